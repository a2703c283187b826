#!/bin/sh
# test_faces.sh - qlux-scene: faces of many corners, seen and lit
# SPDX-License-Identifier: MIT
#
# Usage: tests/tools/faces/test_faces.sh [BUILD]
# Example: tests/tools/faces/test_faces.sh build

suite=tools/faces
. tests/support/workspace.sh

# letter NAME: a lamp in the plane z = 0 that shines down on a floor; its faces
# are on stdin, as corners x,y
letter() {
    {
        printf 'mtllib a.mtl\nv -9 -9 -4\nv 9 -9 -4\nv 9 9 -4\nv -9 9 -4\n'
        printf 'usemtl floor\nf 1 2 3 4\nusemtl lamp\n'
        awk '{
            for (i = NF; i >= 1; i--) { # it is seen from below
                split($i, x, ",")
                print "v", x[1], x[2], 0
            }
            printf "f"
            for (i = NF; i >= 1; i--) printf " %d", -i
            print ""
        }'
    } >"$1.obj"
    printf 'mesh %s.obj\nimage 32 32\n' "$1" >"$1.scene"
    printf 'camera eye 1 1 -3.9 look 1 1 0 up 0 1 0 fov 110\n' >>"$1.scene"
    "$build/qlux-scene" "$1.scene" --direct area -o "$1.qlb" --quiet 2>"$1.err"
}
printf 'newmtl floor\nKd 0.5\nnewmtl lamp\nKd 0\nKe 1\n' >a.mtl

# looks_as CLAIM A B: nothing is said, and from below both are one, bit by bit
looks_as() {
    for s in "$2" "$3"; do
        "$build/qlux-sim" "$s.qlb" -o "$s.pfm" --quiet --spp 4 --direct none \
            --indirect none
    done
    [ ! -s "$2.err" ] && [ -s "$2.pfm" ] && cmp "$2.pfm" "$3.pfm"
    say "$1" $?
}

# shines_as CLAIM A B: the floor, seen from the lamp, has the same light
shines_as() {
    for s in "$2" "$3"; do
        sed 's/^camera.*/camera eye 0 0 -1 look 0 0 -4 up 0 1 0 fov 120/' \
            "$s.scene" >"$s-floor.scene"
        "$build/qlux-scene" "$s-floor.scene" --direct area -o "$s.qlb" --quiet
        "$build/qlux-sim" "$s.qlb" -o "$s.pfm" --quiet --spp 256 --bounces 0 \
            --direct area
    done
    "$build/qlux-diff" "$2.pfm" "$3.pfm" >out.txt
    bias=$(sed -n 's/^bias: *//p' out.txt)
    awk -v b="$bias" 'BEGIN { exit !(b > -0.003 && b < 0.003) }'
    say "$1" $? "bias $bias"
}

letter u <<'END'
-3,-3 3,-3 3,3 1,3 1,-1 -1,-1 -1,3 -3,3
END
letter u-of-boxes <<'END'
-3,-3 3,-3 3,-1 -3,-1
1,-1 3,-1 3,3 1,3
-3,-1 -1,-1 -1,3 -3,3
END
looks_as a_u_looks_as_three_boxes_do u u-of-boxes
shines_as a_u_shines_as_three_boxes_do u u-of-boxes
letter o <<'END'
-3,-3 3,-3 3,3 1,1 1,-1 -1,-1 -1,1 1,1 3,3 -3,3
END
letter o-of-boxes <<'END'
-3,-3 3,-3 1,-1 -1,-1
3,-3 3,3 1,1 1,-1
3,3 -3,3 -1,1 1,1
-3,3 -3,-3 -1,-1 -1,1
END
looks_as a_hole_by_a_bridge_looks_as_four_sides_do o o-of-boxes
shines_as a_hole_by_a_bridge_shines_as_four_sides_do o o-of-boxes
letter star <<'END'
0,4 -1,1 -4,1 -2,-1 -3,-4 0,-2 3,-4 2,-1 4,1 1,1
END
letter star-of-points <<'END'
0,0 0,4 -1,1
0,0 -1,1 -4,1
0,0 -4,1 -2,-1
0,0 -2,-1 -3,-4
0,0 -3,-4 0,-2
0,0 0,-2 3,-4
0,0 3,-4 2,-1
0,0 2,-1 4,1
0,0 4,1 1,1
0,0 1,1 0,4
END
looks_as a_star_looks_as_ten_triangles_do star star-of-points

# ---- what is said ----
# says CLAIM TRIANGLES TEXT: of the faces on stdin
says() {
    letter one
    "$build/qlux-scene" --info one.qlb | sed -n 's/^triangles: //p' >out.txt
    said=$(sed -n '/picture is black/d; /camera sees nothing/d
        s/^qlux-scene: warning: //p' one.err)
    [ "$said" = "$3" ] && [ "$(cat out.txt)" -eq $(($2 + 2)) ] # the floor's
    say "$1" $? "$(cat out.txt): $said"
}
crosses='the outline of a face crosses itself: its triangles overlap'
says outlines_that_cross_themselves_are_counted 10 \
    "one.obj:13: $crosses (3 times)" \
    <<'END'
0,0 4,4 4,0 0,4
0,6 -4,-5 6,2 -6,2 4,-5
0,0 2,0 2,2 0,2
0,0 4,0 4,3 2,-1 0,3
END
says repeated_corners_and_spikes_are_dropped 4 '' <<'END'
0,0 0,0 2,0 2,2 0,2 0,0
5,0 7,0 9,0 7,0 7,2 5,2
END
nothing='a face whose outline encloses nothing is dropped'
says a_face_that_encloses_nothing_is_dropped 0 "one.obj:13: $nothing" <<'END'
0,0 3,0 1,2 3,0
END
says corners_in_a_side_stay_corners 6 '' <<'END'
0,0 1,0 2,0 3,0 3,1 3,2 0,2 0,1
END
printf 'v 0 0 0\nv 4 0 0\nv 4 4 1\nv 0 4 0\nv 4 4 3\n' >bent.obj
printf 'f 1 2 3 4\n f 1 2 5 4\nf 4 1 2 5\n' >>bent.obj
printf "mesh bent.obj\nsky 1 1 1\n" >bent.scene
printf "camera eye 0 0 9 look 0 0 0 fov 40\n" >>bent.scene
expect bent_faces_are_counted 0 "bent.obj:7: .*bent by .* (2 times)" \
    "$build/qlux-scene" bent.scene --direct area -o bent.qlb --quiet

# ---- smooth faces ----
# ball FIRST-LINES: 8 by 16 faces on the unit sphere
ball() {
    { printf 'mtllib a.mtl\nusemtl floor\n'"$1" && awk 'BEGIN {
        for (i = 0; i <= 8; i++) for (j = 0; j < 16; j++) {
            t = atan2(0, -1) * i / 8
            p = atan2(0, -1) * j / 8
            x = sin(t) * cos(p)
            z = -sin(t) * sin(p)
            printf "v %.6f %.6f %.6f\nvn %.6f %.6f %.6f\n", x, cos(t), z,
                x, cos(t), z
        }
        for (i = 0; i < 8; i++) for (j = 0; j < 16; j++) {
            a = 16 * i + j + 1
            b = 16 * i + (j + 1) % 16 + 1
            if (i == 0) printf "f %d %d %d\n", a, a + 16, b + 16
            else if (i == 7) printf "f %d %d %d\n", a, a + 16, b
            else printf "f %d %d %d %d\n", a, a + 16, b + 16, b
        }
    }'; } >ball.obj
}

# picture NAME KEY: of ball.obj, beside a lamp
picture() {
    printf "mesh ball.obj\n%s\nimage 32 32\n" "$2" >"$1.scene"
    printf "sphere 3 4 5 radius 1 material lamp\n" >>"$1.scene"
    printf 'camera eye 0 1 4 look 0 0 0 fov 36\n' >>"$1.scene"
    "$build/qlux-scene" "$1.scene" --direct area -o "$1.qlb" --quiet 2>"$1.err"
    "$build/qlux-sim" "$1.qlb" -o "$1.pfm" --quiet --spp 64 --bounces 0
}

# shades_as CLAIM A B RELMSE: A is silent, and differs by less from B
shades_as() {
    "$build/qlux-diff" "$2.pfm" "$3.pfm" >out.txt
    relmse=$(sed -n 's/^relmse: *//p' out.txt)
    [ ! -s "$2.err" ] &&
        awk -v r="$relmse" -v max="$4" 'BEGIN { exit !(r != "" && r < max) }'
    say "$1" $? "relmse $relmse"
}
ball ''
sed 's/^f .*/& /; /^f/ s/\([0-9][0-9]*\) /\1\/\/\1 /g' ball.obj >round.obj
sed '/^vn/d' ball.obj >flat.obj
mv round.obj ball.obj && picture round ''
mv flat.obj ball.obj && picture flat ''
cp ball.obj plain.obj
picture forty 'smooth 40'
picture ten 'smooth 10'
sed 's/^usemtl.*/&\ns 1/' plain.obj >ball.obj && picture group ''
sed 's/^usemtl.*/&\ns off/' plain.obj >ball.obj && picture off ''
picture said 'smooth 40'
shades_as a_ball_of_one_group_is_as_round_as_by_its_normals group round 2e-3
shades_as and_so_is_one_at_40_degrees forty round 2e-3
shades_as one_of_s_off_is_flat off flat 1e-30
shades_as at_10_degrees_its_sides_are ten flat 2e-4
"$build/qlux-diff" flat.pfm round.pfm >out.txt
sed -n 's/^relmse: *//p' out.txt | awk '{ exit !($1 > 2e-2) }'
say which_is_another_picture $? "$(grep relmse out.txt)"
cmp -s said.qlb off.qlb && grep -q 'said.scene: smooth has no effect' said.err
say an_angle_without_effect_says_so $?
sed 's/^usemtl.*/&\ns 1x/' plain.obj >ball.obj
picture wrong ''
grep -q 'ball.obj:3: expected s GROUP or s off' wrong.err
say a_group_of_letters_is_none $?
exit $((failures > 0))
