#!/bin/sh
# test_stack.sh - no run uses more stack than the bound proved for it
# SPDX-License-Identifier: MIT

usage() {
    cat <<'END'
usage: tests/boards/test_stack.sh ELF BOUND NM EMULATOR [ARGUMENT...]
Run the firmware of a real board, look how much of its stack was ever written
(the emulator's memory begins all zero), print that, and compare with BOUND.

Example: tests/boards/test_stack.sh build/microbit/cornell.elf 1500 \
    arm-none-eabi-nm qemu-system-arm -M microbit
END
}

case ${1-} in
--help) usage; exit 0 ;;
esac
if [ $# -lt 4 ]; then
    usage >&2
    exit 1
fi
elf=$1
bound=$2
bottom=0x$("$3" "$elf" | sed -n 's/ . ql_ld_stack_bottom$//p')
top=0x$("$3" "$elf" | sed -n 's/ . ql_ld_stack_top$//p')
size=$((top - bottom))
shift 3

dir=$(mktemp -d) || exit 3
trap 'rm -rf "$dir"' EXIT
tests/boards/with_monitor.sh "$elf" "$dir/picture.ppm" \
    "memsave $bottom $size \"$dir/stack\"" "$@" || exit

# The first word that is not zero is the deepest.
used=$(od -An -v -tx4 -w4 "$dir/stack" | awk -v size="$size" '
    $1 != "00000000" { print size - 4 * (NR - 1); exit }')
echo "stack-used: $used"
if [ -z "$used" ] || [ "$used" -gt "$bound" ]; then
    echo "test_stack.sh: $used bytes used, at most $bound were proved" >&2
    exit 1
fi
