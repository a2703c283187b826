/* ql_tonemap.c - sRGB curve, ordered dither, pixel formats */
/* SPDX-License-Identifier: MIT */

#include "film/ql_tonemap.h"

#include "math/lut/ql_lut.h"

#define WHITE_UQ16 65536u
#define WHITE_UQ8  65280u /* 255, u8.8 */

/* sRGB display value of a linear one, u8.8 in [0, 255] */
static uint32_t srgb_curve(ql_uq16_t linear)
{
    unsigned octave;
    uint32_t mantissa, step, rest, low, high;

    if (linear >= WHITE_UQ16) {
        return WHITE_UQ8;
    }
    if (linear < 128) {
        /* 12.92 * 65280 / 65536 * 256 = 3294.6 */
        return (linear * 3295u + 128u) >> 8;
    }
    octave = 24 - ql_clz32(linear);    /* 0 for [2^7, 2^8), .. 8 */
    mantissa = linear << (8 - octave); /* [2^15, 2^16) */
    step = octave * QL_SRGB_STEPS + (mantissa >> 11 & 15u);
    rest = mantissa & 2047u;
    low = ql_lut_srgb[step];
    high = ql_lut_srgb[step + 1];
    return low + (((high - low) * rest + 1024u) >> 11);
}

/* Bayer's 8x8 matrix, 0..63, by interleaving the bits of x ^ y and y */
#if QL_CFG_SMALL
static uint32_t bayer(uint16_t x, uint16_t y)
{
    const uint32_t a = (uint32_t)x ^ y, b = y;
    uint32_t t = 0;

    for (unsigned i = 0; i < 3; i++) {
        t = t << 2 | (a >> i & 1u) << 1 | (b >> i & 1u);
    }
    return t;
}
#else
static uint32_t bayer(uint16_t x, uint16_t y)
{
    const uint32_t a = (uint32_t)x ^ y, b = y;

    return (a & 1u) << 5 | (b & 1u) << 4 | (a & 2u) << 2 | (b & 2u) << 1 |
           (a & 4u) >> 1 | (b & 4u) >> 2;
}
#endif

/* Formats built in; what only others need is never called, and not linked. */
#define RGB888 ((QL_CFG_FORMATS & 1) != 0)
#define RGB565 ((QL_CFG_FORMATS & 6) != 0)
#define GRAY   ((QL_CFG_FORMATS & 24) != 0)
#define GRAY4  ((QL_CFG_FORMATS & 16) != 0)

/* As dither() to levels 0..255: the same number without a division. */
static uint8_t dither_byte(uint32_t value, uint32_t threshold)
{
    return (uint8_t)((value + 2u * (2u * threshold + 1u)) >> 8);
}

/* Round a display value to levels 0..top. value top <= 65280 * 255 < 2^24; the
 * threshold (2 t + 1) / 128 of a level is (2 t + 1) 510 of 65280. */
static uint32_t dither(uint32_t value, uint32_t top, uint32_t threshold)
{
    return (value * top + (2u * threshold + 1u) * 510u) / WHITE_UQ8;
}

static uint32_t luma(const ql_uq16_t linear[3])
{
    /* Rec. 709 weights as u0.16; they add up to 1. Each channel is cut to
     * white first, so the sum fits: <= 2^32 only when all are white. */
    uint32_t sum = 32768u;
    static const uint32_t weight[3] = {13933u, 46871u, 4732u};

    for (unsigned i = 0; i < 3; i++) {
        const uint32_t c = linear[i] < WHITE_UQ16 ? linear[i] : 65535u;

        sum += c * weight[i]; /* <= 65535 * 65536 + 32768 < 2^32 */
    }
    return sum >> 16;
}

static void put_rgb565(uint8_t *pixels, uint16_t x, const uint32_t value[3],
        uint32_t threshold, bool low_first)
{
    const uint32_t packed = dither(value[0], 31, threshold) << 11 |
                            dither(value[1], 63, threshold) << 5 |
                            dither(value[2], 31, threshold);
    uint8_t *p = pixels + 2u * (size_t)x;

    p[low_first ? 0 : 1] = (uint8_t)(packed & 0xffu);
    p[low_first ? 1 : 0] = (uint8_t)(packed >> 8);
}

static void put_gray4(uint8_t *pixels, uint16_t x, uint32_t level)
{
    uint8_t *p = pixels + x / 2u;

    *p = (uint8_t)(x & 1u ? (*p & 0xf0u) | level : (*p & 0x0fu) | level << 4);
}

void ql_tonemap_pixel(uint8_t *pixels, ql_format_t format, uint16_t x,
        uint16_t y, const ql_uq16_t linear[3])
{
    const uint32_t threshold = bayer(x, y);
    uint32_t value[3];

    QL_ASSERT(QL_CFG_FORMATS >> format & 1);
    if (GRAY && format >= QL_FORMAT_GRAY8) {
        value[0] = srgb_curve(luma(linear));
        if (GRAY4 && format == QL_FORMAT_GRAY4) {
            put_gray4(pixels, x, dither(value[0], 15, threshold));
        } else {
            pixels[x] = dither_byte(value[0], threshold);
        }
        return;
    }
    for (unsigned i = 0; i < 3 && (RGB888 || RGB565); i++) {
        value[i] = srgb_curve(linear[i]);
        if (RGB888 && (!RGB565 || format == QL_FORMAT_RGB888)) {
            pixels[3u * (size_t)x + i] = dither_byte(value[i], threshold);
        }
    }
    if (RGB565 && format != QL_FORMAT_RGB888) {
        put_rgb565(pixels, x, value, threshold, format == QL_FORMAT_RGB565_LE);
    }
}
