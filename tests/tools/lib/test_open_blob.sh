#!/bin/sh
# test_open_blob.sh - every program says the same of a blob it cannot open
# SPDX-License-Identifier: MIT
#
# Usage: tests/tools/lib/test_open_blob.sh [BUILD]
# Example: tests/tools/lib/test_open_blob.sh build

suite=tools/open_blob
. tests/support/workspace.sh
scene=$build/qlux-scene

# refuses TEXT PROGRAM ARGUMENTS...: exit code 2, this message, nothing written
refuses() {
    wanted="$2: $1"
    shift
    program=$1
    shift
    "$build/$program" "$@" >out.txt 2>err.txt
    [ $? -eq 2 ] && [ "$(cat err.txt)" = "$wanted" ] && [ ! -s out.txt ] &&
        [ ! -e out.qlb ] && [ ! -e out.ppm ] || {
        printf 'wanted %s\n' "$wanted" | cat - err.txt >&2
        return 1
    }
}

# says CLAIM TEXT: of bad.qlb, in every program that opens blobs
says() {
    refuses "bad.qlb: $2" qlux-sim bad.qlb -o out.ppm &&
        refuses "bad.qlb: $2" qlux-sim-draft bad.qlb -o out.ppm &&
        refuses "bad.qlb: $2" qlux-ref bad.qlb -o out.ppm &&
        refuses "bad.qlb: $2" qlux-scene --info bad.qlb &&
        refuses "bad.qlb: $2" qlux-scene --dump bad.qlb -o out.qlb
    say "$1" $?
}

# patch OFFSET BYTES: bad.qlb is good.qlb with other bytes, in octal, there
patch() {
    { head -c "$1" good.qlb; printf '%b' "$2"; } >bad.qlb
    tail -c +$(($(wc -c <bad.qlb) + 1)) good.qlb >rest
    cat rest >>bad.qlb
}

# makes CLAIM TEXT SED: of the blob of a dump that was edited
makes() {
    sed "$3" good.txt >bad.txt
    refuses "the blob of bad.txt: $2" qlux-scene bad.txt -o out.qlb
    say "$1" $?
}

"$scene" "$root/tests/scenes/square.scene" -o good.qlb --quiet || exit 3
"$scene" --dump good.qlb >good.txt || exit 3
size=$(wc -c <good.qlb)

printf 'NOPE' >bad.qlb
says another_file 'byte 0: not a qlux blob: expected "QLUX"'
printf 'QL' >bad.qlb
says a_file_of_two_bytes "byte 2: the blob is longer than the bytes given: \
expected a header of 96 bytes"
patch 4 '\0143\0002'
says another_version "byte 4: the blob's version is not the one this build \
reads: expected version 2, found 611"
head -c $((size - 4)) good.qlb >bad.qlb
says a_cut_blob "byte 8: the blob is longer than the bytes given: expected \
$size bytes, found $((size - 4))"
crc=$(od -An -tx1 -j 12 -N 4 good.qlb | awk '{ print $4 $3 $2 $1 }')
patch 12 '\0001\0002\0003\0004'
says another_checksum "byte 12: the blob's CRC-32 does not match its \
contents: expected $crc, found 04030201"

mended() { # OFFSET HEX: the same with the check value of what is there
    "$build/test/fine/tools/sums/patch_main" good.qlb "$1" "$2" >bad.qlb
}
lacks='the scene needs a feature this build lacks'
mended 19 80
says another_feature "byte 16: $lacks: unknown"
mended 4 0100
says the_version_before "byte 4: the blob's version is not the one this build \
reads: expected version 2, found 1"
mended 4 0300
says the_next_version "byte 4: the blob's version is not the one this build \
reads: expected version 2, found 3"
mended 6 68
says tables_of_other_features "byte 6: the blob's version is not the one this \
build reads: expected the tables of its features, found a header of 104 bytes"
mended 20 2100
says too_deep_a_tree_for_every_program "byte 20: the BVH is deeper than this \
build's stack: expected a depth of 32 or less, found 33"

makes too_deep_a_tree "byte 20: the BVH is deeper than this build's stack: \
expected a depth of 32 or less, found 33" 's/^depth .*/depth 33/'
range='an offset, index, count or value is out of range'
makes a_header_out_of_range "byte 26: $range: expected -64 to 64, found 65" \
    's/^radiance_exp .*/radiance_exp 65/'
makes a_strategy_that_is_none "byte 30: $range: expected 0 to 5, found 6" \
    's/^auto .*/auto 6 0/'
makes a_choice_of_lights_that_is_none "byte 31: $range: expected 0 to 2, found \
3" 's/^auto .*/auto 1 3/'
makes a_table_out_of_range "byte 96: $range: expected tables as BLOB.md has \
them from here on" 's/^d .*/d 0x7fffffff 0x00000000 0x00000000/'

exit $((failures > 0))
