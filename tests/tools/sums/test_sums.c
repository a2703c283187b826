/* test_sums.c - sum files: ranges in one form, whole numbers, any turned bit */
/* SPDX-License-Identifier: MIT */

#define _XOPEN_SOURCE     700 /* pwrite() */
#define _FILE_OFFSET_BITS 64

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "lib/sums/sums.h"
#include "support/ql_test.h"

enum { WIDTH = 2, HEIGHT = 7, HEAD_BYTES = 108 };

static void begin(sums_t *sums)
{
    memset(sums, 0, sizeof *sums);
    sums->field[SUMS_WIDTH] = WIDTH;
    sums->field[SUMS_HEIGHT] = HEIGHT;
    sums->field[SUMS_DIR_BITS] = 22;
    sums->field[SUMS_LIGHT_SAMPLES] = 1;
    sums->field[SUMS_TABLE_BITS] = 7;
    sums_new(sums, 0, HEIGHT);
}

/* The bytes of a sum file, and how many. */
static uint8_t *encode(sums_t *sums, size_t *size)
{
    cli_out_t out = {tmpfile(), "", NULL, NULL};
    uint8_t *data;

    sums_write(sums, &out);
    *size = (size_t)ftell(out.file);
    data = cli_alloc(*size, 1);
    rewind(out.file);
    CHECK(fread(data, 1, *size, out.file) == *size, "%zu bytes", *size);
    fclose(out.file);
    return data;
}

/* ---- Ranges -------------------------------------------------------------- */

/* Write ranges, and say how they come out: "0:2 0:8, ...". */
static void check_joined(
        const sums_range_t *ranges, unsigned n, const char *want)
{
    uint32_t clash[2];
    sums_t sums, back;
    char text[200] = "";
    size_t size, where;
    uint8_t *data;

    begin(&sums);
    for (unsigned i = 0; i < n; i++) {
        ranges_add(&sums.ranges, ranges + i);
    }
    CHECK(sums_settle(&sums, clash), "%s", "they overlap");
    data = encode(&sums, &size);
    sums_free(&sums);
    CHECK(sums_decode(&back, data, size, &where) == NULL, "at %zu", where);
    for (uint32_t i = 0; i < back.ranges.count; i++) {
        const sums_range_t *r = back.ranges.items + i;
        const size_t at = strlen(text);

        snprintf(text + at, sizeof text - at, "%s%u:%u %u:%u",
                i > 0 ? ", " : "", (unsigned)r->row_first, (unsigned)r->row_end,
                (unsigned)r->sample_first, (unsigned)r->sample_end);
    }
    CHECK(strcmp(text, want) == 0, "%s, wanted %s", text, want);
    sums_free(&back);
    free(data);
}

#define JOINED(want, ...)                                                      \
    do {                                                                       \
        static const sums_range_t ranges[] = {__VA_ARGS__};                    \
        check_joined(ranges, sizeof ranges / sizeof *ranges, want);            \
    } while (0)

TEST(ranges_are_joined_where_they_can_be_and_nowhere_else)
{
    /* samples of the same rows, in any order */
    JOINED("0:2 0:9", {0, 2, 4, 9}, {0, 2, 0, 4});
    JOINED("0:2 0:3, 0:2 4:9", {0, 2, 4, 9}, {0, 2, 0, 3});
    /* rows with the same samples */
    JOINED("0:5 2:4", {3, 5, 2, 4}, {0, 3, 2, 4});
    JOINED("0:2 2:4, 3:5 2:4", {3, 5, 2, 4}, {0, 2, 2, 4});
    /* rows with other samples: one end differs, then the other */
    JOINED("0:3 2:4, 3:5 2:5", {0, 3, 2, 4}, {3, 5, 2, 5});
    JOINED("0:3 1:4, 3:5 2:4", {0, 3, 1, 4}, {3, 5, 2, 4});
    /* one range above two, two above one */
    JOINED("0:2 0:2, 1:2 3:4", {0, 1, 0, 2}, {1, 2, 0, 2}, {1, 2, 3, 4});
    JOINED("0:1 0:2, 0:2 3:4", {0, 1, 0, 2}, {0, 2, 3, 4});
    /* two above the same two; above two of which the second differs */
    JOINED("0:3 0:2, 0:3 3:4", {0, 1, 0, 2}, {1, 3, 0, 2}, {0, 2, 3, 4},
            {2, 3, 3, 4});
    JOINED("0:3 0:2, 0:1 3:4, 1:3 3:5", {0, 1, 0, 2}, {0, 1, 3, 4},
            {1, 3, 0, 2}, {1, 3, 3, 5});
    /* cut by others, and made whole again */
    JOINED("1:7 5:9", {1, 4, 5, 7}, {2, 7, 7, 9}, {4, 7, 5, 7}, {1, 2, 7, 9});
}

/* ---- Numbers and damage -------------------------------------------------- */

static uint64_t sum_of(size_t i)
{
    static const uint64_t sums[] = {0, 1, 0xffffffff, 0x100000000, 0x1fffffffe,
            0x7fffffffffffffff, 0x8000000000000000, 0xffffffff00000000,
            UINT64_MAX};

    return sums[i % 9];
}

/* Rows 1 to 3 of seven. */
static uint8_t *example(size_t *size)
{
    const sums_range_t range = {1, 4, 3, 1u << 24};
    uint8_t *data;
    sums_t sums;

    begin(&sums);
    sums_settle_one(&sums, &range);
    for (size_t i = 3 * WIDTH; i < 3 * WIDTH * 4; i++) {
        sums.pixels[i / 3].rgb[i % 3] = sum_of(i);
    }
    data = encode(&sums, size);
    sums_free(&sums);
    return data;
}

/* The layout of sums.h, byte by byte. */
TEST(sums_of_all_64_bits_lie_where_the_header_says)
{
    static const uint8_t range[16] = {
            1, 0, 0, 0, 4, 0, 0, 0, 3, 0, 0, 0, 0, 0, 0, 1};
    size_t size, where;
    uint8_t *data = example(&size);
    sums_t back;

    CHECK(size == HEAD_BYTES + 16 + 3 * WIDTH * 24 + 4, "%zu bytes", size);
    CHECK(memcmp(data + HEAD_BYTES, range, 16) == 0, "%s", "another range");
    for (size_t i = 0; i < 9 * WIDTH; i++) {
        const uint64_t want = sum_of(3 * WIDTH + i);

        for (unsigned k = 0; k < 8; k++) {
            CHECK(data[HEAD_BYTES + 16 + 8 * i + k] == (uint8_t)(want >> 8 * k),
                    "byte %u of sum %zu", k, i);
        }
    }
    CHECK(sums_decode(&back, data, size, &where) == NULL, "at %zu", where);
    for (size_t i = 0; i < 3 * WIDTH * HEIGHT; i++) {
        const bool there = i >= 3 * WIDTH && i < 3 * WIDTH * 4;

        CHECK(back.pixels[i / 3].rgb[i % 3] == (there ? sum_of(i) : 0),
                "sum %zu", i);
    }
    CHECK(sums_row_count(&back, 0) == 0 && sums_row_count(&back, 4) == 0 &&
                    sums_row_count(&back, 3) == (1u << 24) - 3,
            "%lu samples", (unsigned long)sums_row_count(&back, 3));
    sums_free(&back);
    free(data);
}

TEST(every_turned_bit_is_noticed)
{
    size_t size, where;
    uint8_t *data = example(&size);

    for (size_t bit = 0; bit < 8 * size; bit++) {
        const char *error;
        sums_t back;

        data[bit / 8] ^= (uint8_t)(1u << bit % 8);
        error = sums_decode(&back, data, size, &where);
        CHECK(error != NULL, "bit %zu of %zu", bit, 8 * size);
        CHECK(bit < 32 ? where == 0 : where == size - 4, "bit %zu: byte %zu",
                bit, where);
        data[bit / 8] ^= (uint8_t)(1u << bit % 8);
    }
    NOTE("%zu bits", 8 * size);
    free(data);
}

/* 16384 x 16384: a file of 6.4 GB, all holes but for two rows. Rows at the
 * front are not held, so their places are not counted. */
TEST(rows_beyond_2_to_the_32_bytes_are_read)
{
    enum { SIDE = 16384, ROW_BYTES = 24 * SIDE };
    static const uint32_t rows[] = {11000, SIDE - 1};
    sums_rows_t held[] = {{0, 3, 0}, {5, SIDE, 3}};
    FILE *large = tmpfile();
    sums_file_t file = {.path = "large",
            .fd = fileno(large),
            .base = 7,
            .rows_at = 92,
            .rows = held,
            .row_count = 2};
    ql_sum_t *row = cli_alloc(SIDE, sizeof *row);

    file.head.field[SUMS_WIDTH] = SIDE;
    for (unsigned i = 0; i < 2; i++) {
        const uint64_t at = 7 + 92 + (uint64_t)ROW_BYTES * (rows[i] - 2) +
                            24 * (uint64_t)(SIDE - 1);
        const uint8_t byte = (uint8_t)(rows[i] % 251);

        CHECK(at >> 32 != 0, "byte %llu", (unsigned long long)at);
        CHECK(pwrite(file.fd, &byte, 1, (off_t)at) == 1, "row %u", rows[i]);
    }
    CHECK(ftruncate(file.fd, (off_t)ROW_BYTES * SIDE + 99) == 0, "%s", "size");
    for (unsigned i = 0; i < 2; i++) {
        CHECK(sums_row(&file, rows[i], row) &&
                        row[SIDE - 1].rgb[0] == rows[i] % 251 &&
                        row[0].rgb[0] == 0,
                "row %u", rows[i]);
    }
    CHECK(!sums_row(&file, 3, row) && !sums_row(&file, 4, row) &&
                    sums_row(&file, 5, row),
            "%s", "rows that are not held");
    CHECK(sums_holds(&file, 4, 6) && !sums_holds(&file, 3, 5) &&
                    sums_holds(&file, 0, SIDE),
            "%s", "ranges of rows");
    free(row);
    fclose(large);
}

int main(int argc, char **argv)
{
    cli_begin("test_sums");
    TEST_BEGIN("tools/test_sums", argc, argv);
    RUN(ranges_are_joined_where_they_can_be_and_nowhere_else);
    RUN(sums_of_all_64_bits_lie_where_the_header_says);
    RUN(every_turned_bit_is_noticed);
    RUN(rows_beyond_2_to_the_32_bytes_are_read);
    return TEST_END();
}
