/* ql_sphere.h - ray against sphere: sides exact, the hit point from integers */
/* SPDX-License-Identifier: MIT */

/* With s = origin - centre in 1/256 grid units the origin is outside iff
 * s.s > r^2 and leaves iff s.d >= 0: integers, so a ray that leaves a point
 * strictly outside never meets the sphere again, and one strictly inside always
 * does, once. Between these, a ray meets it iff d.d r^2 > |s x d|^2. That is
 * decided with 30 bits, and a ray too close to call misses: no ray is ever said
 * to hit a sphere, and so its box, that it does not meet. */

#ifndef QL_SPHERE_H
#define QL_SPHERE_H

#include "scene/ql_ray.h"
#include "scene/ql_scene.h"
#include "scene/ql_surface.h"

#if QL_CFG_SPHERES

/* From the centre of a sphere to a position.
 *
 *   sphere  -    of the scene
 *   p       pos  in the box
 *   return  1/256 grid units; components below 2^23
 *
 * Exact.
 */
ql_vec3_t ql_sphere_offset(const ql_blob_sphere_t *sphere, ql_vec3_t p);

/* On which side of a sphere?
 *
 *   sphere  -  of the scene
 *   offset  -  from ql_sphere_offset()
 *   return  |offset|^2 - r^2: above 0 outside, below 0 inside
 *
 * Exact.
 */
int64_t ql_sphere_side(const ql_blob_sphere_t *sphere, ql_vec3_t offset);

/* Where a ray meets a sphere.
 *
 *   sphere  -     of the scene
 *   ray     -     origin in the box
 *   t       u2.30 out, if it does: the ray parameter
 *   return  0 no hit, 1 from outside, -1 from inside
 *
 * A ray that begins on the sphere itself misses it if it leaves, and else
 * counts as from inside.
 * Error: origin + t direction is within 2^-26 of the way from origin and an
 *        ulp of t of the sphere; from outside also 2^-29 of the radius. Rays
 *        are lost within 2^-28 of the radius inside the rim
 *        (tests/unit/test_sphere.c).
 * Cost:  7 products for a ray that leaves, 13 more for one that misses; a hit
 *        takes a square root and a reciprocal besides.
 */
int ql_sphere_hit(
        const ql_blob_sphere_t *sphere, const ql_ray_t *ray, ql_uq30_t *t);

/* Is a segment blocked by a sphere strictly between its ends?
 *
 *   sphere   -  of the scene
 *   segment  -  both ends in the box
 *
 * A segment from outside to a point outside that still approaches the centre
 * is free, exactly; so are the two ends inside. From one side to the other it
 * is blocked, exactly; one that only grazes the sphere is free as a ray that is
 * too close to call misses.
 */
bool ql_sphere_blocks(const ql_blob_sphere_t *sphere, const ql_ray_t *segment);

/* Step a point along the dominant axis of its offset until it is strictly
 * outside, or strictly inside; QL_SIDE_STEPS_MAX steps at most.
 *
 *   sphere   -    of the scene
 *   p        pos  within an ulp or two of the sphere; stepped
 *   outside  -    to which side
 *   return   -    its offset there, as ql_sphere_offset() has it
 */
ql_vec3_t ql_sphere_step(
        const ql_blob_sphere_t *sphere, ql_vec3_t *p, bool outside);

/* Step the point of a surface off the sphere, and set its exact normal.
 *
 *   sphere   -  of the scene
 *   outside  -  was it seen from outside?
 *   surface  -  its p is where it was hit; p, n and inv_n are set
 */
void ql_sphere_surface(
        const ql_blob_sphere_t *sphere, bool outside, ql_surface_t *surface);
#else
QL_INLINE ql_vec3_t ql_sphere_offset(
        const ql_blob_sphere_t *sphere, ql_vec3_t p)
{
    (void)sphere;
    return p;
}

QL_INLINE int64_t ql_sphere_side(
        const ql_blob_sphere_t *sphere, ql_vec3_t offset)
{
    (void)sphere, (void)offset;
    return 1;
}

QL_INLINE ql_vec3_t ql_sphere_step(
        const ql_blob_sphere_t *sphere, ql_vec3_t *p, bool outside)
{
    (void)sphere, (void)outside;
    return *p;
}

QL_INLINE void ql_sphere_surface(
        const ql_blob_sphere_t *sphere, bool outside, ql_surface_t *surface)
{
    (void)sphere, (void)outside, (void)surface;
}
#endif

#endif
