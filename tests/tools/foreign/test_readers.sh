#!/bin/sh
# test_readers.sh - qlux-scene: OBJ and MTL files as other programs write them
# SPDX-License-Identifier: MIT
#
# Usage: tests/tools/foreign/test_readers.sh [BUILD]
# Example: tests/tools/foreign/test_readers.sh build

suite=tools/readers
. tests/support/workspace.sh
scene=$build/qlux-scene

# obj LINES: a mesh of four vertices and these lines, from line 5 on
obj() {
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n' >a.obj
    printf "$1" >>a.obj
}

# mtl LINES: its materials, if it has "mtllib a.mtl"
mtl() {
    printf "$1" >a.mtl
}

# A scene with another light than the mesh's; its mesh is as it should be.
reset_input() {
    printf 'mesh a.obj\nsky 1 1 1\n' >a.scene
    printf 'camera eye 0 0 5 look 0 0 0 fov 40\n' >>a.scene
    mtl 'newmtl w\nKd 0.5\n'
    obj 'mtllib a.mtl\nusemtl w\nf 1 2 3\n'
}

# What is said goes to err.txt, the triangles to out.txt.
compile() {
    "$scene" a.scene -o out.qlb --quiet 2>err.txt &&
        "$scene" --info out.qlb | sed -n 's/^triangles: //p' >out.txt
}

# Is it what comes on stdin, but for the name of the program? A line that begins
# with four blanks goes on where the one before ends.
is_said() {
    awk 'NR > 1 && !/^    / { print line; line = "" }
        { sub(/^   /, ""); line = line $0 }
        END { if (NR > 0) print line }' >wanted.txt
    sed 's/^qlux-scene: warning: //; s/^qlux-scene: //' err.txt >said.txt
    diff wanted.txt said.txt >diff.txt
}

# takes CLAIM TRIANGLES: so many, and all that is said comes on stdin
takes() {
    is_same=1
    compile && [ "$(cat out.txt)" = "$2" ] && is_said && is_same=0
    say "$1" $is_same
    [ $is_same -eq 0 ] || cat err.txt diff.txt >&2
    reset_input
}

# refuses CLAIM: exit 2, nothing written, and what is said comes on stdin
refuses() {
    rm -f out.qlb
    "$scene" a.scene -o out.qlb --quiet 2>err.txt
    [ $? -eq 2 ] && is_said && [ ! -e out.qlb ]
    result=$?
    say "$1" $result
    [ $result -eq 0 ] || cat err.txt diff.txt >&2
    reset_input
}

# kds: the reds of the materials in use, in the order of their definition
kds() {
    "$scene" --dump out.qlb | sed -n 's/^m 0x\([0-9a-f]*\).*/\1/p' |
        tr '\n' ' '
}

# are CLAIM REDS: those of the materials, and nothing is said
are() {
    compile && [ ! -s err.txt ] && [ "$(kds)" = "$2 " ]
    say "$1" $? "$(kds)"
    reset_input
}
reset_input
takes what_is_as_it_should_be_is_silent 1 <<'END'
END

# ---- zero bytes ----
obj 'f 1 2 3\n\n\0\n'
takes a_zero_byte_at_the_end_is_a_blank 1 <<'END'
a.obj:7: zero bytes are blanks here
END
obj 'f 1 2 3\0\0\nf 2 3 4\0'
takes zero_bytes_end_lines 2 <<'END'
a.obj:5: zero bytes are blanks here (3 times)
END
obj '# a\0b\r\nf 1 2 3\r\nmtllib a.mtl\r\nusemtl w\r\nf\0 2 3 4'
mtl 'newmtl w\0\0\nKd \0001\n'
takes zero_bytes_of_comments_and_names 2 <<'END'
a.mtl:1: zero bytes are blanks here (3 times)
a.obj:5: zero bytes are blanks here (2 times)
END
obj 'f 1 2 3\nv 1 1\0001 2\n'
refuses a_zero_byte_inside_a_number_is_refused <<'END'
a.obj:6: byte 45 is zero inside a word; expected a text file
END

# ---- names ----
obj 'f 1 2 3\nusemtl\nf 2 3 4\nusemtl\n'
takes usemtl_without_a_name_is_grey 2 <<'END'
a.obj:6: usemtl without a name is the newmtl without one, or grey 0.5 (2 times)
END
obj 'mtllib a.mtl\nusemtl\nf 1 2 3\nusemtl w\nf 2 3 4\n'
mtl 'newmtl\nKd 0.25\nnewmtl w\nKd 0.125\n'
compile && [ "$(kds)" = '20000000 10000000 ' ]
say usemtl_without_a_name_finds_newmtl_without_one $?
is_said <<'END'
a.mtl:1: newmtl without a name is what usemtl without one uses
a.obj:6: usemtl without a name is the newmtl without one, or grey 0.5
END
say both_are_said $?
obj 'mtllib\nf 1 2 3\n'
takes mtllib_without_a_name_is_none 1 <<'END'
a.obj:5: mtllib without a name names no materials
END
obj 'mtllib ./\nf 1 2 3\n'
takes a_folder_is_no_library 1 <<'END'
a.obj:5: cannot read './'; its materials are grey 0.5
END
use='mtllib a.mtl\nusemtl Material #1\nf 1 2 3\nusemtl Material #2\nf 2 3 4\n'
obj "$use"
mtl 'newmtl Material #1\nKd 0.25\nnewmtl Material #2\nKd 0.125\n'
are names_that_differ_behind_a_hash_are_two '20000000 10000000'
obj "$use"
mtl 'newmtl Material\nKd 0.25\nnewmtl Material #2\nKd 0.125\n'
takes a_name_with_a_number_is_not_the_one_without 2 <<'END'
a.obj:6: material 'Material #1' is not defined: grey 0.5
END
obj 'mtllib a.mtl\nusemtl #1\nf 1 2 3\nusemtl #\nf 2 3 4\nusemtl a#b\nf 1 2 4\n'
mtl 'newmtl #1\nKd 0.25\nnewmtl #\nKd 0.125\nnewmtl a#b\nKd 0.5\n'
are names_may_begin_with_a_hash '20000000 10000000 40000000'
obj 'mtllib a.mtl # all\nusemtl w # this\nf 1 2 3 # one\nusemtl x\nf 2 3 4\n'
mtl 'newmtl w\nKd 0.25 # red\nnewmtl x # that\nKd 0.125\n'
are comments_behind_names_are_none '20000000 10000000'
mv a.mtl '#1 b.mtl'
mv a.obj 'a #2.obj'
sed 's/a.mtl/#1 b.mtl/; s/^f 1/f 4/' 'a #2.obj' >'#3.obj'
printf 'mesh a #2.obj\nmesh #3.obj # c\n' >a.scene
printf 'sky 1 1 1\ncamera eye 0 0 5 look 0 0 0 fov 40\n' >>a.scene
takes files_may_have_a_hash_in_their_names 2 <<'END'
a #2.obj:5: cannot read 'a.mtl'; its materials are grey 0.5
a #2.obj:6: material 'w' is not defined: grey 0.5
END
for name in 'a #1' 'a #2 # a comment' 'a #3 #comment' 'a #4' 'b'; do
    printf 'sphere 0 0 0 radius 1 material %s\n' "$name" >>a.scene
done
mtl 'newmtl a #1\nKd 0.25\nnewmtl a #2\nKd 0.5\nnewmtl a #3 #comment\nKd 0.125\n
newmtl a\nKd 1\nnewmtl b # red\nKd 0.0625\n'
obj 'mtllib a.mtl\nf 1 2 3\n'
are spheres_find_names_with_a_hash \
    '20000000 40000000 10000000 80000000 08000000 40000000'

# ---- corners ----
obj 'f 1/0/0 2/1/0 3//0\nf 1/0 2/-0 4\n'
takes index_0_is_a_missing_vt_or_vn 2 <<'END'
a.obj:5: index 0 of a vt or vn is taken for a missing one (6 times)
END
for f in '0 1 2' '1/x/0 2 3' '1/1/x 2 3' '1/1/1/0 2 3' '0/0/0 1 2'; do
    obj "f 1 2 3\nf $f\n"
    refuses "but_f_${f}_is_refused" <<END
a.obj:6: expected a corner like 1, 1/2, 1//3 or 1/2/3 with no vertex 0, found
    '${f%% *}'
END
done
obj 'f 1\nf 1 2\nf 1 2 3\nf\nf 3/1 4/1\n'
takes faces_of_fewer_corners_are_dropped 1 <<'END'
a.obj:5: a face of fewer than three corners is dropped (4 times)
END
obj 'f 1 2 3\nf 1 9\n'
refuses a_vertex_out_of_range_is_one_in_a_line_too <<'END'
a.obj:6: a face of fewer than three corners is dropped
a.obj:6: expected a vertex from 1 to 4, found 9
END
obj 'vn 0 0 1\nf 1//1 2//2 3//1\nf 1//2 2//2 4//3\n'
takes missing_normals_have_a_line_and_a_count 2 <<'END'
a.obj:6: corners name normals that are not there: the face is flat (2 times)
END

# ---- vertices ----
for word in nan NaN -nan inf -inf +Infinity 'nan(ind)' 1.#QNAN -1.#IND 1.#INF \
    1e999 -1e301; do
    obj "v 1 $word 0\nv 1 1 0\nf 1 2 6 3\nf 1 2 5\nf 3 4 -2\nf 2 3 4\n"
    takes "a_vertex_of_${word}_takes_its_faces_away" 3 <<'END'
a.obj:5: a vertex of no finite numbers is dropped with the faces that use it
a.obj:8: a face of a vertex of no finite numbers is dropped (2 times)
END
done
obj 'f 1 2 3 5\nf 2 3 4\nv 0 0 nan\nv nan nan nan\nf 1 2 4 3\n'
takes a_polygon_goes_as_a_whole_even_before_its_vertex 3 <<'END'
a.obj:7: a vertex of no finite numbers is dropped with the faces that use it (2
    times)
a.obj:5: a face of a vertex of no finite numbers is dropped
a.obj:9: a face is bent by more than 20 degrees: other programs may fold it the
    other way
END
obj 'f 1 2 3 5\nv inf 0 0\n'
takes a_mesh_may_lose_all_its_faces 0 <<'END'
a.obj:6: a vertex of no finite numbers is dropped with the faces that use it
a.obj:5: a face of a vertex of no finite numbers is dropped
END
for word in none nano 1.5x 0x10 1,5; do
    obj "f 1 2 3\nv 0 $word 0\n"
    refuses "a_vertex_of_${word}_is_refused" <<END
a.obj:6: expected three coordinates, found '$word'
END
done
obj 'v 1 1 1 1 0 0\nv 2 1 1 0.5\nv 1 2 1 1 0 0 1\nf 1 2 3\n'
takes colours_of_vertices_are_left_out_once 1 <<'END'
a.obj:5: colours of vertices are not modelled: the Kd of the material is used
    (2 times)
END

# ---- continued lines ----
obj 'f 1 \\ \n 2 \\\t \r\n 3\nf 2 3 \\\n 4\n'
takes blanks_behind_a_backslash_continue_a_line 2 <<'END'
a.obj:5: a backslash with blanks behind it continues the line (2 times)
END
obj 'f 1 2 \\ 3\n'
refuses a_backslash_inside_a_line_is_refused <<'END'
a.obj:5: expected a corner like 1, 1/2, 1//3 or 1/2/3 with no vertex 0, found
    '\'
END

# ---- properties ----
mtl 'Ka 0 0 0\nillum 2\nmap_Kd x.png\nnewmtl w\nKd 0.25\n'
takes properties_before_newmtl_are_left_out 1 <<'END'
a.mtl:1: a property before the first newmtl is of no material: left out (3
    times)
END
mtl 'newmtl w\nKd 0.25\nKd red\nKd nan nan nan\nKd 1 0\nKs\nKe 1 1 x
Tf spectral a
Ka 1 none 1\nNs shiny\nNi -nan\nillum 2.5\nillum 11\nd opaque\nTr\nKe inf\n'
compile && [ "$(kds)" = '20000000 ' ] &&
    "$scene" --info out.qlb | grep -q '^lights: 1$'
say what_is_no_number_leaves_a_property_as_it_was $?
is_said <<'END'
a.mtl:3: expected a colour for Kd of 'w', found 'red': left out
a.mtl:4: expected a colour for Kd of 'w', found 'nan nan nan': left out
a.mtl:5: expected a colour for Kd of 'w', found '1 0': left out
a.mtl:6: expected a colour for Ks of 'w', found '': left out
a.mtl:7: expected a colour for Ke of 'w', found '1 1 x': left out
a.mtl:8: expected a colour for Tf of 'w', found 'spectral a': left out
a.mtl:9: expected a colour for Ka of 'w', found '1 none 1': left out
a.mtl:10: expected a number for Ns of 'w', found 'shiny': left out
a.mtl:11: expected a number for Ni of 'w', found '-nan': left out
a.mtl:12: expected an integer from 0 to 10 for illum of 'w', found '2.5': left
    out
a.mtl:13: properties of no numbers: 4 more from this line on
END
say ten_of_them_are_said_and_the_rest_is_counted $? "$(cat diff.txt)"
reset_input
for key in Kd Ks Ke; do
    mtl "newmtl w\n$key xyz 1 1 1\n"
    refuses "a_${key}_of_another_space_is_refused" <<END
a.mtl:2: expected a colour for $key as RGB numbers, found 'xyz 1 1 1'
END
done

# ---- what is done instead ----
mtl 'newmtl w\nd 0.5\nnewmtl x\nTr 1\nd -halo 0.25\nillum 7\nnewmtl y\nTf 0.5\n
newmtl z\nd 1.0\nTr 0\nTf 1 1 1\n'
takes opacity_says_what_is_done_instead 1 <<'END'
a.mtl:2: 'd' of 'w' is not modelled: opaque; illum 7 makes it glass
a.mtl:5: 'd' of 'x' is not modelled: glass of Ni and Tf
a.mtl:8: 'Tf' of 'y' is not modelled: opaque; illum 7 makes it glass
END
mtl 'newmtl a\nillum 4\nnewmtl b\nillum 6\nnewmtl c\nillum 9\nnewmtl d\nillum 8
newmtl e\nillum 10\nnewmtl f\nillum 5\nnewmtl g\nillum 2.0\nnewmtl w\n'
takes illuminations_say_what_is_done_instead 1 <<'END'
a.mtl:2: 'illum 4' of 'a' is not modelled: opaque; illum 7 makes it glass
a.mtl:4: 'illum 6' of 'b' is not modelled: opaque; illum 7 makes it glass
a.mtl:6: 'illum 9' of 'c' is not modelled: opaque; illum 7 makes it glass
a.mtl:8: 'illum 8' of 'd' is not modelled: as illum 2; illum 3 makes it a mirror
a.mtl:10: 'illum 10' of 'e' is not modelled: as illum 2
END
mtl 'newmtl w\nmap_Kd a.png\nKd 0 0 0\nnewmtl b\nKd 0.5 1 0\nMAP_KD a #2.png
newmtl c\nmap_Kd a.png\nnewmtl d\nKd 0\nKs 1\nNs 9\nmap_Kd a.png
newmtl e\nKd 0\nKe 1\nmap_Kd a.png\nmap_Ke b.png
newmtl f\nKd 0\nmap_Kd c.png\nillum 7\nmap_Ke b.png\n'
takes a_map_says_which_colour_stands_for_it 1 <<'END'
a.mtl:2: 'map_Kd' of 'w' is not modelled and its Kd is 0: the object is black
a.mtl:6: 'map_Kd' of 'b' is not modelled: Kd 0.5 1 0 is used
a.mtl:8: 'map_Kd' of 'c' is not modelled: Kd 0.5 0.5 0.5 is used
a.mtl:13: 'map_Kd' of 'd' is not modelled and its Kd is 0: it has no diffuse
    colour
a.mtl:17: 'map_Kd' of 'e' is not modelled and its Kd is 0: it has no diffuse
    colour
a.mtl:21: 'map_Kd' of 'f' is not modelled: glass has no Kd
a.mtl:18: 'map_Ke' of 'e' is not modelled: Ke is used
a.mtl:23: 'map_Ke' of 'f' is not modelled and its Ke is 0: it does not shine
END
mtl 'newmtl w\nmap_Ks a.png\nmap_d a.png\nmap_Bump -bm 2 a.png\nbump a.png
Pr 0.5\nPm 1\nPr 0.5\n'
takes other_maps_and_keys_do_too 1 <<'END'
a.mtl:2: 'map_Ks' of 'w' is not modelled: Ks is used
a.mtl:3: 'map_d' of 'w' is not modelled: opaque; illum 7 makes it glass
a.mtl:4: 'map_Bump' of 'w' is not modelled: it has no bumps
a.mtl:5: 'bump' of 'w' is not modelled: it has no bumps
a.mtl:6: 'Pr' of 'w' is not modelled: left out (2 times)
a.mtl:7: 'Pm' of 'w' is not modelled: left out
END
awk 'BEGIN { for (i = 1; i <= 30; i++)
    print "newmtl m" i "\nd 0.5\nillum 4" }' >a.mtl
awk 'BEGIN { for (i = 1; i <= 12; i++) print "usemtl u" i "\nf 1 2 3" }' >u.txt
{ printf 'newmtl w\n' && cat a.mtl; } >b.mtl && mv b.mtl a.mtl
cat u.txt >>a.obj
compile
[ "$(grep -c "'d' of" err.txt) $(grep -c "'illum 4' of" err.txt)" = '10 10' ] &&
    grep -q 'a.mtl:33: d: 20 more from this line on' err.txt &&
    grep -q 'a.mtl:34: illum: 20 more from this line on' err.txt
say ten_lines_of_a_kind_then_a_count $?
[ "$(grep -c 'is not defined' err.txt)" = 10 ] &&
    grep -q 'a.obj:28: materials that are not defined: 2 more' err.txt
say ten_names_without_a_material_then_a_count $?
reset_input

# ---- what is no mesh ----
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\np 1 2 3\n' >a.obj
refuses a_cloud_of_points_is_refused <<'END'
a.obj:4: 'p' is not modelled: left out
a.obj:4: expected a face before the end of the file, found a cloud of 3 points
END
nothing='expected v and f, or mtllib, before the end of the file, found
    nothing of a mesh'
: >a.obj
refuses an_empty_file_is_no_mesh <<END
a.obj:0: $nothing
END
printf '# nothing\n\n' >a.obj
refuses a_comment_is_no_mesh <<END
a.obj:2: $nothing
END
convert='expected OBJ or MTL; Blender or MeshLab converts meshes'
# other FORMAT BYTES: such a file is no mesh
other() {
    printf "$2" >a.obj
    refuses "$(printf %s "$1" | tr ' ' _)_is_refused_by_name" <<END
a.obj: this is $1; $convert
END
}
other 'a PLY mesh' 'ply\r\nformat binary_little_endian 1.0\n\0\0'
other 'an STL mesh' 'solid cube\n facet normal 0 0 1\n'
other 'an STL mesh' ' SOLID\n'
other 'an STL mesh' "$(printf '%080d' 0)\0\0\0\0"
other 'an STL mesh' "$(printf '%080d' 0)\1\0\0\0$(printf '%50s' x)"
other 'an OFF mesh' 'OFF\n3 1 0\n'
other 'a glTF mesh' 'glTF\2\0\0\0'
printf '\377\376v\0 \0001\0' >a.obj
refuses utf_16_is_refused_by_name <<'END'
a.obj: this is text in UTF-16; expected OBJ or MTL; save it as UTF-8
END
printf 'solidus 1\nplywood 2\nmtllib a.mtl\n' >a.obj
takes words_that_only_begin_so_are_keys 0 <<'END'
a.obj:1: 'solidus' is not modelled: left out
a.obj:2: 'plywood' is not modelled: left out
END

# ---- what is lost on the grid ----
# A tunnel of faces 1 wide and 400 long; in its middle a thing of 0.001.
awk 'BEGIN { for (z = -200; z < 200; z++)
        printf "v 0 0 %d\nv 1 0 %d\nv 0 0 %d\nf -3 -2 -1\n", z, z, z + 1 }' \
    >tunnel.obj
printf 'v 0 0.1 0\nv 0.001 0.1 0\nv 0 0.101 0\nf 1 2 3\n' >thing.obj
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >plate.obj
scene_of() { # MESH...
    printf 'mesh %s\n' "$@" >a.scene
    printf 'sky 1 1 1\ncamera eye 0 0 5 look 0 0 0 fov 40\n' >>a.scene
}
scene_of thing.obj plate.obj tunnel.obj
takes what_is_lost_names_the_mesh_that_makes_it_so 401 <<'END'
tunnel.obj alone makes the scene 400 wide, which is 1 without it
dropped 1 faces smaller than the grid, 0.0122 units wide, because the scene
    is 400 wide (tunnel.obj)
END
scene_of thing.obj plate.obj
takes a_scene_without_it_loses_nothing 2 <<'END'
plate.obj alone makes the scene 1 wide, which is 0.001 without it
END
# The cut of tools/README.md, with corners counted from the first.
awk '$1 == "v" { n++ } $1 == "f" {
    $0 = "f " n + 1 + $2 " " n + 1 + $3 " " n + 1 + $4 } { print }' \
    tunnel.obj >long.obj
cut=$(sed -n '/^    awk /,/near.obj$/s/^    //p' "$root/tools/README.md")
[ -n "$cut" ] && sh -c "$cut" &&
    [ "$(grep -c ^f near.obj) $(grep -c ^v near.obj)" = '40 1200' ]
say the_cut_of_the_readme_keeps_the_faces_within $?
scene_of thing.obj near.obj
printf 'sphere 0 0 0 radius 3 material w\nmesh lib.obj\n' >>a.scene
echo 'mtllib a.mtl' >lib.obj
takes seven_times_as_wide_is_not_named 41 <<'END'
END
reset_input

# ---- no light ----
sed -i /sky/d a.scene
takes a_scene_without_light_says_that_it_is_black 1 <<'END'
a.scene: no surface has a Ke and there is no sky: the picture is black
END

exit $((failures > 0))
