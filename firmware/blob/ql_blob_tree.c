/* ql_blob_tree.c - the BVH: every link, every box, the order of its pairs */
/* SPDX-License-Identifier: MIT */

#include "blob/ql_blob_parts.h"

/* A link and its meta lead to a leaf of real triangles, or to a real pair. */
QL_FAST_INLINE bool link_valid(
        unsigned meta, uint32_t link, uint32_t pair_count, uint32_t tri_count)
{
    if (meta < 3) {
        return link < pair_count;
    }
    return meta - 3 <= QL_LEAF_MAX && link <= tri_count &&
           meta - 3 <= tri_count - link;
}

/* One child of a pair, whatever the width. */
typedef struct {
    uint32_t link;
    unsigned meta;
    bool box_valid;
} child_t;

static child_t child_of(const void *pairs, unsigned bits, uint32_t node)
{
    child_t c = {0, 0, true};

    if (!QL_CFG_NODE8 || (QL_CFG_NODE16 && bits == 16)) {
        const ql_blob_node16_t *n = (const ql_blob_node16_t *)pairs + node;

        c.link = QL_LE16(n->link);
        c.meta = QL_LE16(n->meta);
        for (unsigned k = 0; k < 3; k++) {
            c.box_valid = c.box_valid && QL_LE16(n->centre[k]) <= QL_GRID_MAX &&
                          QL_LE16(n->half[k]) <= 16384;
        }
    } else {
        const ql_blob_pair8_t *n = (const ql_blob_pair8_t *)pairs + (node >> 1);
        const unsigned i = node & 1u;

        c.link = QL_LE16(n->link[i]);
        c.meta = i ? n->meta >> 4 : n->meta & 15u;
        c.box_valid = n->shift <= 8;
        for (unsigned k = 0; k < 3 && c.box_valid; k++) {
            c.box_valid = QL_LE16(n->base[k]) + ((uint32_t)n->centre[i][k]
                                                        << n->shift) <=
                                  QL_GRID_MAX &&
                          (uint32_t)n->half[i][k] << n->shift <= 16384;
        }
    }
    return c;
}

/* Pairs lie in the order of this walk: each is reached once, the walk ends. */
bool ql_blob_tree_check(const ql_blob_parts_t *parts, const ql_scene_t *scene)
{
    const uint32_t pair_count = parts->pair_count;
    const uint32_t tri_count = parts->triangle_count;
    const unsigned depth_max = QL_LE16(parts->header->depth);
    uint32_t stack[QL_CFG_BVH_STACK];
    uint8_t level[QL_CFG_BVH_STACK];
    unsigned depth = 0, at = 0;
    uint32_t visits = 0, node;
    child_t c = {scene->root_link, scene->root_meta, true};

    for (;;) {
        if (!c.box_valid ||
                !link_valid(c.meta, c.link, pair_count, tri_count)) {
            return false;
        }
        if (c.meta < 3) {
            if (c.link != visits++ || ++at > depth_max) {
                return false;
            }
            node = 2 * c.link;
            stack[depth] = node + 1;
            level[depth++] = (uint8_t)at;
        } else {
            if (depth == 0) {
                return visits == pair_count;
            }
            node = stack[--depth];
            at = level[depth];
        }
        c = child_of(scene->pairs, scene->node_bits, node);
    }
}
