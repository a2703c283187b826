/* ql_adaptive.h - when a pixel has enough samples: half judges half */
/* SPDX-License-Identifier: MIT */

/* Samples that decide when to stop may not be averaged: sampling stopped
 * because of what they are, so their mean is off. A pixel therefore has two
 * halves of independent samples, as many in each. Each half estimates the error
 * and decides for the other: the mean of half A is taken as it was when B was
 * content, that of B as it was when A was, and the pixel is the mean of both.
 * Whatever rule decides, a half whose end another one sets has the mean of any
 * sample, so the pixel is unbiased. */

#ifndef QL_ADAPTIVE_H
#define QL_ADAPTIVE_H

#include "film/ql_film.h"

/* Samples a pixel has at least, a power of two; and without any light in one
 * half. */
#define QL_ADAPTIVE_MIN   32u
#define QL_ADAPTIVE_BLACK 256u

/* What the seed of the second half differs by: halves that shared a Sobol
 * sequence would depend on each other. */
#define QL_ADAPTIVE_SEED 0x80000000u

/* Count, sum and sum of squares of values below 2^32. */
typedef struct {
    uint32_t count;       /* at most 2^24 */
    uint32_t square_high; /* sum of squares / 2^64, below 2^24 */
    uint64_t square_low;
    uint64_t sum; /* below 2^56 */
} ql_spread_t;

/* Half of the samples of a pixel; all zero to begin. */
typedef struct {
    ql_spread_t spread;
    ql_sum_t sum;
    ql_sum_t used;       /* sum when the other half was content */
    uint32_t used_count; /* of those samples; 0: it is not yet */
} ql_half_t;

/* Add a value.
 *
 *   spread  -     added to; all zero to begin
 *   value   uq32  any
 *
 * Exact for up to 2^24 values.
 */
void ql_spread_add(ql_spread_t *spread, uint32_t value);

/* Is the standard error of a mean of twice as many values within a part of it?
 *
 *   spread     -      of h values, h at most 2^23
 *   error_q16  u0.16  the part E
 *   return     true if h S2 - S^2 <= 2 (h - 1) E^2 S^2, S and S2 the sums of
 *              values and squares: variance / 2h <= (E mean)^2. False for fewer
 *              than two values, and for a sum of 0 if 2h < QL_ADAPTIVE_BLACK
 *
 * Exact: the left side. Error: of the right side, relative, 2^-28, downwards.
 */
bool ql_spread_enough(const ql_spread_t *spread, uint16_t error_q16);

/* Add one sample to a half: its channels, and for its error R + 2G + B, which
 * counts as 2^32 - 1 if a channel reaches 64 radiance units.
 *
 *   half    -       added to
 *   sample  u40.24  sums of this sample alone
 */
void ql_half_add(ql_half_t *half, const ql_sum_t *sample);

/* Let each of two halves of equal count decide for the other, unless it has.
 *
 *   half       -      both
 *   error_q16  u0.16  relative error to reach
 *   last       -      there are no more samples: take them as they are
 *   return     true if both have decided
 */
bool ql_half_decide(ql_half_t half[2], uint16_t error_q16, bool last);

/* The pixel: the mean of the means that both halves use.
 *
 *   half    -       both, after ql_half_decide() has returned true
 *   sum     u40.24  out: that mean times the samples that both hold; saturates
 *   return  -       how many these are
 *
 * Exact where used_count is a power of two that divides the count, else rounded
 * half up.
 */
uint32_t ql_half_join(const ql_half_t half[2], ql_sum_t *sum);

#endif
