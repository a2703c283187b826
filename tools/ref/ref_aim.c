/* ref_aim.c - directions towards triangles, spheres and the sky */
/* SPDX-License-Identifier: MIT */

#include "ref/ref_parts.h"
#include "sample/ql_table.h"
#include "light/ql_light.h"

double ref_light_chance(
        const ref_scene_t *scene, const ql_settings_t *s, uint32_t light)
{
    const ql_scene_t *blob = scene->blob;
    const uint64_t whole = (uint64_t)1 << 32, n = blob->light_count;
    uint64_t share = whole;

    if (s->lights == QL_LIGHTS_UNIFORM) {
        share = ((light + 1) * whole + n - 1) / n - (light * whole + n - 1) / n;
    } else if (s->lights == QL_LIGHTS_POWER) {
        share = light + 1 < n ? QL_LE32(blob->lights[light + 1].cum) : whole;
        share -= QL_LE32(blob->lights[light].cum);
    }
    return ldexp((double)share, -32) * s->light_samples;
}

/* ---- Triangles ---------------------------------------------------------- */

static bool aim_point(const ref_scene_t *scene, const ref_shape_t *shape,
        const ref_surface_t *surface, double u1, double u2, ref_aim_t *aim)
{
    const ref_rounding_t *rounding = scene->rounding;
    ref_vec_t to;
    double b1, b2, facing;

    ref_warp_triangle(u1, u2, &b1, &b2);
    to = ref_along(ref_along(shape->corner, shape->e1, b1), shape->e2, b2);
    to = ref_sub(to, surface->p);
    if (rounding != NULL && rounding->light_point != NULL) {
        rounding->light_point(rounding->data, surface, shape, u1, u2, &to);
    }
    facing = -ref_dot(to, shape->n); /* 2 area cos' r */
    facing = scene->blob->two_sided ? fabs(facing) : facing;
    aim->distance = ref_length(to);
    aim->w = ref_scale(to, 1 / aim->distance);
    aim->inverse = facing / (2 * pow(aim->distance, 3));
    return facing > 0;
}

/* 1 if done, 0 if nothing comes from there, -1 if it is drawn by points. */
static int aim_spherical(const ref_shape_t *shape, bool two_sided,
        const ref_surface_t *surface, double u1, double u2, ref_aim_t *aim)
{
    const ref_vec_t from = ref_sub(shape->corner, surface->p);
    const ref_vec_t corner[3] = {
            from, ref_add(from, shape->e1), ref_add(from, shape->e2)};
    double height = -ref_dot(from, shape->n);

    height = two_sided ? fabs(height) : height;
    if (height <= 0) {
        return 0;
    }
    if (!ref_warp_spherical(corner, u1, u2, &aim->w, &aim->inverse)) {
        return -1;
    }
    aim->distance = height / fabs(ref_dot(aim->w, shape->n));
    return 1;
}

/* ---- Spheres ------------------------------------------------------------ */

/* Where a surface is: 1 outside of a sphere, -1 inside, 0 on its outside. */
static int side_of(const ref_shape_t *shape, const ref_surface_t *surface,
        uint32_t index, double *square)
{
    const ref_vec_t s = ref_sub(surface->p, shape->corner);

    *square = ref_dot(s, s);
    if (surface->shape == index) {
        return surface->inside ? -1 : 0;
    }
    return *square > shape->radius * shape->radius ? 1 : -1;
}

/* 1 - cos of the cone that a sphere fills. */
static double cone_of(const ref_shape_t *shape, double square)
{
    const double ratio = shape->radius * shape->radius / square;

    return ratio / (1 + sqrt(1 - ratio));
}

/* 1 / the density of a direction proportional to the cosine. */
static double cosine_inverse(const ref_surface_t *surface, ref_vec_t w)
{
    const double cosine = ref_dot(w, surface->shade);

    return cosine > 0 ? REF_PI / cosine : 0;
}

/* A uniform point of a sphere. */
static bool aim_ball_area(const ref_shape_t *shape, int side,
        const ref_surface_t *surface, double u1, double u2, ref_aim_t *aim)
{
    const ref_vec_t out = ref_warp_sphere(u1, u2);
    const ref_vec_t to =
            ref_sub(ref_along(shape->corner, out, shape->radius), surface->p);
    const double facing = -side * ref_dot(to, out);

    aim->distance = ref_length(to);
    aim->w = ref_scale(to, 1 / aim->distance);
    aim->inverse = 4 * REF_PI * shape->radius * shape->radius * facing /
                   pow(aim->distance, 3);
    return facing > 0;
}

/* How far a sphere is along a direction that meets it. */
static double way_to(const ref_shape_t *shape, const ref_surface_t *surface,
        int side, ref_vec_t w)
{
    const ref_vec_t s = ref_sub(surface->p, shape->corner);
    const double way = ref_dot(s, w);
    const ref_vec_t aside = ref_along(s, w, -way);
    const double root = sqrt(
            fmax(0, shape->radius * shape->radius - ref_dot(aside, aside)));

    return -way - side * root;
}

static bool aim_ball(const ref_shape_t *shape, uint32_t index, bool two_sided,
        unsigned direct, const ref_surface_t *surface, double u1, double u2,
        ref_aim_t *aim)
{
    double square;
    const int side = side_of(shape, surface, index, &square);

    if (side == 0 || (side < 0 && !two_sided)) {
        return false;
    }
    if (direct == QL_DIRECT_AREA) {
        return aim_ball_area(shape, side, surface, u1, u2, aim);
    }
    if (side > 0) {
        const ref_vec_t towards = ref_unit(ref_sub(shape->corner, surface->p));
        const double s_max = cone_of(shape, square);

        aim->w = ref_warp_about(NULL, towards, u1 * s_max, u2);
        aim->inverse = 2 * REF_PI * s_max;
    } else {
        aim->w = ref_warp_cosine(surface->shade, u1, u2);
        aim->inverse = cosine_inverse(surface, aim->w);
    }
    aim->distance = way_to(shape, surface, side, aim->w);
    return true;
}

/* ---- The sky ------------------------------------------------------------ */

/* The map's distribution: a row for v, then one for u of each of its cells. */
typedef struct {
    const uint16_t *words;
    uint16_t width, height;
} map_t;

static map_t map_of(const ref_scene_t *scene)
{
    const ql_scene_t *blob = scene->blob;
    const ql_blob_distribution_t *from =
            blob->tables + QL_LE16(blob->sky->table);
    map_t map;

    map.words = blob->words + QL_LE32(from->first);
    map.width = QL_LE16(from->count[0]);
    map.height = QL_LE16(from->count[1]);
    return map;
}

static void texel(const ref_scene_t *scene, const map_t *map, uint32_t column,
        uint32_t row, double emission[3])
{
    const uint32_t packed =
            QL_LE32(scene->blob->texels[row * map->width + column].rgb9e5);

    for (unsigned k = 0; k < 3; k++) {
        emission[k] = ldexp(packed >> 9 * k & 511u, (int)(packed >> 27) - 32);
    }
}

/* Where a cell begins, of 65536. */
static uint32_t bound(const uint16_t *row, uint32_t cell)
{
    return cell == 0 ? 0 : cell < QL_LE16(row[0]) ? QL_LE16(row[cell]) : 65536u;
}

/* Draw from a row: 0..1 along all of it. */
static double pick(const uint16_t *row, uint16_t count, uint32_t u,
        uint16_t *cell, double *density)
{
    uint32_t rest, mass;

    *cell = ql_table_pick(row, u, &rest, &mass);
    *density *= mass / 65536.0 * count;
    return (*cell + (ref_midpoint(u) * 65536 - bound(row, *cell)) / mass) /
           count;
}

static bool aim_map(const ref_scene_t *scene, ql_uniform2_t u, ref_aim_t *aim)
{
    const map_t map = map_of(scene);
    double density = 1, theta, phi;
    uint16_t row, column;

    theta = REF_PI * pick(map.words, map.height, u.u2, &row, &density);
    phi = pick(map.words + map.height + (size_t)row * map.width, map.width,
            u.u1, &column, &density);
    phi = 2 * REF_PI *
          (phi + ldexp((double)QL_LE32(scene->blob->sky->rotate), -32));
    texel(scene, &map, column, row, aim->emission);
    aim->w.x = sin(theta) * sin(phi);
    aim->w.y = cos(theta);
    aim->w.z = sin(theta) * cos(phi);
    aim->inverse = 2 * REF_PI * REF_PI * sin(theta) / density;
    return true;
}

/* The cell that holds a fraction of a row. */
static uint32_t cell_of(double x, uint16_t count)
{
    const double cell = floor((x - floor(x)) * count);

    return cell < count ? (uint32_t)cell : count - 1u;
}

/* Radiance of the map, and 1 / the density of aim_map(). */
static double look_up(const ref_scene_t *scene, ref_vec_t w, double emission[3])
{
    const map_t map = map_of(scene);
    const double flat = hypot(w.x, w.z);
    const double v = atan2(flat, w.y) / REF_PI;
    const double u = atan2(w.x, w.z) / (2 * REF_PI) -
                     ldexp((double)QL_LE32(scene->blob->sky->rotate), -32);
    const uint32_t row = v < 1 ? cell_of(v, map.height) : map.height - 1u;
    const uint32_t column = cell_of(u, map.width);
    const uint16_t *words = map.words + map.height + (size_t)row * map.width;
    double mass = bound(map.words, row + 1) - bound(map.words, row);

    texel(scene, &map, column, row, emission);
    if (mass > 0) { /* below a cell without mass there may be anything */
        mass *= bound(words, column + 1) - bound(words, column);
    }
    mass *= ldexp((double)map.width * map.height, -32);
    return mass > 0 ? 2 * REF_PI * REF_PI * flat / mass : 0;
}

void ref_sky(const ref_scene_t *scene, ref_vec_t w, double emission[3])
{
    if (scene->blob->texels != NULL) {
        (void)look_up(scene, w, emission);
        return;
    }
    for (unsigned k = 0; k < 3; k++) {
        emission[k] = scene->sky[k];
    }
}

static bool aim_sky(const ref_scene_t *scene, const ref_surface_t *surface,
        ql_uniform2_t u, ref_aim_t *aim)
{
    aim->distance = HUGE_VAL;
    aim->shape = REF_NOWHERE;
    if (scene->blob->texels != NULL) {
        return aim_map(scene, u, aim);
    }
    aim->w = ref_warp_cosine(
            surface->shade, ref_midpoint(u.u1), ref_midpoint(u.u2));
    aim->inverse = cosine_inverse(surface, aim->w);
    ref_sky(scene, aim->w, aim->emission);
    return true;
}

/* ---- Any ---------------------------------------------------------------- */

static bool aim_shape(const ref_scene_t *scene, unsigned direct, uint32_t index,
        const ref_surface_t *surface, ql_uniform2_t u, ref_aim_t *aim)
{
    const ref_shape_t *shape = scene->shapes + index;
    const bool two_sided = scene->blob->two_sided;
    const double u1 = ref_midpoint(u.u1), u2 = ref_midpoint(u.u2);

    aim->shape = index;
    for (unsigned k = 0; k < 3; k++) {
        aim->emission[k] = shape->material->emission[k];
    }
    if (shape->radius > 0) {
        return aim_ball(shape, index, two_sided, direct, surface, u1, u2, aim);
    }
    if (index == surface->shape) {
        return false; /* in its own plane */
    }
    if (direct == QL_DIRECT_SOLID_ANGLE) {
        const int done = aim_spherical(shape, two_sided, surface, u1, u2, aim);

        if (done >= 0) {
            return done != 0;
        }
    }
    return aim_point(scene, shape, surface, u1, u2, aim);
}

bool ref_aim(const ref_scene_t *scene, unsigned direct, uint32_t light,
        const ref_surface_t *surface, ql_uniform2_t u, ref_aim_t *aim)
{
    const uint16_t index = QL_LE16(scene->blob->lights[light].triangle);
    const bool found = index == QL_LIGHT_SKY ? aim_sky(scene, surface, u, aim)
                                             : aim_shape(scene, direct, index,
                                                       surface, u, aim);

    return found && ref_cosine(surface, aim->w) > 0;
}

double ref_aim_inverse(const ref_scene_t *scene, const ref_surface_t *surface,
        ref_vec_t w, const ref_hit_t *hit)
{
    const ref_shape_t *shape;
    double square;

    if (hit == NULL) {
        double unused[3];

        return scene->blob->texels != NULL ? look_up(scene, w, unused)
                                           : cosine_inverse(surface, w);
    }
    shape = scene->shapes + hit->shape;
    if (shape->radius > 0) {
        return side_of(shape, surface, hit->shape, &square) > 0
                       ? 2 * REF_PI * cone_of(shape, square)
                       : cosine_inverse(surface, w);
    }
    return fabs(ref_dot(w, shape->n)) / (2 * hit->t * hit->t);
}
