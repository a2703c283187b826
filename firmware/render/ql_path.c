/* ql_path.c - the path loop: what is met, direct light, next direction */
/* SPDX-License-Identifier: MIT */

#include "render/ql_path.h"

#include "material/ql_diffuse.h"
#include "render/ql_emitted.h"
#include "render/ql_mis.h"
#include "render/ql_next_event.h"
#include "sample/ql_roulette.h"
#include "trace/ql_bvh.h"
#include "trace/surface/ql_smooth.h"
#include "trace/surface/ql_surface_at.h"

/* Let the camera's ray begin a path: nothing is lost yet, and an emitter that
 * it meets counts in full. */
static void begin_path(ql_path_ray_t *ray, const ql_ray_t *camera_ray)
{
    ray->ray = *camera_ray;
    ray->throughput.c[0] = QL_UQ31_ONE;
    ray->throughput.c[1] = QL_UQ31_ONE;
    ray->throughput.c[2] = QL_UQ31_ONE;
    ray->throughput.e = 0;
    ray->counts = QL_COUNTS_ALL;
    ray->specular = true;
}

/* Find what a ray meets and add the light that it counts; false if it leaves
 * the scene. */
static bool trace_ray(
        const ql_context_t *context, const ql_path_ray_t *ray, ql_hit_t *hit)
{
    const bool meets = ql_bvh_closest_hit(context->scene, &ray->ray, hit);

    QL_DIAG_COUNT(context->diag, closest_rays);
    if (ray->counts == QL_COUNTS_NOTHING) {
        return meets;
    }
    if (meets) {
        ql_emitted_by_hit(context, ray, hit);
    } else {
        ql_emitted_by_sky(context, ray);
    }
    return meets;
}

/* Is a gloss a specular one: a mirror's, or glass? */
static bool is_specular(const ql_blob_gloss_t *gloss)
{
    return QL_SPECULAR && gloss != NULL &&
           QL_LE16(gloss->kind) != QL_GLOSS_PHONG;
}

/* Make a vertex of what a ray met; false if the surface reflects nothing. */
static bool begin_vertex(const ql_context_t *context, const ql_path_ray_t *ray,
        const ql_hit_t *hit, unsigned bounce, ql_vertex_t *vertex)
{
    const ql_scene_t *scene = context->scene;
    const ql_blob_material_t *material =
            ql_scene_material(scene, scene->triangles + hit->tri_idx);
    const ql_blob_gloss_t *gloss = ql_scene_gloss(scene, material);

    /* A surface that is diffuse only and black, or so dark that nothing is left
     * of the throughput, ends the path. */
    vertex->reflected = ray->throughput;
    ql_rgb_filter(&vertex->reflected, material->albedo);
    if (gloss == NULL && ql_rgb_most(&vertex->reflected) == 0) {
        if ((material->albedo[0] | material->albedo[1] | material->albedo[2]) !=
                0) {
            QL_DIAG_COUNT(context->diag, faint);
        }
        return false;
    }

    /* The rest costs more: the point, its normals, the lobes. */
    QL_COUNT(vertices);
    if (gloss != NULL) {
        QL_COUNT(glossy);
    }
    vertex->throughput = &ray->throughput;
    vertex->dim = QL_DIM_BOUNCE(bounce);
    vertex->tri_idx = hit->tri_idx;
    ql_surface_at(scene, &ray->ray, hit, &vertex->surface);
    if (!is_specular(gloss)) {
        ql_smooth_lift(scene, &vertex->surface);
    }
    ql_bsdf_begin(&vertex->bsdf, scene, &vertex->surface, material, hit->front,
            ray->ray.direction);
    return true;
}

/* What lobes a surface has, as its plan wants them. */
static ql_lobes_t lobes_of(const ql_bsdf_t *bsdf)
{
    if (ql_bsdf_has_specular(bsdf)) {
        return ql_bsdf_has_nonspecular(bsdf) ? QL_LOBES_MIXED
                                             : QL_LOBES_SPECULAR;
    }
    return ql_bsdf_is_glossy(bsdf) ? QL_LOBES_GLOSSY : QL_LOBES_DIFFUSE;
}

/* Which random numbers a ray is drawn by: the numbers of a vertex's first ray,
 * or of its second. */
typedef enum { FIRST_RAY, SECOND_RAY } numbers_t;

/* Draw a ray from a vertex by numbers of dim; false if its light is lost. ray
 * may be the one that led to the vertex: it is written last. */
static bool sample_ray(const ql_context_t *context, const ql_vertex_t *vertex,
        const ql_plan_ray_t *plan, uint32_t dim, numbers_t numbers,
        ql_path_ray_t *ray)
{
    const ql_bsdf_t *bsdf = &vertex->bsdf;
    const bool by_mis = ql_plan_is_mis(plan->counts);
    const bool uniform = ql_density_is_uniform(plan->density);
    const bool first = numbers == FIRST_RAY;
    const ql_uniform2_t u = ql_sampler_2d(
            context->sampler, dim + (first ? QL_DIM_DIRECTION : QL_DIM_LOOK));
    ql_bsdf_sample_t sample;
    ql_uq32_t pick = 0;
    ql_real_t pdf;

    /* Of a flat diffuse surface the weight is the albedo, whatever direction
     * is drawn: f cos / pdf = albedo. */
    if (ql_bsdf_is_flat_diffuse(bsdf) && !by_mis && !uniform) {
        ray->ray.origin = vertex->surface.p;
        ray->ray.direction = ql_diffuse_direction(&vertex->surface, u);
        ray->throughput = vertex->reflected;
        ray->counts = plan->counts;
        ray->specular = false;
        return true;
    }

    /* Sample the BSDF: a lobe if it has two, wi, and f cos / (pmf pdf). */
    if (ql_bsdf_is_glossy(bsdf)) {
        QL_COUNT(lobes);
        pick = ql_sampler_1d(context->sampler,
                dim + (first ? QL_DIM_CHOICE : QL_DIM_LOOK_CHOICE));
    }
    if (!ql_bsdf_sample(
                bsdf, plan->density, pick, u, &sample, by_mis ? &pdf : NULL)) {
        return false;
    }

    /* The ray begins on the side of the surface that it leads to. */
    ray->ray.origin = vertex->surface.p;
    if (sample.through && !ql_surface_cross(context->scene, vertex->tri_idx,
                                  &vertex->surface, &ray->ray.origin)) {
        return false;
    }
    ray->ray.direction = sample.wi;

    /* Its throughput; a diffuse surface weighs by its albedo here too. */
    if (!ql_bsdf_is_glossy(bsdf) && !uniform) {
        ray->throughput = vertex->reflected;
    } else {
        ray->throughput = *vertex->throughput;
        ql_rgb_mul(&ray->throughput, &sample.weight);
    }

    /* What it counts depends on the lobe. */
    ray->specular = sample.specular;
    ray->counts = sample.specular ? plan->specular : plan->counts;
    if (by_mis) {
        QL_COUNT(densities);
        ql_mis_begin(ray, pdf, &vertex->surface);
    }
    return ql_rgb_most(&ray->throughput) != 0;
}

/* Draw rays only for emitters and count what they meet. */
static QL_NOINLINE void trace_emitter_rays(const ql_context_t *context,
        const ql_vertex_t *vertex, const ql_plan_t *plan)
{
    const numbers_t numbers =
            plan->indirect.density == QL_DENSITY_NONE ? FIRST_RAY : SECOND_RAY;
    uint32_t dim = vertex->dim;
    ql_path_ray_t ray;
    ql_hit_t hit;

    for (unsigned i = 0; i < plan->emitter_rays; i++) {
        QL_COUNT(looks);
        if (sample_ray(context, vertex, &plan->emitter, dim, numbers, &ray)) {
            (void)trace_ray(context, &ray, &hit);
        }
        dim += QL_DIMS_A_SAMPLE;
    }
}

void ql_path_trace(const ql_context_t *context, const ql_ray_t *camera_ray)
{
    const ql_settings_t *settings = context->settings;
    bool specular = true; /* at every vertex so far */
    ql_context_t first;
    ql_path_ray_t ray;
    ql_vertex_t vertex;
    ql_hit_t hit;

    QL_DIAG_COUNT(context->diag, paths);
    begin_path(&ray, camera_ray);
    for (unsigned bounce = 0;; bounce++) {
        ql_lobes_t lobes;
        ql_plan_t plan;

        /* Find what the ray meets, and add the light that it counts. */
        if (!trace_ray(
                    ql_context_of_ray(context, bounce, &first), &ray, &hit) ||
                !begin_vertex(context, &ray, &hit, bounce, &vertex)) {
            return;
        }

        /* Estimate direct light by next events. */
        lobes = lobes_of(&vertex.bsdf);
        if (lobes != QL_LOBES_SPECULAR) {
            ql_next_event(context, &vertex);
        }

        /* Estimate it by rays of its own where the plan has some. */
        plan = ql_plan_of(
                settings, lobes, settings->bounces - bounce, specular);
        if (plan.emitter.density != QL_DENSITY_NONE) {
            trace_emitter_rays(context, &vertex, &plan);
        }

        /* Sample the direction in which the path goes on. */
        if (plan.indirect.density == QL_DENSITY_NONE ||
                !sample_ray(context, &vertex, &plan.indirect, vertex.dim,
                        FIRST_RAY, &ray)) {
            return;
        }
        specular = specular && ray.specular;

        /* End faint paths by Russian roulette. */
        if (settings->roulette && !ql_roulette_survives(context->sampler,
                                          vertex.dim, &ray.throughput)) {
            return;
        }
    }
}

#if QL_CFG_SKY
void ql_path_miss(const ql_context_t *context, const ql_ray_t *camera_ray)
{
    ql_context_t first;
    ql_path_ray_t ray;

    begin_path(&ray, camera_ray);
    ql_emitted_by_sky(ql_context_of_ray(context, 0, &first), &ray);
}
#endif
