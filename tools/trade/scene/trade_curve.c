/* trade_curve.c - how an error falls as samples double, measured and beyond */
/* SPDX-License-Identifier: MIT */

#include "trade/scene/trade_curve.h"

#include <math.h>

void trade_curve_extend(trade_curve_t *curve)
{
    const unsigned last = curve->count - 1;
    const double end = curve->noise[last];
    double square = end * end;

    /* the last two dots say how much there is */
    if (last > 0) {
        const double before = curve->noise[last - 1];

        square = (square + before * before / 2) / 2;
    }
    for (unsigned i = curve->count; i < TRADE_DOTS; i++) {
        square /= 2;
        curve->noise[i] = sqrt(square);
    }
}

double trade_curve_error(const trade_curve_t *curve, unsigned i)
{
    return hypot(curve->floor, curve->noise[i]);
}

bool trade_curve_find(const trade_curve_t *curve, double error, unsigned *i)
{
    for (*i = 0; *i < TRADE_DOTS; (*i)++) {
        if (trade_curve_error(curve, *i) <= error) {
            return true;
        }
    }
    return false;
}
