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

/* Write what stands before the rows: of magic "P6", whose rows are bytes from
 * the top, or "PF", whose rows are little-endian floats from the lowest. */
void pnm_write_head(
        const char *magic, uint32_t width, uint32_t height, FILE *file);

/* Write a row of width pixels. */
void pnm_write_bytes(const uint8_t *row, uint32_t width, FILE *file);
void pnm_write_floats(const float *row, uint32_t width, FILE *file);

#endif
