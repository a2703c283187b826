#!/bin/sh
# test_diff.sh - qlux-diff: its numbers by hand, its exit codes, its picture
# SPDX-License-Identifier: MIT
#
# Letters are looked for in the shape that qlux-sheet gives them.
#
# Usage: tests/tools/test_diff.sh [BUILD]
# Example: tests/tools/test_diff.sh build

suite=tools/test_diff
. tests/support/workspace.sh
diff=$build/qlux-diff
sheet=$build/qlux-sheet

# Size of a PPM, and the bytes of its pixel X Y in hexadecimal.
size_of() {
    head -n 2 "$1" | tail -n 1
}
pixel() {
    w=$(size_of "$1")
    w=${w% *}
    tail -c +$(($(head -n 3 "$1" | wc -c) + 3 * ($2 + w * $3) + 1)) "$1" |
        head -c 3 | od -An -tx1 | tr -d ' \n'
}

# has_pixel CLAIM COLOUR X Y: of d.ppm
has_pixel() {
    [ "$(pixel d.ppm "$3" "$4")" = "$2" ]
    say "$1" $?
}

# inked FILE.ppm: its rows, # where a pixel has the colour of letters
inked() {
    w=$(size_of "$1")
    tail -n +4 "$1" | od -An -v -tx1 | tr -d ' \n' | fold -w $((6 * ${w% *})) |
        awk '{ s = ""
            for (i = 1; i < length($0); i += 6)
                s = s (substr($0, i, 6) == "18181c" ? "#" : ".")
            print s }'
}

# shows FILE.ppm TEXT: is this written in it, a blank before and after? A
# label's nine rows begin at row 12, six pixels after the blank; the sheet's
# margin of 8 follows.
shows() {
    "$sheet" -o text.ppm --text 1 "$2=dot.ppm" || return
    inked text.ppm | sed -n '13,21s/^..\(.*\)..$/\1/p' >text.txt
    inked "$1" | awk 'NR == FNR { text[NR] = $0; next }
        { row[FNR] = $0 }
        END {
            for (y = 1; y + 8 <= FNR; y++) {
                x = 0
                while (i = index(substr(row[y], x + 1), text[1])) {
                    x += i
                    for (k = 2; k <= 9; k++)
                        if (substr(row[y + k - 1], x, length(text[k])) != \
                            text[k]) break
                    if (k > 9) exit found = 1
                }
            }
            exit 0
        }' text.txt - && return 1
    return 0
}

# writes CLAIM TEXT: in d.ppm
writes() {
    shows d.ppm "$2"
    say "$1" $?
}

# repeat N OCTAL: so many bytes
repeat() {
    head -c "$1" /dev/zero | tr '\000' "\\$2"
}

# Two pixels. a: 10 20 30 40 50 60; b: 10 20 30 40 50 66, mean 36.
printf 'P6\n2 1\n255\n\012\024\036\050\062\074' >a.ppm
printf 'P6\n2 1\n255\n\012\024\036\050\062\102' >b.ppm
# The same as floats 1 and 2, and twice as large: 2 and 4, little-endian.
printf 'PF\n1 1\n-1.0\n\0\0\200\077\0\0\200\077\0\0\0\100' >one.pfm
printf 'PF\n1 1\n-1.0\n\0\0\0\100\0\0\0\100\0\0\200\100' >two.pfm
# one.pfm in the other byte order.
printf 'PF\n1 1\n1.0\n\077\200\0\0\077\200\0\0\100\0\0\0' >big.pfm
printf 'P6\n1 1\n255\nabc' >dot.ppm
printf 'PF\n1 1\n-1.0\n\0\0\300\177\0\0\200\077\0\0\0\100' >nan.pfm

expect one_picture_is_code_1 1 'missing B ' "$diff" a.ppm
expect the_help_tells_the_code_above_a_limit 0 'exit 4 if relmse' \
    "$diff" --help
expect a_limit_that_is_no_number_is_code_1 1 'max-relmse x' \
    "$diff" a.ppm b.ppm --max-relmse x
expect a_negative_limit_is_code_1 1 'max-bias -1' \
    "$diff" a.ppm b.ppm --max-bias -1
expect a_pfm_of_the_difference_is_code_1 1 '.ppm or .png' \
    "$diff" a.ppm b.ppm -o d.pfm
expect a_missing_picture_is_code_3 3 'none.ppm' "$diff" a.ppm none.ppm
head -c 12 a.ppm >cut.ppm
expect a_cut_picture_is_code_2 2 'cut.ppm: byte 11' "$diff" a.ppm cut.ppm
expect other_sizes_are_code_2 2 '1x1.*2x1' "$diff" one.pfm a.ppm
expect linear_against_display_is_code_2 2 'linear' "$diff" one.pfm dot.ppm

expect equal_pictures_are_identical 0 'identical: yes' "$diff" a.ppm a.ppm
expect equal_pictures_have_no_error 0 '^rmse: 0$' "$diff" a.ppm a.ppm
expect other_pictures_are_not_identical 0 'identical: no' "$diff" a.ppm b.ppm
# sqrt(36 / 6); 36 / (66^2 + 0.01 36^2) / 6; -6 / 216; 20 log10(255 / rmse)
expect rmse_is_right 0 '^rmse: 2.44948974$' "$diff" a.ppm b.ppm
expect relmse_is_right 0 '^relmse: 0.00137332454$' "$diff" a.ppm b.ppm
expect bias_is_right 0 '^bias: -0.0277777778$' "$diff" a.ppm b.ppm
expect psnr_is_right 0 '^psnr: 40.3492' "$diff" a.ppm b.ppm
expect max_is_right 0 '^max: 6$' "$diff" a.ppm b.ppm
# All halves: (1 + 1 + 4) / 3; bias (4 - 8) / 8
expect pfm_rmse_is_right 0 '^rmse: 1.41421356$' "$diff" one.pfm two.pfm
expect pfm_bias_is_right 0 '^bias: -0.5$' "$diff" one.pfm two.pfm
expect byte_orders_of_pfm_agree 0 'identical: yes' "$diff" one.pfm big.pfm

expect relmse_below_its_limit_is_code_0 0 relmse \
    "$diff" a.ppm b.ppm --max-relmse 0.0014
expect relmse_above_its_limit_is_code_4 4 relmse \
    "$diff" a.ppm b.ppm --max-relmse 0.0013
expect bias_below_its_limit_is_code_0 0 bias \
    "$diff" a.ppm b.ppm --max-bias 0.03
expect bias_above_its_limit_is_code_4 4 bias \
    "$diff" a.ppm b.ppm --max-bias 0.02
expect a_nan_makes_psnr_a_nan 0 '^psnr: -*nan$' "$diff" nan.pfm two.pfm
expect a_nan_makes_max_a_nan 0 '^max: -*nan$' "$diff" nan.pfm two.pfm
expect a_nan_is_above_every_limit 4 nan \
    "$diff" nan.pfm two.pfm --max-relmse 1e30

# The figures have the same names and order with a picture and without.
"$diff" a.ppm b.ppm >figures.txt && "$diff" a.ppm b.ppm -o d.ppm >out.txt &&
    head -n 6 out.txt | cmp -s - figures.txt
say a_picture_changes_no_figure $?
"$diff" a.ppm b.ppm -o d.ppm >out.txt && "$diff" a.ppm b.ppm -o d.png >out.txt
say a_picture_of_the_difference_is_written $?
expect its_ppm_and_png_agree 0 'identical: yes' "$diff" d.ppm d.png

# ---- Signs and colours: the picture begins at 8 8

blue=034fbc white=ffffff red=a7031a black=000000
has_pixel equal_is_white $white 8 8
has_pixel lower_is_blue $blue 9 8
"$diff" b.ppm a.ppm -o d.ppm >out.txt
has_pixel higher_is_red $red 9 8
# One brighter and one darker pixel in a field of 64 x 64, at 10 20 and 40 50.
(printf 'P6\n64 64\n255\n' && repeat 12288 144) >flat.ppm
{
    printf 'P6\n64 64\n255\n'
    repeat $((3 * (20 * 64 + 10))) 144
    printf '\156\156\156'
    repeat $((3 * (50 * 64 + 40 - 20 * 64 - 10 - 1))) 144
    printf '\132\132\132'
    repeat $((3 * (13 * 64 + 23))) 144
} >planted.ppm
expect planted_pixels_are_found 0 '^max: 10$' \
    "$diff" planted.ppm flat.ppm -o d.ppm
has_pixel the_planted_brighter_pixel_is_red $red 18 28
has_pixel the_planted_darker_pixel_is_blue $blue 48 58
has_pixel its_neighbour_is_white $white 19 28
"$diff" planted.ppm flat.ppm -o d.ppm --zoom 3 >out.txt
has_pixel zoom_begins_a_pixel_at_its_multiple $red 38 68
has_pixel zoom_ends_it_before_the_next $red 40 70
has_pixel zoom_enlarges_no_neighbour $white 41 70
# The bar below: its ends are the full colours, its middle is white.
"$diff" planted.ppm flat.ppm -o d.ppm >out.txt
end=$(($(size_of d.ppm | cut -d ' ' -f 1) - 9))
has_pixel the_bar_begins_blue $blue 8 80
has_pixel the_bar_ends_red $red "$end" 80
has_pixel the_bar_is_white_in_the_middle $white $(((8 + end) / 2)) 80
# From the middle outwards green only falls, on both sides.
tail -n +4 d.ppm | tail -c +$((3 * (8 + (end + 9) * 80) + 1)) |
    head -c $((3 * (end - 7))) | od -An -v -tx1 | tr -d ' \n' | fold -w 6 |
    cut -c 3-4 | awk '{ v[NR] = $1 "" }
    END { for (i = 2; i <= NR; i++)
              if (i <= (NR + 1) / 2 ? v[i] < v[i - 1] : v[i] > v[i - 1]) bad = 1
          exit bad || NR < 200 || v[1] == v[2 * int(NR / 8)] }'
say the_bar_fades_to_its_middle $?

# ---- The scale and its numbers

writes the_bar_has_its_lower_number '-10'
writes the_bar_has_its_middle '0'
writes the_bar_has_its_upper_number '+10'
! { shows d.ppm '10' || shows d.ppm '+1'; }
say a_part_of_a_number_is_not_taken_for_it $?
writes the_legend_says_which_sign_is_which 'A is brighter'
writes the_legend_says_what_the_values_are 'A - B, 8-bit values'
writes the_legend_counts_what_is_beyond 'beyond the scale: 0 of 4096 pixels'
"$diff" planted.ppm flat.ppm -o d.ppm --scale 2.5 >out.txt
writes the_scale_option_sets_the_upper_number '+2.5'
writes the_scale_option_sets_the_lower_number '-2.5'
writes clipped_pixels_are_counted_in_the_legend \
    'beyond the scale: 2 of 4096 pixels'
has_pixel beyond_the_scale_is_the_full_colour $red 18 28
expect the_scale_is_printed 0 '^scale: 2.5$' \
    "$diff" planted.ppm flat.ppm -o d.ppm --scale 2.5
expect clipped_pixels_are_counted 0 '^clipped: 2$' \
    "$diff" planted.ppm flat.ppm -o d.ppm --scale 9.99
expect what_equals_the_scale_is_not_clipped 0 '^clipped: 0$' \
    "$diff" planted.ppm flat.ppm -o d.ppm --scale 10
"$diff" planted.ppm flat.ppm -o d.ppm --scale 20 >out.txt
[ "$(pixel d.ppm 18 28)" != $red ] && [ "$(pixel d.ppm 18 28)" != $white ]
say half_the_scale_is_a_paler_colour $?
full=$(pixel d.ppm 18 28)
"$diff" planted.ppm flat.ppm -o d.ppm --scale 1000 >out.txt
[ "$(pixel d.ppm 18 28)" \> "$full" ]
say a_larger_scale_makes_paler_colours $?

# Chosen for 4000 pixels that differ by 3, of which one, then five, by 200.
(printf 'P6\n80 50\n255\n' && repeat 12000 0) >zero.ppm
(printf 'P6\n80 50\n255\n\310\310\310' && repeat 11997 3) >one.ppm
(printf 'P6\n80 50\n255\n' && repeat 15 310 && repeat 11985 3) >five.ppm
expect one_pixel_of_4000_does_not_set_the_scale 0 '^scale: 5$' \
    "$diff" one.ppm zero.ppm -o d.ppm
expect it_is_clipped 0 '^clipped: 1$' "$diff" one.ppm zero.ppm -o d.ppm
expect five_pixels_of_4000_set_the_scale 0 '^scale: 200$' \
    "$diff" five.ppm zero.ppm -o d.ppm
expect they_are_not_clipped 0 '^clipped: 0$' "$diff" five.ppm zero.ppm -o d.ppm
expect few_differences_set_the_scale_all_the_same 0 '^scale: 10$' \
    "$diff" planted.ppm flat.ppm -o d.ppm
expect no_difference_has_a_scale_too 0 '^scale: 1$' \
    "$diff" a.ppm a.ppm -o d.ppm
# -6 in one channel of three
expect a_scale_is_of_the_mean_of_the_channels 0 '^scale: 2$' \
    "$diff" a.ppm b.ppm -o d.ppm
# (-1 - 1 - 2) / 3, rounded up
expect a_scale_is_1_2_or_5 0 '^scale: 2$' "$diff" one.pfm two.pfm -o d.ppm
writes linear_values_are_named 'A - B, linear radiance'

# -6 / sqrt(66^2 + 0.01 36^2) / 3 = -0.030
expect relative_differences_have_their_own_scale 0 '^scale: 0.05$' \
    "$diff" a.ppm b.ppm -o d.ppm --relative
writes relative_differences_are_named '(A - B) / sqrt(B^2 + 0.01 mean(B)^2)'
# -(0.49561 + 0.49561 + 0.49889) / 3 = -0.49670, with epsilon (4/15)^2
expect a_relative_difference_is_not_below_its_value 0 '^clipped: 1$' \
    "$diff" one.pfm two.pfm -o d.ppm --relative --scale 0.49669
expect a_relative_difference_is_not_above_its_value 0 '^clipped: 0$' \
    "$diff" one.pfm two.pfm -o d.ppm --relative --scale 0.49671
expect a_reference_of_zeros_has_relative_differences 0 '^undefined: 0$' \
    "$diff" zero.ppm zero.ppm -o d.ppm --relative

expect a_nan_is_counted 0 '^undefined: 1$' "$diff" nan.pfm two.pfm -o d.ppm
has_pixel a_nan_is_black $black 8 8
writes black_is_explained 'black, no number: 1 of 1 pixels'
printf 'PF\n1 1\n-1.0\n\0\0\200\177\0\0\200\077\0\0\0\100' >inf.pfm
expect an_infinite_difference_is_clipped 0 '^clipped: 1$' \
    "$diff" inf.pfm two.pfm -o d.ppm
has_pixel an_infinite_difference_has_its_sign $red 8 8
# Infinite and 2: one of two cannot be within any scale.
printf 'PF\n2 1\n-1.0\n' >half.pfm
printf '\0\0\200\177\0\0\200\077\0\0\0\100' >>half.pfm
printf '\0\0\0\100\0\0\0\100\0\0\0\100' >>half.pfm
printf 'PF\n2 1\n-1.0\n' >none.pfm
repeat 24 0 >>none.pfm
expect finite_differences_set_the_scale 0 '^scale: 2$' \
    "$diff" half.pfm none.pfm -o d.ppm

# ---- What cannot be drawn

rm -f d.ppm d.png
for bad in 0 -1 x inf nan 1e999 ''; do
    expect "a_scale_of_${bad:-nothing}_is_code_1" 1 'finite number above 0' \
        "$diff" a.ppm b.ppm -o d.ppm --scale "$bad"
done
expect a_scale_without_picture_is_code_1 1 "'--scale' needs '-o'" \
    "$diff" a.ppm b.ppm --scale 1
expect relative_without_picture_is_code_1 1 "'--relative' needs '-o'" \
    "$diff" a.ppm b.ppm --relative
expect zoom_without_picture_is_code_1 1 "'--zoom' needs '-o'" \
    "$diff" a.ppm b.ppm --zoom 2
expect a_zoom_of_17_is_code_1 1 'zoom 17' \
    "$diff" a.ppm b.ppm -o d.ppm --zoom 17
(printf 'P6\n6000 1\n255\n' && repeat 18000 0) >wide.ppm
expect a_page_too_large_is_code_1 1 'too large' \
    "$diff" wide.ppm wide.ppm -o d.ppm --zoom 16
! grep -q rmse out.txt
say a_page_too_large_prints_no_figures $?
expect other_sizes_write_no_picture 2 '1x1.*2x1' "$diff" one.pfm a.ppm -o d.ppm
[ ! -e d.ppm ]
say a_failure_writes_nothing $?
expect a_limit_does_not_stop_the_picture 4 relmse \
    "$diff" a.ppm b.ppm --max-relmse 0.0013 -o d.ppm
cp d.ppm old.ppm
expect a_bad_picture_is_code_2_with_a_picture 2 'cut.ppm: byte 11' \
    "$diff" a.ppm cut.ppm -o d.ppm
cmp -s d.ppm old.ppm
say a_failure_leaves_the_old_picture $?

"$diff" a.ppm b.ppm -o /dev/full >out.txt 2>&1
[ $? -eq 1 ]
say a_name_without_extension_is_code_1 $?
ln -s /dev/full full.png
expect a_full_disk_is_code_3 3 'No space' "$diff" a.ppm b.ppm -o full.png
rm full.png
[ "$(ls ./*.tmp 2>/dev/null | wc -l)" -eq 0 ]
say nothing_is_left_behind $?

exit $((failures != 0))
