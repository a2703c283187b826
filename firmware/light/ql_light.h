/* ql_light.h - the table of emitters: choose one, its probability, find one */
/* SPDX-License-Identifier: MIT */

#ifndef QL_LIGHT_H
#define QL_LIGHT_H

#include "base/ql_settings.h"
#include "math/ql_real.h"
#include "scene/ql_scene.h"

/* The triangle or sphere that a light is; not of the sky.
 *
 *   scene  -  has lights
 *   light  -  index of the light
 */
QL_INLINE const ql_blob_tri_t *ql_light_triangle(
        const ql_scene_t *scene, uint16_t light)
{
    return scene->triangles + QL_LE16(scene->lights[light].triangle);
}

/* Is a light the sky?
 *
 *   scene  -  has lights
 *   light  -  index of the light
 */
QL_INLINE bool ql_light_is_sky(const ql_scene_t *scene, uint16_t light)
{
    return QL_CFG_SKY && QL_LE16(scene->lights[light].triangle) == QL_LIGHT_SKY;
}

/* Choose an emitter.
 *
 *   scene   -     has lights
 *   choice  -     ql_light_choice_t, not ALL
 *   pick    uq32  uniform
 *   return  index of a light
 *
 * pmf: ql_light_pmf().
 * Exact: each is chosen for as many of the 2^32 values as its probability says
 * (POWER: the shares in the blob; UNIFORM: 2^32 / count, up or down).
 */
uint16_t ql_light_choose(
        const ql_scene_t *scene, unsigned choice, ql_uq32_t pick);

/* Probability that ql_light_choose() has.
 *
 *   scene   -     has lights
 *   choice  -     ql_light_choice_t; with ALL the probability is 1
 *   light   -     index of the light
 *   return  real  in (0, 1]; 0 for a light of no power
 *
 * Exact: it is the number of values for which the light is chosen, over 2^32.
 */
ql_real_t ql_light_pmf(
        const ql_scene_t *scene, unsigned choice, uint16_t light);

/* 1 / (2 pi P) of a light, P its probability by power, from the blob. */
QL_INLINE ql_real_t ql_light_power_weight(const ql_blob_light_t *light)
{
    return QL_REAL(QL_LE32(light->weight_m),
            ql_i16(QL_LE16((uint16_t)light->weight_exp)));
}

/* What dividing by a light's probability comes to.
 *
 *   scene    -     has lights
 *   choice   -     ql_light_choice_t
 *   samples  -     1..255: samples of each emitter that is asked
 *   light    -     index of the light
 *   return   real  1 / (2 pi P samples), P = ql_light_pmf()
 *
 * Error: half an ulp for one sample by POWER, 2^-29 else.
 */
#if QL_CFG_LIGHT_CHOICES != 1 || QL_CFG_LIGHT_SAMPLES
ql_real_t ql_light_weight(const ql_scene_t *scene, unsigned choice,
        unsigned samples, uint16_t light);
#else
QL_INLINE ql_real_t ql_light_weight(const ql_scene_t *scene, unsigned choice,
        unsigned samples, uint16_t light)
{
    (void)choice, (void)samples;
    return ql_light_power_weight(scene->lights + light);
}
#endif

/* The light that an entry of the table of triangles is.
 *
 *   scene   -  open
 *   index   -  of the triangle or sphere, or QL_LIGHT_SKY
 *   light   -  out, if it is one
 *   return  false if it is none
 *
 * Cost: ceil(log2(lights)) compares.
 */
#if QL_MIS
bool ql_light_find(const ql_scene_t *scene, uint16_t index, uint16_t *light);
#else
QL_INLINE bool ql_light_find(
        const ql_scene_t *scene, uint16_t index, uint16_t *light)
{
    (void)scene, (void)index, (void)light;
    return false;
}
#endif

#endif
