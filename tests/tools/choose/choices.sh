#!/bin/sh
# choices.sh - how good what auto stands for is, in every scene
# SPDX-License-Identifier: MIT
#
# usage: tests/tools/choose/choices.sh [SIZE PICTURES [SCENE...]]
#
# Compiles each scene, measures every way of finding light by pictures that
# qlux-scene has not seen (choice_main.c), and prints a row of a table: what
# auto is, and the work of auto, area, solid-angle and mis by power, over that
# of the best way.
#
# Environment: BUILD (build).
#
# Example: make choices

set -u
build=${BUILD:-build}
size=${1:-32} pictures=${2:-6}
[ $# -lt 2 ] || shift 2
[ $# -gt 0 ] || set -- tests/scenes/*.scene
echo '| scene | auto | its work | area | solid-angle | mis |'
echo '|---|---|---|---|---|---|'
for scene; do
    name=$(basename "$scene" .scene)
    blob=$build/choices-$name.qlb
    "$build/qlux-scene" "$scene" -o "$blob" --quiet 2>"$build/choices.log" &&
        "$build/test/fine/tools/choose/choice_main" "$blob" "$size" \
            "$pictures" >"$build/choices.txt" || exit
    awk -v name="$name" '
        $1 == "way" && $3 == "power" { work[$2] = $6 }
        $1 == "auto" { auto = $2 " by " $3; own = $6 }
        END {
            print "| " name " | " auto " | " own " | " work["area"] " | " \
                work["solid-angle"] " | " work["mis"] " |"
        }' "$build/choices.txt"
    rm -f "$blob"
done
