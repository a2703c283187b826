#!/bin/sh
# test_lut.sh - the core's tables are what qlux-lut writes, byte for byte
# SPDX-License-Identifier: MIT
#
# usage: tests/tools/test_lut.sh [QLUX_LUT]
#
# Example: tests/tools/test_lut.sh build/qlux-lut

set -u
cd "$(dirname "$0")/../.." || exit 1
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
status=0

claim()
{
    if [ "$2" = 0 ]; then
        result=ok
    else
        result="FAIL repeat: tests/tools/test_lut.sh"
        status=1
    fi
    printf '%-20s %-52s %s\n' tools/test_lut "$1" "$result"
}

"${1:-build/qlux-lut}" -o "$out/ql_lut_data.c" &&
    cmp "$out/ql_lut_data.c" firmware/math/ql_lut_data.c
claim tables_regenerated_are_identical $?
exit "$status"
