/* ql_light.h - choose an emitter, choose a point on it */
/* SPDX-License-Identifier: MIT */

#ifndef QL_LIGHT_H
#define QL_LIGHT_H

#include "math/ql_real.h"
#include "math/ql_vec.h"
#include "scene/ql_scene.h"

/* A point on an emitter. */
typedef struct {
    ql_vec3_t q;      /* ql_pos_t, on or within an ulp of the plane */
    ql_vec3_t corner; /* a corner of its triangle, grid units */
    ql_vec3_t n;      /* e1 x e2, exact: |n| is twice the area */
    const ql_blob_material_t *material;
} ql_light_point_t;

/* Choose an emitter.
 *
 *   scene   -     has lights
 *   choice  -     ql_light_choice_t, not ALL
 *   pick    uq32  uniform
 *   return  index of a light
 *
 * Exact: each is chosen for as many of the 2^32 values as its probability says
 * (POWER: the shares in the blob; UNIFORM: 2^32 / count, up or down).
 */
uint16_t ql_light_choose(
        const ql_scene_t *scene, unsigned choice, ql_uq32_t pick);

/* 1 / (2 pi P) of a light, P its share by power. */
QL_INLINE ql_real_t ql_light_power_weight(const ql_blob_light_t *light)
{
    ql_real_t r;

    r.m = QL_LE32(light->weight_m);
    r.e = ql_i16(QL_LE16((uint16_t)light->weight_exp));
    return r;
}

/* What dividing by a light's probability comes to.
 *
 *   scene    -  has lights
 *   choice   -  ql_light_choice_t; with ALL the probability is 1
 *   samples  -  1..255: samples of each emitter asked
 *   index    -  of the light
 *   return   1 / (2 pi P samples), P the probability ql_light_choose() has
 *
 * Error: half an ulp for one sample by POWER, 2^-29 else.
 */
#if QL_CFG_STRATEGIES
ql_real_t ql_light_weight(const ql_scene_t *scene, unsigned choice,
        unsigned samples, uint16_t index);
#else
QL_INLINE ql_real_t ql_light_weight(const ql_scene_t *scene, unsigned choice,
        unsigned samples, uint16_t index)
{
    (void)choice;
    (void)samples;
    return ql_light_power_weight(scene->lights + index);
}
#endif

#if QL_CFG_STRATEGIES
/* The light that an entry of the table of triangles is.
 *
 *   scene   -  open
 *   index   -  of the triangle or sphere, or QL_LIGHT_SKY
 *   light   -  out, if it is one
 *   return  false if it is none
 *
 * Cost: ceil(log2(lights)) compares.
 */
bool ql_light_find(const ql_scene_t *scene, uint16_t index, uint16_t *light);
#endif

/* A uniform point on a light that is a triangle.
 *
 *   scene   -     has lights
 *   index   -     of the light
 *   u1, u2  uq32  choose the point
 *   point   -     out
 *
 * pdf: 1 / area per area. Error: the point within half an ulp in each
 * component.
 */
void ql_light_point(const ql_scene_t *scene, uint16_t index, ql_uq32_t u1,
        ql_uq32_t u2, ql_light_point_t *point);

#endif
