#!/bin/sh
# cost.sh - what each part of the last `make test` proved, and what it cost
# SPDX-License-Identifier: MIT
#
# usage: tests/cost.sh [--jobs]; reads $BUILD/test/log.cost, BUILD being build
#   --jobs  every job in place of every part, the longest first
#
# Prints a table for tests/README.md: seconds are of processor time, user and
# system, of a job and all that it started. What is built before the first job
# has a line of its own after `make test`.
#
# Example: make test && tests/cost.sh

set -u
case $#,${1-} in
0, | 1,--jobs) ;;
*)
    sed -n '/^# usage/,/^# Example/s/^# \{0,1\}//p' "$0"
    [ "${1-}" = --help ]
    exit
    ;;
esac
built=${BUILD:-build}/test
[ -r "$built/log.cost" ] || {
    echo "cost.sh: $built/log.cost: no tests have run" >&2
    exit 2
}
if [ $# -eq 1 ]; then
    sort -k 2,2 -n -r "$built/log.cost"
    exit
fi

# The first expression that is found in a job's name says which part it is.
parts()
{
    cat << 'END'
^matrix/|every compiler and processor: same bits, no float, no state
^(configs|library)/|gates: pairs and triples are all there, build and link
^golden/|gates change no bit of a picture
^boards|boards draw the simulator's bits; panel, stack, faults; budgets
^bench|the float rival on this PC
^tools/trade|measured choices of accuracy and speed
^mutants|planted faults are seen
^(fine|draft)-san/|no undefined behaviour in any unit test
^(fine|draft)/(known|stat)/|estimates have the mean of closed forms
^(fine|draft)/unit/|arithmetic and structures keep their bounds
^(fine|draft)/extreme/|nothing breaks at the edges
^fine/tools/|parts of programs
^(tools|extreme)/|programs: messages, exit codes, files
^lint/|layers, shape, documents, format
^[a-z0-9]*/unit/|arithmetic and structures with every pair of gates
END
}

{
    parts
    echo
    cat "$built/log.cost"
    [ ! -r "$built/make.times" ] || awk 'NR == 2 {
            split($1 "m" $2, t, "m")
            print "make", t[1] * 60 + t[2] + t[3] * 60 + t[4]
        }' "$built/make.times"
} | awk '
    !listed && NF == 0 { listed = 1; next }
    !listed {
        match($0, /\|[^|]*$/)
        expression[++n] = substr($0, 1, RSTART - 1)
        proves[n] = substr($0, RSTART + 1)
        next
    }
    $1 == "make" { made = $2; next }
    {
        for (i = 1; i <= n && $1 !~ expression[i]; i++) {
        }
        jobs[i]++
        cpu[i] += $2
        claims[i] += $3
        all_jobs++
        all_cpu += $2
        all_claims += $3
    }
    END {
        proves[n + 1] = "other"
        print "| what is proved | jobs | claims | seconds |\n|---|--:|--:|--:|"
        for (i = 1; i <= n + 1; i++) {
            if (jobs[i] > 0) {
                printf "| %s | %d | %d | %.0f |\n", proves[i], jobs[i],
                    claims[i], cpu[i]
            }
        }
        if (made > 0) {
            printf "| built before: programs, tests | | | %.0f |\n",
                made - all_cpu
        }
        printf "| all | %d | %d | %.0f |\n", all_jobs, all_claims,
            (made > 0 ? made : all_cpu)
    }'
