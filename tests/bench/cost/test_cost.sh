#!/bin/sh
# test_cost.sh - the table of costs says what emulators count
# SPDX-License-Identifier: MIT
#
# Usage: tests/bench/cost/test_cost.sh [BUILD]
#
# The counts are those of tests/budgets, which the boards' jobs compare with
# emulators at the same time, of the Cornell box with 3 bounces.
#
# Example: tests/bench/cost/test_cost.sh build

suite=bench/test_cost
. tests/support/workspace.sh
model=$build/cost-model
blob=$build/cornell.qlb

# rows PATTERN: "CORE PRECISION path[-DIRECT]: N" of the budgets, for cost-model
rows() {
    awk -v blob="$blob" -v only="$1" '
        /^#/ || $3 !~ /^path/ || $0 !~ only { next }
        {
            sub(/^path-?/, "", $3)
            sub(/:$/, "", $3)
            print blob, 16, 16, 1, $1, $2, ($3 == "" ? "area" : $3) "-3", $4
        }' "$root/tests/budgets/instructions.txt"
}

expect a_wrong_usage_is_code_1 1 'usage: ' "$model"
echo "$blob 16 16 1 z80 draft area-3 1000" >z80.txt
expect a_core_that_is_not_in_the_table_is_code_2 2 'expected a core' \
    sh -c "'$model' 0.1 <z80.txt"
"$model" 0.1 </dev/null
[ $? -eq 4 ]
say no_rows_are_not_good $?
for core in cortex-m0 cortex-m3 cortex-m4f rv32imac; do
    rows "^$core" | "$model" 0.1 >said.txt
    say "${core}_is_within_10_percent" $? "$(sort -t , -k 3 said.txt |
        sed -n '$s/.*said [0-9]*, //p'), $(wc -l <said.txt) rows"
done
rows '^cortex-m0 .* path-mis' | awk '{ $8 *= 2; print }' >half.txt
expect half_the_cost_of_mis_is_seen 4 'mis-3' sh -c "'$model' 0.1 <half.txt"
exit $((failures > 0))
