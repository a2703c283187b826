/* test_tonemap.c - the curve, the dither, and every format's bytes */
/* SPDX-License-Identifier: MIT */

#include <math.h>

#include "support/ql_test.h"
#include "film/ql_tonemap.h"

#define WHITE       65536u
#define LEVEL_BOUND (255 / 2048.0) /* 2^-11 of 8-bit white */

static double srgb(double x)
{
    x = fmin(x, 1);
    return 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055);
}

#if QL_CFG_FORMATS & 9
/* A format of whole bytes, and how many a pixel has. */
#if QL_CFG_FORMATS & 1
enum { BYTES = 3, BYTE_FORMAT = QL_FORMAT_RGB888 };
#else
enum { BYTES = 1, BYTE_FORMAT = QL_FORMAT_GRAY8 };
#endif

/* One pixel's byte for a gray of linear. */
static uint8_t byte_at(uint32_t linear, unsigned threshold)
{
    const uint32_t rgb[3] = {linear, linear, linear};
    uint8_t line[8 * BYTES];

    ql_tonemap_pixel(line, (ql_format_t)BYTE_FORMAT, (uint16_t)(threshold % 8),
            (uint16_t)(threshold / 8), rgb);
    return line[BYTES * (threshold % 8)];
}

/* Mean over the 64 thresholds, in 8-bit levels. */
static double mean_of(uint32_t linear)
{
    unsigned sum = 0;

    for (unsigned t = 0; t < 64; t++) {
        sum += byte_at(linear, t);
    }
    return sum / 64.0;
}

/* Means know the curve to half of 1/64 level. */
TEST(the_curve_is_within_its_bound_for_every_input)
{
    double worst = 0, bias = 0;

    for (uint32_t i = 0; i <= WHITE; i++) {
        const double off = mean_of(i) - srgb(i / 65536.0);

        worst = fmax(worst, fabs(off));
        bias += off / 65537;
        CHECK(fabs(off) <= LEVEL_BOUND + 1 / 128.0,
                "%lu of 65536: %.4f, not %.4f", (unsigned long)i, mean_of(i),
                srgb(i / 65536.0));
    }
    CHECK(fabs(bias) < 0.01, "mean error %.4f levels", bias);
    NOTE("worst %.4f levels, mean %.4f", worst, bias);
}

TEST(a_brighter_input_never_gives_a_darker_pixel)
{
    for (unsigned t = 0; t < 64; t++) {
        uint8_t before = 0;

        for (uint32_t i = 0; i <= WHITE; i++) {
            const uint8_t now = byte_at(i, t);

            CHECK(now >= before, "threshold %u, %lu: %u after %u", t,
                    (unsigned long)i, now, before);
            before = now;
        }
        CHECK(before == 255, "threshold %u: white is %u", t, before);
    }
}

TEST(black_is_black_and_white_white_at_every_threshold)
{
    static const uint32_t whites[] = {
            WHITE, WHITE + 1, 1ul << 20, 0x7fffffffu, 0x80000000u, 0xffffffffu};

    for (unsigned t = 0; t < 64; t++) {
        CHECK(byte_at(0, t) == 0, "threshold %u: %u", t, byte_at(0, t));
        for (unsigned i = 0; i < 6; i++) {
            CHECK(byte_at(whites[i], t) == 255, "threshold %u, %lu: %u", t,
                    (unsigned long)whites[i], byte_at(whites[i], t));
        }
    }
}

/* Bayer's matrix of n by n from that of half its size: 4 B, 4 B + 2 above,
 * 4 B + 3, 4 B + 1 below. */
static unsigned bayer(unsigned x, unsigned y, unsigned n)
{
    static const unsigned quarter[2][2] = {{0, 2}, {3, 1}};
    const unsigned half = n / 2;

    return n == 1 ? 0
                  : 4 * bayer(x % half, y % half, half) +
                            quarter[y / half][x / half];
}

TEST(thresholds_of_the_dither_are_bayers_in_all_64_places)
{
    uint32_t first[64];

    /* the input at which each place leaves level 250 says its threshold */
    for (unsigned t = 0; t < 64; t++) {
        first[t] = 60000;
        while (byte_at(first[t], t) < 251) {
            first[t]++;
        }
        for (unsigned k = 0; k < t; k++) {
            /* the higher the threshold, the less light is needed */
            CHECK(first[k] != first[t] &&
                            (first[k] < first[t]) ==
                                    (bayer(k % 8, k / 8, 8) >
                                            bayer(t % 8, t / 8, 8)),
                    "places %u and %u: %lu, %lu", k, t, (unsigned long)first[k],
                    (unsigned long)first[t]);
        }
    }
    for (unsigned y = 0; y < 8; y++) {
        for (unsigned x = 0; x < 8; x++) {
            const uint32_t rgb[3] = {1000, 1000, 1000};
            uint8_t near_line[BYTES * 8], far_line[BYTES * 1032];

            ql_tonemap_pixel(near_line, (ql_format_t)BYTE_FORMAT, (uint16_t)x,
                    (uint16_t)y, rgb);
            ql_tonemap_pixel(far_line, (ql_format_t)BYTE_FORMAT,
                    (uint16_t)(x + 1024), (uint16_t)(y + 16376), rgb);
            CHECK(near_line[BYTES * x] == far_line[BYTES * (x + 1024)],
                    "%u, %u does not repeat after 8 px", x, y);
        }
    }
}
#endif

/* ---- Formats ----------------------------------------------------------- */

#if (QL_CFG_FORMATS & 30) == 30
typedef struct {
    unsigned red, green, blue;
} levels_t;

static levels_t rgb565(
        ql_format_t format, uint16_t x, uint16_t y, const uint32_t rgb[3])
{
    uint8_t line[2 * 16];
    const uint8_t *p = line + 2 * x;
    unsigned word;
    levels_t l;

    ql_tonemap_pixel(line, format, x, y, rgb);
    word = format == QL_FORMAT_RGB565_LE ? (unsigned)(p[0] | p[1] << 8)
                                         : (unsigned)(p[0] << 8 | p[1]);
    l.red = word >> 11;
    l.green = word >> 5 & 63u;
    l.blue = word & 31u;
    return l;
}
#endif

#if QL_CFG_FORMATS & 1
TEST(rgb888_is_red_green_blue)
{
    for (unsigned i = 0; i < 3; i++) {
        uint32_t rgb[3] = {0, 0, 0};
        uint8_t line[9] = {7, 7, 7, 7, 7, 7, 7, 7, 7};

        rgb[i] = WHITE;
        ql_tonemap_pixel(line, QL_FORMAT_RGB888, 1, 0, rgb);
        for (unsigned k = 0; k < 9; k++) {
            const unsigned expected = k / 3 != 1 ? 7 : k % 3 == i ? 255 : 0;

            CHECK(line[k] == expected, "channel %u, byte %u is %u", i, k,
                    line[k]);
        }
    }
}
#endif

#if (QL_CFG_FORMATS & 6) == 6
TEST(rgb565_names_its_byte_order)
{
    static const uint32_t known[4][3] = {
            {WHITE, 0, 0}, {0, WHITE, 0}, {0, 0, WHITE}, {WHITE, WHITE, WHITE}};
    static const uint8_t bytes[4][2] = {{0x00, 0xf8}, {0xe0, 0x07},
            {0x1f, 0x00}, {0xff, 0xff}}; /* low first */

    for (unsigned i = 0; i < 4; i++) {
        uint8_t little[6] = {9, 9, 9, 9, 9, 9}, big[6] = {9, 9, 9, 9, 9, 9};

        ql_tonemap_pixel(little, QL_FORMAT_RGB565_LE, 1, 3, known[i]);
        ql_tonemap_pixel(big, QL_FORMAT_RGB565_BE, 1, 3, known[i]);
        CHECK(little[2] == bytes[i][0] && little[3] == bytes[i][1],
                "little-endian %u: %02x %02x", i, little[2], little[3]);
        CHECK(big[2] == bytes[i][1] && big[3] == bytes[i][0],
                "big-endian %u: %02x %02x", i, big[2], big[3]);
        CHECK(little[1] == 9 && little[4] == 9 && big[1] == 9 && big[4] == 9,
                "neighbours of %u", i);
    }
}
#endif

#if (QL_CFG_FORMATS & 30) == 30
/* Means over 64 places of all 5 formats against the curve, in parts of 1. */
TEST(the_dither_of_every_format_is_unbiased)
{
    double bias[4] = {0, 0, 0, 0}, worst[4] = {0, 0, 0, 0};
    unsigned count = 0;

    for (uint32_t i = 0; i <= WHITE; i += 16) {
        const uint32_t rgb[3] = {i, i, i};
        const double exact = srgb(i / 65536.0) / 255;
        double mean[4] = {0, 0, 0, 0};

        for (uint16_t t = 0; t < 64; t++) {
            const uint16_t x = t % 8, y = t / 8;
            const levels_t l =
                    rgb565(t & 1 ? QL_FORMAT_RGB565_LE : QL_FORMAT_RGB565_BE, x,
                            y, rgb);
            uint8_t line[8];

            mean[0] += l.red / 31.0 / 64;
            mean[1] += l.green / 63.0 / 64;
            CHECK(l.blue == l.red, "blue %u, red %u of a gray", l.blue, l.red);
            ql_tonemap_pixel(line, QL_FORMAT_GRAY8, x, y, rgb);
            mean[2] += line[x] / 255.0 / 64;
            ql_tonemap_pixel(line, QL_FORMAT_GRAY4, x, y, rgb);
            mean[3] +=
                    (x & 1 ? line[x / 2] & 15u : line[x / 2] >> 4) / 15.0 / 64;
        }
        count++;
        for (unsigned k = 0; k < 4; k++) {
            bias[k] += mean[k] - exact;
            worst[k] = fmax(worst[k], fabs(mean[k] - exact));
        }
    }
    for (unsigned k = 0; k < 4; k++) {
        static const double top[4] = {31, 63, 255, 15};

        CHECK(worst[k] <= 0x1p-11 + 1 / (128 * top[k]) + 1e-4,
                "format %u of %.0f levels: worst %.5f", k, top[k], worst[k]);
        CHECK(fabs(bias[k] / count) < 1e-4, "format %u: mean %.6f", k,
                bias[k] / count);
    }
    NOTE("means %.1e %.1e %.1e %.1e", bias[0] / count, bias[1] / count,
            bias[2] / count, bias[3] / count);
}
#endif

/* The planted fault: plain truncation to levels. */
TEST(truncation_instead_of_dither_is_rejected)
{
    double bias = 0;
    unsigned count = 0;

    for (uint32_t i = 0; i <= WHITE; i += 16) {
        const double exact = srgb(i / 65536.0) / 255;

        bias += floor(exact * 31) / 31 - exact;
        count++;
    }
    CHECK(fabs(bias / count) >= 1e-4, "mean %.6f", bias / count);
}

#if QL_CFG_FORMATS & 8
TEST(gray_is_the_luma_of_rec_709)
{
    static const double weight[3] = {0.2126, 0.7152, 0.0722};
    double worst = 0;

    for (unsigned i = 0; i < 3 * 256; i++) {
        const uint32_t value = i / 3 * 257;
        uint32_t rgb[3] = {0, 0, 0};
        double mean = 0, exact;

        rgb[i % 3] = value;
        exact = srgb(value / 65536.0 * weight[i % 3]);
        for (uint16_t t = 0; t < 64; t++) {
            uint8_t line[8];

            ql_tonemap_pixel(line, QL_FORMAT_GRAY8, t % 8, t / 8, rgb);
            mean += line[t % 8] / 64.0;
        }
        worst = fmax(worst, fabs(mean - exact));
        CHECK(fabs(mean - exact) <= LEVEL_BOUND + 1 / 128.0 + 0.02,
                "channel %u, %lu: %.3f, not %.3f", i % 3, (unsigned long)value,
                mean, exact);
    }
    NOTE("worst %.3f levels", worst);
}
#endif

#if (QL_CFG_FORMATS & 24) == 24
TEST(gray_of_white_is_white_in_every_format)
{
    static const uint32_t white[2][3] = {
            {WHITE, WHITE, WHITE}, {0xffffffffu, 0xffffffffu, 0xffffffffu}};

    for (uint16_t t = 0; t < 128; t++) {
        uint8_t line[8];
        const uint16_t x = t % 8, y = t / 8 % 8;

        ql_tonemap_pixel(line, QL_FORMAT_GRAY8, x, y, white[t / 64]);
        CHECK(line[x] == 255, "GRAY8 at %u, %u: %u", x, y, line[x]);
        ql_tonemap_pixel(line, QL_FORMAT_GRAY4, x, y, white[t / 64]);
        CHECK((x & 1 ? line[x / 2] & 15u : line[x / 2] >> 4) == 15,
                "GRAY4 at %u, %u: %02x", x, y, line[x / 2]);
    }
}
#endif

#if QL_CFG_FORMATS & 16
TEST(gray4_is_high_nibble_first_and_keeps_the_neighbour)
{
    static const uint32_t white[3] = {WHITE, WHITE, WHITE};
    static const uint32_t black[3] = {0, 0, 0};
    uint8_t p = 0x5a;

    ql_tonemap_pixel(&p, QL_FORMAT_GRAY4, 0, 0, white);
    CHECK(p == 0xfa, "left white: %02x", p);
    ql_tonemap_pixel(&p, QL_FORMAT_GRAY4, 1, 0, black);
    CHECK(p == 0xf0, "right black: %02x", p);
    ql_tonemap_pixel(&p, QL_FORMAT_GRAY4, 0, 0, black);
    CHECK(p == 0x00, "left black: %02x", p);
    ql_tonemap_pixel(&p, QL_FORMAT_GRAY4, 1, 0, white);
    CHECK(p == 0x0f, "right white: %02x", p);
}
#endif

/* Lines of every width hold exactly QL_LINE_BYTES, in any order of pixels. */
TEST(lines_take_the_bytes_they_say_for_every_width)
{
    enum { MAX = 67, GUARD = 0xc3 };
    static const unsigned bits[QL_FORMAT_COUNT] = {24, 16, 16, 8, 4};
    static const uint32_t white[3] = {WHITE, WHITE, WHITE};

    for (unsigned format = 0; format < QL_FORMAT_COUNT; format++) {
        for (unsigned width = 1; width <= MAX; width++) {
            const size_t bytes = QL_LINE_BYTES(width, format);
            uint8_t line[3 * MAX + 1];

            CHECK(bytes == (width * bits[format] + 7) / 8,
                    "format %u, %u px: %u bytes", format, width,
                    (unsigned)bytes);
            memset(line, 0, sizeof line);
            memset(line + bytes, GUARD, sizeof line - bytes);
            if ((QL_CFG_FORMATS >> format & 1) == 0) {
                continue;
            }
            for (unsigned i = 0; i < width; i++) {
                const unsigned x =
                        i * 3 % width == 0 && i > 0 ? width - 1 - i : i;

                ql_tonemap_pixel(
                        line, (ql_format_t)format, (uint16_t)x, 0, white);
                ql_tonemap_pixel(
                        line, (ql_format_t)format, (uint16_t)i, 0, white);
            }
            for (size_t k = 0; k < sizeof line; k++) {
                const bool half = format == QL_FORMAT_GRAY4 && width % 2 == 1 &&
                                  k + 1 == bytes;
                const unsigned expected = k >= bytes ? GUARD
                                          : half     ? 0xf0
                                                     : 0xff;

                CHECK(line[k] == expected, "format %u, %u px: byte %u is %02x",
                        format, width, (unsigned)k, line[k]);
            }
        }
    }
}

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_tonemap", argc, argv);
#if QL_CFG_FORMATS & 9
    RUN(the_curve_is_within_its_bound_for_every_input);
    RUN(a_brighter_input_never_gives_a_darker_pixel);
    RUN(black_is_black_and_white_white_at_every_threshold);
    RUN(thresholds_of_the_dither_are_bayers_in_all_64_places);
#endif
#if QL_CFG_FORMATS & 1
    RUN(rgb888_is_red_green_blue);
#endif
#if (QL_CFG_FORMATS & 6) == 6
    RUN(rgb565_names_its_byte_order);
#endif
#if (QL_CFG_FORMATS & 30) == 30
    RUN(the_dither_of_every_format_is_unbiased);
#endif
    RUN(truncation_instead_of_dither_is_rejected);
#if QL_CFG_FORMATS & 8
    RUN(gray_is_the_luma_of_rec_709);
#endif
#if (QL_CFG_FORMATS & 24) == 24
    RUN(gray_of_white_is_white_in_every_format);
#endif
#if QL_CFG_FORMATS & 16
    RUN(gray4_is_high_nibble_first_and_keeps_the_neighbour);
#endif
    RUN(lines_take_the_bytes_they_say_for_every_width);
    return TEST_END();
}
