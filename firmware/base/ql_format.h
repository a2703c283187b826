/* ql_format.h - how displays take pixels, and the bytes of a line of them */
/* SPDX-License-Identifier: MIT */

#ifndef QL_FORMAT_H
#define QL_FORMAT_H

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

#endif
