#!/bin/sh
# test_lint.sh - lint sees the sources and nothing else, wherever the tree lies
# SPDX-License-Identifier: MIT
#
# usage: tests/tools/dev/test_lint.sh
#
# Example: tests/tools/dev/test_lint.sh

set -u
suite=lint/test_lint
. tests/support/claims.sh
work=$(mktemp -d) || exit 3
trap 'rm -rf "$work"' EXIT
tree=$(pwd)

# A small tree with two faults, and the same ones in files that were built.
begin() { # FOLDER
    mkdir -p "$1/tests/support" "$1/sim" "$1/out/flags" "$1/old/flags"
    cp -R "$tree/tests/lint" "$1/tests"
    cp "$tree/tests/support/claims.sh" "$1/tests/support"
    cp "$tree/.clang-format" "$tree/Makefile" "$1"
    printf '/* good.c - it is well */\n/* SPDX-License-Identifier: MIT */\n' \
        >"$1/sim/good.c"
    printf 'int   f(void);\n' >"$1/sim/bad.h"
    touch "$1/old/flags/sources"
    for folder in "$1/out" "$1/old"; do
        printf 'int   g(void);\n' >"$folder/cornell.h"
        echo '[nowhere](nowhere)' >"$folder/made.md"
    done
    echo '[nowhere](nowhere)' >"$1/README.md"
}

# A program that does as it is told, before all others.
pretend() { # NAME COMMANDS
    mkdir -p "$work/bin"
    printf '#!/bin/sh\n%s\n' "$2" >"$work/bin/$1"
    chmod +x "$work/bin/$1"
}

lint() { # NAME [ARGUMENT...]: of the small tree
    script=tests/lint/check_$1.sh
    shift
    (cd "$small" && BUILD=out PATH="$work/bin:$PATH" "./$script" "$@") \
        >"$work/said" 2>&1
}

said() { # CLAIM NOTE: that it fails so
    tr -s ' ' <"$work/said" | grep -qF -- " $1 FAIL $2"
}

# The faults are found, and no others.
finds() {
    ! lint format && grep -q 'FAIL sim/bad.h (' "$work/said" &&
        ! lint docs &&
        said every_source_begins_with_its_name_and_one_line sim/bad.h:1 &&
        said links_in_documents_lead_somewhere 'README.md: nowhere' &&
        ! grep -q 'cornell.h\|made.md\|good.c' "$work/said"
}

small="$work/a tree"
begin "$small"
if command -v clang-format >/dev/null; then
    version=$(clang-format --version)
else
    version="version 14"
fi
case $version in
*'version 14.'* | *'version 15.'*) ;;
*)  # what follows is about files, so any judge will do
    pretend clang-format '[ "$1" = --version ] && echo version 14.0 && exit
        shift 2
        ! grep -n "int   " /dev/null "$@" | sed "s/int .*/1: error: no/" |
            grep .'
    ;;
esac
pretend git 'exit 128'
finds
say an_archive_without_git_is_checked_like_a_clone $?
rm "$work/bin/git"
pretend git '[ "$2" != --error-unmatch ]'
finds
say so_is_a_tree_that_another_repository_does_not_track $?
rm "$work/bin/git"
if git init -q "$small" 2>/dev/null; then
    finds
    say so_is_one_where_nothing_is_added_yet $?
    (cd "$small" && git add Makefile sim tests README.md)
    finds
    say a_clone_is_checked_by_what_it_tracks $?
    rm -rf "$small/.git"
fi

rm "$small/sim/bad.h"
pretend git 'exit 128'
lint format
say without_the_fault_nothing_is_found $?
rm "$small/sim/good.c"
for name in format layers circles docs; do
    ! lint $name && said there_are_files_to_look_at 0
    say "a_tree_without_files_fails_$name" $?
done

printf 'int   f(void);\n' >"$small/sim/bad.h"
pretend clang-format 'echo "clang-format version 19.1.7"; exit 0'
lint format && grep -q '_only .*ok .*version 19.1.7$' "$work/said"
say another_version_says_that_it_cannot_tell $?
! lint format --write && grep -q 'not clang-format version 19' "$work/said"
say another_version_writes_nothing $?
pretend clang-format 'echo version 14.0.6; [ "$1" = --version ]'
! lint format && grep -q 'leaves_it .*FAIL (version 14.0.6)' "$work/said"
say clang_format_that_fails_without_a_word_fails $?

exit $((failures > 0))
