#!/bin/sh
# test_trade_scene.sh - qlux-trade of a scene: what it advises, what it refuses
# SPDX-License-Identifier: MIT
#
# Usage: tests/tools/trade/test_trade_scene.sh [BUILD]
# Example: tests/tools/trade/test_trade_scene.sh build

suite=tools/trade_scene
. tests/support/workspace.sh
trade=$build/qlux-trade
cornell=$root/tests/scenes/cornell.scene

"$trade" "$cornell" --quick --threads 1 -o t.svg >said.txt 2>err.txt
status=$?
[ $status -eq 0 ] && [ ! -s err.txt ] &&
    [ "$(grep -c '^ *[0-9]* %   qlux-sim cornell.qlb --spp [0-9]* --direct' \
        said.txt)" -eq 3 ]
say a_scene_is_compiled_and_three_errors_have_their_way $?

# The error said of 64 samples is that of such a picture against another one of
# many samples and bounces, whose own is a quarter of it.
options=$(sed -n 's/.*cornell.qlb --spp 64 /--spp 64 /p' said.txt | head -n 1)
said=$(sed -n '/--spp 64 /,/error/s/.* error \([0-9.]*\) %.*/\1/p' said.txt)
# shellcheck disable=SC2086 # a list of options
"$build/qlux-sim" "$build/cornell.qlb" -o x.pfm --size 18x18 $options --quiet &&
    "$build/qlux-sim" "$build/cornell.qlb" -o y.pfm --size 18x18 --spp 1024 \
        --bounces 24 --seed 9 --quiet &&
    "$build/qlux-diff" x.pfm y.pfm >diff.txt
awk -v said="$said" '/^relmse:/ {
        is = 100 * sqrt($2) / sqrt(1 + 1 / 16)
        printf "%s %% said, %.1f %% measured\n", said, is
        exit !(said > 0.85 * is && said < 1.15 * is)
    }' diff.txt >note.txt
say the_error_said_is_that_of_the_picture $? "$(cat note.txt)"

# "microbit cortex-m0 1,323,656 64x64 339 s at 16 MHz"
awk '{ gsub(/,/, "") } $2 ~ /^(cortex|rv32)/ {
        split($4, px, "x")
        s = $3 * px[1] * px[2] / ($8 * 1e6)
        if ($5 < 0.99 * s - 0.5 || $5 > 1.01 * s + 0.5) exit 1
        n++
    }
    END { exit n != 12 }' said.txt
say seconds_are_instructions_of_all_pixels_over_the_clock $?
for board in "$root"/hal/boards/*; do
    hz=$(awk '$2 == "QL_PORT_CPU_HZ" { print $3 / 1e6 }' "$board/board.h")
    size=$(sed -n 's/^BOARD_SIZE := //p' "$board/board.mk")
    grep -q "^ *${board##*/} .* $size .* s at $hz MHz$" said.txt ||
        echo "${board##*/}"
done >lacking.txt
say_none every_board_has_its_clock_and_size "$(cat lacking.txt)"

grep -q 'SPP=[0-9]* DIRECT=area' said.txt &&
    grep -q 'SCENE=.*/cornell.scene SPP=' said.txt
say the_same_is_said_for_make $?
grep -q ', extrapolated$' said.txt
say more_samples_than_were_rendered_are_extrapolated $?
grep -q 'best on cortex-m3' t.svg && grep -q '>area-' t.svg
say the_drawing_has_every_core $?

"$build/qlux-scene" "$root/tests/scenes/square.scene" -o square.qlb --quiet
"$trade" square.qlb --quick --board microbit --size 32x32 --threads 3 >b.txt
[ $? -eq 0 ] && grep -q 'qlux-sim square.qlb .* --size 32x32$' b.txt &&
    ! grep -q make b.txt &&
    [ "$(grep -c ' s at ' b.txt)" -eq 3 ] &&
    [ "$(grep -c '^ *microbit .* 32x32 .* 16 MHz' b.txt)" -eq 3 ]
say a_board_and_a_size_narrow_it $?
"$trade" square.qlb --quick --board microbit --size 32x32 --threads 1 |
    cmp -s - b.txt
say threads_change_no_figure $?

expect another_board_is_code_1 1 "'--board pico': expected lm3s6965evb, micro" \
    "$trade" "$cornell" --board pico
expect another_extension_is_code_1 1 'expected .csv, .scene, .obj or .qlb' \
    "$trade" room.stl
expect a_board_for_a_table_is_code_1 1 "'--board' is of a scene" \
    "$trade" "$root/tools/trade/trade.csv" --board microbit
expect a_missing_blob_is_code_3 3 'cannot read none.qlb' "$trade" none.qlb
expect a_missing_scene_is_code_3 3 'cannot read none.scene' "$trade" none.scene
echo 'mesh' >bad.scene
expect a_bad_scene_is_code_2_with_its_line 2 'bad.scene:1' "$trade" bad.scene
echo 'no blob' >bad.qlb
expect a_bad_blob_is_code_2 2 'bad.qlb: byte' "$trade" bad.qlb
cp "$trade" alone
expect a_missing_compiler_is_code_3 3 'qlux-scene: cannot be run' \
    ./alone "$cornell"
cat >dark.obj <<'END_OBJ'
v 0 0 0
v 1 0 0
v 0 1 0
f 1 2 3
END_OBJ
cat >dark.scene <<'END_SCENE'
mesh dark.obj
camera eye 0.2 0.2 2 look 0.2 0.2 0 fov 40
END_SCENE
expect a_picture_without_light_is_code_2 2 'the picture is black' \
    "$trade" dark.scene --quick
exit $((failures > 0))
