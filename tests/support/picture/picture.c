/* picture.c - load blobs, write the pictures of a failed claim */
/* SPDX-License-Identifier: MIT */

#include "support/picture/picture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>

const char *picture_built(const char *name)
{
    static char path[256];
    const char *folder = getenv("BUILD");

    (void)snprintf(path, sizeof path, "%s/%s",
            folder != NULL && folder[0] != '\0' ? folder : "build", name);
    return path;
}

void *picture_load(const char *path, size_t *size)
{
    FILE *file = fopen(path, "rb");
    uint8_t *bytes = NULL;
    long length = -1;

    *size = 0;
    if (file == NULL) {
        return NULL;
    }
    if (fseek(file, 0, SEEK_END) == 0) {
        length = ftell(file);
    }
    if (length > 0 && fseek(file, 0, SEEK_SET) == 0) {
        bytes = malloc((size_t)length);
    }
    if (bytes != NULL &&
            fread(bytes, 1, (size_t)length, file) == (size_t)length) {
        *size = (size_t)length;
    } else {
        free(bytes);
        bytes = NULL;
    }
    (void)fclose(file);
    return bytes;
}

double picture_radiance_unit(const ql_scene_t *scene)
{
    return ldexp(1, ql_i16(QL_LE16((uint16_t)scene->header->radiance_exp)));
}

static uint8_t level(double value)
{
    const double v = value > 0 ? pow(value, 1 / 2.2) * 255 + 0.5 : 0;

    return (uint8_t)(v < 255 ? v : 255);
}

/* One pixel of a kind of picture: 0 actual, 1 the difference on mid gray. */
static void put_pixel(FILE *file, int kind, const double *actual,
        const double *wanted, double white)
{
    for (int k = 0; k < 3; k++) {
        const double off = (actual[1] - wanted[1]) / white * 4;
        double value = actual[k] / white;

        if (kind == 1) {
            value = k == 0 ? off : k == 2 ? -off : 0;
        }
        (void)fputc(level(value), file);
    }
}

const char *picture_fail(const char *name, const double *actual,
        const double *wanted, unsigned width, unsigned height)
{
    static const char *const kinds[2] = {"actual", "diff"};
    static char path[512];
    const size_t count = (size_t)width * height;
    double white = 1e-30;

    for (size_t i = 0; i < 3 * count; i++) {
        white += 2 * wanted[i] / (double)(3 * count);
    }
    (void)mkdir(picture_built("fail"), 0777);
    for (int kind = 0; kind < 2; kind++) {
        FILE *file;

        (void)snprintf(path, sizeof path, "%s/%s_%s.ppm", picture_built("fail"),
                name, kinds[kind]);
        file = fopen(path, "wb");
        if (file == NULL) {
            return "(its folder fail/ cannot be written)";
        }
        (void)fprintf(file, "P6\n%u %u\n255\n", width, height);
        for (size_t i = 0; i < count; i++) {
            put_pixel(file, kind, actual + 3 * i, wanted + 3 * i, white);
        }
        (void)fclose(file);
    }
    return path;
}
