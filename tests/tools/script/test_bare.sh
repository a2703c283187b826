#!/bin/sh
# test_bare.sh - qlux-scene: an OBJ alone becomes a picture
# SPDX-License-Identifier: MIT
#
# Usage: tests/tools/script/test_bare.sh [BUILD]
# Example: tests/tools/script/test_bare.sh build

suite=tools/bare
. tests/support/workspace.sh
scene=$build/qlux-scene

# What auto is takes time to find out, and is not what is tested here.
compile() {
    "$scene" "$@" --direct area
}

# box NAME LOW HIGH SIDES [inside]: a box from "X Y Z" to "X Y Z", without the
# sides that are not among -x +x -y +y -z +z; fronts outside or inside
box() {
    echo "$2 $3 $5" | awk -v sides="$4" '
        {
            for (i = 0; i < 8; i++)
                printf("v %.9g %.9g %.9g\n", i % 2 ? $4 : $1,
                    int(i / 2) % 2 ? $5 : $2, i >= 4 ? $6 : $3)
            split("-x,+x,-y,+y,-z,+z", name, ",")
            split("1 5 7 3,2 4 8 6,1 2 6 5,3 7 8 4,1 3 4 2,5 6 8 7", f, ",")
            for (i = 1; i <= 6; i++) {
                if (index(sides, name[i]) == 0) continue
                split(f[i], c, " ")
                print("f " ($7 == "inside" ? c[4] " " c[3] " " c[2] " " c[1] \
                    : f[i]))
            }
        }' >"$1.obj"
}
all='-x +x -y +y -z +z'

# shine FILE: all of it is a lamp
shine() {
    { printf 'mtllib l.mtl\nusemtl lamp\n' && cat "$1"; } >t && mv t "$1"
}
printf 'newmtl lamp\nKd 0\nKe 1\n' >l.mtl

# ---- all of it is in sight ----
# in_sight CLAIM FILE [OPTIONS]: what shines comes near two opposite sides of
# the picture at least, and to none
in_sight() {
    claim=$1 file=$2
    shift 2
    compile "$file" -o a.qlb "$@" 2>a.err &&
        "$build/qlux-sim" a.qlb -o a.ppm --spp 16 --size 64x64 --quiet \
            --direct none --indirect none
    note=$(tail -c 12288 a.ppm | od -An -v -tu1 -w3 | awk '
        BEGIN { left = top = 64; right = bottom = -1 }
        $1 > 20 {
            x = (NR - 1) % 64
            y = int((NR - 1) / 64)
            if (x < left) left = x
            if (x > right) right = x
            if (y < top) top = y
            if (y > bottom) bottom = y
        }
        END {
            print left, 63 - right, top, 63 - bottom
            wide = left >= 1 && left <= 4 && right <= 62 && right >= 59
            tall = top >= 1 && top <= 4 && bottom <= 62 && bottom >= 59
            exit !(left >= 1 && top >= 1 && right <= 62 && bottom <= 62 &&
                right >= 0 && (wide || tall))
        }')
    say "$claim" $? "$note"
}
box cube '-1 -1 -1' '1 1 1' "$all" && shine cube.obj
in_sight a_cube_is_in_sight cube.obj --quiet
box tall '3 -5 2' '4 9 3' "$all" && shine tall.obj
in_sight a_tower_is_in_sight tall.obj --quiet
box wide '-20 0 0' '0 1 1' "$all" && shine wide.obj
in_sight a_wall_is_in_sight wide.obj --quiet
box deep '0 0 -90' '1 1 0' "$all" && shine deep.obj
in_sight a_corridor_is_in_sight deep.obj --quiet
box tiny '1e-7 0 0' '2e-7 1e-7 1e-7' "$all" && shine tiny.obj
in_sight what_is_tiny_is_in_sight tiny.obj --quiet
box away '1000000 2000000 0' '1000001 2000001 1' "$all" && shine away.obj
in_sight what_is_far_away_is_in_sight away.obj --quiet
box flat '0 0 0' '9 1e-9 9' '+y' && shine flat.obj
in_sight what_is_flat_is_in_sight flat.obj --quiet
in_sight what_stands_on_a_floor_is_in_sight cube.obj --quiet --floor
in_sight what_has_z_up_is_in_sight tall.obj --quiet --up z

# ---- the scene that it stands for ----
# written CLAIM FILE SCENE [OPTIONS]: the scene written gives the same bytes
written() {
    claim=$1 file=$2 script=$3
    shift 3
    compile "$file" -o a.qlb "$@" --write-scene "$script" >a.out 2>a.err &&
        compile "$script" -o b.qlb --quiet 2>b.err && cmp a.qlb b.qlb &&
        sed -n 's/^    //p' a.err | cmp - "$script"
    say "$claim" $?
}
mkdir there
box pot '-1 -1 -1' '1 1.23456789 1' "$all"
written the_scene_written_gives_the_same_bytes pot.obj pot.scene
written also_on_a_floor_with_z_up pot.obj pot.scene --floor --up z
written also_in_another_folder pot.obj there/pot.scene --floor
cp pot.obj there/in.obj
written also_of_a_file_in_another_folder there/in.obj in.scene
written also_beside_it there/in.obj there/in.scene
grep -q '^mesh in.obj$' there/in.scene
say it_names_a_file_beside_it_by_its_name $?
cp pot.obj 'a pot # at 1 2.obj'
written a_name_may_have_blanks_and_hashes 'a pot # at 1 2.obj' pot.scene
cp pot.obj pot.txt
compile pot.obj -o a.qlb --quiet && compile pot.txt -o b.qlb --quiet &&
    cmp a.qlb b.qlb
say an_obj_is_known_by_its_text $?
compile pot.obj -o a.qlb --quiet >a.out 2>a.err && [ ! -s a.err ]
say quiet_prints_no_scene $?
awk '$1 == "v" { print "v", $2, -$4, $3; next } { print }' pot.obj >z.obj
compile pot.obj -o a.qlb --quiet --floor &&
    compile z.obj -o b.qlb --quiet --floor --up z && cmp a.qlb b.qlb
say z_up_is_the_same_picture $?

# ---- light and floor ----
has() { # CLAIM TEXT...: the scene written has lines like these, "!" it has not
    claim=$1 bad=
    shift
    for line; do
        case $line in
        !*) grep -q -e "${line#!}" a.scene && bad="$bad $line" ;;
        *) grep -q -e "$line" a.scene || bad="$bad no $line" ;;
        esac
    done
    [ -z "$bad" ] || cat a.scene >&2
    [ -z "$bad" ]
    say "$claim" $? "$bad"
}
describe() { # FILE [OPTIONS]
    rm -f a.scene
    compile "$@" -o a.qlb --quiet --write-scene a.scene 2>a.err
}
describe pot.obj --floor
has an_object_that_does_not_shine_has_a_sky_and_a_lamp '^sky 0.35' \
    '^material key-light .*Ke' '^quad  -4.*-1 .*floor$' 'right and above'
describe cube.obj
has what_shines_has_neither '!sky' '!key-light' '!quad'
box deeper '0 -1.23456789 0' '1 0 1' "$all"
describe deeper.obj --floor
low=$(sed -n 's/^quad  *[^ ]* \([^ ]*\) .*floor$/\1/p' a.scene)
awk -v y="$low" 'BEGIN { exit !(y <= -1.23456789 && y > -1.2347) }'
say a_floor_is_at_the_lowest_point_or_just_below $? "$low"

# ---- rooms ----
for side in '+z front' '-z back' '+x right' '-x left'; do
    open=${side% *} name=${side#* }
    box room '0 0 0' '4 3 4' "$(echo "$all" | sed "s/$open//")" inside
    describe room.obj
    has "a_room_open_to_its_${name}_is_seen_from_there" \
        "into its open $name" '^sky 0.7 0.8 0.9' '!key-light'
done
box room '0 0 0' '4 3 6' "$all" inside
describe room.obj
has a_dark_closed_one_is_an_object_inside_out 'right and above'
printf 'v 1 2.9 1\nv 2 2.9 1\nv 2 2.9 2\n' >>room.obj
printf 'mtllib l.mtl\nusemtl lamp\nf -3 -2 -1\n' >>room.obj
describe room.obj
has a_closed_one_with_a_lamp_is_seen_from_inside 'from inside' \
    '^camera eye 2 1.5 5.625  look 2 1.5 3  fov 75'

# ---- what is refused ----
refused() { # CLAIM CODE TEXT ARGUMENTS
    claim=$1 code=$2 text=$3
    shift 3
    "$scene" "$@" -o no.qlb >a.out 2>a.err
    [ $? -eq "$code" ] && grep -q -F -e "$text" a.err && [ ! -e no.qlb ]
    result=$?
    say "$claim" $result
    [ $result -eq 0 ] || sed 's/^/    /' a.err
}
printf 'mesh pot.obj\ncamera eye 0 0 9 look 0 0 0 fov 40\n' >s.scene
refused a_scene_takes_no_floor 1 "'--floor' is for an OBJ alone; s.scene" \
    s.scene --floor
refused a_scene_is_not_written_again 1 "'--write-scene' is for an OBJ" \
    s.scene --write-scene t.scene
refused info_takes_no_axis 1 "'--info' goes without '--up'" --info x --up z
refused up_is_y_or_z 1 "'--up x': expected y or z" pot.obj --up x
printf 'v 0 0 0\nv 1 1 1\nf 1 2 1\n' >nothing.obj
refused a_floor_needs_something_on_it 2 'nothing.obj: expected a face with an' \
    nothing.obj
refused a_missing_obj_is_exit_3 3 'none.obj' none.obj
refused a_scene_into_no_folder_is_exit_3 3 'none/a.scene' pot.obj \
    --write-scene none/a.scene
refused two_outputs_of_one_name_are_refused 1 'no.qlb' pot.obj \
    --write-scene ./no.qlb

exit $((failures > 0))
