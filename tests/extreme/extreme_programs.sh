#!/bin/sh
# extreme_programs.sh - cases 6, 28 and 50 as the programs have them
# SPDX-License-Identifier: MIT
#
# usage: tests/extreme/extreme_programs.sh [BUILD]
#   BUILD  where qlux-scene, qlux-sim and qlux-merge are; build unless given
#
# Prints "extreme/programs CLAIM ok" a claim. Works in BUILD/extreme.
#
# Example: tests/extreme/extreme_programs.sh build

set -u
build=${1:-${BUILD:-build}}
work=$build/extreme
suite=extreme/programs
. tests/support/claims.sh
mkdir -p "$work" || exit 3

# scene NAME: what of it is left of standard input, as build/extreme/NAME.qlb
scene() {
    cat >"$work/$1.scene" &&
        "$build/qlux-scene" "$work/$1.scene" \
            --direct area -o "$work/$1.qlb" --quiet \
            >"$work/$1.log" 2>&1
}

# ---- Case 6: faces without area ----

cat >"$work/flat.obj" <<'END'
v 0 0 0
v 1 0 0
v 0 1 0
v 2 0 0
v 0.5 0 0
mtllib flat.mtl
usemtl lamp
f 1 1 1
f 1 2 2
f 1 2 4
f 1 5 2
usemtl white
f 1 2 3
END
printf 'newmtl lamp\nKe 1 1 1\nnewmtl white\nKd 1 1 1\n' >"$work/flat.mtl"
scene flat <<'END'
mesh flat.obj
camera eye 0.3 0.3 2 look 0.3 0.3 0 up 0 1 0 fov 40
image 8 8
END
say case_06_faces_without_area_compile $?
grep -q 'dropped 4 faces without area' "$work/flat.log"
say case_06_faces_without_area_are_dropped_and_counted $?
[ "$("$build/qlux-scene" --info "$work/flat.qlb" |
    sed -n 's/^lights: //p')" = 0 ]
say case_06_faces_without_area_are_no_lights $?

# ---- Case 28: what qlux-sim counts ----

# A lamp on the floor, but for a grid unit; and one where it belongs.
lamp() { # height
    cat <<END
v 0 0 0
v 0 0 1
v 1 0 1
v 1 0 0
v 0.1 $1 0.5
v 0.9 $1 0.5
v 0.9 $1 0.5012
v 0.1 $1 0.5012
mtllib lamp.mtl
usemtl white
f 1 2 3 4
usemtl lamp
f 5 6 7 8
END
}
printf 'newmtl white\nKd 1 1 1\nnewmtl lamp\nKe 0.99 0.99 0.99\n' \
    >"$work/lamp.mtl"
for height in 0.00004 0.5; do
    lamp $height >"$work/lamp.obj"
    scene "lamp$height" <<'END'
mesh lamp.obj
camera eye 0.5 0.0005 0.52 look 0.5 0 0.5006 up 0 1 0 fov 0.01
image 4 4
END
done

saturated() { # scene, threads
    "$build/qlux-sim" "$work/lamp$1.qlb" -o "$work/lamp.pfm" --size 4x4 \
        --spp 65536 --bounces 0 --sampler random --threads "$2" --stats \
        --quiet | sed -n 's/^saturated: //p'
}
low=$(saturated 0.00004 1)
many=$(saturated 0.00004 3)
high=$(saturated 0.5 1)
[ "${low:-0}" -gt 0 ] && [ "$low" = "$many" ]
say case_28_stats_count_what_is_cut_by_any_number_of_threads $? \
    "$low of 3145728"
[ "$high" = 0 ]
say case_28_stats_count_nothing_where_nothing_is_cut $?

# ---- Case 50: nothing to see ----

echo 'mtllib flat.mtl' >"$work/none.obj"
scene none <<'END'
mesh none.obj
camera eye 0 0 3 look 0 0 0 up 0 1 0 fov 40
image 1 1
END
say case_50_a_mesh_of_materials_alone_compiles $?
"$build/qlux-sim" "$work/none.qlb" -o "$work/none.pfm" --spp 1 --quiet &&
    [ "$(tail -c 12 "$work/none.pfm" | tr -d '\000' | wc -c)" -eq 0 ]
say case_50_an_empty_scene_is_one_black_pixel $?
"$build/qlux-sim" "$work/none.qlb" -o "$work/none.pfm" --spp 0 --quiet \
    2>"$work/none.log"
[ $? -eq 1 ]
say case_50_no_samples_are_refused $?

exit $((failures > 0))
