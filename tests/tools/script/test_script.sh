#!/bin/sh
# test_script.sh - qlux-scene: surfaces and materials that a .scene has itself
# SPDX-License-Identifier: MIT
#
# Usage: tests/tools/script/test_script.sh [BUILD]
# Example: tests/tools/script/test_script.sh build

suite=tools/script
. tests/support/workspace.sh
scene=$build/qlux-scene
cam='camera eye 3 4 9 look 0 0 0 fov 40'

printf 'newmtl w\nKd 0.2 0.4 0.6\nKe 1 1 1\nnewmtl x\nKd 0.9 0.9 0.9\n' >a.mtl
printf 'mtllib a.mtl\nv 1 0 0\nv 2 0 0\nv 1 3 0\nv 1 0 4\n' >a.obj
printf 'usemtl w\nf 1 2 3\nusemtl x\nf 1 3 4\n' >>a.obj

# blob NAME LINES...: its blob in NAME.qlb, what is said in NAME.err
blob() {
    name=$1
    shift
    printf '%s\n' "$cam" "$@" >"$name.scene"
    "$scene" "$name.scene" -o "$name.qlb" --quiet --direct area 2>"$name.err"
}

# same CLAIM: one.qlb and two.qlb are one, and nothing was said of the second
same() {
    [ -s one.qlb ] && cmp one.qlb two.qlb && [ ! -s two.err ]
    say "$1" $?
    rm -f one.qlb two.qlb
}

# refused CLAIM TEXT LINE: such a line 2 is refused, by file and line
refused() {
    rm -f bad.qlb
    blob bad "$3" 'mesh a.obj' 'sky 1 1 1'
    [ $? -eq 2 ] && grep -q -F -e "qlux-scene: bad.scene:2: $2" bad.err &&
        [ ! -e bad.qlb ]
    result=$?
    say "$1" $result
    [ $result -eq 0 ] || sed 's/^/    /' bad.err
}

# ---- box, quad ----
# The cube from -1 -2 -3 to 1 2 3 by hand, fronts outside.
printf 'mtllib a.mtl\nv -1 -2 -3\nv 1 -2 -3\nv -1 2 -3\nv 1 2 -3\n' >box.obj
printf 'v -1 -2 3\nv 1 -2 3\nv -1 2 3\nv 1 2 3\nusemtl x\n' >>box.obj
printf 'f %s\n' '1 5 7 3' '2 4 8 6' '1 2 6 5' '3 7 8 4' '1 3 4 2' '5 6 8 7' \
    >>box.obj
blob one 'mesh box.obj' 'sky 1 1 1'
blob two 'material b Kd .9' 'box from -1 -2 -3 to 1 2 3 material b' 'sky 1 1 1'
same a_box_is_the_mesh_of_its_six_sides
blob two 'material b Kd .9' 'box to -1 -2 -3 from 1 2 3 material b inside' \
    'sky 1 1 1'
[ "$?" -eq 2 ] && grep -q "expected a material .*, found 'b inside'" two.err
say the_name_of_a_material_ends_its_line $?
printf 'box from 0 0 0 to 2 2 2%s\nmaterial b Ke 1 1 1\n%s\n' \
    ' inside material b' 'camera eye 1 1 1 look 2 1 1 fov 40' >in.scene
"$scene" in.scene --direct area -o in.qlb --quiet &&
    "$build/qlux-sim" in.qlb -o in.pfm \
    --spp 1 --direct none --indirect none --size 2x2 --quiet &&
    tail -c 4 in.pfm | od -An -tx1 | grep -q '00 00 80 3f'
say a_box_inside_shines_inwards $?
printf 'mtllib a.mtl\nv 0 0 0\nv 4 0 0\nv 1 1 0\nv 0 4 0\n' >quad.obj
printf 'usemtl x\nf 1 2 3 4\n' >>quad.obj
blob one 'mesh quad.obj' 'sky 1 1 1'
printf 'mtllib a.mtl\n' >lib.obj
blob two 'quad 0 0 0  4 0 0  1 1 0  0 4 0  material x # concave' \
    'mesh lib.obj' 'sky 1 1 1'
same a_quad_is_the_face_of_its_corners_also_a_concave_one
blob one 'box from 0 0 0 to 1 1 1 material g' 'material g Kd .5 .5 .5' \
    'sky 1 1 1'
blob two 'box from 0 0 0 to 1 1 1' 'smooth 95' 'sky 1 1 1'
grep -q 'smooth has no effect' two.err && : >two.err
same a_box_is_grey_without_a_material_and_never_smooth

# ---- at, turn, scale ----
# The same as awk makes it of the file: x, y, z to 3 z - 5, 2 x - 1, y.
awk '$1 == "v" { print "v", 3 * $4 - 5, 2 * $2 - 1, $3; next } { print }' \
    a.obj >placed.obj
blob one 'mesh placed.obj' 'sky 1 1 1'
blob two 'mesh a.obj at -5 -1 0 scale 2 1 3 turn 90 0 90' 'sky 1 1 1'
same a_mesh_is_scaled_turned_about_x_y_z_and_moved
blob two 'mesh a.obj turn 90 -720 -630 scale 2 1 3 at -5 -1 0 # here' \
    'sky 1 1 1'
blob one 'mesh placed.obj' 'sky 1 1 1'
same turns_beyond_a_circle_and_the_order_of_words_change_nothing
awk '$1 == "v" { print "v", -$2, $3, $4; next }
    $1 == "f" { print $1, $2, $4, $3; next } { print }' a.obj >mirror.obj
blob one 'mesh mirror.obj' 'sky 1 1 1'
blob two 'mesh a.obj scale -1 1 1' 'sky 1 1 1'
same mirrored_faces_keep_their_fronts
awk '$1 == "v" { print "v", -$2, -$3, -$4; next }
    $1 == "f" { print $1, $2, $4, $3; next } { print }' a.obj >mirror.obj
blob one 'mesh mirror.obj' 'sky 1 1 1'
blob two 'mesh a.obj scale -1' 'sky 1 1 1'
same a_scale_of_one_number_is_of_all_axes
{ cat a.obj && awk '$1 == "v" { print "v", $2 + 10, $3, $4 }
    $1 == "f" { print "f", $2 + 4, $3 + 4, $4 + 4 } $1 == "usemtl"' a.obj; } \
    >twice.obj
blob one 'mesh twice.obj' 'sky 1 1 1'
blob two 'mesh a.obj' 'mesh a.obj at 10 0 0' 'sky 1 1 1'
"$scene" --info one.qlb | grep -v -e crc -e '^materials' >one.txt
"$scene" --info two.qlb | grep -v -e crc -e '^materials' >two.txt
cmp one.txt two.txt && [ "$(sed -n 's/^triangles: //p' two.txt)" = 4 ]
say a_mesh_may_be_placed_several_times $?
printf 'curv 1\n' >>a.obj
blob two 'mesh a.obj' 'mesh a.obj at 10 0 0' 'mesh a.obj at 20 0 0' 'sky 1 1 1'
[ "$(grep -c "'curv'" two.err)" = 1 ]
say what_is_left_out_of_it_is_said_once $?
sed -i '/^curv/d' a.obj
cp a.obj 'a at 1 turn 2 # 3.obj'
blob one 'mesh a.obj at 1 2 3' 'sky 1 1 1'
blob two 'mesh a at 1 turn 2 # 3.obj at 1 2 3' 'sky 1 1 1'
same a_file_may_have_such_words_in_its_name
# Turned by odd angles: these bytes on every host.
blob odd 'mesh a.obj turn 10 20 30 scale 1.1 at .1 .2 .3' \
    'box from 0 0 0 to 1 2 3 turn -12.5 100 271' 'sky 1 1 1'
sum=$("$scene" --dump odd.qlb | grep '^v ' | cksum)
[ "$sum" = '900805995 208' ]
say turned_meshes_have_the_same_bytes_on_every_host $? "$sum"

# ---- material ----
sed 's/usemtl x/usemtl w/' a.obj >w.obj
blob one 'mesh w.obj' 'sky 1 1 1'
blob two 'mesh a.obj material w' 'sky 1 1 1'
same a_mesh_may_be_all_of_one_material
blob one 'mesh a.obj' 'sky 1 1 1'
sed '/^mtllib/d' a.obj >bare.obj
blob two 'mesh bare.obj' 'material w Ke 1 Kd 0.2 0.4 0.6' 'sky 1 1 1' \
    'material x Kd 0.9'
same a_material_of_the_scene_stands_for_its_name_in_files
printf 'mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl g\nf 1 2 3\n' >m.obj
printf 'newmtl g\nKd .1 .2 .3\nKs .4 .3 .2\nNs 77\nillum 3\nKe 0 2 1\n' >m.mtl
blob one 'mesh m.obj'
blob two 'material q  Ns 77  Ke 0 2 1 Ks .4 .3 .2  illum 3   Kd .1 .2 .3 # a' \
    'mesh m.obj material q'
same properties_of_a_line_are_those_of_a_library

# ---- up ----
awk '$1 == "v" { print "v", $2, $4, -$3; next } { print }' a.obj >turned.obj
cam='camera eye 3 4 9 look 0 0 0 fov 40'
blob one 'mesh turned.obj' 'sphere 1 3 -2 radius .5' 'sky 1 1 1'
cam='camera eye 3 -9 4 look 0 0 0 fov 40'
blob two 'mesh a.obj' 'up z' 'sphere 1 2 3 radius .5' 'sky 1 1 1'
same up_z_takes_x_y_z_to_x_z_minus_y_with_camera_and_spheres
blob one 'mesh a.obj' 'sky 1 1 1'
blob two 'up y' 'mesh a.obj' 'sky 1 1 1'
same up_y_is_the_default
cam='camera eye 0 0 9 look 0 0 0 fov 40'
blob two 'mesh a.obj' 'up z' 'sky 1 1 1'
[ $? -eq 2 ] && grep -q "two.scene:1: expected camera 'up' not par" two.err
say the_camera_has_the_up_of_the_scene $?
cam='camera eye 3 4 9 look 0 0 0 fov 40'

# ---- what is refused ----
refused a_box_needs_two_corners 'expected box from X Y Z to' 'box from 0 0 0'
refused a_flat_box_is_refused 'expected a box from X Y Z to another X, Y and' \
    'box from 0 0 0 to 1 0 1'
refused a_box_has_no_radius "expected box from X Y Z to X Y Z [inside]" \
    'box from 0 0 0 to 1 1 1 radius 3'
refused a_quad_has_four_corners 'expected four corners of three coordinates' \
    'quad 0 0 0 1 0 0 0 1 0 material x'
refused a_quad_of_no_area_is_refused 'expected four corners around an area' \
    'quad 0 0 0 1 0 0 2 0 0 3 0 0'
refused a_quad_that_crosses_itself_is_refused 'expected four corners around' \
    'quad 0 0 0 1 1 0 1 0 0 0 1.5 0'
refused a_scale_of_0_is_refused 'expected a scale that is not 0' \
    'mesh a.obj scale 1 0 1'
refused two_scales_are_refused 'expected the scale along z, found the end' \
    'mesh a.obj scale 1 2'
refused two_angles_are_refused 'expected three angles in degrees' \
    'mesh a.obj turn 1 2'
refused a_turn_of_any_size_is_refused 'expected 1e+06 degrees at most' \
    'mesh a.obj turn 1 2 1000001'
refused a_place_given_twice_is_refused "expected 'at' once, found it twice" \
    'mesh a.obj at 1 2 3 at 1 2 3'
refused words_of_no_sense_are_refused 'expected mesh FILE.obj [scale S]' \
    'mesh a.obj at 1 2 3 upside down'
refused a_place_beyond_numbers_is_refused 'expected a place where' \
    'mesh a.obj scale 1e299 at 9e299 0 0'
refused up_x_is_refused 'expected up y or up z' 'up x'
refused a_material_needs_a_name 'expected material NAME [Kd R G B]' 'material'
refused an_unknown_property_is_refused \
    "expected Kd, Ks, Ns, Ke, illum, Ni or Tf of 'm', found 'Kx'" \
    'material m Kx 1'
refused a_property_needs_numbers \
    "expected numbers for Kd of 'm', found 'Ks 1" 'material m Kd Ks 1 1 1'
refused two_numbers_are_no_colour "expected a colour for Kd of 'm', found" \
    'material m Kd 1 1 Ns 3'
refused four_numbers_are_no_colour "expected the end of the line, found '4'" \
    'material m Kd 1 1 1 4 Ns 3'
refused a_property_twice_is_refused "expected one Kd of 'm', found a second" \
    'material m Kd 1 1 1 Kd 1 1 1'
refused an_illum_of_letters_is_refused \
    "expected numbers for illum of 'm', found 'two'" 'material m illum two'
blob bad 'material m Kd 1' 'material m Kd 1' 'mesh a.obj'
grep -q "bad.scene:3: expected one material 'm' in a scene, found a" bad.err
say a_material_twice_is_refused $?

exit $((failures > 0))
