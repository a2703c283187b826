/* ql_emit_sphere.h - directions towards a sphere: its area, cone or inside */
/* SPDX-License-Identifier: MIT */

#ifndef QL_EMIT_SPHERE_H
#define QL_EMIT_SPHERE_H

#include "light/ql_emit_parts.h"

#if QL_CFG_SPHERES
/* Draw a direction towards a sphere.
 *
 *   scene    -     open
 *   direct   -     AREA: a uniform point of the sphere; SOLID_ANGLE or MIS:
 *                  uniform in the cone it fills, or by the cosine from inside
 *   sphere   -     the emitter
 *   surface  -     to be lit
 *   u        uq32  chooses the direction
 *   sample   -     out, if true is returned: all but its emission
 *   return   false if nothing can come from there
 *
 * From a point on the sphere every strategy draws by the cosine.
 */
bool ql_emit_sphere_sample(const ql_scene_t *scene, ql_direct_t direct,
        const ql_blob_sphere_t *sphere, const ql_surface_t *surface,
        ql_uniform2_t u, ql_emit_sample_t *sample);

/* 1 / density that ql_emit_sphere_sample() with MIS has.
 *
 *   sphere   -     the emitter
 *   surface  -     to be lit
 *   ray      -     from there, and what meets the sphere
 *   return   real  1 / pdf per solid angle
 */
ql_real_t ql_emit_sphere_inv_pdf(const ql_blob_sphere_t *sphere,
        const ql_surface_t *surface, const ql_ray_t *ray);
#else
QL_INLINE bool ql_emit_sphere_sample(const ql_scene_t *scene,
        ql_direct_t direct, const ql_blob_sphere_t *sphere,
        const ql_surface_t *surface, ql_uniform2_t u, ql_emit_sample_t *sample)
{
    (void)scene, (void)direct, (void)sphere, (void)surface, (void)u;
    (void)sample;
    return false;
}

QL_INLINE ql_real_t ql_emit_sphere_inv_pdf(const ql_blob_sphere_t *sphere,
        const ql_surface_t *surface, const ql_ray_t *ray)
{
    (void)sphere, (void)surface, (void)ray;
    return QL_REAL_ZERO;
}
#endif

#endif
