#!/bin/sh
# count_warps.sh - instructions per call of each warp on this PC
# SPDX-License-Identifier: MIT

usage() {
    cat <<'END2'
usage: tests/bench/warps/count_warps.sh WARPS-PC PRECISION
Count the instructions of each warp with valgrind, the loop around it taken off:
the same on every run of the same program. PRECISION is what WARPS-PC was built
for. Prints rows "pc PRECISION warp-NAME: N".

Example: tests/bench/warps/count_warps.sh build/warps-pc-draft draft
END2
}

if [ "${1-}" = --help ]; then
    usage
    exit 0
fi
if [ $# -ne 2 ]; then
    usage >&2
    exit 1
fi

dir=$(mktemp -d) || exit 3
trap 'rm -rf "$dir"' EXIT

valgrind --tool=callgrind --callgrind-out-file="$dir/calls" "$1" \
    >"$dir/names" 2>"$dir/log" || {
    cat "$dir/log" >&2
    exit 2
}
callgrind_annotate --inclusive=yes --threshold=100 "$dir/calls" \
    >"$dir/counts" || exit 2

# names: "NAME: CALLS"; counts: "1,234 (5.6%)  FILE:FUNCTION [PROGRAM]".
awk -v precision="$2" '
    FNR == NR { sub(":", "", $1); names[++n] = $1; calls = $2; next }
    match($0, /:warp_batch_[a-z_]+/) {
        name = substr($0, RSTART + 12, RLENGTH - 12)
        gsub(",", "", $1)
        got[name] = $1
    }
    END {
        for (i = 1; i <= n; i++) {
            if (!(names[i] in got) || !("empty" in got)) {
                print "count_warps.sh: no count of " names[i] >"/dev/stderr"
                exit 2
            }
            row = names[i]
            gsub("_", "-", row)
            printf "pc %s warp-%s: %.0f\n", precision, row,
                (got[names[i]] - got["empty"]) / calls
        }
    }' "$dir/names" "$dir/counts"
