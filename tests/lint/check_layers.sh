#!/bin/sh
# check_layers.sh - who may include whom: base, math, .. render, app
# SPDX-License-Identifier: MIT
#
# usage: tests/lint/check_layers.sh
#
# A file of a layer includes its own layer and those to its left; the core never
# includes hal/, a file outside it or a libc header but the freestanding ones.
# Prints one claim a rule; exit 1 if any is broken.
#
# Example: tests/lint/check_layers.sh

set -u
layers='base math sample warp scene blob trace material light film render app'
suite=lint/layers
. tests/support/claims.sh

bad=
for layer in $layers; do
    seen=0
    for other in $layers; do
        if [ $seen -eq 1 ]; then
            bad="$bad $(grep -n "#include \"$other/" firmware/"$layer"/*.[ch])"
        fi
        [ "$other" = "$layer" ] && seen=1
    done
done
bad=$(echo $bad)
say_none a_layer_includes_only_itself_and_those_before_it "$bad"

bad=$(grep -l '#include "\(ql_hal\|\.\./\|hal/\|sim/\|tools/\)' \
    firmware/*/*.[ch] firmware/ql_config.h firmware/qlux.h |
    grep -v "^firmware/app/ql_app\.")
say_none the_core_never_includes_the_hal "$bad"

bad=$(grep -h '#include <' firmware/*.[ch] firmware/*/*.[ch] | sort -u |
    grep -v '<\(stdbool\|stddef\|stdint\|limits\|string\)\.h>')
say_none the_core_includes_only_freestanding_headers "$bad"

bad=$(grep -nE '\b(float|double|malloc|calloc|realloc|free)\b' \
    firmware/*.[ch] firmware/*/*.[ch] |
    grep -vE ':[0-9]+:[[:space:]]*(\*|/\*|//)')
say_none the_core_names_no_floating_point_type_and_no_heap "$bad"

exit $((failures > 0))
