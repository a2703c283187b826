/* png.c - PNG pictures of 8 bits, RGB or gray (ISO/IEC 15948) */
/* SPDX-License-Identifier: MIT */

#include "lib/image/png.h"

#include <stdlib.h>
#include <string.h>

#include "base/ql_crc.h"
#include "lib/image/deflate.h"
#include "lib/program/bytes.h"
#include "lib/program/cli.h"

static const uint8_t signature[8] = {
        0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

enum { FILTER_NONE, FILTER_SUB, FILTER_UP, FILTER_AVERAGE, FILTER_PAETH };

/* No zlib stream expands by more than about 1032; a header that promises a
 * larger picture than its data can hold is refused before memory is taken. */
#define EXPAND_MAX 1040u

/* What a filter predicts from the byte to the left, above, and above left. */
static int predict(unsigned filter, int left, int up, int corner)
{
    const int p = left + up - corner;
    const int a = abs(p - left), b = abs(p - up), c = abs(p - corner);

    switch (filter) {
    case FILTER_SUB:
        return left;
    case FILTER_UP:
        return up;
    case FILTER_AVERAGE:
        return (left + up) / 2;
    case FILTER_PAETH:
        return a <= b && a <= c ? left : b <= c ? up : corner;
    default:
        return 0;
    }
}

/* row[i] +- prediction, with the neighbours taken from plain pixels. */
static uint8_t filter_byte(unsigned filter, const uint8_t *row,
        const uint8_t *above, size_t i, unsigned channels)
{
    const int left = i >= channels ? row[i - channels] : 0;
    const int up = above != NULL ? above[i] : 0;
    const int corner = above != NULL && i >= channels ? above[i - channels] : 0;

    return (uint8_t)predict(filter, left, up, corner);
}

/* ---- Read -------------------------------------------------------------- */

/* What the chunks hold. */
typedef struct {
    uint32_t width;
    uint32_t height;
    unsigned channels;
    uint8_t *packed; /* the IDAT chunks, joined */
    size_t packed_size;
} png_t;

static const char *take_header(png_t *png, const uint8_t *b, size_t size)
{
    if (size != 13 || png->width != 0) {
        return "expected one IHDR chunk of 13 bytes";
    }
    png->width = bytes_get_be32(b);
    png->height = bytes_get_be32(b + 4);
    if (png->width == 0 || png->width > IMAGE_SIDE_MAX || png->height == 0 ||
            png->height > IMAGE_SIDE_MAX ||
            png->height > IMAGE_PIXELS_MAX / png->width) {
        return "expected sides from 1 to 65535 and at most 2^28 pixels";
    }
    if (b[8] != 8 || (b[9] != 0 && b[9] != 2)) {
        return "expected 8 bits a channel, RGB or gray, no alpha or palette";
    }
    if (b[10] != 0 || b[11] != 0 || b[12] != 0) {
        return "expected no interlacing";
    }
    png->channels = b[9] == 2 ? 3 : 1;
    return NULL;
}

/* Walk the chunks from *at on; packed has room for all of them. */
static const char *take_chunks(
        png_t *png, const uint8_t *data, size_t size, size_t *at)
{
    for (;;) {
        const uint8_t *chunk = data + *at;
        const char *error = NULL;
        uint32_t n;
        if (size - *at < 12) {
            return "the file ends before its IEND chunk";
        }
        n = bytes_get_be32(chunk);
        if (n > size - *at - 12) {
            return "a chunk longer than the file";
        }
        if (bytes_get_be32(chunk + 8 + n) != ql_crc32(0, chunk + 4, n + 4u)) {
            return "the chunk's CRC-32 does not match";
        }
        if (memcmp(chunk + 4, "IHDR", 4) == 0) {
            error = take_header(png, chunk + 8, n);
        } else if (png->width == 0) {
            error = "expected an IHDR chunk first";
        } else if (memcmp(chunk + 4, "IDAT", 4) == 0) {
            memcpy(png->packed + png->packed_size, chunk + 8, n);
            png->packed_size += n;
        } else if (memcmp(chunk + 4, "IEND", 4) == 0) {
            return NULL;
        } else if ((chunk[4] & 0x20) == 0) {
            error = "a critical chunk of no known kind";
        }
        if (error != NULL) {
            return error;
        }
        *at += n + 12u;
    }
}

/* Undo the filters in place, then spread gray over RGB. */
static const char *unfilter(const png_t *png, uint8_t *lines, uint8_t *pixels)
{
    const size_t n = (size_t)png->width * png->channels;
    const unsigned repeat = 3 / png->channels;

    for (size_t y = 0; y < png->height; y++) {
        uint8_t *row = lines + (n + 1) * y + 1;
        const uint8_t *above = y > 0 ? row - (n + 1) : NULL;
        if (row[-1] > FILTER_PAETH) {
            return "a row filter of no known kind";
        }
        for (size_t i = 0; i < n; i++) {
            row[i] = (uint8_t)(row[i] + filter_byte(row[-1], row, above, i,
                                                png->channels));
        }
        for (size_t i = 0; i < n * repeat; i++) {
            *pixels++ = row[i / repeat];
        }
    }
    return NULL;
}

static const char *expand(const png_t *png, image_t *image)
{
    const size_t size = png->height * ((size_t)png->width * png->channels + 1);
    const char *error;
    uint8_t *lines;
    size_t where;

    if (size / EXPAND_MAX > png->packed_size) {
        return "the compressed data are too short for the picture";
    }
    lines = cli_alloc(size, 1);
    error = deflate_unpack(png->packed, png->packed_size, lines, size, &where);
    if (error == NULL) {
        image_new_bytes(image, png->width, png->height);
        error = unfilter(png, lines, image->bytes);
    }
    free(lines);
    return error;
}

const char *png_decode(
        image_t *image, const uint8_t *data, size_t size, size_t *where)
{
    png_t png = {0};
    const char *error;

    *where = 0;
    if (size < sizeof signature ||
            memcmp(data, signature, sizeof signature) != 0) {
        return "expected the PNG signature";
    }
    *where = sizeof signature;
    png.packed = cli_alloc(size, 1);
    error = take_chunks(&png, data, size, where);
    if (error == NULL) {
        error = expand(&png, image);
    }
    free(png.packed);
    return error;
}

/* ---- Write ------------------------------------------------------------- */

static void put_chunk(
        FILE *file, const char *kind, const uint8_t *data, size_t size)
{
    uint8_t word[8];

    bytes_put_be32(word, (uint32_t)size); /* a block has < 2^17 bytes */
    memcpy(word + 4, kind, 4);
    fwrite(word, 1, 8, file);
    fwrite(data, 1, size, file);
    bytes_put_be32(word, ql_crc32(ql_crc32(0, kind, 4), data, size));
    fwrite(word, 1, 4, file);
}

/* Filter a row and tell how far its bytes are from zero: the sum of absolute
 * differences that the PNG specification recommends to choose by. */
static uint64_t filter_row(unsigned filter, const uint8_t *row,
        const uint8_t *above, size_t n, uint8_t *out)
{
    uint64_t sum = 0;

    out[0] = (uint8_t)filter;
    for (size_t i = 0; i < n; i++) {
        const uint8_t d =
                (uint8_t)(row[i] - filter_byte(filter, row, above, i, 3));
        out[i + 1] = d;
        sum += d < 128 ? d : 256u - d;
    }
    return sum;
}

struct png_writer {
    FILE *file;
    deflate_t *packed;
    size_t row_bytes;
    uint8_t *above; /* the last row, NULL before the first */
    uint8_t *line;  /* filtered, behind its filter */
};

static void put_packed(void *to, const uint8_t *bytes, size_t size)
{
    put_chunk(to, "IDAT", bytes, size);
}

png_writer_t *png_begin(uint32_t width, uint32_t height, FILE *file)
{
    uint8_t header[13] = {0, 0, 0, 0, 0, 0, 0, 0, 8, 2, 0, 0, 0};
    png_writer_t *png = cli_alloc(1, sizeof *png);

    bytes_put_be32(header, width);
    bytes_put_be32(header + 4, height);
    fwrite(signature, 1, sizeof signature, file);
    put_chunk(file, "IHDR", header, sizeof header);
    put_chunk(file, "sRGB", (const uint8_t *)"\0", 1);
    png->file = file;
    png->packed = deflate_begin(put_packed, file);
    png->row_bytes = 3 * (size_t)width;
    png->line = cli_alloc(png->row_bytes + 1, 1);
    return png;
}

void png_row(png_writer_t *png, const uint8_t *row)
{
    const size_t n = png->row_bytes;
    unsigned best = FILTER_NONE;
    uint64_t least = UINT64_MAX;

    for (unsigned f = FILTER_NONE; f <= FILTER_PAETH; f++) {
        const uint64_t sum = filter_row(f, row, png->above, n, png->line);

        if (sum < least) {
            least = sum;
            best = f;
        }
    }
    filter_row(best, row, png->above, n, png->line);
    deflate_put(png->packed, png->line, n + 1);
    if (png->above == NULL) {
        png->above = cli_alloc(n, 1);
    }
    memcpy(png->above, row, n);
}

void png_end(png_writer_t *png)
{
    deflate_end(png->packed);
    put_chunk(png->file, "IEND", png->line, 0);
    free(png->above);
    free(png->line);
    free(png);
}
