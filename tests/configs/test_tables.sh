#!/bin/sh
# test_tables.sh - what reads the warps' tables, with sizes that no pair has
# SPDX-License-Identifier: MIT
#
# usage: tests/configs/test_tables.sh
#
# ql_config.h offers QL_CFG_TABLE_BITS from .. to ..; gates.txt tries some of
# them in everything. With each other one, as it is in one precision and refined
# in the other, the claims about what reads a table run: compiled with the few
# files that they need. Prints one claim a configuration.
#
# Environment: CC (cc).
#
# Example: tests/configs/test_tables.sh

set -u
cd "$(dirname "$0")/../.." || exit 3
suite=configs/tables
. tests/support/claims.sh
CC=${CC:-cc}
warnings=$(sed -n 's/^export WARN := //p' Makefile)
work=$(mktemp -d) || exit 3
trap 'rm -rf "$work"' EXIT
flags="-std=c99 -pedantic $warnings -Werror -O1 -g0 -DQL_TEST_SHARE=64 \
    -D_POSIX_C_SOURCE=200809L"
for folder in firmware hal tools tests; do
    flags="$flags -I$PWD/$folder"
done
# A test and the part of the names of its claims that depend on the tables.
claims='lut: trig:bound real:root warp_sphere:sphere warp_plane:disk'
sources='math/ql_fx math/ql_real math/ql_trig math/lut/ql_lut_data
    math/vec/ql_vec math/vec/ql_vec_unit warp/ql_warp_sphere
    warp/ql_warp_hemisphere warp/ql_warp_plane'
files=
for source in $sources; do
    files="$files $PWD/firmware/$source.c"
done
unit=$PWD/tests/unit

# Where every file is compiled with the flags of a configuration.
try() # NAME -D...
{
    suite=configs/$1
    shift
    dir=$work/$suite
    mkdir -p "$dir" && cd "$dir" || exit 3
    # shellcheck disable=SC2086
    $CC $flags "$@" -c $files > log 2>&1
    status=$?
    passed=0
    for claim in $claims; do
        test=test_${claim%:*}
        # shellcheck disable=SC2086
        $CC $flags "$@" "$unit/$test.c" "$dir"/*.o "$work"/*.o -lm \
            -o "$test" >> log 2>&1 && "./$test" "${claim#*:}" > out 2>&1 ||
            status=1
        cat out >> log
        passed=$((passed + $(grep -c ' ok ' out)))
    done
    grep -v ' ok ' log >&2
    [ $status -eq 0 ] && [ $passed -ge 20 ]
    say what_reads_a_table_is_within_its_bounds $? "$passed claims"
    cd "$work" || exit 3
}

range=$(sed -n 's/^#if QL_CFG_TABLE_BITS < \([0-9]*\) || [A-Z_]* > /\1 /p' \
    firmware/ql_config.h)
tried=$(sed -n 's/^gate QL_CFG_TABLE_BITS //p' tests/configs/gates.txt)
# shellcheck disable=SC2086
offered=$(echo $(seq $range))
[ -n "$tried" ] && [ -n "$offered" ]
say sizes_that_are_offered_are_known $? "$offered; in pairs $tried"

(cd "$work" && $CC $flags -c "$unit/../support/ql_stats.c" \
    "$unit/../../tools/lib/math/build_table.c") || exit 3
precision=1
for bits in $offered; do
    case " $tried " in
    *" $bits "*) continue ;;
    esac
    for refined in 0 1; do
        try "tables-$bits-$refined" "-DQL_CFG_PRECISION=$precision" \
            "-DQL_CFG_TABLE_BITS=$bits" "-DQL_CFG_TABLE_LERP=$refined"
        precision=$((1 - precision))
    done
    precision=$((1 - precision))
done
exit $((failures > 0))
