/* ql_clamp.h - bright contributions are cut, and what is cut off is added up */
/* SPDX-License-Identifier: MIT */

/* White dots are samples that are rare and bright. Cutting them is biased: the
 * picture is darker by exactly what was cut off, which is kept to be told. */

#ifndef QL_CLAMP_H
#define QL_CLAMP_H

#include "base/ql_settings.h"
#include "film/ql_film.h"

QL_C_BEGIN

/* Where light is cut, and what was. */
typedef struct {
    ql_real_t limit; /* radiance units; 0: nothing is cut */
    uint64_t cut[3]; /* u40.24, of all samples; saturates */
} ql_clamp_t;

/* Begin without anything cut.
 *
 *   clamp         -       out
 *   clamp_q16     u16.16  the setting
 *   radiance_exp  -       of the scene: one radiance unit is 2^this of Ke
 */
void ql_clamp_begin(
        ql_clamp_t *clamp, uint32_t clamp_q16, int16_t radiance_exp);

/* Add value * scale as ql_film_add() does, or if its brightest channel is above
 * the limit, as much of each channel as brings that one down to it: the hue
 * stays.
 *
 *   clamp  -  what is cut off is added to it: the sums with and without a limit
 *             differ by its cut, to the bit, unless a sum is full. NULL: there
 *             is no limit
 *   sum, value, scale, key, diag  as ql_film_add() has them
 *
 * Error: the limit, relative, 2^-28.
 */
#if QL_CFG_CLAMP
void ql_clamp_add(ql_sum_t *sum, ql_clamp_t *clamp, const ql_uq31_t value[3],
        ql_real_t scale, uint32_t key, ql_diag_t *diag);
#else
/* No function: GCC would copy the scale, 40 bytes on a Cortex-M0. */
#define ql_clamp_add(sum, clamp, value, scale, key, diag)                      \
    ((void)(clamp), ql_film_add(sum, value, scale, key, diag))
#endif

QL_C_END

#endif
