/* ql_hull.h - walls around the scene: no segment inside meets them */
/* SPDX-License-Identifier: MIT */

/* A triangle is of the hull if nothing of the scene is behind its plane, not
 * even in part. A segment between two positions in front of such planes meets
 * none of these triangles, and a ray that meets the front of one meets anything
 * else before it. So the tree has them apart, by sides. Whether a position is
 * in front is asked of the position itself, wherever it came from. The proof is
 * in DESIGN.md. */

#ifndef QL_HULL_H
#define QL_HULL_H

#include "scene/ql_ray.h"
#include "scene/ql_scene.h"

/* Is a hit, or none, the front of the hull's? Anything else that the ray meets
 * comes before it, and all of these are met at once. */
#if QL_CFG_HULL
QL_INLINE bool ql_hull_is_last(const ql_scene_t *scene, const ql_hit_t *hit)
{
    /* first is 0 without a hull */
    return hit->front && (uint32_t)scene->hull_first - 1 < hit->tri_idx;
}
#else
QL_INLINE bool ql_hull_is_last(const ql_scene_t *scene, const ql_hit_t *hit)
{
    return (void)scene, (void)hit, false;
}
#endif

#define QL_HULL_NO_NODE 0xffffffffu

#if QL_CFG_HULL && !QL_CFG_SMALL
/* Does a ray begin inside the hull and, if it is a segment, end there?
 *
 *   scene    -  open
 *   ray      -  from a position in the box, a segment to one
 *   segment  -  it is one
 *   return   false if it does not, and always in a scene without a hull
 *
 * Exact: what is on a side is not inside. Without QL_CFG_SLANTED more may be
 * said to be outside.
 */
bool ql_hull_has(const ql_scene_t *scene, const ql_ray_t *ray, bool segment);

/* Find the next side whose front a ray may meet.
 *
 *   scene   -  has a hull
 *   ray     -  it begins inside
 *   left    -  sides that were not tried; less by those tried now
 *   return  its node, 2 j or 2 j + 1 of pair j; QL_HULL_NO_NODE after the last
 *
 * Exact: a side that the ray meets is always found.
 */
uint32_t ql_hull_next(
        const ql_scene_t *scene, const ql_ray_t *ray, unsigned *left);
#else
/* Small builds walk the whole tree: it takes longer and finds the same. */
QL_INLINE bool ql_hull_has(
        const ql_scene_t *scene, const ql_ray_t *ray, bool segment)
{
    return (void)scene, (void)ray, (void)segment, false;
}

QL_INLINE uint32_t ql_hull_next(
        const ql_scene_t *scene, const ql_ray_t *ray, unsigned *left)
{
    return (void)scene, (void)ray, (void)left, QL_HULL_NO_NODE;
}
#endif

/* n.v of a side, v over 2^down, its components below 2^15 then.
 *
 * Error: the side's normal N, scaled by a power of two, is off from n by 1/2 a
 *        component at most and |n| <= 2^14. So N.v, scaled alike, differs by
 *        less than 3 2^14, and by as much again if bits of v were cut. Beyond
 *        QL_HULL_MARGIN it has the sign of n.v, which is below 3 2^29.
 */
#define QL_HULL_MARGIN ((QL_POS_BITS > 0 ? 2 : 1) * 49152l)

QL_INLINE int32_t ql_hull_along(
        const ql_blob_side_t *side, const ql_vec3_t *v, unsigned down)
{
    return ql_i16(QL_LE16((uint16_t)side->n[0])) * ql_asr32(v->x, down) +
           ql_i16(QL_LE16((uint16_t)side->n[1])) * ql_asr32(v->y, down) +
           ql_i16(QL_LE16((uint16_t)side->n[2])) * ql_asr32(v->z, down);
}

/* Is a position in front of every side, strictly? Asked of those that are not
 * in the hull's box: few, unless walls are turned against the grid.
 *
 *   scene  -    has a hull
 *   p      pos  in the box
 *
 * Exact; without QL_CFG_SLANTED always false.
 */
#if QL_CFG_HULL && QL_CFG_SLANTED
bool ql_hull_is_before_sides(const ql_scene_t *scene, const ql_vec3_t *p);
#else
QL_INLINE bool ql_hull_is_before_sides(
        const ql_scene_t *scene, const ql_vec3_t *p)
{
    return (void)scene, (void)p, false;
}
#endif

#endif
