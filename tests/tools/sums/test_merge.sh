#!/bin/sh
# test_merge.sh - qlux-merge: sums beyond 32 bits, and files that were damaged
# SPDX-License-Identifier: MIT
#
# Usage: tests/tools/sums/test_merge.sh [BUILD]
# Example: tests/tools/sums/test_merge.sh build

suite=tools/merge
. tests/support/workspace.sh
sim=$build/qlux-sim
merge=$build/qlux-merge
patch=$build/test/fine/tools/sums/patch_main

"$build/qlux-scene" "$root/tests/scenes/furnace.scene" \
    --direct area -o scene.qlb \
    >out.txt || exit 3

# ---- Numbers: two pixels, one sample in each part; sums begin at byte 92
for i in 0 1; do
    "$sim" scene.qlb --size 2x1 --spp 2 --samples $i:$((i + 1)) --quiet \
        --save-sums part$i.qls || exit 3
done

# reverse: the eight bytes of each line
reverse() {
    sed 's/\(..\)\(..\)\(..\)\(..\)\(..\)\(..\)\(..\)\(..\)/\8\7\6\5\4\3\2\1/'
}
# file PART HEX...: the sums of a part, each as sixteen digits
file() {
    "$patch" "$1" 124 "$(shift && printf '%s\n' "$@" | reverse | tr -d '\n')"
}
# sums FILE: its six sums
sums() {
    od -An -v -tx1 -j 124 -N 48 -w8 "$1" | tr -d ' ' | reverse
}

# A, B and what they add up to: carries into the upper half, into its highest
# bit, exactly the largest number, and beyond it.
cat >cases.txt <<'END'
00000000ffffffff 0000000000000001 0000000100000000
00000000ffffffff 00000000ffffffff 00000001fffffffe
12345678ffffffff 0000000100000001 1234567a00000000
7fffffffffffffff 0000000000000001 8000000000000000
fffffffffffffffe 0000000000000001 ffffffffffffffff
ffffffffffffffff 0000000000000001 ffffffffffffffff
8000000000000000 8000000000000000 ffffffffffffffff
ffffffff00000000 00000000ffffffff ffffffffffffffff
ffffffff00000000 0000000100000000 ffffffffffffffff
0000000000000000 fffffffffffffffe fffffffffffffffe
00000000fffffffe 0000000000000001 00000000ffffffff
0123456789abcdef 0fedcba987654321 1111111111111110
END
ok=0
for from in 1 2 3 4 5 6 7 8 9 10 11 12; do
    # six of the twelve, beginning with another one each time
    cat cases.txt cases.txt | tail -n +$from | head -n 6 >six.txt
    # shellcheck disable=SC2046 # a list of numbers
    file part0.qls $(cut -d ' ' -f 1 six.txt) >a.qls &&
        file part1.qls $(cut -d ' ' -f 2 six.txt) >b.qls || ok=1
    cut -d ' ' -f 3 six.txt >wanted.txt
    for order in 'a.qls b.qls' 'b.qls a.qls'; do
        # shellcheck disable=SC2086
        "$merge" $order --save-sums sum.qls && sums sum.qls >got.txt &&
            cmp -s got.txt wanted.txt || ok=1
    done
done
say every_sum_carries_and_stops_at_its_largest $ok

# The mean of 2^24 samples is one: half of them in each part.
"$patch" part0.qls 108 "00000000010000000000000000008000" \
    124 "$(printf '0000000000800000%.0s' 1 2 3 4 5 6)" >a.qls
"$patch" part1.qls 108 "00000000010000000000800000000001" \
    124 "$(printf '0000000000800000%.0s' 1 2 3 4 5 6)" >b.qls
"$merge" a.qls b.qls -o sum.pfm --save-sums sum.qls && [ "$(sums sum.qls |
    sort -u)" = 0001000000000000 ] &&
    [ "$(od -An -tx1 -j 108 -N 16 sum.qls | tr -d ' ')" = \
        00000000010000000000000000000001 ]
say counts_of_samples_add_up_to_the_most $?
exponent=$(od -An -td4 -j 20 -N 4 part0.qls | tr -d ' ')
# 2^e as a float: no sign, eight bits of e + 127, no fraction
float=$(awk -v b=$(((exponent + 127) * 8388608)) 'BEGIN {
    for (; k < 4; k++) { printf "%02x", b % 256; b = int(b / 256) } }')
[ "$(tail -c 24 sum.pfm | od -An -v -tx1 -w4 | tr -d ' ' | sort -u)" = \
    "$float" ]
say their_mean_is_one_unit $?

# One run of many samples against its parts, which meet within a step of the
# work and at its end. Each sum is 8200 times 2 and more, of which 2^24 is 1.
many="--size 3x2 --spp 8200 --quiet"
"$sim" scene.qlb $many --save-sums whole.qls -o whole.pfm
for part in 0:4095 4095:4097 4097:8192 8192:8193 8193:8200; do
    "$sim" scene.qlb $many --samples $part --save-sums "many$part.qls"
done
"$merge" many*.qls -o sum.pfm --save-sums sum.qls &&
    cmp -s whole.qls sum.qls && cmp -s whole.pfm sum.pfm
say parts_of_many_samples_add_up_to_one_run $?
high=$(od -An -v -tu4 -j 124 -N 144 -w8 whole.qls | awk '$2 > 0' | wc -l)
[ "$high" -eq 18 ]
say all_of_their_sums_are_beyond_32_bits $? "$high of 18"

# ---- Large pictures: rows pass one by one

# Row 0 of so many of 16384 pixels, from a picture of one row.
for i in 0 1; do
    "$sim" scene.qlb --size 16384x1 --spp 2 --samples $i:$((i + 1)) --quiet \
        --save-sums row$i.qls && "$patch" row$i.qls 8 00400000 >tall$i.qls &&
        "$patch" row$i.qls 8 00040000 >short$i.qls
done
ln -s /dev/null null.ppm
"$merge" row0.qls row1.qls --save-sums row.qls &&
    "$patch" row.qls 8 00400000 >tall.qls
(ulimit -v 60000 && "$merge" tall0.qls tall1.qls --quiet -o null.ppm \
    --save-sums sum.qls) && cmp -s sum.qls tall.qls
say a_picture_of_16384x16384_takes_less_than_60_megabytes $?
(ulimit -v 60000 && "$merge" short0.qls short1.qls --quiet -o - >short.ppm &&
    "$merge" short0.qls short1.qls --quiet -o short.pfm) &&
    [ "$(wc -c <short.ppm)" -eq $((18 + 3 * 16384 * 1024)) ] &&
    [ "$(wc -c <short.pfm)" -eq $((19 + 12 * 16384 * 1024)) ]
say so_do_a_ppm_and_a_pfm $?
rm short.ppm short.pfm
# 20 MB of pixels, held three times by who compresses them as one.
for i in 0 1; do
    "$patch" row$i.qls 8 90010000 >short$i.qls
done
(ulimit -v 40000 && "$merge" short0.qls short1.qls --quiet -o short.png) &&
    "$merge" short0.qls short1.qls --quiet -o short.ppm &&
    "$build/qlux-diff" short.ppm short.png --max-relmse 0 >out.txt
say so_does_a_png $?
rm short.*
(ulimit -v 12000 && exec "$merge" tall0.qls --quiet -o no.png) 2>err.txt
[ $? -eq 3 ] && grep -q '^qlux-merge: out of memory for ' err.txt &&
    [ ! -e no.png ]
say what_does_not_fit_says_so $?
large="--size 16384x16384 --spp 1 --threads 1 --quiet"
# shellcheck disable=SC2086
(ulimit -v 60000 && exec "$sim" scene.qlb $large --save-sums no.qls) 2>err.txt
[ $? -eq 3 ] && [ ! -e no.qls ] && [ "$(cat err.txt)" = "qlux-sim: out of \
memory for the sums of rows 0:16384, 6442450944 bytes; fewer rows take less" ]
say so_does_the_simulator $?
# shellcheck disable=SC2086
(ulimit -v 60000 && "$sim" scene.qlb $large --rows 9999:10001 \
    --save-sums rows.qls && "$build/qlux-ref" scene.qlb $large --rows 0:1 \
    -o null.ppm && "$merge" rows.qls --quiet --save-sums sum.qls) &&
    cmp -s rows.qls sum.qls
say some_rows_of_a_large_picture_take_the_memory_of_some $?
# More bytes than a number of 32 bits counts, of which none is on the disk.
truncate -s $((16384 * 16384 * 24 + 96)) bad.qls
"$merge" bad.qls -o no.ppm 2>err.txt
[ $? -eq 2 ] && grep -q 'byte 0: expected a sum file (QLS4)' err.txt
say a_file_of_6_gigabytes_is_opened $?
rm bad.qls
# A sample of each pixel in each part.
for k in $(seq 0 499); do
    hex=$(printf '%02x%02x0000%02x%02x0000' $((k % 256)) $((k / 256)) \
        $(((k + 1) % 256)) $(((k + 1) / 256)))
    "$patch" part0.qls 116 "$hex" >"s$k.qls"
done
(ulimit -n 64 && "$merge" s[0-9]*.qls --save-sums sum.qls -o sum.pfm) &&
    [ "$(od -An -w20 -tu4 -j 104 -N 20 sum.qls | tr -s ' ')" = \
        ' 1 0 1 0 500' ] &&
    [ "$(sums sum.qls)" = "$(sums part0.qls | while read -r hex; do
        printf '%016x\n' $((0x$hex * 500)); done)" ]
say parts_by_the_hundred_with_few_open_files_are_merged $?
cp s7.qls again.qls
expect one_that_is_in_twice_is_named_both_times 2 \
    'again.qls: rows 0:1 samples 7:8 were counted before, in s7.qls$' \
    "$merge" s[0-9]*.qls again.qls --save-sums no.qls
rm s[0-9]*.qls

# ---- Parts of two pictures

# differs CLAIM TEXT-OF-THE-SECOND PROGRAM OPTION...: against qlux-sim with mis
one="--size 3x2 --spp 1 --quiet"
"$sim" scene.qlb $one --direct mis --save-sums one.qls
differs() {
    claim=$1 text=$2 program=$3
    shift 3
    # shellcheck disable=SC2086
    "$build/$program" scene.qlb $one "$@" --save-sums two.qls
    "$merge" one.qls two.qls --save-sums no.qls 2>err.txt
    [ $? -eq 2 ] && [ ! -e no.qls ] && [ "$(cat err.txt)" = "qlux-merge: \
two.qls: its $text in one.qls" ]
    say "$claim" $?
}
differs precisions_are_said_in_words 'precision is draft, but fine' \
    qlux-sim-draft --direct mis
differs strategies_are_said_in_words 'direct strategy is area, but mis' \
    qlux-sim --direct area
differs samplers_are_said_in_words 'sampler is random, but sobol' \
    qlux-sim --direct mis --sampler random
differs indirect_ways_are_said_in_words \
    'indirect strategy is none, but brdf' qlux-sim --direct mis \
    --indirect none
differs choices_of_lights_are_said_in_words \
    'choice of lights is all, but power' qlux-sim --direct mis --lights all
differs roulette_is_said_in_words 'roulette is yes, but no' \
    qlux-sim --direct mis --roulette
differs cut_contributions_are_said_in_units_of_ke 'clamp is 1.5, but 0' \
    qlux-sim --direct mis --clamp 1.5
differs seeds_are_numbers 'seed is 4294967295, but 0' \
    qlux-sim --direct mis --seed 4294967295
"$patch" one.qls 44 09000000 >two.qls
expect words_that_there_are_not_are_numbers 2 \
    'two.qls: its direct strategy is 9, but mis in one.qls' \
    "$merge" one.qls two.qls --save-sums no.qls

# ---- Damage

# refuses CLAIM WHERE-AND-WHY: bad.qls, alone and as the second part
refuses() {
    ok=0
    for parts in bad.qls 'part0.qls bad.qls'; do
        # shellcheck disable=SC2086
        "$merge" $parts -o no.ppm --save-sums no.qls >out.txt 2>err.txt
        [ $? -eq 2 ] && [ ! -s out.txt ] && [ ! -e no.ppm ] &&
            [ ! -e no.qls ] &&
            [ "$(cat err.txt)" = "qlux-merge: bad.qls: byte $2" ] || ok=1
    done
    say "$1" $ok
    [ $ok -eq 0 ] || sed 's/^/    /' err.txt
}

size=$(wc -c <part1.qls)
changed="$((size - 4)): the CRC-32 does not match: the file was cut or changed"
# Of the settings, of the ranges, of the sums, of the check value.
for at in 4 43 79 80 103 104 108 123 124 "$((size - 5))" "$((size - 1))"; do
    { head -c "$at" part1.qls
      tail -c +$((at + 1)) part1.qls | head -c 1 | tr '\000-\377' \
          '\200-\377\000-\177'
      tail -c +$((at + 2)) part1.qls; } >bad.qls
    refuses "byte_${at}_changed_is_refused" "$changed"
done
for cut in 3 4 71 111 112 130 "$((size - 1))"; do
    head -c "$cut" part1.qls >bad.qls
    case $cut in
    3) why='0: expected a sum file (QLS4)' ;;
    4 | 71 | 111) why="$cut: the file ends within its header" ;;
    *) why="$((cut - 4)): ${changed#*: }" ;;
    esac
    refuses "a_file_of_${cut}_bytes_is_refused" "$why"
done
for version in 1 2 3; do
    "$patch" part1.qls 3 3$version >bad.qls
    refuses "version_${version}_is_refused" '0: expected a sum file (QLS4)'
done
# Numbers that no program of ours writes, under a right check value.
# A line says what is put where, the next one what comes of it.
while read -r claim at hex && read -r why; do
    "$patch" part1.qls "$at" "$hex" >bad.qls
    refuses "$claim" "$why"
done <<'END'
width_0_is_refused 4 00000000
    4: expected width from 1 to 16384
height_16385_is_refused 8 01400000
    8: expected height from 1 to 16384
exponent_minus_65_is_refused 20 bfffffff
    20: expected radiance exponent from -64 to 64
exponent_65_is_refused 20 41000000
    20: expected radiance exponent from -64 to 64
exposure_32768_is_refused 24 00800000
    24: expected exposure from -32768 to 32767
direction_bits_0_are_refused 32 00000000
    32: expected direction bits from 1 to 31
roulette_2_is_refused 60 02000000
    60: expected roulette from 0 to 1
table_bits_11_are_refused 64 0b000000
    64: expected table bits from 5 to 10
refined_tables_2_are_refused 68 02000000
    68: expected refined tables from 0 to 1
metered_exposure_of_65_stops_is_refused 72 00410000
    72: expected metered exposure from -16384 to 16384
more_ranges_than_bytes_are_refused 104 05000000
    104: expected a number of ranges that the file can hold
a_range_of_no_rows_is_refused 108 01000000
    108: expected a range of rows of the picture
a_range_below_the_picture_is_refused 112 02000000
    108: expected a range of rows of the picture
a_range_of_no_samples_is_refused 120 01000000
    108: expected a range of samples from 0 to 2^24
a_range_beyond_2_to_the_24_is_refused 120 01000001
    108: expected a range of samples from 0 to 2^24
sums_too_many_are_refused 4 01000000
    124: unexpected bytes after the sums
sums_too_few_are_refused 4 03000000
    124: the sums end too early
END

# Its one range twice; the first sums are taken for the second.
"$patch" part1.qls 104 02000000 124 "$(od -An -v -tx1 -j 108 -N 16 part1.qls |
    tr -d ' \n')" >bad.qls
refuses two_ranges_that_overlap_are_refused '124: a range that overlaps another'

exit $((failures != 0))
