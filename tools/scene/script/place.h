/* place.h - surfaces scaled, turned and moved to where a scene has them */
/* SPDX-License-Identifier: MIT */

#ifndef PLACE_H
#define PLACE_H

#include "scene/world/world.h"

#define PLACE_DEGREES_MOST 1e6

/* First scaled along each axis, then turned about x, about y, about z, all of
 * them axes of the scene, then moved. */
typedef struct {
    double scale[3]; /* none is 0; below 0 it mirrors */
    double turn[3]; /* degrees, counter-clockwise for who looks down the axis */
    double at[3];
} place_t;

/* What leaves everything as it is. */
#define PLACE_NOWHERE                                                          \
    {                                                                          \
        {1, 1, 1}, {0, 0, 0},                                                  \
        {                                                                      \
            0, 0, 0                                                            \
        }                                                                      \
    }

/* How much there is of a world: what comes later begins here. */
typedef struct {
    size_t vertex, normal, face;
} place_mark_t;

place_mark_t place_mark(const world_t *world);

/* Place what a world has from a mark to another. Fronts stay fronts if it is
 * mirrored; normals become unit vectors. The same bits on every host: reals are
 * soft, and multiples of 90 degrees are exact.
 *
 *   world   -  in, out
 *   place   -  where
 *   from    -  the first of what is placed
 *   to      -  the first of what is not
 *   return  false if a coordinate is beyond 1e300 then
 */
bool place_part(world_t *world, const place_t *place, place_mark_t from,
        place_mark_t to);

#endif
