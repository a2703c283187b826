/* known_spheres.c - spheres that shine, hide the sky, or enclose everything */
/* SPDX-License-Identifier: MIT */

/* A point under a sphere of radiance L reflects L F, F a closed form even where
 * the sphere crosses the point's horizon. Expected values are worked out for
 * where the point really is: one ulp above its plane. */

#include <math.h>
#include <stdlib.h>

#include "support/picture/estimate.h"
#include "support/ql_double.h"
#include "support/ql_test.h"
#include "qlux.h"
#include "math/vec/ql_vec_unit.h"
#include "light/ql_emit.h"
#include "trace/surface/ql_surface_at.h"
#include "trace/ql_bvh.h"
#include "trace/ql_sphere.h"

#define ULP      (1.0 / (1 << QL_POS_BITS)) /* grid units */
#define RADIANCE 0.5

static mini_scene_t m;

/* ---- One point and one sphere -------------------------------------------- */

/* Where the receiver is, grid units; its normal is +z. */
static const int32_t at[3] = {16384, 16384, 16384};

static double offset[3]; /* from the lifted receiver to the centre */
static double radius;    /* both in grid units */

/* White, looked at from a little above: low enough for any sphere. */
static void begin_point(double eye_height)
{
    static const int32_t reach = 64;
    const int32_t a[3] = {at[0] - reach, at[1] - reach, at[2]};
    const int32_t b[3] = {at[0] + reach, at[1] - reach, at[2]};
    const int32_t c[3] = {at[0] + reach, at[1] + reach, at[2]};
    const int32_t d[3] = {at[0] - reach, at[1] + reach, at[2]};

    mini_begin(&m);
    mini_quad(&m, a, b, c, d, mini_material(&m, 1, 0));
    mini_eye(&m, at[0], at[1], at[2] + eye_height);
    mini_look(&m, 0, 0, -0.5);
}

/* A sphere whose centre is so far from the receiver, to 1/256 grid unit. */
static void add_ball(double x, double y, double z, double r, uint16_t material)
{
    const double from[3] = {x, y, z};
    int32_t centre[3];

    for (int k = 0; k < 3; k++) {
        centre[k] = at[k] * 256 + (int32_t)lround(from[k] * 256);
        offset[k] = centre[k] / 256.0 - at[k] - (k == 2 ? ULP : 0);
    }
    radius = (double)lround(r * 256) / 256;
    (void)mini_sphere(&m, centre, (int32_t)lround(r * 256), material);
}

/* F of a sphere at distance h radii, seen at an angle of this cosine. */
static double form_factor(double h, double cosine)
{
    const double tangent = sqrt(h * h - 1), sine = sqrt(1 - cosine * cosine);

    if (cosine >= 1 / h) {
        return cosine / (h * h);
    }
    if (cosine <= -1 / h) {
        return 0;
    }
    return 0.5 - asin(tangent / (h * sine)) / PI +
           (cosine * acos(-tangent * cosine / sine) -
                   tangent * sqrt(1 - h * h * cosine * cosine)) /
                   (PI * h * h);
}

/* Of the sphere that was added last. */
static double expected(void)
{
    const double d = sqrt(offset[0] * offset[0] + offset[1] * offset[1] +
                          offset[2] * offset[2]);

    return form_factor(d / radius, offset[2] / d);
}

static stats_moments_t measure(int strategy, uint32_t samples)
{
    ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 0, 21);
    stats_moments_t got;

    s.direct = strategies[strategy].direct;
    got = estimate_pixel(&m, &s, 0, 0, samples);
    got.mean /= RADIANCE;
    got.m2 /= RADIANCE * RADIANCE;
    return got;
}

/* Standard errors off, plus what the rounding of sums may be. A cosine sample
 * is a hit or none, so its variance is known. */
static double off_by(int strategy, const stats_moments_t *got, double want)
{
    const double variance =
            strategy == COSINE ? want * (1 - want) : stats_variance(got);

    return (got->mean - want) / (sqrt(variance / got->n) + 5e-8);
}

/* ---- The closed form ----------------------------------------------------- */

static const struct {
    double h, degrees, form_factor;
} balls[] = {{2, 0, 0.25}, {2, 45, 0.1767766952966369}, {2, 60, 0.125},
        {2, 75, 0.07041042695343}, {2, 90, 0.028834442811219},
        {2, 105, 0.0057056656778003}, {2, 119, 7.283674979095e-6}, {2, 120, 0},
        {10, 85, 8.7297545119371e-4}, {10, 90, 2.1284664328895e-4},
        {10, 95, 1.4180237171287e-6}, {1.01, 0, 0.9802960494},
        {1.01, 90, 0.41093153821012}};
enum { BALLS = sizeof balls / sizeof *balls };

TEST(formula_gives_the_known_digits)
{
    for (int i = 0; i < BALLS; i++) {
        const double f =
                form_factor(balls[i].h, cos(balls[i].degrees * PI / 180));

        CHECK(fabs(f - balls[i].form_factor) < 1e-8, "row %d: %.14f", i, f);
    }
}

static void make_ball(int i)
{
    const double turn = balls[i].degrees * PI / 180;
    const double r = balls[i].h > 9 ? 1000 : balls[i].h > 1.5 ? 4000 : 8000;
    const double d = balls[i].h * r;

    begin_point(64);
    add_ball(
            d * sin(turn), 0, d * cos(turn), r, mini_material(&m, 0, RADIANCE));
}

/* Not by area next to the sphere, where 1/r^2 gives one sample a standard
 * deviation of a hundred times the mean; directions only where some hit. */
TEST(every_strategy_gives_the_form_factor_of_a_sphere)
{
    double worst = 0;
    int count = 0;

    for (int i = 0; i < BALLS; i++) {
        for (int k = 0; k < STRATEGIES; k++) {
            const uint32_t n = 1u << 16;
            stats_moments_t got;
            double want, z;

            make_ball(i);
            want = expected();
            if ((k == AREA && balls[i].h < 1.5) ||
                    ((k == HEMISPHERE || k == COSINE) && want > 0 &&
                            want * n < 10)) {
                continue;
            }
            got = measure(k, n);
            z = off_by(k, &got, want);
            CHECK(want > 0 ? fabs(z) < STATS_Z_MAX
                           : got.mean == 0 && got.m2 == 0,
                    "d/R %g, %g degrees, %s: %.9f, want %.9f, z %.1f",
                    balls[i].h, balls[i].degrees, strategies[k].name, got.mean,
                    want, z);
            worst = want > 0 ? fmax(worst, fabs(z)) : worst;
            count++;
        }
    }
    NOTE("%d cases, worst z %.1f; at 120 degrees exactly 0", count, worst);
}

TEST(form_factors_reject_a_sphere_a_fiftieth_larger_and_a_lost_horizon)
{
    for (int k = 0; k < STRATEGIES; k++) {
        stats_moments_t got;
        double z;

        make_ball(1);
        got = measure(k, 1u << 17);
        z = off_by(k, &got, form_factor(2 / 1.04, sqrt(0.5)));
        CHECK(fabs(z) > STATS_Z_MAX, "%s: a larger one passes, z %.1f",
                strategies[k].name, z);
        /* what is below the horizon counted negative: cos / H^2 */
        make_ball(3);
        got = measure(k, 1u << 17);
        z = off_by(k, &got, cos(75 * PI / 180) / 4);
        CHECK(fabs(z) > STATS_Z_MAX, "%s: no horizon passes, z %.1f",
                strategies[k].name, z);
    }
}

/* Samples of a sphere's light before they are summed: a sum keeps 2^-24 of a
 * radiance unit, more than the smallest sphere gives. */
static stats_moments_t aim_at_ball(int strategy, uint32_t samples)
{
    stats_moments_t moments = {0, 0, 0};
    ql_surface_t surface;
    ql_sampler_t sampler;
    ql_scene_t scene;
    ql_hit_t hit;
    ql_ray_t ray;

    mini_open(&m, &scene);
    ray.origin.x = at[0] * (1 << QL_POS_BITS);
    ray.origin.y = at[1] * (1 << QL_POS_BITS);
    ray.origin.z = (at[2] + 64) * (1 << QL_POS_BITS);
    ray.direction.x = ray.direction.y = 0;
    ray.direction.z = -(1 << QL_DIR_BITS);
    CHECK(ql_bvh_closest_hit(&scene, &ray, &hit), "no receiver");
    ql_surface_at(&scene, &ray, &hit, &surface);
    ql_sampler_begin(&sampler, QL_SAMPLER_RANDOM, 22, 0, 0);
    for (uint32_t i = 0; i < samples; i++) {
        ql_emit_sample_t sample;
        double x = 0;

        ql_sampler_start(&sampler, i);
        if (ql_emit_sample(&scene, strategies[strategy].direct, 0, &surface,
                    ql_sampler_2d(&sampler, 0), &sample)) {
            x = ldexp(sample.cosine.m, sample.cosine.e) *
                ldexp(sample.inv_pdf.m, sample.inv_pdf.e) / PI;
        }
        stats_add(&moments, x);
    }
    return moments;
}

/* The smallest has a radius of one grid unit. Points of its area vary by more
 * than their mean, so there the error is judged by itself. In draft the
 * receiver is a grid unit above its plane, 1e-4 of the distance. */
TEST(small_spheres_are_right_to_a_part_in_a_thousand)
{
    double worst = 0;

    for (int power = 1; power <= 4; power++) {
        const double d = 10000, r = d * pow(10, -power);

        for (int k = 0; k < STRATEGIES; k++) {
            const double f = 0.8 * (r / d) * (r / d);
            stats_moments_t got;
            double want;

            if (k == HEMISPHERE || k == COSINE) {
                continue; /* they do not aim */
            }
            begin_point(64);
            add_ball(0.6 * d, 0, 0.8 * d, r, mini_material(&m, 0, RADIANCE));
            want = expected();
            got = aim_at_ball(k, 1u << 14);
            CHECK(fabs(want / f - 1) < 5e-4, "R/d 1e-%d: expected %.6g, %.6g",
                    power, want, f);
            CHECK(k == AREA ? fabs(estimate_z(&got, want,
                                      stats_variance(&got))) < STATS_Z_MAX
                            : fabs(got.mean / want - 1) < 1e-3,
                    "R/d 1e-%d, %s: %.9g, want %.9g", power, strategies[k].name,
                    got.mean, want);
            if (k != AREA) {
                worst = fmax(worst, fabs(got.mean / want - 1));
            }
        }
    }
    NOTE("R/d 1e-1 to 1e-4, worst %.1e", worst);
}

/* ---- In, on and just outside a sphere ------------------------------------ */

TEST(receiver_inside_sees_all_of_a_two_sided_sphere_and_none_of_another)
{
    for (int two_sided = 0; two_sided < 2; two_sided++) {
        for (int k = 0; k < STRATEGIES; k++) {
            stats_moments_t got;

            begin_point(64);
            m.two_sided = two_sided != 0;
            add_ball(1500, 900, -600, 6000, mini_material(&m, 0, RADIANCE));
            got = measure(k, 1u << 14);
            CHECK(two_sided ? fabs(off_by(AREA, &got, 1)) < STATS_Z_MAX
                            : got.mean == 0 && got.m2 == 0,
                    "%s, two-sided %d: %.7f", strategies[k].name, two_sided,
                    got.mean);
            /* cosine directions all see the same, drawn by whichever; shares
             * are of directions rounded to b bits */
            CHECK(!two_sided || k == AREA || k == HEMISPHERE ||
                            (fabs(got.mean - 1) < 1e-6 &&
                                    stats_variance(&got) <
                                            1e-12 + ldexp(1, -2 * QL_DIR_BITS)),
                    "%s: %.9f, variance %g", strategies[k].name, got.mean,
                    stats_variance(&got));
        }
    }
}

/* The receiver's plane holds the centre; half of what is above it is sphere. An
 * ulp above that plane it is outside, by next to nothing; with the centre an
 * ulp up too it is exactly on the sphere, which counts as inside. */
TEST(receiver_on_a_sphere_sees_half_of_it_or_none)
{
    for (int exact = 0; exact < 2; exact++) {
        for (int two_sided = 0; two_sided < 2; two_sided++) {
            for (int k = HEMISPHERE; k < STRATEGIES; k++) {
                const double want = exact && !two_sided ? 0 : 0.5;
                stats_moments_t got;

                begin_point(64);
                m.two_sided = two_sided != 0;
                add_ball(-4000, 0, exact ? ULP : 0, 4000,
                        mini_material(&m, 0, RADIANCE));
                got = measure(k, 1u << 16);
                CHECK(fabs(off_by(AREA, &got, want)) < STATS_Z_MAX,
                        "%s, exactly %d, two-sided %d: %.6f, want %.1f",
                        strategies[k].name, exact, two_sided, got.mean, want);
            }
        }
    }
}

/* Points of its area are finite, but a mean of them is beyond any number of
 * samples. */
TEST(receiver_one_unit_outside_sees_almost_nothing_else)
{
    for (int k = 0; k < STRATEGIES; k++) {
        stats_moments_t got;
        double want;

        begin_point(1);
        m.radiance_exp = 14;
        add_ball(0, 0, 8002, 8000, mini_material(&m, 0, RADIANCE));
        want = expected();
        got = measure(k, 1u << 16);
        CHECK(k == AREA ? got.mean >= 0 && got.m2 >= 0
                        : fabs(got.mean - want) <
                                  STATS_Z_MAX * sqrt(stats_variance(&got) /
                                                        got.n) +
                                          1e-3,
                "%s: %.6f, want %.6f", strategies[k].name, got.mean, want);
    }
}

/* ---- A sphere on a plane hides the sky ----------------------------------- */

static const struct {
    double a, open; /* distance from the contact in radii; what is left */
} resting[] = {{.25, 0.0869247057}, {.5, 0.2844582472}, {1, 0.6464466094},
        {2, 0.9105572809}, {4, 0.9857331985}};
enum { RESTING = sizeof resting / sizeof *resting };

TEST(sphere_resting_on_a_plane_hides_the_known_part_of_the_sky)
{
    const double r = 3000;
    double worst = 0;

    for (int i = 0; i < RESTING; i++) {
        const double a = resting[i].a;
        const double known = 1 - pow(1 + a * a, -1.5);

        CHECK(fabs(known - resting[i].open) < 1e-10, "%.10f, known %.10f",
                known, resting[i].open);
        for (int k = 0; k < STRATEGIES; k++) {
            stats_moments_t got;
            double want, z;

            begin_point(16);
            add_ball(a * r, 0, r, r, mini_material(&m, 0, 0));
            mini_sky(&m, RADIANCE, RADIANCE, RADIANCE);
            want = 1 - expected();
            CHECK(fabs(want - known) < 1e-7 + 4 * ULP / (a * r),
                    "a %g: lifted %.9f, known %.9f", a, want, known);
            got = measure(k, 1u << 16);
            z = off_by(k == HEMISPHERE || k == MIS ? AREA : COSINE, &got, want);
            CHECK(fabs(z) < STATS_Z_MANY, "a %g, %s: %.7f, want %.7f, z %.1f",
                    a, strategies[k].name, got.mean, want, z);
            /* and rejects a sphere lifted by a fifth of its radius */
            want = 1 - form_factor(sqrt(a * a + 1.2 * 1.2),
                               1.2 / sqrt(a * a + 1.2 * 1.2));
            CHECK(a > 1.5 || fabs(off_by(AREA, &got, want)) > STATS_Z_MAX,
                    "a %g, %s: %.7f passes for %.7f", a, strategies[k].name,
                    got.mean, want);
            worst = fmax(worst, fabs(z));
        }
    }
    NOTE("%d distances, worst z %.1f", RESTING, worst);
}

/* ---- Inside a sphere that shines ----------------------------------------- */

static void make_enclosure(double albedo)
{
    static const int32_t centre[3] = {16384 * 256, 16384 * 256, 16384 * 256};
    static const double right[3] = {0.25, 0, -0.125}, up[3] = {0, 0.25, 0};

    mini_begin(&m);
    (void)mini_sphere(
            &m, centre, 16000 * 256, mini_material(&m, albedo, RADIANCE));
    m.two_sided = true;
    mini_eye(&m, 12000, 17000, 14000);
    mini_look(&m, 0.125, 0.0625, 0.25);
    mini_field(&m, right, up);
}

static double series(double albedo, unsigned reflections)
{
    return (1 - pow(albedo, reflections + 1.0)) / (1 - albedo);
}

/* From inside every point of a sphere gives every other the same: by area, too,
 * A cos cos' / (pi r^2) is 1. A vertex is within an ulp of the sphere, which
 * moves that by an ulp over the distance to the point. */
TEST(enclosing_sphere_gives_the_series_by_every_strategy_and_density)
{
    static const double albedos[] = {0.5, 0.8};
    double worst = 0, spread = 0;

    for (int i = 0; i < 2 * STRATEGIES * 3; i++) {
        const double albedo = albedos[i % 2], want = series(albedo, 4);
        const int k = i / 2 % STRATEGIES;
        ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 3, 30);
        stats_moments_t got;
        double error, off;

        s.direct = strategies[k].direct;
        s.indirect = (uint8_t)(i / (2 * STRATEGIES) + QL_INDIRECT_COSINE);
        make_enclosure(albedo);
        got = estimate_pixel(&m, &s, 0, 0, 1u << 13);
        got.mean /= RADIANCE;
        error = sqrt(stats_variance(&got) / got.n) / RADIANCE;
        off = fabs(got.mean - want);
        CHECK(off < STATS_Z_MAX * error + 20 * ULP / 16000 * want,
                "albedo %g, %s, indirect %d: %.7f, want %.7f, error %.7f",
                albedo, strategies[k].name, s.indirect, got.mean, want, error);
        if (k == COSINE && s.indirect != QL_INDIRECT_UNIFORM) {
            CHECK(error == 0 && off < 1e-6, "albedo %g, cosine: %.9f, error %g",
                    albedo, got.mean, error);
        }
        if (k != HEMISPHERE && s.indirect != QL_INDIRECT_UNIFORM) {
            CHECK(error * sqrt(got.n) < 0.05 * want, "%s: spread %g",
                    strategies[k].name, error * sqrt(got.n));
            spread = fmax(spread, error * sqrt(got.n) / want);
        }
        worst = fmax(worst, off / want);
        CHECK(off < fabs(want - series(albedo, 3)) / 2, "one term less");
    }
    NOTE("worst part off %.0e; spread of samples %.0e", worst, spread);
}

/* ---- Many spheres -------------------------------------------------------- */

enum { MANY = 900, RAYS = 20000 };

static void make_many(unsigned node_bits)
{
    uint64_t random = 7;
    const uint16_t black = (mini_begin(&m), mini_material(&m, 0, 0));

    m.node_bits = node_bits;
    for (int i = 0; i < MANY; i++) {
        const int32_t r =
                (int32_t)(256 + stats_random_below(&random, 1u << 18));
        int32_t centre[3];

        for (int k = 0; k < 3; k++) {
            centre[k] = 2100 * 256 + r +
                        (int32_t)stats_random_below(
                                &random, (uint64_t)(28000 * 256 - 2 * r));
        }
        (void)mini_sphere(&m, centre, r, black);
    }
}

/* The nearest of all, one by one; ties go to the first. */
static bool nearest(const ql_scene_t *scene, const ql_ray_t *ray, ql_hit_t *hit)
{
    bool found = false;

    for (unsigned i = 0; i < MANY; i++) {
        ql_uq30_t t;
        const int side = ql_sphere_hit(
                ql_scene_sphere(scene, scene->triangles + i), ray, &t);

        if (side != 0 && (!found || t < hit->t)) {
            hit->t = t;
            hit->tri_idx = (uint16_t)i;
            hit->front = side > 0;
            found = true;
        }
    }
    return found;
}

static int32_t random_part(uint64_t *random, int32_t range)
{
    return (int32_t)stats_random_below(random, (uint64_t)(2 * range)) - range;
}

TEST(tree_of_spheres_finds_what_trying_each_one_finds)
{
    unsigned hits = 0;

    for (unsigned bits = 8; bits <= 16; bits += 8) {
        uint64_t random = 8;
        ql_scene_t scene;

        make_many(bits);
        mini_open(&m, &scene);
        for (int i = 0; i < RAYS / 2; i++) {
            const int32_t range = 1 << (QL_DIR_BITS - 1);
            ql_ray_t ray;
            ql_hit_t want = {.tri_idx = 0}, got;
            ql_vec3_t d;
            bool hit, found;

            ray.origin.x = (int32_t)(stats_random_below(&random, 32767) *
                                     (1u << QL_POS_BITS));
            ray.origin.y = (int32_t)(stats_random_below(&random, 32767) *
                                     (1u << QL_POS_BITS));
            ray.origin.z = (int32_t)(stats_random_below(&random, 32767) *
                                     (1u << QL_POS_BITS));
            d.x = random_part(&random, range) * 128;
            d.y = random_part(&random, range) * 128;
            d.z = random_part(&random, range) * 128;
            ray.direction = ql_vec_to_dir(d);
            hit = nearest(&scene, &ray, &want);
            found = ql_bvh_closest_hit(&scene, &ray, &got);
            /* the tree keeps t as a fraction: it may round once more */
            CHECK(found == hit &&
                            (!hit ||
                                    (got.tri_idx == want.tri_idx &&
                                            got.front == want.front &&
                                            fabs((double)got.t - want.t) <=
                                                    4 + want.t * ldexp(1,
                                                                         -24))),
                    "ray %d: sphere %u at %lu, want %u at %lu", i, got.tri_idx,
                    (unsigned long)got.t, want.tri_idx, (unsigned long)want.t);
            hits += hit;
        }
    }
    CHECK(hits > RAYS / 8 && hits < RAYS, "%u hits tell little", hits);
    NOTE("%d spheres, %d rays, %u hits", MANY, RAYS, hits);
}

/* Disjoint or not, black spheres under a white sky hide what they hide: every
 * strategy agrees on what is left of it in their middle. */
TEST(every_strategy_agrees_on_the_sky_between_many_spheres)
{
    stats_moments_t got[STRATEGIES];
    double worst = 0;

    for (int k = 0; k < STRATEGIES; k++) {
        uint64_t random = 9;

        const uint16_t black = (begin_point(16), mini_material(&m, 0, 0));

        for (int i = 0; i < 400; i++) {
            add_ball(random_part(&random, 12000), random_part(&random, 12000),
                    7500 + random_part(&random, 5000),
                    800 + random_part(&random, 700), black);
        }
        mini_sky(&m, RADIANCE, RADIANCE, RADIANCE);
        got[k] = measure(k, 1u << 16);
        for (int j = 0; j < k; j++) {
            const double z = (got[k].mean - got[j].mean) /
                             sqrt(stats_variance(got + k) / got[k].n +
                                     stats_variance(got + j) / got[j].n);

            CHECK(fabs(z) < 4, "%s %.6f, %s %.6f", strategies[j].name,
                    got[j].mean, strategies[k].name, got[k].mean);
            worst = fmax(worst, fabs(z));
        }
    }
    CHECK(got[0].mean > 0.02 && got[0].mean < 0.98, "%.6f tells little",
            got[0].mean);
    NOTE("%.4f is left; worst z %.1f", got[0].mean, worst);
}

/* ---- A smooth ball of few triangles -------------------------------------- */

enum { SIDE = 24, WHOLE = SIDE * SIDE };

/* Seen from the front, a small lamp at the left; the ball fills the picture, so
 * that its rim is left out. 0 parts: the sphere itself. */
static void make_smooth(int parts)
{
    static const int32_t centre[3] = {20000, 16000, 16000};
    static const double right[3] = {5000, 0, 0}, up[3] = {0, 5000, 0};
    static const int32_t lamp[4][3] = {{100, 15800, 19800}, {100, 16200, 19800},
            {100, 16200, 20200}, {100, 15800, 20200}};
    uint16_t white;

    mini_begin(&m);
    m.radiance_exp = 8;
    white = mini_material(&m, 1, 0);
    mini_quad(&m, lamp[0], lamp[1], lamp[2], lamp[3], mini_material(&m, 0, 99));
    if (parts > 0) {
        mini_smooth_ball(&m, centre, 8000, parts, white);
    } else {
        const int32_t of[3] = {20000 * 256, 16000 * 256, 16000 * 256};

        (void)mini_sphere(&m, of, 8000 * 256, white);
    }
    m.width = m.height = SIDE;
    mini_eye(&m, 20000, 16000, 30000);
    mini_window(&m, right, up);
    mini_look(&m, 0, 0, -0.5);
}

static void draw_smooth(double pixels[WHOLE])
{
    ql_settings_t s = estimate_settings(QL_SAMPLER_SOBOL, 0, 1);
    ql_scene_t scene;
    ql_render_t render;

    mini_open(&m, &scene);
    CHECK(ql_render_init(&render, &scene, &s) == QL_OK, "settings");
    for (uint16_t i = 0; i < WHOLE; i++) {
        ql_sum_t sum = {{0, 0, 0}};

        ql_render_pixel(&render, i % SIDE, i / SIDE, 0, 16, &sum);
        pixels[i] = (double)sum.rgb[0];
    }
}

/* As qlux-diff has it. */
static double relative_error(
        const double pixels[WHOLE], const double want[WHOLE])
{
    double mean = 0, sum = 0;

    for (int i = 0; i < WHOLE; i++) {
        mean += want[i] / WHOLE;
    }
    for (int i = 0; i < WHOLE; i++) {
        const double off = pixels[i] - want[i];

        sum += off * off / (want[i] * want[i] + 0.01 * mean * mean) / WHOLE;
    }
    return sum;
}

/* A facet that turns away from the lamp before its normals do is not black:
 * points are lifted to where the sphere would be. Unlifted it is 48 times as
 * far off (tests/mutants), and without normals more than that. */
TEST(smooth_balls_are_lit_as_the_spheres_they_stand_for)
{
    static double sphere[WHOLE], ball[WHOLE], flat[WHOLE];
    double error, of_flat;

    make_smooth(0);
    draw_smooth(sphere);
    make_smooth(8);
    draw_smooth(ball);
    memset(m.normals, 0, sizeof m.normals);
    draw_smooth(flat);
    error = relative_error(ball, sphere);
    of_flat = relative_error(flat, sphere);
    CHECK(error < 4e-4, "relmse %.2g", error);
    CHECK(of_flat > 4e-3, "flat triangles pass: relmse %.2g", of_flat);
    NOTE("relmse %.2g, of flat triangles %.2g", error, of_flat);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("known/spheres", argc, argv);
    RUN(formula_gives_the_known_digits);
    RUN(every_strategy_gives_the_form_factor_of_a_sphere);
    RUN(form_factors_reject_a_sphere_a_fiftieth_larger_and_a_lost_horizon);
    RUN(small_spheres_are_right_to_a_part_in_a_thousand);
    RUN(receiver_inside_sees_all_of_a_two_sided_sphere_and_none_of_another);
    RUN(receiver_on_a_sphere_sees_half_of_it_or_none);
    RUN(receiver_one_unit_outside_sees_almost_nothing_else);
    RUN(sphere_resting_on_a_plane_hides_the_known_part_of_the_sky);
    RUN(enclosing_sphere_gives_the_series_by_every_strategy_and_density);
    RUN(tree_of_spheres_finds_what_trying_each_one_finds);
    RUN(every_strategy_agrees_on_the_sky_between_many_spheres);
    RUN(smooth_balls_are_lit_as_the_spheres_they_stand_for);
    return TEST_END();
}
