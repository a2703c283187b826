#!/bin/sh
# some.sh - a configuration has the bits of a build that has everything
# SPDX-License-Identifier: MIT
#
# usage: tests/golden/some.sh CONFIGURATION...
#
# Gates but QL_CFG_PRECISION and those of the tables change no bit: what a
# configuration of tests/configs can draw is compared with the checksums of
# full builds. Prints one claim a configuration. scenes.sh has made the blobs in
# build/golden; the programs are build/test/CONFIGURATION/golden/golden.
#
# Environment: BUILD (build).
#
# Example: tests/golden/some.sh p01 least

set -u
built=${BUILD:-build}
dir=$built/golden
. tests/support/claims.sh

for config; do
    suite=golden/$config
    golden=$built/test/$config/golden/golden
    bits=$("$golden" bits) && tables=$("$golden" tables) || bits=
    from=$dir/$("$golden" contact)
    set -- "${from}16/cornell.qlb" "${from}8/cornell.qlb" \
        "$from$bits"/corner-*.qlb
    if [ -z "$tables" ]; then
        for scene in square glossy sky lens smooth strategies; do
            set -- "$@" "$from$bits/$scene.qlb"
        done
    fi
    said=$("$golden" some tests/golden/checksums.txt "$@" 2>&1)
    status=$?
    [ $status -eq 0 ] || printf '%s\n' "$said"
    say gates_change_no_bit $status "$(printf '%s\n' "$said" | tail -n 1)"
done
changed=$dir/changed-$config.txt
awk '{ $2 = "00000000" } 1' tests/golden/checksums.txt >"$changed"
"$golden" some "$changed" "$@" >"$changed.log" 2>&1
[ $? -eq 1 ]
say changed_checksums_are_rejected $?
exit $((failures > 0))
