#!/bin/sh
# check_format.sh - every C file is as clang-format leaves it
# SPDX-License-Identifier: MIT
#
# usage: tests/lint/check_format.sh [--write]
#
# Versions 14 and 15 leave every file alike; 19 has other ideas about macros and
# assembler in ten files. So another version judges nothing: one claim says so.
#
# Example: tests/lint/check_format.sh --write

set -u
suite=lint/format
. tests/support/claims.sh
. tests/lint/tree.sh
files=$(tree_files '*.c' '*.h')
version=$(clang-format --version 2>&1 | head -n 1)
case $(echo "$version" | sed 's/.*version \([0-9]*\).*/\1/') in
14 | 15) judges=1 ;;
*) judges= ;;
esac

# shellcheck disable=SC2086 # a list of files
if [ "${1:-}" = --write ]; then
    if [ -z "$judges" ]; then
        echo "check_format.sh: needs clang-format 14 or 15, not $version" >&2
        exit 1
    fi
    clang-format -i $files
    exit
fi

say_found "$files"
if ! command -v clang-format >/dev/null; then
    say clang_format_is_installed 1
elif [ -z "$judges" ]; then
    say format_can_be_told_by_clang_format_14_or_15_only 0 "this is $version"
else
    # shellcheck disable=SC2086 # a list of files
    bad=$(clang-format --dry-run -Werror $files 2>&1 </dev/null)
    status=$?
    bad=$(echo "$bad" | sed -n 's/:[0-9]*:[0-9]*: error: .*//p' | sort -u |
        head -n 5 | tr '\n' ' ')
    say every_c_file_is_as_clang_format_leaves_it $status "$bad($version)"
fi
exit $((failures > 0))
