#!/bin/sh
# test_warp.sh - qlux-warp: its list, its pictures, its verdicts, exit codes
# SPDX-License-Identifier: MIT
#
# Usage: tests/tools/test_warp.sh [BUILD]
# Example: tests/tools/test_warp.sh build

suite=tools/test_warp
. tests/support/workspace.sh
warp=$build/qlux-warp
plots=$root/tools/warp/plots

# Every tag of an SVG is closed, in order, and every number is one. In: the
# file. Attributes hold no < or >.
well_formed() {
    grep -q 'nan\|inf"' "$1" && return 1
    tr '\n' ' ' <"$1" | sed 's/</\n</g' | awk '
        /^<\// {
            name = $0; sub(/^<\//, "", name); sub(/>.*/, "", name)
            if (depth == 0 || open[depth--] != name) bad = 1
            next
        }
        /^</ {
            tag = $0; sub(/>.*/, "", tag)
            if (tag == $0 || gsub(/"/, "\"", tag) % 2 != 0) bad = 1
            if (tag ~ /\/$/) next
            name = substr(tag, 2); sub(/[ ].*/, "", name)
            open[++depth] = name; opened++
        }
        END { exit bad || depth != 0 || opened < 5 }'
}

names="naive-hemisphere uniform-hemisphere uniform-sphere cosine-hemisphere
    cosine-power uniform-cone uniform-disk uniform-triangle spherical-triangle
    tent cosine-textbook discrete alias table-1d table-2d table-3d"

# Usage
expect no_command_is_code_1 1 'missing COMMAND' "$warp"
expect an_unknown_command_is_code_1 1 "'draw': expected list, plot or test" \
    "$warp" draw
expect an_unknown_warp_is_code_1 1 "'cube': expected a warp" \
    "$warp" plot cube -o a.svg
expect a_plot_without_a_warp_is_code_1 1 'missing WARP' "$warp" plot -o a.svg
expect a_plot_without_a_file_is_code_1 1 'missing -o FILE' "$warp" plot tent
expect a_test_with_a_file_is_code_1 1 "'test' goes without '-o'" \
    "$warp" test tent -o a.svg
expect a_plot_as_pfm_is_code_1 1 '.svg, .png or .ppm' \
    "$warp" plot tent -o a.pfm
expect a_plot_of_no_kind_is_code_1 1 'a.gif' "$warp" plot tent -o a.gif
expect no_samples_are_code_1 1 '1 to 65536' \
    "$warp" plot tent --samples 0 -o a.svg
expect more_than_the_most_samples_are_code_1 1 '65537' \
    "$warp" plot tent --samples 65537 -o a.svg
for m in -1 65536 nan x 1x ''; do
    expect "an_exponent_of_'$m'_is_code_1" 1 '0 to 65535' \
        "$warp" plot cosine-power -m "$m" -o a.svg
done
expect an_exponent_of_another_warp_is_code_1 1 'for cosine-power, not tent' \
    "$warp" test tent -m 2
expect a_list_of_so_many_samples_is_code_1 1 "'list' goes without '--samples'" \
    "$warp" list --samples 64
expect a_list_of_one_warp_is_code_1 1 "unexpected argument 'tent'" \
    "$warp" list tent
[ "$(ls | grep -v -e '^out.txt$' | wc -l)" -eq 0 ]
say refused_commands_write_nothing $?

# List
"$warp" list >list.txt
[ "$(awk '{ print $1 }' list.txt | tr '\n' ' ')" = "$(echo $names) " ]
say the_list_names_every_warp_in_order $?
for item in 'uniform-triangle.*(18)' 'uniform-sphere.*(33)' \
    'uniform-hemisphere.*(34)' 'cosine-hemisphere.*(35)' \
    'cosine-power.*(36)'; do
    grep -q -- "$item" list.txt || echo "$item" >>missing.txt
done
[ ! -e missing.txt ]
say the_list_cites_the_compendium $?
[ "$(grep -c 'per sr\|per area\|per entry\|per length\|per volume' list.txt)" \
    -eq 16 ]
say every_density_has_its_measure $?

# Every warp that the renderer calls is listed: qlux-warp calls it too.
# In: sources. Comments are left out.
unlisted() {
    for name in $(cat "$@" | sed 's|/\*.*||; /^ \*/d' |
        grep -oE 'ql_(warp_[a-z_0-9]+|table_sample|cdf_sample)\(' | sort -u); do
        grep -qF "$name" "$root"/tools/warp/*.c || echo "$name"
    done
}
sources=$(find "$root"/firmware/scene "$root"/firmware/material \
    "$root"/firmware/light -name '*.[ch]')
# shellcheck disable=SC2086  # names of files, without blanks
[ "$(cat $sources | grep -c 'ql_warp_.*(')" -gt 5 ] &&
    [ -z "$(unlisted $sources | tee unlisted.txt)" ]
say "the_list_has_every_warp_of_the_renderer$(tr '\n' ' ' <unlisted.txt)" $?
echo '    v = ql_warp_unheard_of(u1, u2);' >call.c
[ "$(unlisted call.c)" = 'ql_warp_unheard_of(' ]
say a_warp_that_is_not_listed_would_be_noticed $?

# Tests
expect uniform_hemisphere_passes 0 'uniform-hemisphere .* 511 .* ok$' \
    "$warp" test uniform-hemisphere
expect naive_hemisphere_fails_as_it_should 0 'as uniform .*NOT UNIFORM' \
    "$warp" test naive-hemisphere
grep -q 'as uniform .* <1e-300 ' out.txt &&
    grep -q 'naive-hemisphere   *[0-9].* ok$' out.txt
say and_fits_its_own_density $?
expect a_power_is_tested_as_given 0 'm = 3.25 .* ok$' \
    "$warp" test cosine-power -m 3.25
grep -q 'counted copies against the core: the same bits' out.txt &&
    grep -q 'cos^3.25' out.txt
say its_cost_is_compared_with_a_table $?
expect a_table_fits_its_density 0 'table-3d .* ok$' "$warp" test table-3d
expect the_alias_table_is_exact 0 '16/16  ok$' "$warp" test alias
grep -q 'counted search against the core: the same entries' out.txt &&
    [ "$(awk '$1 ~ /^(4|16|64|256|1024|4096)$/ && NF == 8' out.txt |
        wc -l)" -eq 6 ]
say search_is_compared_with_alias_for_six_sizes $?
awk '$1 ~ /^(16|64|256|1024|4096)$/ && NF == 8 {
        if ($8 <= last || $4 <= steps) bad = 1; last = $8; steps = $4; n++ }
    END { exit bad || n != 5 }' out.txt
say alias_pays_off_later_for_larger_tables $?

# Plots: few samples, for they are tested, not looked at
bad=
for name in $names; do
    "$warp" plot "$name" --samples 64 -o "$name.svg" &&
        well_formed "$name.svg" || bad="$bad $name"
done
[ -z "$bad" ]
say "every_svg_is_well_formed$bad" $?
sed 's/<\/svg>//' tent.svg >broken.svg
well_formed broken.svg
[ $? -ne 0 ]
say an_svg_that_is_cut_would_be_noticed $?
"$warp" plot uniform-disk --samples 64 -o a.png &&
    "$warp" plot uniform-disk --samples 64 -o a.ppm
expect the_png_holds_what_the_ppm_holds 0 'identical: yes' \
    "$build/qlux-diff" a.png a.ppm
head -c 15 a.ppm | grep -q '^1600 740$'
say a_plot_is_1600_by_740_pixels $?
[ "$(od -An -v -tu1 -w3 -j16 a.ppm | sort -u | wc -l)" -gt 200 ]
say it_has_many_colours $?
[ "$(od -An -v -tu1 -w3 -N4800 -j16 a.ppm | sort -u | tr -d ' \n')" = \
    255255255 ]
say its_margin_is_white $?
"$warp" plot uniform-disk --samples 64 -o b.png && cmp -s a.png b.png &&
    "$warp" plot tent --samples 64 -o b.svg && cmp -s tent.svg b.svg
say a_plot_is_the_same_bytes_again $?
"$warp" plot cosine-power -m 1 --samples 64 -o m1.svg &&
    "$warp" plot cosine-power -m 2 --samples 64 -o m2.svg &&
    ! cmp -s m1.svg m2.svg && grep -q 'm = 2<' m2.svg &&
    grep -q 'peak 0.4775 per sr' m2.svg
say a_plot_says_its_exponent_and_peak $?
# counted: dots are what is drawn by h0, twice each
[ "$(grep -o h0 tent.svg | wc -l)" -eq 128 ]
say every_sample_is_in_the_square_and_in_its_image $?

# What README.md shows is what the program draws
for m in 1 2 8 16; do
    "$warp" plot cosine-power -m $m -o shown.svg
    cmp -s shown.svg "$plots/cosine-power-$m.svg" || echo "$m" >>differs.txt
done
"$warp" plot naive-hemisphere -o shown.svg
cmp -s shown.svg "$plots/naive-hemisphere.svg" || echo naive >>differs.txt
[ ! -e differs.txt ]
say the_pictures_of_the_readme_are_up_to_date $?

# Nothing half-written
expect an_unwritable_folder_is_code_3 3 'cannot write none/a.svg' \
    "$warp" plot tent --samples 64 -o none/a.svg
ln -s /dev/full full.svg
expect a_full_disk_is_code_3 3 'No space' \
    "$warp" plot tent --samples 64 -o full.svg
[ "$(ls ./*.tmp 2>/dev/null | wc -l)" -eq 0 ]
say nothing_is_left_behind $?

exit $((failures != 0))
