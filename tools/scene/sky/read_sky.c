/* read_sky.c - maps of the sky from PFM and Radiance files */
/* SPDX-License-Identifier: MIT */

#include "scene/sky/read_sky.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/files/kind.h"
#include "lib/image/image_file.h"
#include "lib/program/cli.h"
#include "scene/sky/read_hdr.h"

#define SIDE_MAX 4096
/* How far below 0 a texel may be, as a part of the brightest: filters that
 * resample a map overshoot beside bright spots. */
#define UNDERSHOOT_MAX 1e-3

static void refuse(const image_t *image, const char *path, size_t i)
{
    cli_fail(CLI_INPUT,
            "%s: pixel %zu of row %zu from the top: expected a "
            "radiance from 0 to %g, found %g",
            path, i / 3 % image->width, i / 3 / image->width, SKY_RADIANCE_MAX,
            (double)image->floats[i]);
}

/* Largest radiance; every one is checked but for its sign. */
static double find_most(const image_t *image, const char *path)
{
    const size_t n = 3 * (size_t)image->width * image->height;
    double most = 0;

    for (size_t i = 0; i < n; i++) {
        const double x = (double)image->floats[i];

        if (!(x <= SKY_RADIANCE_MAX)) { /* so that a NaN fails too */
            refuse(image, path, i);
        }
        most = fmax(most, x);
    }
    return most;
}

static void check_radiance(image_t *image, const char *path)
{
    const size_t n = 3 * (size_t)image->width * image->height;
    const double most = find_most(image, path);
    size_t cut = 0;

    for (size_t i = 0; i < n; i++) {
        const double x = (double)image->floats[i];

        if (x < -UNDERSHOOT_MAX * most) {
            refuse(image, path, i);
        }
        cut += x < 0;
        image->floats[i] = x < 0 ? 0 : image->floats[i];
    }
    if (most == 0) {
        cli_fail(CLI_INPUT, "%s: expected a radiance above 0 somewhere", path);
    }
    if (cut > 0) {
        cli_warn("%s: %zu channels a little below 0 are 0", path, cut);
    }
}

/* Decode the bytes of either format, floats only. */
static const char *decode(
        image_t *image, const uint8_t *data, size_t size, size_t *where)
{
    *where = 0;
    if (read_hdr_is(data, size)) {
        return read_hdr(image, data, size, where);
    }
    if (size >= 2 && data[0] == 'P' && (data[1] == 'F' || data[1] == 'f')) {
        return image_decode(image, data, size, where);
    }
    return "expected a PFM file (PF or Pf) or a Radiance picture (#?RADIANCE)";
}

static void flip(image_t *image)
{
    const size_t width = 3 * (size_t)image->width;
    float *row = cli_alloc(width, sizeof *row);

    for (size_t y = 0; y < image->height / 2; y++) {
        float *a = image->floats + y * width;
        float *b = image->floats + (image->height - 1 - y) * width;

        memcpy(row, a, width * sizeof *row);
        memcpy(a, b, width * sizeof *row);
        memcpy(b, row, width * sizeof *row);
    }
    free(row);
}

void read_sky(world_sky_t *sky, const char *path, sky_rows_t rows)
{
    size_t size, where;
    uint8_t *data = cli_read(path, &size);
    image_t image = {0, 0, NULL, NULL};
    const char *error = decode(&image, data, size, &where);

    if (error != NULL) {
        kind_refuse(path, data, size, KIND_SKY);
        cli_fail(CLI_INPUT, "%s: byte %zu: %s", path, where, error);
    }
    free(data);
    if (image.width > SIDE_MAX || image.height > SIDE_MAX) {
        cli_fail(CLI_INPUT,
                "%s: expected at most %d by %d pixels, found %lu "
                "by %lu",
                path, SIDE_MAX, SIDE_MAX, (unsigned long)image.width,
                (unsigned long)image.height);
    }
    check_radiance(&image, path);
    if (rows == SKY_FLIPPED) {
        flip(&image);
    }
    sky->width = image.width;
    sky->height = image.height;
    sky->map = image.floats;
}
