#!/bin/sh
# test_scene.sh - qlux-scene: messages, exit codes, nothing left, round trips
# SPDX-License-Identifier: MIT
#
# Usage: tests/tools/scene/test_scene.sh [BUILD]
# Example: tests/tools/scene/test_scene.sh build

suite=tools/scene
. tests/support/workspace.sh
scene=$build/qlux-scene
scenes=$root/tests/scenes
mkdir in

# What auto is takes time to find out, and is not what is tested here.
compile() {
    "$scene" "$@" --direct area
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
    expect "$1" 2 "$2: $3" compile in/a.scene -o out.qlb
}

# bad_obj CLAIM LINE TEXT LINES: what follows the four vertices is refused
bad_obj() {
    reset_input
    printf "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n$4" >in/a.obj
    expect "$1" 2 "in/a.obj:$2: $3" compile in/a.scene -o out.qlb
}

bad_mtl() {
    reset_input
    printf "$4" >in/a.mtl
    expect "$1" 2 "in/a.mtl:$2: $3" compile in/a.scene -o out.qlb
}

# good_obj CLAIM TRIANGLES LINES: what follows the four vertices is accepted
good_obj() {
    reset_input
    printf "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n$3" >in/a.obj
    compile in/a.scene -o out.qlb --quiet 2>err.txt &&
        [ "$("$scene" --info out.qlb | sed -n 's/^triangles: //p')" = "$2" ]
    say "$1" $?
    rm -f out.qlb
}

warns() { # CLAIM TIMES TEXT: how often the last command said it
    [ "$(grep -c -F -e "$3" err.txt)" -eq "$2" ]
    say "$1" $?
}

# ---- materials by their names ----
# same_blob CLAIM: the scene in in/ gives the blob in/one.qlb
same_blob() {
    compile in/a.scene -o in/two.qlb --quiet 2>err.txt &&
        cmp -s in/one.qlb in/two.qlb
    say "$1" $?
}
reset_input
compile in/a.scene -o in/one.qlb --quiet
printf 'newmtl brighter\nKd 0.1 0 0\nKe 1000 1000 1000\n' >>in/a.mtl
same_blob a_material_without_surfaces_changes_nothing
reset_input
printf 'newmtl w\nKd 0.1 0.2 0.3\nKe 9 9 9\n' >in/b.mtl
cat in/a.mtl >>in/b.mtl
mv in/b.mtl in/a.mtl
same_blob the_last_definition_of_a_name_counts
reset_input
sed -i 's/newmtl w/newmtl w#2/' in/a.mtl
sed -i 's/usemtl w/usemtl w#2/' in/a.obj
printf 'newmtl w\nKd 0.1 0.2 0.3\n' >>in/a.mtl
same_blob a_name_may_have_a_hash_in_it

# ---- usage ----
reset_input
expect no_arguments_are_refused 1 'missing FILE' "$scene"
expect no_output_is_refused 1 'missing -o FILE' compile in/a.scene
expect node_bits_12_is_refused 1 '12' compile in/a.scene -o o --node-bits 12
expect leaf_0_is_refused 1 '--leaf' compile in/a.scene -o o --leaf 0
expect leaf_14_is_refused 1 '--leaf' compile in/a.scene -o o --leaf 14
expect leaf_13_is_refused_with_8_bit_nodes 1 'expected 1 to 12' \
    compile in/a.scene -o o --leaf 13 --node-bits 8
expect info_with_a_leaf_is_refused 1 "'--info' goes without '--leaf'" \
    "$scene" --info x --leaf 2
expect info_with_an_output_is_refused 1 "'--info' goes without '-o'" \
    "$scene" --info x -o y
expect info_and_dump_together_are_refused 1 '--info' "$scene" --info --dump x

# ---- reading and writing ----
expect a_missing_scene_is_exit_3 3 'in/none' "$scene" in/none -o out.qlb
printf 'mesh none.obj\n' >in/a.scene
expect a_missing_mesh_is_exit_3_with_line 3 'in/a.scene:1: ' \
    compile in/a.scene -o out.qlb
reset_input
expect a_missing_folder_is_exit_3 3 'none/out.qlb' \
    compile in/a.scene -o none/out.qlb
expect a_full_device_is_exit_3 3 '/dev/full' \
    compile in/a.scene -o /dev/full
expect a_full_disk_leaves_nothing 3 'out.qlb' sh -c \
    "ulimit -f 1; exec '$scene' '$scenes/cornell.scene' -o out.qlb"
expect a_dump_to_a_full_device_is_exit_3 3 'write' sh -c "
    '$scene' in/a.scene -o in/a.qlb --quiet &&
    '$scene' --dump in/a.qlb >/dev/full"
expect features_to_nowhere_leave_no_blob 3 'none/f.h' \
    compile in/a.scene -o out.qlb --features none/f.h
printf 'old' >in/keep.qlb
printf 'nonsense\n' >in/a.scene
expect a_failure_keeps_the_old_output 2 'in/a.scene:1: ' \
    compile in/a.scene -o in/keep.qlb
[ "$(cat in/keep.qlb)" = old ]
say the_old_output_is_untouched $?

# ---- .scene ----
cam='camera eye 0 0 5 look 0 0 0 fov 40\n'
a=in/a.scene
bad_scene an_unknown_key_is_refused $a:2 'expected mesh' "mesh a.obj\ntoast 3\n"
bad_scene a_scene_needs_a_camera $a:1 "expected a 'camera'" 'mesh a.obj\n'
bad_scene a_scene_needs_a_surface $a:1 'expected a mesh, box, quad or' "$cam"
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
    compile in/a.scene -o out.qlb

# ---- lens ----
bad_scene a_lens_needs_a_focus $a:1 'expected lens radius' 'lens radius 1\n'
bad_scene a_lens_needs_a_radius $a:1 'expected lens radius' 'lens focus 1\n'
bad_scene a_lens_of_two_radii_is_refused $a:1 'expected each of radius' \
    'lens radius 1 radius 1\n'
bad_scene a_lens_of_unknown_words_is_refused $a:1 'expected each of radius' \
    'lens radius 1 fstop 8\n'
bad_scene a_negative_lens_is_refused $a:1 'expected a radius of 0 or more' \
    'lens radius -1 focus 2\n'
bad_scene a_focus_of_0_is_refused $a:1 'expected a radius of 0 or more' \
    'lens radius 1 focus 0\n'
bad_scene a_second_lens_is_refused $a:2 "expected one 'lens'" \
    'lens radius 1 focus 1\nlens radius 1 focus 1\n'
bad_scene a_lens_wider_than_any_is_refused $a:3 'expected a lens at most 256' \
    "mesh a.obj\n${cam}lens radius 257 focus 1\n"
reset_input
compile in/a.scene -o in/one.qlb --quiet
printf 'lens radius 0 focus 3\n' >>in/a.scene
compile in/a.scene -o in/two.qlb --quiet && cmp -s in/one.qlb in/two.qlb
say a_lens_of_radius_0_is_a_pinhole $?

# ---- sphere ----
bad_scene a_sphere_needs_a_centre $a:1 'expected three coordinates' \
    'sphere 0 0 radius 1 material w\n'
bad_scene a_sphere_needs_a_radius $a:1 'expected sphere X Y Z radius R' \
    'sphere 0 0 0 material w\n'
bad_scene a_sphere_of_radius_0_is_refused $a:1 'expected a radius above 0' \
    'sphere 0 0 0 radius 0 material w\n'
bad_scene a_sphere_of_negative_radius_is_refused $a:1 'expected a radius' \
    'sphere 0 0 0 radius -1 material w\n'
bad_scene a_sphere_needs_a_material $a:1 'expected sphere X Y Z radius R' \
    'sphere 0 0 0 radius 1 material\n'
bad_scene a_sphere_of_an_unknown_material_has_its_line $a:2 \
    "expected a material that a mesh's mtllib or a 'material' line defines, \
found 'nix'" \
    "${cam}sphere 0 0 0 radius 1 material nix\nmesh a.obj\n"
printf "mesh b.obj\n${cam}sphere 0 0 0 radius 1 material ghost\n" >$a
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl ghost\nf 1 2 3\n' >in/b.obj
expect a_name_that_only_faces_use_is_no_material 2 "$a:3: expected a material" \
    compile $a -o out.qlb
reset_input
printf 'mtllib a.mtl\n' >in/a.obj
(printf 'sphere 0 0 0 radius 1 material w\n' && cat in/a.scene &&
    printf 'sphere 2 0 0 radius 1e-6 material w\n') >in/b.scene
compile in/b.scene -o in/one.qlb --quiet 2>err.txt &&
    [ "$("$scene" --info in/one.qlb | grep -c -e '^triangles: 0$' \
        -e '^spheres: 1$' -e '^lights: 1$' -e '^vertices: 0$')" = 4 ]
say a_mesh_without_faces_gives_its_materials_to_spheres $?
warns spheres_below_the_grid_are_dropped_and_counted 1 \
    'dropped 1 faces smaller than the grid, 9.16e-05 units wide, because the'

# ---- sky ----
bad_scene a_sky_of_nothing_is_refused $a:1 'expected sky RED' 'sky\n'
bad_scene a_sky_of_one_number_is_refused $a:1 'expected a radiance' 'sky 1\n'
bad_scene a_sky_of_four_numbers_is_refused $a:1 'expected the end' \
    'sky 1 1 1 1\n'
bad_scene a_negative_sky_is_refused $a:1 'expected a radiance from 0' \
    'sky 1 -1 1\n'
bad_scene a_sky_too_bright_is_refused $a:1 'expected a radiance from 0' \
    'sky 1 2e18 1\n'
bad_scene a_plain_sky_does_not_rotate $a:1 'expected the end' \
    'sky 1 1 1 rotate 9\n'
bad_scene a_second_sky_is_refused $a:2 "expected one 'sky'" \
    'sky 1 1 1\nsky 1 1 1\n'
printf 'sky none.pfm\n' >in/a.scene
expect a_missing_sky_is_exit_3_with_line 3 "$a:1: cannot read the sky" \
    compile $a -o out.qlb
cat "$scenes/sky.pfm" >in/s.pfm # writable, whatever the tree is
bad_scene words_after_the_map_are_refused $a:1 "expected sky FILE [rotate" \
    'sky s.pfm turn 3\n'
bad_scene rotate_needs_degrees $a:1 'expected degrees' 'sky s.pfm rotate\n'
bad_scene rotate_of_any_size_is_refused $a:1 'expected 1e+06 degrees' \
    'sky s.pfm rotate 1000001\n'

# bad_sky CLAIM TEXT BYTES: a map that must be refused
bad_sky() {
    reset_input
    printf "$3" >in/s.pfm
    printf 'sky s.pfm\n' >>in/a.scene
    expect "$1" 2 "in/s.pfm: $2" compile in/a.scene -o out.qlb
}
one='\0\0\200\077' minus='\0\0\200\277' nan='\0\0\300\177' zero='\0\0\0\0'
bad_sky a_map_of_text_is_refused 'this is a PPM picture; expected a PFM' \
    'P6 1 1 255 abc'
bad_sky a_map_without_width_is_refused 'byte 3: expected a width' \
    'PF\n0 1\n-1\n'
bad_sky a_map_without_height_is_refused 'byte 5: expected a height' \
    'PF\n1 x\n-1\n'
reset_input
{ printf 'Pf\n1 4097\n-1\n'; head -c 16388 /dev/zero; } >in/s.pfm
printf 'sky s.pfm\n' >>in/a.scene
expect a_map_of_4097_rows_is_refused 2 'at most 4096 by 4096 pixels' \
    compile in/a.scene -o out.qlb
bad_sky a_map_without_scale_is_refused 'byte 7: expected a scale' 'PF\n1 1\nx\n'
bad_sky a_cut_map_is_refused 'byte 10: the pixels end too early' \
    "PF\n1 1\n-1\n$one$one"
bad_sky a_long_map_is_refused 'byte 10: unexpected bytes after' \
    "PF\n1 1\n-1\n$one$one$one$one"
bad_sky a_negative_radiance_has_a_place \
    "pixel 0 of row 1 from the top: expected a radiance from 0 to 1e+18, \
found -1" \
    "PF\n1 2\n-1\n$one$one$minus$one$one$one"
bad_sky a_radiance_of_nan_has_a_place \
    'pixel 1 of row 0 from the top: expected a radiance' \
    "Pf\n2 1\n-1\n$one$nan"
bad_sky a_black_map_is_refused 'expected a radiance above 0' \
    "Pf\n2 1\n-1\n$zero$zero"
reset_input
printf "Pf\n1 1\n-1\n\1\0\0\0" >in/s.pfm
printf 'sky s.pfm\n' >>in/a.scene
expect a_map_too_dim_beside_its_lights_is_refused 2 'less than 2^32 times' \
    compile $a -o out.qlb

# same_sky CLAIM BYTES BYTES: two maps that give the same blob
same_sky() {
    reset_input
    printf 'sky s.pfm\n' >>in/a.scene
    printf "$2" >in/s.pfm
    compile in/a.scene -o in/one.qlb --quiet
    printf "$3" >in/s.pfm
    compile in/a.scene -o in/two.qlb --quiet && cmp -s in/one.qlb in/two.qlb
    say "$1" $?
}
same_sky both_byte_orders_of_a_map_are_read \
    "PF\n1 2\n-1.0\n$one$one$zero$zero$one$one" \
    'PF 1 2 1\n\077\200\0\0\077\200\0\0\0\0\0\0\0\0\0\0\077\200\0\0\077\200\0\0'
same_sky a_grey_map_has_equal_channels \
    "PF\n2 1\n-1\n$one$one$one$zero$zero$zero" "Pf\n2 1\n-9\n$one$zero"
same_sky a_stray_newline_after_the_map_is_fine \
    "Pf\n2 1\n-1\n$one$zero" "Pf\n2 1\n-1\n$one$zero\n"
"$scene" --dump in/one.qlb >in/one.txt
sed 's/ rotate .*/ rotate -90/' "$scenes/sky.scene" >in/r.scene
cp "$scenes/sky.obj" "$scenes/sky.mtl" "$scenes/sky.pfm" in/
chmod -R u+w in
"$scene" in/r.scene -o in/one.qlb --quiet && "$scene" --dump in/one.qlb |
    grep -q '^sky 0x00000000 0x00000000 0x00000000  0xc0000000  32 16  0$'
say a_map_turned_back_by_90_begins_at_three_quarters $?
reset_input
compile in/a.scene -o in/one.qlb --quiet
printf 'sky 0 0 0\n' >>in/a.scene
compile in/a.scene -o in/two.qlb --quiet && cmp -s in/one.qlb in/two.qlb
say a_black_sky_is_none $?

# ---- table ----
# bad_table CLAIM LINE TEXT LINES: a distribution that must be refused
bad_table() {
    reset_input
    printf "$4" >in/t.txt
    printf 'table t.txt\n' >>in/a.scene
    expect "$1" 2 "in/t.txt:$2: $3" compile in/a.scene -o out.qlb
}
bad_table an_empty_table_is_refused 1 'expected dims D cells' '# nothing\n'
bad_table a_table_without_dims_is_refused 1 'expected dims D cells' '1 2 3\n'
bad_table a_table_of_4_dims_is_refused 1 'expected the dimensions' \
    'dims 4  cells 1 1 1 1\n'
bad_table a_table_without_cells_is_refused 1 'expected dims D cells' \
    'dims 1 2\n'
bad_table a_table_of_0_cells_is_refused 1 'expected the cells' \
    'dims 1 cells 0\n'
bad_table a_table_of_too_few_cells_is_refused 1 'expected the cells' \
    'dims 2 cells 2\n1 1\n'
bad_table a_table_too_large_is_refused 1 'expected at most 2^24 cells' \
    'dims 2 cells 65535 257\n'
bad_table a_negative_weight_is_refused 3 'expected a weight of 0 or more' \
    'dims 1 cells 3\n1 2\n-1\n'
bad_table a_weight_of_nan_is_refused 2 'expected a weight' \
    'dims 1 cells 3\n1 nan 2\n'
bad_table too_few_weights_are_refused 2 'expected 3 weights, found 2' \
    'dims 1 cells 3\n1 2\n'
bad_table too_many_weights_are_refused 3 "expected 3 weights, found '4' too" \
    'dims 1 cells 3\n1 2 3\n4\n'
bad_table a_table_of_zeros_is_refused 2 'expected a weight above 0' \
    'dims 1 cells 3\n0 0 0\n'
reset_input
printf 'table none.txt\n' >>in/a.scene
expect a_missing_table_is_exit_3_with_line 3 "$a:3: cannot read the table" \
    compile $a -o out.qlb
reset_input
printf '# a comment\ndims 2  cells 4 3 # x, then y\n' >in/t.txt
printf '1 1 1 1\n0 0 0 0 # an empty row\n0 4\n0 4\n' >>in/t.txt
printf 'dims 1 cells 2 1 3' >in/u.txt
printf 'dims 3 cells 1 1 2 1 0' >in/v.txt
printf 'table t.txt\ntable u.txt\ntable v.txt\n' >>in/a.scene
"$scene" $a -o in/one.qlb --quiet && "$scene" --dump in/one.qlb >in/one.txt &&
    sed -n '/^# .* contacts/,/^c /d; /^# 3 tables/,$p' in/one.txt >in/two.txt
cat >in/wanted.txt <<'END'
# 3 tables: first word, dims, cells
table 0  2  4 3 1
table 15  1  2 1 1
table 17  3  1 1 2
# 23 words
w 0x0003 0x5555 0x5555 0x0004 0x4000 0x8000 0xc000 0x0000
w 0x0000 0x0000 0x0000 0x0004 0x0000 0x8000 0x8000 0x0002
w 0x4000 0x0001 0x0000 0x0001 0x0000 0x0001 0x0000
end
END
cmp -s in/two.txt in/wanted.txt
say tables_in_1_2_and_3_dimensions_are_those_of_their_weights $?

# ---- OBJ ----
bad_obj an_index_beyond_the_end_is_refused 6 'expected a vertex from 1 to 4' \
    'f 1 2 3\nf 1 2 5\n'
bad_obj a_vertex_that_never_comes_is_named_at_its_face 5 \
    'expected a vertex from 1 to 4, found 9' 'f 1 2 9\nf 1 2 3\no last\n'
bad_obj a_negative_index_too_far_back_is_refused 5 'expected a vertex from -4' \
    'f -1 -2 -5\n'
bad_obj index_0_is_refused 5 'expected a corner' 'f 0 1 2\n'
bad_obj a_hash_inside_a_corner_is_no_comment 5 'expected a corner' 'f 1 2 3#4\n'
bad_obj a_corner_of_letters_is_refused 5 'expected a corner' 'f 1 2 x\n'
bad_obj a_corner_with_four_indices_is_refused 5 'expected a corner' \
    'f 1/1/1/1 2 3\n'
bad_obj a_vertex_of_two_numbers_is_refused 5 'expected three coord' 'v 1 2\n'
bad_obj a_vertex_of_letters_is_refused 5 'expected three coord' 'v 1 2 3x\n'
bad_obj the_line_of_a_continued_face_is_its_first 5 'expected a corner' \
    'f 1 \\\n 2 \\\n x\n'
good_obj polygons_become_triangles 3 'v 1 1 1\nf 1 2 3 4 5\n'
good_obj all_forms_of_corners_are_read 5 \
    'f 1/1 2/2 3/3\nf 1//1 2//2 4//4\nf 2/2/2 3/3/3 4/4/4\nf 1/ 3/ 4/\n'\
'f -1 -2 -3\n'
good_obj a_vertex_may_follow_its_face 1 'f 1 2 5\nv 1 1 1\n'
bad_obj vertices_without_a_face_are_refused 4 'expected a face before the end' \
    ''
good_obj a_scene_of_degenerate_faces_is_empty 0 'f 1 1 2\nf 1 2 2\n'
good_obj degenerate_faces_are_dropped 1 'f 1 1 2\nv 2 0 0\nf 1 2 5\nf 1 2 3\n'
warns they_are_counted_in_one_line 1 'dropped 2 faces without area'
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
bad_mtl a_spectral_kd_is_refused 2 'expected a colour for Kd as RGB' \
    'newmtl w\nKd spectral x.rfl\n'
reset_input
printf 'newmtl w\nKd 2 0 0\nKs 1 1 1\nillum 9\n' >in/a.mtl
printf 'map_Kd a.png\nmap_Kd b.png\n' >>in/a.mtl
compile in/a.scene -o out.qlb --quiet 2>err.txt
say unmodelled_keys_of_materials_are_no_errors $?
warns kd_above_1_is_reported 1 "in/a.mtl:2: Kd of 'w' clamped"
warns other_illuminations_are_reported 1 \
    "in/a.mtl:4: 'illum 9' of 'w' is not modelled: opaque; illum 7 makes it"
warns ks_without_ns_says_what_it_is 1 "'w' has a Ks and no Ns: it is 0"
warns kd_and_ks_above_1_say_by_how_much 1 \
    "Kd + Ks of 'w' is above 1: both scaled by 0.5"
warns maps_are_reported_once 1 "'map_Kd' of 'w' is not modelled"
rm -f out.qlb
reset_input
printf 'newmtl w\nKa 1 1 1\nKd 1 0 0\nKs 0 0 0\nNs 10\n' >in/a.mtl
printf 'Ni 1.45\nd 1\nillum 2\n' >>in/a.mtl
printf 'sky 1 1 1\n' >>in/a.scene
compile in/a.scene -o out.qlb --quiet 2>err.txt && [ ! -s err.txt ]
say what_every_exporter_writes_is_silent $?
rm -f out.qlb
reset_input
cp in/a.mtl 'in/two words.mtl'
sed 's/a.mtl/two words.mtl/' in/a.obj >in/b.obj
sed 's/a.obj/b.obj/' in/a.scene >in/b.scene
compile in/b.scene -o out.qlb --quiet 2>err.txt && [ ! -s err.txt ]
say a_library_name_may_hold_blanks $?
rm -f out.qlb

bad_mtl a_glass_denser_than_any_has_the_line_of_its_ni 2 'expected a Ni' \
    'newmtl w\nNi 65\nKd 1 1 1\nillum 7\n'
bad_mtl a_glass_of_ni_0_is_refused 3 'expected a Ni' \
    'newmtl w\nillum 7\nNi 0\nnewmtl x\n'

# gloss CLAIM LINES WANTED: the materials and gloss that an MTL gives
gloss() {
    reset_input
    printf "newmtl w\n$2" >in/a.mtl
    compile in/a.scene -o in/one.qlb --quiet 2>err.txt &&
        [ "$("$scene" --dump in/one.qlb |
            sed -n 's/  0x0* 0x0* 0x0*$//; /^[mg] /p' |
            tr '\n' ' ' | sed 's/0x//g; s/ $//')" = "$3" ]
    say "$1" $?
}
plain='m 40000000 40000000 40000000'
none='m 00000000 00000000 00000000'
half='40000000 40000000 40000000'
gloss ks_with_ns_is_a_phong_lobe 'Kd 0.5\nKs 0.25\nNs 10.5\nillum 2\n' \
    "$plain g 20000000 20000000 20000000  000a8000 2aaaaaab  1"
gloss no_illum_is_a_phong_lobe_too 'Kd 0.5\nKs 0.5\nNs 1\n' \
    "$plain g $half  00010000 40000000  1"
gloss illum_3_is_a_mirror 'Kd 0.5\nKs 0.5\nNs 1\nillum 3\n' \
    "$plain g $half  00000000 40000000  2"
gloss illum_5_is_a_mirror 'Kd 0\nKs 0.5\nillum 5\n' \
    "$none g $half  00000000 80000000  2"
gloss illum_3_without_ks_is_diffuse 'Kd 0.5\nillum 3\n' "$plain"
gloss illum_7_is_glass \
    'illum 7\nNi 1.5\nTf 0.25 0.25 0.25\nKd 1 1 1\nKs 1 1 1\n' \
    "$none g $half  00018000 80000000  3"
! grep -q -v 'the picture is black' err.txt
say what_glass_ignores_is_silent $?
gloss glass_begins_with_ni_1_and_tf_1 'illum 7\n' \
    "$none g 80000000 80000000 80000000  00010000 80000000  3"
gloss tf_is_clamped 'illum 7\nTf 2 0.5 -1\n' \
    "$none g 80000000 5a82799a 00000000  00010000 80000000  3"
warns tf_above_1_is_reported 1 "in/a.mtl:3: Tf of 'w' clamped to 0..1"
gloss illum_1_leaves_ks_out 'Kd 0.5\nKs 0.5\nNs 1\nillum 1\n' "$plain"
warns illum_1_says_so 1 "Ks of 'w' is not used, for its illum is 1"
gloss illum_0_leaves_ks_out 'Kd 0.5\nKs 0.5\nNs 1\nillum 0\n' "$plain"
gloss a_ks_of_0_is_diffuse 'Kd 0.5\nKs 0 0 0\nNs 9\nillum 2\n' "$plain"
gloss a_ks_that_rounds_to_0_is_diffuse 'Kd 0.5\nKs 1e-11\nNs 9\n' "$plain"
gloss ns_is_clamped_above 'Kd 0.5\nKs 0.5\nNs 1e9\n' \
    "$plain g $half  ffff0000 40000000  1"
warns ns_above_65535_is_reported 1 "in/a.mtl:4: Ns of 'w' clamped to 0..65535"
gloss ns_is_clamped_below 'Kd 0.5\nKs 0.5\nNs -1\n' \
    "$plain g $half  00000000 40000000  1"
gloss kd_and_ks_are_scaled_together 'Kd 0.9 0.3 0\nKs 0.6 0.6 0.3\nNs 1\n' \
    "m 4ccccccd 1999999a 00000000 \
g 33333333 33333333 1999999a  00010000 471c71c7  1"
warns scaling_is_reported 1 "Kd + Ks of 'w' is above 1: both scaled by 0.6667"
gloss a_sum_of_1_is_not_scaled 'Kd 0.9 0.3 0.7\nKs 0.1 0.7 0.3\nNs 1\n' \
    "m 73333333 26666666 5999999a \
g 0ccccccd 5999999a 26666666  00010000 2eeeeeef  1"
! grep -q -v 'the picture is black' err.txt
say a_sum_of_1_is_silent $?
gloss a_trace_of_ks_keeps_a_chance 'Kd 1 1 1\nKs 0 0 1e-9\nNs 1\n' \
    "m 7ffffffe 7ffffffe 7ffffffe \
g 00000000 00000000 00000002  00010000 00000001  1"
gloss a_trace_of_kd_keeps_a_chance 'Kd 0 0 1e-9\nKs 1 1 1\nNs 1\n' \
    "m 00000000 00000000 00000002 \
g 7ffffffe 7ffffffe 7ffffffe  00010000 7fffffff  1"
reset_input
printf 'newmtl d\nKd 0.1\nnewmtl g\nKd 0.2\nKs 0.5\nNs 1\n' >in/a.mtl
printf 'newmtl e\nKd 0.3\nnewmtl h\nKd 0.4\nKs 0.5\nNs 1\n' >>in/a.mtl
printf 'v %s\n' '0 0 0' '1 0 0' '0 1 0' '0 0 1' >in/a.obj
echo 'mtllib a.mtl' >>in/a.obj
printf 'usemtl %s\nf %s\n' d '1 2 3' g '1 3 2' e '1 2 4' h '1 4 2' >>in/a.obj
"$scene" in/a.scene -o in/one.qlb --quiet && [ "$("$scene" --dump in/one.qlb |
    sed -n 's/^m 0x\([0-9a-f]*\).*/\1/p' | tr '\n' ' ')" = \
    '1999999a 33333333 0ccccccd 26666666 ' ]
say materials_with_gloss_come_first $?

# ---- normals ----
flat='v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0.5\n'
# normals CLAIM LINES WANTED: the normals of f 1//1 2//2 3//3 and f 2 4 3
normals() {
    reset_input
    printf "$flat$2" >in/a.obj
    compile in/a.scene -o in/one.qlb --quiet 2>err.txt &&
        [ "$("$scene" --dump in/one.qlb | sed -n 's/^vn //p' | tr '\n' ',')" = \
            "$3" ]
    say "$1" $?
}
normals a_face_with_normals_is_smooth \
    'vn 0 0 1\nvn 1 0 1\nvn 0 3 3\nf 1//1 2//2 3//3\n' \
    '0 0 32767,23170 0 23170,0 23170 23170,'
normals normals_turn_to_the_front \
    'vn 0 0 -2\nvn 1 0 1\nvn 0 -1 -1\nf 1/1/1 2/1/2 3/1/3\n' \
    '0 0 32767,23170 0 23170,0 23170 23170,'
normals a_normal_in_the_plane_leaves_it_flat \
    'vn 0 0 1\nvn 1 0 0\nvn 0 1 1\nf 1//1 2//2 3//3\n' ''
normals a_corner_without_normal_leaves_it_flat \
    'vn 0 0 1\nvn 1 0 1\nf 1//1 2//2 3\n' ''
normals its_own_normal_to_four_decimals_is_flat \
    'vn 0.0001 0 1\nvn 0 0 1\nvn 0 0.0001 1\nf 1//1 2//2 3//3\n' ''
normals a_little_more_is_smooth \
    'vn 0.0002 0 1\nvn 0 0 1\nvn 0 0 1\nf 1//1 2//2 3//3\n' \
    '7 0 32767,0 0 32767,0 0 32767,'
normals negative_indices_count_normals \
    'vn 9 9 9\nvn 0 0 1\nvn 1 0 1\nvn 0 3 3\nf 1//-3 2//-2 3//-1\n' \
    '0 0 32767,23170 0 23170,0 23170 23170,'
normals a_normal_may_follow_its_face \
    'f 1//1 2//2 3//3\nvn 0 0 1\nvn 1 0 1\nvn 0 3 3\n' \
    '0 0 32767,23170 0 23170,0 23170 23170,'
normals a_normal_that_is_not_there_leaves_it_flat \
    'vn 0 0 1\nvn 1 0 1\nf 1//1 2//2 3//3\nf 1//1 2//2 3//-9\n' ''
warns missing_normals_are_reported_once 1 'name normals that are not there'
normals a_normal_of_nan_leaves_it_flat \
    'vn 0 0 1\nvn 1 0 1\nvn nan nan nan\nvn 1\nf 1//1 2//2 3//3\n' ''
warns a_normal_of_nan_is_reported_once 1 'in/a.obj:7: expected vn X Y Z'
normals a_vertex_with_two_normals_becomes_two \
    'vn 0 0 1\nvn 1 0 1\nvn 0 3 3\nf 1//1 2//2 3//3\nf 2 4 3\n' \
    '0 0 32767,23170 0 23170,0 23170 23170,0 0 0,0 0 0,0 0 0,'
[ "$("$scene" --dump in/one.qlb | grep '^v ' | sort -u | wc -l)" -eq 4 ]
say and_both_stay_in_one_place $?
for s in square furnace sky; do
    # each face with its own normal, to four decimals
    awk '/^v / { v[++n] = $2 " " $3 " " $4 }
        /^f / { split(v[$2], a); split(v[$3], b); split(v[$4], c)
            for (k = 1; k < 4; k++) { d[k] = b[k] - a[k]; e[k] = c[k] - a[k] }
            x = d[2] * e[3] - d[3] * e[2]; y = d[3] * e[1] - d[1] * e[3]
            z = d[1] * e[2] - d[2] * e[1]; l = sqrt(x * x + y * y + z * z)
            printf "vn %.4f %.4f %.4f\nf", x / l, y / l, z / l; m++
            for (i = 2; i <= NF; i++) printf " %s//%d", $i, m
            print ""; next }
        { print }' "$scenes/$s.obj" >in/$s.obj
    cp "$scenes/$s.mtl" "$scenes/$s.scene" in/
    compile in/$s.scene -o in/one.qlb --quiet &&
        compile "$scenes/$s.scene" -o in/two.qlb --quiet &&
        cmp -s in/one.qlb in/two.qlb
    say ${s}_exported_with_flat_normals_costs_nothing $?
done

# ---- line ends ----
for s in cornell square wild; do
    mkdir -p in/lf in/crlf in/cr
    for f in $s.scene $s.obj $s.mtl; do
        tr -d '\r' <"$scenes/$f" >in/lf/$f
        sed 's/$/\r/' in/lf/$f >in/crlf/$f
        tr '\n' '\r' <in/lf/$f >in/cr/$f
    done
    for e in lf crlf cr; do
        compile in/$e/$s.scene -o in/$s.$e.qlb --quiet 2>err.txt
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
        compile "$path" -o in/one.qlb --node-bits $bits --quiet 2>err.txt &&
            "$scene" --dump in/one.qlb -o in/one.txt &&
            "$scene" --dump in/one.qlb >in/two.txt &&
            cmp -s in/one.txt in/two.txt &&
            "$scene" in/one.txt -o in/two.qlb --quiet &&
            cmp -s in/one.qlb in/two.qlb
        say ${s}_comes_back_from_its_dump_with_$bits $?
    done
done
compile "$scenes/cornell.scene" -o in/c.qlb --quiet
"$scene" --dump in/c.qlb >in/c.txt
sed 's/^depth .*/depth 1/' in/c.txt >in/d.txt
expect a_dump_that_makes_no_sense_is_refused 2 'in/d.txt' \
    "$scene" in/d.txt -o out.qlb
sed '5s/.*/radiance_exp 70000/' in/c.txt >in/d.txt
expect a_dump_number_out_of_range_has_a_line 2 'in/d.txt:5: expected' \
    "$scene" in/d.txt -o out.qlb
sed 's/^features .*/& lens/' in/c.txt >in/d.txt
expect a_dump_with_a_feature_it_lacks_is_refused 2 'expected lens if and only' \
    "$scene" in/d.txt -o out.qlb
(sed '$d' in/c.txt && echo 's 4096 4096 4096  256' && echo end) >in/d.txt
expect a_dump_without_the_feature_it_has_is_refused 2 \
    'expected spheres if and only' "$scene" in/d.txt -o out.qlb
(sed '$d' in/c.txt && echo 'da 0 0 0' && echo end) >in/d.txt
expect a_quarter_of_a_lens_is_refused 2 "expected a 'pa' line" \
    "$scene" in/d.txt -o out.qlb
(sed '$d' in/c.txt && echo 'da 0 0 0' && echo 'da 0 0 0' && echo end) >in/d.txt
expect a_lens_line_twice_is_refused 2 "expected one 'da'" \
    "$scene" in/d.txt -o out.qlb
sed '/^du /d' in/c.txt >in/d.txt
expect a_dump_without_du_is_refused 2 "expected a 'du' line before the end" \
    "$scene" in/d.txt -o out.qlb
awk '!/^n / || seen++' in/c.txt >in/d.txt
expect half_a_pair_is_refused 2 "expected a 'n' line before the end" \
    "$scene" in/d.txt -o out.qlb
compile "$scenes/cornell.scene" -o in/c8.qlb --node-bits 8 --quiet
"$scene" --dump in/c8.qlb | awk '!/^n8/ || seen++' >in/d.txt
line=$(grep -n '^p8' in/d.txt | sed -n '2s/:.*//p')
expect a_pair_of_one_8_bit_node_is_refused 2 \
    "in/d.txt:$line: expected a 'n8' line here, found 'p8'" \
    "$scene" in/d.txt -o out.qlb
sed 's/^features node16/features node8/' in/c.txt >in/d.txt
expect nodes_of_the_wrong_width_are_refused 2 'expected pairs16 if and only' \
    "$scene" in/d.txt -o out.qlb
(sed '$d' in/c.txt && echo w && echo end) >in/d.txt
expect a_dump_line_without_numbers_is_refused 2 'expected a word' \
    "$scene" in/d.txt -o out.qlb
for version in 2 4 ''; do
    sed "1s/3/$version/" in/c.txt >in/d.txt
    expect "a_dump_of_version_'$version'_is_refused" 2 \
        "in/d.txt:1: expected a dump of version 3, found '$version'" \
        "$scene" in/d.txt -o out.qlb
done
sed '$d' in/c.txt >in/d.txt
expect a_dump_without_its_end_is_refused 2 \
    "in/d.txt:$(wc -l <in/d.txt | tr -d ' '): expected an 'end' line" \
    "$scene" in/d.txt -o out.qlb
(cat in/c.txt && echo && echo end) >in/d.txt
expect nothing_follows_the_end_of_a_dump 2 "in/d.txt:$(wc -l <in/d.txt |
    tr -d ' '): expected nothing after 'end', found 'end'" \
    "$scene" in/d.txt -o out.qlb
expect a_dump_has_no_node_bits 1 '--node-bits' \
    "$scene" in/c.txt -o out.qlb --node-bits 8
head -c 600 in/c.qlb >in/d.qlb
expect a_cut_blob_is_refused 2 'in/d.qlb' "$scene" --info in/d.qlb
(head -c 700 in/c.qlb && printf X && tail -c +702 in/c.qlb) >in/d.qlb
expect a_changed_blob_is_refused 2 'CRC' "$scene" --dump in/d.qlb
expect a_text_is_not_a_blob 2 'this is the dump of a blob' \
    "$scene" --info in/c.txt
expect an_empty_blob_is_refused 2 'dev/null' "$scene" --info /dev/null

# ---- what is in a blob ----
"$scene" --info in/c.qlb >in/info.txt
info() { # KEY: its value
    sed -n "s/^$1: //p" in/info.txt
}
[ "$(info triangles) $(info lights) $(info materials) $(info node-bits)" = \
    "32 2 4 16" ] && [ "$(info bytes)" = "$(wc -c <in/c.qlb | tr -d ' ')" ]
say info_of_the_cornell_box_is_true $?
compile "$scenes/wild.scene" -o in/w.qlb --quiet --features in/w.h 2>err.txt
grep -q '^#define QL_CFG_TWO_SIDED 1$' in/w.h &&
    grep -q '^#define QL_CFG_NODE8 0$' in/w.h &&
    grep -q '^#define QL_CFG_BVH_STACK 4$' in/w.h
say features_say_what_a_scene_needs $?

# needs SCENE GATES: exactly these gates of the header are 1, those apart that
# are sets
needs() {
    compile "$scenes/$1.scene" -o in/n.qlb --quiet --features in/n.h 2>err.txt
    [ "$(sed -n 's/^#define QL_CFG_\([A-Z_0-9]*\) 1$/\1/p' in/n.h |
        grep -v 'DIRECT\|CHOICES' | tr '\n' ' ')" = "$2 " ]
    say ${1}_needs_its_features_and_no_more $?
}
needs cornell 'NODE16 LIGHTS CONTACT HULL'
needs glossy 'NODE16 LIGHTS PHONG MIRROR GLASS SPHERES CONTACT HULL'
needs sky 'NODE16 LIGHTS PHONG SPHERES SKY SKY_MAP TABLES CONTACT HULL'
needs lens 'NODE16 LIGHTS SPHERES SKY LENS CONTACT HULL'
needs smooth 'NODE16 LIGHTS SMOOTH CONTACT HULL'
needs wild 'NODE16 LIGHTS TWO_SIDED SMOOTH MIRROR GLASS CONTACT ORDER HULL'
[ "$(grep -c '^#define QL_CFG_' in/n.h)" = 20 ]
say every_gate_is_said $?
# Mis, by all: 5 and 1, unless the command line asks for another gate.
sed 's/^auto .*/auto 5 1/' in/c.txt >in/d.txt
"$scene" in/d.txt -o in/n.qlb --quiet --features in/n.h
printf '#include "n.h"\n%s\n' \
    'QL_CFG_DIRECT QL_SCENE_DIRECT QL_CFG_LIGHT_CHOICES QL_SCENE_LIGHTS' >in/n.c
[ "$(cc -E -P in/n.c)" = '32 5 2 1' ] &&
    [ "$(cc -DQL_CFG_DIRECT=63 -E -P in/n.c)" = '63 5 2 1' ] &&
    [ "$(cc -DQL_CFG_LIGHT_CHOICES=7 -E -P in/n.c)" = '32 5 7 1' ]
say a_header_says_what_auto_is_and_builds_that $?
compile "$scenes/sky.scene" -o in/n.qlb --quiet
"$scene" --info in/n.qlb >in/info.txt
[ "$(info triangles) $(info spheres) $(info phong-materials) $(info sky)" = \
    "22 2 1 32 16" ] && [ "$(info tables) $(info table-words) $(info lens)" = \
    "1 528 no" ]
say info_of_the_sky_is_true $?
[ "$("$scene" --info in/w.qlb | sed -n 's/^triangles: //p')" = 10 ]
say wild_has_ten_triangles $?

# ---- the specification ----
block() { # NAME: a code block of BLOB.md
    sed -n "/^\`\`\`$1\$/,/^\`\`\`\$/p" "$root/firmware/BLOB.md" | sed "1d;\$d"
}
compile "$scenes/square.scene" -o in/s.qlb --quiet
block dump >in/s.txt
"$scene" --dump in/s.qlb | cmp -s - in/s.txt
say the_dump_in_the_specification_is_true $?
block hex >in/s.hex
od -A x -t x1 -v in/s.qlb | cmp -s - in/s.hex
say the_bytes_in_the_specification_are_true $?

# ---- limits ----
# All are about one point; no two are equal.
awk 'BEGIN {
    for (i = 0; i < 65536; i++) {
        x = 1 + i % 256
        y = 1 + int(i / 256)
        printf "v %d %d 0\nv %d %d 0\nv 0 %d 0\nf -3 -2 -1\n", -x, -y, x, -y, y
    }
}' >in/a.obj
expect more_than_65535_triangles_are_refused 2 'found 65536' \
    compile in/a.scene -o out.qlb
sed '$d' in/a.obj >in/b.obj
compile in/b.scene -o in/b.qlb --quiet 2>err.txt &&
    [ "$("$scene" --info in/b.qlb | sed -n 's/^triangles: //p')" = 65535 ]
say exactly_65535_triangles_about_one_point_compile $?

# ---- every host ----
# The CRC-32 of each blob, with 16-bit and with 8-bit nodes, whatever compiler
# and machine made it.
while read -r s crc16 crc8; do
    compile "$scenes/$s.scene" -o in/one.qlb --quiet 2>err.txt
    compile "$scenes/$s.scene" -o in/two.qlb --quiet --node-bits 8 2>err.txt
    [ "$("$scene" --info in/one.qlb | sed -n 's/^crc32: //p')" = "$crc16" ] &&
        [ "$("$scene" --info in/two.qlb | sed -n 's/^crc32: //p')" = "$crc8" ]
    say ${s}_is_the_same_blob_on_every_host $?
done <<'END'
cornell 33141664 4b989471
furnace 83a5f3cc f0144114
furnace08 b46c365e 33d594ce
furnace099 c76258e5 629a3eeb
square 7af6f09d df6794bd
wild eb77f39b d5371fa7
glossy 3f1cc01f 49e03609
sky 060ceea9 f5588efa
lens 587835a3 50a97027
smooth 685249bf 26f5c0e2
END

is_clean
say nothing_is_left_behind $?
exit $((failures > 0))
