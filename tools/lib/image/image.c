/* image.c - a picture in memory: bytes of a display, or floats of light */
/* SPDX-License-Identifier: MIT */

#include "lib/image/image.h"

#include <stdlib.h>
#include <string.h>

#include "lib/program/cli.h"

void image_new(image_t *image, uint32_t width, uint32_t height, bool floats)
{
    const size_t row = 3 * (size_t)width;

    image->width = width;
    image->height = height;
    image->bytes = floats ? NULL : cli_alloc(height, row);
    image->floats = floats ? cli_alloc(height, row * sizeof(float)) : NULL;
}

void image_free(image_t *image)
{
    free(image->bytes);
    free(image->floats);
    memset(image, 0, sizeof *image);
}
