/* lamp_parts.h - faces that shine together, and what the grid left of them */
/* SPDX-License-Identifier: MIT */

#ifndef LAMP_PARTS_H
#define LAMP_PARTS_H

#include "lib/math/soft.h"
#include "scene/world/world.h"

/* Find how much brighter the faces that are left of a lamp have to shine for
 * those that the grid dropped. A lamp is all faces of an emitting material that
 * hang together by vertices in one place; a face that repeats the corners of
 * another in its order is none.
 *
 *   world   -  the scene
 *   kept    -  of each face: is it on the grid?
 *   lost    -  out: lamps of which nothing is left
 *   return     for each face the area of its lamp as written over that of the
 *              lamp's kept faces; 1 if it does not emit or none is kept; free()
 *              it
 *
 * Cost: n log n.
 */
soft_t *lamp_parts_find(const world_t *world, const bool *kept, size_t *lost);

#endif
