#!/bin/sh
# flash.sh - load a firmware onto a real board, or say what is missing for it
# SPDX-License-Identifier: MIT

usage() {
    cat <<'END'
usage: tools/dev/flash.sh DRAG [TOOL ARGUMENT...]
Run the TOOL that loads a firmware. If it is not installed, say how to get it,
and DRAG, which is how the board is loaded without any tool, unless it is empty.
Without a TOOL say DRAG.

Exit codes: the TOOL's; 0 if there is none to run; 3 if it is not installed.

Example: tools/dev/flash.sh 'copy room.hex to the drive MICROBIT' \
    pyocd flash -t nrf51 room.elf
END
}

case ${1-} in
--help) usage; exit 0 ;;
esac
if [ $# -lt 1 ]; then
    usage >&2
    exit 1
fi
drag=$1
shift
if [ $# -eq 0 ]; then
    echo "$drag"
    exit 0
fi
command -v "$1" >/dev/null && exec "$@"

case $1 in
pyocd) how='pipx install pyocd' ;;
*) how="sudo apt install $1" ;;
esac
echo "flash.sh: $1 is not installed: $how${drag:+; or $drag}" >&2
exit 3
