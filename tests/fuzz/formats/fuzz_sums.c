/* fuzz_sums.c - a sum file, its CRC mended: whole, by rows, written again */
/* SPDX-License-Identifier: MIT */

#define _DEFAULT_SOURCE /* ftruncate() and what stdio has of POSIX */

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/ql_crc.h"
#include "fuzz/fuzz.h"
#include "lib/program/bytes.h"
#include "lib/sums/sums.h"

enum { CRC = 4 };

static uint8_t *write_sums(const sums_t *sums, size_t *size)
{
    cli_out_t out = {.file = fuzz_open()};

    sums_write(sums, &out);
    return fuzz_close(size);
}

/* Written and read again it is the same; ranges are joined in one way. */
static void write_again(const sums_t *sums)
{
    size_t size, again_size, where;
    uint8_t *file = write_sums(sums, &size), *file_again;
    sums_t again;

    FUZZ_CHECK(sums_decode(&again, file, size, &where) == NULL);
    FUZZ_CHECK(sums_compare(sums, &again) == SUMS_FIELD_COUNT);
    file_again = write_sums(&again, &again_size);
    FUZZ_CHECK(size == again_size && memcmp(file, file_again, size) == 0);
    sums_free(&again);
    free(file);
    free(file_again);
}

/* Rows from a file are those of the whole. */
static void read_rows(const uint8_t *data, size_t size, const sums_t *sums)
{
    static FILE *file;
    const uint32_t width = sums->field[SUMS_WIDTH];
    sums_file_t rows = {.path = "sums", .size = size};
    ql_sum_t *row;
    uint64_t where;

    if (file == NULL) {
        file = tmpfile();
        FUZZ_CHECK(file != NULL);
    }
    rows.fd = fileno(file);
    FUZZ_CHECK(ftruncate(rows.fd, 0) == 0 &&
               pwrite(rows.fd, data, size, 0) == (ssize_t)size);
    FUZZ_CHECK(sums_open(&rows, &where) == NULL);
    row = cli_alloc(width, sizeof *row);
    for (uint32_t y = sums->field[SUMS_HEIGHT]; y-- > 0;) {
        const bool held = sums_row_count(sums, y) != 0;

        FUZZ_CHECK(sums_row(&rows, y, row) == held);
        FUZZ_CHECK(!held ||
                   memcmp(row, sums_pixels(sums, y), width * sizeof *row) == 0);
    }
    free(row);
    sums_close(&rows);
}

void fuzz_sums(const uint8_t *data, size_t size)
{
    uint8_t *copy = cli_alloc(size, 1);
    sums_t sums;
    size_t where;

    if (size > 0) {
        memcpy(copy, data, size);
    }
    if (size >= CRC) {
        bytes_put_le32(copy + size - CRC, ql_crc32(0, copy, size - CRC));
    }
    if (sums_decode(&sums, copy, size, &where) == NULL) {
        read_rows(copy, size, &sums);
        write_again(&sums);
        sums_free(&sums);
    } else {
        FUZZ_CHECK(where <= size);
    }
    free(copy);
}
