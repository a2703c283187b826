#!/bin/sh
# firmware_report.sh - what a firmware takes of its board, and how long at least
# SPDX-License-Identifier: MIT

usage() {
    cat <<'END'
usage: tools/dev/firmware_report.sh NAME BOARD SIZE COUNT [COST ARGUMENT...]
Print where the firmware NAME.hex is, how much of the board's flash and RAM it
takes (NAME.map has the memory, NAME.elf the sections; SIZE is the compiler's
size), and how long the picture takes at the clock of BOARD, at one instruction
a cycle: those that the emulator counted, in the file COUNT, or, if that is of
another firmware or not there, what the program COST (qlux-cost) says of the
board's core. A real chip waits for its flash too, so it takes longer.

Example: tools/dev/firmware_report.sh build/microbit/cornell microbit \
    arm-none-eabi-size build/microbit/cornell-emulated.count \
    build/qlux-cost build/cornell.qlb --size 64x64 --spp 4
END
}

case ${1-} in
--help) usage; exit 0 ;;
esac
if [ $# -lt 4 ]; then
    usage >&2
    exit 1
fi
name=$1 board=$2 size=$3 count=$4
shift 4
for file in "$name.elf" "$name.map" "hal/boards/$board/board.h"; do
    if [ ! -r "$file" ]; then
        echo "firmware_report.sh: cannot read $file" >&2
        exit 3
    fi
done
hz=$(sed -n 's/^#define QL_PORT_CPU_HZ  *\([0-9]*\)ul$/\1/p' \
    "hal/boards/$board/board.h")

# A count of another firmware than this is of no use.
kind=counted
instructions=
if [ -r "$count" ] && [ ! "$count" -ot "$name.elf" ]; then
    instructions=$(cat "$count")
elif [ $# -gt 0 ]; then
    kind=estimated
    core=$(sed -n 's/^BOARD_CORE := //p' "hal/boards/$board/board.mk")
    instructions=$("$@" | sed -n "s/^$core: //p")
fi

"$size" -A "$name.elf" | awk -v map="$name.map" -v hex="$name.hex" \
    -v hz="${hz:-0}" -v instructions="$instructions" -v kind="$kind" '
    # 15,812
    function grouped(n,    text, tail) {
        text = sprintf("%.0f", n)
        tail = ""
        while (length(text) > 3) {
            tail = "," substr(text, length(text) - 2) tail
            text = substr(text, 1, length(text) - 3)
        }
        return text tail
    }

    # Two digits, as an estimate has.
    function about(x) {
        return x < 10 ? sprintf("%.1f", x) : grouped(sprintf("%.1e", x) + 0)
    }

    function of_hex(text,    n, i) {
        n = 0
        text = tolower(text)
        for (i = 3; i <= length(text); i++)
            n = n * 16 + index("0123456789abcdef", substr(text, i, 1)) - 1
        return n
    }

    # FLASH            0x00000000         0x00040000         xr
    BEGIN {
        while ((getline line < map) > 0) {
            split(line, word, " ")
            if (word[1] == "FLASH" || word[1] == "RAM")
                memory[word[1]] = of_hex(word[3])
        }
    }

    /^\.(text|rodata|data) / { flash += $2 }
    /^\.(stack|data|bss) / { ram += $2 }

    END {
        print hex ": flash " grouped(flash) " of " grouped(memory["FLASH"]) \
            " bytes, RAM " grouped(ram) " of " grouped(memory["RAM"])
        if (instructions == "" || hz == 0) # a port need not say its clock
            exit
        if (kind == "estimated")
            printf "about %s s or more at %g MHz (%s million instructions" \
                " estimated, one a cycle)\n", about(instructions / hz), \
                hz / 1e6, about(instructions / 1e6)
        else
            printf "at least %.*f s at %g MHz (%s counted instructions," \
                " one a cycle)\n", instructions / hz < 9.95, \
                instructions / hz, hz / 1e6, grouped(instructions)
    }'
