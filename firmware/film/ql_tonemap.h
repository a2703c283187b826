/* ql_tonemap.h - mean radiance to display pixels: curve, dither, format */
/* SPDX-License-Identifier: MIT */

#ifndef QL_TONEMAP_H
#define QL_TONEMAP_H

#include "base/ql_format.h"
#include "film/ql_film.h"

QL_C_BEGIN

/* Encode one pixel of a line.
 *
 *   pixels    -       out: the line; the GRAY4 neighbour is kept
 *   format    -       a ql_format_t of QL_CFG_FORMATS
 *   x, y      px      position: picks the 8x8 ordered dither threshold
 *   linear    u16.16  linear RGB after exposure; 1 is display white
 *
 * Error: the sRGB curve (IEC 61966-2-1) within 2^-11 of 8-bit white, rounded
 * to the format's levels by an ordered dither whose mean is unbiased.
 */
void ql_tonemap_pixel(uint8_t *pixels, ql_format_t format, uint16_t x,
        uint16_t y, const ql_uq16_t linear[3]);

QL_C_END

#endif
