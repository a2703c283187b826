#!/bin/sh
# test_sim.sh - qlux-sim and qlux-merge: exit codes, nothing left, exact parts
# SPDX-License-Identifier: MIT
#
# Usage: tests/tools/test_sim.sh [BUILD [SCENE.qlb]]
# Example: tests/tools/test_sim.sh build

suite=tools/test_sim
. tests/support/workspace.sh
sim=$build/qlux-sim
merge=$build/qlux-merge

# The scene: the one given, or the Cornell box.
if [ -n "${2:-}" ]; then
    (cd "$OLDPWD" && cat "$2") >scene.qlb || exit 3
else
    "$build/qlux-scene" "$root/tests/scenes/cornell.scene" \
        --direct area -o scene.qlb \
        >out.txt || exit 3
fi

# Nothing in the folder that was not there before, but for the logs.
nothing_left() { # claim
    [ "$(ls | grep -v -e '^scene.qlb$' -e '^out.txt$' -e '^err.txt$' | wc -l)" \
        -eq 0 ]
    say "$1" $?
}

small="--size 20x14 --spp 8 --seed 3 --quiet"

# Usage
expect no_arguments_are_refused 1 'missing SCENE.qlb' "$sim"
expect no_output_is_refused 1 'missing -o FILE or --save-sums' "$sim" scene.qlb
expect an_unknown_extension_is_refused 1 '.ppm, .pfm or .png' \
    "$sim" scene.qlb -o a.jpg
for size in 0x8 8x0 -4x4 70000x4 4x70000 16385x1 4 4x 4x4x4 '' x 4:4; do
    expect "size_'$size'_is_refused" 1 'from 1 to 16384\|needs a value' \
        "$sim" scene.qlb -o a.ppm --size "$size"
done
for spp in 0 -1 16777217 99999999999999999999 1e3 +-1; do
    expect "spp_'$spp'_is_refused" 1 'from 1 to 16777216' \
        "$sim" scene.qlb -o a.ppm --spp "$spp"
done
for rows in 5:5 7:3 -1:2 0; do
    expect "rows_${rows}_are_refused" 1 "'--rows $rows'" \
        "$sim" scene.qlb -o a.ppm --size 8x8 --rows "$rows"
done
expect rows_below_the_picture_are_refused 1 'from 0 to 8' \
    "$sim" scene.qlb -o a.ppm --size 8x8 --rows 4:9
expect samples_beyond_spp_are_refused 1 'ends before' \
    "$sim" scene.qlb -o a.ppm --spp 4 --samples 2:5
for n in 0 256 x; do
    expect "light_samples_${n}_are_refused" 1 "'--light-samples $n'" \
        "$sim" scene.qlb -o a.ppm --light-samples "$n"
done
for e in 1 -0.1 1e-9 nan x 0.1x ''; do
    expect "error_'$e'_is_refused" 1 "'--error' is\|from 0 to 0.99999" \
        "$sim" scene.qlb -o a.ppm --error "$e"
done
expect error_with_sums_is_refused 1 "'--error' goes with none" \
    "$sim" scene.qlb --save-sums a.qls --error 0.1
expect error_with_samples_is_refused 1 "'--error' goes with none" \
    "$sim" scene.qlb -o a.ppm --samples 0:4 --error 0.1
expect a_map_that_is_no_pfm_is_refused 1 'ends in .pfm' \
    "$sim" scene.qlb -o a.ppm --samples-map a.ppm
expect indirect_of_no_name_lists_the_names 1 'uniform or brdf' \
    "$sim" scene.qlb -o a.ppm --indirect magic
expect lights_of_no_name_lists_the_names 1 'uniform or auto' \
    "$sim" scene.qlb -o a.ppm --lights magic
expect a_strategy_of_no_name_lists_the_names 1 'mis or auto' \
    "$sim" scene.qlb -o a.ppm --direct magic
expect threads_0_are_refused 1 'from 1 to 1024' \
    "$sim" scene.qlb -o a.ppm --threads 0
expect a_format_without_display_picture_is_refused 1 "'--format' needs" \
    "$sim" scene.qlb -o a.pfm --format gray4
expect linear_radiance_has_no_exposure 1 "'--exposure' needs" \
    "$sim" scene.qlb -o a.pfm --exposure 1
expect linear_radiance_has_no_curve 1 "'--curve' needs" \
    "$sim" scene.qlb -o a.pfm --curve filmic
for radiance in -1 65536 0.000001 x ''; do
    expect "clamp_'$radiance'_is_refused" 1 \
        'from 0 to 65535\|0.0001 or more\|needs a value' \
        "$sim" scene.qlb -o a.ppm --clamp "$radiance"
done
expect another_curve_is_refused 1 'filmic' \
    "$sim" scene.qlb -o a.ppm --curve gamma
for stops in 64.1 -65 x ''; do
    expect "exposure_'$stops'_is_refused" 1 'from -64 to 64\|needs a value' \
        "$sim" scene.qlb -o a.ppm --exposure "$stops"
done
nothing_left wrong_usage_leaves_nothing

# Input
expect a_missing_scene_is_code_3 3 'none.qlb' "$sim" none.qlb -o a.ppm
expect a_folder_as_scene_is_code_3 3 'directory' "$sim" . -o a.ppm
: >empty.qlb
expect an_empty_scene_is_code_2 2 'empty.qlb' "$sim" empty.qlb -o a.ppm
echo 'not a scene but some text, long enough to be one: ............' >bad.qlb
cat bad.qlb bad.qlb >worse.qlb
expect text_as_scene_is_code_2 2 'byte 0:' "$sim" worse.qlb -o a.ppm
size=$(wc -c <scene.qlb)
ok=0
for cut in 1 3 4 40 95 96 200 $((size / 2)) $((size - 1)); do
    head -c "$cut" scene.qlb >cut.qlb
    "$sim" cut.qlb -o a.ppm >out.txt 2>err.txt
    [ $? -eq 2 ] && grep -q cut.qlb err.txt || ok=1
done
say a_truncated_scene_is_code_2_at_any_length $ok
(head -c 300 scene.qlb; printf '????'; tail -c +305 scene.qlb) >flip.qlb
expect a_changed_scene_is_code_2 2 'CRC-32' "$sim" flip.qlb -o a.ppm
rm -f bad.qlb cut.qlb flip.qlb empty.qlb worse.qlb
nothing_left bad_input_leaves_nothing

# Output
expect a_folder_that_is_not_there_is_code_3 3 'none/a.ppm' \
    "$sim" scene.qlb -o none/a.ppm $small
mkdir folder.ppm
expect a_folder_as_output_is_code_3 3 'directory' \
    "$sim" scene.qlb -o folder.ppm $small
rmdir folder.ppm
ln -s /dev/full full.ppm
expect a_full_disk_is_code_3 3 'No space' "$sim" scene.qlb -o full.ppm $small
rm full.ppm
"$sim" scene.qlb --save-sums /dev/null --stats $small >/dev/full 2>err.txt
[ $? -eq 3 ]
say a_full_stdout_is_code_3 $?
(
    ulimit -f 1
    exec "$sim" scene.qlb -o big.ppm --size 64x64 --spp 1 --quiet 2>err.txt
)
[ $? -eq 3 ] && grep -q big.ppm err.txt
say a_file_too_large_is_code_3 $?
(
    ulimit -f 1
    exec "$sim" scene.qlb --save-sums big.qls --size 64x64 --spp 1 --quiet \
        2>err.txt
)
[ $? -eq 3 ] && grep -q big.qls err.txt
say sums_too_large_are_code_3 $?
nothing_left a_failed_write_leaves_nothing
echo precious >keep.ppm
"$sim" scene.qlb -o keep.ppm $small && head -c 2 keep.ppm | grep -q P6
say a_finished_render_replaces_it $?
echo old >kept.ppm
chmod 640 kept.ppm
ln -s kept.ppm keep.png.ppm
"$sim" scene.qlb -o keep.png.ppm $small && [ -L keep.png.ppm ] &&
    cmp -s kept.ppm keep.ppm
say a_link_goes_on_leading_to_what_is_written $?
[ "$(ls -l kept.ppm | cut -c 1-10)" = -rw-r----- ]
say what_is_written_again_keeps_its_permissions $?
rm keep.ppm kept.ppm keep.png.ppm
nothing_left a_render_leaves_nothing_else

# The same bits
same() { # claim, files
    claim=$1
    shift
    first=$1 ok=0
    shift
    for f in "$@"; do
        cmp -s "$first" "$f" || ok=1
    done
    say "$claim" $ok
}
for t in 1 2 7; do
    "$sim" scene.qlb -o t$t.ppm --save-sums t$t.qls $small --threads $t
done
same threads_change_no_bit_of_the_picture t1.ppm t2.ppm t7.ppm
same threads_change_no_bit_of_the_sums t1.qls t2.qls t7.qls
for kind in ppm pfm png; do
    "$sim" scene.qlb -o whole.$kind $small
done
same a_second_run_gives_the_same_picture t1.ppm whole.ppm
"$sim" scene.qlb -o dark.ppm $small --direct none --indirect none
! cmp -s dark.ppm whole.ppm
say direct_none_indirect_none_shows_only_emitters $?

ends="--size 20x14 --spp 256 --error 0.2 --quiet"
for t in 1 2 7; do
    "$sim" scene.qlb -o e$t.ppm --samples-map m$t.pfm $ends --threads $t
done
same threads_change_no_bit_of_pixels_that_end_by_themselves e1.ppm e2.ppm e7.ppm
same threads_change_no_pixels_number_of_samples m1.pfm m2.pfm m7.pfm
"$sim" scene.qlb -o some.ppm $ends --rows 5:6
head=$(($(wc -c <e1.ppm) - 20 * 14 * 3))
tail -c +$((head + 1 + 300)) e1.ppm | head -c 60 >a.txt
tail -c +$((head + 1 + 300)) some.ppm | head -c 60 >b.txt
cmp -s a.txt b.txt
say rows_change_no_bit_of_pixels_that_end_by_themselves $?
"$sim" scene.qlb -o off.ppm $small --error 0
same error_0_is_off whole.ppm off.ppm
"$sim" scene.qlb -o few.ppm $small --error 0.9
same fewer_samples_than_the_least_are_all_taken whole.ppm few.ppm
rm -f some.ppm off.ppm few.ppm e?.ppm m?.pfm

n=0
for r in 0:5 5:6 6:14; do
    for s in 3:8 0:1 1:3; do
        n=$((n + 1))
        "$sim" scene.qlb --save-sums part$n.qls $small --rows $r --samples $s
    done
done
for kind in ppm pfm png; do
    "$merge" part*.qls -o merged.$kind --save-sums merged.qls
    same "parts_merge_to_the_same_$kind" whole.$kind merged.$kind
done
same parts_merge_to_the_same_sums t1.qls merged.qls
"$merge" part9.qls part1.qls part5.qls --quiet --save-sums odd.qls
"$merge" part8.qls part2.qls part3.qls part4.qls part6.qls part7.qls --quiet \
    --save-sums even.qls
"$merge" even.qls odd.qls --save-sums again.qls
same sums_of_sums_merge_in_any_order t1.qls again.qls
"$merge" t1.qls -o gray.png --format gray4
"$sim" scene.qlb -o gray2.png --format gray4 $small
same merge_and_sim_agree_on_display_formats gray.png gray2.png
# Stops of the scene and stops of the picture add up.
sed 's/^exposure .*/exposure -0.25/' "$root/tests/scenes/cornell.scene" \
    >darker.scene && cp "$root/tests/scenes/cornell.obj" \
    "$root/tests/scenes/cornell.mtl" . 2>/dev/null
"$build/qlux-scene" darker.scene --direct area -o darker.qlb --quiet >out.txt &&
    "$sim" scene.qlb -o plain.ppm --save-sums plain.qls $small &&
    "$sim" darker.qlb -o brighter.ppm $small --exposure 1.25
same stops_add_up_to_those_of_the_scene plain.ppm brighter.ppm
"$sim" scene.qlb -o darker.ppm --save-sums darker.qls $small --exposure -3.3
same exposure_changes_no_sum plain.qls darker.qls
"$merge" plain.qls -o darker2.ppm --exposure -3.3 --quiet
same merge_and_sim_agree_on_exposures darker.ppm darker2.ppm
! cmp -s plain.ppm darker.ppm
say exposure_changes_the_picture $?
"$sim" scene.qlb -o straight.ppm $small --curve srgb
same srgb_is_the_curve_of_a_picture plain.ppm straight.ppm
for curve in filmic reinhard; do
    "$sim" scene.qlb -o $curve.ppm $small --curve $curve
    "$merge" plain.qls -o straight.ppm --curve $curve --quiet
    same "merge_and_sim_agree_on_the_curve_$curve" $curve.ppm straight.ppm
done
! cmp -s plain.ppm filmic.ppm && ! cmp -s filmic.ppm reinhard.ppm
say curves_change_the_picture $?
rm -f straight.ppm filmic.ppm reinhard.ppm

# What auto meters is told, and the same whatever else differs.
"$sim" scene.qlb -o auto.ppm $small --exposure auto --stats >stats.txt
stops=$(sed -n 's/^exposure: //p' stats.txt)
"$sim" scene.qlb -o stops.ppm $small --exposure "$stops"
same the_metered_exposure_is_told auto.ppm stops.ppm
! cmp -s auto.ppm plain.ppm
say metering_changes_the_picture $? "$stops stops"
"$sim" darker.qlb -o stops.ppm $small --exposure auto
same the_exposure_of_the_scene_does_not_count auto.ppm stops.ppm
"$merge" plain.qls -o stops.ppm --exposure auto
same merge_and_sim_agree_on_what_is_metered auto.ppm stops.ppm
"$sim" scene.qlb -o stops.ppm --size 20x14 --seed 3 --quiet --spp 2 --rows 3:9 \
    --threads 3 --exposure auto --stats >stats.txt
grep -qx "exposure: $stops" stats.txt
say rows_threads_and_samples_do_not_change_it $?
rm -f auto.ppm stops.ppm stats.txt

# What is cut off is the difference of the means, and goes with the sums.
"$sim" scene.qlb -o plain.pfm $small
"$sim" scene.qlb -o cut.pfm --save-sums cut.qls $small --clamp 0.25 --stats \
    >stats.txt
"$build/qlux-diff" cut.pfm plain.pfm >out.txt
awk '{ is[$1] = $2 } END { b = is["bias:"]; d = is["clamp-bias:"] - b
    exit !(b < -1e-3 && d * d < 1e-12) }' stats.txt out.txt
say the_bias_of_a_clamp_is_told $? "$(grep bias: stats.txt)"
for samples in 0:3 3:8; do
    "$sim" scene.qlb --save-sums cut${samples%:*}.qls --size 20x14 --spp 8 \
        --seed 3 --quiet --clamp 0.25 --samples $samples
done
"$merge" cut0.qls cut3.qls --save-sums cuts.qls
same what_is_cut_off_adds_up cut.qls cuts.qls
"$sim" scene.qlb -o cut.pfm $small --clamp 0.25 --resume cut0.qls --stats |
    grep '^clamp-bias' >out.txt
grep '^clamp-bias' stats.txt | cmp -s - out.txt
say it_is_kept_by_a_run_that_goes_on $?
"$sim" scene.qlb -o cut.pfm $small --clamp 1000 --stats >stats.txt
grep -qx 'clamp-bias: 0' stats.txt && cmp -s cut.pfm plain.pfm
say a_limit_that_nothing_reaches_changes_nothing $?
# The lamp alone: what the camera sees itself is not cut.
"$sim" scene.qlb -o plain.pfm $small --direct none
"$sim" scene.qlb -o cut.pfm $small --direct none --clamp 0.01
same what_the_camera_sees_is_not_cut plain.pfm cut.pfm
rm -f cut* plain.pfm stats.txt
rm -f darker* plain.* brighter.ppm cornell.obj cornell.mtl

# A picture that shows nothing says which exposure would.
"$sim" scene.qlb -o a.ppm $small 2>err.txt && [ ! -s err.txt ]
say a_picture_that_shows_something_needs_no_word $?
# What is cut to white otherwise is below the white of a curve.
"$sim" scene.qlb -o a.ppm $small --exposure 12 --curve filmic 2>err.txt &&
    [ ! -s err.txt ] && "$sim" scene.qlb -o a.ppm $small --exposure 12 \
    2>err.txt && grep -q 'picture is white' err.txt
say a_curve_has_a_white_of_its_own $?
for stops in -18 18; do
    shade=$([ $stops -lt 0 ] && echo black || echo white)
    "$sim" scene.qlb -o a.ppm $small --exposure $stops 2>err.txt
    would=$(sed -n "s/^qlux-sim: warning: the picture is $shade; $(
        )--exposure \(.*\) would do$/\1/p" err.txt)
    "$sim" scene.qlb -o a.ppm $small --exposure "$would" 2>err.txt &&
        [ ! -s err.txt ]
    say "a_picture_all_${shade}_says_which_exposure_would_do" $? "$would"
done
sed 's/^Ke .*/Ke 0 0 0/' "$root/tests/scenes/cornell.mtl" >cornell.mtl &&
    cp "$root/tests/scenes/cornell.obj" "$root/tests/scenes/cornell.scene" . &&
    "$build/qlux-scene" cornell.scene --direct area -o dark.qlb --quiet \
        >out.txt 2>&1 &&
    "$sim" dark.qlb -o a.ppm $small 2>err.txt && [ "$(cat err.txt)" = \
    'qlux-sim: warning: the picture is black: no light reaches the camera' ]
say a_picture_without_light_says_so $?
rm -f cornell.* dark.qlb a.ppm

"$sim" scene.qlb -o rows.ppm $small --rows 5:6
head=$(($(wc -c <whole.ppm) - 20 * 14 * 3))
tail -c +$((head + 1 + 300)) whole.ppm | head -c 60 >a.txt
tail -c +$((head + 1 + 300)) rows.ppm | head -c 60 >b.txt
tail -c +$((head + 1)) rows.ppm | head -c 300 | tr -d '\0' >c.txt
tail -c +$((head + 1 + 360)) rows.ppm | tr -d '\0' >>c.txt
cmp -s a.txt b.txt && [ ! -s c.txt ]
say rows_outside_the_range_are_black $?
"$sim" scene.qlb -o s.pfm --size 20x14 --seed 3 --quiet --samples 0:8
same samples_alone_set_spp whole.pfm s.pfm

# Parts that do not fit
for other in '--seed 4' '--bounces 1' '--sampler random' '--direct none' \
    '--indirect none' '--size 14x20' --roulette '--light-samples 2' \
    '--lights all'; do
    "$sim" scene.qlb --save-sums other.qls $small --samples 0:1 $other
    expect "merge_refuses_another${other%% *}" 2 'other.qls: its' \
        "$merge" part1.qls other.qls -o no.ppm
done
if [ -x "$sim-draft" ]; then
    "$sim-draft" scene.qlb --save-sums other.qls $small
    expect merge_refuses_another_precision 2 'is draft, but fine' \
        "$merge" part1.qls other.qls -o no.ppm
fi
expect merge_refuses_a_sample_counted_twice 2 'counted before' \
    "$merge" part1.qls part2.qls part1.qls -o no.ppm
"$sim" scene.qlb --save-sums other.qls $small --rows 4:6 --samples 7:8
expect merge_refuses_an_overlap 2 'counted before' \
    "$merge" part1.qls other.qls -o no.ppm
expect merge_warns_of_missing_rows 0 \
    '9 of 14 rows are missing, the first is row 5$' \
    "$merge" part1.qls -o some.ppm
expect merge_warns_of_uneven_samples 0 'from 1 to 5 samples' \
    "$merge" part1.qls part5.qls part8.qls -o some.ppm
expect merge_without_parts_is_code_1 1 'missing A.qls' "$merge" -o no.ppm
expect merge_without_output_is_code_1 1 'missing -o FILE or --save-sums' \
    "$merge" t1.qls
expect merge_of_a_missing_file_is_code_3 3 'none.qls' \
    "$merge" none.qls -o no.ppm
head -c 500 t1.qls >cut.qls
expect merge_of_a_cut_file_is_code_2 2 'cut.qls: byte' \
    "$merge" cut.qls -o no.ppm
expect merge_of_a_picture_is_code_2 2 'this is a PPM picture' \
    "$merge" t1.ppm -o no.ppm
[ ! -e no.ppm ] && [ "$(ls ./*.tmp 2>/dev/null | wc -l)" -eq 0 ]
say a_failed_merge_leaves_nothing $?

# Settings that change nothing say so and change no bit; the same settings where
# they have an effect are silent.
dot="scene.qlb --size 6x6 --spp 2 --seed 3 --quiet"
while IFS='|' read -r where idle; do
    "$sim" $dot $where -o without.pfm
    "$sim" $dot $where $idle -o with.pfm 2>err.txt
    cmp -s without.pfm with.pfm && [ "$(wc -l <err.txt)" -eq 1 ] &&
        grep -q -- "warning: '$idle' has no effect with '$where'" err.txt ||
        echo "$idle $where: $(cat err.txt)"
    "$sim" $dot $idle -o with.pfm >err.txt 2>&1
    [ ! -s err.txt ] || echo "$idle alone: $(cat err.txt)"
done >idle.txt <<'END'
--direct hemisphere|--lights all
--direct cosine|--lights uniform
--direct none|--lights all
--direct none|--light-samples 2
--bounces 0|--indirect uniform
--bounces 0|--roulette
--indirect none|--bounces 2
--indirect none|--roulette
END
[ ! -s idle.txt ]
say settings_without_effect_say_so $? "$(head -n 1 idle.txt)"
"$sim" $dot --direct cosine -o without.pfm &&
    "$sim" $dot --direct cosine --light-samples 2 -o with.pfm >err.txt 2>&1
! cmp -s without.pfm with.pfm && [ ! -s err.txt ]
say n_directions_have_an_effect $?

# Numbers
"$sim" scene.qlb --save-sums n.qls $small --stats >stats.txt
grep -q '^paths: [1-9]' stats.txt && [ "$(grep -c ': ' stats.txt)" -eq 10 ]
say stats_are_eight_figures_and_the_way_of_finding_light $?
# One ray from the eye, one to the lamp, a path; times a weight that a dump was
# given all three channels of all sixteen are cut.
"$build/qlux-scene" "$root/tests/scenes/square.scene" \
    --direct area -o square.qlb --quiet
"$build/qlux-scene" --dump square.qlb >square.txt
sed 's/^\(l .*\) -33 /\1 -10 /' square.txt >cut.txt
"$build/qlux-scene" cut.txt -o cut.qlb --quiet
one="--size 4x4 --spp 1 --bounces 0 --direct area --quiet"
# stats SCENE PROGRAM PRECISION SATURATED: every line
stats() {
    "$build/$2" "$1" -o n.pfm $one --stats >stats.txt 2>err.txt
    sed 's/^seconds: [0-9]*\.[0-9][0-9][0-9]$/seconds: S/' stats.txt >out.txt
    { printf '%s\n' 'paths: 16' 'closest-rays: 16' 'shadow-rays: 16' \
        'rays-per-path: 2.000'
      [ -z "$4" ] || printf '%s\n' "saturated: $4" 'faint: 0'
      printf '%s\n' 'seconds: S' "precision: $3" 'direct: area' \
        'lights: power'; } | cmp -s - out.txt &&
        [ ! -s err.txt ]
    say "$2_says_each_figure_of_$1" $?
}
stats square.qlb qlux-sim fine 0
stats square.qlb qlux-sim-draft draft 0
stats square.qlb qlux-ref double ''
stats cut.qlb qlux-sim fine 48
stats cut.qlb qlux-sim-draft draft 48
"$sim" cut.qlb -o n.pfm $one >out.txt 2>err.txt
[ $? -eq 0 ] && [ ! -s out.txt ] && [ "$(cat err.txt)" = \
    'qlux-sim: warning: 48 contributions were cut at their limit' ]
say contributions_that_are_cut_are_a_warning $?
"$sim" square.qlb -o n.pfm $one >out.txt 2>err.txt
[ $? -eq 0 ] && [ ! -s out.txt ] && [ ! -s err.txt ]
say without_them_nothing_is_said $?
# What a scene says of auto is what is rendered, saved and said: mis by all.
sed 's/^auto .*/auto 5 1/' square.txt >auto.txt
"$build/qlux-scene" auto.txt -o auto.qlb --quiet
for renderer in qlux-sim qlux-sim-draft qlux-ref; do
    "$build/$renderer" auto.qlb -o auto.pfm $small --stats >stats.txt &&
        "$build/$renderer" auto.qlb -o named.pfm $small --direct mis \
            --lights all &&
        "$build/$renderer" auto.qlb -o other.pfm $small --direct area \
            --lights power && cmp -s auto.pfm named.pfm &&
        ! cmp -s auto.pfm other.pfm &&
        [ "$(tail -n 2 stats.txt | paste -s -)" = 'direct: mis	lights: all' ]
    say "auto_of_${renderer}_is_what_the_scene_says" $?
done
"$sim" auto.qlb --save-sums auto.qls $small --samples 0:3 &&
    "$sim" auto.qlb --save-sums named.qls $small --samples 3:8 --direct mis \
        --lights all && "$build/qlux-merge" auto.qls named.qls -o merged.pfm &&
    "$sim" auto.qlb -o whole.pfm $small --spp 8 && cmp -s merged.pfm whole.pfm
say parts_of_auto_and_by_name_are_one_picture $?
# In a closed room of white walls every path has all of its rays.
"$build/qlux-scene" "$root/tests/scenes/furnace.scene" \
    --direct area -o room.qlb --quiet
"$sim" room.qlb -o n.ppm $small --direct none --bounces 3 --stats |
    head -n 4 >stats.txt
[ "$(tr '\n' ' ' <stats.txt)" = "paths: 2240 closest-rays: 8960 \
shadow-rays: 0 rays-per-path: 4.000 " ]
say a_path_of_three_reflections_has_four_rays $?
"$sim" scene.qlb -o n.ppm $small --stats | awk '
    /^(paths|closest-rays|shadow-rays|rays-per-path): /{ n[$1] = $2 }
    END { p = n["paths:"]; c = n["closest-rays:"]; s = n["shadow-rays:"]
        exit !(c > p && s > 0 && s != c && p > 0 && p <= 2240 &&
            n["rays-per-path:"] == sprintf("%.3f", (c + s) / p)) }'
say rays_of_a_path_are_both_kinds $?
# A camera whose rays begin further away than numbers reach.
sed 's/^pr 0x0*/pr 0x3fffffff/' square.txt >far.txt
"$build/qlux-scene" far.txt -o far.qlb --quiet &&
    "$sim" far.qlb -o no.ppm $one >out.txt 2>err.txt
[ $? -eq 1 ] && [ ! -e no.ppm ] && [ "$(cat err.txt)" = \
    'qlux-sim: a render setting is out of range (see --help)' ]
say a_bad_setting_is_named $?

"$sim" scene.qlb -o n.ppm --size 20x14 --spp 256 --error 0.2 --quiet --stats \
    >stats.txt
awk '/^paths: /{p = $2} /^samples-per-pixel: /{s = $2}
    END {exit !(s >= 32 && s < 256 && p > 0 && p <= s * 280 + 1)}' stats.txt
say stats_tell_the_mean_number_of_samples $?
"$sim" scene.qlb -o n.ppm --size 20x14 --spp 64 --error 0.00001 --quiet \
    --rows 5:6 --stats >stats.txt
grep -q '^samples-per-pixel: 64.000$' stats.txt
say stats_are_of_the_rows_that_were_rendered $?
for f in rgb888 rgb565le rgb565be gray8 gray4; do
    "$sim" scene.qlb -o $f.ppm --format $f $small || failures=$((failures + 1))
done
same default_format_is_rgb888 whole.ppm rgb888.ppm
same byte_order_shows_the_same_picture rgb565le.ppm rgb565be.ppm
! cmp -s rgb888.ppm rgb565le.ppm && ! cmp -s gray8.ppm gray4.ppm
say formats_differ_otherwise $?

# Stopped by a signal, and gone on with to the bits of one run.
whole="--size 64x48 --spp 200 --quiet"
"$sim" scene.qlb -o whole.ppm --save-sums whole.qls $whole

# begin FILES ARGUMENT...: start a render and wait until its files are open.
begin() {
    files=$1
    shift
    "$sim" scene.qlb "$@" 2>err.txt &
    child=$!
    until [ "$(ls ./*.tmp 2>/dev/null | wc -l)" -eq "$files" ] ||
            ! kill -0 $child 2>/dev/null; do
        sleep 0.1
    done
}
go_on=' of 200 samples a pixel; go on with --resume part.ppm.qls$'
for signal in INT TERM; do
    rm -f part.ppm
    begin 1 -o part.ppm $whole --threads 1 --progressive
    until [ -s part.ppm ] || ! kill -0 $child 2>/dev/null; do
        sleep 0.02
    done
    kill -$signal $child
    wait $child
    [ $? -eq 3 ] && grep -q "$go_on" err.txt && [ -s part.ppm ]
    say "a_sig$(echo $signal | tr A-Z a-z)_leaves_what_there_is" $?
    "$sim" scene.qlb -o part.ppm --save-sums part.qls $whole \
        --resume part.ppm.qls && cmp -s part.ppm whole.ppm &&
        cmp -s part.qls whole.qls
    say "after_a_sig$(echo $signal | tr A-Z a-z)_it_ends_with_the_same_bits" $?
done
"$merge" part.ppm.qls -o part.png --quiet && [ -s part.png ]
say an_interrupted_runs_sums_are_a_part $?
"$sim" scene.qlb -o part.ppm $whole --rows 20:40 --save-sums rows.qls &&
    "$sim" scene.qlb -o part.ppm $whole --resume rows.qls --threads 1 &&
    cmp -s part.ppm whole.ppm
say rows_are_gone_on_with $?
"$sim" scene.qlb -o part.ppm $whole --samples 100:150 --save-sums some.qls &&
    "$sim" scene.qlb --save-sums part.qls $whole --resume some.qls &&
    cmp -s part.qls whole.qls
say samples_are_gone_on_with $?
"$sim" scene.qlb -o part.ppm $whole --resume whole.qls && cmp -s part.ppm \
    whole.ppm
say a_complete_run_is_written_again $?
expect another_seed_is_not_gone_on_with 2 'whole.qls: its seed is 0, but 1' \
    "$sim" scene.qlb -o a.ppm $whole --resume whole.qls --seed 1
expect other_samples_are_refused 2 'samples 0:200 are not of this run' \
    "$sim" scene.qlb -o a.ppm $whole --spp 199 --resume whole.qls
expect other_rows_are_refused 2 'rows 0:48 samples 0:200 are not of' \
    "$sim" scene.qlb -o a.ppm $whole --rows 1:48 --resume whole.qls
head -c 1000 whole.qls >cut.qls
expect a_damaged_file_is_not_gone_on_with 2 'cut.qls: byte' \
    "$sim" scene.qlb -o a.ppm $whole --resume cut.qls
expect a_file_that_is_missing_is_code_3 3 'cannot read no.qls' \
    "$sim" scene.qlb -o a.ppm $whole --resume no.qls
for option in '--resume whole.qls' --progressive; do
    expect "error_with_${option%% *}_is_refused" 1 "'--error' goes with none" \
        "$sim" scene.qlb -o a.ppm --error 0.1 $option
done
expect progress_needs_a_name 1 "'--progressive' needs '-o' with a name" \
    "$sim" scene.qlb -o - --progressive
expect progress_needs_a_picture 1 "'--progressive' needs '-o' with a name" \
    "$sim" scene.qlb --save-sums a.qls --progressive

# Before the first row is finished nothing is there to be written. A row of
# 16,384 pixels, each with 255 samples of the light, takes seconds.
echo precious >keep.ppm
long="--size 16384x16384 --rows 8192:8193 --light-samples 255"
begin 2 -o keep.ppm --save-sums keep.qls $long
kill -INT $child
wait $child
[ $? -eq 3 ] && [ "$(cat keep.ppm)" = precious ] && [ ! -e keep.qls ] &&
    [ "$(cat err.txt)" = 'qlux-sim: interrupted; nothing was written' ]
say a_render_stopped_at_once_keeps_the_old_file $?
# One pixel that ends by itself: the second signal does not wait for it.
begin 1 -o keep.ppm --size 1x1 --spp 16777216 --error 0.00001
kill -INT $child
sleep 0.1
kill -INT $child
wait $child
[ $? -eq 3 ] && [ "$(cat keep.ppm)" = precious ] &&
    [ "$(cat err.txt)" = 'qlux-sim: interrupted' ] &&
    [ "$(ls ./*.tmp 2>/dev/null | wc -l)" -eq 0 ]
say a_second_signal_ends_it_at_once $?

# The picture is renewed while it is rendered, and is the same in the end.
begin 1 -o seen.ppm $whole --size 300x200 --progressive --threads 1
until [ -s seen.ppm ] || ! kill -0 $child 2>/dev/null; do
    sleep 0.02
done
cp seen.ppm first.ppm
kill -0 $child 2>/dev/null
running=$?
kill -INT $child
wait $child
[ $running -eq 0 ] && [ "$(head -n 2 first.ppm | tail -n 1)" = '300 200' ] &&
    ! cmp -s first.ppm seen.ppm
say the_picture_is_renewed_while_it_is_rendered $?
"$sim" scene.qlb -o seen.ppm $whole --progressive && cmp -s seen.ppm whole.ppm
say a_renewed_picture_ends_with_the_same_bits $?
rm -f keep.ppm whole.* part.* rows.qls some.qls cut.qls seen.* first.ppm

exit $((failures != 0))
