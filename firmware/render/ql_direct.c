/* ql_direct.c - next-event estimation, emitters met by rays, their shares */
/* SPDX-License-Identifier: MIT */

#include "render/ql_direct.h"

#include "light/ql_emit.h"
#include "light/ql_emit_sky.h"
#include "light/ql_emit_triangle.h"
#include "light/ql_light.h"
#include "math/vec/ql_vec_unit.h"
#include "trace/ql_bvh.h"

/* Points of triangles, seen from flat diffuse surfaces, are all there is. */
#define POINTS_ONLY                                                            \
    (!QL_GLOSS && !QL_CFG_SMOOTH && !QL_CFG_SPHERES && !QL_CFG_SKY &&          \
            !QL_CFG_STRATEGIES)

/* round(a b / 2^32) */
static uint32_t product_round(uint32_t a, uint32_t b)
{
#if QL_PORT_WIDE_MUL
    return (uint32_t)(((uint64_t)a * b + 0x80000000u) >> 32);
#else
    return ql_mulhi_u32(a, b) + (a * b >> 31); /* a b <= (2^32 - 1)^2 */
#endif
}

/* Add carried Le scale; Le is u0.32. Exact for a throughput of 1. */
static void add_light(const ql_path_t *path, const ql_rgb_t *carried,
        const ql_uq32_t emission[3], ql_real_t scale)
{
    ql_uq31_t value[3];

    scale.e = ql_real_exponent((int32_t)scale.e + carried->e);
    for (unsigned i = 0; i < 3; i++) {
        value[i] = product_round(carried->c[i], emission[i]);
    }
    ql_film_add(
            path->sum, value, scale, ql_sampler_key(path->sampler), path->diag);
}

/* The same of what a material emits. */
QL_FAST_INLINE void add_emission(const ql_path_t *path, const ql_rgb_t *carried,
        const ql_blob_material_t *material, ql_real_t scale)
{
    ql_uq32_t emission[3];

    for (unsigned i = 0; i < 3; i++) {
        emission[i] = QL_LE32(material->emission[i]);
    }
    add_light(path, carried, emission, scale);
}

#if QL_CFG_STRATEGIES
/* h / (1 + h) */
static ql_real_t share_of(ql_real_t h)
{
    ql_real_t below;

    if (h.m == 0 || h.e < -93) {
        return h; /* h < 2^-61 */
    }
    if (h.e >= 0) {
        return QL_REAL_ONE; /* h >= 2^31 */
    }
    if (h.e >= -31) {
        /* 1 <= h < 2^31, in units of 2^e */
        below = ql_real_scale(
                ql_real_from_u64((uint64_t)h.m + ((uint64_t)1 << -h.e)), h.e);
    } else {
        /* h < 1, in units of 2^-62 */
        const int up = h.e + 62;
        const uint64_t m =
                up >= 0 ? (uint64_t)h.m << up : (uint64_t)(h.m >> -up);

        below = ql_real_scale(ql_real_from_u64(m + ((uint64_t)1 << 62)), -62);
    }
    return ql_real_mul(h, ql_real_recip(below));
}
#endif

/* ---- drawn towards emitters ---- */

#if QL_CFG_LIGHTS
/* weight (n.w)(N.w) / |w|^4 with n unit. Positions carry f fraction bits: two
 * more powers of w below than above, so the quotient is 2^2f too small. */
static ql_real_t geometry(const ql_surface_t *surface, ql_real_t weight,
        ql_vec3_t w, uint64_t cos_n, uint64_t cos_light)
{
    const ql_real_t inverse = ql_real_recip(ql_vec_square_pos(w));
    ql_real_t g;

    g = ql_real_mul(
            ql_real_from_u64(cos_n), ql_vec_unit_unpack_inv_n(surface->inv_n));
    g = ql_real_mul(g, inverse);
    g = ql_real_mul(g, ql_real_from_u64(cos_light));
    g = ql_real_mul(g, inverse);
    g = ql_real_mul(g, weight);
    return ql_real_scale(g, 2 * QL_POS_BITS);
}

/* A flat diffuse surface and a point of a triangle: no square root. */
static void light_point(const ql_path_t *path, const ql_surface_t *surface,
        const ql_rgb_t *reflected, uint16_t light, ql_real_t weight,
        ql_uniform2_t u)
{
    ql_emit_point_t point;
    ql_ray_t ray;
    const uint64_t cos_light = ql_emit_triangle_facing(
            path->scene, light, surface->p, u, &point, &ray.direction);
    const int64_t cos_n = ql_vec_dot_normal_ptr(&ray.direction, &surface->n);
    ql_real_t g;

    if (cos_n <= 0 || cos_light == 0) {
        return;
    }
    ray.origin = surface->p;
    QL_DIAG_COUNT(path->diag, shadow_rays);
    if (ql_bvh_occluded(path->scene, &ray)) {
        return;
    }
    g = geometry(surface, weight, ray.direction, (uint64_t)cos_n, cos_light);
#if QL_CFG_STRATEGIES
    if (path->settings->direct == QL_DIRECT_MIS) {
        g = share_of(g);
    }
#endif
    add_emission(path, reflected, point.material, g);
}

#if !POINTS_ONLY
/* Can light come along a direction that was drawn? */
static bool is_free(const ql_path_t *path, const ql_surface_t *surface,
        uint16_t light, const ql_emit_sample_t *sample)
{
    const uint16_t index = QL_LE16(path->scene->lights[light].triangle);
    ql_ray_t ray;

    ray.origin = surface->p;
#if QL_CFG_SKY
    if (index == QL_LIGHT_SKY) {
        ql_hit_t hit;

        QL_DIAG_COUNT(path->diag, closest_rays);
        ray.direction = ql_vec_to_dir(sample->wi);
        return !ql_bvh_closest_hit(path->scene, &ray, &hit);
    }
#endif
    ray.direction = ql_vec_sub(sample->to, surface->p);
    QL_DIAG_COUNT(path->diag, shadow_rays);
    return !ql_bvh_occluded_but(path->scene, &ray, index);
}

/* Any surface, any emitter. */
static void light_direction(const ql_path_t *path, const ql_bsdf_t *bsdf,
        const ql_rgb_t *carried, uint16_t light, ql_real_t weight,
        ql_uniform2_t u)
{
    const ql_direct_t direct = (ql_direct_t)path->settings->direct;
    ql_emit_sample_t sample;
    ql_rgb_t r;

    if (!ql_emit_sample(
                path->scene, direct, light, bsdf->surface, u, &sample) ||
            !is_free(path, bsdf->surface, light, &sample)) {
        return;
    }
    ql_bsdf_eval(bsdf, sample.wi, sample.cosine,
            ql_real_mul(sample.inv_pdf, ql_real_mul(QL_REAL_TWO_PI, weight)),
            direct == QL_DIRECT_MIS ? QL_MIS_BALANCE : QL_MIS_NONE, &r);
    ql_rgb_mul(&r, carried);
    add_light(path, &r, sample.emission, QL_REAL_ONE);
}

/* Is a light drawn by its area alone, a triangle's? */
static bool is_by_area(const ql_path_t *path, uint16_t light)
{
    const uint16_t index = QL_LE16(path->scene->lights[light].triangle);

    return (!QL_CFG_STRATEGIES ||
                   path->settings->direct != QL_DIRECT_SOLID_ANGLE) &&
           (!QL_CFG_SKY || index != QL_LIGHT_SKY) &&
           ql_scene_sphere(path->scene, path->scene->triangles + index) == NULL;
}

#endif

/* One sample of one light. */
static void ask(const ql_path_t *path, uint32_t dim, const ql_bsdf_t *bsdf,
        const ql_rgb_t *carried, const ql_rgb_t *reflected, uint16_t light)
{
    const ql_settings_t *s = path->settings;
    const ql_real_t weight =
            ql_light_weight(path->scene, s->lights, s->light_samples, light);
    const ql_uniform2_t u =
            ql_sampler_2d(path->sampler, dim + QL_DIM_LIGHT_POINT);

#if POINTS_ONLY
    (void)carried;
#else
    if (!ql_bsdf_is_flat_diffuse(bsdf) || !is_by_area(path, light)) {
        light_direction(path, bsdf, carried, light, weight, u);
        return;
    }
#endif
    light_point(path, bsdf->surface, reflected, light, weight, u);
}

void ql_direct_light(const ql_path_t *path, uint32_t dim, const ql_bsdf_t *bsdf,
        const ql_rgb_t *carried, const ql_rgb_t *reflected)
{
    const ql_settings_t *s = path->settings;
    const uint16_t count = path->scene->light_count;
    const unsigned samples = QL_CFG_STRATEGIES ? s->light_samples : 1;

#if QL_CFG_STRATEGIES
    if (s->lights == QL_LIGHTS_ALL) {
        for (uint16_t light = 0; light < count; light++) {
            for (unsigned i = 0; i < samples; i++) {
                ask(path, dim, bsdf, carried, reflected, light);
                dim += QL_DIMS_A_SAMPLE;
            }
        }
        return;
    }
#endif
    for (unsigned i = 0; i < samples; i++) {
        const ql_uq32_t pick = count < 2 ? 0
                                         : ql_sampler_1d(path->sampler,
                                                   dim + QL_DIM_LIGHT_PICK);

        ask(path, dim, bsdf, carried, reflected,
                ql_light_choose(path->scene, s->lights, pick));
        dim += QL_DIMS_A_SAMPLE;
    }
}
#endif

/* ---- met by rays ---- */

/* The share of a ray that met a light; 1 if no other estimator could have. tri
 * is NULL for the sky. */
static ql_real_t share_seen(const ql_path_t *path, const ql_sight_t *sight,
        const ql_ray_t *ray, const ql_blob_tri_t *tri, ql_uq30_t t)
{
#if QL_CFG_STRATEGIES
    const ql_settings_t *s = path->settings;
    const uint16_t index = tri == NULL
                                   ? QL_LIGHT_SKY
                                   : (uint16_t)(tri - path->scene->triangles);
    uint16_t light;
    ql_real_t h;

    if (sight->kind != QL_SIGHT_SHARE ||
            !ql_light_find(path->scene, index, &light)) {
        return QL_REAL_ONE;
    }
    h = ql_real_mul(
            sight->pdf, ql_emit_inv_pdf(path->scene, sight->from, ray, tri, t));
    h = ql_real_mul(h, QL_REAL_TWO_PI);
    h = ql_real_mul(h,
            ql_light_weight(path->scene, s->lights, s->light_samples, light));
    return h.m == 0 ? QL_REAL_ONE : share_of(h);
#else
    (void)path;
    (void)sight;
    (void)ray;
    (void)tri;
    (void)t;
    return QL_REAL_ONE;
#endif
}

void ql_direct_seen(const ql_path_t *path, const ql_sight_t *sight,
        const ql_rgb_t *carried, const ql_ray_t *ray, const ql_hit_t *hit)
{
    const ql_blob_tri_t *tri = path->scene->triangles + hit->tri_idx;
    const ql_blob_material_t *material = ql_scene_material(path->scene, tri);

    if (sight->kind == QL_SIGHT_NONE ||
            (!hit->front && !ql_scene_two_sided(path->scene)) ||
            (material->emission[0] | material->emission[1] |
                    material->emission[2]) == 0) {
        return;
    }
    add_emission(
            path, carried, material, share_seen(path, sight, ray, tri, hit->t));
}

void ql_direct_sky(const ql_path_t *path, const ql_sight_t *sight,
        const ql_rgb_t *carried, const ql_ray_t *ray)
{
#if QL_CFG_SKY
    ql_uq32_t emission[3];

    if (path->scene->sky == NULL || sight->kind == QL_SIGHT_NONE) {
        return;
    }
    ql_emit_sky_radiance(path->scene, ray->direction, emission);
    add_light(path, carried, emission, share_seen(path, sight, ray, NULL, 0));
#else
    (void)path;
    (void)sight;
    (void)carried;
    (void)ray;
#endif
}
