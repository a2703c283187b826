/* ql_path.c - the path loop: emission, direct light, next direction */
/* SPDX-License-Identifier: MIT */

#include "render/ql_path.h"

#include "render/ql_direct.h"
#include "sample/ql_warp.h"
#include "trace/ql_bvh.h"
#include "trace/ql_surface.h"

/* Light that the camera sees the surface emit: one-sided unless the scene says
 * otherwise. */
static void add_emission(const ql_scene_t *scene,
        const ql_blob_material_t *material, const ql_hit_t *hit, ql_sum_t *sum,
        ql_diag_t *diag)
{
    static const ql_real_t one = {0x80000000u, -31};

    if (hit->front || ql_scene_two_sided(scene)) {
        for (unsigned i = 0; i < 3; i++) {
            /* u0.32 as u1.31, to nearest; never rounds above 2^31 */
            const uint32_t e = QL_LE32(material->emission[i]);

            ql_film_add(&sum->rgb[i], (e >> 1) + (e & 1u), one, diag);
        }
    }
}

/* Cosine-distributed direction from a surface. Below the horizon by rounding,
 * or zero (rarer than 2^-18 in draft, 2^-26 in fine), it is the normal. */
static ql_vec3_t cosine_direction(const ql_surface_t *surface, ql_uniform2_t u)
{
    const ql_vec3_t n = ql_vec_unit(surface->n, surface->inv_n);
    const ql_vec3_t d = ql_dir_round(ql_warp_cosine_hemisphere(n, u.u1, u.u2));

    return ql_vec_dot_n(d, surface->n) > 0 ? d : ql_dir_round(n);
}

void ql_path_trace(const ql_scene_t *scene, const ql_settings_t *settings,
        const ql_sampler_t *sampler, const ql_ray_t *camera_ray, ql_sum_t *sum,
        ql_diag_t *diag)
{
    ql_uq31_t throughput[3] = {QL_UQ31_ONE, QL_UQ31_ONE, QL_UQ31_ONE};
    ql_ray_t ray = *camera_ray;
    const bool direct = QL_CFG_LIGHTS && settings->direct == QL_DIRECT_AREA &&
                        scene->light_count > 0;

    QL_DIAG_COUNT(diag, paths);
    for (uint8_t bounce = 0;; bounce++) {
        const uint32_t dim = QL_DIM_BOUNCE(bounce);
        const ql_blob_material_t *material;
        ql_surface_t surface;
        ql_hit_t hit;
        uint32_t any = 0;

        QL_DIAG_COUNT(diag, closest_rays);
        if (!ql_bvh_closest_hit(scene, &ray, &hit)) {
            return;
        }
        material = ql_scene_material(scene, scene->triangles + hit.tri_idx);
        if (bounce == 0) {
            add_emission(scene, material, &hit, sum, diag);
        }
        for (unsigned i = 0; i < 3; i++) {
            throughput[i] =
                    ql_mul_uq31(throughput[i], QL_LE32(material->albedo[i]));
            any |= throughput[i];
        }
        if (any == 0) {
            return;
        }
        ql_surface_at(scene, &ray, &hit, &surface);
        if (direct) {
            ql_direct_area(
                    scene, sampler, dim, &surface, throughput, sum, diag);
        }
        if (bounce >= settings->bounces ||
                settings->indirect == QL_INDIRECT_NONE) {
            return;
        }

        /* The weight of a cosine-distributed direction is the albedo. */
        ray.origin = surface.p;
        ray.direction = cosine_direction(
                &surface, ql_sampler_2d(sampler, dim + QL_DIM_DIRECTION));
    }
}
