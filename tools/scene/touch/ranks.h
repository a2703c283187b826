/* ranks.h - which of the faces in one place counts */
/* SPDX-License-Identifier: MIT */

#ifndef RANKS_H
#define RANKS_H

#include "scene/mesh/bvh.h"
#include "scene/mesh/grid.h"

/* Find the rank of each face: of those that a ray meets at once the lowest is
 * the one it meets, and of equal ones the one whose front it sees. It is the
 * face's place in the file; two faces of the same corners in opposite order
 * have the lower of both.
 *
 *   grid    -  complete
 *   bvh     -  of it
 *   return     in the order of bvh, from malloc(); NULL if no two triangles
 *              overlap in one plane, and no two spheres are equal
 *
 * Exact.
 */
uint16_t *ranks_find(const grid_t *grid, const bvh_t *bvh);

#endif
