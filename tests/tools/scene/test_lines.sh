#!/bin/sh
# test_lines.sh - qlux-scene: errors and warnings name the line they are about
# SPDX-License-Identifier: MIT
#
# Usage: tests/tools/scene/test_lines.sh [BUILD]
# Example: tests/tools/scene/test_lines.sh build

suite=tools/lines
. tests/support/workspace.sh
scene=$build/qlux-scene
tab=$(printf '\t')

# A scene that is as it should be.
reset_input() {
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nmtllib a.mtl\nusemtl w\nf 1 2 3\n' >a.obj
    printf 'newmtl w\nKd 0.5 0.5 0.5\nKe 1 1 1\n' >a.mtl
    printf 'mesh a.obj\ncamera eye 0 0 5 look 0 0 0 fov 40\n' >a.scene
    printf 'dims 1 cells 3 1 2 3\n' >a.table
}

# before WORDS | WORDS: eight lines, of which two are one: the only ones that
# say anything. A comment is not continued.
before() {
    printf '%s\n' '' '# one' " $tab" "$tab# two \\" "${1% | *} \\" "${1#* | }" \
        '' '#'
}

# names CLAIM FILE LINE TEXT: what the three kinds of line ends, and a mark of
# the byte order, give. The file is in lf.txt; what is said goes to stderr.
names() {
    bad=
    for ends in lf crlf cr mark; do
        case $ends in
        lf) cat lf.txt ;;
        crlf) sed 's/$/\r/' lf.txt ;;
        cr) tr '\n' '\r' <lf.txt ;;
        mark) printf '\357\273\277' && cat lf.txt ;;
        esac >"$2"
        "$scene" a.scene -o out.qlb --quiet >out.txt 2>err.txt
        grep -q -e "^qlux-scene: $2:$3: $4" \
            -e "^qlux-scene: warning: $2:$3: $4" err.txt || bad="$bad $ends"
    done
    [ -z "$bad" ] || cat err.txt >&2
    [ -z "$bad" ]
    say "$1" $? "$bad"
    reset_input
}

# Each reader: what is claimed of which file; what stands before, what is wrong
# in lines 9 and 10; what follows, and what is said.
reset_input
while read -r claim file && IFS=@ read -r good wrong &&
        IFS=@ read -r after text; do
    { before "$good" && printf '%s \\\n%s\n' "${wrong% | *}" "${wrong#* | }" &&
        printf "$after\\n"; } >lf.txt
    [ "$file" != a.table ] || printf 'table a.table\n' >>a.scene
    names "$claim" "$file" 9 "$text"
done <<'END'
a_corner_has_its_line a.obj
v 0 0 | 0@f 1 2 | x
v 1 0 0@expected a corner
a_vertex_that_never_comes_has_its_line a.obj
v 0 0 | 0@f 1 1 | 9
v 1 0 0\nf 1 2 1@expected a vertex from 1 to 2, found 9
the_furthest_vertex_ahead_has_its_line a.obj
f 1 1 | 5@f 1 1 | 9
v 1 0 0\nv 0 1 0@expected a vertex from 1 to 2, found 9
a_coordinate_has_its_line a.obj
v 0 0 | 0@v 0 | 0
v 1 0 0@expected three coordinates
a_missing_library_has_its_line a.obj
v 0 0 | 0@mtllib | none.mtl
v 1 0 0@cannot read 'none.mtl'
a_normal_has_its_line a.obj
v 0 0 | 0@vn 0 | nan 1
v 1 0 0@expected vn
an_unknown_key_of_a_mesh_has_its_line a.obj
v 0 0 | 0@curv 0 | 1
v 1 0 0@'curv'
a_colour_has_its_line a.mtl
newmtl | w@Kd 1 | red 1
Ke 1 1 1@expected a colour
a_clamped_colour_has_its_line a.mtl
newmtl | w@Kd 2 | 0 0
Ke 1 1 1@Kd of 'w' clamped
a_clamped_exponent_has_its_line a.mtl
newmtl | w@Ns | -1
Ke 1 1 1@Ns of 'w' clamped
an_index_of_glass_has_its_line a.mtl
newmtl | w@Ni | 65
Kd 1\nillum 7\nnewmtl x\nKd 1@expected a Ni
an_exposure_has_its_line a.scene
mesh | a.obj@exposure | 100
image 4 4@expected an exposure
a_key_of_a_scene_has_its_line a.scene
mesh | a.obj@toast | 3
image 4 4@expected mesh
a_second_camera_has_its_line a.scene
camera eye 0 0 5 look 0 0 0 | fov 40@camera eye 0 0 5 | look 0 0 0 fov 40
image 4 4@expected one 'camera'
a_camera_too_far_has_its_line a.scene
mesh | a.obj@camera eye 0 0 1000 look 0 0 2000 | fov 40
image 4 4@expected an eye beside
a_lens_too_wide_has_its_line a.scene
mesh | a.obj@lens radius 257 | focus 1
camera eye 0 0 5 look 0 0 0 fov 40@expected a lens
the_material_of_a_sphere_has_its_line a.scene
mesh | a.obj@sphere 0 0 0 radius 1 | material nix
camera eye 0 0 5 look 0 0 0 fov 40@expected a material
a_missing_mesh_has_its_line a.scene
image 4 | 4@mesh | none.obj
camera eye 0 0 5 look 0 0 0 fov 40@cannot read
a_missing_sky_has_its_line a.scene
mesh | a.obj@sky | none.pfm
image 4 4@cannot read the sky
a_weight_has_its_line a.table
dims 1 cells | 3 1@-1 | 2
\n# end@expected a weight of 0 or more
the_cells_of_a_table_have_their_line a.table
 | @dims 1 cells | 0
1@expected the cells
a_word_after_the_weights_has_its_line a.table
dims 1 cells | 3 1 2 3@4 | 5
@expected 3 weights, found '4' too
END

# What is missing is missed at the end.
{ before 'mesh | a.obj' && printf '#\n\n'; } >lf.txt
names what_is_missing_at_the_end_has_a_line a.scene 10 "expected a 'camera'"

# A dump begins with its own line; its second one has the features.
"$scene" a.scene -o a.qlb --quiet && "$scene" --dump a.qlb >dump.txt || exit 3
spread() { # LINES...: such a dump, and these instead of its depth
    head -n 1 dump.txt && before 'features node16 | lights' &&
        printf '%s\n' "$@" && sed 1,3d dump.txt
}
spread 'depth \' -1 >lf.txt
names a_number_of_a_dump_has_its_line a.scene 10 'expected the depth'
spread 'toast \' 1 >lf.txt
names a_key_of_a_dump_has_its_line a.scene 10 'expected a key'
spread 'depth \' 0 >lf.txt
"$scene" lf.txt -o b.qlb --quiet && cmp -s a.qlb b.qlb
say blanks_comments_and_continued_lines_change_no_dump $?

exit $((failures > 0))
