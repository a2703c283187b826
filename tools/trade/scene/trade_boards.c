/* trade_boards.c - the boards of hal/boards, in a table that make writes */
/* SPDX-License-Identifier: MIT */

#include "trade/scene/trade_boards.h"

#include <stddef.h>

/* BOARD(name, core, hz, width, height) for each of hal/boards. */
#define BOARD(name, core, hz, width, height) {name, core, hz, width, height},
const trade_board_t trade_boards[] = {
#include TRADE_BOARDS
};
#undef BOARD

const unsigned trade_board_count = sizeof trade_boards / sizeof trade_boards[0];

#define BOARD(name, core, hz, width, height) name,
const char *const trade_board_names[] = {
#include TRADE_BOARDS
        NULL};
#undef BOARD
