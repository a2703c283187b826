/* trade_curve.h - how an error falls as samples double, measured and beyond */
/* SPDX-License-Identifier: MIT */

#ifndef TRADE_CURVE_H
#define TRADE_CURVE_H

#include <stdbool.h>

#define TRADE_DOTS 25 /* 1, 2, 4, .. 2^24 samples a pixel */

/* The square of an error is what no number of samples takes away, the light
 * that comes after the last bounce, and noise: floor^2 + noise^2. */
typedef struct {
    double floor;
    double noise[TRADE_DOTS]; /* of 2^i samples a pixel, above 0 */
    unsigned count;           /* how many are measured */
} trade_curve_t;

/* Fill in the noise of more samples than were measured: its square halves as
 * they double. Sobol points do better while they are few; then it is that.
 *
 *   curve  -  in: count >= 1 of noise
 */
void trade_curve_extend(trade_curve_t *curve);

/* The error of 2^i samples, i < TRADE_DOTS: root of relMSE. */
double trade_curve_error(const trade_curve_t *curve, unsigned i);

/* The fewest samples for an error.
 *
 *   curve   -  extended
 *   error   -  at most this
 *   i       -  out: 2^i samples; below count if that was measured
 *   return  false if no number of samples brings it that far
 */
bool trade_curve_find(const trade_curve_t *curve, double error, unsigned *i);

#endif
