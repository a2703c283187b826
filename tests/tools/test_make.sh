#!/bin/sh
# test_make.sh - make builds what it must, where it may, and says what is wrong
# SPDX-License-Identifier: MIT
#
# usage: tests/tools/test_make.sh
#
# Builds a copy of the tree that nobody may write to, in a folder with a blank
# in its name, without optimisation. As root it does so as another user.
#
# Example: tests/tools/test_make.sh

suite=tools/test_make
. tests/support/claims.sh
unset MAKEFLAGS MFLAGS MAKELEVEL BUILD WARN O V SCENE CC CFLAGS
make=${MAKE:-make}
# The other user need not get to the folder of the tree.
work=$(TMPDIR=/tmp mktemp -d) || exit 3
trap 'chmod -R u+w "$work"; rm -rf "$work"' EXIT
tree="$work/a tree"
out=$work/out
mkdir "$tree" "$out" "$work/my scenes" || exit 3
cp -R Makefile firmware hal sim tools tests linker "$tree" || exit 3
cp tests/scenes/square.* "$work/my scenes"
mv "$work/my scenes/square.scene" "$work/my scenes/it's my room.scene"

other=
if [ "$(id -u)" -eq 0 ]; then
    other='setpriv --reuid=65534 --regid=65534 --clear-groups'
    chown -R 65534:65534 "$work"
fi
chmod -R a-w "$tree"

# build ARGUMENT...: make with them in the copy, as who may not write there.
build() {
    (cd "$tree" && $other "$make" CFLAGS=-O0 "O=$out" SPP=1 SIZE=8x8 "$@") \
        >"$work/said" 2>"$work/errors"
}

compiled() { # how often a compiler is called, of what make -n said
    grep -c ' -c ' "$work/said"
}

# would CLAIM COUNT ARGUMENT...: make -n with them calls the compiler so often
would() {
    claim=$1 count=$2
    shift 2
    build -n "$@" all
    say "$claim" $(($? || $(compiled) != count)) "$(compiled) of $count"
}

# changed FILE: someone changes it
changed() {
    chmod u+w "$tree/$1" && touch "$tree/$1"
}

last_line() {
    tail -n 1 "$work/said"
}

# ---- where it builds, and what it says

build -j"$(getconf _NPROCESSORS_ONLN)" all
say a_read_only_tree_in_a_folder_with_a_blank_builds $?
[ -s "$work/errors" ] && head -n 5 "$work/errors" >&2
[ -s "$out/cornell.ppm" ] && [ ! -e "$tree/build" ]
say everything_that_is_written_lies_under_O $?
[ "$(last_line)" = "$out/cornell.ppm" ]
say the_last_line_of_make_names_the_picture $?
grep -q '^  CC	firmware/math/ql_real.c$' "$work/said" &&
    ! grep -v "^  [A-Z]*	[^ ]*\$\|^$out/cornell.ppm\$" "$work/said" >&2
say a_step_is_one_line $?
build -s DIRECT=mis all
[ $? -eq 0 ] && [ ! -s "$work/said" ] && [ ! -s "$work/errors" ]
say silent_make_prints_nothing $?
build V=1 DIRECT=cosine all && grep -q 'qlux-sim .*--direct cosine' "$work/said"
say V_1_prints_the_commands $?

# ---- what it builds again

objects=$(find "$out" -name '*.o' | wc -l)
would what_is_built_is_not_built_again 0
changed hal/ql_report.h
would a_header_that_no_object_includes_rebuilds_none 0
changed firmware/base/ql_crc.h
users=$(find "$out" -name '*.d' -exec grep -l 'base/ql_crc.h:' {} + | wc -l)
would a_header_rebuilds_what_includes_it "$users"
[ "$users" -gt 0 ] && [ "$users" -lt 20 ]
say few_objects_include_the_header_of_the_checksum $? "$users of $objects"
would other_compiler_options_rebuild_all "$objects" CFLAGS=-O1
would a_gate_on_the_command_line_rebuilds_all "$objects" \
    CFLAGS='-O0 -DQL_CFG_DIAG=0'
would another_compiler_rebuilds_all "$objects" CC=c99
touch -d '1 hour ago' "$tree/firmware/base/ql_crc.h"
build -n LDFLAGS=-s all
[ "$(compiled)" -eq 0 ] && grep -q '^  LD	.*qlux-merge$' "$work/said"
say other_linker_options_link_again $?
build -n "$out/test/p01/unit/test_fx"
[ "$(grep -c QL_CFG_PRECISION "$work/said")" -gt 9 ]
say one_test_is_a_target_of_its_own $?

# ---- scenes

build run SCENE="$work/my scenes/it's my room.scene"
[ $? -eq 0 ] && [ "$(last_line)" = "$out/it_s_my_room.ppm" ] &&
    [ -s "$out/it_s_my_room.ppm" ]
say a_scene_may_have_blanks_in_its_path $?
build SCENE="$work/my scenes/it's my room.scene" all
! grep 'SCENE\|RENDER' "$work/said" >&2
say make_and_make_run_render_the_same_picture $?
touch "$work/my scenes/square.obj"
build SCENE="$work/my scenes/it's my room.scene" all
grep -q '^  SCENE' "$work/said" && grep -q '^  RENDER' "$work/said"
say what_lies_beside_a_scene_makes_it_anew $?
build run SCENE="$work/my scenes/square.obj" SCENE_OPTIONS='--floor'
[ $? -eq 0 ] && [ "$(last_line)" = "$out/square.ppm" ]
say an_obj_alone_is_a_scene_too $?
mkdir "$work/more" && cp "$work/my scenes"/* "$work/more"
build -n SCENE="$work/more/it's my room.scene" all
grep -q '^  SCENE' "$work/said"
say another_scene_of_the_same_name_is_another $?

# ---- settings, the same here and on a board

choice='DIRECT=solid-angle INDIRECT=uniform LIGHTS=all SEED=7 BOUNCES=2'
build -n run $choice PRECISION=draft ERROR=0.1 CURVE=filmic
grep -q -- 'qlux-sim-draft .*--seed 7 --bounces 2 .*--direct solid-angle
    --indirect uniform --lights all .*--error 0.1' "$work/said" ||
    grep 'qlux-sim-draft .*--seed 7 --bounces 2 ' "$work/said" |
    grep -q -- '--direct solid-angle --indirect uniform --lights all .*--err'
say settings_choose_the_picture_of_this_pc $?
build -n firmware BOARD=microbit $choice ERROR=0.1 CURVE=reinhard
for word in APP_WIDTH=8 APP_SEED=7 APP_BOUNCES=2 APP_LIGHTS=QL_LIGHTS_ALL \
    APP_DIRECT=QL_DIRECT_SOLID_ANGLE APP_ERROR=0.1 CFG_PRECISION=0 \
    CFG_DIRECT=16 CFG_LIGHT_CHOICES=2 CFG_UNIFORM=1 CFG_ADAPTIVE=1 \
    CFG_INDIRECT=1 CFG_FORMATS=1 CFG_CURVES=2 \
    APP_CURVE=QL_CURVE_REINHARD; do
    grep -q -- "-DQL_$word " "$work/said" || echo "lacks $word"
done >"$work/lacking"
[ ! -s "$work/lacking" ]
say settings_choose_the_picture_of_a_board $? "$(head -n 1 "$work/lacking")"

# gates VARIABLE=value... GATE=value...: what the firmware then has
gates() {
    build -n firmware BOARD=lm3s6965evb $1
    for word in $2; do
        grep -q -- "-DQL_CFG_$word " "$work/said" || echo "$1: not $word"
    done
}
{
    gates 'CURVE=filmic EXPOSURE=auto CLAMP=2' 'CURVES=1 METER=1 CLAMP=1'
    gates 'EXPOSURE=-2.5 CLAMP=0' 'METER=0 CLAMP=0 CURVES=0'
    none='LIGHT_SAMPLES=0 UNIFORM=0 ROULETTE=0'
    gates '' "$none ADAPTIVE=0 INDIRECT=1 SAMPLERS=2 FORMATS=17 METER=0 CLAMP=0"
    ! grep -q QL_APP_ERROR "$work/said" || echo 'an error that none asked for'
    # what auto is, the scene's header says
    ! grep -q 'QL_CFG_DIRECT\|QL_CFG_LIGHT_CHOICES' "$work/said" ||
        echo 'a way of finding light that none asked for'
    grep -q 'APP_DIRECT=QL_SCENE_DIRECT .*APP_LIGHTS=QL_SCENE_LIGHTS ' \
        "$work/said" || echo 'auto is not what the scene says'
    gates 'DIRECT=none LIGHT_SAMPLES=1 LIGHTS=power' \
        "$none DIRECT=1 LIGHT_CHOICES=1"
    gates 'DIRECT=mis' "$none DIRECT=32"
    gates 'LIGHT_SAMPLES=2' 'LIGHT_SAMPLES=1 UNIFORM=0 ROULETTE=0'
    gates 'ROULETTE=1' 'LIGHT_SAMPLES=0 UNIFORM=0 ROULETTE=1'
    gates 'INDIRECT=uniform' 'LIGHT_SAMPLES=0 UNIFORM=1 ROULETTE=0 INDIRECT=1'
    gates 'INDIRECT=cosine BOUNCES=64' "$none INDIRECT=1"
    gates 'BOUNCES=0' 'INDIRECT=0'
    gates 'INDIRECT=none' "INDIRECT=0 $none"
    gates 'DIRECT=mis STRATEGIES=1' 'DIRECT=63 LIGHT_CHOICES=7 LIGHT_SAMPLES=1
        UNIFORM=1 ROULETTE=1'
    gates 'SAMPLER=random SMALL=1' 'SAMPLERS=1 SMALL=1 DIAG=0'
} >"$work/lacking"
[ ! -s "$work/lacking" ]
say a_firmware_has_the_gates_that_its_settings_need $? \
    "$(head -n 1 "$work/lacking")"

build -n firmware BOARD=microbit DIRECT=cosine LIGHTS=all INDIRECT=none
said=$(cat "$work/errors")
[ "$said" = 'make: LIGHTS=all has no effect with DIRECT=cosine' ]
say a_setting_of_a_board_without_effect_says_so $? "$said"

# ---- what is wrong

# WORDS OF THE COMMAND LINE | WHAT THE ONE LINE SAYS
while IFS='|' read -r words text; do
    # shellcheck disable=SC2086 # words
    (cd "$tree" && "$make" -n "O=$out" $words) >"$work/said" 2>&1
    status=$?
    if [ $status -eq 0 ] || [ "$(wc -l <"$work/said")" -ne 1 ] ||
        ! grep -q -- "$text" "$work/said"; then
        echo "$words: $(cat "$work/said")"
    fi
done >"$work/wrong" <<'END'
PRECISION=fien|PRECISION=fien: use draft or fine
SAMPLER=sobl|SAMPLER=sobl: use random or sobol
DIRECT=foo|use none, area, hemisphere, cosine, solid-angle, mis or auto
INDIRECT=foo|use none, cosine, uniform or brdf
LIGHTS=some|use power, all, uniform or auto
SPP=abc|use a number from 1 to 16777216
SPP=0|use a number from 1 to 16777216
SPP=16777217|use a number from 1 to 16777216
SIZE=200|use WIDTHxHEIGHT, each from 1 to 16384
SIZE=0x8|use WIDTHxHEIGHT, each from 1 to 16384
BOUNCES=65|use a number from 0 to 64
SEED=-1|use a number from 0 to 4294967295
ERROR=1|use 0, or a part from 0.00001 to 0.9999
EXPOSURE=65|use stops from -64 to 64
EXPOSURE=1,5|use stops from -64 to 64
LIGHT_SAMPLES=256|use a number from 1 to 255
TABLE_BITS=11|use a number from 5 to 10
TABLE_LERP=2|use 0 or 1
ROULETTE=yes|use 0 or 1
SCENE=missing|use the path of a .scene or .obj file, or bulb, ceiling
SCENE=no/such.scene|use the path of a .scene or .obj file, or bulb, ceiling
BOARD=x firmware|use lm3s6965evb, microbit, mps2-an386 or sifive_e
BOARD=microbit SMALL=2 firmware|SMALL=2: use 0 or 1
BOARD=microbit INTERLACE=3 firmware|use a power of two from 1 to 16384
BOARD=microbit LTO=yes firmware|LTO=yes: use 0 or 1
BOARD=microbit DIAG=2 firmware|DIAG=2: use 0 or 1
BOARD=microbit EMULATED=2 firmware|EMULATED=2: use 0 or 1
BOARD=microbit STRATEGIES=2 firmware|STRATEGIES=2: use 0 or 1
BORAD=microbit run|make knows no variable of this name
SPPP=3|make knows no variable of this name
BOARD=microbit|BOARD=microbit: make all does not use it; make run,
BOARD=microbit test|make test does not use it
SMALL=1 run|SMALL=1: make run uses it only with BOARD=lm3s6965evb,
DIRECT=mis lint|make lint does not use it
V=2|V=2: use 0 or 1
END
[ ! -s "$work/wrong" ]
say a_wrong_variable_is_one_line_that_names_the_right_ones $? \
    "$(head -n 1 "$work/wrong")"
(cd "$tree" && "$make" "O=a b") >"$work/said" 2>&1
[ $? -ne 0 ] && grep -q 'O=a b: use the path of a folder' "$work/said"
say a_folder_with_a_blank_for_O_is_refused $?
(cd "$tree" && "$make" -n O=. clean) >"$work/said" 2>&1
[ $? -ne 0 ] && grep -q 'O=.: use a folder that make clean may' "$work/said"
say the_tree_itself_for_O_is_refused $?
(cd "$tree" && "$make" firmware "O=$out") >"$work/said" 2>&1
[ $? -ne 0 ] && grep -q 'name a board: BOARD= one of' "$work/said"
say a_firmware_without_a_board_asks_for_one $?
build -n flash BOARD=microbit
grep -q 'flash.sh "copy $hex to the drive MICROBIT" pyocd ' "$work/said"
say make_flash_knows_the_tool_of_a_board_and_how_to_do_without $?
# loads WORD...: flash.sh with them; leaves its status and what it said.
loads() {
    tools/dev/flash.sh "$@" >"$work/said" 2>"$work/errors"
    echo $? >>"$work/said"
}
loads 'copy it' no-such-tool 1
[ "$(cat "$work/said")" = 3 ] && [ "$(cat "$work/errors")" = "flash.sh: \
no-such-tool is not installed: sudo apt install no-such-tool; or copy it" ]
say a_tool_that_is_not_installed_is_named_with_how_to_get_it $?
loads 'copy it' && [ "$(paste -s "$work/said")" = 'copy it	0' ]
say a_board_that_needs_no_tool_is_loaded_as_said $?
loads 'copy it' sh -c 'echo loaded "$1"; exit 7' sh 'a b'
[ "$(paste -s "$work/said")" = 'loaded a b	7' ]
say a_tool_gets_its_words_and_ends_as_it_does $?
(cd "$tree" && "$make" help "O=$out") >"$work/said" 2>&1
[ $? -eq 0 ] && grep -q '^  SPP=64 ' "$work/said" &&
    grep -q '^  firmware  ' "$work/said"
say make_help_lists_targets_and_variables $?
exit $((failures > 0))
