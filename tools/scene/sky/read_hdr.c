/* read_hdr.c - Radiance pictures (.hdr) to floats */
/* SPDX-License-Identifier: MIT */

#include "scene/sky/read_hdr.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/program/cli.h"

enum { LINE_MAX = 200, RUNS_MIN = 8, RUNS_MAX = 32767 };

typedef struct {
    const uint8_t *data;
    size_t size;
    size_t at;
} cursor_t;

/* How the header says the pixels lie, and what they are divided by. */
typedef struct {
    double exposure;
    bool upwards;  /* the first row is the lowest */
    bool leftward; /* the first pixel of a row is the rightmost */
} layout_t;

bool read_hdr_is(const uint8_t *data, size_t size)
{
    return size >= 10 && (memcmp(data, "#?RADIANCE", 10) == 0 ||
                                 memcmp(data, "#?RGBE", 6) == 0);
}

/* ---- header ---- */

/* The next line, without its end, cut at LINE_MAX; false if there is none. */
static bool take_line(cursor_t *c, char line[LINE_MAX + 1])
{
    size_t n = 0;

    while (c->at < c->size && c->data[c->at] != '\n') {
        if (n < LINE_MAX) {
            line[n++] = (char)c->data[c->at];
        }
        c->at++;
    }
    if (c->at == c->size) {
        return false;
    }
    c->at++;
    while (n > 0 && line[n - 1] == '\r') {
        n--;
    }
    line[n] = '\0';
    return true;
}

static const char *take_variable(const char *line, layout_t *layout)
{
    if (strncmp(line, "FORMAT=", 7) == 0 &&
            strcmp(line + 7, "32-bit_rle_rgbe") != 0) {
        return "expected FORMAT=32-bit_rle_rgbe";
    }
    if (strncmp(line, "EXPOSURE=", 9) == 0) {
        char *end;
        const double factor = strtod(line + 9, &end);

        if (end == line + 9 || !(factor > 0 && factor < 1e30)) {
            return "expected an EXPOSURE above 0";
        }
        layout->exposure *= factor;
    }
    return NULL;
}

/* A sign, an axis, a blank and a number from 1 to IMAGE_SIDE_MAX. */
static const char *take_axis(
        const char *at, char axis, bool *minus, uint32_t *side)
{
    char *end;
    long n;

    if ((at[0] != '-' && at[0] != '+') || at[1] != axis || at[2] != ' ') {
        return NULL;
    }
    *minus = at[0] == '-';
    n = strtol(at + 3, &end, 10);
    if (end == at + 3 || n < 1 || n > (long)IMAGE_SIDE_MAX) {
        return NULL;
    }
    *side = (uint32_t)n;
    return end;
}

static const char *take_size(const char *line, image_t *image, layout_t *layout)
{
    bool down = false, left = false;
    const char *rest = take_axis(line, 'Y', &down, &image->height);

    if (rest == NULL || rest[0] != ' ' ||
            (rest = take_axis(rest + 1, 'X', &left, &image->width)) == NULL ||
            rest[0] != '\0') {
        return "expected -Y HEIGHT +X WIDTH";
    }
    layout->upwards = !down;
    layout->leftward = left;
    return image->height > IMAGE_PIXELS_MAX / image->width
                   ? "expected at most 2^28 pixels"
                   : NULL;
}

static const char *take_header(cursor_t *c, image_t *image, layout_t *layout)
{
    char line[LINE_MAX + 1];
    const char *error = NULL;
    size_t from = 0;

    do {
        from = c->at;
        if (!take_line(c, line)) {
            return "expected an empty line after the header";
        }
        error = line[0] == '#' ? NULL : take_variable(line, layout);
    } while (error == NULL && line[0] != '\0');
    if (error == NULL) {
        from = c->at;
        error = take_line(c, line) ? take_size(line, image, layout)
                                   : "expected -Y HEIGHT +X WIDTH";
    }
    c->at = error != NULL ? from : c->at;
    return error;
}

/* ---- rows ---- */

static const char cut[] = "the pixels end too early";

/* Each channel apart: a run of n - 128 equal bytes, or n that differ. */
static const char *take_runs(cursor_t *c, uint8_t *row, uint32_t width)
{
    for (unsigned k = 0; k < 4; k++) {
        uint32_t x = 0;

        while (x < width) {
            uint32_t n;
            bool run;

            if (c->size - c->at < 2) {
                return cut;
            }
            n = c->data[c->at];
            run = n > 128;
            n = run ? n - 128 : n;
            if (n == 0 || n > width - x) {
                return "expected a run that ends within its row";
            }
            c->at++;
            if (!run && c->size - c->at < n) {
                return cut;
            }
            for (uint32_t i = 0; i < n; i++) {
                row[4 * x++ + k] = c->data[c->at + (run ? 0 : i)];
            }
            c->at += run ? 1 : n;
        }
    }
    return NULL;
}

/* Pixel after pixel; 1, 1, 1, n repeats the one before n times, and each one
 * that follows directly counts 256 times as much as the last. */
static const char *take_flat(cursor_t *c, uint8_t *row, uint32_t width)
{
    unsigned shift = 0;
    uint32_t x = 0;

    while (x < width) {
        const uint8_t *p = c->data + c->at;

        if (c->size - c->at < 4) {
            return cut;
        }
        if (p[0] == 1 && p[1] == 1 && p[2] == 1) {
            const uint32_t n = shift < 16 ? (uint32_t)p[3] << shift : 0;

            if (x == 0 || n > width - x || shift >= 16) {
                return "expected a repetition that ends within its row";
            }
            for (uint32_t i = 0; i < n; i++, x++) {
                memcpy(row + 4 * x, row + 4 * (x - 1), 4);
            }
            shift += 8;
        } else {
            memcpy(row + 4 * x++, p, 4);
            shift = 0;
        }
        c->at += 4;
    }
    return NULL;
}

static const char *take_row(cursor_t *c, uint8_t *row, uint32_t width)
{
    const uint8_t *p = c->data + c->at;

    if (c->size - c->at < 4) {
        return cut;
    }
    if (width < RUNS_MIN || width > RUNS_MAX || p[0] != 2 || p[1] != 2 ||
            p[2] > 127) {
        return take_flat(c, row, width);
    }
    if (((uint32_t)p[2] << 8 | p[3]) != width) {
        return "expected a row of the picture's width";
    }
    c->at += 4;
    return take_runs(c, row, width);
}

static void widen_row(
        float *to, const uint8_t *row, uint32_t width, const layout_t *layout)
{
    for (uint32_t x = 0; x < width; x++) {
        const uint8_t *p = row + 4 * (layout->leftward ? width - 1 - x : x);

        for (unsigned k = 0; k < 3; k++) {
            const double m = ldexp(p[k], p[3] - 136) / layout->exposure;

            /* what is beyond a float is beyond a sky too */
            to[3 * x + k] = p[3] == 0 ? 0 : (float)fmin(m, 1e38);
        }
    }
}

const char *read_hdr(
        image_t *image, const uint8_t *data, size_t size, size_t *where)
{
    cursor_t c = {data, size, 0};
    layout_t layout = {1, false, false};
    const char *error;
    uint8_t *row;

    memset(image, 0, sizeof *image);
    error = take_header(&c, image, &layout);
    /* a row has four bytes at least */
    if (error == NULL && (c.size - c.at) / 4 < image->height) {
        error = cut;
    }
    if (error == NULL) {
        image_new_floats(image, image->width, image->height);
        row = cli_alloc(image->width, 4);
        for (uint32_t y = 0; y < image->height && error == NULL; y++) {
            const size_t to = layout.upwards ? image->height - 1 - y : y;

            error = take_row(&c, row, image->width);
            widen_row(image->floats + 3 * to * image->width, row, image->width,
                    &layout);
        }
        free(row);
    }
    if (error == NULL && c.at != size) {
        error = "unexpected bytes after the pixels";
    }
    *where = c.at;
    return error;
}
