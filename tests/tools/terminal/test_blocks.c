/* test_blocks.c - a picture in a terminal, place by place */
/* SPDX-License-Identifier: MIT */

#define _XOPEN_SOURCE 700 /* setenv() */

#include <stdlib.h>
#include <string.h>

#include "lib/program/cli.h"
#include "lib/terminal/blocks.h"
#include "support/ql_test.h"

enum { WIDTH_MAX = 400, COLUMNS = 80, LINES = 24 }; /* of no terminal */

/* What is drawn, read back: colour and background of each place. */
typedef struct {
    unsigned count; /* blocks */
    unsigned rgb[COLUMNS * LINES][2][3];
    unsigned lines;
    unsigned up; /* lines that the cursor went up at first */
} seen_t;

static seen_t seen;

/* One escape sequence behind its "ESC [". */
static const char *take_escape(const char *at, unsigned now[2][3])
{
    unsigned kind, r, g, b;
    int used = 0;

    if (sscanf(at, "%u;2;%u;%u;%um%n", &kind, &r, &g, &b, &used) == 4 &&
            used > 0 && (kind == 38 || kind == 48)) {
        now[kind == 48][0] = r;
        now[kind == 48][1] = g;
        now[kind == 48][2] = b;
    } else if (sscanf(at, "%u;5;%um%n", &kind, &r, &used) == 2 && used > 0 &&
               r >= 16 && r < 232) {
        static const unsigned level[] = {0, 95, 135, 175, 215, 255};

        now[kind == 48][0] = level[(r - 16) / 36];
        now[kind == 48][1] = level[(r - 16) / 6 % 6];
        now[kind == 48][2] = level[(r - 16) % 6];
    } else if (sscanf(at, "%uA%n", &r, &used) == 1 && used > 0) {
        seen.up = r;
    } else if (strncmp(at, "0m", 2) == 0) {
        memset(now, 0, 2 * sizeof now[0]);
        used = 2;
    } else {
        CHECK(false, "ESC [ %.8s", at);
        used = 1;
    }
    return at + used;
}

static void draw(blocks_t *blocks)
{
    static char text[COLUMNS * LINES * 50];
    unsigned now[2][3] = {{0}};
    FILE *file = tmpfile();
    const char *at = text;
    size_t size;

    if (file == NULL) {
        cli_fail(CLI_IO, "no temporary file");
    }
    blocks_draw(blocks, file);
    rewind(file);
    size = fread(text, 1, sizeof text - 1, file);
    text[size] = '\0';
    fclose(file);
    memset(&seen, 0, sizeof seen);
    while (*at != '\0') {
        if (strncmp(at, "\033[", 2) == 0) {
            at = take_escape(at + 2, now);
        } else if (strncmp(at, "\xe2\x96\x80", 3) == 0) {
            memcpy(seen.rgb[seen.count++], now, sizeof now);
            at += 3;
        } else {
            CHECK(*at == '\n' || *at == '\r', "a character %02x",
                    (unsigned char)*at);
            seen.lines += *at++ == '\n';
        }
    }
}

static void put_row(blocks_t *blocks, uint32_t y, uint32_t width,
        void (*pixel)(uint32_t x, uint32_t y, uint8_t rgb[3]))
{
    static uint8_t row[3 * WIDTH_MAX];

    for (uint32_t x = 0; x < width; x++) {
        pixel(x, y, row + 3 * x);
    }
    blocks_row(blocks, y, row);
}

static void any_pixel(uint32_t x, uint32_t y, uint8_t rgb[3])
{
    rgb[0] = (uint8_t)(x * 37 + y);
    rgb[1] = (uint8_t)(x + y * 91);
    rgb[2] = (uint8_t)(x * 5 ^ y * 3);
}

static void check_place(unsigned place, unsigned half, const uint8_t rgb[3])
{
    const unsigned *got = seen.rgb[place][half];

    CHECK(got[0] == rgb[0] && got[1] == rgb[1] && got[2] == rgb[2],
            "place %u.%u is %u %u %u, not %u %u %u", place, half, got[0],
            got[1], got[2], rgb[0], rgb[1], rgb[2]);
}

TEST(a_picture_that_fits_is_drawn_pixel_by_pixel)
{
    blocks_t blocks;

    (void)setenv("COLORTERM", "truecolor", 1);
    blocks_begin(&blocks, 7, 5);
    for (uint32_t y = 0; y < 5; y++) {
        put_row(&blocks, y, 7, any_pixel);
    }
    draw(&blocks);
    CHECK(seen.count == 21 && seen.lines == 3 && seen.up == 0,
            "%u places in %u lines, %u up", seen.count, seen.lines, seen.up);
    for (uint32_t i = 0; i < 35; i++) {
        uint8_t rgb[3];

        any_pixel(i % 7, i / 7, rgb);
        check_place(i / 14 * 7 + i % 7, i / 7 % 2, rgb);
    }
    blocks_free(&blocks);
}

TEST(the_next_drawing_is_over_the_last)
{
    static const uint8_t black[3];
    blocks_t blocks;
    uint8_t rgb[3];

    (void)setenv("COLORTERM", "24bit", 1);
    blocks_begin(&blocks, 3, 4);
    put_row(&blocks, 0, 3, any_pixel);
    draw(&blocks);
    put_row(&blocks, 2, 3, any_pixel);
    draw(&blocks);
    CHECK(seen.up == 2 && seen.lines == 2, "%u up, %u lines", seen.up,
            seen.lines);
    any_pixel(1, 2, rgb);
    check_place(4, 0, rgb);
    check_place(1, 0, black); /* what came before the last drawing */
    check_place(4, 1, black); /* what never came */
    blocks_free(&blocks);
}

static void halves(uint32_t x, uint32_t y, uint8_t rgb[3])
{
    rgb[0] = (uint8_t)(x % 4 < 2 ? 10 : 21); /* mean of four 15.5, half up */
    rgb[1] = (uint8_t)(y % 4 < 2 ? 0 : 255);
    rgb[2] = (uint8_t)(x < 160 ? 200 : 100);
}

/* 320 x 80 in 80 columns: four by four pixels a place. */
TEST(a_larger_picture_is_averaged_in_proportion)
{
    static const uint8_t left[3] = {16, 128, 200}, right[3] = {16, 128, 100};
    blocks_t blocks;

    (void)setenv("COLORTERM", "truecolor", 1);
    blocks_begin(&blocks, 320, 80);
    for (uint32_t y = 0; y < 80; y++) {
        put_row(&blocks, y, 320, halves);
    }
    draw(&blocks);
    CHECK(seen.count == 800 && seen.lines == 10, "%u places in %u lines",
            seen.count, seen.lines);
    for (unsigned i = 0; i < 800; i++) {
        check_place(i, 0, i % 80 < 40 ? left : right);
        check_place(i, 1, i % 80 < 40 ? left : right);
    }
    blocks_free(&blocks);
}

/* Two of 24 lines are left, and no side ends at 0. */
TEST(a_high_picture_leaves_a_line_and_a_wide_one_is_not_lost)
{
    blocks_t blocks;

    blocks_begin(&blocks, 100, 400);
    CHECK(blocks.columns == 11 && blocks.rows == 44, "%u x %u",
            (unsigned)blocks.columns, (unsigned)blocks.rows);
    blocks_free(&blocks);
    blocks_begin(&blocks, 16384, 1);
    CHECK(blocks.columns == 80 && blocks.rows == 1, "%u x %u",
            (unsigned)blocks.columns, (unsigned)blocks.rows);
    blocks_free(&blocks);
    blocks_begin(&blocks, 1, 16384);
    CHECK(blocks.columns == 1 && blocks.rows == 44, "%u x %u",
            (unsigned)blocks.columns, (unsigned)blocks.rows);
    blocks_free(&blocks);
}

static void greys(uint32_t x, uint32_t y, uint8_t rgb[3])
{
    const uint32_t i = x + 64 * y;

    rgb[0] = (uint8_t)i;
    rgb[1] = (uint8_t)(255 - i);
    rgb[2] = (uint8_t)(i * 7);
}

/* Each of 256 values by the nearest of six levels. */
TEST(terminals_of_256_colours_get_the_nearest)
{
    static const int level[] = {0, 95, 135, 175, 215, 255};
    blocks_t blocks;

    (void)unsetenv("COLORTERM");
    blocks_begin(&blocks, 64, 4);
    for (uint32_t y = 0; y < 4; y++) {
        put_row(&blocks, y, 64, greys);
    }
    draw(&blocks);
    CHECK(seen.count == 128, "%u places", seen.count);
    for (uint32_t i = 0; i < 256; i++) {
        uint8_t rgb[3];

        greys(i % 64, i / 64, rgb);
        for (unsigned k = 0; k < 3; k++) {
            const int got = (int)seen.rgb[i / 128 * 64 + i % 64][i / 64 % 2][k];

            for (unsigned n = 0; n < 6; n++) {
                CHECK(abs(got - rgb[k]) <= abs(level[n] - rgb[k]),
                        "%u as %d: %d is nearer", rgb[k], got, level[n]);
            }
        }
    }
    blocks_free(&blocks);
}

int main(int argc, char **argv)
{
    cli_begin("test_blocks");
    TEST_BEGIN("tools/test_blocks", argc, argv);
    RUN(a_picture_that_fits_is_drawn_pixel_by_pixel);
    RUN(the_next_drawing_is_over_the_last);
    RUN(a_larger_picture_is_averaged_in_proportion);
    RUN(a_high_picture_leaves_a_line_and_a_wide_one_is_not_lost);
    RUN(terminals_of_256_colours_get_the_nearest);
    return TEST_END();
}
