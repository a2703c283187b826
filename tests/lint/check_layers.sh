#!/bin/sh
# check_layers.sh - who may include whom: layers of the core, hal, sim, tools
# SPDX-License-Identifier: MIT
#
# usage: tests/lint/check_layers.sh
#
# A file of a layer includes its own layer and those to its left; the core never
# includes hal/, a file outside it or a libc header but the freestanding ones.
# The rest of the tree keeps to the table below; tests/ may include anything.
# Prints one claim a rule; exit 1 if any is broken.
#
# Example: tests/lint/check_layers.sh

set -u
layers='base math sample warp scene blob trace material light film render app'
suite=lint/layers
. tests/support/claims.sh
. tests/lint/tree.sh
files=$(tree_files '*.c' '*.h')
say_found "$files"

bad=
for layer in $layers; do
    seen=0
    for other in $layers; do
        if [ $seen -eq 1 ]; then
            bad="$bad $(grep -rn "#include \"$other/" "firmware/$layer")"
        fi
        [ "$other" = "$layer" ] && seen=1
    done
done
bad=$(echo $bad)
say_none a_layer_includes_only_itself_and_those_before_it "$bad"

bad=$(grep -l '#include "\(ql_hal\|\.\./\|hal/\|sim/\|tools/\)' \
    firmware/*/*.[ch] firmware/*/*/*.[ch] firmware/ql_config.h firmware/qlux.h |
    grep -v "^firmware/app/")
say_none the_core_never_includes_the_hal "$bad"

bad=$(grep -h '#include <' firmware/*.[ch] firmware/*/*.[ch] \
    firmware/*/*/*.[ch] | sort -u |
    grep -v '<\(stdbool\|stddef\|stdint\|limits\|string\)\.h>')
say_none the_core_includes_only_freestanding_headers "$bad"

bad=$(grep -nE '\b(float|double|malloc|calloc|realloc|free)\b' \
    firmware/*.[ch] firmware/*/*.[ch] firmware/*/*/*.[ch] |
    grep -vE ':[0-9]+:[[:space:]]*(\*|/\*|//)')
say_none the_core_names_no_floating_point_type_and_no_heap "$bad"

# Sorted, because qlux.c has them in the order of the layers.
mkdir -p "${BUILD:-build}"
for f in firmware/*/*.c firmware/*/*/*.c; do
    echo "${f#firmware/}"
done | grep -v '^app/' | sort > "${BUILD:-build}/core.files"
bad=$(sed -n 's/^#include "\(.*\)"$/\1/p' firmware/qlux.c | sort |
    diff - "${BUILD:-build}/core.files")
say_none qlux_c_has_every_file_of_the_core_once "$bad"

# Folder, and what its files may include beside files of that folder.
rules='
firmware/app/  ^firmware/|^hal/ql_hal.h
firmware/      ^firmware/
hal/           ^firmware/(base|app)/|^firmware/[^/]*$
sim/           ^firmware/|^hal/ql_hal.h|^tools/lib/
tools/lib/     ^firmware/
tools/figure/  ^firmware/|^tools/lib/
tools/[^/]*/   ^firmware/|^tools/lib/|^tools/figure/
tests/         .
'
# shellcheck disable=SC2086  # no name has a space
bad=$(awk -f tests/lint/includes.awk $files < /dev/null |
    awk -v rules="$rules" '
        BEGIN {
            n = split(rules, row, "\n")
            for (i = 2; i < n; i++) {
                split(row[i], part, " ")
                folder[i] = "^" part[1]
                may[i] = part[2]
            }
        }
        {
            for (i = 2; i < n && $1 !~ folder[i]; i++) continue
            own = i < n && match($1, folder[i]) ? substr($1, 1, RLENGTH) : "?"
            if (i == n || index($2, own) != 1 && $2 !~ may[i])
                print $1 "->" $2
        }')
say_none every_folder_includes_only_what_it_may "$bad"

exit $((failures > 0))
