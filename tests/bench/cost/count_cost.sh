#!/bin/sh
# count_cost.sh - what samples cost on every board, as rows for cost-model
# SPDX-License-Identifier: MIT
#
# usage: tests/bench/cost/count_cost.sh [BOARD...]
#
# Each scene with the tree that qlux-scene builds, and some with leaves of 1 and
# of 12 triangles, where boxes and triangles are tested in other numbers; each
# in two firmwares, of area by power alone and with all strategies. A way that
# both can is counted in the first, as boards have it. What was counted stays in
# build/cost.
#
# Example: make cost-table

make=${MAKE:-make}
build=${BUILD:-build}
scenes='cornell cornell-1 cornell-12 dents dents-1 dents-12 glossy lights
    smooth smooth-1 smooth-12 sky strategies'
[ $# -gt 0 ] || set -- $(cd hal/boards && echo *)
mkdir -p "$build/cost" || exit 3

# blob NAME: NAME is a scene, or SCENE-LEAF
blob() {
    case $1 in
    *-*) leaf=${1#*-} ;;
    *) leaf=4 ;;
    esac
    "$build/qlux-scene" "tests/scenes/${1%-*}.scene" --leaf "$leaf" --quiet \
        -o "$build/cost/$1.qlb" --features "$build/cost/$1.h"
}

# count NAME BOARD PRECISION STRATEGIES
count() {
    to=$build/cost/$1-$2-$3-$4
    [ -s "$to" ] && return
    "$make" -s --no-print-directory bench-board BOARD="$2" SCENE="${1%-*}" \
        BLOB="$build/cost/$1" PRECISION="$3" EMULATED=1 DIRECT=area \
        LIGHTS=power STRATEGIES="$4" \
        VARIANT="-cost-$1-$3-$4" CFLAGS_BOARD=-g0 \
        BOARD_MAIN='tests/bench/cost/bench_cost.c tests/bench/bench_board.c' \
        > "$to.tmp" && mv "$to.tmp" "$to"
}

for scene in $scenes; do
    blob $scene || exit
done
for board; do
    for precision in draft fine; do
        for scene in $scenes; do
            for strategies in 0 1; do
                count $scene "$board" $precision $strategies || exit
            done
            cat "$build/cost/$scene-$board-$precision-0" \
                "$build/cost/$scene-$board-$precision-1" |
                awk -v blob="$build/cost/$scene.qlb" '
                    /^#/ { next }
                    {
                        sub(/:/, "", $3)
                        if (!seen[$3]++) print blob, 16, 16, 1, $1, $2, $3, $4
                    }'
        done
    done
done
