/* gain.h - what a lamp lost of its area on the grid, and gets back */
/* SPDX-License-Identifier: MIT */

#ifndef GAIN_H
#define GAIN_H

#include "lib/math/soft.h"
#include "scene/mesh/grid.h"
#include "scene/world/world.h"

#define GAIN_NONE 0u /* emits as written; else see gain_value() */

/* Set the gain of every face and sphere that emits: its area as written over
 * that on the grid, so that emission times area is what was written. The grid
 * moves a corner by up to half a unit, which is much of a small lamp. The faces
 * of a lamp that are left shine for those that are not: lamp_parts_find().
 *
 *   grid   -  in, out; its lost_count is set
 *   world  -  the scene
 *   return    the largest gain over 1, or 1 over the smallest, of all; 1 if
 *             there are none
 *
 * Error: 2^-9 of the power of a lamp; gains are from 2^-16 to 16, and 1 is what
 * is within 2^-9 of it.
 */
soft_t gain_faces(grid_t *grid, const world_t *world);

/* The factor that a gain stands for. */
soft_t gain_value(uint32_t gain);

#endif
