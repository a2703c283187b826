/* blocks.c - a picture in a terminal, two pixels a character */
/* SPDX-License-Identifier: MIT */

#include "lib/terminal/blocks.h"

#include <stdlib.h>
#include <string.h>

#include "lib/program/cli.h"

#define UPPER_HALF "\xe2\x96\x80" /* U+2580 */

/* a * b / c, at least 1. */
static uint32_t scaled(uint32_t a, uint32_t b, uint32_t c)
{
    const uint32_t n = (uint32_t)((uint64_t)a * b / c); /* sides: < 2^16 */

    return n > 0 ? n : 1;
}

static bool has_full_colour(void)
{
    const char *said = getenv("COLORTERM");

    return said != NULL &&
           (strcmp(said, "truecolor") == 0 || strcmp(said, "24bit") == 0);
}

void blocks_begin(blocks_t *blocks, uint32_t width, uint32_t height)
{
    unsigned columns, lines;
    uint32_t rows;

    cli_terminal_size(&columns, &lines);
    rows = lines > 2 ? 2 * (lines - 2) : 2; /* below it a bar and a prompt */
    memset(blocks, 0, sizeof *blocks);
    blocks->width = width;
    blocks->height = height;
    blocks->columns = width < columns ? width : columns;
    blocks->rows = scaled(height, blocks->columns, width);
    if (blocks->rows > rows) {
        blocks->rows = rows;
        blocks->columns = scaled(width, rows, height);
    }
    blocks->full_colour = has_full_colour();
    blocks->sums = cli_alloc(
            (size_t)blocks->columns * blocks->rows, 4 * sizeof *blocks->sums);
}

void blocks_row(blocks_t *blocks, uint32_t y, const uint8_t *rgb)
{
    const size_t row = (size_t)y * blocks->rows / blocks->height;

    for (uint32_t x = 0; x < blocks->width; x++) {
        const size_t column = (size_t)x * blocks->columns / blocks->width;
        uint64_t *sum = blocks->sums + 4 * (row * blocks->columns + column);

        for (unsigned k = 0; k < 3; k++) {
            sum[k] += rgb[3 * (size_t)x + k];
        }
        sum[3]++;
    }
}

/* The mean of a place, 0 if nothing came. */
static void mean_of(const blocks_t *blocks, size_t place, uint8_t rgb[3])
{
    const uint64_t *sum = blocks->sums + 4 * place;

    for (unsigned k = 0; k < 3; k++) {
        rgb[k] = (uint8_t)(sum[3] > 0 ? (sum[k] + sum[3] / 2) / sum[3] : 0);
    }
}

/* The nearest of the levels 0, 95, 135, 175, 215, 255. */
static unsigned level_of(uint8_t value)
{
    return value < 48 ? 0 : value < 115 ? 1 : (value - 35u) / 40;
}

/* kind: 38 the colour, 48 the background. */
static void set_colour(
        const blocks_t *blocks, FILE *to, unsigned kind, const uint8_t rgb[3])
{
    if (blocks->full_colour) {
        fprintf(to, "\033[%u;2;%u;%u;%um", kind, rgb[0], rgb[1], rgb[2]);
    } else {
        fprintf(to, "\033[%u;5;%um", kind,
                16 + 36 * level_of(rgb[0]) + 6 * level_of(rgb[1]) +
                        level_of(rgb[2]));
    }
}

void blocks_draw(blocks_t *blocks, FILE *to)
{
    const size_t width = blocks->columns;
    const uint32_t lines = (blocks->rows + 1) / 2;

    if (blocks->drawn) {
        fprintf(to, "\r\033[%uA", (unsigned)lines);
    }
    for (uint32_t line = 0; line < lines; line++) {
        for (size_t x = 0; x < width; x++) {
            uint8_t rgb[3] = {0, 0, 0};

            mean_of(blocks, 2 * line * width + x, rgb);
            set_colour(blocks, to, 38, rgb);
            if (2 * line + 1 < blocks->rows) {
                mean_of(blocks, (2 * line + 1) * width + x, rgb);
                set_colour(blocks, to, 48, rgb);
            }
            fputs(UPPER_HALF, to);
        }
        fputs("\033[0m\n", to);
    }
    fflush(to);
    blocks->drawn = true;
    memset(blocks->sums, 0, width * blocks->rows * 4 * sizeof *blocks->sums);
}

void blocks_free(blocks_t *blocks)
{
    free(blocks->sums);
    memset(blocks, 0, sizeof *blocks);
}
