#!/bin/sh
# check_circles.sh - no file and no folder needs one that needs it
# SPDX-License-Identifier: MIT
#
# usage: tests/lint/check_circles.sh [--order | --list]
#   --list   also print every arrow of a circle between files
#   --order  print the folders of tools/, each after those that it includes
#
# Who needs whom is who includes whom. A header and the .c of its name are one
# file here. A contract is a folder of its own: one side implements what the
# other calls, and neither includes the other. Contracts are the headers right
# in firmware/, hal/ql_hal.h, and hal/drivers/ql_bus.h between board and driver.
#
# The order in tools/, each may include those to its left:
#   lib/program  lib/files  lib/math  lib/image  lib/terminal  lib/sums
#   lib/render  figure
#   and then the programs;
#   of scene: world  fill  crease  lamp  foreign  read  script  mesh  bare
#   touch  blob  report  build, then others
# Prints one claim a rule; exit 1 if any is broken.
#
# Example: tests/lint/check_circles.sh

set -u
arrows_max=0 # arrows of circles between files
suite=lint/circles
. tests/support/claims.sh
. tests/lint/tree.sh
files=$(tree_files '*.c' '*.h')
# shellcheck disable=SC2086  # no name has a space
includes=$(awk -f tests/lint/includes.awk $files < /dev/null)

# Arrows "FROM TO" that are part of a circle. What needs nothing, or is needed
# by nothing, is taken away until none is left; then who reaches whom is known.
circles()
{
    sort -u | awk '
        function take_away(i, left, before) {
            do {
                split("", needs)
                split("", needed)
                for (i = 1; i <= n; i++) {
                    needs[from[i]] = 1
                    needed[to[i]] = 1
                }
                before = n
                for (i = 1; i <= before; i++) {
                    if (i == 1) n = 0
                    if (from[i] in needed && to[i] in needs) {
                        from[++n] = from[i]
                        to[n] = to[i]
                    }
                }
            } while (n < before)
        }
        $1 != $2 { from[++n] = $1; to[n] = $2 }
        END {
            take_away()
            for (i = 1; i <= n; i++) reaches[from[i], to[i]] = 1
            for (k in needs)
                for (i in needs)
                    for (j in needs)
                        if ((i, k) in reaches && (k, j) in reaches)
                            reaches[i, j] = 1
            for (i = 1; i <= n; i++)
                if ((to[i], from[i]) in reaches) print from[i] "->" to[i]
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

say_found "$files"
[ "$(printf '%s\n' 'a b' 'b c' 'c a' 'c d' 'd e' 'e f' 'f e' 'g a' | circles |
    paste -s -d ' ' -)" = 'a->b b->c c->a e->f f->e' ]
say circles_of_three_and_two_are_seen_and_nothing_else $?
arrows=$(echo "$includes" | sed 's/\.[ch] / /; s/\.[ch]$//' | circles)
count=$(printf '%s' "$arrows" | grep -c '')
[ "$count" -le $arrows_max ]
say few_files_need_one_that_needs_it $? "$count arrows, at most $arrows_max"
if [ "$count" -gt $arrows_max ] || [ "${1-}" = --list ]; then
    echo "$arrows" | sed 's/^/    /'
fi
say_none no_folder_of_tools_needs_one_that_needs_it "$(folders |
    awk '$1 ~ /^tools/ && $2 ~ /^tools/' | circles)"
say_none no_folder_of_the_rest_needs_one_that_needs_it "$(folders |
    awk '$1 !~ /^t/ && $2 !~ /^t/' | circles)"
exit $((failures > 0))
