#!/bin/sh
# test_recv.sh - qlux-recv gives every good line, and a reason for each other
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

# receive WANTED-STATUS [OPTION]: of $dir/s; output in $dir/o.ppm, $dir/out and
# $dir/err, no temporary file.
receive() {
    rm -f "$dir/o.ppm"
    # shellcheck disable=SC2086 # an option or none
    "$recv" "$dir/s" -o "$dir/o.ppm" --stats --quiet ${2-} \
        >"$dir/out" 2>"$dir/err"
    got=$?
    [ "$got" -eq "$1" ] || {
        echo "status $got, wanted $1: $(cat "$dir/err")" >&2
        return 1
    }
    [ "$(ls "$dir" | grep -c tmp)" -eq 0 ]
}
# refused: no picture at all
refused() { receive 2 && [ ! -e "$dir/o.ppm" ]; }
# gaps VALUE LINE...: the picture, with each byte of these lines this value
gaps() {
    value=$1
    shift
    cp "$dir/want.ppm" "$dir/gaps"
    for y in "$@"; do
        { head -c $((11 + 15 * y)) "$dir/gaps"
          head -c 15 /dev/zero | tr '\0' "\\$value"
          tail -c +$((11 + 15 * y + 16)) "$dir/gaps"; } >"$dir/more" &&
            mv "$dir/more" "$dir/gaps"
    done
    cmp "$dir/gaps" "$dir/o.ppm"
    same=$?
    rm "$dir/gaps"
    return $same
}

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
gaps 0 2
say missing_line_is_black $?
receive 2 --partial && gaps 200 2 && figures_of=$(sed -n 's/^spp: //p' \
    "$dir/out") && [ "$figures_of" = 16 ]
say missing_line_is_grey_if_asked_for $?
cp "$dir/s" "$dir/t"
"$recv" "$dir/t" -o "$dir/o.png" --partial --quiet 2>"$dir/err"
[ $? -eq 2 ] && "${recv%recv}diff" "$dir/o.png" "$dir/o.ppm" |
    grep -qx 'identical: yes'
say picture_with_gaps_is_a_png_too $?
rm "$dir/o.png" "$dir/t"

# Header 25, then lines of 26: a pixel of line 1 lies at 25 + 26 + 12.
"$stream" 0 5 4 flip 63 >"$dir/s"
receive 2 && grep -q 'lines 1 have a wrong CRC' "$dir/err"
say line_with_wrong_crc_is_named $?

# A damaged copy of a line that arrived says nothing of it: line 2 is missing.
{
    "$stream" 0 5 4 drop 2 | head -c 77
    "$stream" 0 5 4 flip 63 | tail -c +52 | head -c 26
    "$stream" 0 5 4 drop 2 | tail -c +78
} >"$dir/s"
receive 2 && grep -q 'lines 2 are missing' "$dir/err" &&
    ! grep -q 'CRC' "$dir/err"
say damaged_copy_of_a_line_that_arrived_is_harmless $?

"$stream" 0 5 4 status -12 >"$dir/s"
receive 2 && grep -q 'status -12: stopped by the user' "$dir/err"
say status_of_the_board_is_reported $?

{ printf 'qlux: panic\n'; "$stream" 0 5 4; } >"$dir/s"
receive 0 && grep -qx 'board: panic' "$dir/err"
say text_from_the_board_is_shown $?

{ printf 'qlux: a\001qlux: b\nno: c\nqlux: d\n'; "$stream" 0 5 4; } >"$dir/s"
receive 0 && [ "$(grep board: "$dir/err" | tr '\n' ' ')" = \
    'board: b board: d ' ]
say text_begins_again_after_what_is_none $?

# A restarted board sends its header again: only the last picture counts, and
# lines from before it if it is the same.
{ "$stream" 0 3 9 cut 60; "$stream" 0 5 4; } >"$dir/s"
receive 0 && cmp "$dir/o.ppm" "$dir/want.ppm" &&
    grep -q 'another header: 1 of 9 lines' "$dir/err"
say second_header_begins_again $?
{ "$stream" 0 5 4 shade 1 cut 80; "$stream" 0 5 4; } >"$dir/s"
receive 0 && cmp "$dir/o.ppm" "$dir/want.ppm" &&
    grep -q 'another header: 2 of 4 lines' "$dir/err"
say same_header_with_another_picture_begins_again $?
{ "$stream" 0 5 4 cut 103; "$stream" 0 5 4 drop 1; } >"$dir/s"
receive 0 && cmp "$dir/o.ppm" "$dir/want.ppm" &&
    grep -qx 'duplicate-lines: 2' "$dir/out"
say lines_from_before_a_restart_fill_its_gaps $?
# None of those before came again: nothing says that they are the same picture.
{ "$stream" 0 5 4 cut 51; "$stream" 0 5 4 drop 0; } >"$dir/s"
receive 2 && gaps 0 0
say lines_from_before_that_nothing_confirms_are_left_out $?
{ "$stream" 0 5 4 cut 103; "$stream" 0 0 4; "$stream" 0 5 4 | tail -c +26
} >"$dir/s"
receive 2 && gaps 0 3
say senseless_header_within_a_picture_is_left_out $?

# ---- Two pictures in one stream

# Another picture's lines, of which one comes twice; its header is lost.
{ "$stream" 0 5 4 cut 103; "$stream" 0 5 4 shade 1 | tail -c +78; } >"$dir/s"
refused && grep -q 'line 2 came twice and differs' "$dir/err"
say line_that_comes_twice_and_differs_is_refused $?
# Each header with its lines, one board beside the other.
{ "$stream" 0 5 4 cut 25; "$stream" 0 5 4 shade 9 cut 51
  "$stream" 0 5 4 | tail -c +26; } >"$dir/s"
refused && grep -q 'line 0 came twice and differs' "$dir/err"
say lines_of_two_boards_are_refused $?
for paths in 321 640; do
    "$stream" 0 5 4 paths $paths >"$dir/s"
    refused && grep -q "counts $paths paths, .* have 320 at most" "$dir/err"
    say "end_of_a_picture_of_${paths}_paths_is_refused" $?
done
"$stream" 0 5 4 paths 319 >"$dir/s"
receive 0 && cmp "$dir/o.ppm" "$dir/want.ppm"
say fewer_paths_are_those_that_meet_the_scene $?

# ---- Every figure, as the stream has it

# figures KEY=VALUE...: those of a whole stream, but for these
figures() {
    cat >"$dir/figures" <<'END'
width: 5
height: 4
spp: 16
seed: 0
status: 0
paths: 320
closest-rays: 6
shadow-rays: 5
saturated: 4
ticks: 3000
tick-hz: 1000000
faint: 3
nanoseconds: 3000000
duplicate-lines: 0
bad-frames: 0
skipped-bytes: 0
END
    for other in "$@"; do
        sed "s/^${other%=*}: .*/${other%=*}: ${other#*=}/" "$dir/figures" \
            >"$dir/err" && cat "$dir/err" >"$dir/figures"
    done
    cmp "$dir/figures" "$dir/out"
    same=$?
    rm "$dir/figures"
    return $same
}
"$stream" 0 5 4 >"$dir/s"
receive 0 && figures
say figures_are_those_of_the_board $?
"$stream" 0 5 4 noise >"$dir/s" # half a frame and 11 bytes, four times
receive 0 && figures bad-frames=4 skipped-bytes=68
say bytes_and_frames_that_are_none_are_counted $?
"$stream" 0 5 4 twice 2 >"$dir/s"
receive 0 && figures duplicate-lines=1
say lines_sent_twice_are_counted $?
while read -r ticks hz nanoseconds; do
    "$stream" 0 5 4 ticks "$ticks" hz "$hz" >"$dir/s"
    receive 0 && figures "ticks=$ticks" "tick-hz=$hz" "nanoseconds=$nanoseconds"
    say "${ticks}_ticks_of_${hz}_a_second_are_right" $?
done <<'END'
4294967295 1 4294967295000000000
4294967295 1000000 4294967295000
4294967295 4294967295 1000000000
4294967 1000000000 4294967
1 3 333333333
5 0 0
END

# ---- Headers and lines that make no sense under a right CRC

for head in '0 0 4' '0 4 0' '0 16385 1' '0 1 16385' '5 4 4'; do
    # shellcheck disable=SC2086 # three arguments
    "$stream" $head >"$dir/s"
    # shellcheck disable=SC2086
    refused && [ "$(cat "$dir/err")" = "qlux-recv: header: $(set -- $head
        echo "$2 x $3 pixels of format $1"): expected sides of 1 to 16384 and \
a format below 5" ]
    say "header_$(echo "$head" | tr ' ' _)_is_refused" $?
done
for y in 4 5 65535; do
    "$stream" 0 5 4 beyond $y >"$dir/s"
    receive 0 && cmp "$dir/o.ppm" "$dir/want.ppm" && figures bad-frames=1
    say "line_${y}_of_4_is_counted_and_left_out" $?
done
# It does not stand for the line that is missing.
"$stream" 0 5 4 drop 2 beyond 4 >"$dir/s"
receive 2 && [ "$(cat "$dir/err")" = "lines 2 are missing
qlux-recv: $dir/s: 3 of 4 lines arrived" ]
say line_beyond_is_none_of_those_that_arrived $?

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

# Header 25, four lines of 26, end 41: a damaged header leaves nothing, and a
# damaged line the others.
bad=0
i=0
while [ "$i" -lt "$size" ]; do
    "$stream" 0 5 4 flip "$i" >"$dir/s"
    if [ "$i" -lt 25 ]; then
        refused
    elif [ "$i" -lt 129 ]; then
        receive 2 && gaps 0 $(((i - 25) / 26))
    else
        receive 2 && gaps 0
    fi || bad=1
    i=$((i + 1))
done
say "byte_flipped_at_any_of_${size}_places_is_noticed" $bad

bad=0
i=0
while [ "$i" -lt "$size" ]; do
    "$stream" 0 5 4 cut "$i" >"$dir/s"
    # shellcheck disable=SC2046 # lines that are not whole
    if [ "$i" -lt 51 ]; then
        refused
    else
        receive 2 && gaps 0 $(seq $(((i - 25) / 26)) 3)
    fi || bad=1
    i=$((i + 1))
done
say "stream_cut_at_any_of_${size}_places_is_noticed" $bad
"$stream" 0 5 4 >"$dir/s"

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
    [ $code -eq 3 ] && grep -q ': interrupted; 1 of 4 lines were written$' \
        "$dir/err" && grep -q '^lines 1-3 are missing$' "$dir/err" &&
        mv "$dir/stop.ppm" "$dir/o.ppm" && gaps 0 1 2 3 &&
        [ "$(ls "$dir" | grep -c tmp)" -eq 0 ]
    say "stopped_by_${signal}_exits_3_and_writes_what_is_there" $?
    "$recv" "$dir/fifo" -o "$dir/stop.ppm" --quiet 2>"$dir/err" &
    child=$!
    exec 3>"$dir/fifo"
    head -c 50 "$dir/s" >&3
    kill -$signal $child
    wait $child
    code=$?
    exec 3>&-
    [ $code -eq 3 ] && grep -q 'interrupted; nothing was written' "$dir/err" &&
        [ "$(ls "$dir" | grep -c -e stop -e tmp)" -eq 0 ]
    say "stopped_by_${signal}_before_a_line_it_writes_nothing" $?
done
rm "$dir/fifo"

"$recv" "$dir/none" -o "$dir/o.ppm" 2>/dev/null
[ $? -eq 3 ]
say missing_device_exits_3 $?
"$recv" "$dir/s" -o "$dir/none/o.ppm" --quiet 2>/dev/null
[ $? -eq 3 ]
say unwritable_output_exits_3 $?
{ "$recv" - -o "$dir/none/o.ppm" --quiet 2>/dev/null; cat; } <"$dir/s" |
    cmp - "$dir/s"
say unwritable_output_is_known_before_a_byte_is_read $?
"$recv" - -o - --quiet --stats <"$dir/s" 2>"$dir/err" | cmp - "$dir/want.ppm" &&
    grep -qx 'spp: 16' "$dir/err"
say stdout_holds_the_picture_and_nothing_else $?

exit $((failures > 0))
