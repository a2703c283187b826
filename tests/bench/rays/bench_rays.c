/* bench_rays.c - follow paths as ql_path.c does and keep their rays */
/* SPDX-License-Identifier: MIT */

#include "bench/rays/bench_rays.h"

#include "base/ql_settings.h"
#include "math/vec/ql_vec_unit.h"
#include "light/ql_emit_triangle.h"
#include "warp/ql_warp_hemisphere.h"
#include "light/ql_light.h"
#include "trace/ql_bvh.h"
#include "trace/surface/ql_surface_at.h"

/* As cosine_direction() of ql_bsdf.c. Out of line, so that it can be timed. */
QL_NOINLINE ql_vec3_t bench_direction(const bench_warp_t *warp)
{
    const ql_vec3_t n = ql_vec_unit_q29_of_inv_n(warp->n, warp->inv_n);
    const ql_vec3_t d =
            ql_vec_to_dir(ql_warp_hemisphere_cosine(n, warp->u.u1, warp->u.u2));

    return ql_vec_dot_normal(d, warp->n) > 0 ? d : ql_vec_to_dir(n);
}

/* As ql_next_event(), up to the segment it tests. */
static void add_shadow(bench_batch_t *batch, const ql_scene_t *scene,
        const ql_sampler_t *sampler, uint32_t dim, const ql_surface_t *surface)
{
    const ql_uq32_t pick =
            scene->light_count < 2
                    ? 0
                    : ql_sampler_1d(sampler, dim + QL_DIM_LIGHT_PICK);
    const uint16_t light = ql_light_choose(scene, QL_LIGHTS_POWER, pick);
    const ql_uniform2_t u = ql_sampler_2d(sampler, dim + QL_DIM_LIGHT_POINT);
    ql_emit_point_t point;
    ql_ray_t ray;

    ray.origin = surface->p;
    if (ql_emit_triangle_facing(
                scene, light, surface->p, u, &point, &ray.direction) > 0 &&
            ql_vec_dot_normal(ray.direction, surface->n) > 0) {
        batch->shadow[batch->shadow_count++] = ray;
    }
}

/* Does the surface reflect anything that the path still carries? */
static bool reflect(const ql_blob_material_t *material, ql_uq31_t carried[3])
{
    uint32_t any = 0;

    for (unsigned i = 0; i < 3; i++) {
        carried[i] = ql_mul_uq31(carried[i], QL_LE32(material->albedo[i]));
        any |= carried[i];
    }
    return any != 0;
}

/* As ql_path_trace(). */
static void add_path(bench_batch_t *batch, const ql_render_t *render,
        const ql_sampler_t *sampler, ql_ray_t ray)
{
    const ql_scene_t *scene = render->scene;
    ql_uq31_t carried[3] = {QL_UQ31_ONE, QL_UQ31_ONE, QL_UQ31_ONE};

    for (uint8_t bounce = 0;; bounce++) {
        const uint32_t dim = QL_DIM_BOUNCE(bounce);
        bench_warp_t *warp = batch->warps + batch->warp_count;
        ql_surface_t surface;
        ql_hit_t hit;

        batch->closest[batch->closest_count++] = ray;
        if (!ql_bvh_closest_hit(scene, &ray, &hit) ||
                !reflect(ql_scene_material(
                                 scene, scene->triangles + hit.tri_idx),
                        carried)) {
            return;
        }
        ql_surface_at(scene, &ray, &hit, &surface);
        if (scene->light_count > 0) {
            add_shadow(batch, scene, sampler, dim, &surface);
        }
        if (bounce >= render->settings.bounces) {
            return;
        }
        warp->n = surface.n;
        warp->inv_n = surface.inv_n;
        warp->u = ql_sampler_2d(sampler, dim + QL_DIM_DIRECTION);
        batch->warp_count++;
        ray.origin = surface.p;
        ray.direction = bench_direction(warp);
    }
}

/* As ql_render_pixel(), for one sample. */
static void add_sample(bench_batch_t *batch, const ql_render_t *render,
        uint16_t x, uint16_t y, uint32_t sample)
{
    const ql_settings_t *s = &render->settings;
    ql_camera_pixel_t pixel;
    ql_sampler_t sampler;
    ql_uniform2_t u;
    ql_ray_t ray;

    ql_camera_pixel(&pixel, &render->camera, x, y);
    ql_sampler_begin(&sampler, s->sampler, s->seed, x, y);
    ql_sampler_start(&sampler, sample);
    u = ql_sampler_2d(&sampler, QL_DIM_PIXEL);
    if (ql_camera_ray(&pixel, u, u, &ray)) {
        add_path(batch, render, &sampler, ray);
    }
}

bool bench_rays_fill(
        bench_batch_t *batch, const ql_render_t *render, uint32_t *next)
{
    const ql_settings_t *s = &render->settings;
    const uint32_t total = (uint32_t)s->width * s->height * s->spp;

    batch->closest_count = 0;
    batch->shadow_count = 0;
    batch->warp_count = 0;
    batch->path_count = 0;
    while (*next < total &&
            batch->closest_count + BENCH_PATH_RAYS <= batch->capacity) {
        const uint32_t pixel = *next / s->spp;

        add_sample(batch, render, (uint16_t)(pixel % s->width),
                (uint16_t)(pixel / s->width), *next % s->spp);
        batch->path_count++;
        (*next)++;
    }
    return batch->path_count > 0;
}
