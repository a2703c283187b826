/* plane.h - the corners of a face as integers, seen along its normal */
/* SPDX-License-Identifier: MIT */

#ifndef PLANE_H
#define PLANE_H

#include "scene/world/world.h"

typedef struct {
    int64_t x, y; /* at most 2^61 in size */
} plane_point_t;

/* Look at the corners of a face along its normal, as Newell found it: the sum
 * of the cross products of its edges. If they add up to nothing, because the
 * outline encloses as much backwards as forwards, the largest one has to do.
 *
 *   points    -  out: the corners, counter-clockwise where the face is seen
 *                from its front
 *   world     -  the scene
 *   vertices  -  of the corners, in order; their coordinates are finite
 *   count     -  of corners, 3 at least
 *   return    false if each edge is on a line through the first corner
 *
 * Error: 2^-54 of the face's width a coordinate, as exact as a double is. The
 *        direction is rounded to 1/254, which only matters if a face is bent.
 * From:  I. E. Sutherland, R. F. Sproull, R. A. Schumacker, "A characterization
 *        of ten hidden-surface algorithms", 1974, which credits M. Newell.
 */
bool plane_project(plane_point_t *points, const world_t *world,
        const uint32_t *vertices, size_t count);

/* 1, 0 or -1: c is to the left of the line from a to b, on it, to its right.
 * Exact. */
int plane_side(
        const plane_point_t *a, const plane_point_t *b, const plane_point_t *c);

/* Does the way from a to c, all on a line, come back at b, or rest there? */
bool plane_turns_back(
        const plane_point_t *a, const plane_point_t *b, const plane_point_t *c);

#endif
