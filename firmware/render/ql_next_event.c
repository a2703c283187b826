/* ql_next_event.c - next-event estimation: light drawn towards the emitters */
/* SPDX-License-Identifier: MIT */

#include "render/ql_next_event.h"

#include "light/ql_emit.h"
#include "light/ql_emit_triangle.h"
#include "light/ql_light.h"
#include "math/vec/ql_vec_unit.h"
#include "render/ql_emitted.h"
#include "render/ql_mis.h"
#include "trace/ql_bvh.h"

#if QL_CFG_LIGHTS

/* Points of triangles, seen from flat diffuse surfaces, are all there is. */
#define POINTS_ONLY                                                            \
    (!QL_GLOSS && !QL_CFG_SMOOTH && !QL_CFG_SPHERES && !QL_CFG_SKY &&          \
            !QL_SOLID_ANGLE)

/* Does a ray that leads to an emitter meet it, not another surface in its
 * place? It does in a scene without any. w is a difference of positions. */
static bool is_met(const ql_context_t *context, ql_vec3_t origin, ql_vec3_t w,
        uint16_t light)
{
    const ql_scene_t *scene = context->scene;
    ql_ray_t ray;
    ql_hit_t hit;

    if (ql_scene_ranks(scene) == NULL) {
        return true;
    }
    QL_DIAG_COUNT(context->diag, closest_rays);
    ray.origin = origin;
    ray.direction = ql_vec_to_dir(w);
    return ql_bvh_closest_hit(scene, &ray, &hit) &&
           hit.tri_idx == QL_LE16(scene->lights[light].triangle);
}

/* ---- A point of a triangle, seen from a flat diffuse surface ----------- */

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

/* No square root is needed. */
static void sample_point(const ql_context_t *context, const ql_vertex_t *vertex,
        uint16_t light, ql_real_t weight, ql_uniform2_t u)
{
    const ql_surface_t *surface = &vertex->surface;
    ql_emit_point_t point;
    ql_ray_t ray;
    const uint64_t cos_light = ql_emit_triangle_facing(
            context->scene, light, surface->p, u, &point, &ray.direction);
    const int64_t cos_n = ql_vec_dot_normal_ptr(&ray.direction, &surface->n);
    ql_real_t g;

    if (cos_n <= 0 || cos_light == 0) {
        return;
    }
    ray.origin = surface->p;
    QL_DIAG_COUNT(context->diag, shadow_rays);
    if (ql_bvh_occluded(context->scene, &ray) ||
            !is_met(context, ray.origin, ray.direction, light)) {
        return;
    }
    g = geometry(surface, weight, ray.direction, (uint64_t)cos_n, cos_light);
    ql_emitted_by_material(context, &vertex->reflected, point.material,
            ql_mis_weigh_point(context, g));
}

/* ---- A direction towards any emitter, from any surface ----------------- */

/* Does light come along a direction that was drawn? */
static bool is_free(const ql_context_t *context, ql_vec3_t origin,
        uint16_t light, const ql_emit_sample_t *sample)
{
    const ql_scene_t *scene = context->scene;
    ql_ray_t ray;

    ray.origin = origin;
    if (ql_light_is_sky(scene, light)) {
        ql_hit_t hit;

        QL_DIAG_COUNT(context->diag, closest_rays);
        ray.direction = ql_vec_to_dir(sample->wi);
        return !ql_bvh_closest_hit(scene, &ray, &hit);
    }
    QL_DIAG_COUNT(context->diag, shadow_rays);
    ray.direction = ql_vec_sub(sample->to, origin);
    return !ql_bvh_occluded_but(
                   scene, &ray, QL_LE16(scene->lights[light].triangle)) &&
           is_met(context, origin, ray.direction, light);
}

static void sample_direction(const ql_context_t *context,
        const ql_vertex_t *vertex, uint16_t light, ql_real_t weight,
        ql_uniform2_t u)
{
    const ql_direct_t direct = (ql_direct_t)context->settings->direct;
    const ql_surface_t *surface = &vertex->surface;
    ql_emit_sample_t sample;
    ql_rgb_t r;

    if (!ql_emit_sample(context->scene, direct, light, surface, u, &sample) ||
            !is_free(context, surface->p, light, &sample)) {
        return;
    }
    QL_COUNT(values);
    if (direct == QL_DIRECT_MIS) {
        QL_COUNT(shares);
    }
    ql_bsdf_eval(&vertex->bsdf, sample.wi, sample.cosine,
            ql_real_mul(sample.inv_pdf, ql_real_mul(QL_REAL_TWO_PI, weight)),
            ql_direct_is(direct, QL_DIRECT_MIS) ? QL_MIS_BALANCE : QL_MIS_NONE,
            &r);
    ql_rgb_mul(&r, vertex->throughput);
    ql_emitted_add(context, &r, sample.emission, QL_REAL_ONE);
}

/* ---- Either ------------------------------------------------------------ */

/* Is a point of a triangle drawn, towards a surface that needs no more? */
static bool is_point(
        const ql_context_t *context, const ql_vertex_t *vertex, uint16_t light)
{
    const ql_scene_t *scene = context->scene;

    return POINTS_ONLY ||
           (ql_bsdf_is_flat_diffuse(&vertex->bsdf) &&
                   !ql_light_is_sky(scene, light) &&
                   ql_scene_sphere(scene, ql_light_triangle(scene, light)) ==
                           NULL &&
                   !ql_direct_is(
                           context->settings->direct, QL_DIRECT_SOLID_ANGLE));
}

/* Draw one sample of one emitter. */
static void sample_light(const ql_context_t *context, const ql_vertex_t *vertex,
        uint32_t dim, uint16_t light)
{
    const ql_settings_t *s = context->settings;
    const ql_real_t weight =
            ql_light_weight(context->scene, s->lights, s->light_samples, light);
    const ql_uniform2_t u =
            ql_sampler_2d(context->sampler, dim + QL_DIM_LIGHT_POINT);

    if (is_point(context, vertex, light)) {
        QL_COUNT(points);
        sample_point(context, vertex, light, weight, u);
    } else {
        QL_COUNT(directions);
        sample_direction(context, vertex, light, weight, u);
    }
}

/* Draw samples of emitters that are chosen, each time anew. */
static void sample_chosen(const ql_context_t *context,
        const ql_vertex_t *vertex, unsigned samples)
{
    const uint16_t count = context->scene->light_count;
    uint32_t dim = vertex->dim;

    for (unsigned i = 0; i < samples; i++) {
        const ql_uq32_t pick = count < 2 ? 0
                                         : ql_sampler_1d(context->sampler,
                                                   dim + QL_DIM_LIGHT_PICK);

        sample_light(context, vertex, dim,
                ql_light_choose(
                        context->scene, context->settings->lights, pick));
        dim += QL_DIMS_A_SAMPLE;
    }
}

/* Are points or directions of emitters drawn? */
static bool draws_emitters(unsigned direct)
{
    return ql_direct_is(direct, QL_DIRECT_AREA) ||
           ql_direct_is(direct, QL_DIRECT_SOLID_ANGLE) ||
           ql_direct_is(direct, QL_DIRECT_MIS);
}

/* Draw samples of every emitter. */
static void sample_all(const ql_context_t *context, const ql_vertex_t *vertex,
        unsigned samples)
{
    const uint16_t count = context->scene->light_count;
    uint32_t dim = vertex->dim;

    for (uint16_t light = 0; light < count; light++) {
        for (unsigned i = 0; i < samples; i++) {
            sample_light(context, vertex, dim, light);
            dim += QL_DIMS_A_SAMPLE;
        }
    }
}

void ql_next_event(const ql_context_t *context, const ql_vertex_t *vertex)
{
    const ql_settings_t *s = context->settings;
    const unsigned samples = QL_CFG_LIGHT_SAMPLES ? s->light_samples : 1;

    if (context->scene->light_count == 0 || !draws_emitters(s->direct)) {
        return;
    }
    if (ql_lights_is(s->lights, QL_LIGHTS_ALL)) {
        sample_all(context, vertex, samples);
    } else {
        sample_chosen(context, vertex, samples);
    }
}

#endif
