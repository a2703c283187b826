/* rounding.c - what each stage of the core does to an exact result */
/* SPDX-License-Identifier: MIT */

#include "known/double/rounding.h"

#include <math.h>
#include <string.h>

#include "support/picture/film_add.h"
#include "math/vec/ql_frame.h"
#include "math/vec/ql_rgb.h"
#include "math/ql_trig.h"
#include "math/vec/ql_vec_unit.h"
#include "warp/ql_warp_sphere.h"
#include "light/ql_emit_triangle.h"
#include "light/ql_light.h"
#include "trace/surface/ql_surface_at.h"

#define ULP     ldexp(1, -QL_POS_BITS) /* of a position, grid units */
#define BOX     32767.0
#define ANGLE   ldexp(1, QL_DIR_BITS) /* units of a direction in a radian */
#define UNIT_Q  ldexp(1, 29)          /* s2.29 */
#define UNIT_31 ldexp(1, 31)          /* u1.31 */

static const struct {
    const char *name, *unit;
} stages[ROUNDING_STAGES] = {
        {"table: sine, cosine", "absolute"},
        {"table: reciprocal square root", "relative"},
        {"table: reciprocal", "relative"},
        {"camera ray: origin", "position ulp"},
        {"camera ray: direction", "of 2^-b rad"},
        {"warp: point of a light", "position ulp"},
        {"warp: cosine direction", "of 2^-b rad"},
        {"frame: unit normal", "of 2^-29"},
        {"frame: its other axes", "of 2^-29"},
        {"intersection: ray parameter", "position ulp"},
        {"hit point", "position ulp"},
        {"shading: geometry term", "relative"},
        {"shading: throughput", "of 2^-31"},
        {"sum", "of 2^-24"},
};

const char *rounding_name(rounding_stage_t stage)
{
    return stages[stage].name;
}

const char *rounding_unit(rounding_stage_t stage)
{
    return stages[stage].unit;
}

/* ---- What stages share -------------------------------------------------- */

static bool is_on(const rounding_t *r, rounding_stage_t stage)
{
    return (r->on >> stage & 1u) != 0;
}

static void count(rounding_t *r, rounding_stage_t stage, double off)
{
    rounding_error_t *e = r->error + stage;

    e->worst = fmax(e->worst, fabs(off));
    e->squares += off * off;
    e->count++;
}

/* exact, off by as much as rounded is, or coarser. */
static ref_vec_t put(const rounding_t *r, ref_vec_t exact, ref_vec_t rounded)
{
    return r->coarser == 1
                   ? rounded
                   : ref_along(exact, ref_sub(rounded, exact), r->coarser);
}

static double put_number(const rounding_t *r, double exact, double rounded)
{
    return r->coarser == 1 ? rounded : exact + r->coarser * (rounded - exact);
}

static ref_vec_t from_integers(ql_vec3_t v, double unit)
{
    const ref_vec_t x = {v.x * unit, v.y * unit, v.z * unit};

    return x;
}

/* To nearest. */
static ql_vec3_t to_integers(ref_vec_t v, double per_unit)
{
    ql_vec3_t x;

    x.x = (int32_t)floor(v.x * per_unit + 0.5);
    x.y = (int32_t)floor(v.y * per_unit + 0.5);
    x.z = (int32_t)floor(v.z * per_unit + 0.5);
    return x;
}

/* A midpoint of ref_midpoint() as the number it stands for. */
static uint32_t to_uniform(double u)
{
    return (uint32_t)ldexp(u, 32);
}

/* x > 0, cut as ql_real_from_u64() cuts. */
static ql_real_t to_real(double x)
{
    ql_real_t r = {0, 0};
    int e;
    const double m = frexp(x, &e);

    if (x > 0) {
        r.m = (uint32_t)ldexp(m, 32);
        r.e = (int16_t)(e - 32);
    }
    return r;
}

/* To nearest: off by 2^-33 at most. */
static ql_real_t to_nearest_real(double x)
{
    return to_real(x * (1 + ldexp(1, -33)));
}

static double from_real(ql_real_t a)
{
    return ldexp(a.m, a.e);
}

/* A surface's exact normal, on the side it was seen from. */
static ql_vec3_t normal_of(const rounding_t *r, const ref_surface_t *surface)
{
    const ref_shape_t *shape = r->scene->shapes + surface->shape;
    const double side = ref_dot(surface->n, shape->n) < 0 ? -1 : 1;

    return to_integers(shape->n, side);
}

static const ql_blob_tri_t *triangle_of(
        const rounding_t *r, const ref_surface_t *surface)
{
    return r->scene->blob->triangles + surface->shape;
}

/* ---- Camera ------------------------------------------------------------- */

static void round_camera(void *data, uint16_t x, uint16_t y,
        const ql_sampler_t *sampler, ref_ray_t *ray)
{
    rounding_t *r = data;
    const ql_uniform2_t u = ql_sampler_2d(sampler, QL_DIM_PIXEL);
    ref_vec_t origin, direction, beside;
    ql_camera_pixel_t pixel;
    ql_ray_t core;

    if (!is_on(r, ROUNDING_ORIGIN) && !is_on(r, ROUNDING_RAY)) {
        return;
    }
    ql_camera_pixel(&pixel, &r->camera, x, y);
    if (!ql_camera_ray(&pixel, u, u, &core)) {
        return; /* no lens; misses the box, and so does this one */
    }
    origin = from_integers(core.origin, ULP);
    direction = ref_unit(from_integers(core.direction, 1));
    /* where this ray is beside that origin */
    beside = ref_along(ray->origin, ray->direction,
            ref_dot(ref_sub(origin, ray->origin), ray->direction));
    if (is_on(r, ROUNDING_ORIGIN)) {
        count(r, ROUNDING_ORIGIN, ref_length(ref_sub(origin, beside)) / ULP);
        beside = put(r, beside, origin);
    }
    if (is_on(r, ROUNDING_RAY)) {
        count(r, ROUNDING_RAY,
                ref_length(ref_sub(direction, ray->direction)) * ANGLE);
        ray->direction = ref_unit(put(r, ray->direction, direction));
    }
    ray->origin = beside; /* both errors are those from there on */
}

/* ---- Hits --------------------------------------------------------------- */

/* Where a ray begins: the camera's, where it enters the box. */
static ref_vec_t begin_of(const ref_ray_t *ray)
{
    const double o[3] = {ray->origin.x, ray->origin.y, ray->origin.z};
    const double d[3] = {ray->direction.x, ray->direction.y, ray->direction.z};
    double entry = 0;

    for (unsigned k = 0; k < 3; k++) {
        if (o[k] < 0 || o[k] > BOX) {
            entry = fmax(entry, ((o[k] < 0 ? 0 : BOX) - o[k]) / d[k]);
        }
    }
    return ref_along(ray->origin, ray->direction, entry);
}

/* parameter() of ql_bvh.c: t / det, u2.30. */
static double parameter(uint64_t t, uint64_t det)
{
    const unsigned up = ql_clz64(det) - 2;
    const uint32_t det30 = (uint32_t)(det << up >> 32);
    const uint32_t t30 = (uint32_t)(t << up >> 32);

    return ldexp(ql_mulhi_u32(t30, ql_recip_m(det30 << 2)) << 1, -30);
}

/* Where the core's ray parameter leads to. */
static ref_vec_t way_along(
        const rounding_t *r, const ref_ray_t *ray, const ref_shape_t *shape)
{
    const ref_vec_t begin = begin_of(ray);
    const ref_vec_t s = ref_scale(ref_sub(begin, shape->corner), 1 / ULP);
    const double most = fmax(fabs(ray->direction.x),
            fmax(fabs(ray->direction.y), fabs(ray->direction.z)));
    int e;
    double scale, det, t;

    (void)r;
    (void)frexp(most, &e); /* most in [2^(e-1), 2^e) */
    scale = ldexp(1, QL_DIR_BITS - e);
    det = floor(fabs(ref_dot(ray->direction, shape->n)) * scale);
    t = floor(fabs(ref_dot(s, shape->n)));
    if (!(det >= 1 && t < 4 * det)) { /* along the plane */
        return begin;
    }
    return ref_along(begin, ray->direction,
            parameter((uint64_t)t, (uint64_t)det) * scale * ULP);
}

/* Cut towards where it came from; what is a whole number but for the rounding
 * of doubles stays. */
static int32_t cut(double x, double direction)
{
    const double near = floor(x + 0.5);

    return (int32_t)(fabs(x - near) < 1e-6 ? near
                     : direction < 0       ? ceil(x)
                                           : floor(x));
}

static void round_point(void *data, const ref_ray_t *ray, const ref_hit_t *hit,
        ref_surface_t *surface)
{
    rounding_t *r = data;
    const ref_shape_t *shape = r->scene->shapes + hit->shape;
    const ref_vec_t exact = surface->p;

    if (is_on(r, ROUNDING_WAY)) {
        const ref_vec_t p = way_along(r, ray, shape);

        count(r, ROUNDING_WAY, ref_length(ref_sub(p, exact)) / ULP);
        surface->p = put(r, exact, p);
    }
    if (is_on(r, ROUNDING_POINT)) {
        const ref_vec_t before = surface->p;
        ref_vec_t p;
        ql_vec3_t at, corner, n;

        at.x = cut(before.x / ULP, ray->direction.x);
        at.y = cut(before.y / ULP, ray->direction.y);
        at.z = cut(before.z / ULP, ray->direction.z);
        corner = to_integers(shape->corner, 1);
        n = normal_of(r, surface);
        (void)ql_surface_step(&at, &corner, &n);
        p = from_integers(at, ULP);
        count(r, ROUNDING_POINT, ref_length(ref_sub(p, before)) / ULP);
        r->error[ROUNDING_POINT].along +=
                ref_dot(ref_sub(p, before), surface->n) / ULP;
        surface->p = put(r, before, p);
    }
}

/* ---- Directions --------------------------------------------------------- */

static void round_normal(void *data, const ref_surface_t *surface, ref_vec_t *n)
{
    rounding_t *r = data;
    ref_vec_t unit;

    if (is_on(r, ROUNDING_NORMAL)) {
        unit = from_integers(ql_vec_unit_q29_of_inv_n(normal_of(r, surface),
                                     QL_LE32(triangle_of(r, surface)->inv_n)),
                1 / UNIT_Q);
        count(r, ROUNDING_NORMAL, ref_length(ref_sub(unit, *n)) * UNIT_Q);
        *n = put(r, *n, unit);
    }
}

/* The frame of Duff et al., of an axis that need not be a unit vector. */
static void frame_of(ref_vec_t axis, ref_vec_t *right, ref_vec_t *up)
{
    const double sign = axis.z < 0 ? -1 : 1, a = 1 / (1 + fabs(axis.z));

    right->x = 1 - axis.x * axis.x * a;
    right->y = -axis.x * axis.y * a;
    right->z = -sign * axis.x;
    up->x = sign * right->y;
    up->y = sign * (1 - axis.y * axis.y * a);
    up->z = -axis.y;
}

static void round_frame(
        void *data, ref_vec_t axis, ref_vec_t *right, ref_vec_t *up)
{
    rounding_t *r = data;
    const ql_vec3_t n = to_integers(axis, UNIT_Q);
    ref_vec_t exact[2], off[2];
    ql_frame_t frame;

    if (is_on(r, ROUNDING_FRAME)) {
        ql_frame_from_normal(&frame, n);
        frame_of(from_integers(n, 1 / UNIT_Q), &exact[0], &exact[1]);
        off[0] = ref_sub(from_integers(frame.s, 1 / UNIT_Q), exact[0]);
        off[1] = ref_sub(from_integers(frame.t, 1 / UNIT_Q), exact[1]);
        count(r, ROUNDING_FRAME,
                fmax(ref_length(off[0]), ref_length(off[1])) * UNIT_Q);
        *right = ref_along(*right, off[0], r->coarser);
        *up = ref_along(*up, off[1], r->coarser);
    }
}

/* Relative error of the core's reciprocal square root. */
static double root_error(double x)
{
    int e;
    double m = frexp(x, &e); /* in [1/2, 1) */
    uint32_t mantissa;

    m = e & 1 ? m / 2 : m;
    mantissa = (uint32_t)ldexp(m, 32);
    return ldexp(ql_rsqrt_m(mantissa) * sqrt(mantissa), -47) - 1;
}

/* A point of the sphere by parts: table, square root, what is left. */
static ref_vec_t sphere_by_parts(rounding_t *r, double u1, double u2)
{
    const uint32_t n1 = to_uniform(u1), n2 = to_uniform(u2);
    double square = 4 * u1 * (1 - u1), z = 1 - 2 * u1, rho;
    double c = cos(2 * REF_PI * u2), s = sin(2 * REF_PI * u2);
    ref_vec_t v;

    if (is_on(r, ROUNDING_SINE)) {
        int32_t sine, cosine;

        ql_sincos(n2, &sine, &cosine);
        count(r, ROUNDING_SINE, ldexp(sine, -30) - s);
        count(r, ROUNDING_SINE, ldexp(cosine, -30) - c);
        s = ldexp(sine, -30);
        c = ldexp(cosine, -30);
    }
    if (is_on(r, ROUNDING_COSINE)) {
        square = ldexp(ql_mulhi_u32(n1, ~n1) << 2, -32);
        z = ldexp((double)((1L << 29) - (int32_t)(n1 >> 2)), -29);
    }
    rho = sqrt(square);
    if (is_on(r, ROUNDING_ROOT) && square > 0) {
        const double off = root_error(square);

        count(r, ROUNDING_ROOT, off);
        rho *= 1 + off;
    }
    v.x = rho * c;
    v.y = rho * s;
    v.z = z;
    if (is_on(r, ROUNDING_COSINE)) {
        v.x = floor(v.x * UNIT_Q) / UNIT_Q;
        v.y = floor(v.y * UNIT_Q) / UNIT_Q;
    }
    return v;
}

static void round_sphere(void *data, double u1, double u2, ref_vec_t *v)
{
    const uint32_t parts = (uint32_t)1 << ROUNDING_SINE |
                           (uint32_t)1 << ROUNDING_ROOT |
                           (uint32_t)1 << ROUNDING_COSINE;
    rounding_t *r = data;
    ref_vec_t rounded;

    r->sphere = *v;
    if ((r->on & parts) == parts) {
        rounded = from_integers(
                ql_warp_sphere(to_uniform(u1), to_uniform(u2)), 1 / UNIT_Q);
    } else if ((r->on & parts) != 0) {
        rounded = sphere_by_parts(r, u1, u2);
    } else {
        return;
    }
    *v = put(r, *v, rounded);
}

static void round_direction(
        void *data, const ref_surface_t *surface, ref_vec_t n, ref_vec_t *w)
{
    rounding_t *r = data;
    const ql_vec3_t normal = normal_of(r, surface);
    const ref_vec_t exact = ref_unit(ref_add(n, r->sphere));
    ref_vec_t rounded;
    ql_vec3_t d;

    if (!is_on(r, ROUNDING_COSINE)) {
        return;
    }
    d = ql_vec_to_dir(to_integers(*w, UNIT_Q));
    if (ql_vec_dot_normal(d, normal) <= 0) { /* as ql_diffuse_direction() */
        d = ql_vec_to_dir(to_integers(n, UNIT_Q));
        r->fallbacks++;
        *w = from_integers(d, 1);
        return;
    }
    rounded = ref_unit(from_integers(d, 1));
    count(r, ROUNDING_COSINE, ref_length(ref_sub(rounded, exact)) * ANGLE);
    *w = put(r, exact, rounded);
}

/* ---- Light -------------------------------------------------------------- */

static void round_light_point(void *data, const ref_surface_t *surface,
        const ref_shape_t *shape, double u1, double u2, ref_vec_t *to)
{
    rounding_t *r = data;
    const ref_vec_t exact = ref_add(surface->p, *to);
    ql_emit_point_t point;
    ql_uniform2_t u;
    ref_vec_t q;

    if (!is_on(r, ROUNDING_LIGHT)) {
        return;
    }
    u.u1 = to_uniform(u1);
    u.u2 = to_uniform(u2);
    ql_emit_triangle_point(r->scene->blob, (uint16_t)shape->light, u, &point);
    if (r->scene->blob->two_sided && ref_dot(*to, shape->n) > 0) {
        point.n = to_integers(shape->n, -1);
    }
    (void)ql_surface_step(&point.q, &point.corner, &point.n);
    q = from_integers(point.q, ULP);
    count(r, ROUNDING_LIGHT, ref_length(ref_sub(q, exact)) / ULP);
    r->error[ROUNDING_LIGHT].along +=
            ref_dot(ref_sub(q, exact), ref_unit(from_integers(point.n, 1))) /
            ULP;
    *to = ref_sub(put(r, exact, q), surface->p);
}

/* 1/|n| as packed in ql_blob_tri_t. */
static ql_real_t unpack_inverse(uint32_t inv_n)
{
    ql_real_t a;

    a.m = inv_n & ~(uint32_t)31;
    a.e = (int16_t)(-31 - (int16_t)(inv_n & 31u));
    return a;
}

/* Relative error of geometry() in ql_next_event.c, with or without the exact
 * reciprocal. */
static double geometry_error(const rounding_t *r, const ref_surface_t *surface,
        const ref_aim_t *aim, bool recip)
{
    const ref_shape_t *light = r->scene->shapes + aim->shape;
    const ref_vec_t w = ref_scale(aim->w, aim->distance / ULP);
    const ref_vec_t n = from_integers(normal_of(r, surface), 1);
    const double cos_n = ref_dot(n, w), square = ref_dot(w, w);
    const double cos_light = fabs(ref_dot(light->n, w));
    const double chance =
            ref_light_chance(r->scene, r->settings, (uint32_t)light->light);
    const ql_real_t inverse = recip ? ql_real_recip(to_real(square))
                                    : to_nearest_real(1 / square);
    const double exact = cos_n / ref_length(n) * cos_light / (square * square) /
                         (2 * REF_PI * chance);
    ql_real_t g;

    g = ql_real_mul(to_real(cos_n),
            unpack_inverse(QL_LE32(triangle_of(r, surface)->inv_n)));
    g = ql_real_mul(g, inverse);
    g = ql_real_mul(g, to_real(cos_light));
    g = ql_real_mul(g, inverse);
    g = ql_real_mul(
            g, ql_light_weight(r->scene->blob, r->settings->lights,
                       r->settings->light_samples, (uint16_t)light->light));
    return from_real(g) / exact - 1;
}

/* Relative error of the core's reciprocal. */
static double reciprocal_error(double x)
{
    const ql_real_t a = to_real(x);

    return from_real(ql_real_recip(a)) * from_real(a) - 1;
}

static void round_geometry(void *data, const ref_surface_t *surface,
        const ref_aim_t *aim, double *inverse)
{
    rounding_t *r = data;
    const bool recip = is_on(r, ROUNDING_RECIPROCAL);
    const double distance = aim->distance / ULP;

    if (is_on(r, ROUNDING_GEOMETRY)) {
        const double off = geometry_error(r, surface, aim, recip);

        count(r, ROUNDING_GEOMETRY, off);
        *inverse *= 1 + r->coarser * off;
    } else if (recip) {
        const double off = reciprocal_error(distance * distance);

        count(r, ROUNDING_RECIPROCAL, off);
        *inverse *= (1 + r->coarser * off) * (1 + r->coarser * off);
    }
}

static void round_product(
        void *data, double carried, double by, double *product)
{
    rounding_t *r = data;
    const uint64_t a = (uint64_t)(carried * UNIT_31 + 0.5);
    const uint64_t b = (uint64_t)(by * 2 * UNIT_31 + 0.5);
    uint64_t c;

    if (!is_on(r, ROUNDING_THROUGHPUT)) {
        return;
    }
    /* albedo is u1.31, emission u0.32: half up, both */
    c = b % 2 == 0 ? ql_mul_uq31((uint32_t)a, (uint32_t)(b / 2))
                   : (a * b + 0x80000000u) >> 32;
    count(r, ROUNDING_THROUGHPUT, (double)c - *product * UNIT_31);
    *product = put_number(r, *product, (double)c / UNIT_31);
}

static void round_contribution(void *data, double *light)
{
    static const double per_unit = 1ul << QL_SUM_BITS;
    rounding_t *r = data;
    ql_diag_t diag = {0};
    uint64_t sum = 0;

    if (!is_on(r, ROUNDING_SUM) || *light <= 0) {
        return;
    }
    if (r->truncate) {
        sum = (uint64_t)(*light * per_unit);
    } else {
        film_add(&sum, QL_UQ31_ONE, to_nearest_real(*light),
                0x9e3779b9u * (uint32_t)r->error[ROUNDING_SUM].count, &diag);
    }
    count(r, ROUNDING_SUM, (double)sum - *light * per_unit);
    *light = put_number(r, *light, (double)sum / per_unit);
}

static void note_met(void *data, uint32_t what)
{
    rounding_t *r = data;

    r->route = (r->route ^ what) * 16777619u; /* FNV */
}

void rounding_begin(
        rounding_t *rounding, ref_scene_t *scene, const ql_settings_t *settings)
{
    static const ref_rounding_t hooks = {.camera = round_camera,
            .point = round_point,
            .normal = round_normal,
            .frame = round_frame,
            .sphere = round_sphere,
            .direction = round_direction,
            .light_point = round_light_point,
            .geometry = round_geometry,
            .product = round_product,
            .contribution = round_contribution,
            .met = note_met};

    memset(rounding, 0, sizeof *rounding);
    rounding->hooks = hooks;
    rounding->hooks.data = rounding;
    rounding->scene = scene;
    rounding->settings = settings;
    rounding->coarser = 1;
    if (!ql_camera_init(&rounding->camera, scene->blob, settings->width,
                settings->height)) {
        memset(&rounding->camera, 0, sizeof rounding->camera);
    }
    scene->rounding = &rounding->hooks;
}
