/* bvh.h - BVH by full-sweep SAH, of guaranteed depth */
/* SPDX-License-Identifier: MIT */

/* Every split between triangles sorted by centroid along each axis is tried and
 * the one of least expected cost taken (surface area heuristic). A split is
 * only considered if both sides still fit into the levels that remain, so the
 * depth is bounded by construction. All integers: every host builds the same
 * tree. */

#ifndef BVH_H
#define BVH_H

#include "scene/mesh/grid.h"

#define BVH_LEAF 3 /* meta of a leaf of n: BVH_LEAF + n */

/* Expected costs, in instructions of the core. */
typedef struct {
    uint32_t pair;     /* test the two children of a node */
    uint32_t triangle; /* test a triangle */
} bvh_cost_t;

typedef struct {
    uint16_t low[3], high[3]; /* exact box, inclusive */
    uint32_t link;            /* first pair, or first entry of order */
    uint32_t meta;            /* split axis 0..2, or BVH_LEAF + n */
} bvh_node_t;

typedef struct {
    bvh_node_t (*pairs)[2]; /* the first on the lower side of the split */
    uint32_t *order;        /* faces of the grid, leaf by leaf */
    bvh_node_t root;
    uint32_t pair_count;
    uint32_t depth; /* levels below the root */
} bvh_t;

/* Build a tree.
 *
 *   bvh       -      out; bvh_free() it
 *   grid      -      the triangles, none of them or 65,535 at most
 *   leaf_max  1..13  triangles in one leaf
 *   cost      -      what the core pays
 *   quiet     -      no progress bar
 *
 * Exact: no deeper than QL_DEPTH_MAX; links point forward.
 * Cost:  n log n.
 */
void bvh_build(bvh_t *bvh, const grid_t *grid, unsigned leaf_max,
        const bvh_cost_t *cost, bool quiet);

#define BVH_PARTS_MAX 16

/* Faces that are kept apart from the others, in parts. */
typedef struct {
    const uint8_t *part; /* of each face; 0: not apart, as one is at least */
    unsigned count;      /* parts 1 to count, each of a face or more */
    uint32_t *nodes;     /* out: 2 j or 2 j + 1, child of pair j */
} bvh_apart_t;

/* The same with some faces apart below the root's second child, where each part
 * is all that is below a node. They are the last ones of order, part by part.
 *
 *   apart  -  NULL for none
 */
void bvh_build_apart(bvh_t *bvh, const grid_t *grid, const bvh_apart_t *apart,
        unsigned leaf_max, const bvh_cost_t *cost, bool quiet);

void bvh_free(bvh_t *bvh);

#endif
