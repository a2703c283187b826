/* smooth.h - which triangles are smooth, and the normals of their corners */
/* SPDX-License-Identifier: MIT */

#ifndef SMOOTH_H
#define SMOOTH_H

#include "scene/mesh/grid.h"

/* Give the corners of smooth triangles their normals.
 *
 *   grid   -  in, out: complete but for normals. Where a vertex has several, it
 *             becomes several vertices; normals stays NULL if nothing is smooth
 *   world  -  the scene
 *
 * A triangle is smooth if each corner has a normal that, as stored, is not in
 * its plane; each is turned to its front. If all are parallel to its own as
 * written, to 2^-13, it is flat: files keep four decimals, off by 2^-13.5.
 *
 * Error: half of the last bit of s0.15.
 */
void smooth_corners(grid_t *grid, const world_t *world);

#endif
