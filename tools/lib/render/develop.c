/* develop.c - sums of samples to a picture: linear, or as a display shows it */
/* SPDX-License-Identifier: MIT */

#include "lib/render/develop.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/render/widen.h"

const char *const develop_formats[QL_FORMAT_COUNT + 1] = {
        "rgb888", "rgb565le", "rgb565be", "gray8", "gray4", NULL};

/* sum / count * 2^exponent as the nearest float, ties to even. In integers, so
 * that every machine agrees, those with 80-bit registers too. */
static float mean_float(uint64_t sum, uint32_t count, int exponent)
{
    const unsigned shift = ql_clz64(sum);
    uint64_t quotient;
    unsigned drop = 0;
    bool above;

    if (sum == 0 || count == 0) {
        return 0;
    }
    sum <<= shift;
    quotient = sum / count; /* >= 2^63 / 2^24: 24 bits and more to round by */
    above = sum % count != 0;
    for (; quotient >> drop >= 1u << 25; drop++) { /* keep 25 bits */
        above = above || (quotient >> drop & 1u) != 0;
    }
    quotient >>= drop;
    if ((quotient & 1u) != 0 && (above || (quotient & 2u) != 0)) {
        quotient++;
    }
    /* Exact: at most 2^24 times a power of two from 2^-200 up; the smallest
     * result is 2^-64-24-24, a normal float. */
    return (float)ldexp(
            (double)(quotient >> 1), exponent - (int)shift + (int)drop + 1);
}

static void develop_linear(
        float *out, const sums_t *sums, const ql_sum_t *pixels, uint32_t y)
{
    const int exponent = (int)sums_field_value(sums, SUMS_RADIANCE_EXP);

    for (uint32_t x = 0; x < sums->field[SUMS_WIDTH]; x++) {
        for (unsigned k = 0; k < 3; k++) {
            *out++ = mean_float(pixels[x].rgb[k], sums_count(sums, x, y),
                    exponent - QL_SUM_BITS);
        }
    }
}

static void develop_display(uint8_t *out, const sums_t *sums,
        const ql_sum_t *pixels, uint32_t y, const develop_t *how)
{
    const ql_format_t format = how->format;
    const uint32_t width = sums->field[SUMS_WIDTH];
    const ql_real_t exposure =
            ql_film_exposure((int16_t)sums_field_value(sums, SUMS_RADIANCE_EXP),
                    (int32_t)sums_field_value(sums, SUMS_EXPOSURE_Q8) +
                            how->exposure_q8);
    uint8_t *line = cli_alloc(QL_LINE_BYTES((size_t)width, format), 1);

    for (uint32_t x = 0; x < width; x++) {
        ql_uq16_t linear[3];
        ql_film_display(pixels + x, sums_count(sums, x, y), exposure, linear);
        ql_curve_roll_off(how->curve, linear);
        ql_tonemap_pixel(line, format, (uint16_t)x, (uint16_t)y, linear);
    }
    widen_line(out, line, format, width);
    free(line);
}

void develop_row(image_t *line, const sums_t *sums, const ql_sum_t *pixels,
        uint32_t y, const develop_t *how)
{
    const size_t n = 3 * (size_t)line->width;

    if (sums_row_count(sums, y) == 0) { /* not even dithered */
        if (line->floats != NULL) {
            memset(line->floats, 0, n * sizeof *line->floats); /* as 0.0f */
        } else {
            memset(line->bytes, 0, n);
        }
    } else if (line->floats != NULL) {
        develop_linear(line->floats, sums, pixels, y);
    } else {
        develop_display(line->bytes, sums, pixels, y, how);
    }
}

void develop_write(const sums_t *sums, const develop_t *how, cli_out_t *out)
{
    const uint32_t width = sums->field[SUMS_WIDTH];
    const uint32_t height = sums->field[SUMS_HEIGHT];
    image_writer_t writer;
    image_t line;

    if (how->kind == IMAGE_PFM) {
        image_new_floats(&line, width, 1);
    } else {
        image_new_bytes(&line, width, 1);
    }
    image_begin(&writer, how->kind, width, height, out);
    for (uint32_t i = 0; i < height; i++) {
        const uint32_t y = image_row_at(&writer, i);
        const ql_sum_t *pixels = NULL;

        if (sums_row_count(sums, y) != 0) {
            pixels = how->row != NULL ? how->row(how->from, y)
                                      : sums_pixels(sums, y);
        }
        develop_row(&line, sums, pixels, y, how);
        image_row(&writer, &line);
    }
    image_end(&writer);
    image_free(&line);
}
