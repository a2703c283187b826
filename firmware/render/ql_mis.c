/* ql_mis.c - multiple importance sampling: weights by the balance heuristic */
/* SPDX-License-Identifier: MIT */

#include "render/ql_mis.h"

#include "light/ql_emit.h"
#include "light/ql_light.h"

#if QL_MIS

ql_real_t ql_mis_weight(ql_real_t h)
{
    uint64_t below; /* 1 + h in units of 2^e, below 2^63 */
    int e;

    QL_COUNT(balances);
    if (h.m == 0 || h.e < -93) {
        return h; /* h < 2^-61 */
    }
    if (h.e >= 0) {
        return QL_REAL_ONE; /* h >= 2^31 */
    }
    if (h.e >= -31) {
        /* 1 <= h < 2^31 */
        e = h.e;
        below = (uint64_t)h.m + ((uint64_t)1 << -e);
    } else {
        /* h < 1 */
        const int up = h.e + 62;

        e = -62;
        below = (up >= 0 ? (uint64_t)h.m << up : (uint64_t)(h.m >> -up)) +
                ((uint64_t)1 << 62);
    }
    return ql_real_mul_call(
            h, ql_real_recip_call(ql_real_from_uq_call(below, (unsigned)-e)));
}

ql_real_t ql_mis_weight_of_ray(const ql_context_t *context,
        const ql_path_ray_t *ray, const ql_blob_tri_t *tri, ql_uq30_t t)
{
    const ql_scene_t *scene = context->scene;
    const ql_settings_t *s = context->settings;
    const uint16_t index =
            tri == NULL ? QL_LIGHT_SKY : (uint16_t)(tri - scene->triangles);
    uint16_t light;
    ql_real_t h;

    if (ray->counts != QL_COUNTS_MIS || !ql_light_find(scene, index, &light)) {
        return QL_REAL_ONE;
    }
    QL_COUNT(weights);

    /* h = p / q: the lobe's density times the inverse of the emitter's */
    h = ql_real_mul_call(
            ray->pdf, ql_emit_inv_pdf(scene, ray->from, &ray->ray, tri, t));
    h = ql_real_mul_call(h, QL_REAL_TWO_PI);
    h = ql_real_mul_call(
            h, ql_light_weight(scene, s->lights, s->light_samples, light));
    return h.m == 0 ? QL_REAL_ONE : ql_mis_weight(h);
}

#endif
