#!/bin/sh
# test_sheet.sh - qlux-sheet: sizes, places, letters, its exit codes
# SPDX-License-Identifier: MIT
#
# Usage: tests/tools/test_sheet.sh [BUILD]
# Example: tests/tools/test_sheet.sh build

suite=tools/test_sheet
. tests/support/workspace.sh
sheet=$build/qlux-sheet
diff=$build/qlux-diff

# size_of FILE.ppm: "WIDTH HEIGHT"
size_of() {
    head -n 2 "$1" | tail -n 1
}

# has_size CLAIM SIZE OPTIONS...: of a sheet made with these options
has_size() {
    claim=$1 size=$2
    shift 2
    "$sheet" -o size.ppm "$@" && [ "$(size_of size.ppm)" = "$size" ]
    say "$claim" $?
}

# pixel FILE.ppm X Y: its bytes, in hexadecimal
pixel() {
    w=$(size_of "$1")
    w=${w% *}
    tail -c +$(($(head -n 3 "$1" | wc -c) + 3 * ($2 + w * $3) + 1)) "$1" |
        head -c 3 | od -An -tx1 | tr -d ' \n'
}

# inked FILE.ppm: how many of its bytes are not white
inked() {
    tail -n +4 "$1" | od -An -v -tx1 | tr -s ' ' '\n' | grep -c '[0-9a-e]'
}

# One red pixel; green and blue, one above the other; a linear one; half a one.
printf 'P6\n1 1\n255\n\377\0\0' >red.ppm
printf 'P6\n1 2\n255\n\0\377\0\0\0\377' >tall.ppm
printf 'PF\n1 1\n-1.0\n\0\0\200\077\0\0\200\077\0\0\0\100' >linear.pfm
printf 'P6\n2 2\n255\n\377' >cut.ppm

expect no_output_is_code_1 1 'missing -o FILE' "$sheet" a=red.ppm
expect no_picture_is_code_1 1 'LABEL=IN' "$sheet" -o s.ppm
expect a_picture_without_label_is_code_1 1 "'red.ppm': expected LABEL=IN" \
    "$sheet" -o s.ppm red.ppm
expect a_label_without_picture_is_code_1 1 'expected LABEL=IN' \
    "$sheet" -o s.ppm a=
expect an_unknown_option_is_code_1 1 "unknown option '--rows'" \
    "$sheet" -o s.ppm --rows 1 a=red.ppm
expect no_columns_is_code_1 1 '--columns 0' \
    "$sheet" -o s.ppm --columns 0 a=red.ppm
expect a_zoom_of_17_is_code_1 1 '--zoom 17' \
    "$sheet" -o s.ppm --zoom 17 a=red.ppm
expect a_text_size_of_0_is_code_1 1 '--text 0' \
    "$sheet" -o s.ppm --text 0 a=red.ppm
expect an_option_without_value_is_code_1 1 '--title' "$sheet" -o s.ppm --title
expect nine_titles_are_code_1 1 'at most 8' "$sheet" -o s.ppm \
    --title 1 --title 2 --title 3 --title 4 --title 5 --title 6 --title 7 \
    --title 8 --title 9 a=red.ppm
expect a_pfm_sheet_is_code_1 1 '.png or .ppm' "$sheet" -o s.pfm a=red.ppm
expect a_name_without_extension_is_code_1 1 's' "$sheet" -o s a=red.ppm
long=$(printf '%6000s' '' | tr ' ' x)
expect a_sheet_too_wide_is_code_1 1 'too large' \
    "$sheet" -o s.ppm "$long=red.ppm"
expect a_missing_picture_is_code_3 3 'none.ppm' "$sheet" -o s.ppm a=none.ppm
expect a_cut_picture_is_code_2 2 'cut.ppm: byte' "$sheet" -o s.ppm a=cut.ppm
expect a_linear_picture_is_code_2 2 'linear' "$sheet" -o s.ppm a=linear.pfm
! ls s.* >out.txt 2>&1
say a_failure_writes_nothing $?

# Letters of size 1: a margin of 8, a gap of 3, lines of 11; n letters are
# 6 n - 1 wide.
has_size a_sheet_is_as_large_as_its_parts '17 31' --text 1 =red.ppm
has_size a_long_label_widens_its_cell '33 31' --text 1 abc=red.ppm
has_size every_cell_is_as_wide_as_the_widest '83 31' \
    --text 1 a=red.ppm abc=red.ppm abc=red.ppm
has_size columns_limit_the_width '46 54' \
    --text 1 --columns 2 a=red.ppm ab=red.ppm a=red.ppm c=red.ppm
has_size more_columns_than_pictures_are_not_there '34 31' \
    --text 1 --columns 9 a=red.ppm a=red.ppm
has_size each_bar_begins_a_line '21 53' --text 1 'a|b|c=red.ppm'
has_size the_highest_picture_sets_the_height '34 32' \
    --text 1 a=red.ppm b=tall.ppm
has_size zoom_enlarges_pictures '26 50' --text 1 --zoom 10 a=tall.ppm
has_size text_enlarges_letters_and_margins '33 61' --text 2 =red.ppm
has_size a_title_has_a_line_of_its_own '38 58' --text 1 --title no a=red.ppm
has_size a_second_title_is_smaller '38 70' \
    --text 1 --title no --title yes a=red.ppm

"$sheet" -o s.ppm --text 1 --zoom 2 --columns 2 \
    a=red.ppm a=tall.ppm a=tall.ppm a=red.ppm
[ "$(pixel s.ppm 8 8) $(pixel s.ppm 9 9)" = 'ff0000 ff0000' ]
say the_first_picture_is_in_the_upper_left_corner $?
[ "$(pixel s.ppm 21 8) $(pixel s.ppm 22 11)" = '00ff00 0000ff' ]
say the_second_is_to_its_right $?
[ "$(pixel s.ppm 8 34) $(pixel s.ppm 21 34)" = '00ff00 ff0000' ]
say the_third_begins_the_second_row $?
[ "$(pixel s.ppm 0 0) $(pixel s.ppm 10 8)" = 'ffffff ffffff' ]
say the_ground_is_white $?
# The first one, of size 2, is on the rows 8 to 25 of 26 pixels each.
"$sheet" -o one.ppm --text 1 --title 'H' --title ' ' =red.ppm
"$sheet" -o two.ppm --text 1 --title 'H' --title 'H' =red.ppm
cmp one.ppm two.ppm | awk '{ byte = $5 + 0 }
    END { exit !(byte > 13 + 3 * 26 * 26) }'
say a_second_title_is_below_the_first $?

"$sheet" -o x.ppm --text 1 a=a=red.ppm && [ "$(size_of x.ppm)" = '33 31' ]
say the_last_equals_sign_ends_the_label $?

"$sheet" -o none.ppm --text 1 '   =red.ppm'
"$sheet" -o abc.ppm --text 1 'abc=red.ppm'
"$sheet" -o abd.ppm --text 1 'abd=red.ppm'
"$sheet" -o odd.ppm --text 1 "$(printf 'ab\001')=red.ppm"
expect a_label_of_blanks_is_not_seen 0 'identical: no' "$diff" none.ppm abc.ppm
# Two bytes of a red pixel; and three each of the 41 pixels of the letters.
[ "$(inked none.ppm)" -eq 2 ] && [ "$(inked abc.ppm)" -eq 125 ]
say a_label_is_drawn $?
expect other_letters_look_different 0 'identical: no' "$diff" abc.ppm abd.ppm
expect what_is_no_letter_is_a_box 0 'identical: no' "$diff" odd.ppm abc.ppm
# Every printable character has a shape of its own; a bar makes two lines.
code=32
while [ $code -lt 127 ]; do
    "$sheet" -o one.ppm --text 1 \
        "$(printf "\\$(printf %o $code)")x=red.ppm" && cksum <one.ppm
    code=$((code + 1))
done | sort | uniq -c | awk '$1 > 1 { n++ } END { exit NR < 95 || n > 0 }'
say every_character_looks_different $?

"$sheet" -o s.png --text 1 --zoom 2 --columns 2 \
    a=red.ppm a=tall.ppm a=tall.ppm a=red.ppm
expect its_ppm_and_png_agree 0 'identical: yes' "$diff" s.ppm s.png
"$sheet" -o from_png.ppm a=s.png && "$sheet" -o from_ppm.ppm a=s.ppm
expect it_reads_png_too 0 'identical: yes' "$diff" from_png.ppm from_ppm.ppm
ln -s /dev/full full.png
expect a_full_disk_is_code_3 3 'No space' "$sheet" -o full.png a=red.ppm
rm full.png
[ "$(ls ./*.tmp 2>/dev/null | wc -l)" -eq 0 ]
say nothing_is_left_behind $?

# ---- shrink.sh: variance as a light shrinks ---------------------------------

shrink() { # OPTION...
    (cd "$root" && BUILD=$work/b tools/sheet/shrink.sh "$@")
}
mkdir b && ln -s "$build/qlux-scene" "$build/qlux-sim" b
kept=$root/tools/sheet/shrink
awk -f "$kept.awk" "$kept.csv" >again.svg && cmp again.svg "$kept.svg"
say the_drawing_of_a_shrinking_light_is_that_of_its_table $?
expect a_shrinking_light_needs_a_drawing_of_svg 1 'a name that ends in .svg' \
    shrink -o a.png
expect a_light_of_one_size_is_measured 0 'b/shrink.svg' \
    shrink --sides 1 --spp 16
# The closed forms of known_strategies.c; the spread of 16,384 pixels, whose
# fourth moments are below 5 squared variances: 4.9 standard errors are 7.7 %.
awk -F, '
    function near(x, want, part) {
        if (x / want - 1 > part || want / x - 1 > part) bad = bad " " $3 " " x
    }
    BEGIN {
        square = 0.2394564704607735 ^ 2
        known["hemisphere"] = 0.3908040397 / square
        known["cosine"] = 0.1821170692 / square
        known["area"] = 0.0017405096 / square
        known["solid-angle"] = 0.0001074045 / square
    }
    FNR == 1 { next }
    {
        rows++
        if ($3 in known) near($5 * $4, known[$3], 1e-4)
        near($6, $5, 0.08)
    }
    END { print bad; exit bad != "" || rows != 6 }
' b/shrink.csv >bad.txt
say its_variances_are_those_of_closed_forms $? "$(cat bad.txt)"

exit $((failures != 0))
