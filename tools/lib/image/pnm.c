/* pnm.c - PPM pictures of bytes, PFM pictures of floats */
/* SPDX-License-Identifier: MIT */

#include "lib/image/pnm.h"

#include <stdlib.h>
#include <string.h>

#include "lib/program/bytes.h"
#include "lib/program/cli.h"

/* Where a header is being read. */
typedef struct {
    const uint8_t *data;
    size_t size;
    size_t at;
} cursor_t;

static bool is_space(uint8_t c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

/* Skip white space and comments, at least one byte. */
static bool skip_space(cursor_t *c)
{
    const size_t from = c->at;

    while (c->at < c->size &&
            (is_space(c->data[c->at]) || c->data[c->at] == '#')) {
        if (c->data[c->at] == '#') {
            while (c->at < c->size && c->data[c->at] != '\n' &&
                    c->data[c->at] != '\r') {
                c->at++;
            }
        } else {
            c->at++;
        }
    }
    return c->at > from;
}

/* A number in [1, max] after white space; 0 if there is none, with the cursor
 * where it should begin. */
static uint32_t take_size(cursor_t *c, uint32_t max)
{
    size_t at;
    uint32_t n = 0;

    if (!skip_space(c)) {
        return 0;
    }
    for (at = c->at; at < c->size; at++) {
        if (c->data[at] < '0' || c->data[at] > '9') {
            break;
        }
        n = n * 10 + (uint32_t)(c->data[at] - '0'); /* max < 2^16: < 2^20 */
        if (n > max) {
            return 0;
        }
    }
    if (n != 0) {
        c->at = at;
    }
    return n;
}

/* Width and height. */
static const char *take_sizes(cursor_t *c, image_t *image)
{
    image->width = take_size(c, IMAGE_SIDE_MAX);
    if (image->width == 0) {
        return "expected a width from 1 to 65535";
    }
    image->height = take_size(c, IMAGE_SIDE_MAX);
    if (image->height == 0) {
        return "expected a height from 1 to 65535";
    }
    if (image->height > IMAGE_PIXELS_MAX / image->width) {
        return "expected at most 2^28 pixels";
    }
    return NULL;
}

/* Exactly n bytes shall be left. A few files end in a stray newline. */
static const char *check_rest(const cursor_t *c, uint64_t n)
{
    const size_t left = c->size - c->at;

    if (left < n) {
        return "the pixels end too early";
    }
    if (left > n + 1 || (left == n + 1 && c->data[c->size - 1] != '\n')) {
        return "unexpected bytes after the pixels";
    }
    return NULL;
}

static const char *decode_ppm(image_t *image, cursor_t *c)
{
    const char *error = take_sizes(c, image);
    size_t n;

    if (error != NULL) {
        return error;
    }
    if (take_size(c, 255) != 255) {
        return "expected a maximum of 255";
    }
    if (c->at == c->size || !is_space(c->data[c->at])) {
        return "expected one white space";
    }
    c->at++;
    n = (size_t)3 * image->width * image->height; /* < 2^30 */
    error = check_rest(c, n);
    if (error == NULL) {
        image_new_bytes(image, image->width, image->height);
        memcpy(image->bytes, c->data + c->at, n);
    }
    return error;
}

/* The scale of a PFM: its sign is the byte order, its size means nothing. */
static const char *take_scale(cursor_t *c, bool *little)
{
    size_t digits = 0;

    if (!skip_space(c)) {
        return "expected a scale such as -1.0";
    }
    *little = c->at < c->size && c->data[c->at] == '-';
    for (size_t at = c->at + *little; at < c->size; at++) {
        const uint8_t b = c->data[at];
        if (is_space(b) && digits > 0) {
            c->at = at + 1;
            return NULL;
        }
        if (b == '\0' || strchr("0123456789.eE+-", b) == NULL) {
            break;
        }
        digits++;
    }
    return "expected a scale such as -1.0";
}

static float take_float(const uint8_t *b, bool little)
{
    const uint32_t bits = little ? bytes_get_le32(b) : bytes_get_be32(b);
    float value;

    memcpy(&value, &bits, sizeof value);
    return value;
}

static const char *decode_pfm(image_t *image, cursor_t *c, unsigned channels)
{
    const char *error = take_sizes(c, image);
    const size_t width = image->width;
    bool little = false;

    if (error == NULL) {
        error = take_scale(c, &little);
    }
    if (error == NULL) {
        error = check_rest(c, (uint64_t)4 * channels * width * image->height);
    }
    if (error != NULL) {
        return error;
    }
    image_new_floats(image, image->width, image->height);
    for (size_t y = 0; y < image->height; y++) { /* the file goes upwards */
        const uint8_t *from = c->data + c->at + 4 * channels * width * y;
        float *to = image->floats + 3 * width * (image->height - 1 - y);
        for (size_t i = 0; i < 3 * width; i++) {
            to[i] = take_float(from + 4 * (channels == 3 ? i : i / 3), little);
        }
    }
    return NULL;
}

const char *pnm_decode(
        image_t *image, const uint8_t *data, size_t size, size_t *where)
{
    cursor_t c = {data, size, 2};
    const char *error;

    if (memcmp(data, "P6", 2) == 0) {
        error = decode_ppm(image, &c);
    } else {
        error = decode_pfm(image, &c, data[1] == 'F' ? 3 : 1);
    }
    *where = c.at;
    return error;
}

void pnm_write_head(
        const char *magic, uint32_t width, uint32_t height, FILE *file)
{
    fprintf(file, "%s\n%u %u\n%s\n", magic, (unsigned)width, (unsigned)height,
            magic[1] == '6' ? "255" : "-1.0");
}

void pnm_write_bytes(const uint8_t *row, uint32_t width, FILE *file)
{
    fwrite(row, 3, width, file);
}

void pnm_write_floats(const float *row, uint32_t width, FILE *file)
{
    uint8_t pixel[12];
    uint32_t bits;

    for (uint32_t x = 0; x < width; x++) {
        for (unsigned k = 0; k < 3; k++) {
            memcpy(&bits, row++, sizeof bits);
            bytes_put_le32(pixel + 4 * k, bits);
        }
        fwrite(pixel, 1, sizeof pixel, file);
    }
}
