#!/bin/sh
# run.sh - random inputs to every reader, for a while; what ends badly is kept
# SPDX-License-Identifier: MIT
#
# usage: tests/fuzz/run.sh BUILD SECONDS [FORMAT...]
#
# BUILD has the fuzzers, which make fuzz makes. Each format gets so many
# seconds, half of them with each core; as many run at a time as there are
# processors. New inputs stay in BUILD/corpus, so that the next run begins with
# them. One that crashes, hangs, leaks or takes too much memory stays in
# BUILD/found:
#
#     FUZZ=obj build/fuzz/fuzz-fine build/fuzz/found/obj-fine-crash-...
#
# repeats it. Prints one claim a format and core; exit 1 if any is broken.
#
# Example: make fuzz T=60

set -u
suite=fuzz
. tests/support/claims.sh
build=$1
seconds=$((($2 + 1) / 2))
shift 2
formats=${*:-$(ls tests/fuzz/corpus)}
mkdir -p "$build/found" "$build/log"

# one FORMAT CORE: its log is there afterwards, and ends in the exit code
one() {
    kept=$build/corpus/$1
    mkdir -p "$kept"
    FUZZ=$1 "$build/fuzz-$2" -max_total_time="$seconds" -timeout=10 \
        -rss_limit_mb=1024 -max_len=4096 -close_fd_mask=3 \
        -print_final_stats=1 -artifact_prefix="$build/found/$1-$2-" \
        "$kept" "tests/fuzz/corpus/$1" >"$build/log/$1-$2" 2>&1
    echo "exit $?" >>"$build/log/$1-$2"
}

running=0
for format in $formats; do
    for core in fine draft; do
        one "$format" "$core" &
        running=$((running + 1))
        [ $((running % $(getconf _NPROCESSORS_ONLN))) -ne 0 ] || wait
    done
done
wait
for format in $formats; do
    for core in fine draft; do
        log=$build/log/$format-$core
        runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
        [ "$(tail -n 1 "$log")" = 'exit 0' ] && [ -n "$runs" ]
        say "${format}_$core" $? "${runs:-0} inputs $(sed -n \
            's/^SUMMARY: //p; s/^not true: /&/p' "$log" | head -n 1)"
    done
done
exit $((failures > 0))
