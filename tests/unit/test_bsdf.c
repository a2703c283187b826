/* test_bsdf.c - materials against closed forms; planted faults are rejected */
/* SPDX-License-Identifier: MIT */

#include <math.h>

#include "support/ql_points.h"
#include "support/ql_stats.h"
#include "support/ql_table_error.h"
#include "support/ql_test.h"
#include "math/ql_vec_unit.h"
#include "warp/ql_lobe.h"
#include "warp/ql_warp.h"
#include "material/ql_bsdf.h"

#define PI 3.14159265358979323846

/* Of a direction rounded to QL_DIR_BITS, rad. */
#define ROUNDED (sqrt(3) * ldexp(1, -QL_DIR_BITS))

/* Lengths of unit vectors, and so cosines, are as good as ql_rsqrt_m(). */
#define LENGTH_ERROR (QL_CFG_PRECISION == 0 ? 6e-5 : 5e-8)
/* of directions that were drawn */
#define DRAWN_ERROR BY_TABLES(LENGTH_ERROR)

typedef struct {
    double x, y, z;
} point_t;

static point_t point(double x, double y, double z)
{
    const point_t p = {x, y, z};

    return p;
}

static point_t from_vec(ql_vec3_t v)
{
    return point(v.x, v.y, v.z);
}

static double dot(point_t a, point_t b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* a + k b */
static point_t along(point_t a, double k, point_t b)
{
    return point(a.x + k * b.x, a.y + k * b.y, a.z + k * b.z);
}

static point_t unit(point_t a)
{
    const double size = sqrt(dot(a, a));

    return point(a.x / size, a.y / size, a.z / size);
}

#if QL_CFG_MIRROR || QL_CFG_GLASS
/* 2 asin(|a - b| / 2): good for small angles too. */
static double angle(point_t a, point_t b)
{
    const point_t d = along(unit(a), -1, unit(b));

    return 2 * asin(fmin(1, sqrt(dot(d, d)) / 2));
}
#endif

static ql_vec3_t to_q29(point_t a)
{
    return vec((int32_t)lrint(ldexp(a.x, 29)), (int32_t)lrint(ldexp(a.y, 29)),
            (int32_t)lrint(ldexp(a.z, 29)));
}

static double real(ql_real_t a)
{
    return ldexp(a.m, a.e);
}

static double channel(const ql_rgb_t *a, unsigned i)
{
    return ldexp(a->c[i], a->e - 31);
}

#if QL_CFG_SMOOTH
static point_t random_unit(void)
{
    const double z = 2 * stats_random_unit(&state) - 1;
    const double turn = 2 * PI * stats_random_unit(&state);

    return point(sqrt(1 - z * z) * cos(turn), sqrt(1 - z * z) * sin(turn), z);
}
#endif

/* ---- A surface of one material, seen along a direction ----------------- */

static ql_scene_t scene;
static ql_blob_material_t material;
static ql_surface_t surface;
static ql_bsdf_t bsdf;

static uint32_t uq31(double x)
{
    return QL_LE32((uint32_t)lrint(ldexp(x, 31)));
}

static void set_albedo(double r, double g, double b)
{
    memset(&scene, 0, sizeof scene);
    scene.materials = &material;
    material.albedo[0] = uq31(r);
    material.albedo[1] = uq31(g);
    material.albedo[2] = uq31(b);
}

/* As BLOB.md has it: 1/|n| = m 2^-32 2^(1 - e), m a multiple of 32. */
static void set_normal(ql_vec3_t n)
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

static point_t normal(void)
{
    return unit(from_vec(surface.n));
}

static void see(bool front, ql_vec3_t incoming)
{
    ql_bsdf_begin(&bsdf, &scene, &surface, &material, front, incoming);
}

/* Two directions across a unit vector and each other. */
static void across(point_t n, point_t *s, point_t *t)
{
    *s = fabs(n.x) < 0.5 ? point(1, 0, 0) : point(0, 1, 0);
    *s = unit(along(*s, -dot(*s, n), n));
    *t = point(n.y * s->z - n.z * s->y, n.z * s->x - n.x * s->z,
            n.x * s->y - n.y * s->x);
}

/* A ray that comes at an angle to a normal, from an azimuth, rad. */
static ql_vec3_t incoming_at(point_t n, double theta, double turn)
{
    point_t s, t, d;

    across(n, &s, &t);
    d = along(along(point(0, 0, 0), -cos(theta), n), sin(theta) * cos(turn), s);
    return ql_vec_to_dir(to_q29(along(d, sin(theta) * sin(turn), t)));
}

#if QL_CFG_MIRROR
static ql_vec3_t random_incoming(void)
{
    const double theta = 1.57 * stats_random_unit(&state);

    return incoming_at(normal(), theta, 2 * PI * stats_random_unit(&state));
}
#endif

/* Neither along an axis nor of a length that is a power of two. */
static const ql_vec3_t tilted = {-271828183, 314159265, 141421356};

static void see_at(double degrees)
{
    set_normal(tilted);
    see(true, incoming_at(normal(), degrees * PI / 180, 0.7));
}

static double cosine_to_normal(ql_vec3_t direction)
{
    return dot(unit(from_vec(direction)), normal());
}

#if QL_GLOSS
static ql_blob_gloss_t gloss;

static void set_gloss(
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

static estimate_t estimate(value_t value, uint32_t count)
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

/* Four standard errors; where there is next to no variance, the formats: of
 * lengths, and of how far rounding moved the direction it is seen from. */
#define WITHIN(e) (4 * (e).error + DRAWN_ERROR + 2 * ROUNDED)

static ql_density_t density;
static unsigned colour; /* channel looked at */

/* Weight of that channel, 0 if lost. */
static double drawn_weight(draw_t draw)
{
    ql_bsdf_sample_t sample;

    return ql_bsdf_sample(
                   &bsdf, density, false, draw.pick, draw.u, &sample, false)
                   ? channel(&sample.weight, colour)
                   : 0;
}

/* ---- Diffuse ----------------------------------------------------------- */

/* What the path tracer has always done; pictures depend on every bit. */
static ql_vec3_t cosine_direction(ql_uniform2_t u)
{
    const ql_vec3_t n = ql_vec_unit_q29_of_inv_n(surface.n, surface.inv_n);
    const ql_vec3_t d = ql_vec_to_dir(ql_warp_cosine_hemisphere(n, u.u1, u.u2));

    return ql_vec_dot_normal(d, surface.n) > 0 ? d : ql_vec_to_dir(n);
}

static ql_vec3_t random_vec(int32_t most)
{
    ql_vec3_t v;

    do { /* one after another: arguments have no order */
        v.x = random_in(-most, most);
        v.y = random_in(-most, most);
        v.z = random_in(-most, most);
    } while (v.x == 0 && v.y == 0 && v.z == 0);
    return v;
}

static ql_vec3_t random_normal(void)
{
    return random_vec(0x3fffffff >> stats_random_below(&state, 29));
}

static bool same(ql_vec3_t a, ql_vec3_t b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

static const uint32_t corners[] = {0, 1, 0x3fffffffu, 0x40000000u, 0x7fffffffu,
        0x80000000u, 0xc0000000u, 0xfffffffeu, 0xffffffffu};

enum { CORNERS = sizeof corners / sizeof corners[0] };

TEST(diffuse_directions_and_weights_are_the_old_bits)
{
    state = 1;
    set_albedo(0.3, 1, 0.7);
    for (long k = 0; k < 200000; k++) {
        const uint64_t bits = stats_random(&state);
        ql_uniform2_t u = {(uint32_t)bits, (uint32_t)(bits >> 32)};
        ql_bsdf_sample_t sample;
        bool drawn;

        if (k % 8 == 0) {
            u.u1 = corners[k / 8 % CORNERS];
            u.u2 = corners[k / 8 / CORNERS % CORNERS];
        }
        set_normal(random_normal());
        see(true, vec(1, 2, 3));
        drawn = ql_bsdf_sample(&bsdf,
                k & 1 ? QL_DENSITY_COSINE : QL_DENSITY_BRDF, false, (uint32_t)k,
                u, &sample, false);
        CHECK(drawn && same(sample.direction, cosine_direction(u)) &&
                        !sample.delta && !sample.through,
                "n = %ld %ld %ld, u = %08lx %08lx", (long)surface.n.x,
                (long)surface.n.y, (long)surface.n.z, (unsigned long)u.u1,
                (unsigned long)u.u2);
        for (unsigned i = 0; i < 3; i++) {
            CHECK(sample.weight.c[i] == QL_LE32(material.albedo[i]) &&
                            sample.weight.e == 0,
                    "weight %08lx 2^%d", (unsigned long)sample.weight.c[i],
                    sample.weight.e);
        }
        CHECK(!ql_bsdf_sample(
                      &bsdf, QL_DENSITY_BRDF, true, 0, u, &sample, false),
                "drew a lobe that is not there");
    }
}

/* The mean of the cosine of a cosine lobe is 2/3. */
static double drawn_cosine(draw_t draw)
{
    ql_bsdf_sample_t sample;

    return ql_bsdf_sample(
                   &bsdf, density, false, draw.pick, draw.u, &sample, false)
                   ? cosine_to_normal(sample.direction)
                   : 0;
}

TEST(diffuse_directions_have_the_albedo_and_a_mean_cosine_of_2_3)
{
    estimate_t weight, cosine;

    set_albedo(0.6, 0, 0);
    see_at(30);
    density = QL_DENSITY_BRDF;
    weight = estimate(drawn_weight, 64);
    cosine = estimate(drawn_cosine, 256);
    CHECK(fabs(weight.mean - 0.6) < 1e-9 &&
                    fabs(cosine.mean - 2.0 / 3) <= WITHIN(cosine),
            "%.9f; %.6f +- %.6f", weight.mean, cosine.mean, cosine.error);
    NOTE("%.6f +- %.6f", cosine.mean, cosine.error);
}

TEST(black_surfaces_lose_all_light)
{
    const ql_uniform2_t u = {0x80000000u, 5};
    ql_bsdf_sample_t sample;

    set_albedo(0, 0, 0);
    see_at(30);
    CHECK(!ql_bsdf_sample(&bsdf, QL_DENSITY_BRDF, false, 0, u, &sample, false),
            "reflects");
}

TEST(cosines_are_within_their_bounds)
{
    double worst = 0, smooth = 0;

    state = 2;
    for (long k = 0; k < 300000; k++) {
        const int32_t most = 0x1fffffff >> stats_random_below(&state, 25);
        const ql_vec3_t w = random_vec(most);
        double exact, got;

        set_normal(random_normal());
        exact = dot(from_vec(w), normal());
        got = real(ql_bsdf_cosine(&surface, w));
        CHECK((got > 0) == (ql_vec_dot(w, surface.n) > 0), "sign of %g", exact);
        if (exact > 0x1p-20 * most) { /* below, the double cancels */
            worst = fmax(worst, fabs(got / exact - 1));
            CHECK(fabs(got / exact - 1) <= 0x1p-26, "%.12g, not %.12g", got,
                    exact);
        }
#if QL_CFG_SMOOTH
        {
            const point_t shade = random_unit();
            const double size = sqrt(dot(from_vec(w), from_vec(w)));
            const bool above = ql_vec_dot(w, surface.n) > 0;

            surface.smooth = true;
            surface.shade = to_q29(shade);
            got = real(ql_bsdf_cosine(&surface, w));
            exact = above ? fmax(0, dot(from_vec(w), shade)) : 0;
            smooth = fmax(smooth, fabs(got - exact) / size);
            CHECK(fabs(got - exact) <= 0x1p-28 * size, "%.12g, not %.12g", got,
                    exact);
        }
#endif
    }
    NOTE("worst 2^%.2f flat, 2^%.2f smooth", log2(worst),
            log2(fmax(smooth, 1e-30)));
}

#if QL_CFG_STRATEGIES
/* 2 cos, whose mean is 1. */
TEST(uniform_directions_have_the_mean_of_the_cosine)
{
    estimate_t e;

    set_albedo(0.6, 0, 0);
    see_at(30);
    density = QL_DENSITY_UNIFORM;
    e = estimate(drawn_weight, 256);
    CHECK(fabs(e.mean - 0.6) <= WITHIN(e) && e.most <= 1.2 + 1e-6,
            "%.6f +- %.6f, most %.9f", e.mean, e.error, e.most);
    NOTE("%.6f +- %.6f", e.mean, e.error);
}

/* cos/pi of the direction as it was rounded; the root near the horizon costs
 * what the length of n + sphere point is off. */
TEST(diffuse_density_is_the_cosine_over_pi)
{
    double worst = 0;

    state = 3;
    set_albedo(1, 1, 1);
    for (long k = 0; k < 200000; k++) {
        const uint64_t bits = stats_random(&state);
        ql_uniform2_t u = {(uint32_t)bits, (uint32_t)(bits >> 32)};
        ql_bsdf_sample_t sample;
        double cosine, error;

        if (k < CORNERS * CORNERS) {
            u.u1 = corners[k % CORNERS];
            u.u2 = corners[k / CORNERS];
        }
        set_normal(random_normal());
        see(true, vec(0, 0, 1));
        CHECK(ql_bsdf_sample(
                      &bsdf, QL_DENSITY_BRDF, false, 0, u, &sample, true) &&
                        sample.pdf.m != 0,
                "k = %ld", k);
        cosine = cosine_to_normal(sample.direction);
        error = fabs(real(sample.pdf) * PI - cosine);
        if (cosine > 0.05) {
            worst = fmax(worst, error);
            CHECK(error <= DRAWN_ERROR / cosine + ROUNDED,
                    "%.9g, not %.9g / pi", real(sample.pdf), cosine);
        }
    }
    NOTE("worst %.2e above cos 0.05", worst);
}
#endif

/* ---- Smooth normals ---------------------------------------------------- */

#if QL_CFG_SMOOTH
/* The flat normal turned by an angle. */
static void set_shade(double degrees)
{
    point_t s, t;

    across(normal(), &s, &t);
    surface.smooth = true;
    surface.shade = to_q29(unit(along(normal(), tan(degrees * PI / 180), s)));
}

/* Of a cosine lobe tilted by a, (1 + cos a) / 2 is above the plane. */
TEST(smooth_surfaces_lose_what_is_below_the_plane)
{
    for (int degrees = 10; degrees <= 80; degrees += 10) {
        estimate_t e;
        const double above = (1 + cos(degrees * PI / 180)) / 2;

        set_albedo(0.8, 0, 0);
        set_normal(tilted);
        set_shade(degrees);
        see(true, incoming_at(normal(), 0.3, 0));
        density = QL_DENSITY_COSINE;
        e = estimate(drawn_weight, 256);
        CHECK(fabs(e.mean - 0.8 * above) <= WITHIN(e) && e.most <= 0.8000001,
                "%d degrees: %.6f +- %.6f, not %.6f", degrees, e.mean, e.error,
                0.8 * above);
#if QL_CFG_STRATEGIES
        density = QL_DENSITY_UNIFORM;
        e = estimate(drawn_weight, 256);
        CHECK(fabs(e.mean - 0.8 * above) <= WITHIN(e),
                "uniform, %d degrees: %.6f +- %.6f, not %.6f", degrees, e.mean,
                e.error, 0.8 * above);
#endif
    }
}
#endif

/* Is a drawn direction where it should be, and its weight and density? */
static void check_sample(const ql_bsdf_sample_t *sample, double most, bool pdf)
{
    const int64_t side = ql_vec_dot_normal(sample->direction, surface.n);

    CHECK(sample->through ? side < 0 : side > 0,
            "on the wrong side: %ld %ld %ld", (long)sample->direction.x,
            (long)sample->direction.y, (long)sample->direction.z);
    for (unsigned i = 0; i < 3; i++) {
        CHECK(channel(&sample->weight, i) <= most * (1 + 0x1p-29),
                "weight %.12g above %.12g", channel(&sample->weight, i), most);
    }
    CHECK(!pdf || (sample->pdf.m == 0) == sample->delta, "density %g",
            real(sample->pdf));
}

/* ---- Phong ------------------------------------------------------------- */

#if QL_CFG_PHONG
static const double exponents[] = {0, 1, 5, 20, 100, 1000, 65535};
static const double views[] = {0, 30, 45, 60, 75, 80, 85, 89};

enum { EXPONENTS = 7, VIEWS = 8 };

/* Albedo of the lobe with Ks = 1; the last row is the limit, cos. */
static const double albedos[EXPONENTS][VIEWS] = {
        {1, .9330127019, .8535533906, .75, .6294095226, .5868240888,
                .5435778714, .5087262032},
        {1, .8808427796, .7554091649, .6089977810, .4584415161, .4099452536,
                .3630974852, .3270845671},
        {1, .8662535765, .7103933491, .5194068355, .3271321791, .2692908026,
                .2165609213, .1786207365},
        {1, .8660254050, .7071102788, .5005094980, .2711785286, .2003418687,
                .1382931375, .0970929429},
        {1, .8660254038, .7071067812, .5000000006, .2589453621, .1752326235,
                .0976133604, .0491253640},
        {1, .8660254038, .7071067812, .5, .2588190451, .1736481778, .0871830044,
                .0232122927},
        {1, .8660254038, .7071067812, .5, .2588190451, .1736481777, .0871557427,
                .0174524064}};

static void set_phong(double kd, double ks, double n, double chance)
{
    set_albedo(kd, kd, kd);
    set_gloss(QL_GLOSS_PHONG, ks, n, chance);
}

/* The fault: the cosine left out of the weight. */
static double weight_without_cosine(draw_t draw)
{
    ql_bsdf_sample_t sample;

    return ql_bsdf_sample(
                   &bsdf, density, false, draw.pick, draw.u, &sample, false)
                   ? channel(&sample.weight, 0) /
                             cosine_to_normal(sample.direction)
                   : 0;
}

static double is_kept(draw_t draw)
{
    return drawn_weight(draw) > 0;
}

TEST(phong_lobes_have_the_albedos_of_the_table)
{
    double worst = 0;

    density = QL_DENSITY_BRDF;
    for (int i = 0; i < EXPONENTS; i++) {
        for (int k = 0; k < VIEWS; k++) {
            const double n = exponents[i], exact = albedos[i][k];
            estimate_t e;

            set_phong(0, 1, n, 1);
            see_at(views[k]);
            e = estimate(drawn_weight, 1024);
            worst = fmax(worst, fabs(e.mean - exact));
            CHECK(fabs(e.mean - exact) <= WITHIN(e),
                    "n = %g, %g degrees: %.8f +- %.8f, not %.8f", n, views[k],
                    e.mean, e.error, exact);
            CHECK(e.most <= (n + 2) / (n + 1) * (1 + 0x1p-29),
                    "n = %g, %g degrees: weight %.10f", n, views[k], e.most);
            CHECK(e.mean <= 1 + WITHIN(e), "n = %g: gains energy", n);
        }
    }
    NOTE("worst %.1e, %d albedos of 2^16 samples", worst, EXPONENTS * VIEWS);
}

/* Of a uniform lobe 1 - theta/180 is above the horizon, of a cosine lobe
 * (1 + cos)/2. */
TEST(phong_lobes_are_cut_at_the_horizon)
{
    density = QL_DENSITY_BRDF;
    for (int k = 0; k < VIEWS; k++) {
        estimate_t e;

        set_phong(0, 1, 0, 1);
        see_at(views[k]);
        e = estimate(is_kept, 256);
        CHECK(fabs(e.mean - (1 - views[k] / 180)) <= WITHIN(e) + 1e-4,
                "n = 0, %g degrees: %.6f +- %.6f", views[k], e.mean, e.error);
        set_phong(0, 1, 1, 1);
        see_at(views[k]);
        e = estimate(is_kept, 256);
        CHECK(fabs(e.mean - (1 + cos(views[k] * PI / 180)) / 2) <=
                        WITHIN(e) + 1e-4,
                "n = 1, %g degrees: %.6f +- %.6f", views[k], e.mean, e.error);
    }
}

TEST(phong_lobes_of_exponent_n_plus_1_are_rejected)
{
    const uint32_t count = QL_CFG_SAMPLERS & 2 ? 1024 : 16384; /* no Sobol */

    density = QL_DENSITY_BRDF;
    for (int i = 0; i < 3; i++) {
        estimate_t e;

        set_phong(0, 1, exponents[i] + 1, 1);
        see_at(60);
        e = estimate(drawn_weight, count);
        CHECK(fabs(e.mean - albedos[i][3]) > WITHIN(e), "n = %g: %.6f +- %.6f",
                exponents[i], e.mean, e.error);
    }
}

TEST(phong_weights_without_the_cosine_are_rejected)
{
    density = QL_DENSITY_BRDF;
    for (int i = 0; i < EXPONENTS; i++) {
        estimate_t e;

        set_phong(0, 1, exponents[i], 1);
        see_at(60);
        e = estimate(weight_without_cosine, 64);
        CHECK(fabs(e.mean - albedos[i][3]) > WITHIN(e), "n = %g: %.6f +- %.6f",
                exponents[i], e.mean, e.error);
    }
}

static void check_density(int i, int k, double kd, double ks)
{
    const double exact = kd + ks * albedos[i][k];
    const estimate_t e = estimate(drawn_weight, 512);

    CHECK(fabs(e.mean - exact) <= WITHIN(e),
            "density %d, Kd %g, n = %g, %g degrees: %.6f +- %.6f, not %.6f",
            density, kd, exponents[i], views[k], e.mean, e.error, exact);
}

/* 4 exponents, 3 views, 3 mixtures. */
TEST(every_density_has_the_same_mean)
{
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < VIEWS; k += 3) {
            for (int mix = 0; mix < 3; mix++) {
                const double kd = mix == 0 ? 0 : mix == 1 ? 0.3 : 0.75;
                const double ks = mix == 0 ? 1 : mix == 1 ? 0.6 : 0.25;

                set_phong(kd, ks, exponents[i],
                        mix == 0   ? 1
                        : mix == 1 ? 0.4
                                   : 0.2);
                see_at(views[k]);
                density = QL_DENSITY_BRDF;
                check_density(i, k, kd, ks);
                density = QL_DENSITY_COSINE;
                check_density(i, k, kd, ks);
#if QL_CFG_STRATEGIES
                density = QL_DENSITY_UNIFORM;
                check_density(i, k, kd, ks);
#endif
            }
        }
    }
}

TEST(colours_of_both_lobes_keep_apart)
{
    static const double kd[] = {0.5, 0.2, 0}, ks[] = {0.1, 0.7, 0.9};

    set_phong(0, 0, 20, 0.5);
    for (unsigned i = 0; i < 3; i++) {
        material.albedo[i] = uq31(kd[i]);
        gloss.specular[i] = uq31(ks[i]);
    }
    see_at(60);
    for (colour = 0; colour < 3; colour++) {
        density = QL_DENSITY_BRDF;
        check_density(3, 3, kd[colour], ks[colour]);
        density = QL_DENSITY_COSINE;
        check_density(3, 3, kd[colour], ks[colour]);
    }
    colour = 0;
}

/* A chance of 0 or 1 never divides by nothing. */
TEST(lobes_of_no_chance_are_never_drawn)
{
    for (int k = 0; k < CORNERS * CORNERS * CORNERS; k++) {
        const ql_uniform2_t u = {
                corners[k % CORNERS], corners[k / CORNERS % CORNERS]};
        const uint32_t pick = corners[k / (CORNERS * CORNERS)];
        ql_bsdf_sample_t sample;

        set_phong(0.5, 0.5, 20, 0);
        see_at(45);
        CHECK(ql_bsdf_sample(
                      &bsdf, QL_DENSITY_BRDF, false, pick, u, &sample, false) &&
                        channel(&sample.weight, 0) == 0.5,
                "chance 0: weight %.9f", channel(&sample.weight, 0));
        set_phong(0.5, 0.5, 20, 1);
        see_at(45);
        if (ql_bsdf_sample(
                    &bsdf, QL_DENSITY_BRDF, false, pick, u, &sample, false)) {
            CHECK(channel(&sample.weight, 0) <= 0.5 * 22 / 21 * (1 + 0x1p-29),
                    "chance 1: weight %.9f", channel(&sample.weight, 0));
        }
    }
}

/* ---- Phong: the distribution ------------------------------------------- */

enum { ROWS = 16, COLUMNS = 32, BINS = ROWS * COLUMNS };

/* p-value of 2^18 directions in bins that are equally likely for exponent n
 * about the mirror direction, worked out in double. */
static double chi2_p(double n)
{
    static uint32_t counts[BINS];
    const long count = 1L << 18;
    const ql_vec3_t incoming = incoming_at(normal(), 0.3, 2);
    const point_t in = unit(from_vec(incoming));
    const point_t axis = along(in, -2 * dot(in, normal()), normal());
    point_t s, t;

    memset(counts, 0, sizeof counts);
    across(axis, &s, &t);
    see(true, incoming);
    state = 5;
    for (long i = 0; i < count; i++) {
        const uint64_t bits = stats_random(&state);
        const ql_uniform2_t u = {(uint32_t)bits, (uint32_t)(bits >> 32)};
        ql_bsdf_sample_t sample;
        point_t w, apart;
        double at, turn;

        if (!ql_bsdf_sample(
                    &bsdf, QL_DENSITY_BRDF, false, 0, u, &sample, false)) {
            return 0;
        }
        w = unit(from_vec(sample.direction));
        apart = along(w, -1, axis);
        at = -expm1(log1p(-fmin(dot(apart, apart) / 2, 1)) * (n + 1));
        turn = atan2(dot(w, t), dot(w, s)) / (2 * PI) + 0.5;
        counts[(int)fmin(at * ROWS, ROWS - 1) * COLUMNS +
                (int)(turn * COLUMNS) % COLUMNS]++;
    }
    return stats_chi2_p(
            stats_chi2_equal(counts, BINS, (double)count / BINS), BINS - 1);
}

TEST(phong_directions_match_their_density)
{
    double p;

    set_phong(0, 1, 40, 1);
    set_normal(tilted);
    p = chi2_p(40);
    CHECK(p > STATS_P_MIN, "p = %.3g", p);
    NOTE("p = %.2f, %d bins", p, BINS);
}

TEST(phong_directions_of_another_exponent_are_rejected)
{
    double p;

    set_phong(0, 1, 41.5, 1);
    set_normal(tilted);
    p = chi2_p(40);
    CHECK(p <= STATS_P_MIN, "p = %.3g", p);
    NOTE("p = %.1e", p);
}

#if QL_CFG_STRATEGIES
/* P (n + 1)/(2 pi) cos^n of the angle to the mirror direction, and (1 - P)
 * cos/pi. Rounding moves the angle by ROUNDED, so cos^n by n tan of it. */
TEST(densities_are_those_of_the_lobe_drawn)
{
    const double n = 20, chance = 0.3;
    double lobe = 0, diffuse = 0;

    set_phong(0.5, 0.4, n, chance);
    set_normal(tilted);
    state = 6;
    for (long k = 0; k < 100000; k++) {
        const uint64_t bits = stats_random(&state);
        const ql_uniform2_t u = {(uint32_t)bits, (uint32_t)(bits >> 32)};
        const bool special = k & 1;
        const ql_vec3_t incoming = incoming_at(
                normal(), 1.4 * stats_random_unit(&state), 6.0 * (int)(k % 7));
        const point_t in = unit(from_vec(incoming));
        const point_t axis = along(in, -2 * dot(in, normal()), normal());
        ql_bsdf_sample_t sample;
        ql_uq31_t s;
        double got, exact, cosine, error;

        see(true, incoming);
        if (!ql_bsdf_sample(&bsdf, QL_DENSITY_BRDF, false,
                    special ? 0 : 0xffffffffu, u, &sample, true)) {
            continue;
        }
        got = real(sample.pdf);
        if (special) {
            cosine = dot(unit(from_vec(sample.direction)), axis);
            exact = chance * (n + 1) / (2 * PI) * pow(cosine, n);
            error = fabs(got / exact - 1);
            if (cosine > 0.3) {
                lobe = fmax(lobe, error);
                CHECK(error <= 1e-6 + 2 * n * (ROUNDED + DRAWN_ERROR) / cosine,
                        "lobe: %.9g, not %.9g", got, exact);
            }
            (void)ql_warp_power_lobe(
                    ql_lobe_inverse((uint32_t)n << 16), u.u1, u.u2, &s);
            exact = real(ql_warp_power_lobe_pdf((uint32_t)n << 16, s)) * chance;
            CHECK(fabs(got / exact - 1) <= 0x1p-29, "lobe: %.9g, not %.9g", got,
                    exact);
        } else {
            cosine = cosine_to_normal(sample.direction);
            exact = (1 - chance) * cosine / PI;
            error = fabs(got - exact);
            if (cosine > 0.05) {
                diffuse = fmax(diffuse, error);
                CHECK(error <= DRAWN_ERROR / cosine + ROUNDED,
                        "diffuse: %.9g, not %.9g", got, exact);
            }
        }
    }
    NOTE("worst %.1e relative, lobe; %.1e diffuse", lobe, diffuse);
}
#endif

/* ---- Light from a known direction -------------------------------------- */

/* A cap of light about a direction of the surface's frame. */
static point_t cap_axis;
static double cap_s; /* 1 - cos of its rim */

static point_t cap_direction(draw_t draw)
{
    const double s = ldexp(draw.u.u1 + 0.5, -32) * cap_s;
    const double turn = ldexp(draw.u.u2 + 0.5, -32) * 2 * PI;
    const double rho = sqrt(s * (2 - s));
    point_t a, b, w;

    across(cap_axis, &a, &b);
    w = along(point(0, 0, 0), 1 - s, cap_axis);
    return along(along(w, rho * cos(turn), a), rho * sin(turn), b);
}

static double reflected(draw_t draw, bool mis)
{
    const ql_vec3_t w = to_q29(cap_direction(draw));
    ql_real_t cosine = ql_bsdf_cosine(&surface, w), inverse;
    ql_rgb_t r;

    if (cosine.m == 0) {
        return 0;
    }
    cosine.e = (int16_t)(cosine.e - 29);
    inverse = ql_real_from_u64((uint64_t)ldexp(2 * PI * cap_s, 50));
    inverse.e = (int16_t)(inverse.e - 50);
    ql_bsdf_reflect(&bsdf, w, cosine, inverse, mis, &r);
    return channel(&r, 0);
}

static double by_light(draw_t draw)
{
    return reflected(draw, false);
}

TEST(light_from_all_around_is_reflected_by_the_albedo)
{
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < VIEWS; k += 3) {
            const double exact = 0.3 + 0.6 * albedos[i][k];
            estimate_t e;

            set_phong(0.3, 0.6, exponents[i], 0.5);
            see_at(views[k]);
            cap_axis = normal();
            cap_s = 1;
            e = estimate(by_light, 512);
            CHECK(fabs(e.mean - exact) <= WITHIN(e),
                    "n = %g, %g degrees: %.6f +- %.6f, not %.6f", exponents[i],
                    views[k], e.mean, e.error, exact);
        }
    }
}

#if QL_CFG_STRATEGIES
static bool in_cap(ql_vec3_t direction)
{
    return dot(unit(from_vec(direction)), cap_axis) > 1 - cap_s;
}

static double by_brdf(draw_t draw)
{
    ql_bsdf_sample_t sample;

    return ql_bsdf_sample(&bsdf, QL_DENSITY_BRDF, false, draw.pick, draw.u,
                   &sample, true) &&
                           in_cap(sample.direction)
                   ? channel(&sample.weight, 0)
                   : 0;
}

static double density_scale; /* 1; a fault otherwise */

/* Both halves, the same numbers for each. */
static double by_both(draw_t draw)
{
    const double light = 1 / (2 * PI * cap_s);
    ql_bsdf_sample_t sample;
    double value = reflected(draw, true);

    if (ql_bsdf_sample(&bsdf, QL_DENSITY_BRDF, false, draw.pick, draw.u,
                &sample, true) &&
            in_cap(sample.direction)) {
        const double p = real(sample.pdf) * density_scale;

        value += channel(&sample.weight, 0) * p / (p + light);
    }
    return value;
}

static void see_cap(double n, double wide)
{
    set_phong(0.4, 0.5, n, 0.35);
    see_at(50);
    /* off the mirror direction and across the horizon where it is wide */
    cap_s = wide;
    cap_axis = unit(along(from_vec(bsdf.axis), 0x1p27, normal()));
}

TEST(light_and_directions_and_both_have_the_same_mean)
{
    double least = 1;

    for (int i = 1; i < 5; i++) {
        for (int k = 0; k < 3; k++) {
            estimate_t light, brdf, both;

            see_cap(exponents[i], k == 0 ? 0.02 : k == 1 ? 0.2 : 0.9);
            density_scale = 1;
            light = estimate(by_light, 512);
            brdf = estimate(by_brdf, 512);
            both = estimate(by_both, 512);
            least = fmin(least, light.mean);
            CHECK(fabs(light.mean - brdf.mean) <=
                                    WITHIN(light) + 4 * brdf.error &&
                            fabs(light.mean - both.mean) <=
                                    WITHIN(light) + 4 * both.error,
                    "n = %g, cap %d: %.6f +- %.6f, %.6f +- %.6f, %.6f +- %.6f",
                    exponents[i], k, light.mean, light.error, brdf.mean,
                    brdf.error, both.mean, both.error);
        }
    }
    NOTE("12 caps, the darkest %.4f", least);
}

/* The fault: the density without the chance of the lobe. */
TEST(a_density_without_the_chance_is_rejected)
{
    estimate_t light, both;

    see_cap(20, 0.2);
    density_scale = 2;
    light = estimate(by_light, 512);
    both = estimate(by_both, 512);
    CHECK(fabs(light.mean - both.mean) > WITHIN(light) + 4 * both.error,
            "%.6f +- %.6f, %.6f +- %.6f", light.mean, light.error, both.mean,
            both.error);
    NOTE("%.4f, not %.4f", both.mean, light.mean);
}
#endif
#endif

/* ---- Mirror ------------------------------------------------------------ */

#if QL_CFG_MIRROR
/* Twice the error of the normal, 2^-26, and rounding. */
TEST(mirrors_reflect_at_equal_angles)
{
    double worst = 0;

    state = 7;
    set_albedo(0, 0, 0);
    set_gloss(QL_GLOSS_MIRROR, 1, 0, 1);
    for (long k = 0; k < 100000; k++) {
        const ql_uniform2_t u = {(uint32_t)k, 7};
        ql_vec3_t incoming;
        point_t in;
        ql_bsdf_sample_t sample;
        double off;

        set_normal(random_normal());
        incoming = random_incoming();
        in = unit(from_vec(incoming));
        see(true, incoming);
        CHECK(ql_bsdf_sample(&bsdf, QL_DENSITY_UNIFORM, k & 1, (uint32_t)k, u,
                      &sample, true) &&
                        sample.delta && !sample.through,
                "lost");
        check_sample(&sample, 1, true);
        off = angle(from_vec(sample.direction),
                along(in, -2 * dot(in, normal()), normal()));
        worst = fmax(worst, off);
        CHECK(off <= ROUNDED + 0x1p-24, "%.3g rad off", off);
    }
    NOTE("worst %.2f 2^-%d rad", ldexp(worst, QL_DIR_BITS), QL_DIR_BITS);
}

/* Both lobes, each divided by its chance; the delta lobe alone is not. */
TEST(mixed_mirrors_draw_each_lobe_with_its_chance)
{
    static const ql_density_t all[] = {
            QL_DENSITY_BRDF, QL_DENSITY_COSINE, QL_DENSITY_UNIFORM};

    set_albedo(0.5, 0.5, 0.5);
    set_gloss(QL_GLOSS_MIRROR, 0.25, 0, 0.25);
    see_at(40);
    CHECK(ql_bsdf_has_delta(&bsdf) && ql_bsdf_has_spread(&bsdf), "lobes");
    for (int i = 0; i < (QL_CFG_STRATEGIES ? 3 : 2); i++) {
        estimate_t e;
        const ql_uniform2_t u = {0x12345678u, 0x9abcdef0u};
        ql_bsdf_sample_t sample;

        density = all[i];
        e = estimate(drawn_weight, 256);
        CHECK(fabs(e.mean - 0.75) <= WITHIN(e), "density %d: %.6f +- %.6f",
                density, e.mean, e.error);
        CHECK(ql_bsdf_sample(
                      &bsdf, density, false, 0x3fffffffu, u, &sample, false) &&
                        sample.delta &&
                        fabs(channel(&sample.weight, 0) - 1) < 0x1p-28,
                "below the chance");
        CHECK(ql_bsdf_sample(
                      &bsdf, density, false, 0x40000000u, u, &sample, false) &&
                        !sample.delta,
                "at the chance");
        CHECK(ql_bsdf_sample(
                      &bsdf, density, true, 0xffffffffu, u, &sample, false) &&
                        sample.delta && channel(&sample.weight, 0) == 0.25,
                "alone: %.9f", channel(&sample.weight, 0));
    }
}

#if QL_CFG_SMOOTH
/* Whatever the shading normal; where it does not turn the ray away from the
 * surface, at equal angles about it. */
TEST(smooth_mirrors_have_no_black_rim)
{
    long plain = 0, bent = 0;
    double worst = 0;

    state = 8;
    set_albedo(0, 0, 0);
    set_gloss(QL_GLOSS_MIRROR, 1, 0, 1);
    for (long k = 0; k < 100000; k++) {
        const ql_uniform2_t u = {0, 0};
        ql_vec3_t incoming;
        point_t in, axis, shade;
        ql_bsdf_sample_t sample;

        set_normal(random_normal());
        set_shade(60 * stats_random_unit(&state));
        incoming = random_incoming();
        see(true, incoming);
        CHECK(ql_bsdf_sample(
                      &bsdf, QL_DENSITY_BRDF, false, 0, u, &sample, false),
                "lost");
        check_sample(&sample, 1, false);
        in = unit(from_vec(incoming));
        shade = unit(from_vec(surface.shade));
        if (dot(in, shade) > 1e-3) { /* seen from below it */
            shade = normal();
        }
        axis = along(in, -2 * dot(in, shade), shade);
        if (dot(axis, normal()) < -1e-3) {
            axis = along(axis, -2 * dot(axis, normal()), normal());
            bent++;
        } else {
            plain++;
        }
        if (fabs(dot(in, shade)) > 1e-3 && fabs(dot(axis, normal())) > 1e-3) {
            worst = fmax(worst, angle(from_vec(sample.direction), axis));
        }
    }
    CHECK(worst <= ROUNDED + 0x1p-23, "%.3g rad off", worst);
    CHECK(bent > 1000 && plain > 1000, "%ld turned up, %ld not", bent, plain);
    NOTE("%ld turned up, %ld not", bent, plain);
}
#endif
#endif

/* ---- Glass ------------------------------------------------------------- */

#if QL_CFG_GLASS
static const double indices[] = {
        1, 1.0001, 1.33, 1.5, 2.4, 64, 1 / 1.5, 1.0 / 16};

enum { INDICES = sizeof indices / sizeof indices[0] };

/* As the blob holds it. */
static double set_glass(double index)
{
    set_albedo(0, 0, 0);
    set_gloss(QL_GLOSS_GLASS, 1, index, 1);
    return ldexp(QL_LE32(gloss.parameter), -16);
}

static bool draw_glass(ql_uq32_t pick, ql_bsdf_sample_t *sample)
{
    const ql_uniform2_t u = {0, 0};

    return ql_bsdf_sample(&bsdf, QL_DENSITY_BRDF, false, pick, u, sample, true);
}

/* How many of 2^32 picks reflect: they are the smallest. */
static uint64_t reflectance(void)
{
    uint64_t low = 0, high = (uint64_t)1 << 32;

    while (low < high) {
        const uint64_t mid = (low + high) / 2;
        ql_bsdf_sample_t sample;

        if (draw_glass((uint32_t)mid, &sample) && !sample.through) {
            low = mid + 1;
        } else {
            high = mid;
        }
    }
    return low;
}

/* Fresnel's equations as in the textbooks, n = n2/n1. */
static double fresnel(double c, double n)
{
    const double t2 = 1 - (1 - c * c) / (n * n);
    const double t = sqrt(fmax(t2, 0));
    const double s = (c - n * t) / (c + n * t), p = (t - n * c) / (t + n * c);

    return t2 <= 0 ? 1 : (s * s + p * p) / 2;
}

/* How much it may change if the cosine is off by its length's error, the angle
 * by so much, and the index by 2^-30: it dips at Brewster's angle, so all of
 * the range is looked at. Then what a root is off. */
static double fresnel_limit(double c, double n, double angle_off)
{
    const double off = c * LENGTH_ERROR + 0x1p-28 + angle_off * sqrt(1 - c * c);
    const double r = fresnel(c, n);
    double change = 0;

    for (int i = -32; i <= 32; i++) {
        const double at = fmin(fmax(c + off * i / 32, 0), 1);

        change = fmax(change, fabs(fresnel(at, n * (1 - 0x1p-30)) - r));
        change = fmax(change, fabs(fresnel(at, n * (1 + 0x1p-30)) - r));
    }
    return change + (QL_CFG_PRECISION == 0 ? 0x1p-13 : 0x1p-26);
}

#define FRESNEL_ERROR (QL_CFG_PRECISION == 0 ? 0x1p-11 : 0x1p-20)

TEST(fresnel_reflectance_is_right_but_next_to_total_reflection)
{
    double worst = 0;
    long loose = 0;

    set_normal(tilted);
    for (int i = 0; i < 2 * INDICES; i++) {
        const bool front = i < INDICES;
        const double index = set_glass(indices[i % INDICES]);
        const double n = front ? index : 1 / index;

        for (int k = 0; k < 1000; k++) {
            const ql_vec3_t incoming =
                    incoming_at(normal(), (k + 0.5) * PI / 2000, k);
            const double c = -cosine_to_normal(incoming);
            const double exact = fresnel(c, n);
            const double limit = fresnel_limit(c, n, 0);
            double got;

            see(front, incoming);
            got = ldexp((double)reflectance(), -32);
            CHECK(fabs(got - exact) <= limit,
                    "index %g, %s, cos %.9f: %.9f, not %.9f, limit %.2g", index,
                    front ? "front" : "back", c, got, exact, limit);
            /* all but where a rounded cosine decides */
            if (limit < FRESNEL_ERROR) {
                worst = fmax(worst, fabs(got - exact));
            } else {
                loose++;
            }
        }
    }
    CHECK(worst <= FRESNEL_ERROR && loose < 200, "worst %.3g, %ld left out",
            worst, loose);
    NOTE("worst 2^%.1f but for %ld of 16,000", log2(worst), loose);
}

/* ((n - 1)/(n + 1))^2 head on. */
TEST(glass_head_on_has_its_closed_form)
{
    set_normal(vec(0, 0, 12345));
    for (int i = 0; i < INDICES; i++) {
        const double n = set_glass(indices[i]);
        const double root = (n - 1) / (n + 1);
        double got;

        see(true, vec(0, 0, -(1 << QL_DIR_BITS)));
        got = ldexp((double)reflectance(), -32);
        CHECK(fabs(got - root * root) <=
                        (QL_CFG_PRECISION == 0 ? 0x1p-14 : 0x1p-26),
                "index %g: %.9f, not %.9f", n, got, root * root);
    }
}

TEST(snell_holds_both_ways)
{
    double worst = 0;

    set_normal(tilted);
    for (int i = 0; i < 2 * INDICES; i++) {
        const bool front = i < INDICES;
        const double index = set_glass(indices[i % INDICES]);
        const double n = front ? index : 1 / index;

        for (int k = 0; k < 1000; k++) {
            const ql_vec3_t incoming =
                    incoming_at(normal(), (k + 0.5) * PI / 2000, k);
            const point_t in = unit(from_vec(incoming));
            const double c = -dot(in, normal());
            const double t2 = 1 - (1 - c * c) / (n * n);
            ql_bsdf_sample_t sample;
            double off, limit;

            see(front, incoming);
            if (!draw_glass(0xffffffffu, &sample) || !sample.through) {
                CHECK(t2 < 1e-3, "index %g, cos %.6f: not refracted", index, c);
                continue;
            }
            check_sample(&sample, fmax(1, 1 / (n * n)) * (1 + 1e-6), true);
            if (t2 < 1e-6) {
                continue;
            }
            off = angle(from_vec(sample.direction),
                    along(along(point(0, 0, 0), 1 / n, in), c / n - sqrt(t2),
                            normal()));
            /* across the normal what the directions are off, along it what
             * the cosine behind is, each magnified by a larger index */
            limit = ROUNDED + 0x1p-27 * fmax(1, 1 / n) +
                    LENGTH_ERROR * c * fmax(1, 1 / (n * n)) / sqrt(t2);
            worst = fmax(worst, off / limit);
            CHECK(off <= limit,
                    "index %g, %s, cos %.6f: %.3g rad off, limit %.3g", index,
                    front ? "front" : "back", c, off, limit);
        }
    }
    NOTE("worst %.2f of the limit", worst);
}

/* sin = n2/n1 */
TEST(reflection_is_total_from_the_critical_angle_on)
{
    set_normal(tilted);
    for (int i = 2; i < INDICES; i++) {
        const double index = set_glass(indices[i]);
        const bool front = index < 1;
        const double critical = asin(front ? index : 1 / index);
        const double off = QL_CFG_PRECISION == 0 ? 2e-3 : 1e-5;

        see(front, incoming_at(normal(), critical + off, 1));
        CHECK(reflectance() == (uint64_t)1 << 32, "index %g: %.9f", index,
                ldexp((double)reflectance(), -32));
        see(front, incoming_at(normal(), critical - off, 1));
        CHECK(reflectance() < (uint64_t)1 << 32, "index %g: total", index);
    }
}

/* R is the same from both sides of a path, radiance over n^2 is kept, and what
 * is reflected and refracted adds up. */
TEST(glass_is_reciprocal_and_keeps_energy)
{
    long loose = 0;

    set_normal(tilted);
    for (int i = 0; i < INDICES; i++) {
        const double index = set_glass(indices[i]);

        for (int k = 1; k < 80; k++) {
            const double theta = asin(sin(k * PI / 180) * fmin(1, index));
            const double behind = asin(fmin(1, sin(theta) / index));
            ql_bsdf_sample_t there, back;
            const double limit = fresnel_limit(cos(theta), index, ROUNDED) +
                                 fresnel_limit(cos(behind), 1 / index, ROUNDED);
            double r, r2, kept;

            see(true, incoming_at(normal(), theta, k));
            r = ldexp((double)reflectance(), -32);
            CHECK(draw_glass(0xffffffffu, &there) && there.through,
                    "not refracted");
            kept = r + (1 - r) * channel(&there.weight, 0) * index * index;
            CHECK(fabs(kept - 1) <= 1e-8, "index %g: %.10f", index, kept);
            if (limit > 0.01) { /* the rounded ray may miss the way back */
                loose++;
                continue;
            }
            see(false, incoming_at(normal(), behind, k));
            r2 = ldexp((double)reflectance(), -32);
            CHECK(draw_glass(0xffffffffu, &back) && back.through,
                    "not refracted back");
            CHECK(fabs(r - r2) <= limit, "index %g, %d degrees: %.9f, %.9f",
                    index, k, r, r2);
            CHECK(fabs(channel(&there.weight, 0) * channel(&back.weight, 0) -
                          1) <= 1e-8,
                    "there and back: %.10f",
                    channel(&there.weight, 0) * channel(&back.weight, 0));
            CHECK(draw_glass(0, &back) && (r == 0 || !back.through),
                    "the least pick is refracted");
        }
    }
    CHECK(loose <= (QL_CFG_PRECISION == 0 ? 160 : 2), "%ld left out", loose);
    NOTE("all but %ld of %d", loose, INDICES * 79);
}

TEST(glass_has_no_spread_and_filters_by_tf)
{
    ql_bsdf_sample_t sample;
    const ql_real_t one = {0x80000000u, -31};
    ql_rgb_t r;

    (void)set_glass(1);
    gloss.specular[1] = uq31(0.25);
    gloss.specular[2] = 0;
    see_at(40);
    CHECK(ql_bsdf_has_delta(&bsdf) && !ql_bsdf_has_spread(&bsdf), "lobes");
    CHECK(draw_glass(0, &sample) && sample.through &&
                    fabs(channel(&sample.weight, 0) - 1) < 0x1p-29 &&
                    fabs(channel(&sample.weight, 1) - 0.25) < 0x1p-31 &&
                    channel(&sample.weight, 2) == 0,
            "%.9f", channel(&sample.weight, 1));
    CHECK(angle(from_vec(sample.direction), from_vec(bsdf.in)) <= ROUNDED,
            "index 1 bends");
    ql_bsdf_reflect(&bsdf, bsdf.n, one, one, false, &r);
    CHECK(ql_rgb_most(&r) == 0, "reflects %.9f", channel(&r, 0));
}
#endif

#if QL_CFG_MIRROR || QL_CFG_GLASS
/* Along the surface, as near its plane as directions can be: whichever way
 * rounding goes, nothing is lost or lands on the plane. */
static void check_grazing(long *reflected_count, long *through)
{
    for (long k = 0; k < 60000; k++) {
        const ql_uniform2_t u = {0, 0};
        ql_bsdf_sample_t sample;
        ql_vec3_t incoming;

        set_normal(random_normal());
        incoming = incoming_at(
                normal(), PI / 2, 2 * PI * stats_random_unit(&state));
        if (ql_vec_dot_normal(incoming, surface.n) >= 0) {
            continue;
        }
        see(k & 1, incoming);
        CHECK(ql_bsdf_sample(&bsdf, QL_DENSITY_BRDF, true,
                      k & 2 ? 0xffffffffu : 0, u, &sample, true),
                "lost");
        check_sample(&sample, 1e6, true);
        *reflected_count += !sample.through;
        *through += sample.through;
    }
}

TEST(grazing_rays_are_never_lost)
{
    long reflected_count = 0, through = 0;

    state = 9;
#if QL_CFG_MIRROR
    set_albedo(0, 0, 0);
    set_gloss(QL_GLOSS_MIRROR, 1, 0, 1);
    check_grazing(&reflected_count, &through);
#endif
#if QL_CFG_GLASS
    (void)set_glass(1);
    check_grazing(&reflected_count, &through);
    (void)set_glass(1 + 0x1p-16);
    check_grazing(&reflected_count, &through);
    (void)set_glass(1.5);
    check_grazing(&reflected_count, &through);
#endif
    CHECK(reflected_count > 10000, "%ld", reflected_count);
    NOTE("%ld reflected, %ld through", reflected_count, through);
}
#endif

/* ---- Extremes ---------------------------------------------------------- */

/* Every sample of the material that is set, at every corner of the random
 * numbers, seen along the normal and as grazing as 2^-15. */
static unsigned long extremes(double most)
{
    unsigned long count = 0;

    for (int axis = 0; axis < 27; axis++) {
        const ql_vec3_t n = vec((axis % 3 - 1) * 0x3fffffff,
                (axis / 3 % 3 - 1) * 0x3fffffff, (axis / 9 - 1) * 0x3fffffff);
        point_t s, t, d;

        if (axis == 13) {
            continue;
        }
        for (int k = 0; k < 8; k++) {
            set_normal(n);
            across(normal(), &s, &t);
            d = along(k & 1 ? s : t, -(k & 2 ? 1 : 0x1p-15), normal());
#if QL_CFG_SMOOTH
            if (k & 4) {
                set_shade(70);
            }
#endif
            see(k & 2, ql_vec_to_dir(to_q29(unit(d))));
            for (int i = 0; i < CORNERS * CORNERS * CORNERS; i++) {
                const ql_uniform2_t u = {
                        corners[i % CORNERS], corners[i / CORNERS % CORNERS]};
                const ql_density_t which = i % 3 == 0   ? QL_DENSITY_BRDF
                                           : i % 3 == 1 ? QL_DENSITY_COSINE
                                                        : QL_DENSITY_UNIFORM;
                ql_bsdf_sample_t sample;

                if (ql_bsdf_sample(&bsdf, which, (i & 8) != 0,
                            corners[i / (CORNERS * CORNERS)], u, &sample,
                            i & 16)) {
                    check_sample(&sample, which == QL_DENSITY_BRDF ? most : 1e6,
                            QL_CFG_STRATEGIES && which == QL_DENSITY_BRDF &&
                                    (i & 16));
                    count++;
                }
            }
        }
    }
    return count;
}

TEST(extremes_stay_on_their_side_and_below_their_weights)
{
    unsigned long count;

    set_albedo(1, 1, 1);
    count = extremes(1);
#if QL_CFG_PHONG
    for (int i = 0; i < EXPONENTS; i++) {
        set_phong(0, 1, exponents[i], 1);
        count += extremes((exponents[i] + 2) / (exponents[i] + 1));
    }
    set_phong(0.5, 0.5, 65535.99998, 0.5);
    count += extremes(1 + 1 / 65536.0);
#endif
#if QL_CFG_MIRROR
    set_albedo(0.5, 0.5, 0.5);
    set_gloss(QL_GLOSS_MIRROR, 0.5, 0, 0.5);
    count += extremes(1);
#endif
#if QL_CFG_GLASS
    for (int i = 0; i < INDICES; i++) {
        const double n = set_glass(indices[i]);

        count += extremes(fmax(n * n, 1 / (n * n)) * (1 + 1e-8));
    }
#endif
    CHECK(count > 10000, "%lu samples", count);
    NOTE("%lu samples", count);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_bsdf", argc, argv);
    RUN(diffuse_directions_and_weights_are_the_old_bits);
    RUN(diffuse_directions_have_the_albedo_and_a_mean_cosine_of_2_3);
    RUN(black_surfaces_lose_all_light);
    RUN(cosines_are_within_their_bounds);
#if QL_CFG_STRATEGIES
    RUN(uniform_directions_have_the_mean_of_the_cosine);
    RUN(diffuse_density_is_the_cosine_over_pi);
#endif
#if QL_CFG_SMOOTH
    RUN(smooth_surfaces_lose_what_is_below_the_plane);
#endif
#if QL_CFG_PHONG
    RUN(phong_lobes_have_the_albedos_of_the_table);
    RUN(phong_lobes_are_cut_at_the_horizon);
    RUN_IF(TABLES_EXACT, phong_lobes_of_exponent_n_plus_1_are_rejected);
    RUN(phong_weights_without_the_cosine_are_rejected);
    RUN(every_density_has_the_same_mean);
    RUN(colours_of_both_lobes_keep_apart);
    RUN(lobes_of_no_chance_are_never_drawn);
    RUN(phong_directions_match_their_density);
    RUN(phong_directions_of_another_exponent_are_rejected);
    RUN(light_from_all_around_is_reflected_by_the_albedo);
#if QL_CFG_STRATEGIES
    RUN(densities_are_those_of_the_lobe_drawn);
    RUN(light_and_directions_and_both_have_the_same_mean);
    RUN_IF(TABLES_EXACT, a_density_without_the_chance_is_rejected);
#endif
#endif
#if QL_CFG_MIRROR
    RUN(mirrors_reflect_at_equal_angles);
    RUN(mixed_mirrors_draw_each_lobe_with_its_chance);
#if QL_CFG_SMOOTH
    RUN(smooth_mirrors_have_no_black_rim);
#endif
#endif
#if QL_CFG_GLASS
    RUN(fresnel_reflectance_is_right_but_next_to_total_reflection);
    RUN(glass_head_on_has_its_closed_form);
    RUN(snell_holds_both_ways);
    RUN(reflection_is_total_from_the_critical_angle_on);
    RUN(glass_is_reciprocal_and_keeps_energy);
    RUN(glass_has_no_spread_and_filters_by_tf);
#endif
#if QL_CFG_MIRROR || QL_CFG_GLASS
    RUN(grazing_rays_are_never_lost);
#endif
    RUN(extremes_stay_on_their_side_and_below_their_weights);
    return TEST_END();
}
