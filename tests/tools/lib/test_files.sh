#!/bin/sh
# test_files.sh - names of files, stdin and stdout, Ctrl-C: alike everywhere
# SPDX-License-Identifier: MIT
#
# Usage: tests/tools/lib/test_files.sh [BUILD]
# Example: tests/tools/lib/test_files.sh build

suite=tools/files
. tests/support/workspace.sh
sim=$build/qlux-sim
small="--size 6x5 --spp 2 --quiet"

"$build/qlux-scene" "$root/tests/scenes/furnace.scene" \
    --direct area -o scene.qlb \
    >out.txt || exit 3
"$sim" scene.qlb -o want.ppm --save-sums want.qls $small || exit 3
"$sim" scene.qlb -o want.pfm $small || exit 3
ln -s /dev/null null.ppm

# ---- Links that lead to nothing yet

# leads LINK FILE: a picture goes through the link, which stays one
leads() {
    "$sim" scene.qlb -o "$1" $small && [ -L "$1" ] && [ ! -L "$2" ] &&
        cmp -s "$2" want.ppm && [ "$(find . -name '*.tmp' | wc -l)" -eq 0 ]
}
mkdir deep
ln -s new.ppm link.ppm && leads link.ppm new.ppm
say a_link_to_what_is_not_there_makes_it $?
ln -s new2.ppm first.ppm && ln -s first.ppm second.ppm &&
    leads second.ppm new2.ppm && [ -L first.ppm ]
say a_link_to_such_a_link_makes_it $?
ln -s deep/new.ppm down.ppm && ln -s ../new3.ppm deep/up.ppm &&
    leads down.ppm deep/new.ppm && leads deep/up.ppm new3.ppm
say such_a_link_begins_in_its_own_folder $?
ln -s "$work/new4.ppm" whole.ppm && leads whole.ppm new4.ppm
say such_a_link_may_be_a_whole_path $?
ln -s none/new.ppm lost.ppm
expect a_link_into_no_folder_is_code_3 3 'cannot write lost.ppm: No such file' \
    "$sim" scene.qlb -o lost.ppm $small
ln -s b.ppm a.ppm && ln -s a.ppm b.ppm
expect links_in_a_circle_are_code_3 3 'cannot write a.ppm: ' \
    "$sim" scene.qlb -o a.ppm $small

# ---- Two outputs with one name

# clash NAME NAME: both of qlux-sim
clash() {
    "$sim" scene.qlb -o "$1" --save-sums "$2" $small >out.txt 2>err.txt
    [ $? -eq 1 ] && [ ! -s out.txt ] && grep -qx "qlux-sim: '--save-sums $2': \
'-o' writes this file (see --help)" err.txt
}
bad=
ln -s same.ppm alias.ppm
ln -s . here
for second in same.ppm ./same.ppm deep/../same.ppm "$work/same.ppm" \
    alias.ppm here/same.ppm; do
    clash same.ppm "$second" && [ ! -e same.ppm ] || bad="$bad $second"
done
echo old >same.ppm
clash alias.ppm here/same.ppm && [ "$(cat same.ppm)" = old ] ||
    bad="$bad old"
clash - - || bad="$bad -"
say_none two_outputs_with_one_name_are_refused "$bad"
"$build/qlux-scene" scene.qlb -o a.txt --features ./a.txt 2>err.txt
[ $? -eq 1 ] && [ ! -e a.txt ] && "$build/qlux-merge" want.qls -o x.ppm \
    --save-sums ./x.ppm 2>>err.txt
[ $? -eq 1 ] && [ ! -e x.ppm ] &&
    [ "$(grep -c 'writes this file' err.txt)" -eq 2 ]
say so_they_are_everywhere $?
"$sim" scene.qlb -o null.ppm --save-sums /dev/null --samples-map other.pfm \
    $small && ln other.pfm hard.pfm &&
    "$sim" scene.qlb -o hard.pfm --samples-map other.pfm $small &&
    cmp -s hard.pfm want.pfm
say devices_and_names_of_their_own_are_not $?

# ---- A dash

cp "$root"/tests/scenes/furnace.* .
"$build/qlux-scene" - --direct area -o - <furnace.scene 2>err.txt |
    cmp -s - scene.qlb &&
    grep -q ' triangles, ' err.txt
say qlux_scene_reads_and_writes_a_dash $?
"$build/qlux-scene" - --dump -o - <scene.qlb | "$build/qlux-scene" - \
    --quiet -o - | cmp -s - scene.qlb &&
    "$build/qlux-scene" - --info <scene.qlb | grep -q triangles
say its_dumps_do_too $?
"$sim" - -o - --stats $small <scene.qlb 2>err.txt | cmp -s - want.ppm &&
    grep -q '^paths: 60$' err.txt
say qlux_sim_does $?
"$sim" - --save-sums - $small <scene.qlb | "$build/qlux-merge" - -o - |
    cmp -s - want.ppm
say qlux_merge_does $?
"$sim" scene.qlb -o null.ppm --samples-map - $small | head -c 2 | grep -qx PF
say a_map_is_a_pfm_there_as_well $?
"$build/qlux-ref" scene.qlb -o ref.ppm $small &&
    "$build/qlux-ref" - -o - $small <scene.qlb | cmp -s - ref.ppm
say qlux_ref_does $?
"$build/qlux-diff" want.ppm ref.ppm -o diff.ppm >figures.txt &&
    "$build/qlux-diff" want.ppm - -o - <ref.ppm 2>err.txt |
    cmp -s - diff.ppm && cmp -s err.txt figures.txt
say qlux_diff_does $?
"$build/qlux-sheet" a=want.ppm -o sheet.ppm &&
    "$build/qlux-sheet" a=- -o - <want.ppm | cmp -s - sheet.ppm
say qlux_sheet_does $?
"$build/qlux-warp" plot tent -o tent.ppm >out.txt &&
    "$build/qlux-warp" plot tent -o - 2>err.txt | cmp -s - tent.ppm
say qlux_warp_does $?
"$build/qlux-lut" -o - | cmp -s - "$root/firmware/math/lut/ql_lut_data.c"
say qlux_lut_does $?
"$build/qlux-trade" - --best <"$root/tools/trade/trade.csv" >out.txt &&
    "$build/qlux-trade" "$root/tools/trade/trade.csv" --best | cmp -s - out.txt
say qlux_trade_does $?
expect stdin_is_read_once 1 "'-' is given twice" \
    "$build/qlux-diff" - - <want.ppm

# ---- Ctrl-C

# Its first picture has come to an end when the second begins: from the end of
# that one on it computes.
mkfifo fifo
{ printf 'P6\n4000 3000\n255\n'; head -c 36000000 /dev/zero; } >large.ppm
"$build/qlux-diff" large.ppm fifo >out.txt 2>err.txt &
child=$!
cat large.ppm >fifo
kill -INT $child
wait $child
[ $? -eq 3 ] && [ ! -s out.txt ] &&
    [ "$(cat err.txt)" = 'qlux-diff: interrupted' ]
say qlux_diff_ends_while_it_compares $?
rm large.ppm
"$build/qlux-warp" test >out.txt 2>err.txt &
child=$!
sleep 1
kill -INT $child
wait $child
[ $? -eq 3 ] && [ "$(cat err.txt)" = 'qlux-warp: interrupted' ]
say qlux_warp_ends_while_it_tests $?
for signal in INT TERM; do
    "$build/qlux-sheet" a=fifo -o no.ppm 2>err.txt &
    child=$!
    exec 3>fifo # opens once qlux-sheet has
    kill -$signal $child
    wait $child
    code=$?
    exec 3>&-
    [ $code -eq 3 ] && [ "$(cat err.txt)" = 'qlux-sheet: interrupted' ] &&
        [ ! -e no.ppm ]
    say "${signal}_ends_a_program_that_reads" $?
done

exit $((failures != 0))
