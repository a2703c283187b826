#!/bin/sh
# test_ref.sh - qlux-ref: exit codes, nothing left, the core's pictures
# SPDX-License-Identifier: MIT
#
# Usage: tests/tools/test_ref.sh [BUILD]
# Example: tests/tools/test_ref.sh build

suite=tools/test_ref
. tests/support/workspace.sh
ref=$build/qlux-ref

for scene in cornell glossy sky; do
    "$build/qlux-scene" "$root/tests/scenes/$scene.scene" \
        -o "$scene.qlb" >out.txt 2>&1 || exit 3
done

small="--size 20x14 --spp 8 --seed 3 --quiet"

# Usage
expect no_arguments_are_refused 1 'missing SCENE.qlb' "$ref"
expect no_output_is_refused 1 'missing -o FILE' "$ref" cornell.qlb
expect sums_are_refused 1 "unknown option '--save-sums'" \
    "$ref" cornell.qlb -o a.pfm --save-sums a.qls
expect the_help_says_why 0 'sums of doubles are' "$ref" --help
expect an_unknown_extension_is_refused 1 '.ppm, .pfm or .png' \
    "$ref" cornell.qlb -o a.jpg
expect rows_below_the_picture_are_refused 1 'from 0 to 8' \
    "$ref" cornell.qlb -o a.pfm --size 8x8 --rows 4:9

expect what_has_no_effect_says_so 0 "'--lights all' has no effect with" \
    "$ref" cornell.qlb -o a.pfm $small --direct cosine --lights all --rows 0:1
rm a.pfm

# Input
expect a_missing_scene_is_code_3 3 'none.qlb' "$ref" none.qlb -o a.pfm
head -c 300 cornell.qlb >cut.qlb
expect a_cut_scene_is_code_2 2 'cut.qlb: byte 8: ' "$ref" cut.qlb -o a.pfm
echo 'this is not a blob, whatever its name is' >text.qlb
expect a_text_is_code_2 2 'text.qlb: byte 0: ' "$ref" text.qlb -o a.pfm
expect a_missing_folder_is_code_3 3 'no/a.pfm' "$ref" cornell.qlb -o no/a.pfm
ln -s /dev/full full.pfm
expect a_full_disk_is_code_3 3 'No space' "$ref" cornell.qlb -o full.pfm $small
rm full.pfm cut.qlb text.qlb
[ "$(ls ./*.pfm ./*.tmp 2>/dev/null | wc -l)" -eq 0 ]
say nothing_is_left_behind $?

# Output
"$ref" cornell.qlb -o one.pfm $small --threads 1 &&
    "$ref" cornell.qlb -o four.pfm $small --threads 4 && cmp one.pfm four.pfm
say threads_change_no_bit $?
"$ref" cornell.qlb -o a.ppm $small && "$ref" cornell.qlb -o a.png $small
expect ppm_and_png_agree 0 'identical: yes' "$build/qlux-diff" a.ppm a.png
"$build/qlux-sim" cornell.qlb -o s.ppm $small
"$build/qlux-diff" a.ppm s.ppm >out.txt
awk '$1 == "max:" { exit $2 > 1 }' out.txt
say a_display_shows_what_the_core_shows $? "$(grep max out.txt) of 255"
"$ref" cornell.qlb -o part.pfm $small --rows 0:7 --samples 2:8 --stats >out.txt
grep -q '^paths: 840$' out.txt
say rows_and_samples_are_counted $?

# A slab that bends nothing, before a sky of 1: Tf is taken once, not twice.
printf '%s\n' 'newmtl g' 'illum 7' 'Ni 1' 'Tf 0.5 0.25 1' >slab.mtl
printf '%s\n' 'mtllib slab.mtl' 'usemtl g' 'v -9 -9 0' 'v 9 -9 0' 'v 9 9 0' \
    'v -9 9 0' 'v -9 -9 1' 'v 9 -9 1' 'v 9 9 1' 'v -9 9 1' 'f 4 3 2 1' \
    'f 5 6 7 8' 'f 1 2 6 5' 'f 2 3 7 6' 'f 3 4 8 7' 'f 4 1 5 8' >slab.obj
printf '%s\n' 'mesh slab.obj' 'sky 1 1 1' \
    'camera eye 0 0 9 look 0 0 0 fov 20' >slab.scene
"$build/qlux-scene" slab.scene --direct area -o slab.qlb --quiet || exit 3
for program in qlux-sim qlux-sim-draft qlux-ref; do
    "$build/$program" slab.qlb -o slab.pfm --size 1x1 --spp 16 --quiet
    tail -c 12 slab.pfm | od -A n -t f4 | awk '
        function near(x, want) { return x > want - 1e-6 && x < want + 1e-6 }
        END { exit !(near($1, 0.5) && near($2, 0.25) && near($3, 1)) }'
    say "light_through_a_body_is_filtered_once_by_$program" $?
done

# Two rays a vertex, and a lamp in a ball of glass, where radiance is larger.
agrees() { # CLAIM SCENE.qlb OPTION...
    claim=$1
    shift
    "$ref" "$@" -o double.pfm $small && "$build/qlux-sim" "$@" -o core.pfm \
        $small && "$build/qlux-diff" core.pfm double.pfm --max-relmse 1e-4 \
        --max-bias 1e-3 >out.txt
    say "$claim" $? "$(grep -E '^(relmse|bias)' out.txt | tr '\n' ' ')"
}
agrees two_rays_of_a_vertex_are_those_of_double cornell.qlb --bounces 1 \
    --direct hemisphere --indirect cosine
agrees n_directions_are_those_of_double glossy.qlb --bounces 1 \
    --direct cosine --light-samples 3
agrees mis_and_roulette_are_those_of_double cornell.qlb --direct mis \
    --bounces 3 --roulette
agrees cut_contributions_are_those_of_double cornell.qlb --clamp 0.2
"$build/qlux-sim" cornell.qlb -o core.pfm $small
expect contributions_that_are_not_cut_are_rejected 4 bias \
    "$build/qlux-diff" core.pfm double.pfm --max-bias 1e-3
"$ref" cornell.qlb -o double.ppm $small --exposure auto &&
    "$build/qlux-sim" cornell.qlb -o core.ppm $small --exposure auto
"$build/qlux-diff" core.ppm double.ppm --max-relmse 1e-3 >out.txt
say the_metered_exposure_is_the_cores $? "$(grep relmse out.txt)"
agrees a_round_lamp_by_mis_is_that_of_double glossy.qlb --direct mis --bounces 0
agrees a_round_lamp_by_its_area_is_that_of_double glossy.qlb --bounces 0
printf 'v -1 -1 0\nv 1 -1 0\nv 0 1 0\nmtllib ball.mtl\nusemtl lamp\n' >ball.obj
echo 'f 1 2 3' >>ball.obj
printf 'newmtl lamp\nKd 0 0 0\nKe 1 1 1\n' >ball.mtl
printf 'newmtl glass\nKd 0 0 0\nillum 7\nNi 1.5\nTf 1 1 1\n' >>ball.mtl
printf 'mesh ball.obj\nsphere 0 0 0 radius 4 material glass\n' >ball.scene
echo 'camera eye 0 0 9 look 0 0 0 fov 40' >>ball.scene
"$build/qlux-scene" ball.scene --direct area -o ball.qlb --quiet
agrees a_lamp_in_glass_is_that_of_double ball.qlb --bounces 2

# The same random numbers: what differs is arithmetic, by the limits that the
# formats were chosen for. One bounce only: through glass and back from walls a
# lamp is met by few paths, and one of them that passes it on the other side is
# seen in its pixel.
picture="--size 64x64 --spp 256 --bounces 1 --quiet"
for scene in cornell glossy sky; do
    "$ref" $scene.qlb -o $scene.pfm $picture
    for precision in fine draft; do
        case $precision in
        fine) sim=qlux-sim relmse=1e-6 bias=1e-4 ;;
        draft) sim=qlux-sim-draft relmse=1e-4 bias=1e-3 ;;
        esac
        "$build/$sim" $scene.qlb -o core.pfm $picture &&
            "$build/qlux-diff" core.pfm $scene.pfm --max-relmse $relmse \
                --max-bias $bias >out.txt
        say "${scene}_is_that_of_double_in_$precision" $? "$(grep -E \
            '^(relmse|bias)' out.txt | tr '\n' ' ')limits $relmse $bias"
    done
done
"$build/qlux-sim-draft" cornell.qlb -o core.pfm $picture --seed 1
expect other_random_numbers_are_rejected 4 relmse \
    "$build/qlux-diff" core.pfm cornell.pfm --max-relmse 1e-4

exit $((failures != 0))
