# claims.sh - what the tests of programs share; they source it
# SPDX-License-Identifier: MIT
#
# Before: suite=tools/test_NAME. After: $build holds the programs ($1, or build),
# the current folder is a new one, removed at the end, and failures is 0.

build=$(cd "${1:-build}" && pwd) || exit 3
root=$(cd "$(dirname "$0")/../.." && pwd) || exit 3
work=$(mktemp -d) || exit 3
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 3
failures=0

say() { # claim, what it evaluates to
    if [ "$2" -eq 0 ]; then
        printf '%-20s %-52s ok\n' "$suite" "$1"
    else
        printf '%-20s %-52s FAIL\n' "$suite" "$1"
        failures=$((failures + 1))
    fi
}

# expect CLAIM CODE TEXT COMMAND...: the exit code, and TEXT in what it prints
expect() {
    claim=$1 code=$2 text=$3
    shift 3
    "$@" >out.txt 2>&1
    got=$?
    grep -q -- "$text" out.txt && [ "$got" -eq "$code" ]
    say "$claim" $?
}
