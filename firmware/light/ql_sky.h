/* ql_sky.h - light from all around: a constant, or a latitude-longitude map */
/* SPDX-License-Identifier: MIT */

/* Row 0 of a map is around +y. A direction (x, y, z) lies at polar angle
 * theta = atan2(|(x, z)|, y) and azimuth atan2(x, z); v = theta / pi and
 * u = (azimuth - rotate) / (2 pi), modulo 1. A texel has one radiance. */

#ifndef QL_SKY_H
#define QL_SKY_H

#include "math/ql_real.h"
#include "math/ql_vec.h"
#include "scene/ql_scene.h"

#if QL_CFG_SKY
/* Radiance from a direction, and the density ql_sky_sample() has there.
 *
 *   scene     -     has a sky
 *   d         -     any integer vector, components up to 2^30; of (0, 0, 0)
 *                   some texel
 *   emission  uq32  out: RGB, radiance units
 *   inverse   real  out, unless NULL: 1 / pdf per solid angle of a map; 0 for
 *                   a density of 0, and for a constant sky, which has none
 *
 * At a pole the density is infinite; there the inverse is that of a direction
 * next to it, not 0.
 *
 * Error: u within 2^-29 / sin(theta) of a turn, v within 2^-28; inverse
 *        relative, 2^-26. The same in both precisions.
 * Cost:  of a map two arc tangents and two square roots.
 */
void ql_sky_radiance(const ql_scene_t *scene, ql_vec3_t d,
        ql_uq32_t emission[3], ql_real_t *inverse);
#endif

#if QL_CFG_SKY_MAP
/* Draw a direction towards the map in proportion to its radiance.
 *
 *   scene     -      its sky is a map
 *   u1, u2    uq32   uniform
 *   w         s2.29  out: unit direction
 *   emission  uq32   out: RGB of the texel drawn, radiance units
 *   return    1 / pdf = 2 pi^2 sin(theta) / (density of its table), per solid
 *             angle; never 0
 *
 * The density is that of the quantised table, so nothing is biased by it.
 *
 * Error: the inverse relative, 2^-26, both precisions; the direction that of
 *        ql_sincos() twice, 4e-5 (draft) or 9e-8 (fine), so it may be looked
 *        up in a neighbour of its texel.
 * Cost:  that of ql_table_sample(), two sines and cosines, one more sine.
 */
ql_real_t ql_sky_sample(const ql_scene_t *scene, ql_uq32_t u1, ql_uq32_t u2,
        ql_vec3_t *w, ql_uq32_t emission[3]);
#endif

#endif
