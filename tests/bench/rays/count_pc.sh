#!/bin/sh
# count_pc.sh - instructions per ray on this PC, and their growth with triangles
# SPDX-License-Identifier: MIT

usage() {
    cat <<'END'
usage: tests/bench/rays/count_pc.sh BENCH-PC PRECISION SCENE.qlb MESH.qlb
Count the instructions of each ray function with valgrind: the same on every run
of the same program. Prints rows of instructions per call, and of the growth
from the first scene to the second. PRECISION is what BENCH-PC was built for.

Example: tests/bench/rays/count_pc.sh build/bench-pc-draft draft \
    build/cornell.qlb build/mesh.qlb
END
}

if [ "${1-}" = --help ]; then
    usage
    exit 0
fi
if [ $# -ne 4 ]; then
    usage >&2
    exit 1
fi
program=$1
precision=$2
small=$3
large=$4

dir=$(mktemp -d) || exit 3
trap 'rm -rf "$dir"' EXIT

# count FUNCTION KIND SCENE: instructions per call, one fraction digit
count() {
    valgrind --tool=callgrind --callgrind-out-file=/dev/null \
        --toggle-collect="$1" "$program" --once "$3" \
        >"$dir/out" 2>"$dir/log" || { cat "$dir/log" >&2; return 3; }
    awk -v kind="$2:" '
        FNR == NR { if ($1 == kind) calls = $2; next }
        /Collected/ { n = $NF }
        END {
            if (!calls || !n) exit 2
            printf "%.1f\n", n / calls
        }' "$dir/out" "$dir/log"
}

# rows NAME FUNCTION KIND
rows() {
    a=$(count "$2" "$3" "$small") && b=$(count "$2" "$3" "$large") || {
        echo "count_pc.sh: cannot count $2" >&2
        exit 2
    }
    echo "# $1: $a instructions, $b with the large scene"
    awk -v a="$a" -v b="$b" -v name="$1" -v precision="$precision" 'BEGIN {
        printf "pc %s %s-growth-instructions: %.2f\n", precision, name, b / a
    }'
}

rows closest ql_bvh_closest_hit closest
rows shadow ql_bvh_occluded_but shadow
rows float-closest fp_closest closest
rows float-shadow fp_occluded shadow
