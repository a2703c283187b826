/* ql_emit_sky.h - light from all around: its radiance, directions to it */
/* SPDX-License-Identifier: MIT */

/* A sky is constant, or a map (ql_sky_map.h). A constant one is drawn by the
 * cosine, as no density of its own would be better. */

#ifndef QL_EMIT_SKY_H
#define QL_EMIT_SKY_H

#include "light/ql_emit_parts.h"

#if QL_CFG_SKY
/* Radiance from a direction.
 *
 *   scene     -     has a sky
 *   d         -     any integer vector, components up to 2^30; of (0, 0, 0)
 *                   some texel of a map
 *   emission  uq32  out: RGB, radiance units
 */
void ql_emit_sky_radiance(
        const ql_scene_t *scene, ql_vec3_t d, ql_uq32_t emission[3]);

/* Draw a direction towards the sky.
 *
 *   scene    -     has a sky
 *   surface  -     to be lit
 *   u        uq32  chooses the direction
 *   sample   -     out, if true is returned: all but where it ends
 *   return   false if the direction is below the surface or the shading normal
 */
bool ql_emit_sky_sample(const ql_scene_t *scene, const ql_surface_t *surface,
        ql_uniform2_t u, ql_emit_sample_t *sample);

/* 1 / density of ql_emit_sky_sample().
 *
 *   scene    -      has a sky
 *   surface  -      to be lit
 *   d        dir_t  the direction, above the surface
 *   return   real   1 / pdf per solid angle; 0 for a density of 0
 */
ql_real_t ql_emit_sky_inv_pdf(
        const ql_scene_t *scene, const ql_surface_t *surface, ql_vec3_t d);
#else
QL_INLINE void ql_emit_sky_radiance(
        const ql_scene_t *scene, ql_vec3_t d, ql_uq32_t emission[3])
{
    (void)scene, (void)d, (void)emission;
}

QL_INLINE bool ql_emit_sky_sample(const ql_scene_t *scene,
        const ql_surface_t *surface, ql_uniform2_t u, ql_emit_sample_t *sample)
{
    (void)scene, (void)surface, (void)u, (void)sample;
    return false;
}

QL_INLINE ql_real_t ql_emit_sky_inv_pdf(
        const ql_scene_t *scene, const ql_surface_t *surface, ql_vec3_t d)
{
    (void)scene, (void)surface, (void)d;
    return QL_REAL_ZERO;
}
#endif

#endif
