/* trade_advice.h - what to ask for, its cost, and how long on each board */
/* SPDX-License-Identifier: MIT */

#ifndef TRADE_ADVICE_H
#define TRADE_ADVICE_H

#include "trade/scene/trade_boards.h"
#include "trade/scene/trade_measure.h"

/* Print, for an error of 10 %, 3 % and 1 %, the cheapest way of those measured.
 *
 *   measure  -  from trade_measure()
 *   path     -  of the scene, as it was given
 *   board    -  the only one that counts, and its core decides; NULL: all, and
 *               the Cortex-M3 decides
 *   width,   px of the picture on boards; 0: each board's own
 *   height
 */
void trade_advise(const trade_measure_t *measure, const char *path,
        const trade_board_t *board, uint32_t width, uint32_t height);

/* The options that settings stand for: " --direct mis --bounces 8".
 *
 *   text  -  out: room bytes, cut if that is not enough
 */
void trade_options(char *text, size_t room, const ql_settings_t *settings);

#endif
