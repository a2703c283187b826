#!/bin/sh
# run.sh - run test jobs side by side; count every claim they print
# SPDX-License-Identifier: MIT
#
# usage: tests/run.sh [--shuffle SEED] JOBS; logs go to $BUILD/test/log, BUILD
#        being build; "name seconds claims" of every job to $BUILD/test/log.cost
#   JOBS            a file of lines "name|command"; each command prints claims
#                   as "suite  claim_in_words  ok|FAIL  note" and exits non-zero
#                   on a failure
#   --shuffle SEED  in another order: none may depend on it
#
# A job that fails without a FAIL line, prints no claim, or has to be ended
# counts as one failure more. The last line is "N passed, N failed".
#
# A job is ended, alone and with what it started, when it has used its processor
# time or waits for ever (tools/dev/limit.sh). Locale, time zone, umask and the
# folder for temporary files are the same for each, whatever the user has.
#
# Environment: JOB_CPU, JOB_IDLE, seconds for every job in place of those below.
#
# Example: tests/run.sh build/test/jobs

set -u
usage()
{
    sed -n '/^# usage/,/^# Example/s/^# \{0,1\}//p' "$0"
}

# Several times what the longest job takes, on a PC of 2020. A job that builds
# or runs many programs one after the other has more.
cpu_of() # NAME
{
    case $1 in
    boards* | bench* | mutants* | tools/trade) echo "${JOB_CPU:-1800}" ;;
    *) echo "${JOB_CPU:-300}" ;;
    esac
}

# FILE, by `times`: user and system time of what has ended, in seconds.
cpu_in()
{
    awk 'NR == 2 {
            split($1 "m" $2, t, "m")
            printf "%.1f", t[1] * 60 + t[2] + t[3] * 60 + t[4]
        }' "$1"
}

# NAME COMMAND
run_job()
{
    log=$logs/$(printf %s "$1" | tr '/ ' '_-')
    suite=$(printf %s "$1" | tr ' ' '_')
    tools/dev/limit.sh --cpu "$(cpu_of "$1")" --idle "${JOB_IDLE:-300}" \
        sh -c "$2" > "$log.tmp" 2>&1 < /dev/null
    status=$?
    fault=
    if [ "$status" -eq 124 ]; then
        fault="ends_by_itself FAIL $(sed -n 's/^limit\.sh: \([^:]*\).*/\1/p' \
            "$log.tmp" | tail -n 1)"
    elif awk '$3 == "FAIL" { f = 1 } END { exit !f }' "$log.tmp"; then
        :
    elif signal=$(kill -l "$status" 2> /dev/null) &&
        [ "$status" -gt 128 ]; then
        fault="exits_with_success FAIL signal $signal"
    elif [ "$status" -ne 0 ]; then
        fault="exits_with_success FAIL status $status"
    elif ! awk '$3 == "ok" { f = 1 } END { exit !f }' "$log.tmp"; then
        fault="claims_something FAIL it printed no claim"
    fi
    # A line of its own, though the job may have died within one.
    [ -z "$fault" ] || printf '\n%s %s\n' "$suite" "$fault" >> "$log.tmp"
    mv "$log.tmp" "$log.log"
    times > "$log.times"
    cpu=$(cpu_in "$log.times")
    rm "$log.times"
    awk -v name="$1" -v cpu="$cpu" '
        $3 == "ok" || $3 == "FAIL" { claims++ }
        END { print name, cpu, claims + 0 }' "$log.log" >> "$logs.cost"
    printf '%s  (%s s)\n' "$1" "$cpu"
    cat "$log.log"
}

# The lines of JOBS, by numbers drawn from SEED if there is one.
in_order()
{
    if [ -n "$seed" ]; then
        awk -v seed="$seed" 'BEGIN { srand(seed) }
            NF { printf "%.9f %s\n", rand(), $0 }' "$jobs_file" |
            sort | cut -d ' ' -f 2-
    else
        awk NF "$jobs_file"
    fi
}

logs=${BUILD:-build}/test/log
seed=
case ${1-} in
--one)
    run_job "${2%%|*}" "${2#*|}"
    exit 0
    ;;
--help)
    usage
    exit 0
    ;;
--shuffle)
    seed=${2:?}
    shift 2
    ;;
esac
jobs_file=${1-}
if [ $# -ne 1 ] || [ ! -r "$jobs_file" ]; then
    usage >&2
    exit 2
fi

rm -rf "$logs" "$logs.tmp" "$logs.cost"
mkdir -p "$logs" "$logs.tmp" || exit 3
unset CDPATH POSIXLY_CORRECT
TMPDIR=$(cd "$logs.tmp" && pwd)
LC_ALL=C
TZ=UTC
export TMPDIR LC_ALL TZ
umask 022

in_order | tr '\n' '\0' |
    xargs -0 -n 1 -P "$(getconf _NPROCESSORS_ONLN)" "$0" --one

echo
rm -rf "$logs.tmp"
cat "$logs"/*.log | awk -v jobs="$(in_order | wc -l)" \
    -v ran="$(ls "$logs" | grep -c '\.log$')" '
    $3 == "ok" { passed++ }
    $3 == "FAIL" { failed++; list = list "  " $0 "\n" }
    END {
        if (ran != jobs) {
            failed++
            list = list "  run every_job_ran FAIL " ran " of " jobs "\n"
        }
        if (failed) printf "failed:\n%s", list
        printf "%d passed, %d failed\n", passed, failed
        exit failed > 0 || passed == 0
    }'
