/* sums.c - sum files: exact sums of samples, to be added up across machines */
/* SPDX-License-Identifier: MIT */

#ifndef _XOPEN_SOURCE
#define _XOPEN_SOURCE 700 /* pread() */
#endif
#define _FILE_OFFSET_BITS 64

#include "lib/sums/sums.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <unistd.h>

#include "base/ql_crc.h"
#include "base/ql_settings.h"
#include "lib/program/bytes.h"

enum {
    HEAD_BYTES = 8 + 4 * SUMS_FIELD_COUNT + 24,
    RANGE_BYTES = 16,
    PIXEL_BYTES = 24,
    CRC_BYTES = 4,
    STEP_BYTES = 1 << 16
};

/* Files of more than 2^32 bytes: an off_t has 64 bits. */
typedef char off_t_is_wide[sizeof(off_t) >= 8 ? 1 : -1];

static const struct {
    const char *name;
    int64_t min;
    int64_t max;
} fields[SUMS_FIELD_COUNT] = {
#define SUMS_FIELD_ROW(name, text, min, max) {text, min, max},
        SUMS_FIELD_LIST(SUMS_FIELD_ROW)
#undef SUMS_FIELD_ROW
};

const char *sums_field_name(unsigned field)
{
    return fields[field].name;
}

int64_t sums_field_value(const sums_t *sums, unsigned field)
{
    const uint32_t bits = sums->field[field];

    return fields[field].min < 0 ? ql_i32(bits) : (int64_t)bits;
}

unsigned sums_compare(const sums_t *a, const sums_t *b)
{
    unsigned i = 0;

    while (i < SUMS_FIELD_COUNT && a->field[i] == b->field[i]) {
        i++;
    }
    return i;
}

void sums_new(sums_t *sums, uint32_t row_first, uint32_t row_end)
{
    const uint32_t width = sums->field[SUMS_WIDTH];
    const uint32_t rows = row_end - row_first;

    sums->row_counts =
            cli_alloc(sums->field[SUMS_HEIGHT], sizeof *sums->row_counts);
    sums->row_first = row_first;
    sums->row_end = row_end;
    sums->pixels = calloc(rows != 0 ? rows : 1, width * sizeof(ql_sum_t));
    if (sums->pixels == NULL) {
        cli_fail(CLI_IO,
                "out of memory for the sums of rows %u:%u, %" PRIu64 " bytes; "
                "fewer rows take less",
                (unsigned)row_first, (unsigned)row_end,
                (uint64_t)rows * width * sizeof(ql_sum_t));
    }
}

void sums_own_counts(sums_t *sums)
{
    sums->counts = cli_alloc(sums->row_end - sums->row_first,
            sums->field[SUMS_WIDTH] * sizeof *sums->counts);
}

void sums_free(sums_t *sums)
{
    ranges_free(&sums->ranges);
    free(sums->row_counts);
    free(sums->pixels);
    free(sums->counts);
    memset(sums, 0, sizeof *sums);
}

bool sums_settle(sums_t *sums, uint32_t clash[2])
{
    const uint32_t height = sums->field[SUMS_HEIGHT];

    if (!ranges_join(&sums->ranges, clash)) {
        return false;
    }
    ranges_count(&sums->ranges, sums->row_counts, height);
    return true;
}

void sums_settle_one(sums_t *sums, const sums_range_t *range)
{
    uint32_t none[2];

    ranges_add(&sums->ranges, range);
    (void)sums_settle(sums, none);
}

uint32_t sums_row_count(const sums_t *sums, uint32_t y)
{
    return sums->row_counts[y];
}

/* Of a row in memory. */
static size_t place_of(const sums_t *sums, uint32_t y)
{
    return (size_t)sums->field[SUMS_WIDTH] * (y - sums->row_first);
}

uint32_t sums_count(const sums_t *sums, uint32_t x, uint32_t y)
{
    return sums->counts != NULL && sums->row_counts[y] != 0
                   ? sums->counts[place_of(sums, y) + x]
                   : sums->row_counts[y];
}

ql_sum_t *sums_pixels(const sums_t *sums, uint32_t y)
{
    return sums->pixels + place_of(sums, y);
}

void sums_add_pixels(ql_sum_t *to, const ql_sum_t *from, uint32_t count)
{
    for (size_t k = 0; k < 3 * (size_t)count; k++) {
        uint64_t *sum = to[k / 3].rgb + k % 3;
        const uint64_t add = from[k / 3].rgb[k % 3];

        *sum = add > UINT64_MAX - *sum ? UINT64_MAX : *sum + add;
    }
}

/* ---- Read -------------------------------------------------------------- */

/* Size bytes of the file from an offset on. */
static void fetch(
        const sums_file_t *file, uint64_t at, void *bytes, size_t size)
{
    uint8_t *to = bytes;

    if (file->data != NULL) {
        memcpy(to, file->data + at, size);
        return;
    }
    at += file->base;
    while (size > 0) {
        const ssize_t n = pread(file->fd, to, size, (off_t)at);

        if (n == 0 || (n < 0 && errno != EINTR)) {
            cli_fail(CLI_IO, "cannot read %s: %s", file->path,
                    n == 0 ? "it became shorter" : strerror(errno));
        }
        to += n > 0 ? n : 0;
        at += n > 0 ? (uint64_t)n : 0;
        size -= n > 0 ? (size_t)n : 0;
    }
}

static bool is_crc_right(const sums_file_t *file)
{
    uint8_t *step = cli_alloc(STEP_BYTES, 1);
    uint32_t crc = 0;

    for (uint64_t at = 0; at < file->size;) {
        const uint64_t left = file->size - at;
        const size_t n = left < STEP_BYTES ? (size_t)left : STEP_BYTES;

        fetch(file, at, step, n);
        crc = ql_crc32(crc, step, n);
        at += n;
    }
    fetch(file, file->size, step, CRC_BYTES);
    crc ^= bytes_get_le32(step);
    free(step);
    return crc == 0;
}

static const char *take_fields(sums_t *sums, const uint8_t *data, size_t *at)
{
    static char message[80];

    for (unsigned i = 0; i < SUMS_FIELD_COUNT; i++, *at += 4) {
        int64_t value;
        sums->field[i] = bytes_get_le32(data + *at);
        value = sums_field_value(sums, i);
        if (value < fields[i].min || value > fields[i].max) {
            snprintf(message, sizeof message, "expected %s from %ld to %lu",
                    fields[i].name, (long)fields[i].min,
                    (unsigned long)fields[i].max);
            return message;
        }
    }
    return NULL;
}

static const char *take_ranges(
        sums_t *sums, const uint8_t *data, uint32_t count, size_t *at)
{
    uint32_t clash[2];

    for (uint32_t i = 0; i < count; i++, *at += RANGE_BYTES) {
        const uint8_t *b = data + *at;
        const sums_range_t r = {bytes_get_le32(b), bytes_get_le32(b + 4),
                bytes_get_le32(b + 8), bytes_get_le32(b + 12)};

        if (r.row_first >= r.row_end || r.row_end > sums->field[SUMS_HEIGHT]) {
            return "expected a range of rows of the picture";
        }
        if (r.sample_first >= r.sample_end || r.sample_end > QL_SPP_MAX) {
            return "expected a range of samples from 0 to 2^24";
        }
        ranges_add(&sums->ranges, &r);
    }
    if (!ranges_join(&sums->ranges, clash)) {
        *at = HEAD_BYTES + (size_t)clash[1] * RANGE_BYTES;
        return "a range that overlaps another";
    }
    return NULL;
}

static uint64_t row_bytes(const sums_file_t *file)
{
    return (uint64_t)PIXEL_BYTES * file->head.field[SUMS_WIDTH];
}

/* Ranges are sorted by rows: find those that hold any. */
static void find_rows(sums_file_t *file)
{
    const ranges_t *ranges = &file->head.ranges;
    uint32_t above = 0;

    file->rows = cli_alloc(ranges->count, sizeof *file->rows);
    for (uint32_t i = 0; i < ranges->count; i++) {
        const sums_range_t *r = ranges->items + i;
        sums_rows_t *last = file->rows + file->row_count;

        if (file->row_count > 0 && r->row_first <= last[-1].end) {
            last[-1].end =
                    r->row_end > last[-1].end ? r->row_end : last[-1].end;
        } else {
            above += file->row_count > 0 ? last[-1].end - last[-1].first : 0;
            *last = (sums_rows_t){r->row_first, r->row_end, above};
            file->row_count++;
        }
    }
}

/* The rows that some range holds are the rest of the file. */
static const char *check_rows(sums_file_t *file)
{
    const sums_rows_t *last;
    uint64_t bytes = 0; /* < 2^33 */

    find_rows(file);
    if (file->row_count > 0) {
        last = file->rows + file->row_count - 1;
        bytes = row_bytes(file) * (last->before + last->end - last->first);
    }
    return file->size - file->rows_at < bytes ? "the sums end too early"
           : file->size - file->rows_at > bytes
                   ? "unexpected bytes after the sums"
                   : NULL;
}

/* Fields and ranges, whose bytes are in memory. */
static const char *take_head(sums_file_t *file, size_t *at)
{
    uint8_t head[HEAD_BYTES], *ranges;
    const char *error;
    uint32_t count;

    fetch(file, 0, head, sizeof head);
    *at = 4;
    error = take_fields(&file->head, head, at);
    if (error != NULL) {
        return error;
    }
    for (unsigned i = 0; i < 3; i++, *at += 8) {
        file->head.cut.rgb[i] = bytes_get_le64(head + *at);
    }
    count = bytes_get_le32(head + *at);
    if (count > (file->size - HEAD_BYTES) / RANGE_BYTES) {
        return "expected a number of ranges that the file can hold";
    }
    ranges = cli_alloc(HEAD_BYTES + (size_t)count * RANGE_BYTES, 1);
    *at = HEAD_BYTES;
    fetch(file, 0, ranges, HEAD_BYTES + (size_t)count * RANGE_BYTES);
    error = take_ranges(&file->head, ranges, count, at);
    free(ranges);
    return error;
}

const char *sums_open(sums_file_t *file, uint64_t *where)
{
    char magic[4];
    const char *error;
    size_t at = 0;

    memset(&file->head, 0, sizeof file->head);
    file->row_count = 0;
    file->rows = NULL;
    *where = 0;
    if (file->size >= sizeof magic) {
        fetch(file, 0, magic, sizeof magic);
    }
    if (file->size < sizeof magic || memcmp(magic, "QLS4", 4) != 0) {
        return "expected a sum file (QLS4)";
    }
    *where = file->size;
    if (file->size < HEAD_BYTES + CRC_BYTES) {
        return "the file ends within its header";
    }
    file->size -= CRC_BYTES;
    *where = file->size;
    if (!is_crc_right(file)) {
        return "the CRC-32 does not match: the file was cut or changed";
    }
    error = take_head(file, &at);
    if (error == NULL) {
        file->rows_at = at;
        error = check_rows(file);
    }
    *where = at;
    if (error != NULL) {
        sums_close(file);
    }
    return error;
}

void sums_close(sums_file_t *file)
{
    sums_free(&file->head);
    free(file->rows);
    file->rows = NULL;
    file->row_count = 0;
}

/* The first rows that do not end above y, or those behind the last. */
static uint32_t find_below(const sums_file_t *file, uint32_t y)
{
    uint32_t first = 0, end = file->row_count;

    while (first < end) {
        const uint32_t middle = first + (end - first) / 2;

        if (file->rows[middle].end > y) {
            end = middle;
        } else {
            first = middle + 1;
        }
    }
    return first;
}

bool sums_holds(const sums_file_t *file, uint32_t first, uint32_t end)
{
    const uint32_t i = find_below(file, first);

    return i < file->row_count && file->rows[i].first < end;
}

bool sums_row(const sums_file_t *file, uint32_t y, ql_sum_t *row)
{
    const uint32_t width = file->head.field[SUMS_WIDTH];
    const sums_rows_t *rows = file->rows + find_below(file, y);
    const uint8_t *bytes = (const uint8_t *)row;

    if (!sums_holds(file, y, y + 1)) {
        return false;
    }
    fetch(file,
            file->rows_at + row_bytes(file) * (rows->before + y - rows->first),
            row, (size_t)row_bytes(file));
    for (size_t i = 0; i < 3 * (size_t)width; i++) { /* in place */
        row[i / 3].rgb[i % 3] = bytes_get_le64(bytes + 8 * i);
    }
    return true;
}

const char *sums_decode(
        sums_t *sums, const uint8_t *data, size_t size, size_t *where)
{
    sums_file_t file = {.path = "a sum file", .data = data, .size = size};
    uint64_t at;
    const char *error = sums_open(&file, &at);

    memset(sums, 0, sizeof *sums);
    *where = (size_t)at;
    if (error == NULL) {
        const uint32_t height = file.head.field[SUMS_HEIGHT];

        memcpy(sums->field, file.head.field, sizeof sums->field);
        sums_new(sums, 0, height);
        sums->cut = file.head.cut;
        sums->ranges = file.head.ranges;
        memset(&file.head.ranges, 0, sizeof file.head.ranges);
        ranges_count(&sums->ranges, sums->row_counts, height);
        for (uint32_t y = 0; y < height; y++) {
            (void)sums_row(&file, y, sums_pixels(sums, y));
        }
        sums_close(&file);
    }
    return error;
}

/* ---- Write ------------------------------------------------------------- */

static void put_bytes(sums_writer_t *to, const uint8_t *bytes, size_t size)
{
    to->crc = ql_crc32(to->crc, bytes, size);
    fwrite(bytes, 1, size, to->file);
}

static void put_le32(sums_writer_t *to, uint32_t value)
{
    uint8_t bytes[4];

    bytes_put_le32(bytes, value);
    put_bytes(to, bytes, sizeof bytes);
}

void sums_write_head(sums_writer_t *to, const sums_t *sums, cli_out_t *out)
{
    to->file = out->file;
    to->crc = 0;
    put_bytes(to, (const uint8_t *)"QLS4", 4);
    for (unsigned i = 0; i < SUMS_FIELD_COUNT; i++) {
        put_le32(to, sums->field[i]);
    }
    sums_write_row(to, &sums->cut, 1);
    put_le32(to, sums->ranges.count);
    for (uint32_t i = 0; i < sums->ranges.count; i++) {
        const sums_range_t *r = sums->ranges.items + i;

        put_le32(to, r->row_first);
        put_le32(to, r->row_end);
        put_le32(to, r->sample_first);
        put_le32(to, r->sample_end);
    }
}

void sums_write_row(sums_writer_t *to, const ql_sum_t *row, uint32_t width)
{
    for (size_t i = 0; i < 3 * (size_t)width; i++) {
        const uint64_t sum = row[i / 3].rgb[i % 3];
        put_le32(to, (uint32_t)sum);
        put_le32(to, (uint32_t)(sum >> 32));
    }
}

void sums_write_end(sums_writer_t *to)
{
    put_le32(to, to->crc);
}

void sums_write(const sums_t *sums, cli_out_t *out)
{
    sums_writer_t to;

    sums_write_head(&to, sums, out);
    for (uint32_t y = sums->row_first; y < sums->row_end; y++) {
        if (sums_row_count(sums, y) != 0) {
            sums_write_row(&to, sums_pixels(sums, y), sums->field[SUMS_WIDTH]);
        }
    }
    sums_write_end(&to);
}
