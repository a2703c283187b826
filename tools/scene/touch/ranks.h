/* ranks.h - which of the faces in one place counts */
/* SPDX-License-Identifier: MIT */

#ifndef RANKS_H
#define RANKS_H

#include "scene/mesh/bvh.h"
#include "scene/mesh/grid.h"

/* Find the rank of each face, its place in the file: of those that a ray meets
 * at once it meets the lowest of which it sees the front, or else the lowest.
 *
 *   grid    -  complete
 *   bvh     -  of it
 *   return     in the order of bvh, from malloc(); NULL if no two triangles
 *              overlap in one plane, and no two spheres are equal
 *
 * Exact.
 */
uint16_t *ranks_find(const grid_t *grid, const bvh_t *bvh);

/* Do two triangles of one plane have an area in common? */
bool ranks_do_overlap(
        const grid_t *grid, const grid_face_t *a, const grid_face_t *b);

#endif
