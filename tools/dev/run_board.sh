#!/bin/sh
# run_board.sh - run a firmware in its emulator and receive its picture
# SPDX-License-Identifier: MIT

usage() {
    cat <<'END'
usage: tools/dev/run_board.sh [--quiet] [--count FILE] ELF OUT.ppm \
           EMULATOR [ARGUMENT...]
Start the emulator with the firmware, receive its picture from the serial port
while it renders, print the board's counters, and exit with the firmware's
status (0 done; 124 after TIMEOUT seconds of this PC's processor time, 120 if
unset, or when the board sleeps for ever).

One instruction takes one nanosecond of the board's time (-icount shift=0), so
"instructions" is exact and the same on every PC. With --count FILE has it too,
once the picture is complete.

Example: tools/dev/run_board.sh build/microbit/cornell-emulated.elf o.ppm \
    qemu-system-arm -M microbit
END
}

quiet=
count=
while :; do
    case ${1-} in
    --help) usage; exit 0 ;;
    --quiet) quiet=--quiet; shift ;;
    --count) count=${2-}; shift 2 ;;
    *) break ;;
    esac
done
if [ $# -lt 3 ]; then
    usage >&2
    exit 1
fi
elf=$1
out=$2
shift 2

recv=${BUILD:-build}/qlux-recv
for file in "$recv" "$elf"; do
    if [ ! -r "$file" ]; then
        echo "run_board.sh: cannot read $file" >&2
        exit 3
    fi
done

dir=$(mktemp -d) || exit 3
emulator=
trap 'rm -rf "$dir"' EXIT
trap '[ -z "$emulator" ] || kill "$emulator" 2>/dev/null; exit 3' INT TERM
mkfifo "$dir/serial" || exit 3

"$(dirname "$0")/limit.sh" --cpu "${TIMEOUT:-120}" "$@" \
    -display none -monitor none -serial stdio -icount shift=0 \
    -semihosting-config enable=on,target=native \
    -kernel "$elf" </dev/null >"$dir/serial" 2>"$dir/log" &
emulator=$!
"$recv" "$dir/serial" -o "$out" --stats $quiet >"$dir/stats"
received=$?
# The last frame has come, or never will: the board ends within seconds.
wait "$emulator"
status=$?

# The ticks are those of the emulator's time, which is not the chip's.
sed '/^tick/d; s/^nanoseconds: /instructions: /' "$dir/stats"
if [ "$status" -ne 0 ]; then
    [ "$status" -ne 124 ] || echo "run_board.sh: timed out" >&2
    grep -v 'Timer with period zero' "$dir/log" >&2
    echo "run_board.sh: $elf ended with status $status" >&2
    exit "$status"
fi
if [ "$received" -eq 0 ] && [ -n "$count" ]; then
    sed -n 's/^nanoseconds: //p' "$dir/stats" >"$count" || exit 3
fi
exit "$received"
