/* ql_bvh.h - closest hit and any hit, fixed stack, no recursion */
/* SPDX-License-Identifier: MIT */

#ifndef QL_BVH_H
#define QL_BVH_H

#include "scene/ql_ray.h"
#include "scene/ql_scene.h"

/* Find the nearest triangle or sphere along a ray.
 *
 *   scene   -  open
 *   ray     -  origin in the box; largest direction component 2^(b-1)..2^b
 *   hit     -  out: valid if true is returned
 *   return  true if anything is hit
 *
 * Exact: which triangles are hit. Among them the smallest t wins, of equals the
 * first, as ql_order.h has it. Error: t within 2^-29 t + 2^-27
 * (tests/unit/test_bvh.c), far below an ulp of the hit point; for spheres see
 * ql_sphere_hit().
 * Cost: four bytes of stack for each of QL_CFG_BVH_STACK.
 */
bool ql_bvh_closest_hit(
        const ql_scene_t *scene, const ql_ray_t *ray, ql_hit_t *hit);

/* Is anything strictly between the ends of a segment?
 *
 *   scene   -  open
 *   ray     -  segment from origin to origin + direction, both in the box
 *   but     -  index of a sphere that does not count, as the segment aims at
 *              the side that it shows; QL_TRI_MAX for none
 *   return  true if a triangle or sphere is hit at 0 < t < 1
 *
 * Exact, for every segment, of triangles; of spheres see ql_sphere_blocks().
 */
bool ql_bvh_occluded_but(
        const ql_scene_t *scene, const ql_ray_t *ray, uint16_t but);

/* Is anything on a segment, its far end included?
 *
 *   scene   -  open
 *   ray     -  segment, both ends in the box; its origin lies on no surface
 *   but     -  index of a triangle or sphere that does not count
 *   return  true if a triangle or sphere is hit at 0 < t <= 1
 *
 * As exact as ql_bvh_occluded_but().
 */
#if QL_CFG_CONTACT
bool ql_bvh_touches(const ql_scene_t *scene, const ql_ray_t *ray, uint16_t but);
#endif

QL_INLINE bool ql_bvh_occluded(const ql_scene_t *scene, const ql_ray_t *ray)
{
    return ql_bvh_occluded_but(scene, ray, (uint16_t)QL_TRI_MAX);
}

#endif
