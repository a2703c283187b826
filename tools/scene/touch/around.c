/* around.c - the faces whose boxes meet a box */
/* SPDX-License-Identifier: MIT */

#include "scene/touch/around.h"

box_t box_around(const grid_t *grid, const grid_face_t *face, int more)
{
    uint16_t low[3], high[3];
    box_t box;

    grid_box(grid, face, low, high);
    for (int k = 0; k < 3; k++) {
        box.low[k] = low[k] - more;
        box.high[k] = high[k] + more;
    }
    return box;
}

static bool do_meet(
        const box_t *a, const uint16_t low[3], const uint16_t high[3])
{
    bool meet = true;

    for (int k = 0; k < 3; k++) {
        meet = meet && a->low[k] <= high[k] && low[k] <= a->high[k];
    }
    return meet;
}

void around_begin(
        around_t *walk, const grid_t *grid, const bvh_t *bvh, box_t box)
{
    walk->grid = grid;
    walk->bvh = bvh;
    walk->box = box;
    walk->stack[0] = &bvh->root;
    walk->depth = 1;
    walk->next = walk->end = 0;
}

/* Go to the next leaf; false after the last. */
static bool next_leaf(around_t *walk)
{
    while (walk->depth > 0) {
        const bvh_node_t *node = walk->stack[--walk->depth];

        if (node->meta >= BVH_LEAF) {
            walk->next = node->link;
            walk->end = node->link + (node->meta - BVH_LEAF);
            return true;
        }
        for (int i = 0; i < 2; i++) {
            const bvh_node_t *child = walk->bvh->pairs[node->link] + i;

            if (do_meet(&walk->box, child->low, child->high)) {
                walk->stack[walk->depth++] = child;
            }
        }
    }
    return false;
}

const grid_face_t *around_next(around_t *walk)
{
    for (;;) {
        while (walk->next < walk->end) {
            const grid_face_t *face =
                    walk->grid->faces + walk->bvh->order[walk->next++];
            uint16_t low[3], high[3];

            grid_box(walk->grid, face, low, high);
            if (do_meet(&walk->box, low, high)) {
                return face;
            }
        }
        if (!next_leaf(walk)) {
            return NULL;
        }
    }
}
