/* sums.h - sum files: exact sums of samples, to be added up across machines */
/* SPDX-License-Identifier: MIT */

/* A .qls file holds part of a picture: some rows, some sample indices. Parts of
 * one picture add up to the very bits of the whole. Numbers are little-endian:
 *
 *     0   4         magic "QLS4"
 *     4   4 * 19    the settings of SUMS_FIELD_LIST, in its order
 *    80   24        u64 of R, G and B: what --clamp cut off the sums, u40.24
 *   104   4         n, the number of ranges
 *   108   16 * n    ranges: row_first, row_end, sample_first, sample_end
 *     .   24 * w    for each row that a range holds, from the top: for each
 *                   pixel u64 sums of R, G and B, u40.24 radiance units
 *     .   4         CRC-32 of everything before
 *
 * Ends are one past the last. Ranges do not overlap; they are joined as
 * ranges_join() says, so that equal parts have equal bytes. The samples of a
 * pixel are those of the ranges that hold its row: their count is not stored a
 * second time. */

#ifndef SUMS_H
#define SUMS_H

#include "lib/program/cli.h"
#include "lib/sums/ranges.h"
#include "film/ql_film.h"

/* What parts must have in common: name, text, smallest, largest. Signed fields
 * are two's complement. */
#define SUMS_FIELD_LIST(X)                                                     \
    X(SUMS_WIDTH, "width", 1, 16384)                                           \
    X(SUMS_HEIGHT, "height", 1, 16384)                                         \
    X(SUMS_BLOB_CRC, "scene CRC-32", 0, 0xffffffff)                            \
    X(SUMS_SEED, "seed", 0, 0xffffffff)                                        \
    X(SUMS_RADIANCE_EXP, "radiance exponent", -64, 64)                         \
    X(SUMS_EXPOSURE_Q8, "exposure", -32768, 32767)                             \
    X(SUMS_POS_BITS, "position bits", 0, 16)                                   \
    X(SUMS_DIR_BITS, "direction bits", 1, 31)                                  \
    X(SUMS_BOUNCES, "bounces", 0, 255)                                         \
    X(SUMS_SAMPLER, "sampler", 0, 255)                                         \
    X(SUMS_DIRECT, "direct strategy", 0, 255)                                  \
    X(SUMS_INDIRECT, "indirect strategy", 0, 255)                              \
    X(SUMS_LIGHTS, "choice of lights", 0, 255)                                 \
    X(SUMS_LIGHT_SAMPLES, "samples a light", 1, 255)                           \
    X(SUMS_ROULETTE, "roulette", 0, 1)                                         \
    X(SUMS_TABLE_BITS, "table bits", 5, 10)                                    \
    X(SUMS_TABLE_LERP, "refined tables", 0, 1)                                 \
    X(SUMS_METERED_Q8, "metered exposure", -16384, 16384)                      \
    X(SUMS_CLAMP_Q16, "clamp", 0, 0xffffffff)

enum {
#define SUMS_FIELD_ENUM(name, text, min, max) name,
    SUMS_FIELD_LIST(SUMS_FIELD_ENUM)
#undef SUMS_FIELD_ENUM
            SUMS_FIELD_COUNT
};

typedef struct {
    uint32_t field[SUMS_FIELD_COUNT];
    ql_sum_t cut;         /* off the pixels, all together; saturates */
    ranges_t ranges;      /* what the pixels hold */
    uint32_t *row_counts; /* samples of a pixel, for each row of the picture */
    uint32_t row_first;   /* of the rows whose pixels are in memory */
    uint32_t row_end;
    ql_sum_t *pixels; /* theirs, from the top */
    uint32_t *counts; /* samples of each pixel if they differ, which no file
                         holds; NULL: as the ranges say */
} sums_t;

/* Take memory for black pixels of some rows; the size fields are set already,
 * everything else is 0. Ends in cli_fail(CLI_IO) if there is not enough. */
void sums_new(sums_t *sums, uint32_t row_first, uint32_t row_end);
void sums_free(sums_t *sums);

/* Once the list of ranges is complete: join it and count the samples of each
 * row. Returns false, and what ranges_join() says, if two overlap. */
bool sums_settle(sums_t *sums, uint32_t clash[2]);

/* The same where the range is the only one. */
void sums_settle_one(sums_t *sums, const sums_range_t *range);

/* Samples in each pixel of a row; of one pixel, which may have its own. */
uint32_t sums_row_count(const sums_t *sums, uint32_t y);
uint32_t sums_count(const sums_t *sums, uint32_t x, uint32_t y);

/* The pixels of a row in memory. */
ql_sum_t *sums_pixels(const sums_t *sums, uint32_t y);

/* Add pixels to others. Sums stay at their maximum as they do while rendering,
 * so any order of adding gives the same bits. */
void sums_add_pixels(ql_sum_t *to, const ql_sum_t *from, uint32_t count);

/* Give each pixel in memory a count of its own, 0 to begin. */
void sums_own_counts(sums_t *sums);

/* Decode a file's bytes, as image_decode() does. */
const char *sums_decode(
        sums_t *sums, const uint8_t *data, size_t size, size_t *where);

/* Rows of a file, one below the other, and how many it has above them. */
typedef struct {
    uint32_t first;
    uint32_t end;
    uint32_t before;
} sums_rows_t;

/* A sum file that is read row by row, so that a picture may be larger than
 * memory. Between two calls it may be closed and opened again. */
typedef struct {
    const char *path;    /* in messages */
    const uint8_t *data; /* all bytes, or NULL: */
    int fd;              /* which can seek */
    uint64_t base;       /* bytes before it in there */
    uint64_t size;

    sums_t head; /* fields and ranges; no pixels, no counts */
    uint64_t rows_at;
    uint32_t row_count;
    sums_rows_t *rows;
} sums_file_t;

/* Check a file: its check value, fields and ranges are found right.
 *
 *   file    -      in: path, and where its bytes are; the rest out, to be freed
 *                  by sums_close() if this succeeds
 *   where   bytes  out: offset of what is wrong
 *   return  NULL, or what was expected there; cli_fail(CLI_IO) if it cannot be
 *           read
 */
const char *sums_open(sums_file_t *file, uint64_t *where);

/* Does it hold any row of [first, end)? */
bool sums_holds(const sums_file_t *file, uint32_t first, uint32_t end);

/* Read a row of width pixels; false and nothing if no range holds it. */
bool sums_row(const sums_file_t *file, uint32_t y, ql_sum_t *row);

/* Free what sums_open() took; fd stays open. */
void sums_close(sums_file_t *file);

/* Write into an open file what is settled; counts is NULL. */
void sums_write(const sums_t *sums, cli_out_t *out);

/* The same piece by piece: the head, each row that a range holds, the end. */
typedef struct {
    FILE *file;
    uint32_t crc;
} sums_writer_t;

void sums_write_head(sums_writer_t *to, const sums_t *sums, cli_out_t *out);
void sums_write_row(sums_writer_t *to, const ql_sum_t *row, uint32_t width);
void sums_write_end(sums_writer_t *to);

/* The first field in which two parts differ, SUMS_FIELD_COUNT if none. */
unsigned sums_compare(const sums_t *a, const sums_t *b);

/* A field's name, and its value as a number. */
const char *sums_field_name(unsigned field);
int64_t sums_field_value(const sums_t *sums, unsigned field);

#endif
