#!/bin/sh
# test_sky.sh - qlux-scene: maps of the sky, and lights dim beside others
# SPDX-License-Identifier: MIT
#
# Usage: tests/tools/scene/test_sky.sh [BUILD]
# Example: tests/tools/scene/test_sky.sh build

suite=tools/test_sky
. tests/support/workspace.sh

# Eight columns of 45 degrees, painted 1 to 8 from left to right.
{
    printf 'PF\n8 1\n-1\n'
    for high in '\200\077' '\000\100' '\100\100' '\200\100' '\240\100' \
        '\300\100' '\340\100' '\000\101'; do
        printf "\\0\\0$high\\0\\0$high\\0\\0$high"
    done
} >sky.pfm
printf 'v 0 -1 0\nv 1 -1 0\nv 0 -1 1\nf 1 2 3\n' >a.obj

# sees CLAIM ROTATE X Z LEFT RIGHT: towards (X, 0, Z), on either side of what is
# straight ahead
sees()
{
    printf '%s\n' 'mesh a.obj' "sky sky.pfm rotate $2" \
        "camera eye 0 0 0  look $3 0 $4  fov 40" >a.scene
    "$build/qlux-scene" a.scene -o a.qlb >out.txt 2>&1 || exit 3
    for program in qlux-sim qlux-sim-draft qlux-ref; do
        "$build/$program" a.qlb -o a.pfm --size 2x1 --spp 16 --quiet || exit 3
        tail -c 24 a.pfm | od -A n -t f4 -v | awk -v left="$5" -v right="$6" '
            { for (i = 1; i <= NF; i++) v[n++] = $i }
            function near(x, want) {
                return x > want * 0.995 && x < want * 1.005
            }
            END { exit !(n == 6 && near(v[0], left) && near(v[3], right)) }' ||
            { say "$1" 1 "$program"; return; }
    done
    say "$1" 0
}
sees the_left_edge_is_at_z_and_columns_grow_to_the_right 0 0 1 8 1
sees a_quarter_to_the_right_of_z_is_minus_x 0 -1 0 2 3
sees behind_is_the_middle_of_the_map 0 0 -1 4 5
sees rotate_turns_the_left_edge_from_z_to_x 90 1 0 8 1
sees what_was_ahead_is_to_the_left_then 90 0 1 2 3
sees a_turn_against_it_is_the_other_way -45 0 1 7 8

# ---- formats ----

# blob NAME BYTES [WORDS]: of a scene with this map; what is said is in out.txt
blob()
{
    # shellcheck disable=SC2059 # the bytes are written as a format
    printf "$2" >"$1.map"
    printf '%s\n' 'mesh a.obj' "sky $1.map ${3-}" \
        'camera eye 0 0 0  look 0 0 1  fov 40' >a.scene
    "$build/qlux-scene" a.scene -o "$1.qlb" --quiet >out.txt 2>&1
}

# same CLAIM PFM OTHER [WORDS]: two maps, the other by WORDS, give one blob
same()
{
    blob pfm "$2" && blob other "$3" "${4-}" && [ ! -s out.txt ] &&
        cmp -s pfm.qlb other.qlb
    say "$1" $?
}

# bad CLAIM TEXT BYTES: a map that is refused, and why
bad()
{
    blob bad "$3"
    [ $? -eq 2 ] && grep -qF "bad.map: $2" out.txt
    say "$1" $?
}
one='\0\0\200\077' zero='\0\0\0\0' two='\0\0\0\100'
ones=$one$one$one$one$one$one$one$one
hdr='#?RADIANCE\n# by hand\nFORMAT=32-bit_rle_rgbe\n'
b1='\200\200\200\201' b2='\200\200\200\202' b0='\0\0\0\0'
same pixels_of_a_radiance_picture_are_read "Pf\n2 1\n-1\n$one$zero" \
    "$hdr\n-Y 1 +X 2\n$b1$b0"
same its_exposures_are_divided_out "Pf\n2 1\n-1\n$one$zero" \
    "${hdr}EXPOSURE=4\nEXPOSURE=0.5\n\n-Y 1 +X 2\n$b2$b0"
same its_rows_may_go_upwards "Pf\n1 2\n-1\n$zero$one" \
    "#?RGBE\n\n+Y 2 +X 1\n$b0$b1"
same its_pixels_may_go_to_the_left "Pf\n2 1\n-1\n$zero$one" \
    "$hdr\n-Y 1 -X 2\n$b1$b0"
row='\002\002\0\010'
green='\010\200\200\200\200\200\200\200\200'
same runs_of_each_channel_are_read "Pf\n8 2\n-1\n$ones$ones" \
    "$hdr\n-Y 2 +X 8\n$row\210\200$green\204\200\204\200\210\201\
$row\210\200$green\203\200\205\200\001\201\207\201"
same pixels_are_repeated_as_of_old "Pf\n8 1\n-1\n$ones" \
    "$hdr\n-Y 1 +X 8\n$b1\001\001\001\003$b1\001\001\001\003"
same a_map_written_downwards_is_flipped "Pf\n1 3\n-1\n$zero$one$two" \
    "Pf\n1 3\n-1\n$two$one$zero" flip
same words_come_in_any_order "Pf\n1 2\n-1\n$zero$one" \
    "Pf\n1 2\n-1\n$one$zero" 'rotate 0 flip'

bad another_format_is_refused 'byte 11: expected FORMAT=32-bit_rle_rgbe' \
    "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n$b1"
bad a_header_without_end_is_refused 'byte 44: expected an empty line' "$hdr"
bad a_turned_picture_is_refused 'byte 45: expected -Y HEIGHT +X WIDTH' \
    "$hdr\n+X 1 -Y 1\n$b1"
bad an_exposure_of_0_is_refused 'byte 44: expected an EXPOSURE above 0' \
    "${hdr}EXPOSURE=0\n\n-Y 1 +X 1\n$b1"
bad a_cut_picture_is_refused 'byte 59: the pixels end too early' \
    "$hdr\n-Y 1 +X 2\n$b1"
bad a_run_beyond_its_row_is_refused 'byte 59: expected a run that ends' \
    "$hdr\n-Y 1 +X 8\n$row\211\200$b1$b1"
bad a_row_of_another_width_is_refused 'byte 55: expected a row of' \
    "$hdr\n-Y 1 +X 8\n\002\002\0\011\210\200$b1$b1"
bad a_repetition_of_nothing_is_refused 'byte 55: expected a repetition' \
    "$hdr\n-Y 1 +X 8\n\001\001\001\003$b1"
bad bytes_after_the_pixels_are_refused 'byte 59: unexpected bytes' \
    "$hdr\n-Y 1 +X 1\n$b1$b1"
bad openexr_is_refused_with_the_way_to_convert_it \
    'this is an OpenEXR picture; expected a PFM or a Radiance picture' \
    'v/1\001\002\0\0\0'
blob low "Pf\n2 1\n-1\n$two\0\0\0\272" &&
    grep -q 'low.map: 3 channels a little below 0 are 0$' out.txt
say what_is_a_little_below_0_is_0_and_counted $?
bad what_is_far_below_0_is_refused 'pixel 1 of row 0 from the top: expected' \
    "Pf\n2 1\n-1\n$two\0\0\200\273"

# ---- what is too dim beside the brightest light ----
# lamps KE...: a blob of so many lamps, m1 first; what is said is in out.txt
lamps()
{
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nmtllib m.mtl\n' >a.obj
    : >m.mtl
    m=0
    for ke; do
        m=$((m + 1))
        printf 'v 0 0 %s\nusemtl m%s\nf 1 2 -1\n' $m $m >>a.obj
        printf 'newmtl m%s\nKe %s\n' $m "$ke" >>m.mtl
    done
    printf '%s\n' 'mesh a.obj' "${sky-}" \
        'camera eye 0.2 -9 1.2 look 0.2 0 1.2 up 0 0 1 fov 1' >a.scene
    "$build/qlux-scene" a.scene -o a.qlb --quiet >out.txt 2>&1
}

# says CLAIM TEXT: that and nothing else of the light
says()
{
    [ "$(sed '/the camera sees nothing/d
        s/^qlux-scene: warning: a.scene: //' out.txt)" = "$2" ]
    say "$1" $? "$(cat out.txt)"
}
dim='times dimmer than the brightest light'
lamps '1e7 1e7 1e7' 1
says a_lamp_10_million_times_dimmer_is_right ''
lamps '1 1e-12 1'
says a_channel_that_does_not_count_is_not_told ''
lamps 1e10 1
says a_lamp_10_billion_times_dimmer_is_told "material 'm2' shines 8 times as \
bright as written, because it is 1e+10 $dim"
"$build/qlux-sim" a.qlb -o a.pfm --size 32x32 --spp 1024 --direct none --quiet
tail -c 12288 a.pfm | od -A n -t f4 -v | awk '
    { for (i = 1; i <= NF; i++) sum += $i }
    END { exit !(sum > 3072 * 7.7 && sum < 3072 * 8.3) }'
say and_so_it_does $?
sky='sky 1e-9 1e-9 2e-9' lamps 1 2
says a_dim_sky_is_told "the sky shines 1.4 times as bright as written, \
because it is 1.5e+09 $dim"
lamps 1e12 2 2 2 2 2 2 2 2 2 2 2 2
[ "$(grep -c "material 'm[0-9]*' shines" out.txt)" -eq 10 ] &&
    grep -q ': 2 more materials are as dim' out.txt
say ten_are_named_and_the_rest_counted $?
printf 'v 0 -1 0\nv 1 -1 0\nv 0 -1 1\nf 1 2 3\n' >a.obj
# 1, 2^-33, 1.5 2^-31 and 2^-24, in units of 2^-31
blob a "Pf\n4 1\n-1\n$one\0\0\0\057\0\0\100\060\0\0\200\063"
says dim_texels_are_counted "1 texels of the sky are off, one shines 1.33 \
times as bright as written, because it is 1.4e+09 $dim
1 texels of the sky are black, because they are \
8.6e+09 $dim, or dimmer"
exit $((failures > 0))
