/* sums.c - sum files: exact sums of samples, to be added up across machines */
/* SPDX-License-Identifier: MIT */

#ifndef _XOPEN_SOURCE
#define _XOPEN_SOURCE 700 /* pread() */
#endif
#define _FILE_OFFSET_BITS 64

#include "lib/render/sums.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/ql_crc.h"
#include "base/ql_settings.h"
#include "lib/program/bytes.h"

enum {
    HEAD_BYTES = 8 + 4 * SUMS_FIELD_COUNT,
    RANGE_BYTES = 16,
    PIXEL_BYTES = 24,
    CRC_BYTES = 4,
    STEP_BYTES = 1 << 16
};

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

void sums_new(sums_t *sums)
{
    sums->range_count = 0;
    sums->ranges = NULL;
    sums->counts = NULL;
    sums->pixels = cli_alloc(sums->field[SUMS_HEIGHT],
            sums->field[SUMS_WIDTH] * sizeof(ql_sum_t));
}

void sums_own_counts(sums_t *sums)
{
    sums->counts = cli_alloc(sums->field[SUMS_HEIGHT],
            sums->field[SUMS_WIDTH] * sizeof *sums->counts);
}

void sums_free(sums_t *sums)
{
    free(sums->ranges);
    free(sums->pixels);
    free(sums->counts);
    memset(sums, 0, sizeof *sums);
}

/* ---- Ranges ------------------------------------------------------------ */

static void append_range(sums_t *sums, const sums_range_t *range)
{
    const uint32_t n = sums->range_count;

    if ((n & (n - 1)) == 0) { /* full at every power of two, and at 0 */
        sums->ranges = realloc(
                sums->ranges, (n == 0 ? 1 : 2 * (size_t)n) * sizeof *range);
        if (sums->ranges == NULL) {
            cli_fail(CLI_IO, "out of memory for %u ranges", (unsigned)n);
        }
    }
    sums->ranges[sums->range_count++] = *range;
}

bool sums_claim(sums_t *sums, const sums_range_t *range, sums_range_t *clash)
{
    for (uint32_t i = 0; i < sums->range_count; i++) {
        const sums_range_t *r = sums->ranges + i;
        if (range->row_first < r->row_end && r->row_first < range->row_end &&
                range->sample_first < r->sample_end &&
                r->sample_first < range->sample_end) {
            *clash = *r;
            return false;
        }
    }
    append_range(sums, range);
    return true;
}

uint32_t sums_row_count(const sums_t *sums, uint32_t y)
{
    uint32_t count = 0; /* ranges do not overlap: at most 2^24 */

    for (uint32_t i = 0; i < sums->range_count; i++) {
        const sums_range_t *r = sums->ranges + i;
        if (r->row_first <= y && y < r->row_end) {
            count += r->sample_end - r->sample_first;
        }
    }
    return count;
}

static int compare_samples(const void *a, const void *b)
{
    const sums_range_t *p = a, *q = b;

    return (p->sample_first > q->sample_first) -
           (p->sample_first < q->sample_first);
}

static int compare_numbers(const void *a, const void *b)
{
    const uint32_t *p = a, *q = b;

    return (*p > *q) - (*p < *q);
}

/* Append to joined the sample ranges of rows [first, end), which every range
 * holds entirely or not at all. sums->ranges are sorted by samples. Returns
 * how many ranges this made. */
static uint32_t join_samples(
        const sums_t *sums, sums_t *joined, uint32_t first, uint32_t end)
{
    uint32_t made = 0;

    for (uint32_t i = 0; i < sums->range_count; i++) {
        sums_range_t r = sums->ranges[i];
        if (r.row_first > first || r.row_end <= first) {
            continue;
        }
        r.row_first = first;
        r.row_end = end;
        if (made > 0 && joined->ranges[joined->range_count - 1].sample_end ==
                                r.sample_first) {
            joined->ranges[joined->range_count - 1].sample_end = r.sample_end;
        } else {
            append_range(joined, &r);
            made++;
        }
    }
    return made;
}

/* If the last made ranges repeat the n before them, which are of the rows right
 * above, grow those instead. Returns how many ranges now describe the lowest
 * rows. */
static uint32_t join_rows(sums_t *joined, uint32_t n, uint32_t made)
{
    sums_range_t *now = joined->ranges + joined->range_count - made;
    sums_range_t *old = now - n;

    if (n != made) {
        return made;
    }
    for (uint32_t i = 0; i < n; i++) {
        if (old[i].sample_first != now[i].sample_first ||
                old[i].sample_end != now[i].sample_end) {
            return made;
        }
    }
    for (uint32_t i = 0; i < n; i++) {
        old[i].row_end = now[i].row_end;
    }
    joined->range_count -= made;
    return n;
}

/* Describe the same samples in the one canonical way: cut the rows wherever a
 * range begins or ends, join samples within each slice, then join slices. */
static void join_ranges(sums_t *sums)
{
    const uint32_t n = 2 * sums->range_count;
    uint32_t *cuts = cli_alloc(n, sizeof *cuts);
    sums_t joined = *sums;
    uint32_t made = 0;

    joined.ranges = NULL;
    joined.range_count = 0;
    for (uint32_t i = 0; i < n; i++) {
        cuts[i] = i % 2 == 0 ? sums->ranges[i / 2].row_first
                             : sums->ranges[i / 2].row_end;
    }
    qsort(cuts, n, sizeof *cuts, compare_numbers);
    if (n > 0) {
        qsort(sums->ranges, sums->range_count, sizeof *sums->ranges,
                compare_samples);
    }
    for (uint32_t i = 0; i + 1 < n; i++) {
        if (cuts[i] < cuts[i + 1]) {
            made = join_rows(&joined, made,
                    join_samples(sums, &joined, cuts[i], cuts[i + 1]));
        }
    }
    free(cuts);
    free(sums->ranges);
    *sums = joined;
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
    while (size > 0) {
        const ssize_t n = pread(file->fd, to, size, (off_t)at);

        if (n == 0 || (n < 0 && errno != EINTR)) {
            cli_fail(CLI_IO, "cannot read a sum file: %s",
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
    for (uint32_t i = 0; i < count; i++, *at += RANGE_BYTES) {
        const uint8_t *b = data + *at;
        const sums_range_t r = {bytes_get_le32(b), bytes_get_le32(b + 4),
                bytes_get_le32(b + 8), bytes_get_le32(b + 12)};
        sums_range_t clash;
        if (r.row_first >= r.row_end || r.row_end > sums->field[SUMS_HEIGHT]) {
            return "expected a range of rows of the picture";
        }
        if (r.sample_first >= r.sample_end || r.sample_end > QL_SPP_MAX) {
            return "expected a range of samples from 0 to 2^24";
        }
        if (!sums_claim(sums, &r, &clash)) {
            return "a range that overlaps another";
        }
    }
    return NULL;
}

static uint64_t row_bytes(const sums_file_t *file)
{
    return (uint64_t)PIXEL_BYTES * file->head.field[SUMS_WIDTH];
}

/* The rows that some range holds are the rest of the file. */
static const char *check_rows(sums_file_t *file, uint64_t at)
{
    uint64_t rows = 0;

    for (uint32_t y = 0; y < file->head.field[SUMS_HEIGHT]; y++) {
        rows += sums_row_count(&file->head, y) != 0;
    }
    file->row = 0;
    file->row_at = at;
    rows *= row_bytes(file); /* < 2^33 */
    return file->size - at < rows   ? "the sums end too early"
           : file->size - at > rows ? "unexpected bytes after the sums"
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

/* Everything but the rows themselves; data, or fd, and size are set. */
static const char *open_file(sums_file_t *file, uint64_t *where)
{
    char magic[4];
    const char *error;
    size_t at = 0;

    *where = 0;
    if (file->size >= sizeof magic) {
        fetch(file, 0, magic, sizeof magic);
    }
    if (file->size < sizeof magic || memcmp(magic, "QLS3", 4) != 0) {
        return "expected a sum file (QLS3)";
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
        error = check_rows(file, at);
    }
    *where = at;
    if (error != NULL) {
        sums_free(&file->head);
    }
    return error;
}

const char *sums_open(sums_file_t *file, int fd, uint64_t size, uint64_t *where)
{
    memset(file, 0, sizeof *file);
    file->fd = fd;
    file->size = size;
    return open_file(file, where);
}

bool sums_row(sums_file_t *file, uint32_t y, ql_sum_t *row)
{
    const uint32_t width = file->head.field[SUMS_WIDTH];
    const uint8_t *bytes = (const uint8_t *)row;

    if (sums_row_count(&file->head, y) == 0) {
        return false;
    }
    while (file->row < y) {
        if (sums_row_count(&file->head, file->row++) != 0) {
            file->row_at += row_bytes(file);
        }
    }
    while (file->row > y) {
        if (sums_row_count(&file->head, --file->row) != 0) {
            file->row_at -= row_bytes(file);
        }
    }
    fetch(file, file->row_at, row, (size_t)row_bytes(file));
    for (size_t i = 0; i < 3 * (size_t)width; i++) { /* in place */
        row[i / 3].rgb[i % 3] = bytes_get_le64(bytes + 8 * i);
    }
    return true;
}

const char *sums_decode(
        sums_t *sums, const uint8_t *data, size_t size, size_t *where)
{
    sums_file_t file;
    const char *error;
    uint64_t at;
    size_t width;

    memset(&file, 0, sizeof file);
    memset(sums, 0, sizeof *sums);
    file.data = data;
    file.size = size;
    error = open_file(&file, &at);
    *where = (size_t)at;
    if (error == NULL) {
        *sums = file.head;
        width = sums->field[SUMS_WIDTH];
        sums->pixels =
                cli_alloc(sums->field[SUMS_HEIGHT], width * sizeof(ql_sum_t));
        for (uint32_t y = 0; y < sums->field[SUMS_HEIGHT]; y++) {
            (void)sums_row(&file, y, sums->pixels + width * y);
        }
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

void sums_write_head(sums_writer_t *to, sums_t *sums, cli_out_t *out)
{
    to->file = out->file;
    to->crc = 0;
    join_ranges(sums);
    put_bytes(to, (const uint8_t *)"QLS3", 4);
    for (unsigned i = 0; i < SUMS_FIELD_COUNT; i++) {
        put_le32(to, sums->field[i]);
    }
    put_le32(to, sums->range_count);
    for (uint32_t i = 0; i < sums->range_count; i++) {
        put_le32(to, sums->ranges[i].row_first);
        put_le32(to, sums->ranges[i].row_end);
        put_le32(to, sums->ranges[i].sample_first);
        put_le32(to, sums->ranges[i].sample_end);
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

void sums_write(sums_t *sums, cli_out_t *out)
{
    const uint32_t width = sums->field[SUMS_WIDTH];
    sums_writer_t to;

    sums_write_head(&to, sums, out);
    for (uint32_t y = 0; y < sums->field[SUMS_HEIGHT]; y++) {
        if (sums_row_count(sums, y) != 0) {
            sums_write_row(&to, sums->pixels + (size_t)width * y, width);
        }
    }
    sums_write_end(&to);
}
