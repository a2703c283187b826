#!/bin/sh
# test_info.sh - qlux-scene: every figure and every line that it prints
# SPDX-License-Identifier: MIT
#
# Usage: tests/tools/scene/test_info.sh [BUILD]
# Example: tests/tools/scene/test_info.sh build

suite=tools/info
. tests/support/workspace.sh
scene=$build/qlux-scene
scenes=$root/tests/scenes

# is CLAIM: out.txt is what comes on stdin, nothing more
is() {
    diff - out.txt >diff.txt
    say "$1" $?
    cat diff.txt >&2
}

# By hand: two quadrilaterals, one of them a light, each with corners of its own
# and in a leaf of its own. One unit is 1 / 4096.
"$scene" "$scenes/square.scene" -o square.qlb --direct area >out.txt 2>err.txt
[ ! -s err.txt ] && is the_summary_of_the_square <<'END'
square.qlb: 4 triangles, 2 lights, 404 bytes
auto is area by power
END
"$scene" --info square.qlb >out.txt
is each_line_about_the_square <<'END'
version: 2
triangles: 4
spheres: 0
vertices: 8
smooth-vertices: 0
nodes: 3
leaves: 2
depth: 1
node-bits: 16
materials: 2
phong-materials: 0
mirror-materials: 0
glass-materials: 0
emissive-materials: 1
lights: 2
radiance-unit: 2^1
sky: none
tables: 0
table-words: 0
lens: no
auto: area power
features: node16 lights
image: 16 16
exposure: 1
unit: 0.000244140625
rounding: 0.000122
bytes: 404
bytes-per-triangle: 101.00
crc32: 7af6f09d
END

# Of the others, the same as their dumps have, whose lines are counted.
for s in glossy sky smooth lens wild lights; do
    "$scene" "$scenes/$s.scene" -o $s.qlb --direct area --lights power \
        >summary.txt 2>err.txt
    "$scene" --dump $s.qlb >dump.txt
    "$scene" --info $s.qlb | grep -v -e '^depth:' -e '^unit:' -e '^rounding:' \
        -e '^version:' -e '^crc32:' >out.txt
    awk -v bytes="$(wc -c <$s.qlb)" '
        $1 == "features" { features = $0; sub(/ /, ": ", features) }
        $1 == "image" { image = $0; sub(/ /, ": ", image) }
        $1 == "radiance_exp" { unit = $2 }
        $1 == "auto" && $2 == 1 && $3 == 0 { choice = "auto: area power" }
        $1 == "exposure_q8" { exposure = $2 / 256 }
        $1 == "n" || $1 == "v" || $1 == "t" || $1 == "s" || $1 == "l" ||
            $1 == "table" { count[$1]++ }
        $1 == "vn" { smooth += $2 != 0 || $3 != 0 || $4 != 0 }
        $1 == "m" { count["m"]++; emits += $5 $6 $7 !~ /^(0x0*)*$/ }
        $1 == "g" { kind[$NF]++ }
        $1 == "w" { words += NF - 1 }
        $1 == "da" { lens = 1 }
        $1 == "sky" { sky = $6 > 0 ? $6 " " $7 : "constant" }
        END {
            t = count["t"] - count["s"]
            print "triangles: " t
            print "spheres: " count["s"] + 0
            print "vertices: " count["v"]
            print "smooth-vertices: " smooth + 0
            print "nodes: " count["n"] + 1
            print "leaves: " count["n"] / 2 + 1
            print "node-bits: 16"
            print "materials: " count["m"]
            print "phong-materials: " kind[1] + 0
            print "mirror-materials: " kind[2] + 0
            print "glass-materials: " kind[3] + 0
            print "emissive-materials: " emits + 0
            print "lights: " count["l"] + 0
            print "radiance-unit: 2^" unit
            print "sky: " (sky == "" ? "none" : sky)
            if (sky != "")
                print "sky-chance: 1" # there are no lamps
            print "tables: " count["table"] + 0
            print "table-words: " words + 0
            print "lens: " (lens ? "yes" : "no")
            print choice
            print features
            print image
            printf "exposure: %.8g\n", exposure
            print "bytes: " bytes + 0
            printf "bytes-per-triangle: %.2f\n", bytes / count["t"]
        }' dump.txt >wanted.txt
    is ${s}_is_told_as_its_dump_has_it <wanted.txt
    info() {
        sed -n "s/^$1: //p" wanted.txt
    }
    spheres=$(info spheres)
    [ "$spheres" -eq 0 ] && spheres= || spheres="$spheres spheres, "
    cat summary.txt >out.txt
    echo "$s.qlb: $(info triangles) triangles, $spheres$(info lights) lights," \
        "$(info bytes) bytes" >wanted.txt
    echo "auto is area by power" >>wanted.txt
    is the_summary_of_$s <wanted.txt
done

# Four faces are good; two have no area as written, three none on the grid, of
# which one cell is 1 / 32751 of the whole, and each is one of its sorts.
printf 'v %s\n' '0 0 0' '1 0 0' '0 1 0' '0 0 1' '0 1e-7 0' '1e-7 0 0' \
    '0 0 1e-7' >a.obj
printf 'f %s\n' '1 2 3' '1 2 4' '1 3 4' '2 3 4' '1 1 2' '1 2 2' '1 2 5' \
    '1 3 6' '1 6 7' >>a.obj
printf 'mesh a.obj\ncamera eye 0 0 9 look 0 0 0 fov 40\nsky 1 1 1\n' >a.scene
"$scene" a.scene -o a.qlb --direct area >summary.txt 2>out.txt
why='because the scene is 1 wide (a.obj)'
is dropped_faces_are_counted_by_their_sort <<END
qlux-scene: dropped 2 faces without area
qlux-scene: dropped 3 faces smaller than the grid, 3.05e-05 units wide, $why
END
sed 's/, [0-9]* bytes$//' summary.txt >out.txt
is what_is_left_is_counted <<'END'
a.qlb: 4 triangles, 1 lights
auto is area by power
END
sed '/^f 1 1 2/,$d' a.obj >b.obj
sed 's/a.obj/b.obj/' a.scene >b.scene
"$scene" b.scene -o b.qlb --quiet --direct area >out.txt 2>&1 &&
    is nothing_dropped_is_silent </dev/null
cmp -s a.qlb b.qlb
say dropped_faces_leave_no_trace $?

# A lamp that is there twice, once from another corner and with vertices of its
# own, shines once; its other side is a face of its own.
printf '%s\n' 'newmtl lamp' 'Kd 0 0 0' 'Ke 5 4 3' >a.mtl
printf '%s\n' 'mtllib a.mtl' 'v 0 0 0' 'v 1 0 0' 'v 0 1 0' 'v 0 0 1' 'f 1 2 4' \
    'usemtl lamp' 'f 1 2 3' >b.obj
{
    cat b.obj
    printf '%s\n' 'f 3 1 2' 'v 1 0 0' 'f 5 -3 1' 'f 1 2 3'
} >a.obj
"$scene" b.scene -o b.qlb --quiet --direct area &&
    "$scene" a.scene -o a.qlb --quiet --direct area 2>out.txt &&
    is doubled_faces_are_counted <<'END'
qlux-scene: dropped 3 faces that repeat another's corners, in its order
END
cmp -s a.qlb b.qlb
say doubled_faces_leave_no_trace $?
echo 'f 1 3 2' >>a.obj
"$scene" a.scene -o a.qlb --direct area 2>/dev/null |
    sed 's/, [0-9]* bytes$//' >out.txt
is the_other_side_of_a_face_is_kept <<'END'
a.qlb: 3 triangles, 3 lights
auto is area by power
END

exit $((failures != 0))
