# boards.awk - the boards of hal/boards as rows of a table in C
# SPDX-License-Identifier: MIT
#
# usage: awk -f tools/trade/boards.awk hal/boards/*/board.h
#            hal/boards/*/board.mk
#
# BOARD("microbit", "cortex-m0", 16000000, 64, 64)

FNR == 1 {
    n = split(FILENAME, part, "/")
    board = part[n - 1]
    core = size = ""
}
/^#define QL_PORT_CPU_HZ / {
    hz[board] = $3
    sub(/ul$/, "", hz[board])
}
/^BOARD_CORE := / { core = $3 }
/^BOARD_SIZE := / { size = $3 }
core != "" && size != "" && board in hz { # a port need not say its clock
    split(size, px, "x")
    printf "BOARD(\"%s\", \"%s\", %s, %s, %s)\n", board, core, hz[board], \
        px[1], px[2]
    core = size = ""
}
