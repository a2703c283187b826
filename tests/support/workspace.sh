# workspace.sh - a folder of its own for a test of programs; scripts source it
# SPDX-License-Identifier: MIT
#
# Before: suite=tools/NAME, and the current folder is the tree's, as for every
# test. After: $build holds the programs ($1, or build), $root is the tree, the
# current folder is a new one, removed at the end, and claims.sh is there.

. tests/support/claims.sh
root=$(pwd)
build=$(cd "${1:-${BUILD:-build}}" && pwd) || exit 3
work=$(mktemp -d) || exit 3
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 3

# expect CLAIM CODE TEXT COMMAND...: the exit code, and TEXT in what it prints
expect() {
    claim=$1 code=$2 text=$3
    shift 3
    "$@" >out.txt 2>&1
    got=$?
    grep -q -- "$text" out.txt && [ "$got" -eq "$code" ]
    say "$claim" $?
}
