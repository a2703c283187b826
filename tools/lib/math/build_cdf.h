/* build_cdf.h - quantised distributions over the lights of a scene */
/* SPDX-License-Identifier: MIT */

#ifndef BUILD_CDF_H
#define BUILD_CDF_H

#include <stdint.h>

#include "lib/math/soft.h"

/* Share 2^32 among weights by largest remainder, at least 1 each.
 *
 *   shares   -  out: count numbers above 0 whose sum is exactly 2^32
 *   weights  -  count of them above 0, their sum below 2^128
 *   count    -  1 to 65,535
 *
 * Exact for the weights given, but those below 2^-63 of the sum count as that;
 * ties go to the lower index.
 */
void cdf_shares(uint64_t *shares, const u128_t *weights, uint32_t count);

/* 1 / (2 pi P) of P = share 2^-32 as m 2^e, rounded to nearest.
 *
 *   share  -  1 to 2^32
 *   m      -  out: its top bit is set
 *   e      -  out
 */
void cdf_weight(uint64_t share, uint32_t *m, int16_t *e);

#endif
