#!/bin/sh
# test_sky.sh - a map of the sky is seen from inside as it was painted
# SPDX-License-Identifier: MIT
#
# Usage: tests/tools/scene/test_sky.sh [BUILD]
# Example: tests/tools/scene/test_sky.sh build

suite=tools/test_sky
. tests/support/workspace.sh

# Eight columns of 45 degrees, painted 1 to 8 from left to right.
{
    printf 'PF\n8 1\n-1\n'
    for high in '\200\077' '\000\100' '\100\100' '\200\100' '\240\100' \
        '\300\100' '\340\100' '\000\101'; do
        printf "\\0\\0$high\\0\\0$high\\0\\0$high"
    done
} >sky.pfm
printf 'v 0 -1 0\nv 1 -1 0\nv 0 -1 1\nf 1 2 3\n' >a.obj

# sees CLAIM ROTATE X Z LEFT RIGHT: towards (X, 0, Z), on either side of what is
# straight ahead
sees()
{
    printf '%s\n' 'mesh a.obj' "sky sky.pfm rotate $2" \
        "camera eye 0 0 0  look $3 0 $4  fov 40" >a.scene
    "$build/qlux-scene" a.scene -o a.qlb >out.txt 2>&1 || exit 3
    for program in qlux-sim qlux-sim-draft qlux-ref; do
        "$build/$program" a.qlb -o a.pfm --size 2x1 --spp 16 --quiet || exit 3
        tail -c 24 a.pfm | od -A n -t f4 -v | awk -v left="$5" -v right="$6" '
            { for (i = 1; i <= NF; i++) v[n++] = $i }
            function near(x, want) {
                return x > want * 0.995 && x < want * 1.005
            }
            END { exit !(n == 6 && near(v[0], left) && near(v[3], right)) }' ||
            { say "$1" 1 "$program"; return; }
    done
    say "$1" 0
}
sees the_left_edge_is_at_z_and_columns_grow_to_the_right 0 0 1 8 1
sees a_quarter_to_the_right_of_z_is_minus_x 0 -1 0 2 3
sees behind_is_the_middle_of_the_map 0 0 -1 4 5
sees rotate_turns_the_left_edge_from_z_to_x 90 1 0 8 1
sees what_was_ahead_is_to_the_left_then 90 0 1 2 3
sees a_turn_against_it_is_the_other_way -45 0 1 7 8
exit $((failures > 0))
