# farm.sh - a picture, and a simulator that dies half way; scripts source it
# SPDX-License-Identifier: MIT
#
# Before: suite=tools/NAME. After, beside what workspace.sh has: $farm, the
# scripts; scene.qlb; one.png, which one machine made; $size and $spp of it; SIM
# and MERGE. The simulator writes what it is asked into calls.txt. Asked for the
# first part after `touch die`, or for rows 13:18 while there is a file dies, it
# writes half of it and kills itself. stop, which a script defines, is called
# however the script ends.

. tests/support/workspace.sh
farm=$root/tools/farm
trap 'stop; rm -rf "$work"' EXIT
trap 'exit 3' INT TERM HUP

size=30x23 spp=8
"$build/qlux-scene" "$root/tests/scenes/furnace.scene" \
    --direct area -o scene.qlb \
    >out.txt && "$build/qlux-sim" scene.qlb --size $size --spp $spp --quiet \
    -o one.png || exit 3
cat >sim.sh <<END
#!/bin/sh
echo "\$*" >>'$work/calls.txt'
case \$* in
*' 13:18 '*) [ ! -e '$work/dies' ] || touch '$work/die' ;;
esac
if rm '$work/die' 2>/dev/null; then
    '$build/qlux-sim' "\$@" | head -c 500
    kill -KILL \$\$
fi
exec '$build/qlux-sim' "\$@"
END
chmod +x sim.sh
# What programs keep of their own, they keep here.
export SIM="$work/sim.sh" MERGE="$build/qlux-merge" HOME="$work"

# calls: how often the simulator was asked for a part
calls() {
    wc -l <calls.txt
}

# renders COMMAND [ARGUMENT...]: 5 parts of the picture into many.png
renders() {
    rm -f many.png
    "$@" 5 many.png scene.qlb --size $size --spp $spp >out.txt 2>err.txt &&
        cmp -s one.png many.png
}

# What holds of each of the scripts: check COMMAND [ARGUMENT...]
check() {
    touch die
    renders "$@" && [ ! -e die ] && [ "$(calls)" -eq 6 ]
    say a_part_whose_worker_was_killed_is_taken_up "$?" "$(calls) calls"
    rm many.png.parts/3.qls
    touch dies
    expect a_part_that_dies_everywhere_is_missing 3 \
        'parts 3 are missing; the others are in many.png.parts: run it again' \
        "$@" 5 many.png scene.qlb --size $size --spp $spp
    [ ! -e many.png.parts/3.qls ] && ls many.png.parts/3.*.tmp >out.txt
    say half_of_a_part_does_not_have_its_name $?
    rm dies calls.txt many.png.parts/0.qls
    renders "$@" && [ "$(calls)" -eq 2 ] &&
        [ "$(grep -c -e '--rows 0:4 ' -e '--rows 13:18 ' calls.txt)" -eq 2 ]
    say parts_that_are_there_are_not_rendered_again "$?" "$(calls) calls"
    [ -z "$(ls many.png.parts/*.tmp 2>/dev/null)" ]
    say nothing_half_written_is_left $?
    renders "$@" && [ "$(calls)" -eq 2 ]
    say a_picture_that_is_complete_is_put_together_again $?
    expect other_settings_are_refused 2 \
        'has parts of another picture: .*sim.sh, 5 parts, scene .*spp 8$' \
        "$@" 5 many.png scene.qlb --size $size --spp 9
    { cat scene.qlb; echo; } >other.qlb
    expect another_scene_is_refused 2 'has parts of another picture: ' \
        "$@" 5 many.png other.qlb --size $size --spp $spp
    expect more_parts_than_rows_are_refused 1 \
        "'24' of '--size 30x23': expected --size, and parts of 1 row up" \
        "$@" 24 other.png scene.qlb --size 30x23
    expect no_size_is_refused 1 "'5' of '--spp 8 --bounces 1': expected " \
        "$@" 5 other.png scene.qlb --spp 8 --bounces 1
    expect its_help_has_an_example 0 "^Example: .*tools/farm/${1##*/}" \
        "$1" --help
    expect no_arguments_are_too_few 1 'too few arguments (see --help)' "$1"
    expect what_no_machine_can_do_is_said 3 \
        'parts 0 1 2 are missing; the others are in bad.png.parts' \
        "$@" 3 bad.png scene.qlb --size 9x3 --bounces 999
}
