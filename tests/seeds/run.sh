#!/bin/sh
# run.sh - run test programs with other seeds; name the claims that then fail
# SPDX-License-Identifier: MIT
#
# usage: tests/seeds/run.sh N PROGRAM...
#   N        how many seeds: 1 to N. Seed 0 is the one of `make test`
#   PROGRAM  from make: one that takes its seed from the environment
#
# Prints for each claim that failed the seed and its line, as it fails, and
# what is done to stderr. A program that crashes, or prints no claim, has
# failed. At the end: every claim that failed, with its seeds; then "N passed,
# N failed", where a claim that failed with one seed has failed.
# Environment: JOBS (of this machine's processors), how many run side by side;
# FIRST (1), the first seed; LIMIT (1200), seconds of processor time of one
# program.
#
# Example: make test-seeds N=20

set -u
one() # SEED PROGRAM: lines "seed|claim line"
{
    name=${2#"${BUILD:-build}"/test/}
    out=$(SEED=$1 tools/dev/limit.sh --cpu "${LIMIT:-1200}" "$2" \
        $(case $2 in *test_app) echo "${BUILD:-build}/cornell.qlb" ;; esac) \
        2>&1 < /dev/null)
    status=$?
    if [ "$status" -gt 1 ] || ! printf '%s\n' "$out" |
        grep -Eq '^[^ ]+ +[^ ]+ +(ok|FAIL)'; then
        out="$out
${name#*/} runs FAIL status $status"
    fi
    printf '%s\n' "$out" | awk -v seed="$1" -v build="${name%%/*}" '
        $3 == "ok" || $3 == "FAIL" {
            print build "|" seed "|" $0
            fflush()
        }'
}

if [ "${1-}" = --one ]; then
    one "$2" "$3"
    exit 0
fi
if [ $# -lt 2 ]; then
    sed -n '/^# usage/,/^# Example/s/^# \{0,1\}//p' "$0"
    exit 2
fi
last=$((${FIRST:-1} + $1 - 1))
shift
for seed in $(seq "${FIRST:-1}" "$last"); do
    for program; do
        printf '%s\0%s\0' "$seed" "$program"
    done
done | xargs -0 -n 2 -P "${JOBS:-$(getconf _NPROCESSORS_ONLN)}" "$0" --one |
    awk -F '|' -v last="$last" '
    {
        line = $3
        for (i = 4; i <= NF; i++) {
            line = line "|" $i
        }
        split(line, word, " ")
        claim = sprintf("%-6s %-20s %s", $1, word[1], word[2])
        claims[claim]
        results++
    }
    word[3] == "FAIL" {
        seeds[claim] = seeds[claim] " " $2
        failures++
        printf "%s seed %s: %s\n", $1, $2, line
    }
    $2 != seed {
        seed = $2
        printf "seed %d of %d: %d results so far, %d failed\n", seed, last,
            results, failures > "/dev/stderr"
    }
    { fflush() }
    END {
        for (claim in claims) {
            if (claim in seeds) {
                failed++
                list = list "  " claim ": seeds" seeds[claim] "\n"
            } else {
                passed++
            }
        }
        if (failed) {
            printf "failed:\n%s", list
        }
        printf "%d passed, %d failed\n", passed, failed
        exit failed > 0 || passed == 0
    }'
