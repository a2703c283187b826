#!/bin/sh
# test_boards.sh - every emulated board renders the simulator's picture
# SPDX-License-Identifier: MIT

if [ "${1-}" = --help ]; then
    echo 'usage: tests/boards/test_boards.sh [BOARD|template...]'
    echo 'Example: tests/boards/test_boards.sh microbit sifive_e'
    exit 0
fi
if [ $# -eq 0 ]; then
    cd hal/boards && set -- template * && cd ../.. || exit 3
fi

make=${MAKE:-make}
. tests/support/claims.sh
build=${BUILD:-build}
mkdir -p "$build/fail"
log=$(mktemp) || exit 3
trap 'rm -f "$log" "$log.plain"' EXIT

# check BOARD CLAIM COMMAND...: run it, say one line; its output on a failure.
check() {
    suite=boards/$1
    name=$2
    shift 2
    note=
    if "$@" >"$log" 2>&1; then
        say "$name" 0 "$note"
    else
        say "$name" 1
        grep -v '^  [A-Z]*	' "$log" | tail -12 >&2
        echo "    again: $*" >&2
    fi
}

# choose BOARD [VARIABLE=value...] TARGET: make it.
choose() {
    on=$1
    shift
    "$make" --no-print-directory BOARD="$on" "$@"
}

# same BOARD [VARIABLE=value...]: render there and here, compare.
same() {
    picture=$build/$SCENE-$1
    rm -f "$picture.ppm" "$picture-sim.ppm"
    choose "$@" run-emulated EMULATED=1 QUIET=1 &&
        choose "$@" "$picture-sim.ppm" || return
    instructions=$(sed -n "s/^instructions: //p" "$log")
    paths=$(sed -n "s/^paths: //p" "$log")
    note="$instructions instructions"
    [ "${paths:-0}" -eq 0 ] ||
        note="$((instructions / paths)) instructions a path"
    cmp "$picture.ppm" "$picture-sim.ppm" && return
    cp "$picture.ppm" "$build/fail/$SCENE-${1}_actual.ppm"
    return 1
}

# scene NAME BOARD [VARIABLE=value...]: the same with another scene.
scene() {
    SCENE=$1
    shift
    same "$@"
    result=$?
    SCENE=$default_scene
    return $result
}

# takes BOARD: the end of make firmware has what the picture just rendered took,
# and an estimate, a tenth off at most, once the firmware is another.
takes() {
    count=$build/$1/$SCENE-emulated.count
    choose "$1" firmware && touch "$count" && choose "$1" firmware || return
    tr -d , <"$log" >"$log.plain"
    count=$(cat "$count")
    note=$(sed -n 's/^\(at least .*\) (.*/\1/p' "$log")
    grep -q "^at least [0-9.]* s at [0-9.]* MHz ($count counted" \
        "$log.plain" || return
    size=$("$(of_board "$1" CROSS)size" -A "$build/$1/$SCENE.elf" |
        awk '/^\.(text|rodata|data) / { n += $2 } END { print n }')
    grep -q "^$build/$1/$SCENE.hex: flash $size of" "$log.plain" || return
    touch "$build/$1/$SCENE.elf" && choose "$1" firmware >"$log" || return
    about=$(sed -n 's/^about .* (\([0-9]*\) million .*estimated.*/\1/p' "$log")
    [ $((about * 100)) -gt $((count / 11000)) ] &&
        [ $((about * 100)) -lt $((count / 9000)) ]
}

# panel BOARD [VARIABLE=value...]: the real board's firmware, and what it shows.
panel() {
    grey=$build/$SCENE-$1-gray4.ppm
    choose "$@" VARIANT=-panel firmware &&
        "$build/qlux-sim-draft" "$build/$SCENE.qlb" -o "$grey" --quiet \
            --format gray4 --size 128x64 --spp 8 &&
        tests/boards/test_panel.sh "$build/$1/$SCENE-panel.elf" "$grey"
}

# stops BOARD STATUS FAULT: how fault_main.c ends, and that it says so; of an
# instruction, where that is.
stops() {
    fault=$build/$1/$SCENE-emulated-fault-$3
    choose "$1" EMULATED=1 VARIANT="-fault-$3" "$fault.elf" \
        BOARD_MAIN=tests/boards/fault_main.c FLAGS_MAIN=-DTEST_FAULT="$3" \
        FIRMWARE_SRC='firmware/base/ql_crc.c firmware/app/ql_stream.c' || return
    # shellcheck disable=SC2046 # a command and its arguments
    tools/dev/run_board.sh --quiet "$fault.elf" "$build/$1/fault.ppm" \
        $(emulator "$1")
    status=$?
    note="status $status"
    [ "$status" -eq "$2" ] && [ ! -e "$build/$1/fault.ppm" ] || return
    case $3 in
    0) grep -q "^board: panic" "$log" ;;
    1) grep -q "^board: fault .* stack overflow" "$log" ;;
    2)
        here=$("$(of_board "$1" CROSS)nm" "$fault.elf" |
            sed -n 's/ . fault_here$//p')
        note="$note at 0x$here"
        grep -q "^board: fault .* at pc 0x$here" "$log"
        ;;
    esac
}

# of_board BOARD NAME: what its board.mk says.
of_board() {
    sed -n "s/^BOARD_$2 := //p" "hal/boards/$1/board.mk"
}

emulator() {
    of_board "$1" QEMU
}

# Ctrl-C on the serial port, a moment after the start of a long picture.
ctrl_c() {
    choose "$1" SPP=256 EMULATED=1 "$build/$1/$SCENE-emulated.elf" || return
    # shellcheck disable=SC2046
    { sleep 1; printf "\003"; } |
        tools/dev/limit.sh --cpu 60 $(emulator "$1") -display none \
            -monitor none -serial stdio -icount shift=0 \
            -semihosting-config enable=on,target=native \
            -kernel "$build/$1/$SCENE-emulated.elf" >"$build/$1/stopped.stream"
    ! "$build/qlux-recv" "$build/$1/stopped.stream" -o "$build/$1/stopped.ppm" \
        --quiet && grep -q "status -12: stopped by the user" "$log"
}

# stack BOARD: what was used stays within what was proved.
stack() {
    choose "$1" test-stack || return
    used=$(sed -n "s/^stack-used: //p" "$log")
    note="$used bytes used"
}

# objects BOARD WORD...: how many would be compiled for another firmware.
objects() {
    choose "$@" -n EMULATED=1 VARIANT=-never firmware | grep -c "^  CC	"
}

# Of the core and hal/ what is there is used; main() is the firmware's own.
shares() {
    n=$(objects "$1" SPP=3 SEED=3 SIZE=8x8 BOUNCES=3 EXPOSURE=1 INTERLACE=2)
    source=$(objects "$1" -W "hal/boards/$1/board.c")
    header=$(objects "$1" -W hal/ql_hal.h)
    gate=$(objects "$1" ROULETTE=1)
    note="$n, source $source, header $header, gate $gate objects"
    [ "$n" -eq 1 ] && [ "$source" -eq 2 ] && [ "$header" -gt 5 ] &&
        [ "$gate" -gt "$header" ]
}

# Of cores that nothing else uses nobody reads the debug information.
bare=CFLAGS_BOARD=-g0
SCENE=${SCENE:-cornell}
default_scene=$SCENE
export SCENE
case " $* " in
*' template '*)
    check template port_that_does_nothing_compiles "$make" test-template ;;
esac
for board; do
    [ "$board" != template ] || continue
    check "$board" draft_picture_is_the_simulators same "$board"
    [ "$board" != lm3s6965evb ] ||
        check "$board" a_firmware_says_what_it_takes takes "$board"
    check "$board" other_settings_compile_main_alone shares "$board"
    check "$board" fine_picture_is_the_simulators same "$board" PRECISION=fine
    check "$board" interlaced_picture_is_the_same \
        same "$board" INTERLACE=8 SIZE=37x21 SPP=2 SEED=9 EXPOSURE=-0.75 \
        CURVE=filmic
    check "$board" random_numbers_nearest_entries_are_the_same same "$board" \
        $bare EXPOSURE=auto CLAMP=0.5 SIZE=24x24 SAMPLER=random SEED=9 \
        TABLE_BITS=5 TABLE_LERP=0
    check "$board" spheres_phong_mirror_and_glass_are_the_same \
        scene glossy "$board" $bare SIZE=20x20 SPP=1
    check "$board" sky_map_by_mis_is_the_same \
        scene sky "$board" $bare SIZE=20x20 SPP=1 DIRECT=mis ROULETTE=1
    check "$board" lens_pixels_that_end_by_themselves_are_the_same \
        scene lens "$board" $bare SIZE=16x16 SPP=64 ERROR=0.1
    check "$board" smooth_normals_are_the_same \
        scene smooth "$board" $bare SIZE=20x20 SPP=1 PRECISION=fine
    check "$board" small_code_draws_the_same same "$board" SMALL=1 SIZE=24x24
    check "$board" direct_light_alone_is_the_same scene square "$board" \
        SMALL=1 SIZE=24x24 INDIRECT=none BOUNCES=0
    for direct in hemisphere cosine solid-angle mis; do
        check "$board" "strategy_${direct}_is_the_same" scene strategies \
            "$board" $bare SIZE=16x16 SPP=1 DIRECT=$direct LIGHTS=uniform \
            INDIRECT=uniform LIGHT_SAMPLES=2 STRATEGIES=1
    done
    check "$board" stack_stays_within_its_proved_bound stack "$board"
    check "$board" ctrl_c_stops_the_picture ctrl_c "$board"
    check "$board" panic_is_reported stops "$board" 100 0
    check "$board" undefined_instruction_is_reported_where_it_is \
        stops "$board" 101 2
    check "$board" stack_overflow_is_reported stops "$board" 101 1
    check "$board" status_is_what_the_emulator_exits_with stops "$board" 12 3
done
for board; do
    [ "$board" = lm3s6965evb ] || continue
    check "$board" panel_shows_the_simulators_greys panel "$board"
    check "$board" interlaced_panel_ends_with_the_same \
        panel "$board" INTERLACE=16
done
exit $((failures > 0))
