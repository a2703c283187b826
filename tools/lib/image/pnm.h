/* pnm.h - PPM pictures of bytes, PFM pictures of floats */
/* SPDX-License-Identifier: MIT */

#ifndef PNM_H
#define PNM_H

#include <stddef.h>
#include <stdio.h>

#include "lib/image/image.h"

/* Decode a PPM (P6 of maximum 255) or a PFM (PF or Pf, both byte orders; the
 * size of the scale is ignored). One newline after the pixels is allowed.
 *
 *   image   -      out: what there is of it is to be freed, even after an error
 *   data    -      size bytes that begin with P6, PF or Pf
 *   size    bytes  2 or more
 *   where   bytes  out: offset of what is wrong
 *   return  NULL, or what was expected there
 */
const char *pnm_decode(
        image_t *image, const uint8_t *data, size_t size, size_t *where);

/* Write a picture of bytes. */
void pnm_write_ppm(const image_t *image, FILE *file);

/* Write a picture of floats, little-endian. */
void pnm_write_pfm(const image_t *image, FILE *file);

/* The same piece by piece: what stands before the rows, and a row of width
 * pixels. A PFM begins with the lowest row. */
void pnm_write_head(const char *magic, const image_t *size, FILE *file);
void pnm_write_row(const image_t *line, FILE *file);

#endif
