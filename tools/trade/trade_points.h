/* trade_points.h - what was measured of a scene as points of a table */
/* SPDX-License-Identifier: MIT */

#ifndef TRADE_POINTS_H
#define TRADE_POINTS_H

#include "trade/scene/trade_measure.h"
#include "trade/trade.h"

/* Make a table of it, as trade_read() has them, on every core.
 *
 *   trade    -  out: to be freed by trade_free()
 *   measure  -  from trade_measure()
 *   path     -  of the scene
 */
void trade_points(
        trade_t *trade, const trade_measure_t *measure, const char *path);

#endif
