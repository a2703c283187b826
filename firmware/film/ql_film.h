/* ql_film.h - exact sums of samples, and their mean */
/* SPDX-License-Identifier: MIT */

#ifndef QL_FILM_H
#define QL_FILM_H

#include "base/ql_diag.h"
#include "math/ql_real.h"

QL_C_BEGIN

/* Fraction bits of a sum: one radiance unit is 2^24. */
#define QL_SUM_BITS 24

/* Sum of samples of one pixel, linear RGB, u40.24 radiance units. */
typedef struct {
    uint64_t rgb[3];
} ql_sum_t;

/* Largest contribution of one sample, and largest sum. */
#define QL_CONTRIBUTION_MAX ((uint64_t)1 << 39)

/* Contributions below this, 2^-16 radiance units, are rounded by chance. */
#define QL_FAINT 256u

/* Add value * scale to the sums of a pixel.
 *
 *   sum    u40.24  added to; a channel stays at UINT64_MAX when full
 *   value  uq31    in [0, 2), each channel
 *   scale  real    any
 *   key    -       differs from sample to sample: ql_sampler_key()
 *   diag   -       its saturated is counted up for each channel that was cut at
 *                  QL_CONTRIBUTION_MAX / 2^24 radiance units or whose sum is
 *                  full, its faint for each that was rounded by chance
 *
 * 2^24 samples of the largest contribution fit; nothing wraps.
 * Error: a contribution of QL_FAINT or more is rounded half up to 2^-24, which
 *        is 2^-9 of the contribution at most. A fainter one is rounded up with
 *        the probability of the part that is cut off, so its mean is right
 *        however faint it is; with a scale of 1 or more value has no more bits
 *        to lose. A contribution below 2^-56 adds nothing.
 * Cost:  a product and a 32-bit shift a channel; if faint a hash more.
 */
void ql_film_add(ql_sum_t *sum, const ql_uq31_t value[3], ql_real_t scale,
        uint32_t key, ql_diag_t *diag);

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

/* 2^(radiance_exp + exposure_q8 / 256) as a real; exposure_q8 within 2^16. */
ql_real_t ql_film_exposure(int16_t radiance_exp, int32_t exposure_q8);

QL_C_END

#endif
