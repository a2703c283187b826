/* sides.h - does one see fronts or backs of a mesh from a direction? */
/* SPDX-License-Identifier: MIT */

#ifndef SIDES_H
#define SIDES_H

#include <stdint.h>

#include "scene/world/world.h"

/* Places of a picture of SIDES_RASTER by SIDES_RASTER. */
#define SIDES_RASTER 64

typedef struct {
    unsigned fronts, backs;
} sides_t;

/* Look at all faces from far away, with parallel rays.
 *
 *   world      -  vertices and faces; y is up
 *   direction  -  towards the eye; each below 16 in size, x or z is not 0
 *   return     where a front is nearest, where a back is
 *
 * In integers: vertices are rounded to 2^-14 of the longest side.
 */
sides_t sides_see(const world_t *world, const int direction[3]);

#endif
