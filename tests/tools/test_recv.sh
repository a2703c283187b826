#!/bin/sh
# test_recv.sh - qlux-recv gives the exact picture, or none and a reason
# SPDX-License-Identifier: MIT

recv=${1:-${BUILD:-build}/qlux-recv}
stream=${2:-${BUILD:-build}/test/fine/tools/stream_main}
if [ "${1-}" = --help ]; then
    echo 'usage: tests/tools/test_recv.sh [QLUX-RECV STREAM]'
    echo 'Example: tests/tools/test_recv.sh'
    exit 0
fi

for program in "$recv" "$stream"; do
    if [ ! -x "$program" ]; then
        echo "test_recv.sh: $program is not built" >&2
        exit 1
    fi
done

dir=$(mktemp -d) || exit 3
trap 'rm -rf "$dir"' EXIT
suite=tools/test_recv
. tests/support/claims.sh

# receive WANTED-STATUS: of $dir/s; output in $dir/o.ppm, $dir/out and $dir/err.
receive() {
    rm -f "$dir/o.ppm"
    "$recv" "$dir/s" -o "$dir/o.ppm" --stats --quiet \
        >"$dir/out" 2>"$dir/err"
    got=$?
    [ "$got" -eq "$1" ] || {
        echo "status $got, wanted $1: $(cat "$dir/err")" >&2
        return 1
    }
    # A failure leaves nothing: no picture, no temporary file.
    [ "$1" -eq 0 ] || [ "$(ls "$dir" | tr '\n' ' ')" = "$left" ]
}
left='err out s want.ppm '

# What stream_main.c says: red = x, green = y, blue = x ^ y.
{
    printf 'P6\n5 4\n255\n'
    for y in 0 1 2 3; do
        for x in 0 1 2 3 4; do
            printf "\\$(printf %03o $x)\\$(printf %03o $y)"
            printf "\\$(printf %03o $((x ^ y)))"
        done
    done
} >"$dir/want.ppm"

"$stream" 0 5 4 >"$dir/s"
size=$(wc -c <"$dir/s")
receive 0 && cmp "$dir/o.ppm" "$dir/want.ppm" &&
    grep -qx 'closest-rays: 6' "$dir/out" &&
    grep -qx 'nanoseconds: 3000000' "$dir/out"
say whole_stream_gives_the_exact_picture $?

"$recv" - -o "$dir/o.ppm" --quiet <"$dir/s" && cmp "$dir/o.ppm" "$dir/want.ppm"
say stdin_works_as_well $?

mkfifo "$dir/fifo"
{ head -c 60 "$dir/s"; sleep 1; tail -c +61 "$dir/s"; sleep 2; } >"$dir/fifo" &
"$recv" "$dir/fifo" -o "$dir/o.ppm" --quiet && cmp "$dir/o.ppm" "$dir/want.ppm"
say pause_within_a_line_is_harmless $?
rm "$dir/fifo"

bad=0
i=0
while [ "$i" -lt "$size" ]; do
    "$stream" 0 5 4 flip "$i" >"$dir/s"
    receive 2 || bad=1
    i=$((i + 1))
done
say "byte_flipped_at_any_of_${size}_places_is_noticed" $bad

bad=0
i=0
while [ "$i" -lt "$size" ]; do
    "$stream" 0 5 4 cut "$i" >"$dir/s"
    receive 2 || bad=1
    i=$((i + 1))
done
say "stream_cut_at_any_of_${size}_places_is_noticed" $bad

"$stream" 0 5 4 noise >"$dir/s"
receive 0 && cmp "$dir/o.ppm" "$dir/want.ppm" &&
    ! grep -qx 'skipped-bytes: 0' "$dir/out"
say garbage_between_frames_is_skipped $?

{ head -c 100000 /dev/zero | tr '\0' '\245'; "$stream" 0 5 4; } >"$dir/s"
receive 0 && cmp "$dir/o.ppm" "$dir/want.ppm"
say hundred_thousand_false_marks_are_skipped $?

"$stream" 0 5 4 twice 2 >"$dir/s"
receive 0 && cmp "$dir/o.ppm" "$dir/want.ppm" &&
    grep -qx 'duplicate-lines: 1' "$dir/out"
say line_sent_twice_is_harmless $?

"$stream" 0 5 4 drop 2 >"$dir/s"
receive 2 && grep -q 'lines 2 are missing' "$dir/err"
say missing_line_is_named $?

# Header 25, then lines of 26: a pixel of line 1 lies at 25 + 26 + 12.
"$stream" 0 5 4 flip 63 >"$dir/s"
receive 2 && grep -q 'lines 1 have a wrong CRC' "$dir/err"
say line_with_wrong_crc_is_named $?

"$stream" 0 5 4 status -12 >"$dir/s"
receive 2 && grep -q 'status -12: stopped by the user' "$dir/err"
say status_of_the_board_is_reported $?

{ printf 'qlux: panic\n'; "$stream" 0 5 4; } >"$dir/s"
receive 0 && grep -qx 'board: panic' "$dir/err"
say text_from_the_board_is_shown $?

# A restarted board sends its header again: only the last picture counts.
{ "$stream" 0 3 9 cut 60; "$stream" 0 5 4; } >"$dir/s"
receive 0 && cmp "$dir/o.ppm" "$dir/want.ppm"
say second_header_begins_again $?

# One pixel of each format, from the definition of each.
pixel() {
    "$stream" "$1" "$2" 1 >"$dir/s"
    receive 0 && [ "$(tail -c "$3" "$dir/o.ppm" | od -An -tx1 |
        tr -d ' \n')" = "$4" ]
}
# Bytes 00 01 02 03: RGB565_LE is 0x0100 and 0x0302.
pixel 1 2 6 002000006110
say rgb565_low_byte_first_is_decoded $?
# RGB565_BE is 0x0001 and 0x0203.
pixel 2 2 6 000008004118
say rgb565_high_byte_first_is_decoded $?
pixel 3 3 9 000000010101020202
say gray8_is_decoded $?
# Nibbles 0 0 0 1.
pixel 4 4 12 000000000000000000111111
say gray4_high_nibble_is_left $?

# The extension says what is written; a board sends no linear radiance.
"$stream" 0 5 4 >"$dir/s"
"$recv" "$dir/s" -o "$dir/o.png" --quiet &&
    [ "$(head -c 4 "$dir/o.png" | od -An -tx1 | tr -d ' \n')" = 89504e47 ] &&
    "${recv%recv}diff" "$dir/o.png" "$dir/want.ppm" | grep -qx 'identical: yes'
say png_is_a_png_of_the_same_picture $?
rm -f "$dir/o.png"
for name in o.pfm o.jpg o; do
    "$recv" "$dir/s" -o "$dir/$name" 2>"$dir/err"
    [ $? -eq 1 ] && grep -q 'ends in .ppm or .png' "$dir/err" &&
        [ ! -e "$dir/$name" ]
    say "${name}_is_refused" $?
done

# A board that sends the first lines and then nothing more.
mkfifo "$dir/fifo"
for signal in INT TERM; do
    "$recv" "$dir/fifo" -o "$dir/stop.ppm" --quiet 2>"$dir/err" &
    child=$!
    exec 3>"$dir/fifo" # opens once qlux-recv has
    head -c 60 "$dir/s" >&3
    kill -$signal $child
    wait $child
    code=$?
    exec 3>&-
    [ $code -eq 3 ] && grep -q 'interrupted; nothing was written' "$dir/err" &&
        [ "$(ls "$dir" | grep -c -e stop -e tmp)" -eq 0 ]
    say "stopped_by_${signal}_exits_3_and_writes_nothing" $?
done
rm "$dir/fifo"

"$recv" "$dir/none" -o "$dir/o.ppm" 2>/dev/null
[ $? -eq 3 ]
say missing_device_exits_3 $?
"$recv" "$dir/s" -o "$dir/none/o.ppm" --quiet 2>/dev/null
[ $? -eq 3 ]
say unwritable_output_exits_3 $?

exit $((failures > 0))
