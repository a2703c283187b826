#!/bin/sh
# check_format.sh - every C file is as clang-format leaves it
# SPDX-License-Identifier: MIT
#
# usage: tests/lint/check_format.sh [--write]
#
# Example: tests/lint/check_format.sh --write

set -u
suite=lint/format
. tests/support/claims.sh
files=$(git ls-files '*.c' '*.h' 2> /dev/null || find . -name '*.[ch]')
if [ "${1:-}" = --write ]; then
    clang-format -i $files
    exit
fi
bad=$(for f in $files; do
    clang-format "$f" | cmp -s - "$f" || echo "$f"
done)
say_none every_c_file_is_as_clang_format_leaves_it "$bad"
exit "$failures"
