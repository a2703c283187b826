#!/bin/sh
# test_terminal.sh - progress bars and the serial port, on pseudo terminals
# SPDX-License-Identifier: MIT
#
# Usage: tests/tools/terminal/test_terminal.sh [BUILD]
# Example: tests/tools/terminal/test_terminal.sh build

suite=tools/terminal
. tests/support/workspace.sh
pty=$build/test/fine/tools/terminal/pty_main
stream=$build/test/fine/tools/stream_main
recv=$build/qlux-recv

"$build/qlux-scene" "$root/tests/scenes/furnace.scene" \
    --direct area -o scene.qlb \
    >out.txt || exit 3

# ---- Bars

# ends LABEL: what was seen are frames of this bar, of which the last and no
# other is whole, and then a new line
full='################################'
ends() {
    tr '\r' '\n' <seen.txt | sed '1{/^$/d;}' >frames.txt
    sed '$d' frames.txt | grep -v -q \
        "^$1 \[#*\.*\]  *[0-9]* % *[0-9:]* *\(left\)* *$" && return 1
    sed '$d' frames.txt | grep -q '100 %' && return 1
    tail -n 1 frames.txt | grep -q "^$1 \[$full\] 100 % [0-9]*:[0-9][0-9] *$" &&
        [ "$(tail -c 1 seen.txt | od -An -tu1 | tr -d ' ')" = 10 ]
}

# A row of 4096 samples, and rows of fewer.
for size in 64x64 20x14; do
    "$pty" watch "$build/qlux-sim" scene.qlb -o a.ppm --size $size --spp 64 \
        >seen.txt && ends rendering
    say "qlux_sim_draws_one_bar_of_$size" $?
done
"$pty" watch "$build/qlux-ref" scene.qlb -o a.pfm --size 8x8 --spp 4 \
    >seen.txt && ends reference
say qlux_ref_draws_one_bar $?
# 4999 triangles: the last leaf begins no further 256.
awk 'BEGIN { print "v 0 0 0\nv 1 0 0"
    for (i = 0; i < 4999; i++) print "v 0 1 " i "\nf 1 2 -1" }' >a.obj
printf 'mesh a.obj\nsky 1 1 1\ncamera eye 0 0 -9 look 0 0 0 fov 40\n' >a.scene
"$pty" watch "$build/qlux-scene" a.scene --direct area -o a.qlb >seen.txt
grep -v -e triangles -e '^auto is' seen.txt >bar.txt &&
    mv bar.txt seen.txt && ends bvh
say qlux_scene_draws_one_bar $?
"$stream" 0 40 30 >stream.bin
"$pty" watch "$recv" stream.bin -o a.ppm >seen.txt && ends receiving
say qlux_recv_draws_one_bar $?

# Nothing but what is asked for goes to a pipe, or where nobody wants it.
for run in "qlux-sim scene.qlb -o a.ppm --size 8x8 --spp 4" \
    "qlux-ref scene.qlb -o a.pfm --size 8x8 --spp 4" \
    "qlux-recv stream.bin -o a.ppm" "qlux-scene a.scene -o a.qlb"; do
    name=${run%% *}
    # shellcheck disable=SC2086 # a list of arguments
    "$build/"$run 2>&1 >out.txt | cat >seen.txt
    [ ! -s seen.txt ]
    say "${name}_draws_no_bar_in_a_pipe" $?
    # shellcheck disable=SC2086
    "$pty" watch "$build/"$run --quiet >seen.txt && [ ! -s seen.txt ]
    say "${name}_draws_no_bar_if_it_is_to_be_quiet" $?
done

# The picture itself in place of a bar. The last drawing, 20 x 14 pixels in 7
# lines, has the colours of the file.
# colours: of the last seven lines, as "R G B" for each pixel from the top left
colours() {
    tail -n 7 seen.txt | awk 'BEGIN { FS = "\033\\[" }
        {
            for (i = 2; i <= NF; i++) {
                split($i, part, "[;m]")
                if (part[2] == 2)
                    text[part[1] == 48] = text[part[1] == 48] part[3] " " \
                        part[4] " " part[5] "\n"
            }
            printf "%s%s", text[0], text[1]
            text[0] = text[1] = ""
        }'
}
COLORTERM=truecolor "$pty" watch "$build/qlux-sim" scene.qlb -o a.ppm \
    --size 20x14 --spp 9 --show >seen.txt
tail -c 840 a.ppm | od -An -v -tu1 -w3 | awk '{ print $1, $2, $3 }' >want.txt
colours | cmp -s - want.txt && [ "$(wc -l <want.txt)" -eq 280 ] &&
    [ "$(grep -c "$(printf '\033\\[7A')" seen.txt)" -eq 3 ] &&
    ! grep -q rendering seen.txt
say qlux_sim_shows_its_picture $? "4 drawings"
"$stream" 0 20 14 >shown.bin
COLORTERM=truecolor "$pty" watch "$recv" shown.bin -o a.ppm --show >seen.txt
tail -c 840 a.ppm | od -An -v -tu1 -w3 | awk '{ print $1, $2, $3 }' >want.txt
colours | cmp -s - want.txt && ! grep -q receiving seen.txt
say qlux_recv_shows_its_picture $?

# Messages begin on a line of their own below the bar.
"$stream" 0 40 30 drop 20 >short.bin
"$pty" watch "$recv" short.bin -o gaps.ppm >seen.txt
[ $? -eq 2 ] && [ "$(tail -n 2 seen.txt)" = "lines 20 are missing
qlux-recv: short.bin: 29 of 30 lines arrived" ] &&
    [ "$(sed '$d' seen.txt | sed '$d' | tr '\r' '\n' | grep -c -v \
        -e '^receiving \[' -e '^$')" -eq 0 ]
say missing_lines_are_named_below_the_bar $?
# After a header of 25 bytes and three lines of 131.
{ head -c 418 stream.bin; printf 'qlux: warm\n'; tail -c +419 stream.bin; } \
    >text.bin
"$pty" watch "$recv" text.bin -o a.ppm >seen.txt &&
    grep -q '^board: warm$' seen.txt
say text_of_the_board_is_below_the_bar $?

# ---- Ctrl-C

"$pty" stop "$build/qlux-sim" scene.qlb -o part.ppm --size 2000x2000 \
    --spp 999 >seen.txt
[ $? -eq 3 ] && tail -n 1 seen.txt | sed 's/ after [0-9.]* of / after N of /' |
    grep -qx "qlux-sim: interrupted after N of 999 samples a pixel; $(
        )go on with --resume part.ppm.qls" &&
    [ "$(ls part.* | paste -s -d ' ' -)" = 'part.ppm part.ppm.qls' ]
say ctrl_c_stops_a_render_and_leaves_what_there_is $?
rm -f part.*

# ---- The serial port

# The picture of the stream, as a file gives it: red = x and green = y, so that
# every control character that a terminal knows is in it.
"$recv" stream.bin -o want.ppm --quiet
for baud in 9600 19200 38400 57600 115200 230400 460800 921600 1000000 end; do
    [ $baud != end ] || break
    "$pty" send stream.bin "$recv" @ -o port.ppm --quiet --baud $baud \
        >seen.txt 2>err.txt && cmp -s port.ppm want.ppm &&
        [ "$(cat seen.txt)" = "raw, in $baud, out $baud, no modem" ] &&
        [ ! -s err.txt ] || break
    rm -f port.ppm
done
[ $baud = end ]
say a_serial_port_of_each_rate_gives_the_picture $? "$baud"
"$pty" send stream.bin "$recv" @ -o port.ppm --quiet >seen.txt &&
    cmp -s port.ppm want.ppm &&
    [ "$(cat seen.txt)" = 'raw, in 115200, out 115200, no modem' ]
say a_serial_port_has_115200_baud_unless_told $?
"$pty" send stream.bin "$recv" @ -o no.ppm --quiet --baud 9601 \
    >seen.txt 2>err.txt
[ $? -eq 1 ] && [ ! -e no.ppm ] && [ "$(cat err.txt)" = "qlux-recv: '--baud \
9601': the device does not have this rate (see --help)" ]
say another_rate_is_refused $?
"$recv" stream.bin -o a.ppm --quiet --baud 9601 && cmp -s a.ppm want.ppm
say a_file_has_no_rate $?
"$pty" part 300 stream.bin "$recv" @ -o no.ppm --quiet >seen.txt 2>err.txt
[ $? -eq 3 ] && grep -q '^qlux-recv: /.*: interrupted; 2 of 30 lines were' \
    err.txt && head -c 253 want.ppm >top.ppm &&
    head -c 253 no.ppm | cmp -s - top.ppm && [ "$(ls | grep -c tmp)" -eq 0 ]
rm -f no.ppm
say ctrl_c_at_a_serial_port_writes_what_is_there $?

exit $((failures != 0))
