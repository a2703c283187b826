/* crossing.h - does an outline cross itself? */
/* SPDX-License-Identifier: MIT */

#ifndef CROSSING_H
#define CROSSING_H

#include "scene/fill/plane.h"

/* Is there a point inside two edges of a closed outline that are not parallel?
 *
 *   points  -  its corners
 *   count   -  of corners
 *
 * Exact. Edges that touch or run along each other do not cross.
 * Cost: n log n, and a comparison for each two edges whose abscissas overlap.
 */
bool crossing_find(const plane_point_t *points, size_t count);

#endif
