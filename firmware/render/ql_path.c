/* ql_path.c - the path loop: what is seen, direct light, next direction */
/* SPDX-License-Identifier: MIT */

/* A vertex draws up to two rays. One leads on, by the density of the indirect
 * estimator; one looks for emitters, by the density of the direct strategy if
 * that draws directions. Where both densities are the same, one ray does both.
 * A mirror and glass have only one way to see an emitter, so there every
 * strategy looks along it. */

#include "render/ql_path.h"

#include "material/ql_diffuse.h"
#include "trace/ql_bvh.h"
#include "trace/ql_surface_at.h"

/* Density by which a strategy looks for emitters; NONE if it does not. */
static ql_density_t looks_by(const ql_settings_t *s)
{
#if QL_CFG_STRATEGIES
    switch (s->direct) {
    case QL_DIRECT_HEMISPHERE:
        return QL_DENSITY_UNIFORM;
    case QL_DIRECT_COSINE:
        return QL_DENSITY_COSINE;
    case QL_DIRECT_MIS:
        return QL_DENSITY_BRDF;
    default:
        return QL_DENSITY_NONE;
    }
#else
    (void)s;
    return QL_DENSITY_NONE;
#endif
}

#if QL_CFG_LIGHTS
/* Does it draw points or directions towards emitters? */
static bool aims(const ql_path_t *path)
{
    const unsigned direct = path->settings->direct;

    return path->scene->light_count > 0 &&
           (direct == QL_DIRECT_AREA ||
                   (QL_CFG_STRATEGIES && (direct == QL_DIRECT_SOLID_ANGLE ||
                                                 direct == QL_DIRECT_MIS)));
}
#endif

#if QL_CFG_STRATEGIES
/* Are two densities one on this surface? */
static bool same_density(const ql_bsdf_t *bsdf, ql_density_t a, ql_density_t b)
{
    if (!ql_bsdf_has_nonspecular(bsdf)) {
        return true;
    }
    if (!ql_bsdf_is_glossy(bsdf)) {
        a = a == QL_DENSITY_BRDF ? QL_DENSITY_COSINE : a;
        b = b == QL_DENSITY_BRDF ? QL_DENSITY_COSINE : b;
    }
    return a == b;
}
#endif

/* A vertex of the path. */
typedef struct {
    uint32_t dim;     /* QL_DIM_BOUNCE(k) */
    uint16_t tri_idx; /* what was hit */
    ql_surface_t surface;
    ql_bsdf_t bsdf;
    const ql_rgb_t *carried; /* throughput up to here */
    ql_rgb_t reflected;      /* times the diffuse albedo */
} vertex_t;

/* A ray, what it carries and what it may see. */
typedef struct {
    ql_ray_t ray;
    ql_rgb_t carried;
    ql_sight_t sight;
    bool delta; /* it is a mirror's or glass's only way */
} way_t;

/* Draw a way from a vertex by some density; false if the light is lost. look is
 * 0, or 1 for the numbers of a second way. */
static bool draw(const ql_path_t *path, const vertex_t *v, ql_density_t density,
        uint32_t look, way_t *way)
{
    const bool shares = QL_CFG_STRATEGIES && density == QL_DENSITY_BRDF &&
                        path->settings->direct == QL_DIRECT_MIS;
    const ql_uniform2_t u = ql_sampler_2d(
            path->sampler, v->dim + (look ? QL_DIM_LOOK : QL_DIM_DIRECTION));
    const uint32_t choice =
            v->dim + (look ? QL_DIM_LOOK_CHOICE : QL_DIM_CHOICE);
    ql_bsdf_sample_t sample;
    ql_real_t pdf;

    if (ql_bsdf_is_flat_diffuse(&v->bsdf) && !shares &&
            !ql_density_is_uniform(density)) {
        way->ray.origin = v->surface.p;
        way->ray.direction = ql_diffuse_direction(&v->surface, u);
        way->carried = v->reflected;
        way->delta = false;
        way->sight.kind = QL_SIGHT_ALL;
        return true;
    }
    if (!ql_bsdf_sample(&v->bsdf, density,
                ql_bsdf_is_glossy(&v->bsdf)
                        ? ql_sampler_1d(path->sampler, choice)
                        : 0,
                u, &sample, shares ? &pdf : NULL)) {
        return false;
    }
    way->ray.origin = v->surface.p;
#if QL_CFG_GLASS
    if (sample.through) {
        ql_surface_cross(
                path->scene, v->tri_idx, &v->surface, &way->ray.origin);
    }
#endif
    way->ray.direction = sample.wi;
    if (!ql_bsdf_is_glossy(&v->bsdf) && !ql_density_is_uniform(density)) {
        way->carried = v->reflected; /* the weight is the albedo */
    } else {
        way->carried = *v->carried;
        ql_rgb_mul(&way->carried, &sample.weight);
    }
    way->delta = sample.specular;
    way->sight.kind = QL_SIGHT_ALL;
#if QL_CFG_STRATEGIES
    if (shares && !sample.specular) {
        way->sight.kind = QL_SIGHT_SHARE;
        way->sight.pdf = pdf;
        way->sight.from = &v->surface;
    }
#endif
    return ql_rgb_most(&way->carried) != 0;
}

/* Follow a ray to what it meets and add what it sees; false if it leaves. */
static bool follow(const ql_path_t *path, const way_t *way, ql_hit_t *hit)
{
    QL_DIAG_COUNT(path->diag, closest_rays);
    if (!ql_bvh_closest_hit(path->scene, &way->ray, hit)) {
        ql_direct_sky(path, &way->sight, &way->carried, &way->ray);
        return false;
    }
    if (way->sight.kind != QL_SIGHT_NONE) {
        ql_direct_seen(path, &way->sight, &way->carried, &way->ray, hit);
    }
    return true;
}

#if QL_CFG_STRATEGIES
/* A second way, only to look for emitters. */
static QL_NOINLINE void look_around(
        const ql_path_t *path, const vertex_t *v, ql_density_t density)
{
    way_t way;
    ql_hit_t hit;

    if (draw(path, v, density, 1, &way)) {
        (void)follow(path, &way, &hit);
    }
}

/* Russian roulette: go on with the chance of the largest channel, if that is
 * below 1, and divide by it. Exact: the chance is the integer compared with. */
static QL_NOINLINE bool survives(
        const ql_path_t *path, const vertex_t *v, way_t *way)
{
    const ql_uniform2_t u =
            ql_sampler_2d(path->sampler, v->dim + QL_DIM_CHOICE);
    const uint32_t most = ql_rgb_most(&way->carried);
    const int down = -way->carried.e;
    ql_uq31_t chance = QL_UQ31_ONE;
    ql_real_t inverse;

    if (down > 0) {
        chance = down > 30 ? 1 : most >> down;
    } else if (most >> (31 + down > 0 ? 31 + down : 0) == 0) {
        chance = most << -down; /* below 1 */
    }
    chance = chance == 0 ? 1 : chance;
    if (chance >= QL_UQ31_ONE) {
        return true;
    }
    if (u.u2 >> 1 >= chance) {
        return false;
    }
    inverse = ql_real_recip(ql_real_from_u64(chance));
    ql_rgb_scale(&way->carried, ql_real_scale(inverse, 31));
    return true;
}
#endif

/* How a path goes on after a vertex. */
typedef struct {
    uint8_t bounce;
    bool last; /* the ray only looks for emitters */
    bool seen; /* so far there were mirrors and glass only: as if one looked */
} state_t;

/* Draw the next ray of the path; false if there is none. */
static bool go_on(
        const ql_path_t *path, const vertex_t *v, state_t *state, way_t *way)
{
    const ql_settings_t *s = path->settings;
    const ql_density_t look = looks_by(s);
    ql_density_t density = QL_CFG_INDIRECT && state->bounce < s->bounces
                                   ? (ql_density_t)s->indirect
                                   : QL_DENSITY_NONE;
    const bool mirror = ql_bsdf_has_specular(&v->bsdf) &&
                        (s->direct != QL_DIRECT_NONE || state->seen);
    bool apart = false;

    if (density == QL_DENSITY_NONE) {
        const bool spread =
                look != QL_DENSITY_NONE && ql_bsdf_has_nonspecular(&v->bsdf);

        state->last = true;
        return (spread || mirror) &&
               draw(path, v, spread ? look : QL_DENSITY_SPECULAR, 0, way);
    }
#if QL_CFG_STRATEGIES
    apart = look != QL_DENSITY_NONE && !same_density(&v->bsdf, look, density);
    if (apart) {
        look_around(path, v, look);
    } else if (look != QL_DENSITY_NONE) {
        density = look;
    }
#endif
    if (!draw(path, v, density, 0, way)) {
        return false;
    }
    if (apart || (way->delta ? !mirror : look == QL_DENSITY_NONE)) {
        way->sight.kind = QL_SIGHT_NONE;
    }
    state->seen = state->seen && way->delta;
#if QL_CFG_STRATEGIES
    return !s->roulette || survives(path, v, way);
#else
    return true;
#endif
}

/* Make a vertex of a hit; false if it reflects nothing. */
static bool arrive(const ql_path_t *path, const way_t *way, const ql_hit_t *hit,
        uint8_t bounce, vertex_t *v)
{
    const ql_scene_t *scene = path->scene;
    const ql_blob_material_t *material =
            ql_scene_material(scene, scene->triangles + hit->tri_idx);

    v->reflected = way->carried;
    ql_rgb_filter(&v->reflected, material->albedo);
    if (ql_scene_gloss(scene, material) == NULL &&
            ql_rgb_most(&v->reflected) == 0) {
        if ((material->albedo[0] | material->albedo[1] | material->albedo[2]) !=
                0) {
            QL_DIAG_COUNT(path->diag, faint);
        }
        return false;
    }
    v->carried = &way->carried;
    v->dim = QL_DIM_BOUNCE(bounce);
    v->tri_idx = hit->tri_idx;
    ql_surface_at(scene, &way->ray, hit, &v->surface);
    ql_bsdf_begin(&v->bsdf, scene, &v->surface, material, hit->front,
            way->ray.direction);
    return true;
}

/* What the camera's ray carries and sees: all. */
static void begin(ql_rgb_t *carried, ql_sight_t *sight)
{
    carried->c[0] = carried->c[1] = carried->c[2] = QL_UQ31_ONE;
    carried->e = 0;
    sight->kind = QL_SIGHT_ALL;
}

void ql_path_trace(const ql_path_t *path, const ql_ray_t *camera_ray)
{
    state_t state = {0, false, true};
    vertex_t v;
    ql_hit_t hit;
    way_t way;

    QL_DIAG_COUNT(path->diag, paths);
    way.ray = *camera_ray;
    begin(&way.carried, &way.sight);
    for (;; state.bounce++) {
        if (!follow(path, &way, &hit) || state.last ||
                !arrive(path, &way, &hit, state.bounce, &v)) {
            return;
        }
#if QL_CFG_LIGHTS
        if (aims(path) && ql_bsdf_has_nonspecular(&v.bsdf)) {
            ql_direct_light(path, v.dim, &v.bsdf, v.carried, &v.reflected);
        }
#endif
        if (!go_on(path, &v, &state, &way)) {
            return;
        }
    }
}

void ql_path_miss(const ql_path_t *path, const ql_ray_t *camera_ray)
{
    ql_rgb_t carried;
    ql_sight_t sight;

    begin(&carried, &sight);
    ql_direct_sky(path, &sight, &carried, camera_ray);
}
