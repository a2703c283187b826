/* png.h - PNG pictures of 8 bits, RGB or gray */
/* SPDX-License-Identifier: MIT */

#ifndef PNG_H
#define PNG_H

#include "lib/image/image.h"

/* Decode a PNG; as image_decode(). */
const char *png_decode(
        image_t *image, const uint8_t *data, size_t size, size_t *where);

/* Write a picture of bytes. */
void png_write(const image_t *image, FILE *file);

#endif
