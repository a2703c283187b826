/* read_sky.h - maps of the sky from PFM and Radiance files */
/* SPDX-License-Identifier: MIT */

#ifndef READ_SKY_H
#define READ_SKY_H

#include "scene/world/world.h"

#define SKY_RADIANCE_MAX 1e18 /* as of a Ke */

/* Is the file's first row the highest, as its format says, or the lowest? */
typedef enum { SKY_AS_WRITTEN, SKY_FLIPPED } sky_rows_t;

/* Read the map of a sky.
 *
 *   sky   -  in, out
 *   path  -  of a PFM or Radiance file
 *   rows  -  SKY_FLIPPED turns the map upside down
 *
 * A radiance below 0 by a thousandth of the brightest or less is 0, and counted
 * on standard error.
 *
 * Fails: exit 2 with the byte or the pixel of what is wrong: neither format,
 *        larger than 4096 by 4096, a radiance that is lower, above 1e18 or no
 *        number, or none above 0; exit 3 if it cannot be read.
 */
void read_sky(world_sky_t *sky, const char *path, sky_rows_t rows);

#endif
