/* joints.h - edges are split at the corners of other faces that lie on them */
/* SPDX-License-Identifier: MIT */

/* Where a long edge meets two short ones, the corner between those is on the
 * long one as written, but not on the grid, and the crack between lets light
 * through. Faces with such an edge are cut, so that no corner lies on an edge
 * but at its ends. */

#ifndef JOINTS_H
#define JOINTS_H

#include "scene/world/world.h"

/* Split edges that no other face has where two others, that no other face has
 * either, meet on them: less than half a grid unit off, along each axis.
 *
 *   world   -  in, out: faces are replaced by their parts, in their place
 *   return     how many faces were
 *
 * A part has the material and the group of its face; normals at a new corner
 * are those of the edge's ends in proportion.
 * Cost: n log n.
 */
size_t joints_split(world_t *world);

#endif
