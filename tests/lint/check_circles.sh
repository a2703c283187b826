#!/bin/sh
# check_circles.sh - no file and no folder needs one that needs it
# SPDX-License-Identifier: MIT
#
# usage: tests/lint/check_circles.sh [--order]
#   --order  print the folders of tools/, each after those that it includes
#
# Who needs whom is who includes whom. A header and the .c of its name are one
# file here. A contract is a folder of its own: one side implements what the
# other calls, and neither includes the other. Contracts are the headers right
# in firmware/, hal/ql_hal.h, and hal/drivers/ql_bus.h between board and driver.
#
# The order in tools/, each may include those to its left:
#   lib/program  lib/math  lib/image  lib/render  figure  and then the programs;
#   of scene: world  read  mesh  blob  build, then what is beside them
# Prints one claim a rule; exit 1 if any is broken.
#
# Example: tests/lint/check_circles.sh

set -u
suite=lint/circles
. tests/support/claims.sh
# shellcheck disable=SC2046  # no name has a space
includes=$(awk -f tests/lint/includes.awk $(git ls-files '*.c' '*.h') |
    grep -v '/ql_real_small.h ')

# Arrows "FROM TO" that are part of a circle, or lie between two: what is left
# when whatever needs nothing, or is needed by nothing, has been taken away.
circles()
{
    sort -u | awk '
        $1 != $2 { from[++n] = $1; to[n] = $2 }
        END {
            do {
                split("", needs)
                split("", needed)
                for (i = 1; i <= n; i++) {
                    needs[from[i]] = 1
                    needed[to[i]] = 1
                }
                left = 0
                for (i = 1; i <= n; i++) {
                    if (from[i] in needed && to[i] in needs) {
                        from[++left] = from[i]
                        to[left] = to[i]
                    }
                }
                gone = n - left
                n = left
            } while (gone > 0)
            for (i = 1; i <= n; i++) print from[i] "->" to[i]
        }'
}

# Arrows between folders, contracts as folders of their own.
folders()
{
    echo "$includes" | awk '
        function folder(path) {
            if (path !~ /^firmware\/[^\/]*$|\/ql_(hal|bus)\.h$/)
                sub(/\/[^\/]*$/, "", path)
            return path
        }
        { print folder($1), folder($2) }'
}

if [ "${1-}" = --order ]; then
    folders | awk '
        $1 ~ /^tools/ && $2 ~ /^tools/ && $1 != $2 { print $2, $1 }' |
        sort -u | tsort
    exit
fi

[ "$(printf 'a b\nb c\nc a\nc d\ne a\n' | circles | wc -l)" -eq 3 ]
say a_circle_of_three_among_five_arrows_is_seen $?
say_none no_file_needs_one_that_needs_it "$(echo "$includes" |
    sed 's/\.[ch] / /; s/\.[ch]$//' | circles)"
say_none no_folder_of_tools_needs_one_that_needs_it "$(folders |
    awk '$1 ~ /^tools/ && $2 ~ /^tools/' | circles)"
say_none no_folder_of_the_rest_needs_one_that_needs_it "$(folders |
    awk '$1 !~ /^t/ && $2 !~ /^t/' | circles)"
exit $((failures > 0))
