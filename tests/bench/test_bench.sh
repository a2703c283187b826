#!/bin/sh
# test_bench.sh - instructions and bytes stay within their budgets
# SPDX-License-Identifier: MIT
#
# usage: tests/bench/test_bench.sh
#
# Counts on emulated boards are the same on every run, so they can fail a test;
# times on a PC cannot and are not looked at, but that both tracers agree is.
#
# Example: tests/bench/test_bench.sh

set -u
dir=$(mktemp -d) || exit 3
trap 'rm -rf "$dir"' EXIT
make=${MAKE:-make}
. tests/support/claims.sh

# say_rows SUITE: a claim for each row "CLAIM ok|FAIL NOTE" of $dir/rows
say_rows()
{
    while read -r claim verdict note; do
        say_as "$1" "$claim" "$verdict" "$note"
    done < "$dir/rows"
}

# Compare rows "NAME: N" of $2 with the budget $1; a missing row fails.
compare()
{
    awk '
        /^#/ { next }
        FNR == NR { split($0, a, ": "); got[a[1]] = a[2]; next }
        {
            split($0, a, ": ")
            claim = a[1]
            gsub(/ /, "_", claim)
            n = got[a[1]]
            ok = n != "" && n + 0 <= a[2] + 0
            printf "%s_within_budget %s %s of %s\n", claim,
                ok ? "ok" : "FAIL", n == "" ? "no row" : n, a[2]
        }' "$2" "$1" > "$dir/rows"
    say_rows "$3"
}

# rows TARGET...: add the rows that make prints of it
rows()
{
    $make -s --no-print-directory "$@" >> "$dir/bench" 2> "$dir/log" ||
        say_as bench/boards "$1_runs_on_its_boards" FAIL \
            "$(tail -n 1 "$dir/log")"
}

rows bench-boards
rows bench-warps WARP_BOARDS='lm3s6965evb microbit'
rows bench-strategies
compare tests/budgets/instructions.txt "$dir/bench" bench/boards

# size_of VARIABLE=value...: add the rows of that choice
size_of()
{
    $make -s --no-print-directory size "$@" >> "$dir/size" 2> "$dir/log" ||
        say_as bench/size measures_every_board FAIL "$(tail -n 1 "$dir/log")"
}

size_of
size_of BOARD=microbit SMALL=1
size_of BOARD=microbit SMALL=1 SCENE=square INDIRECT=none BOUNCES=0
compare tests/budgets/sizes.txt "$dir/size" bench/size

# Every firmware's modules add up to its flash, and little is nobody's.
awk '
    !/ flash/ { next }
    {
        split($0, a, ": ")
        firmware = a[1]
        sub(/ flash.*/, "", firmware)
    }
    / flash:/ { flash[firmware] = a[2] }
    / flash-/ { sum[firmware] += a[2] }
    / flash-rest:/ { rest[firmware] = a[2] }
    / flash-.*: -/ || / flash-(math|trace|hal|data): 0$/ { bad = bad "; " $0 }
    END {
        for (firmware in flash) {
            n++
            if (sum[firmware] != flash[firmware] || rest[firmware] > 256) {
                bad = bad "; " firmware ": modules " sum[firmware] + 0 \
                    ", rest " rest[firmware] + 0 ", flash " flash[firmware]
            }
        }
        if (n == 0) bad = "; no firmware"
        printf "modules_add_up_to_the_flash %s\n",
            bad == "" ? "ok " n " firmwares" : "FAIL " substr(bad, 3)
    }' "$dir/size" > "$dir/rows"
say_rows bench/size

suite=bench/pc
$make -s --no-print-directory bench-pc > "$dir/pc" 2>&1
status=$?
say both_tracers_hit_the_same_triangles $status "$(
    [ $status -eq 0 ] || tail -n 1 "$dir/pc")"
grep -q 'pc fine closest-ratio: [0-9.]*$' "$dir/pc"
say prints_its_ratios $?
exit $((failures > 0))
