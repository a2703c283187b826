/* ql_light.h - choose an emitter by power, choose a point on it */
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
    ql_real_t weight; /* 1 / (2 pi P), P the light's probability */
    const ql_blob_material_t *material;
} ql_light_point_t;

/* Choose an emitter with its quantised probability, and a uniform point on it.
 *
 *   scene   -     has lights
 *   pick    uq32  chooses the emitter
 *   u1, u2  uq32  choose the point
 *   point   -     out
 *
 * pdf: P / area per area, with the P that point->weight divides by.
 * Error: the point within half an ulp in each component.
 */
void ql_light_sample(const ql_scene_t *scene, ql_uq32_t pick, ql_uq32_t u1,
        ql_uq32_t u2, ql_light_point_t *point);

#endif
