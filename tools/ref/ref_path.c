/* ref_path.c - camera, path loop and direct light, with the core's decisions */
/* SPDX-License-Identifier: MIT */

/* Which rays are drawn, what each may see and which random numbers it takes is
 * as in render/ql_path.c and render/ql_next_event.c. */

#include "ref/ref_parts.h"
#include "light/ql_light.h"

typedef enum { SEES_NOTHING, SEES_ALL, SEES_A_SHARE } sight_t;

/* A ray, what it carries and what it may see. */
typedef struct {
    ref_ray_t ray;
    double carried[3];
    sight_t sight;
    double part;         /* 1/N of what it sees, if it is one of N */
    double pdf;          /* of its direction, for its share */
    ref_surface_t begun; /* where it began, for its share */
    bool delta;
} way_t;

/* One sample of one pixel. */
typedef struct {
    const ref_scene_t *scene;
    const ql_settings_t *settings;
    ql_sampler_t sampler;
    double *rgb;
    ref_stats_t *stats;
    bool first; /* the camera's ray is followed */
} path_t;

typedef struct {
    uint32_t dim;
    ref_surface_t surface;
    ref_bsdf_t bsdf;
    double carried[3]; /* before it */
} vertex_t;

typedef struct {
    unsigned bounce;
    bool seen; /* so far there were mirrors and glass only */
} state_t;

static double largest(const double rgb[3])
{
    return fmax(rgb[0], fmax(rgb[1], rgb[2]));
}

/* carried by something, as rounded. */
static double product(const path_t *path, double carried, double by)
{
    const ref_rounding_t *rounding = path->scene->rounding;
    double result = carried * by;

    if (rounding != NULL && rounding->product != NULL) {
        rounding->product(rounding->data, carried, by, &result);
    }
    return result;
}

/* Add to a channel. */
static void put(path_t *path, unsigned k, double light)
{
    const ref_rounding_t *rounding = path->scene->rounding;

    if (rounding != NULL && rounding->contribution != NULL) {
        rounding->contribution(rounding->data, &light);
    }
    path->rgb[k] += light;
}

/* Add a contribution, as much of it as --clamp lets; all of what the camera
 * sees itself. */
static void deposit(path_t *path, const double light[3])
{
    const double limit = ldexp(path->settings->clamp_q16, -16);
    const double most = largest(light) * path->scene->unit;
    const double part =
            limit > 0 && !path->first && most > limit ? limit / most : 1;

    for (unsigned k = 0; k < 3; k++) {
        put(path, k, light[k] * part);
    }
}

static void add(path_t *path, const double carried[3], const double value[3],
        double scale)
{
    double light[3];

    for (unsigned k = 0; k < 3; k++) {
        light[k] = product(path, carried[k], value[k]) * scale;
    }
    deposit(path, light);
}

static void tell(const path_t *path, uint32_t what)
{
    const ref_rounding_t *rounding = path->scene->rounding;

    if (rounding != NULL && rounding->met != NULL) {
        rounding->met(rounding->data, what);
    }
}

/* ---- Direct light ------------------------------------------------------- */

/* The share of a ray that met a light, or the sky: hit is NULL then. */
static double share_of(const path_t *path, const way_t *way, int32_t light,
        const ref_hit_t *hit)
{
    double ratio;

    if (way->sight != SEES_A_SHARE || light < 0) {
        return way->part;
    }
    ratio = way->pdf *
            ref_aim_inverse(path->scene, &way->begun, way->ray.direction, hit) /
            ref_light_chance(path->scene, path->settings, (uint32_t)light);
    return ratio > 0 ? ratio / (1 + ratio) : 1;
}

static void see_sky(path_t *path, const way_t *way)
{
    double emission[3];

    if (path->scene->blob->sky == NULL || way->sight == SEES_NOTHING) {
        return;
    }
    ref_sky(path->scene, way->ray.direction, emission);
    add(path, way->carried, emission,
            share_of(path, way, path->scene->blob->light_count - 1, NULL));
}

static void see_shape(path_t *path, const way_t *way, const ref_hit_t *hit)
{
    const ref_shape_t *shape = path->scene->shapes + hit->shape;

    if (way->sight != SEES_NOTHING && largest(shape->material->emission) > 0 &&
            (hit->front || path->scene->blob->two_sided)) {
        add(path, way->carried, shape->material->emission,
                share_of(path, way, shape->light, hit));
    }
}

/* Follow a ray to what it meets and add what it sees; false if it leaves. */
static bool follow(path_t *path, const way_t *way, ref_hit_t *hit)
{
    path->stats->closest_rays++;
    if (!ref_closest(path->scene, &way->ray, hit)) {
        tell(path, REF_NOWHERE);
        see_sky(path, way);
        return false;
    }
    tell(path, hit->shape);
    see_shape(path, way, hit);
    return true;
}

/* Add what a vertex reflects of the light from a direction. */
static void reflect(
        path_t *path, const vertex_t *v, const ref_aim_t *aim, double inverse)
{
    const ref_rounding_t *rounding = path->scene->rounding;
    const ref_material_t *material = v->bsdf.material;
    double diffuse, lobe, light[3];

    if (rounding != NULL && rounding->geometry != NULL) {
        rounding->geometry(rounding->data, &v->surface, aim, &inverse);
    }
    ref_bsdf_reflect(&v->bsdf, aim->w, inverse,
            path->settings->direct == QL_DIRECT_MIS, &diffuse, &lobe);
    for (unsigned k = 0; k < 3; k++) {
        const double albedo = product(path, v->carried[k], material->albedo[k]);
        const double specular = v->carried[k] * material->specular[k];

        light[k] = product(path, albedo, aim->emission[k]) * diffuse +
                   specular * aim->emission[k] * lobe;
    }
    deposit(path, light);
}

/* One sample of one light. */
static void ask(path_t *path, uint32_t dim, const vertex_t *v, uint32_t light)
{
    const ql_settings_t *s = path->settings;
    const ql_uniform2_t u =
            ql_sampler_2d(&path->sampler, dim + QL_DIM_LIGHT_POINT);
    bool blocked;
    ref_aim_t aim;
    ref_ray_t ray;

    if (!ref_aim(path->scene, s->direct, light, &v->surface, u, &aim)) {
        return;
    }
    ray = ref_leave(&v->surface, aim.w, REF_ABOVE);
    if (aim.shape == REF_NOWHERE) {
        path->stats->closest_rays++;
    } else {
        path->stats->shadow_rays++;
    }
    blocked = ref_blocked(path->scene, &ray, aim.distance, aim.shape);
    if (!blocked && path->scene->blob->ranks != NULL &&
            aim.shape != REF_NOWHERE) {
        ref_hit_t hit; /* another may be in its place */

        path->stats->closest_rays++;
        blocked =
                !ref_closest(path->scene, &ray, &hit) || hit.shape != aim.shape;
    }
    tell(path, blocked);
    if (!blocked) {
        reflect(path, v, &aim,
                aim.inverse / ref_light_chance(path->scene, s, light));
    }
}

static bool aims(const path_t *path)
{
    const unsigned direct = path->settings->direct;

    return path->scene->blob->light_count > 0 &&
           (direct == QL_DIRECT_AREA || direct == QL_DIRECT_SOLID_ANGLE ||
                   direct == QL_DIRECT_MIS);
}

static void direct_light(path_t *path, const vertex_t *v)
{
    const ql_settings_t *s = path->settings;
    const ql_scene_t *blob = path->scene->blob;
    const unsigned asked = s->lights == QL_LIGHTS_ALL ? blob->light_count : 1;
    uint32_t dim = v->dim;

    for (unsigned light = 0; light < asked; light++) {
        for (unsigned i = 0; i < s->light_samples; i++) {
            const uint32_t pick =
                    ql_sampler_1d(&path->sampler, dim + QL_DIM_LIGHT_PICK);

            ask(path, dim, v,
                    s->lights == QL_LIGHTS_ALL
                            ? light
                            : ql_light_choose(blob, s->lights, pick));
            dim += QL_DIMS_A_SAMPLE;
        }
    }
}

/* ---- The next ray ------------------------------------------------------- */

/* Density by which a strategy looks for emitters. */
static ql_density_t looks_by(const ql_settings_t *s)
{
    return s->direct == QL_DIRECT_HEMISPHERE ? QL_DENSITY_UNIFORM
           : s->direct == QL_DIRECT_COSINE   ? QL_DENSITY_COSINE
           : s->direct == QL_DIRECT_MIS      ? QL_DENSITY_BRDF
                                             : QL_DENSITY_NONE;
}

/* By how many ways a vertex does, whose mean counts. */
static unsigned looks_of(const ql_settings_t *s, const vertex_t *v)
{
    const ql_density_t look = looks_by(s);

    return (look == QL_DENSITY_UNIFORM || look == QL_DENSITY_COSINE) &&
                           ref_bsdf_has_spread(&v->bsdf)
                   ? s->light_samples
                   : 1;
}

/* The numbers of a vertex that a way is drawn by, of its first or its second
 * one; of the i-th that looks for emitters. */
typedef struct {
    uint32_t direction, choice;
} numbers_t;

static const numbers_t first_numbers = {QL_DIM_DIRECTION, QL_DIM_CHOICE};
static const numbers_t second_numbers = {QL_DIM_LOOK, QL_DIM_LOOK_CHOICE};

/* Draw a way from a vertex. */
static bool draw(const path_t *path, const vertex_t *v, ql_density_t density,
        ref_lobes_t lobes, numbers_t numbers, way_t *way)
{
    const ql_uniform2_t u =
            ql_sampler_2d(&path->sampler, v->dim + numbers.direction);
    const uint32_t pick =
            ql_sampler_1d(&path->sampler, v->dim + numbers.choice);
    ref_bsdf_sample_t sample;

    if (!ref_bsdf_sample(&v->bsdf, density, lobes, pick, u, &sample)) {
        return false;
    }
    way->ray = ref_leave(&v->surface, sample.direction, sample.side);
    for (unsigned k = 0; k < 3; k++) {
        way->carried[k] = product(path, v->carried[k], sample.weight[k]);
    }
    way->delta = sample.delta;
    way->sight = SEES_ALL;
    way->part = 1.0 / looks_of(path->settings, v);
    if (density == QL_DENSITY_BRDF && !sample.delta &&
            path->settings->direct == QL_DIRECT_MIS) {
        way->sight = SEES_A_SHARE;
        way->pdf = sample.pdf;
        way->begun = v->surface;
    }
    return largest(way->carried) > 0;
}

/* Draw ways that only look for emitters and follow them. */
static void look_around(path_t *path, const vertex_t *v, ql_density_t density,
        ref_lobes_t lobes, numbers_t numbers, unsigned count)
{
    for (unsigned i = 0; i < count; i++) {
        ref_hit_t hit;
        way_t way;

        if (draw(path, v, density, lobes, numbers, &way)) {
            (void)follow(path, &way, &hit);
        }
        numbers.direction += QL_DIMS_A_SAMPLE;
        numbers.choice += QL_DIMS_A_SAMPLE;
    }
}

static bool same_density(const ref_bsdf_t *bsdf, ql_density_t a, ql_density_t b)
{
    if (!ref_bsdf_has_spread(bsdf)) {
        return true;
    }
    if (bsdf->material->kind == 0) {
        a = a == QL_DENSITY_BRDF ? QL_DENSITY_COSINE : a;
        b = b == QL_DENSITY_BRDF ? QL_DENSITY_COSINE : b;
    }
    return a == b;
}

/* Russian roulette, with the chance of the largest channel. */
static bool survives(const path_t *path, const vertex_t *v, way_t *way)
{
    const ql_uniform2_t u =
            ql_sampler_2d(&path->sampler, v->dim + QL_DIM_CHOICE);
    const double chance = largest(way->carried);

    if (!path->settings->roulette || chance >= 1) {
        return true;
    }
    for (unsigned k = 0; k < 3; k++) {
        way->carried[k] /= chance;
    }
    return ref_midpoint(u.u2) < chance;
}

/* Draw the next ray of the path; false if there is none. */
static bool go_on(path_t *path, const vertex_t *v, state_t *state, way_t *way)
{
    const ql_settings_t *s = path->settings;
    const ql_density_t look = looks_by(s);
    const unsigned looks = looks_of(s, v);
    const bool mirror = ref_bsdf_has_delta(&v->bsdf) &&
                        (s->direct != QL_DIRECT_NONE || state->seen);
    ql_density_t density = state->bounce < s->bounces
                                   ? (ql_density_t)s->indirect
                                   : QL_DENSITY_NONE;
    bool apart;

    if (density == QL_DENSITY_NONE) {
        const bool spread =
                look != QL_DENSITY_NONE && ref_bsdf_has_spread(&v->bsdf);

        if (spread) {
            look_around(path, v, look, REF_LOBES_ALL, first_numbers, looks);
        } else if (mirror) {
            look_around(path, v, look, REF_LOBES_DELTA, first_numbers, 1);
        }
        return false;
    }
    apart = look != QL_DENSITY_NONE && !same_density(&v->bsdf, look, density);
    if (look != QL_DENSITY_NONE) {
        look_around(path, v, look, REF_LOBES_ALL, second_numbers,
                apart ? looks : looks - 1);
        density = apart ? density : look;
    }
    if (!draw(path, v, density, REF_LOBES_ALL, first_numbers, way)) {
        return false;
    }
    if (apart || (way->delta ? !mirror : look == QL_DENSITY_NONE)) {
        way->sight = SEES_NOTHING;
    }
    state->seen = state->seen && way->delta;
    return survives(path, v, way);
}

/* ---- The path ----------------------------------------------------------- */

/* Make a vertex of a hit; false if it reflects nothing. */
static bool arrive(const path_t *path, const way_t *way, const ref_hit_t *hit,
        unsigned bounce, vertex_t *v)
{
    const ref_material_t *material = path->scene->shapes[hit->shape].material;

    if (material->kind == 0 && largest(material->albedo) <= 0) {
        return false;
    }
    for (unsigned k = 0; k < 3; k++) {
        v->carried[k] = way->carried[k];
    }
    v->dim = QL_DIM_BOUNCE(bounce);
    ref_surface_at(path->scene, &way->ray, hit, &v->surface);
    ref_bsdf_begin(&v->bsdf, path->scene->rounding, &v->surface, material,
            hit->front, way->ray.direction);
    return true;
}

static void trace(path_t *path, way_t *way)
{
    state_t state = {0, true};
    vertex_t v;
    ref_hit_t hit;
    bool met;

    path->stats->paths++;
    for (;; state.bounce++) {
        path->first = state.bounce == 0;
        met = follow(path, way, &hit);
        path->first = false;
        if (!met || !arrive(path, way, &hit, state.bounce, &v)) {
            return;
        }
        if (aims(path) && ref_bsdf_has_spread(&v.bsdf)) {
            direct_light(path, &v);
        }
        if (!go_on(path, &v, &state, way)) {
            return;
        }
    }
}

/* The ray through a point of the picture's plane, and of the lens. */
static ref_ray_t camera_ray(
        const ref_scene_t *scene, double x, double y, ref_vec_t lens)
{
    ref_ray_t ray;

    ray.origin = ref_along(ref_along(scene->p, scene->pr, x), scene->pu, y);
    ray.direction = ref_along(ref_along(scene->d, scene->dr, x), scene->du, y);
    ray.origin = ref_along(ray.origin, scene->lens_p[0], lens.x);
    ray.origin = ref_along(ray.origin, scene->lens_p[1], lens.y);
    ray.direction = ref_along(ray.direction, scene->lens_d[0], lens.x);
    ray.direction = ref_along(ray.direction, scene->lens_d[1], lens.y);
    ray.direction = ref_unit(ray.direction);
    ray.from = REF_NOWHERE;
    ray.inside = false;
    return ray;
}

void ref_pixel(const ref_scene_t *scene, const ql_settings_t *settings,
        uint16_t x, uint16_t y, uint32_t first, uint32_t count, double rgb[3],
        ref_stats_t *stats)
{
    path_t path = {
            .scene = scene, .settings = settings, .rgb = rgb, .stats = stats};

    ql_sampler_begin(&path.sampler, settings->sampler, settings->seed, x, y);
    for (uint32_t i = 0; i < count; i++) {
        way_t way = {.carried = {1, 1, 1}, .sight = SEES_ALL, .part = 1};
        ql_uniform2_t u, on_lens;

        ql_sampler_start(&path.sampler, first + i);
        u = ql_sampler_2d(&path.sampler, QL_DIM_PIXEL);
        on_lens = ql_sampler_2d(&path.sampler, QL_DIM_LENS);
        way.ray = camera_ray(scene,
                (2 * (x + ref_midpoint(u.u1)) - settings->width) /
                        settings->height,
                1 - 2 * (y + ref_midpoint(u.u2)) / settings->height,
                ref_warp_disk(
                        ref_midpoint(on_lens.u1), ref_midpoint(on_lens.u2)));
        if (scene->rounding != NULL && scene->rounding->camera != NULL) {
            scene->rounding->camera(
                    scene->rounding->data, x, y, &path.sampler, &way.ray);
        }
        trace(&path, &way);
    }
}
