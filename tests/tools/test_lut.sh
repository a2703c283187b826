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
suite=tools/test_lut
. tests/support/claims.sh

"${1:-${BUILD:-build}/qlux-lut}" -o "$out/ql_lut_data.c" &&
    cmp "$out/ql_lut_data.c" firmware/math/lut/ql_lut_data.c
say tables_regenerated_are_identical $?
exit "$failures"
