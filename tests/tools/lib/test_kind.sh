#!/bin/sh
# test_kind.sh - every program names a file of the wrong kind, and what to do
# SPDX-License-Identifier: MIT
#
# Usage: tests/tools/lib/test_kind.sh [BUILD]
# Example: tests/tools/lib/test_kind.sh build

suite=tools/kind
. tests/support/workspace.sh
scenes=$root/tests/scenes

cp "$scenes/square.scene" "$scenes/square.obj" "$scenes/square.mtl" .
cp "$scenes/sky.pfm" s.pfm
chmod +w ./*
"$build/qlux-scene" square.scene -o a.qlb --quiet &&
    "$build/qlux-scene" --dump a.qlb >a.txt &&
    "$build/qlux-sim" a.qlb -o a.png --spp 1 --size 4x4 --quiet \
        --save-sums a.qls || exit 3
cp a.qlb blob.csv
{ printf '# Blender 4.2\no Cube\n' && cat square.obj; } >mesh.txt
printf 'solid cube\n facet normal 0 0 1\n' >a.stl
printf '%080d\1\0\0\0%50s' 0 x >b.bin
printf 'ply\nformat ascii 1.0\n' >a.ply
printf 'glTF\2\0\0\0' >a.glb
printf '{ "asset": { "version": "2.0" } }\n' >a.gltf
printf 'BLENDER-v402' >a.blend
printf '\377\330\377\340\0\020JFIF' >a.jpg
printf 'v/1\1\2\0\0\0' >a.exr
printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n' >a.hdr
printf 'PK\3\4' >a.zip
printf '\377\376v\0 \0001\0' >wide.obj
printf 'nothing that anybody knows\n' >what.qlb

# says PROGRAM FILE TEXT: it ends with code 2 and this line, and writes nothing
says() {
    case $1 in
    qlux-scene-info) set -- "$1" "$2" "$3" qlux-scene --info "$2" ;;
    qlux-diff) set -- "$1" "$2" "$3" qlux-diff a.png "$2" ;;
    qlux-sheet) set -- "$1" "$2" "$3" qlux-sheet -o no.png "x=$2" ;;
    qlux-trade) set -- "$1" "$2" "$3" qlux-trade "$2" ;;
    qlux-resume) set -- "$1" "$2" "$3" qlux-sim a.qlb -o no.png --quiet \
        --spp 2 --size 4x4 --resume "$2" ;;
    qlux-scene) set -- "$1" "$2" "$3" qlux-scene "$2" -o no.qlb ;;
    *) set -- "$1" "$2" "$3" "$1" "$2" -o no.png ;;
    esac
    of=$1 file=$2 text=$3 program=$4
    shift 4
    "$build/$program" "$@" >out.txt 2>err.txt
    [ $? -eq 2 ] && [ ! -e no.png ] && [ ! -e no.qlb ] &&
        [ "$(tail -n 1 err.txt)" = "$program: $file: this is $text" ]
    result=$?
    say "${of}_says_what_to_do_with_$file" $result
    [ $result -eq 0 ] || sed 's/^/    /' err.txt
}

# Two lines each: programs, file, what it is; what is expected.
while IFS='|' read -r programs file what && read -r wanted; do
    for program in $programs; do
        says "$program" "$file" "$what; expected $(echo "$wanted" |
            sed "s/SCENE/a .scene or an OBJ/
                s/PICTURE/a PPM, PFM or PNG picture/
                s/CONVERT/Blender or MeshLab converts meshes/")"
    done
done <<'END'
qlux-sim qlux-ref qlux-scene-info|square.scene|a scene
a blob: qlux-scene square.scene -o square.qlb
qlux-sim qlux-ref|square.obj|an OBJ mesh
a blob: qlux-scene square.obj -o square.qlb
qlux-sim|mesh.txt|an OBJ mesh
a blob: qlux-scene mesh.txt -o mesh.qlb
qlux-sim|a.txt|the dump of a blob
a blob: qlux-scene a.txt -o a.qlb
qlux-sim|square.mtl|an MTL library
a blob
qlux-sim qlux-ref|a.png|a PNG picture
a blob
qlux-sim|a.qls|a sum file
a blob: qlux-merge a.qls -o a.png makes a picture of it
qlux-sim|a.blend|a Blender scene
a blob; CONVERT
qlux-scene|a.qlb|a blob
SCENE: qlux-sim a.qlb -o a.png draws it, and qlux-scene --info tells of it
qlux-scene|square.mtl|an MTL library
SCENE: give the OBJ that names it
qlux-scene|a.stl|an STL mesh
SCENE; CONVERT
qlux-scene|b.bin|an STL mesh
SCENE; CONVERT
qlux-scene|a.ply|a PLY mesh
SCENE; CONVERT
qlux-scene|a.glb|a glTF mesh
SCENE; CONVERT
qlux-scene|a.gltf|a glTF mesh
SCENE; CONVERT
qlux-scene|a.blend|a Blender scene
SCENE; CONVERT
qlux-scene|a.png|a PNG picture
SCENE
qlux-scene|a.jpg|a JPEG picture
SCENE
qlux-scene|a.zip|a zip archive
SCENE; unpack it
qlux-scene|wide.obj|text in UTF-16
OBJ or MTL; save it as UTF-8
qlux-scene|what.qlb|a blob by its name
SCENE: qlux-sim what.qlb -o what.png draws it, and qlux-scene --info tells of it
qlux-merge qlux-resume|a.png|a PNG picture
sums
qlux-merge|a.qlb|a blob
sums: qlux-sim a.qlb -o a.png --save-sums x.qls
qlux-diff qlux-sheet|a.qlb|a blob
PICTURE: qlux-sim a.qlb -o a.png draws it
qlux-diff qlux-sheet|a.qls|a sum file
PICTURE: qlux-merge a.qls -o a.png makes a picture of it
qlux-diff|square.scene|a scene
PICTURE: qlux-scene square.scene -o square.qlb, then qlux-sim draws it
qlux-sheet|a.jpg|a JPEG picture
PICTURE: magick a.jpg a.png
qlux-recv|a.qlb|a blob
what a board sends
qlux-recv|a.png|a PNG picture
what a board sends
qlux-trade|blob.csv|a blob
a table of tools/trade/trade.sh
END

# A map of the sky.
sky() { # FILE TEXT
    sed "\$a sky $1" square.scene >sky.scene
    "$build/qlux-scene" sky.scene -o no.qlb >out.txt 2>err.txt
    [ $? -eq 2 ] && [ "$(tail -n 1 err.txt)" = "qlux-scene: $1: this is $2" ]
    say "a_sky_of_${1}_is_named" $?
}
map='expected a PFM or a Radiance picture (.hdr): oiiotool'
sky a.exr "an OpenEXR picture; $map a.exr -o a.hdr"
sky a.png "a PNG picture; $map a.png -o a.hdr"

# What is of no kind is told as before, by its bytes.
cp what.qlb what
"$build/qlux-sim" what -o no.png 2>err.txt
[ $? -eq 2 ] && grep -q '^qlux-sim: what: byte ' err.txt
say what_nobody_knows_is_told_by_its_bytes $?

exit $((failures > 0))
