/* png.h - PNG pictures of 8 bits, RGB or gray */
/* SPDX-License-Identifier: MIT */

#ifndef PNG_H
#define PNG_H

#include <stddef.h>
#include <stdio.h>

#include "lib/image/image.h"

/* Decode a PNG of 8 bits, RGB or gray, not interlaced.
 *
 *   image   -      out: what there is of it is to be freed, even after an error
 *   data    -      size bytes; any content is safe
 *   where   bytes  out: offset of what is wrong
 *   return  NULL, or what was expected there
 */
const char *png_decode(
        image_t *image, const uint8_t *data, size_t size, size_t *where);

/* Write a picture of bytes. */
void png_write(const image_t *image, FILE *file);

#endif
