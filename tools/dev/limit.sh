#!/bin/sh
# limit.sh - run a command, and end it when it computes or waits for ever
# SPDX-License-Identifier: MIT

usage() {
    cat <<'END'
usage: tools/dev/limit.sh [--cpu SECONDS] [--idle SECONDS] COMMAND [ARGUMENT...]
Run a command in a session of its own. When it ends, kill what it left running
there. End it, with every process that it started, when these

  --cpu SECONDS   have used so much processor time together (120)
  --idle SECONDS  have used less than a fiftieth of a core for so long (300)

Exit with its status; with 124 and a line that says why if it was ended. Time on
the clock decides nothing: a busy machine makes a command slow, not wrong. A
command that waits for ever uses no processor time, and one that only looks
again and again uses little; to be taken for one of these, a command that could
go on would have to share its core with fifty others.

Where there is no /proc, each process has the limit for itself, and waiting is
not noticed.

Example: tools/dev/limit.sh --cpu 60 build/qlux-sim build/cornell.qlb -o c.png
END
}

cpu=120
idle=300
while :; do
    case ${1-} in
    --help) usage; exit 0 ;;
    --cpu) cpu=${2-} ;;
    --idle) idle=${2-} ;;
    *) break ;;
    esac
    shift $(($# > 1 ? 2 : 1))
done
case $#,$cpu,$idle in
0,* | *,,* | *, | *[!0-9,]*) usage >&2; exit 1 ;;
esac

ticks=$(getconf CLK_TCK 2>/dev/null) || ticks=100

# Hundredths of seconds that the processes of the job have used, and their
# numbers. A process is one of the job's if its session or its parent is.
look() {
    cat /proc/[0-9]*/stat 2>/dev/null | awk -v job="$job" -v ticks="$ticks" '
        {
            pid = $1
            sub(/^.*\) /, "")
            parent[pid] = $2
            session[pid] = $4
            used[pid] = $12 + $13 + $14 + $15
        }
        END {
            do {
                more = 0
                for (pid in parent) {
                    if (!(pid in own) && (pid == job || session[pid] == job ||
                            (parent[pid] in own))) {
                        own[pid]
                        more = 1
                    }
                }
            } while (more)
            for (pid in own) {
                sum += used[pid]
                list = list " " pid
            }
            printf "%d%s\n", sum * 100 / ticks, list
        }'
}

# Twice: a process may have begun another one while it was looked for.
end_job() {
    for _ in 1 2; do
        # shellcheck disable=SC2046 # several words
        set -- $(look)
        shift
        [ $# -eq 0 ] || kill -KILL "$@" 2>/dev/null
    done
}

# Look now and then; end the job and exit with 3 or 4 when it must end. What is
# counted are naps, each of which takes its time or more: never the clock.
watch() {
    nap=
    trap '[ -z "$nap" ] || { kill $nap; wait $nap; }; exit 0' TERM
    from=0 waited=0 pause=1
    while :; do
        sleep $pause &
        nap=$!
        wait $nap
        waited=$((waited + pause))
        [ $pause -ge 5 ] || pause=$((pause + 1))
        set -- $(look)
        if ! kill -0 $$ 2>/dev/null || [ "$1" -gt $((cpu * 100)) ]; then
            trap '' TERM
            end_job
            exit 3
        elif [ $(($1 - from)) -lt 0 ] ||
            [ $(($1 - from)) -ge $((idle * 2)) ]; then
            from=$1
            waited=0
        elif [ $waited -ge "$idle" ]; then
            trap '' TERM
            end_job
            exit 4
        fi
    done
}

# What runs in the background ignores an interrupt, unless it is told not to.
own='env --default-signal=INT,QUIT'
$own true 2>/dev/null || own=
command -v setsid >/dev/null 2>&1 && own="setsid $own"

exec 3<&0
(
    # shellcheck disable=SC3045 # Debian's sh, bash and busybox have it
    ulimit -S -t "$cpu" 2>/dev/null
    exec $own "$@" <&3 3<&-
) &
job=$!
watcher=
if [ -r /proc/self/stat ]; then
    watch </dev/null >/dev/null 2>&1 3<&- &
    watcher=$!
fi

# Only now: the watcher must not begin with a trap that is not its own.
stop() { # STATUS, as by a signal
    trap '' INT TERM HUP
    [ -z "$watcher" ] || kill "$watcher" 2>/dev/null
    end_job
    exit "$1"
}
trap 'stop 130' INT
trap 'stop 143' TERM
trap 'stop 129' HUP

wait $job
status=$?
ended=0
if [ -n "$watcher" ]; then
    kill $watcher 2>/dev/null
    wait $watcher
    ended=$?
    end_job
fi
[ $status -le 128 ] || [ "$(kill -l $status 2>/dev/null)" != XCPU ] || ended=3
case $ended in
3) echo "limit.sh: ended after $cpu s of processor time: $*" >&2 ;;
4) echo "limit.sh: ended after $idle s of waiting: $*" >&2 ;;
*) exit $status ;;
esac
exit 124
