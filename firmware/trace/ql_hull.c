/* ql_hull.c - walls around the scene: no segment inside meets them */
/* SPDX-License-Identifier: MIT */

#include "trace/ql_hull.h"

#include "base/ql_diag.h"

#if QL_CFG_HULL && !QL_CFG_SMALL

/* Is a coordinate between two bounds, and on neither? */
QL_FAST_INLINE bool is_between(int32_t p, const uint16_t bounds[2])
{
    return p > (int32_t)QL_LE16(bounds[0]) * (1 << QL_POS_BITS) &&
           p < (int32_t)QL_LE16(bounds[1]) * (1 << QL_POS_BITS);
}

/* Most positions are in the box, unless sides are turned against the grid. */
QL_FAST_INLINE bool holds(const ql_scene_t *scene, const ql_vec3_t *p)
{
    const ql_blob_hull_t *hull = scene->hull;

    QL_COUNT(places);
    return (is_between(p->x, hull->box[0]) && is_between(p->y, hull->box[1]) &&
                   is_between(p->z, hull->box[2])) ||
           ql_hull_is_before_sides(scene, p);
}

bool ql_hull_has(const ql_scene_t *scene, const ql_ray_t *ray, bool segment)
{
    ql_vec3_t p = ray->origin;

    if (scene->hull == NULL) {
        return false;
    }
    for (;;) {
        if (!holds(scene, &p)) {
            return false;
        }
        if (!segment) {
            return true;
        }
        p.x += ray->direction.x;
        p.y += ray->direction.y;
        p.z += ray->direction.z;
        segment = false;
    }
}

uint32_t ql_hull_next(
        const ql_scene_t *scene, const ql_ray_t *ray, unsigned *left)
{
    const ql_blob_side_t *const end = scene->sides + scene->side_count;

    while (*left > 0) {
        const ql_blob_side_t *side = end - (*left)--;

        QL_COUNT(sides);
        if (ql_hull_along(side, &ray->direction, QL_DIR_BITS - 15) <=
                QL_HULL_MARGIN) {
            return QL_LE16(side->node);
        }
    }
    return QL_HULL_NO_NODE;
}

#endif
