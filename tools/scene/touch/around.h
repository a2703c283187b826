/* around.h - the faces whose boxes meet a box */
/* SPDX-License-Identifier: MIT */

#ifndef AROUND_H
#define AROUND_H

#include "scene/mesh/bvh.h"
#include "scene/mesh/grid.h"

/* From low to high, inclusive. */
typedef struct {
    int32_t low[3], high[3];
} box_t;

/* The box of a face and as much more on each side. */
box_t box_around(const grid_t *grid, const grid_face_t *face, int more);

/* A walk through a tree. */
typedef struct {
    const grid_t *grid;
    const bvh_t *bvh;
    box_t box;
    const bvh_node_t *stack[QL_DEPTH_MAX + 2];
    int depth;
    uint32_t next, end; /* of the leaf it is in */
} around_t;

/* Begin a walk to all faces whose boxes meet a box. */
void around_begin(
        around_t *walk, const grid_t *grid, const bvh_t *bvh, box_t box);

/* The next of them, in the order of the tree; NULL after the last. */
const grid_face_t *around_next(around_t *walk);

#endif
