/* ql_hull_slanted.c - what is in front of sides turned against the grid */
/* SPDX-License-Identifier: MIT */

#include "trace/ql_hull.h"

#include "base/ql_diag.h"

#if QL_CFG_HULL && QL_CFG_SLANTED && !QL_CFG_SMALL

/* Is a position in front of a side, strictly? Nearly always what is left of
 * the position and the normal in 16 bits tells. */
static bool is_in_front(
        const ql_scene_t *scene, const ql_blob_side_t *side, const ql_vec3_t *p)
{
    const ql_blob_tri_t *tri = scene->triangles + QL_LE16(side->triangle);
    const ql_vec3_t v = ql_scene_corner(scene, tri, 0);
    ql_vec3_t n, s;
    ql_edges_t t;

    s.x = p->x - v.x * (1 << QL_POS_BITS);
    s.y = p->y - v.y * (1 << QL_POS_BITS);
    s.z = p->z - v.z * (1 << QL_POS_BITS);
    if (ql_hull_along(side, &s, QL_POS_BITS) > QL_HULL_MARGIN) {
        return true;
    }
    t = ql_scene_edges(scene, tri);
    ql_vec_cross_ptr(&n, &t.e1, &t.e2);
    return ql_vec_dot_normal_ptr(&s, &n) > 0;
}

bool ql_hull_is_before_sides(const ql_scene_t *scene, const ql_vec3_t *p)
{
    const ql_blob_side_t *side = scene->sides;
    const ql_blob_side_t *const end = side + scene->side_count;

    for (; side < end; side++) {
        QL_COUNT(slants);
        if (!is_in_front(scene, side, p)) {
            return false;
        }
    }
    return true;
}

#endif
