#!/bin/sh
# firmware_report.sh - what a firmware takes of its board, and how long at least
# SPDX-License-Identifier: MIT

usage() {
    cat <<'END'
usage: tools/dev/firmware_report.sh NAME BOARD SIZE [COUNT]
Print where the firmware NAME.hex is, how much of the board's flash and RAM it
takes (NAME.map has the memory, NAME.elf the sections; SIZE is the compiler's
size), and how long the picture takes at least at the clock of BOARD: the
emulator's count of instructions in the file COUNT, at one a cycle. A real chip
waits for its flash too, so it takes longer.

Example: tools/dev/firmware_report.sh build/microbit/cornell microbit \
    arm-none-eabi-size build/microbit/cornell.count
END
}

case ${1-} in
--help) usage; exit 0 ;;
esac
if [ $# -lt 3 ] || [ $# -gt 4 ]; then
    usage >&2
    exit 1
fi
name=$1 board=$2 size=$3 count=${4-}
for file in "$name.elf" "$name.map" "hal/boards/$board/board.h"; do
    if [ ! -r "$file" ]; then
        echo "firmware_report.sh: cannot read $file" >&2
        exit 3
    fi
done
hz=$(sed -n 's/^#define QL_PORT_CPU_HZ  *\([0-9]*\)ul$/\1/p' \
    "hal/boards/$board/board.h")

# A count of another firmware than this is of no use.
instructions=
[ -z "$count" ] || [ ! -r "$count" ] || [ "$count" -ot "$name.elf" ] ||
    instructions=$(cat "$count")

"$size" -A "$name.elf" | awk -v map="$name.map" -v hex="$name.hex" \
    -v hz="${hz:-0}" -v instructions="$instructions" -v board="$board" '
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
        if (instructions != "")
            printf "at least %.*f s at %g MHz (%s counted instructions," \
                " one a cycle)\n", instructions / hz < 9.95, \
                instructions / hz, hz / 1e6, grouped(instructions)
        else
            print "make run BOARD=" board " counts its instructions in an" \
                " emulator"
    }'
