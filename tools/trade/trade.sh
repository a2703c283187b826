#!/bin/sh
# trade.sh - error against instructions of every choice, measured and drawn
# SPDX-License-Identifier: MIT
#
#   make trade --> trade.sh --> rules.awk      choices.txt to rules.mk
#                     |-------> make trade-measure TRADE_RULES=rules.mk
#                     |           |--> qlux-scene, qlux-ref, trade_error
#                     |           '--> make bench-board BOARD=b: instructions
#                     '-------> qlux-trade     the table and the drawings of all

usage() {
    cat <<'END'
usage: tools/trade/trade.sh [--quick]

Measure every choice of tools/trade/choices.txt in three scenes: the error of
the picture against two references in double precision, as samples double, and
the instructions of a sample on an emulated Cortex-M0, M3 and M4F. Writes
build/trade.csv, build/trade.svg and .png, and prints for each scene and core
the cheapest choice for an error of 10 %, 3 % and 1 %.

What is measured is kept in build/trade: a run that was stopped goes on where it
was, and a change measures again what depends on it.

  --quick   some choices, two scenes, small pictures, Cortex-M3 only:
            build/trade-quick.*

Example: make trade
END
}

quick=0
name=trade
case ${1-} in
'') ;;
--quick) quick=1; name=trade-quick ;;
--help) usage; exit 0 ;;
*) usage >&2; exit 1 ;;
esac
make=${MAKE:-make}
build=${BUILD:-build}
dir=$build/trade
[ $quick = 0 ] || dir=$build/trade/quick
rules=$dir/rules.mk
mkdir -p "$dir" || exit 3

tools/dev/setup.sh >&2 || exit # cross compilers and emulators
awk -v quick=$quick -v build="$build" -f tools/dev/gates.awk \
    -f tools/trade/rules.awk tools/trade/choices.txt > "$rules" || exit
$make -s --no-print-directory -j"$(getconf _NPROCESSORS_ONLN)" tools \
    >"$dir/log" 2>&1 || { cat "$dir/log" >&2; exit 3; }
targets=$(sed -n 's/^TRADE_TARGETS := *//p' "$rules")
total=$(echo "$targets" | wc -w)

# A bar on a terminal, else a line now and then; until the file $dir/busy goes.
progress() {
    begun=$(date +%s)
    last=-1
    : "${first:=$(done_of)}"
    while [ -e "$dir/busy" ]; do
        n=$(done_of)
        left=
        [ "$n" -le "$first" ] || left=$((($(date +%s) - begun) * (total - n) /
            (n - first)))
        if [ -t 2 ]; then
            awk -v n="$n" -v total="$total" -v left="$left" 'BEGIN {
                for (i = 0; i < 40; i++)
                    bar = bar (i < 40 * n / total ? "#" : ".")
                printf "\rmeasuring [%s] %d of %d", bar, n, total
                if (left != "") printf ", %d:%02d left ", left / 60, left % 60
            }' >&2
        elif [ $((n * 10 / total)) -gt "$last" ]; then
            last=$((n * 10 / total))
            echo "measured $n of $total" >&2
        fi
        sleep 1
    done
    [ ! -t 2 ] || echo >&2
}

done_of() {
    # shellcheck disable=SC2086 # a list of names
    ls $targets 2>/dev/null | wc -l
}

: > "$dir/busy"
progress &
bar=$!
trap 'rm -f "$dir/busy"; kill $bar 2>/dev/null' EXIT
trap 'exit 130' INT TERM
$make -s --no-print-directory -j"$(getconf _NPROCESSORS_ONLN)" trade-measure \
    TRADE_RULES="$rules" >"$dir/log" 2>&1
status=$?
rm -f "$dir/busy"
wait $bar
if [ $status -ne 0 ]; then
    tail -n 20 "$dir/log" >&2
    echo "trade.sh: stopped; the same command goes on from here" >&2
    exit 3
fi

# Rows of choices, their errors and costs, to one table.
awk -F'|' -v dir="$dir" '
    BEGIN {
        print "scene,core,name,knob,precision,table_bits,table_lerp," \
            "node_bits,leaf,options,samples,error,bias," \
            "instructions_per_sample,instructions_per_pixel"
        split("lm3s6965evb microbit mps2-an386", boards, " ")
    }
    # "cortex-m3 draft mis-2: 9000" of a group of choices
    function costs(group,    b, file, line, words) {
        if (group in read)
            return
        read[group] = 1
        for (b = 1; b <= 3; b++) {
            file = dir "/" group "/" boards[b] ".cost"
            while ((getline line < file) > 0) {
                split(line, words, /[ :]+/)
                cost[group, b, words[3]] = words[4]
                core[b] = words[1]
            }
            close(file)
        }
    }
    {
        group = $10
        gsub(/ /, "-", group)
        costs(group)
        options = $9
        sub(/^ /, "", options)
        file = dir "/" $1 "/" $2 ".error"
        while ((getline line < file) > 0) {
            split(line, f, " ")
            for (b = 1; b <= 3; b++)
                if ((group, b, $2) in cost)
                    printf "%s,%s,%s,%s,%s,%s,%s,%s,%s,%s,%s,%s,%s,%s,%.0f\n",
                        $1, core[b], $2, $3, $4, $5, $6, $7, $8, options,
                        f[1], f[2], f[3], cost[group, b, $2],
                        f[1] * cost[group, b, $2]
        }
        close(file)
    }' "$dir/rows" > "$build/$name.csv.tmp" &&
    mv "$build/$name.csv.tmp" "$build/$name.csv" &&
    "$build/qlux-trade" "$build/$name.csv" -o "$build/$name.svg" &&
    "$build/qlux-trade" "$build/$name.csv" -o "$build/$name.png" --quiet || exit
echo "$build/$name.csv $build/$name.svg $build/$name.png" >&2
