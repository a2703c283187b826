#!/bin/sh
# test_diff.sh - qlux-diff: its numbers by hand, its exit codes, its picture
# SPDX-License-Identifier: MIT
#
# Usage: tests/tools/test_diff.sh [BUILD]
# Example: tests/tools/test_diff.sh build

build=$(cd "${1:-build}" && pwd) || exit 3
work=$(mktemp -d) || exit 3
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 3
diff=$build/qlux-diff
failures=0

say() { # claim, what it evaluates to
    if [ "$2" -eq 0 ]; then
        printf '%-20s %-52s ok\n' tools/test_diff "$1"
    else
        printf '%-20s %-52s FAIL\n' tools/test_diff "$1"
        failures=$((failures + 1))
    fi
}

# expect CLAIM CODE TEXT COMMAND...: the exit code, and TEXT in what it prints
expect() {
    claim=$1 code=$2 text=$3
    shift 3
    "$@" >out.txt 2>&1
    got=$?
    grep -q -- "$text" out.txt && [ "$got" -eq "$code" ]
    say "$claim" $?
}

# Two pixels. a: 10 20 30 40 50 60; b: 10 20 30 40 50 66, mean 36.
printf 'P6\n2 1\n255\n\012\024\036\050\062\074' >a.ppm
printf 'P6\n2 1\n255\n\012\024\036\050\062\102' >b.ppm
# The same as floats 1 and 2, and twice as large: 2 and 4, little-endian.
printf 'PF\n1 1\n-1.0\n\0\0\200\077\0\0\200\077\0\0\0\100' >one.pfm
printf 'PF\n1 1\n-1.0\n\0\0\0\100\0\0\0\100\0\0\200\100' >two.pfm
# one.pfm in the other byte order.
printf 'PF\n1 1\n1.0\n\077\200\0\0\077\200\0\0\100\0\0\0' >big.pfm
printf 'PF\n1 1\n-1.0\n\0\0\300\177\0\0\200\077\0\0\0\100' >nan.pfm

expect help_has_an_example 0 'Example:' "$diff" --help
expect one_picture_is_code_1 1 'two pictures' "$diff" a.ppm
expect three_pictures_are_code_1 1 'third' "$diff" a.ppm b.ppm b.ppm
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
printf 'P6\n1 1\n255\nabc' >dot.ppm
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
expect relmse_above_its_limit_is_code_1 1 relmse \
    "$diff" a.ppm b.ppm --max-relmse 0.0013
expect bias_below_its_limit_is_code_0 0 bias \
    "$diff" a.ppm b.ppm --max-bias 0.03
expect bias_above_its_limit_is_code_1 1 bias \
    "$diff" a.ppm b.ppm --max-bias 0.02
expect a_nan_is_above_every_limit 1 nan \
    "$diff" nan.pfm two.pfm --max-relmse 1e30

"$diff" a.ppm b.ppm -o d.ppm >out.txt && "$diff" a.ppm b.ppm -o d.png >out.txt
say a_picture_of_the_difference_is_written $?
expect its_ppm_and_png_agree 0 'identical: yes' "$diff" d.ppm d.png
# The second pixel is where a is lower most: pure blue.
[ "$(head -c 19 d.ppm | tail -c 6 | od -An -tx1 | tr -d ' \n')" = \
    ffffff0000ff ]
say equal_is_white_and_lower_is_blue $?
"$diff" a.ppm b.ppm -o /dev/full >out.txt 2>&1
[ $? -eq 1 ]
say a_name_without_extension_is_code_1 $?
ln -s /dev/full full.png
expect a_full_disk_is_code_3 3 'No space' "$diff" a.ppm b.ppm -o full.png
rm full.png
[ "$(ls ./*.tmp 2>/dev/null | wc -l)" -eq 0 ]
say nothing_is_left_behind $?

exit $((failures != 0))
