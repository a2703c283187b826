#!/bin/sh
# test_sight.sh - qlux-scene: cameras and lamps that see nothing are told
# SPDX-License-Identifier: MIT
#
# Usage: tests/tools/script/test_sight.sh [BUILD]
# Example: tests/tools/script/test_sight.sh build

suite=tools/sight
. tests/support/workspace.sh

# told CLAIM TEXT LINES...: that is all that is said of such a scene, the first
# of whose lines is its camera; TEXT may be empty
told() {
    claim=$1 text=$2
    shift 2
    printf '%s\n' 'material grey Kd .5' 'material glass illum 7 Ni 1.5' \
        'material lamp Ke 9' "$@" >s.scene
    "$build/qlux-scene" s.scene -o s.qlb --quiet --direct area 2>err.txt
    if [ -n "$text" ]; then
        [ "$(cat err.txt)" = "qlux-scene: warning: s.scene$text" ]
    else
        [ -s s.qlb ] && [ ! -s err.txt ]
    fi
    result=$?
    say "$claim" $result
    [ $result -eq 0 ] || sed 's/^/    /' err.txt
    rm -f s.qlb
}
sky='sky 1 1 1'
cube='box from -1 -1 -1 to 1 1 1'
box="$cube material grey"
floor='quad -9 -1 -9  -9 -1 9  9 -1 9  9 -1 -9'

# ---- a camera that sees nothing ----
nothing='the camera sees nothing: the scene is around'
told a_camera_that_looks_away_is_told ":4: $nothing 5 6 7 and 4 wide" \
    'camera eye 5 6 30 look 5 6 40 fov 40' "$cube scale 1 2 1 at 5 6 7" "$sky"
told its_scene_is_where_its_lines_have_it ":4: $nothing 5 6 7 and 4 wide" \
    'camera eye 5 -6 30 look 5 -30 40 fov 40' \
    "$cube scale 1 2 1 at 5 6 7" 'up z' "$sky"
told what_is_small_in_the_picture_is_seen '' \
    'camera eye 0 0 500 look 3.1 0 0 fov 40' "$box" "$sky"
printf 'mtllib lib.mtl\n' >lib.obj && : >lib.mtl
told a_scene_without_surfaces_has_nothing_to_see '' \
    'camera eye 0 0 500 look 3.1 0 0 fov 40' 'mesh lib.obj' "$sky"

# ---- a camera inside an object ----
inside="the camera is inside an object of material 'grey' and sees the backs"
told a_camera_in_a_box_is_told ":4: $inside of its faces" \
    'camera eye 0 0 .5 look 0 0 0 fov 40' "$box" "$floor" "$sky"
told a_camera_in_a_ball_is_told ":4: $inside of its faces" \
    'camera eye 0 0 .5 look 0 0 0 fov 40' "$floor" \
    'sphere 0 0 0 radius .9 material grey' "$sky"
told a_camera_beside_it_is_right '' \
    'camera eye 0 0 1.5 look 0 0 0 fov 40' "$box" "$floor" "$sky"
told a_camera_in_glass_may_be_meant '' \
    'camera eye 0 0 .5 look 0 0 0 fov 40' "$floor" \
    'box from -1 -1 -1 to 1 1 1 material glass' "$sky"
told a_camera_in_a_room_is_right '' \
    'camera eye 0 0 .5 look 0 0 0 fov 40' "$floor" "$sky" \
    'box from -1 -1 -1 to 1 1 1 inside material grey'
told also_in_one_whose_fronts_are_outside '' \
    'camera eye 3 0 2.5 look 0 0 0 fov 40' "$cube scale 4 3 5" "$box" \
    'quad -1 2 -1  1 2 -1  1 2 1  -1 2 1 material lamp'
told also_under_a_ball_open_below '' \
    'camera eye 0 0 .5 look 0 0 0 fov 40' "$floor" "$sky" \
    'quad -1 1 -1  1 1 -1  1 1 1  -1 1 1 material grey'

# ---- lamps that shine away ----
away=": the lamp 'lamp' of the quad of line 6 shines away from everything; \
turn its faces, or say 'lights two-sided'"
cam='camera eye 0 0 2.5 look 0 0 0 fov 60'
room='box from -3 -3 -3 to 3 3 3 inside material grey'
up='quad -1 2.99 -1  -1 2.99 1  1 2.99 1  1 2.99 -1 material lamp'
down='quad -1 2.99 -1  1 2.99 -1  1 2.99 1  -1 2.99 1 material lamp'
told a_lamp_that_lights_the_ceiling_it_hangs_at_is_told "$away" \
    "$cam" "$room" "$up"
told one_that_hangs_lower_lights_the_room '' "$cam" "$room" \
    "$(echo "$up" | sed 's/2.99/2/g')"
told one_that_shines_down_is_right '' "$cam" "$room" "$down"
told one_of_two_sides_is_right '' "$cam" "$room" "$up" 'lights two-sided'
told one_that_lights_nothing_outside_is_told "$away" "$cam" "$floor" "$up"
told one_that_the_camera_sees_shine_may_be_meant '' \
    'camera eye 0 5 2.5 look 0 0 0 fov 60' "$floor" "$up"
told a_block_that_shines_all_around_is_right '' "$cam" "$room" \
    'box from -1 2.9 -1 to 1 2.99 1 material lamp'

exit $((failures > 0))
