/* ql_direct.c - next-event estimation by area sampling */
/* SPDX-License-Identifier: MIT */

#include "render/ql_direct.h"

#include "scene/ql_light.h"
#include "trace/ql_bvh.h"
#include "trace/ql_surface.h"

/* |w|^2; components below 2^15 (draft): 3 2^30 fits 32 bits; 2^23 (fine) */
QL_INLINE ql_real_t length_squared(ql_vec3_t w)
{
#if QL_POS_BITS == 0
    return ql_real_from_u64((uint32_t)(w.x * w.x) + (uint32_t)(w.y * w.y) +
                            (uint32_t)(w.z * w.z));
#else
    return ql_real_from_u64((uint64_t)ql_vec_dot(w, w));
#endif
}

/* 1/|n| as packed in ql_blob_tri_t */
QL_INLINE ql_real_t unpack_inverse(uint32_t inv_n)
{
    ql_real_t r;

    r.m = inv_n & ~31u;
    r.e = (int16_t)(-31 - (int16_t)(inv_n & 31u));
    return r;
}

/* weight (n.w)(N.w) / |w|^4 with n unit. Positions carry f fraction bits: two
 * more powers of w below than above, so the quotient is 2^2f too small. */
static ql_real_t geometry(const ql_surface_t *surface,
        const ql_light_point_t *point, ql_vec3_t w, uint64_t cos_n,
        uint64_t cos_light)
{
    const ql_real_t inverse = ql_real_recip(length_squared(w));
    ql_real_t g;

    g = ql_real_mul(ql_real_from_u64(cos_n), unpack_inverse(surface->inv_n));
    g = ql_real_mul(g, inverse);
    g = ql_real_mul(g, ql_real_from_u64(cos_light));
    g = ql_real_mul(g, inverse);
    g = ql_real_mul(g, point->weight);
    g.e = (int16_t)(g.e + 2 * QL_POS_BITS);
    return g;
}

void ql_direct_area(const ql_scene_t *scene, const ql_sampler_t *sampler,
        uint32_t dim, const ql_surface_t *surface, const ql_uq31_t reflected[3],
        ql_sum_t *sum, ql_diag_t *diag)
{
    const ql_uq32_t pick =
            scene->light_count < 2
                    ? 0
                    : ql_sampler_1d(sampler, dim + QL_DIM_LIGHT_PICK);
    const ql_uniform2_t u = ql_sampler_2d(sampler, dim + QL_DIM_LIGHT_POINT);
    ql_light_point_t point;
    ql_ray_t ray;
    ql_vec3_t n;
    int64_t cos_n, cos_light;
    ql_real_t g;

    ql_light_sample(scene, pick, u.u1, u.u2, &point);

    /* The side of the emitter that may shine towards the surface. */
    ray.origin = surface->p;
    n = point.n;
    ray.direction = ql_vec_sub(point.q, surface->p);
    if (ql_scene_two_sided(scene) && ql_vec_dot_n(ray.direction, n) > 0) {
        n.x = -n.x; /* |n| < 2^31 */
        n.y = -n.y;
        n.z = -n.z;
    }

    /* Keep the point strictly in front, so its own emitter never hides it. */
    (void)ql_surface_step(&point.q, point.corner, n);
    ray.direction = ql_vec_sub(point.q, surface->p);
    cos_n = ql_vec_dot_n(ray.direction, surface->n);
    cos_light = -ql_vec_dot_n(ray.direction, n);
    if (cos_n <= 0 || cos_light <= 0) {
        return;
    }
    QL_DIAG_COUNT(diag, shadow_rays);
    if (ql_bvh_occluded(scene, &ray)) {
        return;
    }
    g = geometry(surface, &point, ray.direction, (uint64_t)cos_n,
            (uint64_t)cos_light);
    for (unsigned i = 0; i < 3; i++) {
        const uint32_t emission = QL_LE32(point.material->emission[i]);

        ql_film_add(
                &sum->rgb[i], ql_mulhi_u32(reflected[i], emission), g, diag);
    }
}
