/* ql_tonemap.h - mean radiance to display pixels: curve, dither, format */
/* SPDX-License-Identifier: MIT */

#ifndef QL_TONEMAP_H
#define QL_TONEMAP_H

#include "render/ql_film.h"

/* Pixel encodings. The name gives the byte order. */
typedef enum {
    QL_FORMAT_RGB888,    /* bytes R, G, B */
    QL_FORMAT_RGB565_LE, /* RRRRRGGG GGGBBBBB, low byte first */
    QL_FORMAT_RGB565_BE, /* the same, high byte first: most SPI panels */
    QL_FORMAT_GRAY8,     /* one byte of luma (Rec. 709) */
    QL_FORMAT_GRAY4      /* two pixels a byte, high nibble left */
} ql_format_t;

#define QL_FORMAT_COUNT 5

/* Bytes of one line of width pixels; constant when its arguments are. */
#define QL_LINE_BYTES(width, format)                                           \
    ((format) == QL_FORMAT_RGB888             ? 3u * (width)                   \
            : (format) <= QL_FORMAT_RGB565_BE ? 2u * (width)                   \
            : (format) == QL_FORMAT_GRAY8     ? 1u * (width)                   \
                                              : ((width) + 1u) / 2u)

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
        uint16_t y, const uint32_t linear[3]);

#endif
