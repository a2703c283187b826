#!/bin/sh
# with_monitor.sh - run a firmware to its last frame, then ask the emulator
# SPDX-License-Identifier: MIT

usage() {
    cat <<'END'
usage: tests/boards/with_monitor.sh ELF PICTURE.ppm COMMAND EMULATOR...
Run the firmware of a real board, which sleeps when it is done; once its last
frame has come, give COMMAND to the monitor of QEMU and end it.

Example: tests/boards/with_monitor.sh build/lm3s6965evb/cornell.elf \
    picture.ppm 'screendump panel.ppm' qemu-system-arm -M lm3s6965evb
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
picture=$2
command=$3
shift 3

dir=$(mktemp -d) || exit 3
emulator=
trap '[ -z "$emulator" ] || kill "$emulator" 2>/dev/null; rm -rf "$dir"' EXIT
mkfifo "$dir/serial" "$dir/monitor" || exit 3

tools/dev/limit.sh --cpu 60 "$@" -display none -icount shift=0 \
    -serial "file:$dir/serial" -monitor stdio -kernel "$elf" \
    <"$dir/monitor" >"$dir/log" 2>&1 &
emulator=$!
exec 3>"$dir/monitor"
"${BUILD:-build}/qlux-recv" "$dir/serial" -o "$picture" --quiet || exit

printf '%s\nquit\n' "$command" >&3
wait "$emulator"
status=$?
emulator=
[ "$status" -eq 0 ] || cat "$dir/log" >&2
exit "$status"
