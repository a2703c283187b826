#!/bin/sh
# scenes.sh - the blobs that goldens are made of: one for each feature
# SPDX-License-Identifier: MIT
#
# usage: tests/golden/scenes.sh QLUX-SCENE DIR
#
# Writes DIR/16/NAME.qlb and DIR/8/NAME.qlb, the same scene with nodes of both
# widths: the scenes of tests/scenes, and a corner of a room, once plain and
# once with each feature alone, so that a build that lacks all others can draw
# it. DIR/bare/ has all of them without contacts, DIR/open/ without a hull,
# DIR/bare/open/ without either. DIR/digest.bin is some of them in a row, as
# tests/matrix/digest_main.c reads them.
#
# Example: tests/golden/scenes.sh build/qlux-scene build/golden

set -eu
scene=$1
dir=$2
mkdir -p "$dir/16" "$dir/8"

# compile NAME FILE: with nodes of both widths
compile()
{
    for bits in 16 8; do
        "$scene" "$2" -o "$dir/$bits/$1.qlb" --quiet --node-bits "$bits" \
            --direct area \
            2> "$dir/$bits/$1.log" || { cat "$dir/$bits/$1.log" >&2; exit 1; }
    done
}

for name in cornell square glossy sky lens smooth strategies; do
    compile "$name" "tests/scenes/$name.scene"
done

# corner NAME [MATERIAL [NORMAL [LAMP]]]: a floor, a wall of MATERIAL whose
# corners have NORMAL, and a lamp of material LAMP; standard input is what else
# there is.
corner()
{
    n=${3:+//$3}
    cat > "$dir/corner-$1.obj" << END
mtllib corner.mtl
v -4 0 -4
v -4 0 4
v 4 0 4
v 4 0 -4
v 4 4 -4
v -4 4 -4
v -1 3 -1
v 1 3 -1
v 1 3 1
v -1 3 1
vn 0 0.1 1
usemtl floor
f 1 2 3 4
usemtl ${2:-floor}
f 1$n 4$n 5$n 6$n
usemtl ${4:-lamp}
f 7 8 9 10
END
    {
        echo "mesh corner-$1.obj"
        echo 'camera eye 1 2 9 look 0 1 0 fov 40'
        cat
    } > "$dir/corner-$1.scene"
    compile "corner-$1" "$dir/corner-$1.scene"
}

cat > "$dir/corner.mtl" << 'END'
newmtl floor
Kd 0.8 0.6 0.4
newmtl lamp
Ke 3 4 5
newmtl phong
Kd 0.3 0.3 0.3
Ks 0.5 0.4 0.3
Ns 20
newmtl mirror
Kd 0 0 0
Ks 0.9 0.8 0.7
illum 3
newmtl glass
Ni 1.5
Tf 0.81 0.81 1
illum 7
END
# A sky of four by two texels: red differs, green is 2, blue is 4.
{
    printf 'PF\n4 2\n-1\n'
    for texel in 160 140 100 200 340 100 140 220; do
        printf "\\000\\000\\$texel\\100\\000\\000\\000\\100\\000\\000\\200\\100"
    done
} > "$dir/corner.pfm"

corner plain < /dev/null
corner dark floor "" floor < /dev/null
corner two-sided << 'END'
lights two-sided
END
corner sphere << 'END'
sphere 1 1 0 radius 1 material floor
sphere -2 1 1 radius 0.5 material lamp
END
corner phong phong < /dev/null
corner mirror mirror < /dev/null
corner glass glass < /dev/null
corner smooth floor 1 < /dev/null
corner lens << 'END'
lens radius 0.2 focus 9
END
corner sky << 'END'
sky 0.5 0.6 0.8
END
corner map << 'END'
sky corner.pfm rotate 30
END

# ---- The same without contacts or hull, for builds that have none ----

# without KEYS FEATURE FROM TO: the blobs of a folder without some lines
without()
{
    mkdir -p "$4/16" "$4/8"
    for blob in "$3"/16/*.qlb "$3"/8/*.qlb; do
        "$scene" --dump "$blob" |
            sed "/^$1 /d; s/^\(features .*\) $2/\1/" > "$4/dump.txt"
        "$scene" "$4/dump.txt" -o "$4/${blob#"$3/"}" --quiet
    done
}

# Where no point of a picture is near another surface, they draw the same; and
# whether the hull is asked of first or not.
without c contact "$dir" "$dir/bare"
without 'hs*' hull "$dir" "$dir/open"
without 'hs*' hull "$dir/bare" "$dir/bare/open"

# ---- In a row, nodes of either width in turn ----

le32() # NUMBER: as four bytes, the lowest first
{
    # shellcheck disable=SC2059  # the format is made here
    printf "$(printf '\\%03o\\%03o\\%03o\\%03o' $(($1 & 255)) \
        $(($1 >> 8 & 255)) $(($1 >> 16 & 255)) $(($1 >> 24 & 255)))"
}

for blob in 8/cornell 16/glossy 8/sky 16/lens 8/smooth 16/strategies; do
    le32 "$(wc -c < "$dir/$blob.qlb")"
    cat "$dir/$blob.qlb"
done > "$dir/digest.bin"
le32 0 >> "$dir/digest.bin"
