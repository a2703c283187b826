/* widen.c - a display's line as RGB of eight bits a channel */
/* SPDX-License-Identifier: MIT */

#include "lib/render/widen.h"

#include <stddef.h>
#include <string.h>

static void widen_565(uint8_t rgb[3], unsigned high, unsigned low)
{
    const unsigned r = high >> 3, g = (high & 7u) << 3 | low >> 5;
    const unsigned b = low & 31u;

    rgb[0] = (uint8_t)(r << 3 | r >> 2);
    rgb[1] = (uint8_t)(g << 2 | g >> 4);
    rgb[2] = (uint8_t)(b << 3 | b >> 2);
}

static void widen_gray(uint8_t rgb[3], unsigned level)
{
    rgb[0] = rgb[1] = rgb[2] = (uint8_t)level;
}

static void widen_pixel(
        uint8_t rgb[3], const uint8_t *line, ql_format_t format, size_t x)
{
    switch (format) {
    case QL_FORMAT_RGB888:
        memcpy(rgb, line + 3 * x, 3);
        break;
    case QL_FORMAT_RGB565_LE:
        widen_565(rgb, line[2 * x + 1], line[2 * x]);
        break;
    case QL_FORMAT_RGB565_BE:
        widen_565(rgb, line[2 * x], line[2 * x + 1]);
        break;
    case QL_FORMAT_GRAY8:
        widen_gray(rgb, line[x]);
        break;
    case QL_FORMAT_GRAY4: /* the left pixel in the high half */
        widen_gray(
                rgb, 17u * (x % 2 == 0 ? line[x / 2] >> 4 : line[x / 2] & 15u));
        break;
    }
}

void widen_line(
        uint8_t *rgb, const uint8_t *line, ql_format_t format, uint32_t width)
{
    for (size_t x = 0; x < width; x++) {
        widen_pixel(rgb + 3 * x, line, format, x);
    }
}
