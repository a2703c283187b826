/* ql_emit.h - directions towards an emitter, and their density */
/* SPDX-License-Identifier: MIT */

/* How each strategy draws a direction towards one emitter, and so with which
 * density per solid angle:
 *
 *              AREA, MIS                  SOLID_ANGLE
 *   triangle   point of its area          spherical triangle, or area if that
 *                                         is below 3e-4 or above 6.22 sr
 *   sphere     AREA: point of its area    cone it fills, or the cosine
 *              MIS: as SOLID_ANGLE        hemisphere if the surface is inside
 *   sky        map: its distribution      the same as AREA
 *              constant: cosine hemisphere
 *
 * A density here belongs to one emitter; whoever chose it divides by the
 * probability of that, ql_light_weight(). Each kind of emitter has a file of
 * its own. */

#ifndef QL_EMIT_H
#define QL_EMIT_H

#include "light/ql_emit_parts.h"

/* Draw a direction.
 *
 *   scene    -     has lights
 *   direct   -     AREA, SOLID_ANGLE or MIS
 *   light    -     index of the light
 *   surface  -     to be lit
 *   u        uq32  chooses the direction
 *   sample   -     out, if true is returned
 *   return   false if nothing can come from there: the emitter faces away, or
 *            the direction is below the surface or the shading normal
 */
bool ql_emit_sample(const ql_scene_t *scene, ql_direct_t direct, uint16_t light,
        const ql_surface_t *surface, ql_uniform2_t u, ql_emit_sample_t *sample);

#if QL_MIS
/* 1 / density that ql_emit_sample() with MIS has for a direction that was drawn
 * by another density.
 *
 *   scene    -      has lights
 *   surface  -      where it begins
 *   ray      -      the direction, ql_dir_t
 *   tri      -      what it hit, an emitter; NULL for the sky
 *   t        u2.30  where
 *   return   real   1 / pdf per solid angle; 0 for a density of 0
 */
ql_real_t ql_emit_inv_pdf(const ql_scene_t *scene, const ql_surface_t *surface,
        const ql_ray_t *ray, const ql_blob_tri_t *tri, ql_uq30_t t);
#else
QL_INLINE ql_real_t ql_emit_inv_pdf(const ql_scene_t *scene,
        const ql_surface_t *surface, const ql_ray_t *ray,
        const ql_blob_tri_t *tri, ql_uq30_t t)
{
    (void)scene, (void)surface, (void)ray, (void)tri, (void)t;
    return QL_REAL_ZERO;
}
#endif

#endif
