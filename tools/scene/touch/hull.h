/* hull.h - the walls around a scene: nothing is behind their planes */
/* SPDX-License-Identifier: MIT */

/* A face is of the hull if every vertex of the scene lies in its plane or in
 * front of it, and every sphere too. The core never meets such a face on a
 * segment between two positions in front of it (firmware/DESIGN.md), so the
 * tree keeps these faces apart. */

#ifndef HULL_H
#define HULL_H

#include "scene/mesh/bvh.h"
#include "scene/mesh/grid.h"

#define HULL_SIDES_MAX BVH_PARTS_MAX /* planes; more would ask too much */
#define HULL_WALKS_MAX 400 /* over all faces, while it is looked for */

typedef struct {
    uint8_t *part; /* of each face: 1 + its side, or 0; NULL without a hull */
    ql_blob_hull_t box;
    ql_blob_side_t sides[HULL_SIDES_MAX]; /* without nodes and triangles */
    uint32_t side_count;
    uint32_t nodes[HULL_SIDES_MAX]; /* as the tree has them, once there is one*/
} hull_t;

/* Find the hull of a scene.
 *
 *   hull  -  out; hull_free() it
 *   grid  -  complete
 *
 * There is none if it would have too many planes, or if nothing else is in the
 * scene. A face that overlaps another in its plane is not of it.
 * Exact.
 * Cost: HULL_WALKS_MAX times the faces at most; a scene that takes more has
 *       none.
 */
void hull_find(hull_t *hull, const grid_t *grid);

/* The same as the tree wants it, which writes the nodes. */
bvh_apart_t hull_apart(hull_t *hull);

void hull_free(hull_t *hull);

#endif
