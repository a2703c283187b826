#!/bin/sh
# test_scene.sh - qlux-scene: messages, exit codes, nothing left, round trips
# SPDX-License-Identifier: MIT
#
# Usage: tests/tools/test_scene.sh [BUILD]
# Example: tests/tools/test_scene.sh build

build=$(cd "${1:-build}" && pwd) || exit 3
root=$(cd "$(dirname "$0")/../.." && pwd)
work=$(mktemp -d) || exit 3
trap 'rm -rf "$work"' EXIT
scene=$build/qlux-scene
scenes=$root/tests/scenes
failures=0
cd "$work" || exit 3
mkdir in

say() { # claim, what it evaluates to
    if [ "$2" -eq 0 ]; then
        printf 'tools/scene       %-50s ok\n' "$1"
    else
        printf 'tools/scene       %-50s FAIL\n' "$1"
        failures=$((failures + 1))
    fi
}

# Nothing in the folder but the inputs and the logs.
is_clean() {
    [ "$(ls -A | grep -c -v -e '^in$' -e '^out.txt$' -e '^err.txt$')" -eq 0 ]
}

# expect CLAIM CODE TEXT COMMAND...: the exit code, TEXT on stderr, nothing left
expect() {
    claim=$1 code=$2 text=$3
    shift 3
    "$@" >out.txt 2>err.txt
    got=$?
    grep -q -F -e "$text" err.txt && [ "$got" -eq "$code" ] && is_clean
    result=$?
    say "$claim" $result
    [ $result -eq 0 ] || sed 's/^/    /' err.txt
}

# A small valid scene in in/, to be spoilt by the cases below.
reset_input() {
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nmtllib a.mtl\n' >in/a.obj
    printf 'usemtl w\nf 1 2 3\nf 1 3 4\n' >>in/a.obj
    printf 'newmtl w\nKd 0.5 0.5 0.5\nKe 1 1 1\n' >in/a.mtl
    printf 'mesh a.obj\ncamera eye 0 0 5 look 0 0 0 fov 40\n' >in/a.scene
}

# bad_scene CLAIM FILE-AND-LINE TEXT LINES: a .scene that must be refused
bad_scene() {
    reset_input
    printf "$4" >in/a.scene
    expect "$1" 2 "$2: $3" "$scene" in/a.scene -o out.qlb
}

# bad_obj CLAIM LINE TEXT LINES: what follows the four vertices is refused
bad_obj() {
    reset_input
    printf "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n$4" >in/a.obj
    expect "$1" 2 "in/a.obj:$2: $3" "$scene" in/a.scene -o out.qlb
}

bad_mtl() {
    reset_input
    printf "$4" >in/a.mtl
    expect "$1" 2 "in/a.mtl:$2: $3" "$scene" in/a.scene -o out.qlb
}

# good_obj CLAIM TRIANGLES LINES: what follows the four vertices is accepted
good_obj() {
    reset_input
    printf "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n$3" >in/a.obj
    "$scene" in/a.scene -o out.qlb --quiet 2>err.txt &&
        [ "$("$scene" --info out.qlb | sed -n 's/^triangles: //p')" = "$2" ]
    say "$1" $?
    rm -f out.qlb
}

warns() { # CLAIM TIMES TEXT: how often the last command said it
    [ "$(grep -c -F -e "$3" err.txt)" -eq "$2" ]
    say "$1" $?
}

# ---- usage ----
reset_input
"$scene" --help >out.txt && grep -q 'Example: ' out.txt
say help_has_an_example $?
expect no_arguments_are_refused 1 'an input file' "$scene"
expect no_output_is_refused 1 'expected -o' "$scene" in/a.scene
expect two_inputs_are_refused 1 'in/b' "$scene" in/a.scene in/b -o out.qlb
expect unknown_options_are_refused 1 "'--bogus'" "$scene" in/a.scene --bogus
expect node_bits_12_is_refused 1 '12' "$scene" in/a.scene -o o --node-bits 12
expect leaf_0_is_refused 1 '--leaf' "$scene" in/a.scene -o o --leaf 0
expect leaf_14_is_refused 1 '--leaf' "$scene" in/a.scene -o o --leaf 14
expect leaf_13_is_refused_with_8_bit_nodes 1 'expected 1 to 12' \
    "$scene" in/a.scene -o o --leaf 13 --node-bits 8
expect a_missing_value_is_refused 1 '-o' "$scene" in/a.scene -o
expect info_and_dump_together_are_refused 1 '--info' "$scene" --info --dump x

# ---- reading and writing ----
expect a_missing_scene_is_exit_3 3 'in/none' "$scene" in/none -o out.qlb
printf 'mesh none.obj\n' >in/a.scene
expect a_missing_mesh_is_exit_3_with_line 3 'in/a.scene:1: ' \
    "$scene" in/a.scene -o out.qlb
reset_input
expect a_missing_folder_is_exit_3 3 'none/out.qlb' \
    "$scene" in/a.scene -o none/out.qlb
expect a_full_device_is_exit_3 3 '/dev/full' \
    "$scene" in/a.scene -o /dev/full
expect a_full_disk_leaves_nothing 3 'out.qlb' sh -c \
    "ulimit -f 1; exec '$scene' '$scenes/cornell.scene' -o out.qlb"
expect a_dump_to_a_full_device_is_exit_3 3 'write' sh -c "
    '$scene' in/a.scene -o in/a.qlb --quiet &&
    '$scene' --dump in/a.qlb >/dev/full"
expect features_to_nowhere_leave_no_blob 3 'none/f.h' \
    "$scene" in/a.scene -o out.qlb --features none/f.h
printf 'old' >in/keep.qlb
printf 'nonsense\n' >in/a.scene
expect a_failure_keeps_the_old_output 2 'in/a.scene:1: ' \
    "$scene" in/a.scene -o in/keep.qlb
[ "$(cat in/keep.qlb)" = old ]
say the_old_output_is_untouched $?

# ---- .scene ----
cam='camera eye 0 0 5 look 0 0 0 fov 40\n'
a=in/a.scene
bad_scene an_unknown_key_is_refused $a:2 'expected mesh' "mesh a.obj\ntoast 3\n"
bad_scene sky_is_named_as_unsupported $a:3 "'sky' is not supported" \
    "mesh a.obj\n${cam}sky 1 1 1\n"
bad_scene sphere_is_named_as_unsupported $a:1 "'sphere' is not supported" \
    'sphere 0 0 0 radius 1\n'
bad_scene lens_is_named_as_unsupported $a:1 "'lens' is not supported" \
    'lens radius 1\n'
bad_scene a_scene_needs_a_camera $a:1 "expected a 'camera'" 'mesh a.obj\n'
bad_scene a_scene_needs_a_mesh $a:1 "expected a 'mesh'" "$cam"
bad_scene a_second_camera_is_refused $a:2 "expected one 'camera'" "$cam$cam"
bad_scene an_empty_file_is_refused $a:0 "expected a 'camera'" ''
bad_scene fov_0_is_refused $a:1 'expected a fov above 0' \
    'camera eye 0 0 5 look 0 0 0 fov 0\n'
bad_scene fov_180_is_refused $a:1 'expected a fov above 0' \
    'camera eye 0 0 5 look 0 0 0 fov 180\n'
bad_scene fov_missing_is_refused $a:1 'expected camera eye' \
    'camera eye 0 0 5 look 0 0 0\n'
bad_scene eye_at_look_is_refused $a:1 "expected camera 'eye' and 'look'" \
    'camera eye 1 2 3 look 1 2 3 fov 40\n'
bad_scene up_along_the_view_is_refused $a:1 "expected camera 'up' not par" \
    'camera eye 0 5 0 look 0 0 0 fov 40\n'
bad_scene up_of_zero_is_refused $a:1 "expected camera 'up' that" \
    'camera eye 0 5 0 look 0 0 0 up 0 0 0 fov 40\n'
bad_scene eye_twice_is_refused $a:1 'expected each of' \
    'camera eye 0 5 0 eye 0 0 0 fov 40\n'
bad_scene two_coordinates_are_refused $a:1 'expected three coordinates' \
    'camera eye 0 5 look 0 0 0 fov 40\n'
bad_scene nan_is_refused $a:1 'expected three coordinates' \
    'camera eye nan 0 5 look 0 0 0 fov 40\n'
bad_scene infinity_is_refused $a:1 'expected three coordinates' \
    'camera eye 1e999 0 5 look 0 0 0 fov 40\n'
bad_scene image_0_is_refused $a:2 'expected the width' "${cam}image 0 4\n"
bad_scene image_16385_is_refused $a:2 'expected the height' \
    "${cam}image 4 16385\n"
bad_scene image_of_one_number_is_refused $a:2 'expected the height' \
    "${cam}image 4\n"
bad_scene exposure_100_is_refused $a:1 'expected an exposure' 'exposure 100\n'
bad_scene lights_of_three_sides_are_refused $a:1 'expected lights one-sided' \
    'lights three-sided\n'
bad_scene words_after_the_end_are_refused $a:1 'expected the end of the line' \
    'exposure 1 2\n'
bad_scene a_far_camera_beside_the_scene_is_refused in/a.scene:2 \
    'expected an eye beside' 'mesh a.obj
camera eye 0 0 1000 look 0 0 2000 fov 40\n'
bad_scene a_scene_too_small_in_its_picture_is_refused in/a.scene:2 \
    'expected a picture at' 'mesh a.obj
camera eye 0 0 1000000 look 0 0 0 fov 40\n'
reset_input
printf 'mesh a.obj\0' >in/a.scene
expect a_binary_scene_is_refused 2 'byte 10 is zero' \
    "$scene" in/a.scene -o out.qlb

# ---- OBJ ----
bad_obj an_index_beyond_the_end_is_refused 6 'expected a vertex from 1 to 4' \
    'f 1 2 3\nf 1 2 5\n'
bad_obj a_negative_index_too_far_back_is_refused 5 'expected a vertex from -4' \
    'f -1 -2 -5\n'
bad_obj index_0_is_refused 5 'expected a corner' 'f 0 1 2\n'
bad_obj two_corners_are_refused 5 'expected three or more' 'f 1 2\n'
bad_obj a_corner_of_letters_is_refused 5 'expected a corner' 'f 1 2 x\n'
bad_obj a_corner_with_four_indices_is_refused 5 'expected a corner' \
    'f 1/1/1/1 2 3\n'
bad_obj a_vertex_of_two_numbers_is_refused 5 'expected three coord' 'v 1 2\n'
bad_obj a_vertex_of_nan_is_refused 5 'expected three coord' 'v 1 2 nan\n'
bad_obj a_vertex_of_infinity_is_refused 5 'expected three coord' 'v 1 2 inf\n'
bad_obj a_vertex_of_letters_is_refused 5 'expected three coord' 'v 1 2 3x\n'
bad_obj usemtl_without_a_name_is_refused 5 'expected usemtl NAME' 'usemtl\n'
bad_obj the_line_of_a_continued_face_is_its_first 5 'expected a corner' \
    'f 1 \\\n 2 \\\n x\n'
good_obj polygons_become_fans 3 'v 1 1 1\nf 1 2 3 4 5\n'
good_obj all_forms_of_corners_are_read 5 \
    'f 1/1 2/2 3/3\nf 1//1 2//2 4//4\nf 1/1/1 2/2/2 3/3/3\nf 1/ 2/ 3/\nf -1 -2 -3\n'
good_obj a_vertex_may_follow_its_face 1 'f 1 2 5\nv 1 1 1\n'
good_obj an_empty_mesh_is_a_scene 0 ''
good_obj a_scene_of_degenerate_faces_is_empty 0 'f 1 1 2\nf 1 2 2\n'
good_obj degenerate_faces_are_dropped 1 'f 1 1 2\nv 2 0 0\nf 1 2 5\nf 1 2 3\n'
warns they_are_counted_in_one_line 1 \
    'dropped 2 degenerate faces (1 as written, 1 on the grid)'
good_obj unknown_keys_are_no_errors 1 'l 1 2\nl 2 3\np 1\nbevel on\nf 1 2 3\n'
warns lines_are_reported_once 1 "'l' is not modelled"
warns points_are_reported_once 1 "'p' is not modelled"
warns unknown_keys_are_reported_by_name 1 "'bevel' is not modelled"
good_obj a_missing_library_is_no_error 1 \
    'mtllib no.mtl\nmtllib no.mtl\nusemtl x\nf 1 2 3\n'
warns a_missing_library_is_reported_once 1 "cannot read 'in/no.mtl'"

# ---- MTL ----
bad_mtl a_negative_ke_is_refused 3 'expected a Ke from 0' \
    'newmtl w\nKd 1 1 1\nKe 1 -1 1\n'
bad_mtl a_kd_of_letters_is_refused 2 'expected a colour' 'newmtl w\nKd red\n'
bad_mtl keys_before_newmtl_are_refused 1 'expected newmtl' 'Kd 1 1 1\n'
bad_mtl newmtl_without_a_name_is_refused 1 'expected newmtl NAME' 'newmtl\n'
bad_mtl a_spectral_kd_is_refused 2 'expected a colour for Kd as RGB' \
    'newmtl w\nKd spectral x.rfl\n'
reset_input
printf 'newmtl w\nKd 2 0 0\nKs 1 1 1\nmap_Kd a.png\nmap_Kd b.png\n' >in/a.mtl
"$scene" in/a.scene -o out.qlb --quiet 2>err.txt
say unmodelled_keys_of_materials_are_no_errors $?
warns kd_above_1_is_reported 1 "in/a.mtl:2: Kd of 'w' clamped"
warns ks_is_reported 1 "'Ks' is not modelled"
warns maps_are_reported_once 1 "'map_Kd' is not modelled"
rm -f out.qlb
reset_input
printf 'newmtl w\nKa 1 1 1\nKd 1 0 0\nKs 0 0 0\nNs 10\nNi 1.45\nd 1\nillum 2\n' \
    >in/a.mtl
"$scene" in/a.scene -o out.qlb --quiet 2>err.txt && [ ! -s err.txt ]
say what_every_exporter_writes_is_silent $?
rm -f out.qlb
reset_input
cp in/a.mtl 'in/two words.mtl'
sed 's/a.mtl/two words.mtl/' in/a.obj >in/b.obj
sed 's/a.obj/b.obj/' in/a.scene >in/b.scene
"$scene" in/b.scene -o out.qlb --quiet 2>err.txt && [ ! -s err.txt ]
say a_library_name_may_hold_blanks $?
rm -f out.qlb

# ---- line ends ----
for s in cornell square wild; do
    mkdir -p in/lf in/crlf in/cr
    for f in $s.scene $s.obj $s.mtl; do
        tr -d '\r' <"$scenes/$f" >in/lf/$f
        sed 's/$/\r/' in/lf/$f >in/crlf/$f
        tr '\n' '\r' <in/lf/$f >in/cr/$f
    done
    for e in lf crlf cr; do
        "$scene" in/$e/$s.scene -o in/$s.$e.qlb --quiet 2>err.txt
    done
    cmp -s in/$s.lf.qlb in/$s.crlf.qlb
    say ${s}_with_cr_lf_gives_the_same_bytes $?
    cmp -s in/$s.lf.qlb in/$s.cr.qlb
    say ${s}_with_cr_gives_the_same_bytes $?
done

# ---- dumps ----
for path in "$scenes"/*.scene in/a.scene; do
    s=$(basename "$path" .scene)
    for bits in 8 16; do
        "$scene" "$path" -o in/one.qlb --node-bits $bits --quiet 2>err.txt &&
            "$scene" --dump in/one.qlb -o in/one.txt &&
            "$scene" --dump in/one.qlb >in/two.txt &&
            cmp -s in/one.txt in/two.txt &&
            "$scene" in/one.txt -o in/two.qlb --quiet &&
            cmp -s in/one.qlb in/two.qlb
        say ${s}_comes_back_from_its_dump_with_$bits $?
    done
done
"$scene" "$scenes/cornell.scene" -o in/c.qlb --quiet
"$scene" --dump in/c.qlb >in/c.txt
sed 's/^depth .*/depth 1/' in/c.txt >in/d.txt
expect a_dump_that_makes_no_sense_is_refused 2 'in/d.txt' \
    "$scene" in/d.txt -o out.qlb
sed '5s/.*/radiance_exp 70000/' in/c.txt >in/d.txt
expect a_dump_number_out_of_range_has_a_line 2 'in/d.txt:5: expected' \
    "$scene" in/d.txt -o out.qlb
expect a_dump_has_no_node_bits 1 '--node-bits' \
    "$scene" in/c.txt -o out.qlb --node-bits 8
head -c 600 in/c.qlb >in/d.qlb
expect a_cut_blob_is_refused 2 'in/d.qlb' "$scene" --info in/d.qlb
(head -c 700 in/c.qlb && printf X && tail -c +702 in/c.qlb) >in/d.qlb
expect a_changed_blob_is_refused 2 'CRC' "$scene" --dump in/d.qlb
expect a_text_is_not_a_blob 2 'not a qlux blob' "$scene" --info in/c.txt
expect an_empty_blob_is_refused 2 'dev/null' "$scene" --info /dev/null

# ---- what is in a blob ----
"$scene" --info in/c.qlb >in/info.txt
info() { # KEY: its value
    sed -n "s/^$1: //p" in/info.txt
}
[ "$(info triangles) $(info lights) $(info materials) $(info node-bits)" = \
    "32 2 4 16" ] && [ "$(info bytes)" = "$(wc -c <in/c.qlb | tr -d ' ')" ]
say info_of_the_cornell_box_is_true $?
"$scene" "$scenes/wild.scene" -o in/w.qlb --quiet --features in/w.h 2>err.txt
grep -q '^#define QL_CFG_TWO_SIDED 1$' in/w.h &&
    grep -q '^#define QL_CFG_NODE8 0$' in/w.h &&
    grep -q '^#define QL_CFG_BVH_STACK 4$' in/w.h
say features_say_what_a_scene_needs $?
[ "$("$scene" --info in/w.qlb | sed -n 's/^triangles: //p')" = 10 ]
say wild_has_ten_triangles $?

# ---- the specification ----
block() { # NAME: a code block of BLOB.md
    sed -n "/^\`\`\`$1\$/,/^\`\`\`\$/p" "$root/firmware/BLOB.md" | sed "1d;\$d"
}
"$scene" "$scenes/square.scene" -o in/s.qlb --quiet
block dump >in/s.txt
"$scene" --dump in/s.qlb | cmp -s - in/s.txt
say the_dump_in_the_specification_is_true $?
block hex >in/s.hex
od -A x -t x1 -v in/s.qlb | cmp -s - in/s.hex
say the_bytes_in_the_specification_are_true $?

# ---- limits ----
awk 'BEGIN { print "v 0 0 0\nv 1 0 0\nv 0 1 0";
    for (i = 0; i < 65536; i++) print "f 1 2 3" }' >in/a.obj
expect more_than_65535_triangles_are_refused 2 'found 65536' \
    "$scene" in/a.scene -o out.qlb
sed '$d' in/a.obj >in/b.obj
"$scene" in/b.scene -o in/b.qlb --quiet 2>err.txt &&
    [ "$("$scene" --info in/b.qlb | sed -n 's/^triangles: //p')" = 65535 ]
say exactly_65535_identical_triangles_compile $?

is_clean
say nothing_is_left_behind $?
exit $((failures > 0))
