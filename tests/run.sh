#!/bin/sh
# run.sh - run test jobs side by side; count every claim they print
# SPDX-License-Identifier: MIT
#
# usage: tests/run.sh JOBS; logs go to $BUILD/test/log, BUILD being build
#   JOBS  a file of lines "name|command"; each command prints claims as
#         "suite  claim_in_words  ok|FAIL  note" and exits non-zero on a failure
#
# A job that fails without a FAIL line, or prints no claim, counts as one
# failure. The last line is "N passed, N failed".
#
# Example: tests/run.sh build/test/jobs

set -u
jobs_file=$1
logs=${BUILD:-build}/test/log
[ "${2:-}" = --one ] || rm -rf "$logs"
mkdir -p "$logs"

run_job()
{
    name=${1%%|*}
    log=$logs/$(printf %s "$name" | tr '/ ' '__')
    start=$(date +%s)
    if sh -c "${1#*|}" > "$log.tmp" 2>&1; then
        status=0
    else
        status=$?
    fi
    if ! awk '$3 == "FAIL" { f = 1 } END { exit !f }' "$log.tmp"; then
        if [ "$status" -ne 0 ]; then
            echo "$name exits_with_success FAIL status $status" >> "$log.tmp"
        elif ! awk '$3 == "ok" { f = 1 } END { exit !f }' "$log.tmp"; then
            echo "$name claims_something FAIL it printed no claim" >> "$log.tmp"
        fi
    fi
    mv "$log.tmp" "$log.log"
    printf '%s  (%s s)\n' "$name" "$(($(date +%s) - start))"
    cat "$log.log"
}

if [ "${2:-}" = --one ]; then
    run_job "$3"
    exit 0
fi
while IFS= read -r job; do
    printf '%s\0' "$job"
done < "$jobs_file" |
    xargs -0 -n 1 -P "$(getconf _NPROCESSORS_ONLN)" "$0" "$jobs_file" --one

echo
cat "$logs"/*.log | awk '
    $3 == "ok" { passed++ }
    $3 == "FAIL" { failed++; list = list "  " $0 "\n" }
    END {
        if (failed) printf "failed:\n%s", list
        printf "%d passed, %d failed\n", passed, failed
        exit failed > 0 || passed == 0
    }'
