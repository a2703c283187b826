/* texel.h - a texel of a map of the sky, three numbers of nine bits */
/* SPDX-License-Identifier: MIT */

#ifndef TEXEL_H
#define TEXEL_H

#include <stdint.h>

#include "scene/ql_blob.h"

/* The largest texel is TEXEL_MOST 2^TEXEL_SCALE_MOST units of u0.32. */
enum { TEXEL_BITS = 9, TEXEL_MOST = 511, TEXEL_SCALE_MOST = 23 };

/* Round a texel.
 *
 *   rgb           -  radiance, >= 0, none above the largest texel
 *   radiance_exp  -  of the header: 2^(radiance_exp - 32) is a radiance unit
 *
 * Error: of a channel 1/511 of the largest one, and half a radiance unit at
 *        least.
 */
ql_blob_texel_t texel_round(const float rgb[3], int radiance_exp);

/* Its channels in radiance units, exactly. */
void texel_unpack(ql_blob_texel_t texel, uint32_t channels[3]);

#endif
