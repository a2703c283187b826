/* read_hdr.h - Radiance pictures (.hdr) to floats */
/* SPDX-License-Identifier: MIT */

#ifndef READ_HDR_H
#define READ_HDR_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "lib/image/image.h"

/* Do these bytes begin as a Radiance picture does? */
bool read_hdr_is(const uint8_t *data, size_t size);

/* Decode a Radiance picture: flat, or with runs of either kind.
 *
 *   image   -      out: floats, rows from the top, radiance; what there is of
 *                  it is to be freed, even after an error
 *   data    -      size bytes, any content is safe
 *   size    bytes  as read_hdr_is() wants
 *   where   bytes  out: offset of what is wrong
 *   return  NULL, or what was expected there
 *
 * A channel is m 2^(e - 136) over the product of all EXPOSURE lines. Only
 * 32-bit_rle_rgbe is read, rows from the top or from the bottom, pixels from
 * the left or from the right.
 * From: Ward, Real Pixels (Graphics Gems II, 1991), and the file format of the
 * Radiance manual.
 */
const char *read_hdr(
        image_t *image, const uint8_t *data, size_t size, size_t *where);

#endif
