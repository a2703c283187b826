/* ql_bvh.h - closest hit and any hit, fixed stack, no recursion */
/* SPDX-License-Identifier: MIT */

#ifndef QL_BVH_H
#define QL_BVH_H

#include "scene/ql_ray.h"
#include "scene/ql_scene.h"

/* Find the nearest triangle along a ray.
 *
 *   scene   -  open
 *   ray     -  origin in the box; largest direction component 2^(b-1)..2^b
 *   hit     -  out: valid if true is returned
 *   return  true if anything is hit
 *
 * Exact: which triangles are hit. Among them the smallest t wins, of equals the
 * lowest index. Error: t within 2^-29 t + 2^-27 (tests/unit/test_bvh.c), far
 * below an ulp of the hit point.
 * Cost: four bytes of stack for each of QL_CFG_BVH_STACK.
 */
bool ql_bvh_closest_hit(
        const ql_scene_t *scene, const ql_ray_t *ray, ql_hit_t *hit);

/* Is anything strictly between the ends of a segment?
 *
 *   scene   -  open
 *   ray     -  segment from origin to origin + direction, both in the box
 *   return  true if a triangle is hit at 0 < t < 1
 *
 * Exact, for every segment.
 */
bool ql_bvh_occluded(const ql_scene_t *scene, const ql_ray_t *ray);

#endif
