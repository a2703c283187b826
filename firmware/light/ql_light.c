/* ql_light.c - discrete choice of an emitter, uniform point on a triangle */
/* SPDX-License-Identifier: MIT */

#include "light/ql_light.h"

#include "base/ql_settings.h"
#include "sample/ql_cdf.h"
#include "warp/ql_warp.h"

#define LIGHT_WORDS (sizeof(ql_blob_light_t) / sizeof(uint32_t))

/* v + b1 e1 + b2 e2 along one axis, to nearest. The weights add up to less than
 * 1 and the edges are < 2^15, so the sum is < 2^31 (draft) or 2^47. */
QL_FAST_INLINE ql_pos_t blend(
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

uint16_t ql_light_choose(
        const ql_scene_t *scene, unsigned choice, ql_uq32_t pick)
{
    if (scene->light_count < 2) {
        return 0;
    }
    if (QL_CFG_STRATEGIES && choice == QL_LIGHTS_UNIFORM) {
        return (uint16_t)ql_mulhi_u32(pick, scene->light_count);
    }
    return ql_cdf_sample(
            &scene->lights->cum, LIGHT_WORDS, scene->light_count, pick);
}

#if QL_CFG_STRATEGIES
/* ceil(i 2^32 / n) for i <= n: where equal shares begin; 0 for i = n = 2^32. */
static uint32_t equal_bound(uint32_t i, uint32_t n)
{
    /* digit by digit in base 2^16, as i < 2^16 */
    const uint32_t high = (i << 16) / n, rest = (i << 16) - high * n;
    const uint32_t low = (rest << 16) / n;

    return (high << 16 | low) + (low * n != rest << 16);
}

ql_real_t ql_light_weight(const ql_scene_t *scene, unsigned choice,
        unsigned samples, uint16_t index)
{
    const uint32_t n = scene->light_count;
    ql_real_t weight;

    if (choice == QL_LIGHTS_POWER) {
        weight = ql_light_power_weight(scene->lights + index);
    } else {
        weight = QL_REAL_INV_2PI;
    }
    if (choice == QL_LIGHTS_UNIFORM && n > 1) {
        /* the bound after the last is 2^32, which wraps */
        const uint32_t share =
                equal_bound((uint32_t)index + 1, n) - equal_bound(index, n);

        weight = ql_real_mul(weight, ql_real_recip(ql_real_from_u64(share)));
        weight = ql_real_scale(weight, 32);
    }
    if (samples > 1) {
        weight = ql_real_mul(weight, ql_real_recip(ql_real_from_u64(samples)));
    }
    return weight;
}

bool ql_light_find(const ql_scene_t *scene, uint16_t index, uint16_t *light)
{
    uint32_t low = 0, high = scene->light_count;

    while (low < high) {
        const uint32_t mid = (low + high) / 2;

        if (QL_LE16(scene->lights[mid].triangle) < index) {
            low = mid + 1;
        } else {
            high = mid;
        }
    }
    *light = (uint16_t)low; /* <= light_count */
    return low < scene->light_count &&
           QL_LE16(scene->lights[low].triangle) == index;
}
#endif

void ql_light_point(const ql_scene_t *scene, uint16_t index, ql_uq32_t u1,
        ql_uq32_t u2, ql_light_point_t *point)
{
    const ql_blob_light_t *light = scene->lights + index;
    const ql_blob_tri_t *tri = scene->triangles + QL_LE16(light->triangle);
    const ql_edges_t t = ql_scene_edges(scene, tri);
    uint32_t b1, b2;

    ql_warp_triangle(u1, u2, &b1, &b2);
    point->q.x = blend(t.v0.x, t.e1.x, t.e2.x, b1, b2);
    point->q.y = blend(t.v0.y, t.e1.y, t.e2.y, b1, b2);
    point->q.z = blend(t.v0.z, t.e1.z, t.e2.z, b1, b2);
    point->corner = t.v0;
    ql_vec_cross_ptr(&point->n, &t.e1, &t.e2);
    point->material = ql_scene_material(scene, tri);
}
