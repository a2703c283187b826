/* image.c - a picture in memory: bytes of a display, or floats of light */
/* SPDX-License-Identifier: MIT */

#include "lib/image/image.h"

#include <stdlib.h>
#include <string.h>

#include "lib/program/cli.h"

void image_new_bytes(image_t *image, uint32_t width, uint32_t height)
{
    image->width = width;
    image->height = height;
    image->bytes = cli_alloc(height, 3 * (size_t)width);
    image->floats = NULL;
}

void image_new_floats(image_t *image, uint32_t width, uint32_t height)
{
    image->width = width;
    image->height = height;
    image->bytes = NULL;
    image->floats = cli_alloc(height, 3 * (size_t)width * sizeof(float));
}

void image_free(image_t *image)
{
    free(image->bytes);
    free(image->floats);
    memset(image, 0, sizeof *image);
}
