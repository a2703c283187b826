#!/bin/sh
# tutorial.sh - do what a page says: write its files, run its commands
# SPDX-License-Identifier: MIT

usage() {
    cat <<'END'
usage: tools/dev/tutorial.sh PAGE DIR
In the folder DIR, which is made, write each block of PAGE behind a line
"<!-- file NAME -->" to NAME, and run each one behind "<!-- run -->", in their
order. The programs and the tree are there as they are where qlux was built.
Ends at the first command that fails, with its status.

Example: tools/dev/tutorial.sh sim/FIRST_ROOM.md build/tutorial
END
}

case ${1-} in
--help) usage; exit 0 ;;
esac
if [ $# -ne 2 ]; then
    usage >&2
    exit 1
fi
root=$(pwd)
built=$(cd "${BUILD:-build}" && pwd) || exit 3
rm -rf "$2"
mkdir -p "$2" || exit 3
awk -v dir="$2" '
    /^<!-- file .* -->$/ { to = dir "/" $3; next }
    /^<!-- run -->$/ { to = dir "/commands"; next }
    /^```/ {
        inside = !inside && to != ""
        if (!inside)
            to = ""
        next
    }
    inside { print >to }' "$1"
cd "$2" || exit 3
for part in Makefile firmware hal linker sim tests tools; do
    ln -s "$root/$part" "$part" || exit 3
done
ln -s "$built" build || exit 3
unset MAKEFLAGS MFLAGS MAKELEVEL
sh -e -x ./commands
