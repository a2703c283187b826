#!/bin/sh
# test_trade.sh - make trade: its table, its recommendation, its figures, resume
# SPDX-License-Identifier: MIT
#
# Usage: tests/tools/test_trade.sh [BUILD]
# Example: tests/tools/test_trade.sh build

suite=tools/test_trade
. tests/support/workspace.sh
trade=$build/qlux-trade
make=${MAKE:-make}

# ---- qlux-trade -------------------------------------------------------------

head='scene,core,name,knob,precision,table_bits,table_lerp,node_bits,leaf,'
head="${head}options,samples,error,bias,instructions_per_sample,"
head="${head}instructions_per_pixel"

# table FILE ROW...: "name,knob,error,cost" in scene s on core c
table() {
    file=$1
    shift
    echo "$head" >"$file"
    for r in "$@"; do
        echo "$r" | awk -F, '{
            print "s,c," $1 "," $2 ",draft,7,1,16,4,--direct mis,1," $3 \
                ",-0.001,1000," $4 }' >>"$file"
    done
}

table good.csv a,base,0.5,1000 a,base,0.09,9000 b,direct,0.08,4000 \
    c,tables,0.02,50000 b,direct,0.02,60000
expect no_table_is_code_1 1 'missing TRADE.csv' "$trade"
expect a_linear_drawing_is_code_1 1 'ends in .svg' "$trade" good.csv -o t.pfm
expect a_missing_table_is_code_3 3 'none.csv' "$trade" none.csv
echo 'scene,core' >bad.csv
expect another_header_is_code_2 2 'bad.csv:1: expected scene,core' \
    "$trade" bad.csv
echo "$head" >bad.csv
expect a_table_without_rows_is_code_2 2 'bad.csv: no rows' "$trade" bad.csv
{ cat good.csv; echo 's,c,x'; } >bad.csv
expect a_short_row_is_code_2_with_its_line 2 'bad.csv:7: expected a row' \
    "$trade" bad.csv
sed '4s/4000$/many/' good.csv >bad.csv
expect a_cost_that_is_no_number_is_code_2_with_its_line 2 'bad.csv:4:' \
    "$trade" bad.csv
sed '3s/0.09/-0.09/' good.csv >bad.csv
expect a_negative_error_is_code_2_with_its_line 2 'bad.csv:3:' "$trade" bad.csv
printf '%s' "$head" >bad.csv
expect a_line_without_end_is_code_2 2 'bad.csv:1: the line has no end' \
    "$trade" bad.csv

"$trade" good.csv -o t.svg >said.txt && "$trade" good.csv -o t.png --quiet
say draws_svg_and_png $?
grep -q '10 %  b .* 0.004 M instructions.*8.00 %' said.txt &&
    grep -q ' 3 %  c .* 0.050 M instructions' said.txt
say recommends_the_cheapest_below_each_error $?
grep -q ' 1 %  by no choice that was measured' said.txt
say says_where_no_choice_is_good_enough $?
grep -q -- '--direct mis$' said.txt
say says_what_to_ask_for $?
grep -q 'instructions a pixel' t.svg && grep -q '>b<' t.svg &&
    grep -q 'best on c' t.svg && [ "$(head -c 4 t.png | tail -c 3)" = PNG ]
say the_drawing_names_axes_and_what_is_best $?
[ "$("$trade" good.csv --best | cut -d, -f3-5 | tr '\n' ' ')" = \
    'name,samples,error a,1,0.5 b,1,0.08 c,1,0.02 ' ]
say best_is_what_nothing_cheaper_is_better_than $?
! "$trade" good.csv --quiet | grep -q .
say quiet_prints_nothing $?
table exact.csv a,base,0.1,1000 a,base,0.05,2000
"$trade" exact.csv | grep -q '10 %  a .* 0.001 M instructions.*10.00 %'
say an_error_of_exactly_the_target_reaches_it $?
table amp.csv 'a&b<c',base,0.1,10000
"$trade" amp.csv -o amp.svg --quiet && grep -q '>a&amp;b&lt;c<' amp.svg &&
    ! grep -q 'a&b' amp.svg
say what_svg_means_otherwise_is_escaped $?
# The line of the first choice is the only one of its width; it turns back.
table back.csv a,base,0.5,10000 a,base,0.5,90000 a,base,0.5,40000
"$trade" back.csv -o back.svg --quiet
grep 'stroke-width="2.2"' back.svg | grep -q 'd="M[^L]*L[^L]*L[^L]*"/>'
say a_line_that_turns_back_keeps_its_turn $?

# The picture of the READMEs, and their table, are of the numbers beside it.
"$trade" "$root/tools/trade/trade.csv" -o drawn.svg >said.txt &&
    cmp -s drawn.svg "$root/tools/trade/trade.svg"
say the_drawing_kept_is_that_of_the_table_kept $?
awk '/ on /{ on = / cortex-m3$/ } on && / M instructions/ {
        sub(/ M instr.*/, ""); print $NF ": " }' said.txt >numbers.txt
[ "$(wc -l <numbers.txt)" -eq 9 ] && while read -r number; do
    grep -q "| $number " "$root/tools/README.md" || echo "$number" >>lacking.txt
done <numbers.txt
[ ! -e lacking.txt ]
say the_readme_recommends_what_the_table_does $?

# ---- measurements -----------------------------------------------------------

cd "$root" || exit 3
awk -v quick=0 -v build="$build" -f tools/dev/gates.awk \
    -f tools/trade/rules.awk - >"$work/out.txt" 2>&1 <<'END'
base base all draft 7 1 16
END
[ $? -eq 2 ] && grep -q ':1: expected NAME KNOB' "$work/out.txt"
say a_bad_line_of_choices_is_named $?

# quick: run it; its last lines are what it recommends
quick() {
    tools/trade/trade.sh --quick >"$work/said.txt" 2>"$work/log"
}

quick
status=$?
[ $status -eq 0 ] || tail -n 5 "$work/log"
say quick_measures_its_choices $status
csv=$build/trade-quick.csv
sed -n 's/^!\([^ +]*\)+\{0,1\} .* all .*/\1/p' tools/trade/choices.txt |
    while read -r name; do
        for scene in cornell dents; do
            grep -q "^$scene,cortex-m3,$name," $csv ||
                echo "$scene $name" >>"$work/lacking"
        done
    done
[ ! -e "$work/lacking" ]
say every_choice_has_rows_in_every_scene $?
[ "$(grep -c ' on cortex-m3' "$work/said.txt")" -eq 2 ]
say every_scene_has_a_recommendation $?
[ -s "$build/trade-quick.svg" ] && [ -s "$build/trade-quick.png" ]
say table_and_drawings_are_written $?

# Independent samples: 64 times as many err an eighth.
awk -F, '$1 == "cornell" && $3 == "random" { error[$11] = $12 }
    END {
        ratio = error[4] / error[256]
        printf "ratio %.2f\n", ratio
        exit !(ratio > 5.5 && ratio < 11.5)
    }' $csv
say errors_fall_with_the_root_of_random_samples $?
awk -F, '$3 == "bounces-1" && $1 == "cornell" { bias = $13 }
    $3 == "base" && $1 == "cornell" { base = $13 }
    END { exit !(bias < -0.1 && base > -0.05 && base < 0.05) }' $csv
say light_that_bounces_leave_out_is_a_bias $?
awk -F, '{ cost[$1 $3] = $14 }
    END {
        exit !(cost["cornellmis-2"] < cost["cornellmis"] &&
            cost["cornellbase"] < cost["cornellmis"] &&
            cost["cornellbase"] < cost["cornellfine"])
    }' $csv
say costs_are_in_the_order_of_the_work $?

# Every third pixel of every third line, as bench_settings.c has them.
awk -F, -v dir="$build/trade" '
    BEGIN {
        split("base area-4 mis mis-4 mis-2 mis-2 bounces-1 area-1 " \
            "fine area-4", w, " ")
        for (i = 1; i < 10; i += 2) way[w[i]] = w[i + 1]
    }
    $3 in way && !seen[$1 $3]++ {
        print dir "/" $1 "-n16l4.qlb", $1 == "cornell" ? "18 18" : "20 15", 3,
            $2, $5, way[$3], $14
    }' $csv >"$work/rows.txt"
[ "$(wc -l <"$work/rows.txt")" -eq 10 ] &&
    "$build/cost-model" 0.1 <"$work/rows.txt" >"$work/costs.txt"
say costs_are_within_10_percent_of_the_model $?
awk '$7 == "mis-4" { $8 *= 2 } { print }' "$work/rows.txt" |
    "$build/cost-model" 0.1 >"$work/costs.txt"
[ $? -eq 4 ]
say half_the_cost_of_mis_is_seen $?

# Nothing is measured twice; what is missing is.
stamp() { # when each was measured
    find "$build/trade/quick" -name '*.error' -o -name '*.cost' | sort |
        xargs ls -l --time-style=full-iso |
        sed 's/.* \(20[0-9-]* [^ ]*\) .* /\1 /'
}
stamp >"$work/before"
quick && stamp >"$work/after" && cmp -s "$work/before" "$work/after"
say a_second_run_measures_nothing $?
rm -f "$build/trade/quick/cornell/base.error"
quick && stamp >"$work/after" &&
    [ "$(diff "$work/before" "$work/after" | grep -c '^>')" -eq 1 ]
say a_run_goes_on_with_what_is_missing $?
[ $failures -eq 0 ]
