/* ql_film.h - exact sums of samples, their mean, and counters */
/* SPDX-License-Identifier: MIT */

#ifndef QL_FILM_H
#define QL_FILM_H

#include "math/ql_real.h"

/* Fraction bits of a sum: one radiance unit is 2^24. */
#define QL_SUM_BITS 24

/* Sum of samples of one pixel, linear RGB, u40.24 radiance units. */
typedef struct {
    uint64_t rgb[3];
} ql_sum_t;

/* What happened while rendering; never changes a pixel. */
typedef struct {
    uint32_t paths;
    uint32_t closest_rays;
    uint32_t shadow_rays;
    uint32_t saturated; /* contributions or sums cut at their limit */
} ql_diag_t;

#if QL_CFG_DIAG
#define QL_DIAG_COUNT(diag, counter) ((void)(diag)->counter++)
#else
#define QL_DIAG_COUNT(diag, counter) ((void)(diag))
#endif

/* Largest contribution of one sample, and largest sum. */
#define QL_CONTRIBUTION_MAX ((uint64_t)1 << 39)

/* Add value * scale to a sum, rounded half up.
 *
 *   sum    u40.24  added to; stays at UINT64_MAX when full
 *   value  uq31    in [0, 2)
 *   scale  real    any
 *   diag   -       its saturated is counted up if the contribution was cut at
 *                  QL_CONTRIBUTION_MAX / 2^24 radiance units or the sum is full
 *
 * 2^24 samples of the largest contribution fit; nothing wraps.
 */
void ql_film_add(
        uint64_t *sum, ql_uq31_t value, ql_real_t scale, ql_diag_t *diag);

/* Mean of a pixel, ready for the display.
 *
 *   sum          u40.24  sums
 *   samples      -       how many; 0 gives black
 *   exposure     -       radiance unit times display exposure, see
 *                        ql_film_exposure()
 *   linear       u16.16  out: display-linear RGB, 1 is white; saturates
 *
 * Error: rounded to nearest once at the end, after a relative error of 2^-28.
 */
void ql_film_display(const ql_sum_t *sum, uint32_t samples, ql_real_t exposure,
        ql_uq16_t linear[3]);

/* 2^(radiance_exp + exposure_q8 / 256) as a real. */
ql_real_t ql_film_exposure(int16_t radiance_exp, int16_t exposure_q8);

#endif
