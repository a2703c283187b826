#!/bin/sh
# test_tutorial.sh - sim/FIRST_ROOM.md does what it says, picture by picture
# SPDX-License-Identifier: MIT
#
# usage: tests/tools/test_tutorial.sh [BUILD]
#
# Does everything on the page, an emulated board included, and compares every
# picture that is kept beside it, bit for bit.
#
# Example: tests/tools/test_tutorial.sh build

suite=tools/tutorial
. tests/support/claims.sh
BUILD=$(cd "${1:-${BUILD:-build}}" && pwd) || exit 3
export BUILD
unset MAKEFLAGS MFLAGS MAKELEVEL O V SCENE
work=$(mktemp -d) || exit 3
trap 'rm -rf "$work"' EXIT

tools/dev/tutorial.sh sim/FIRST_ROOM.md "$work/room" >"$work/said" 2>&1
say every_command_of_the_page_works $? "$(tail -n 1 "$work/said")"
grep -q '^identical: yes$' "$work/said"
say the_board_shows_what_the_pc_shows $?

pictures=$(sed -n 's|^!\[.*](tutorial/\(.*\.png\))$|\1|p' sim/FIRST_ROOM.md)
[ "$(echo "$pictures" | wc -l)" -ge 6 ]
say there_is_a_picture_at_each_step $?
bad=
for picture in $pictures; do
    cmp -s "$work/room/$picture" "sim/tutorial/$picture" || bad="$bad $picture"
done
[ -z "$bad" ]
say pictures_of_the_page_are_what_it_draws $? "$bad"
[ "$(find sim/tutorial -name '*.png' | wc -l)" -eq \
    "$(echo "$pictures" | wc -l)" ]
say no_picture_is_kept_that_the_page_does_not_show $?

cat >"$work/page" <<'END'
<!-- run -->

```sh
true && false
touch after
```
END
! tools/dev/tutorial.sh "$work/page" "$work/bad" >/dev/null 2>&1 &&
    [ ! -e "$work/bad/after" ]
say a_command_that_fails_ends_it $?
exit $((failures > 0))
