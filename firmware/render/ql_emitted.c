/* ql_emitted.c - light of the emitters that rays meet, added to the pixel */
/* SPDX-License-Identifier: MIT */

#include "render/ql_emitted.h"

#include "light/ql_emit_sky.h"
#include "render/ql_mis.h"

void ql_emitted_add(const ql_context_t *context, const ql_rgb_t *throughput,
        const ql_uq32_t emission[3], ql_real_t scale)
{
    ql_uq31_t value[3];

    QL_COUNT(lit);
    scale.e = ql_real_exponent((int32_t)scale.e + throughput->e);
    for (unsigned i = 0; i < 3; i++) {
        value[i] = ql_mulhi_u32_rounded(throughput->c[i], emission[i]);
    }
    ql_clamp_add(context->sum, ql_context_clamp(context), value, scale,
            ql_sampler_key(context->sampler), context->diag);
}

/* The part that a ray counts of the emitter that it met; as
 * ql_mis_weight_of_ray() has it. */
static ql_real_t counted_part(const ql_context_t *context,
        const ql_path_ray_t *ray, const ql_blob_tri_t *tri, ql_uq30_t t)
{
    if (ql_plan_is_share(ray->counts)) {
        return ql_real_recip(
                ql_real_from_u64(context->settings->light_samples));
    }
    return ql_mis_weight_of_ray(context, ray, tri, t);
}

void ql_emitted_by_hit(const ql_context_t *context, const ql_path_ray_t *ray,
        const ql_hit_t *hit)
{
    const ql_scene_t *scene = context->scene;
    const ql_blob_tri_t *tri = scene->triangles + hit->tri_idx;
    const ql_blob_material_t *material = ql_scene_material(scene, tri);

    if ((!hit->front && !ql_scene_two_sided(scene)) ||
            (material->emission[0] | material->emission[1] |
                    material->emission[2]) == 0) {
        return;
    }
    ql_emitted_by_material(context, &ray->throughput, material,
            counted_part(context, ray, tri, hit->t));
}

#if QL_CFG_SKY
void ql_emitted_by_sky(const ql_context_t *context, const ql_path_ray_t *ray)
{
    ql_uq32_t emission[3];

    if (context->scene->sky == NULL) {
        return;
    }
    ql_emit_sky_radiance(context->scene, ray->ray.direction, emission);
    ql_emitted_add(context, &ray->throughput, emission,
            counted_part(context, ray, NULL, 0));
}
#endif
