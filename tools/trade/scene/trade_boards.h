/* trade_boards.h - the boards of hal/boards: their core, clock and picture */
/* SPDX-License-Identifier: MIT */

#ifndef TRADE_BOARDS_H
#define TRADE_BOARDS_H

#include <stdint.h>

#include "lib/cost/cost.h"

/* A board, as board.mk and board.h have it. */
typedef struct {
    const char *name;
    const char *core; /* as cost_core_name() */
    uint32_t hz;      /* QL_PORT_CPU_HZ: of the real chip */
    uint16_t width;   /* px, unless make is told another size */
    uint16_t height;
} trade_board_t;

extern const trade_board_t trade_boards[];
extern const unsigned trade_board_count;

/* Their names, for an option; NULL ends them. */
extern const char *const trade_board_names[];

#endif
