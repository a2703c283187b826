/* ql_surface_at.h - the point that was hit, on the side it was seen from */
/* SPDX-License-Identifier: MIT */

#ifndef QL_SURFACE_AT_H
#define QL_SURFACE_AT_H

#include "scene/ql_ray.h"
#include "scene/ql_scene.h"
#include "scene/ql_surface.h"

/* Work out the surface at a hit.
 *
 *   scene    -  open
 *   ray      -  the ray
 *   hit      -  what it hit
 *   surface  -  out
 *
 * The point is cut towards the ray's origin, so it stays in every axis-aligned
 * room the ray was in, then stepped along the dominant axis of the normal until
 * it is strictly on the side it was seen from: an exact test, no epsilon.
 * At most 2 steps were ever needed (tests/unit/test_surface.c, test_sphere.c);
 * the loop ends after QL_SIDE_STEPS_MAX whatever the triangle.
 *
 * Where another surface may be that near (ql_contact.h), a segment from the
 * ray's origin decides whether the point is in front of it. A point that is not
 * is drawn back along the ray, by 1, 3, 7 .. units or twice that, if need be to
 * the origin.
 *
 * A shading normal is interpolated between the corners' with the exact weights
 * of the hit, on the side it was seen from. Where it is not above the surface
 * itself, or a corner has none, the surface is flat.
 * Error: of the shading normal, angle 2^-27 rad and 2^-30 of the sum of the
 *        corner normals' lengths over the length of the interpolated one;
 *        length 2^-25 (tests/unit/test_smooth.c).
 */
void ql_surface_at(const ql_scene_t *scene, const ql_ray_t *ray,
        const ql_hit_t *hit, ql_surface_t *surface);

/* Bring a point of a surface to its other side, for a ray that passes through.
 *
 *   scene    -    open
 *   tri_idx  -    what was hit
 *   surface  -    from ql_surface_at()
 *   p        pos  out: surface->p, stepped until strictly on the other side
 *   return   false if another surface is between the two points
 *
 * As exact as ql_surface_at(), and with the same limit of steps.
 */
#if QL_CFG_GLASS
bool ql_surface_cross(const ql_scene_t *scene, uint16_t tri_idx,
        const ql_surface_t *surface, ql_vec3_t *p);
#else
QL_INLINE bool ql_surface_cross(const ql_scene_t *scene, uint16_t tri_idx,
        const ql_surface_t *surface, ql_vec3_t *p)
{
    return (void)scene, (void)tri_idx, (void)surface, (void)p, true;
}
#endif

/* Step p along the dominant axis of n until n.(p - on) > 0.
 *
 *   p       pos   a point within an ulp or two of the plane; stepped
 *   on      grid  a corner in the plane
 *   n       -     the plane's exact normal
 *   return  how many steps, 0..QL_SIDE_STEPS_MAX
 */
unsigned ql_surface_step(ql_vec3_t *p, const ql_vec3_t *on, const ql_vec3_t *n);

#endif
