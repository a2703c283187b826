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

/* A PNG being written, RGB of 8 bits, a row at a time: its memory is that of
 * two rows and a deflate_t. */
typedef struct png_writer png_writer_t;

png_writer_t *png_begin(uint32_t width, uint32_t height, FILE *file);

/* The next row, from the top: 3 * width bytes, behind its best filter. */
void png_row(png_writer_t *png, const uint8_t *row);

/* After height rows: write what is left, and free it. */
void png_end(png_writer_t *png);

#endif
