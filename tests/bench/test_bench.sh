#!/bin/sh
# test_bench.sh - instructions and bytes are what the budgets say
# SPDX-License-Identifier: MIT
#
# usage: tests/bench/test_bench.sh [--update] [BOARD|pc...]
#
# Counts on emulated boards are the same on every run, so they can fail a test;
# times on a PC cannot and are not looked at, but that both tracers agree is.
# A figure that is better than its budget fails too: what skips work is fast.
# --update writes what was measured into tests/budgets. Without a name: all.
#
# Example: tests/bench/test_bench.sh microbit

set -u
dir=$(mktemp -d) || exit 3
trap 'rm -rf "$dir"' EXIT
make=${MAKE:-make}
. tests/support/claims.sh
update=
[ "${1-}" != --update ] || { update=yes; shift; }
[ $# -gt 0 ] || set -- $(cd hal/boards && echo *) pc

# say_rows SUITE: a claim for each row "CLAIM ok|FAIL NOTE" of $dir/rows
say_rows()
{
    while read -r claim verdict note; do
        say_as "$1" "$claim" "$verdict" "$note"
    done < "$dir/rows"
}

# compare SUITE BUDGET MEASURED FIRST: rows "NAME: N" whose NAME begins with the
# word FIRST; one that is missing fails.
compare()
{
    if [ -n "$update" ]; then
        awk -F ': ' '
            FNR == NR { got[$1] = $2; next }
            !/^#/ && $1 in got { sub(/: [0-9]+/, ": " got[$1]) }
            { print }' "$3" "$2" > "$dir/budget" && cp "$dir/budget" "$2"
    fi
    awk -v first="$4 " '
        /^#/ { next }
        FNR == NR { split($0, a, ": "); got[a[1]] = a[2]; next }
        /^tolerance: / { tolerance = $2 / 100; next }
        index($0, first) == 1 {
            split($0, a, ": ")
            n = got[a[1]]
            split(a[2], of, " ") # N [at most LIMIT]
            room = of[1] * tolerance
            room = room < 1 ? 1 : room
            note = n " of " of[1]
            if (n == "")
                note = "no row"
            else if (n > of[1] + room || n < of[1] - room)
                note = "measured " n ", budget " of[1] \
                    ": make budgets-update if the change is meant"
            else if (of[4] != "" && n + 0 > of[4] + 0)
                note = "measured " n ", at most " of[4]
            claim = a[1]
            gsub(/ /, "_", claim)
            print claim "_within_budget",
                note ~ /^[0-9]+ of/ ? "ok" : "FAIL", note
        }' "$3" "$2" > "$dir/rows"
    say_rows "$1"
}

# rows FILE TARGET WORD...: add the rows that make prints of it for $board
rows()
{
    file=$dir/$1
    shift
    "$make" -s --no-print-directory "$@" >> "$file" 2> "$dir/log" ||
        say_as bench/boards "$1_runs_on_$board" FAIL "$(tail -n 1 "$dir/log")"
}

# Is there a budget of the board for rows like this?
budgeted()
{
    grep -q "^$core $1" tests/budgets/instructions.txt
}

# Every firmware's modules add up to its flash, and little is nobody's.
add_up()
{
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
        / flash-.*: -/ || / flash-(math|trace|hal|data): 0$/ {
            bad = bad "; " $0
        }
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
        }' "$1" > "$dir/rows"
    say_rows bench/size
}

# Of 64 paths every instruction is told to a source; sources of rays are two.
profile()
{
    "$make" -s --no-print-directory bench-board-profile BOARD="$1" \
        EMULATED=1 DIAG=1 VARIANT=-profile-64 FLAGS_MAIN=-DQL_BENCH_SIZE=4 \
        BOARD_MAIN='tests/bench/bench_profile.c tests/bench/bench_board.c' \
        > "$dir/profile" 2> "$dir/log" &&
        grep -q ' path-in-closest-ql_bvh.c: ' "$dir/profile" &&
        grep -q ' path-in-shadow-ql_bvh.c: ' "$dir/profile" &&
        awk -F ': ' '/ path: / { path = $2 } / path-in-/ { sum += $2 }
            END { exit !(path && sum > path * 0.98 && sum < path * 1.02) }' \
            "$dir/profile"
    say_as bench/boards a_path_is_divided_among_its_sources \
        "$([ $? -eq 0 ] && echo ok || echo FAIL)" "$(tail -n 1 "$dir/log")"
}

# board NAME: what it measures is what its budgets say
board()
{
    board=$1
    core=$(sed -n 's/^BOARD_CORE := //p' "hal/boards/$board/board.mk")
    rm -f "$dir/bench" "$dir/size"
    rows bench bench-boards BOARDS="$board"
    ! budgeted '.* warp-' || rows bench bench-warps-boards WARP_BOARDS="$board"
    ! budgeted '.* path-' ||
        rows bench bench-strategies STRATEGY_BOARDS="$board"
    compare bench/boards tests/budgets/instructions.txt "$dir/bench" "$core"
    rows size size BOARD="$board"
    if grep -q "^$board .* small " tests/budgets/sizes.txt; then
        rows size size BOARD="$board" SMALL=1
        rows size size BOARD="$board" SMALL=1 SCENE=square INDIRECT=none \
            BOUNCES=0 DIRECT=area LIGHTS=power
        rows size size BOARD="$board" DIRECT=mis LIGHTS=power
    fi
    compare bench/size tests/budgets/sizes.txt "$dir/size" "$board"
    add_up "$dir/size"
    [ "$board" != lm3s6965evb ] || profile "$board"
}

pc()
{
    suite=bench/pc
    "$make" -s --no-print-directory bench-pc REPETITIONS=1 \
        > "$dir/pc" 2>&1
    status=$?
    say both_tracers_hit_the_same_triangles $status "$(
        [ $status -eq 0 ] || tail -n 1 "$dir/pc")"
    grep -q 'pc fine closest-ratio: [0-9.]*$' "$dir/pc"
    say prints_its_ratios $?
    "$make" -s --no-print-directory bench-warps-pc > "$dir/pc" 2>&1 &&
        grep -q 'pc fine warp-cone: [0-9]*$' "$dir/pc"
    say warps_are_counted $?
    sed -n 's/^BOARD_CORE := //p' hal/boards/*/board.mk > "$dir/names"
    (cd hal/boards && ls) >> "$dir/names"
    say_none every_budget_is_of_a_board "$(grep -hv '^#\|^tolerance: ' \
        tests/budgets/*.txt | cut -d ' ' -f 1 | sort -u | grep -vxFf \
        "$dir/names")"
}

for part; do
    case $part in
    pc) pc ;;
    *) board "$part" ;;
    esac
done
exit $((failures > 0))
