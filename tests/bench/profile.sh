#!/bin/sh
# profile.sh - where the instructions of a path go, by source
# SPDX-License-Identifier: MIT

usage() {
    cat <<'END'
usage: tests/bench/profile.sh ELF PREFIX CORE EMULATOR [ARGUMENT...]
Run the firmware ELF of bench_profile.c, which prints its row "CORE PRECISION
path: N", one instruction at a time, count each, and print a row
"CORE PRECISION path-in-SOURCE: N" for every source that has 1 % of a path or
more, largest first, and for all others together "path-in-rest". What is
inlined from base or math counts for the source that calls it, and what rays
cost is told apart: closest-SOURCE, shadow-SOURCE. Opening the scene and the
board's own code are left out. PREFIX is that of the binutils.

Example: make bench-profile BOARDS=lm3s6965evb
END
}

case ${1-} in
--help) usage; exit 0 ;;
esac
if [ $# -lt 4 ]; then
    usage >&2
    exit 1
fi
elf=$1
prefix=$2
core=$3
shift 3

dir=$(mktemp -d) || exit 3
trap 'rm -rf "$dir"' EXIT
# The log has a line an instruction: Trace 0: HOST [FLAGS/PC/FLAGS/FLAGS] NAME
mkfifo "$dir/log" || exit 3
awk -F / '/^Trace/ { n[$2]++ } END { for (at in n) print at, n[at] }' \
    "$dir/log" >"$dir/counts" &
"$(dirname "$0")/../../tools/dev/limit.sh" --cpu 300 "$@" -display none \
    -monitor none -serial "file:$dir/rows" -icount shift=0 -singlestep \
    -d exec,nochain -D "$dir/log" -semihosting-config enable=on,target=native \
    -kernel "$elf" </dev/null 2>"$dir/errors"
status=$?
wait
if [ "$status" -ne 0 ]; then
    cat "$dir/errors" >&2
    echo "profile.sh: $elf ended with status $status" >&2
    exit "$status"
fi
grep -v '^#' "$dir/rows"
{
    cat "$dir/rows" "$dir/counts"
    cut -d ' ' -f 1 "$dir/counts" | "${prefix}addr2line" -a -i -f -e "$elf"
} | tr -d '\r' | awk -v core="$core" '
    # Its calls inlined into each other, innermost first: function, then place.
    function flush(    source, i) {
        if (at == "")
            return
        for (i = 1; i < depth && place[i] ~ /\/firmware\/(base|math)\//; i++)
            ;
        source = place[i]
        sub(/:[0-9?]+( .*)?$/, "", source)
        if (source ~ /\/(firmware\/(blob|app)|hal|tests)\/|\/ql_crc/ ||
            name[depth] ~ /_init|^reach_of$|^ql_blob_/) # once a picture
            return
        sub(/.*\//, "", source)
        if (source == "??")
            source = "libgcc"
        for (i = 1; i <= depth; i++)
            if (name[i] == "ql_bvh_closest_hit")
                source = "closest-" source
            else if (name[i] ~ /^(ql_bvh_occluded|is_blocked)$/)
                source = "shadow-" source
        total[source] += times[at]
    }
    / path: / { precision = $2; path = $4; next }
    /^# paths: / { paths = $3; next }
    NF == 2 && /^[0-9a-f]+ [0-9]+$/ { times[$1] = $2; next }
    /^0x/ {
        flush()
        at = substr($1, 3)
        depth = 0
        next
    }
    at != "" && !odd { name[depth + 1] = $1; odd = 1; next }
    at != "" { place[++depth] = $1; odd = 0 }
    END {
        flush()
        sort = "sort -t : -k 2 -n -r"
        for (source in total) {
            n = total[source] / paths
            sum += n
            if (n < path / 100)
                rest += n
            else
                printf("%s %s path-in-%s: %.0f\n", core, precision, source, \
                    n) | sort
        }
        close(sort)
        printf "%s %s path-in-rest: %.0f\n", core, precision, rest
        if (paths == 0 || sum < path * 0.99 || sum > path * 1.01) {
            printf "profile.sh: %.0f of %d instructions\n", sum, path
            exit 2
        }
    }'
