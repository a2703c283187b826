/* ql_order.h - which of two hits is the nearer, exactly if need be */
/* SPDX-License-Identifier: MIT */

/* Ray parameters are rounded, so of two surfaces in one place the one or the
 * other would be hit, as rounding has it. Where a scene has such surfaces, hits
 * within rounding are compared as the fractions that they are. Of equals one
 * whose front is seen comes before one seen from behind, so a sheet of two
 * faces wound against each other shows each from its front; then the rank
 * decides that the scene gives them, their order in its file. */

#ifndef QL_ORDER_H
#define QL_ORDER_H

#include "scene/ql_ray.h"
#include "scene/ql_scene.h"

/* By the rounded parameter; of equal ones the lowest index. */
QL_INLINE bool ql_order_is_before_as_rounded(
        const ql_hit_t *a, const ql_hit_t *b)
{
    return a->t < b->t || (a->t == b->t && a->tri_idx < b->tri_idx);
}

#if QL_CFG_ORDER
/* A parameter is off by 2^-29 t + 2^-27 at most and t < 4: two of them by this
 * many units. */
#define QL_ORDER_ROUNDING 32u

/* Keep the fraction t / det of a hit; 1 / 0 if there is none yet. */
QL_INLINE void ql_order_keep(ql_hit_t *hit, uint64_t t, uint64_t det)
{
    hit->exact_t = t;
    hit->exact_det = det;
}

/* Is hit a before hit b? By their fractions, then by the side that is seen, by
 * their ranks, by their indices.
 *
 *   scene  -  has ranks
 *   a, b   -  with their fractions
 *
 * Exact.
 */
bool ql_order_is_before_exactly(
        const ql_scene_t *scene, const ql_hit_t *a, const ql_hit_t *b);

/* Do two hits of one ray, with their fractions, have to be compared exactly? */
QL_INLINE bool ql_order_is_close(
        const ql_scene_t *scene, const ql_hit_t *a, const ql_hit_t *b)
{
    return scene->ranks != NULL &&
           a->t - b->t + QL_ORDER_ROUNDING <= 2 * QL_ORDER_ROUNDING;
}
#else
QL_INLINE void ql_order_keep(ql_hit_t *hit, uint64_t t, uint64_t det)
{
    (void)hit, (void)t, (void)det;
}

QL_INLINE bool ql_order_is_close(
        const ql_scene_t *scene, const ql_hit_t *a, const ql_hit_t *b)
{
    return (void)scene, (void)a, (void)b, false;
}

QL_INLINE bool ql_order_is_before_exactly(
        const ql_scene_t *scene, const ql_hit_t *a, const ql_hit_t *b)
{
    return (void)scene, ql_order_is_before_as_rounded(a, b);
}
#endif

#endif
