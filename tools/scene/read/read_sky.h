/* read_sky.h - maps of the sky from PFM files */
/* SPDX-License-Identifier: MIT */

#ifndef READ_SKY_H
#define READ_SKY_H

#include "scene/world/world.h"

#define SKY_RADIANCE_MAX 1e18 /* as of a Ke */

/* Read the map of a sky.
 *
 *   sky   -  in, out
 *   path  -  of the PFM file
 *
 * Fails: exit 2 with the byte or the pixel of what is wrong: not a PFM, larger
 *        than 4096 by 4096, a radiance that is negative, above 1e18 or not a
 *        number, or none above 0; exit 3 if it cannot be read.
 */
void read_sky(world_sky_t *sky, const char *path);

#endif
