/* seen_surface.h - a surface of one material, seen along a direction */
/* SPDX-License-Identifier: MIT */

/* What the tests of materials share: such a surface, directions about it, and
 * means of what its BSDF draws. */

#ifndef SEEN_SURFACE_H
#define SEEN_SURFACE_H

#include <math.h>
#include <string.h>

#include "material/ql_bsdf.h"
#include "support/ql_double.h"
#include "support/ql_points.h"
#include "support/ql_stats.h"
#include "support/ql_table_error.h"
#include "support/ql_test.h"

/* Of a direction rounded to QL_DIR_BITS, rad. */
#define ROUNDED (sqrt(3) * ldexp(1, -QL_DIR_BITS))

/* Lengths of unit vectors, and so cosines, are as good as ql_rsqrt_m(). */
#define LENGTH_ERROR (QL_CFG_PRECISION == 0 ? 6e-5 : 5e-8)
/* of directions that were drawn */
#define DRAWN_ERROR BY_TABLES(LENGTH_ERROR)

/* ---- Vectors ----------------------------------------------------------- */

typedef struct {
    double x, y, z;
} point_t;

static inline point_t point(double x, double y, double z)
{
    const point_t p = {x, y, z};

    return p;
}

static inline point_t from_vec(ql_vec3_t v)
{
    return point(v.x, v.y, v.z);
}

static inline double dot(point_t a, point_t b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* a + k b */
static inline point_t along(point_t a, double k, point_t b)
{
    return point(a.x + k * b.x, a.y + k * b.y, a.z + k * b.z);
}

static inline point_t unit(point_t a)
{
    const double size = sqrt(dot(a, a));

    return point(a.x / size, a.y / size, a.z / size);
}

/* 2 asin(|a - b| / 2): good for small angles too. */
static inline double angle(point_t a, point_t b)
{
    const point_t d = along(unit(a), -1, unit(b));

    return 2 * asin(fmin(1, sqrt(dot(d, d)) / 2));
}

static inline ql_vec3_t to_q29(point_t a)
{
    return vec((int32_t)lrint(ldexp(a.x, 29)), (int32_t)lrint(ldexp(a.y, 29)),
            (int32_t)lrint(ldexp(a.z, 29)));
}

static inline double real(ql_real_t a)
{
    return ldexp(a.m, a.e);
}

static inline double channel(const ql_rgb_t *a, unsigned i)
{
    return ldexp(a->c[i], a->e - 31);
}

static inline point_t random_unit(void)
{
    const double z = 2 * stats_random_unit(&state) - 1;
    const double turn = 2 * PI * stats_random_unit(&state);

    return point(sqrt(1 - z * z) * cos(turn), sqrt(1 - z * z) * sin(turn), z);
}

static inline ql_vec3_t random_vec(int32_t most)
{
    ql_vec3_t v;

    do { /* one after another: arguments have no order */
        v.x = random_in(-most, most);
        v.y = random_in(-most, most);
        v.z = random_in(-most, most);
    } while (v.x == 0 && v.y == 0 && v.z == 0);
    return v;
}

static inline ql_vec3_t random_normal(void)
{
    return random_vec(0x3fffffff >> stats_random_below(&state, 29));
}

static inline bool same(ql_vec3_t a, ql_vec3_t b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* Nasty random numbers. */
static const uint32_t corners[] = {0, 1, 0x3fffffffu, 0x40000000u, 0x7fffffffu,
        0x80000000u, 0xc0000000u, 0xfffffffeu, 0xffffffffu};

enum { CORNERS = sizeof corners / sizeof corners[0] };

/* ---- The surface ------------------------------------------------------- */

static ql_scene_t scene;
static ql_blob_material_t material;
static ql_surface_t surface;
static ql_bsdf_t bsdf;

static inline uint32_t uq31(double x)
{
    return QL_LE32((uint32_t)lrint(ldexp(x, 31)));
}

static inline void set_albedo(double r, double g, double b)
{
    memset(&scene, 0, sizeof scene);
    scene.materials = &material;
    material.albedo[0] = uq31(r);
    material.albedo[1] = uq31(g);
    material.albedo[2] = uq31(b);
}

/* As BLOB.md has it: 1/|n| = m 2^-32 2^(1 - e), m a multiple of 32. */
static inline void set_normal(ql_vec3_t n)
{
    const point_t exact = from_vec(n);
    const double size = sqrt(dot(exact, exact));
    int e;
    double m;

    (void)frexp(size, &e); /* 2^(e-1) <= size < 2^e */
    e = size == ldexp(1, e - 1) ? e - 1 : e;
    m = floor(ldexp(1, 26 + e) / size + 0.5);
    memset(&surface, 0, sizeof surface);
    surface.n = n;
    surface.inv_n =
            (uint32_t)fmin(m, 0x07ffffff) << 5 | (uint32_t)(e < 0 ? 0 : e);
}

static inline point_t normal(void)
{
    return unit(from_vec(surface.n));
}

static inline void see(bool front, ql_vec3_t incoming)
{
    ql_bsdf_begin(&bsdf, &scene, &surface, &material, front, incoming);
}

/* Two directions across a unit vector and each other. */
static inline void across(point_t n, point_t *s, point_t *t)
{
    *s = fabs(n.x) < 0.5 ? point(1, 0, 0) : point(0, 1, 0);
    *s = unit(along(*s, -dot(*s, n), n));
    *t = point(n.y * s->z - n.z * s->y, n.z * s->x - n.x * s->z,
            n.x * s->y - n.y * s->x);
}

/* A ray that comes at an angle to a normal, from an azimuth, rad. */
static inline ql_vec3_t incoming_at(point_t n, double theta, double turn)
{
    point_t s, t, d;

    across(n, &s, &t);
    d = along(along(point(0, 0, 0), -cos(theta), n), sin(theta) * cos(turn), s);
    return ql_vec_to_dir(to_q29(along(d, sin(theta) * sin(turn), t)));
}

static inline ql_vec3_t random_incoming(void)
{
    const double theta = 1.57 * stats_random_unit(&state);

    return incoming_at(normal(), theta, 2 * PI * stats_random_unit(&state));
}

/* Neither along an axis nor of a length that is a power of two. */
static const ql_vec3_t tilted = {-271828183, 314159265, 141421356};

static inline void see_at(double degrees)
{
    set_normal(tilted);
    see(true, incoming_at(normal(), degrees * PI / 180, 0.7));
}

static inline double cosine_to_normal(ql_vec3_t direction)
{
    return dot(unit(from_vec(direction)), normal());
}

#if QL_CFG_SMOOTH
/* The flat normal turned by an angle. */
static inline void set_shade(double degrees)
{
    point_t s, t;

    across(normal(), &s, &t);
    surface.smooth = true;
    surface.shade = to_q29(unit(along(normal(), tan(degrees * PI / 180), s)));
}
#endif

#if QL_GLOSS
static ql_blob_gloss_t gloss;

static inline void set_gloss(
        ql_gloss_kind_t kind, double ks, double parameter, double chance)
{
    for (unsigned i = 0; i < 3; i++) {
        gloss.specular[i] = uq31(ks);
    }
    gloss.parameter = QL_LE32((uint32_t)lrint(ldexp(parameter, 16)));
    gloss.chance = uq31(chance);
    gloss.kind = QL_LE16((uint16_t)kind);
    scene.gloss = &gloss;
    scene.gloss_count = 1;
}
#endif

#if QL_CFG_GLASS
static const double indices[] = {
        1, 1.0001, 1.33, 1.5, 2.4, 64, 1 / 1.5, 1.0 / 16};

enum { INDICES = sizeof indices / sizeof indices[0] };

/* As the blob holds it. */
static inline double set_glass(double index)
{
    set_albedo(0, 0, 0);
    set_gloss(QL_GLOSS_GLASS, 1, index, 1);
    return ldexp(QL_LE32(gloss.parameter), -16);
}
#endif

/* ---- Means of replicated Sobol points ---------------------------------- */

enum { REPLICATES = 64 };

typedef struct {
    ql_uq32_t pick;
    ql_uniform2_t u;
} draw_t;

typedef double (*value_t)(draw_t draw);

typedef struct {
    double mean;
    double error; /* standard error, from the replicates */
    double most;  /* largest value */
} estimate_t;

static inline estimate_t estimate(value_t value, uint32_t count)
{
    stats_moments_t means = {0, 0, 0};
    estimate_t r = {0, 0, 0};

    for (uint32_t seed = 0; seed < REPLICATES; seed++) {
        ql_sampler_t sampler;
        double sum = 0;

        ql_sampler_begin(&sampler, QL_SAMPLER_SOBOL, seed, 0, 0);
        for (uint32_t i = 0; i < count; i++) {
            draw_t draw;
            double v;

            ql_sampler_start(&sampler, i);
            draw.pick = ql_sampler_1d(&sampler, 0);
            draw.u = ql_sampler_2d(&sampler, 1);
            v = value(draw);
            sum += v;
            r.most = fmax(r.most, v);
        }
        stats_add(&means, sum / count);
    }
    r.mean = means.mean;
    r.error = sqrt(stats_variance(&means) / REPLICATES);
    return r;
}

/* Means compared in one program, at most. */
enum { COMPARISONS = 200 };

/* How many standard errors of replicates a mean may be off. */
static inline double errors_max(void)
{
    static double limit;

    limit = limit > 0 ? limit : stats_t_limit(COMPARISONS, REPLICATES);
    return limit;
}

/* Standard errors; where there is next to no variance, the formats: of lengths,
 * and of how far rounding moved the direction it is seen from. */
#define WITHIN(e) (errors_max() * (e).error + DRAWN_ERROR + 2 * ROUNDED)

static ql_density_t density;
static unsigned colour; /* channel looked at */

/* Weight of that channel, 0 if lost. */
static inline double drawn_weight(draw_t draw)
{
    ql_bsdf_sample_t sample;

    return ql_bsdf_sample(&bsdf, density, draw.pick, draw.u, &sample, NULL)
                   ? channel(&sample.weight, colour)
                   : 0;
}

/* Is a drawn direction where it should be, and its weight and density? */
static inline void check_sample(
        const ql_bsdf_sample_t *sample, double most, const ql_real_t *pdf)
{
    const int64_t side = ql_vec_dot_normal(sample->wi, surface.n);

    CHECK(sample->through ? side < 0 : side > 0,
            "on the wrong side: %ld %ld %ld", (long)sample->wi.x,
            (long)sample->wi.y, (long)sample->wi.z);
    for (unsigned i = 0; i < 3; i++) {
        CHECK(channel(&sample->weight, i) <= most * (1 + 0x1p-29),
                "weight %.12g above %.12g", channel(&sample->weight, i), most);
    }
    CHECK(pdf == NULL || (pdf->m == 0) == sample->specular, "density %g",
            pdf == NULL ? 0 : real(*pdf));
}

#endif
