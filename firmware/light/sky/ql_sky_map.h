/* ql_sky_map.h - a latitude-longitude map of the sky: look up, draw */
/* SPDX-License-Identifier: MIT */

/* Row 0 of a map is around +y. A direction (x, y, z) lies at polar angle
 * theta = atan2(|(x, z)|, y) and azimuth atan2(x, z); v = theta / pi and
 * u = (azimuth - rotate) / (2 pi), modulo 1. A texel has one radiance. */

#ifndef QL_SKY_MAP_H
#define QL_SKY_MAP_H

#include "math/ql_real.h"
#include "math/vec/ql_vec.h"
#include "scene/ql_scene.h"

#if QL_CFG_SKY_MAP
/* Radiance from a direction, and the density ql_sky_map_sample() has there.
 *
 *   scene     -     its sky is a map
 *   d         -     any integer vector, components up to 2^30; of (0, 0, 0)
 *                   some texel
 *   emission  uq32  out: RGB, radiance units
 *   inv_pdf   real  out, unless NULL: 1 / pdf per solid angle; 0 for a density
 *                   of 0
 *
 * At a pole the density is infinite; there inv_pdf is that of a direction next
 * to it, not 0.
 *
 * Error: u within 2^-29 / sin(theta) of a turn, v within 2^-28; inv_pdf
 *        relative, 2^-26. The same in both precisions.
 * Cost:  two arc tangents and two square roots.
 */
void ql_sky_map_radiance(const ql_scene_t *scene, ql_vec3_t d,
        ql_uq32_t emission[3], ql_real_t *inv_pdf);

/* Draw a direction towards the map in proportion to its radiance.
 *
 *   scene     -      its sky is a map
 *   u1, u2    uq32   uniform
 *   w         s2.29  out: unit direction
 *   emission  uq32   out: RGB of the texel drawn, radiance units
 *   return    real   1 / pdf per solid angle, never 0:
 *                    2 pi^2 sin(theta) over the density of the map's table
 *
 * The density is the quantised table's own, so quantising biases nothing.
 *
 * Error: of 1 / pdf relative, 2^-26, both precisions; of the direction 4e-5
 *        (draft) or 9e-8 (fine), twice the error of ql_sincos(), so looking it
 *        up may find a neighbour of its texel.
 * Cost:  ql_table_sample(), two sines and cosines, one more sine.
 */
ql_real_t ql_sky_map_sample(const ql_scene_t *scene, ql_uq32_t u1, ql_uq32_t u2,
        ql_vec3_t *w, ql_uq32_t emission[3]);
#else
QL_INLINE void ql_sky_map_radiance(const ql_scene_t *scene, ql_vec3_t d,
        ql_uq32_t emission[3], ql_real_t *inv_pdf)
{
    (void)scene, (void)d, (void)emission, (void)inv_pdf;
}

QL_INLINE ql_real_t ql_sky_map_sample(const ql_scene_t *scene, ql_uq32_t u1,
        ql_uq32_t u2, ql_vec3_t *w, ql_uq32_t emission[3])
{
    (void)scene, (void)u1, (void)u2, (void)w, (void)emission;
    return QL_REAL_ZERO;
}
#endif

#endif
