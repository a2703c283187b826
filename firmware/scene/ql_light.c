/* ql_light.c - discrete choice by power, uniform point on a triangle */
/* SPDX-License-Identifier: MIT */

#include "scene/ql_light.h"

#include "sample/ql_cdf.h"
#include "sample/ql_warp.h"

#define LIGHT_WORDS (sizeof(ql_blob_light_t) / sizeof(uint32_t))

/* v + b1 e1 + b2 e2 along one axis, to nearest. The weights add up to less than
 * 1 and the edges are < 2^15, so the sum is < 2^31 (draft) or 2^47. */
QL_INLINE ql_pos_t blend(
        int32_t v, int32_t e1, int32_t e2, uint32_t b1, uint32_t b2)
{
#if QL_POS_BITS == 0
    /* b <= 65535: |b e| < 2^31; the sum lies between two box coordinates */
    const int32_t sum = ql_i32((uint32_t)e1 * b1 + (uint32_t)e2 * b2);

    return v + ql_asr32(ql_asr32(sum, QL_BARY_BITS - 1) + 1, 1);
#else
    const int64_t sum = (int64_t)e1 * b1 + (int64_t)e2 * b2;

    return v * (1 << QL_POS_BITS) +
           (int32_t)ql_asr64(
                   ql_asr64(sum, QL_BARY_BITS - QL_POS_BITS - 1) + 1, 1);
#endif
}

void ql_light_sample(const ql_scene_t *scene, ql_uq32_t pick, ql_uq32_t u1,
        ql_uq32_t u2, ql_light_point_t *point)
{
    const uint16_t index =
            scene->light_count < 2
                    ? 0
                    : ql_cdf_sample(&scene->lights->cum, LIGHT_WORDS,
                              scene->light_count, pick);
    const ql_blob_light_t *light = scene->lights + index;
    const ql_blob_tri_t *tri = scene->triangles + QL_LE16(light->triangle);
    const ql_vec3_t v0 = ql_scene_corner(scene, tri, 0);
    const ql_vec3_t e1 = ql_vec_sub(ql_scene_corner(scene, tri, 1), v0);
    const ql_vec3_t e2 = ql_vec_sub(ql_scene_corner(scene, tri, 2), v0);
    uint32_t b1, b2;

    ql_warp_triangle(u1, u2, &b1, &b2);
    point->q.x = blend(v0.x, e1.x, e2.x, b1, b2);
    point->q.y = blend(v0.y, e1.y, e2.y, b1, b2);
    point->q.z = blend(v0.z, e1.z, e2.z, b1, b2);
    point->corner = v0;
    point->n = ql_vec_cross(e1, e2);
    point->weight.m = QL_LE32(light->weight_m);
    point->weight.e = ql_i16(QL_LE16((uint16_t)light->weight_exp));
    point->material = ql_scene_material(scene, tri);
}
