/* known_form_factor.c - a point lit by polygons: mean and variance are known */
/* SPDX-License-Identifier: MIT */

/* A white floor under one emitter of radiance L, seen at one point: what leaves
 * it is L F, F the emitter's form factor by Lambert's formula, and one sample
 * has a variance that quadrature gives. All rays of a picture meet the point,
 * so the samples of a pixel are samples of the estimator. The core lifts the
 * point by one ulp and lowers the sample on the emitter by one (the exact side
 * test); expected values are worked out for where they really are. */

#include <math.h>
#include <stdlib.h>

#include "support/picture/estimate.h"
#include "support/picture/lambert.h"
#include "support/ql_double.h"
#include "support/ql_test.h"
#include "support/picture/film_add.h"
#include "sample/ql_sampler.h"
#include "light/ql_emit_triangle.h"
#include "light/ql_light.h"

#define ULP (1.0 / (1 << QL_POS_BITS)) /* grid units */

/* An emitter over the origin; coordinates in units of scale grid units. */
typedef struct {
    const char *name;
    double form_factor; /* from truth: ten digits and more */
    int32_t scale;      /* grid units a unit */
    int corners;        /* 3 or 4, the front towards the receiver */
    double corner[4][3];
    int32_t normal[3], normal_length; /* of the receiver */
    double variance; /* of one sample by area; 0: only by quadrature */
} case_t;

#define UP {0, 0, 1}, 1
static const case_t cases[] = {
        {"square_at_1", 0.2394564704607735, 8000, 4,
                {{-.5, -.5, 1}, {-.5, .5, 1}, {.5, .5, 1}, {.5, -.5, 1}}, UP,
                0.0017405096},
        {"square_at_0.1", 0.9683395569740398, 20000, 4,
                {{-.5, -.5, .1}, {-.5, .5, .1}, {.5, .5, .1}, {.5, -.5, .1}},
                UP, 0},
        {"square_at_10", 0.003172525532555426, 3000, 4,
                {{-.5, -.5, 10}, {-.5, .5, 10}, {.5, .5, 10}, {.5, -.5, 10}},
                UP, 4.452103e-11},
        {"square_tilted", 0.1915651763686188, 8000, 4,
                {{-.5, -.5, 1}, {-.5, .5, 1}, {.5, .5, 1}, {.5, -.5, 1}},
                {3, 0, 4}, 5, 0},
        {"triangle", 0.2188754127462383, 7000, 3,
                {{1, 0, 1}, {-1, -1, 2}, {0, 1, 1}}, UP, 0},
        {"triangle_across_the_horizon", 0.1163103269550030, 7000, 3,
                {{2, 0, -1}, {1, 1, 3}, {0, 2, 1}}, UP, 0},
};
enum { CASES = sizeof cases / sizeof *cases };

/* The wall that stands on the floor, at distances of 1 to 1e-3. */
static const struct {
    int32_t distance; /* in units of 1e-4 */
    double form_factor;
} wall[] = {{10000, 0.07109343904694551}, {1000, 0.4225448602390583},
        {100, 0.4921589521634546}, {10, 0.4992157975962600}};
enum { WALLS = sizeof wall / sizeof *wall };

static mini_scene_t m;

/* ---- Scenes ------------------------------------------------------------ */

/* Where the receiver is, grid units. */
static const int32_t at[3] = {14000, 14000, 1000};
static const int32_t at_horizon[3] = {9000, 9000, 9000};

static const int32_t *origin_of(const case_t *c)
{
    return c->corner[0][2] < 0 ? at_horizon : at;
}

/* The receiver: a square about the origin, white, looked at along -normal. */
static void add_receiver(const int32_t o[3], const int32_t n[3])
{
    /* sides s = (0, 1, 0) and t = s x n = (n_z, 0, -n_x), for n in x and z */
    const int32_t reach = 25;
    int32_t corner[4][3];

    for (int i = 0; i < 4; i++) {
        const int32_t along_s = i == 1 || i == 2 ? reach : -reach;
        const int32_t along_t = i >= 2 ? reach : -reach;

        corner[i][0] = o[0] + along_t * n[2];
        corner[i][1] = o[1] + along_s;
        corner[i][2] = o[2] - along_t * n[0];
    }
    mini_quad(&m, corner[0], corner[3], corner[2], corner[1],
            mini_material(&m, 1, 0));
    /* powers of two: neither the eye nor the direction is rounded */
    mini_eye(&m, o[0] + 32.0 * n[0], o[1], o[2] + 32.0 * n[2]);
    mini_look(&m, -n[0] / 8.0, 0, -n[2] / 8.0);
}

static void make_scene(const case_t *c, double radiance)
{
    const int32_t *const o = origin_of(c);
    const uint16_t light = (mini_begin(&m), mini_material(&m, 0, radiance));
    int32_t corner[4][3];

    for (int i = 0; i < c->corners; i++) {
        for (int k = 0; k < 3; k++) {
            corner[i][k] = o[k] + (int32_t)lround(c->corner[i][k] * c->scale);
        }
    }
    if (c->corners == 3) {
        mini_triangle(&m, corner[0], corner[1], corner[2], light);
    } else {
        mini_quad(&m, corner[0], corner[1], corner[2], corner[3], light);
    }
    add_receiver(o, c->normal);
}

/* A wall on the floor: x in [-1/2, 1/2], z in [0, 1], y the distance. */
static void make_wall(int32_t distance, double radiance)
{
    const int32_t o[3] = {16000, 2000, 1000}, up[3] = {0, 0, 1};
    const int32_t y = o[1] + distance;
    const int32_t low[2][3] = {{o[0] - 5000, y, o[2]}, {o[0] + 5000, y, o[2]}};
    const int32_t high[2][3] = {
            {o[0] - 5000, y, o[2] + 10000}, {o[0] + 5000, y, o[2] + 10000}};

    mini_begin(&m);
    mini_quad(&m, low[0], low[1], high[1], high[0],
            mini_material(&m, 0, radiance));
    add_receiver(o, up);
}

/* ---- What is expected --------------------------------------------------- */

static lambert_polygon_t polygon_of(const case_t *c)
{
    lambert_polygon_t p;

    memset(&p, 0, sizeof p);
    p.count = c->corners;
    for (int i = 0; i < c->corners; i++) {
        /* the front faces the receiver, the formula wants the other turn */
        memcpy(p.corner[i], c->corner[c->corners - 1 - i], sizeof p.corner[i]);
    }
    return p;
}

static void normal_of(const case_t *c, double n[3])
{
    for (int k = 0; k < 3; k++) {
        n[k] = (double)c->normal[k] / c->normal_length;
    }
}

/* Steps along the dominant axis towards the side of n, in the case's units. */
static void step(double v[3], const double n[3], double by)
{
    int axis = 0;

    axis = fabs(n[1]) > fabs(n[axis]) ? 1 : axis;
    axis = fabs(n[2]) > fabs(n[axis]) ? 2 : axis;
    v[axis] += n[axis] < 0 ? -by : by;
}

/* The moments of one sample, the receiver one ulp up and the emitter one ulp
 * nearer. */
static lambert_moments_t expected(const case_t *c, int side)
{
    double corner[4][3], a[3], b[3], n[3], front[3], shift[3] = {0, 0, 0};
    lambert_moments_t moments;

    normal_of(c, n);
    for (int k = 0; k < 3; k++) {
        a[k] = c->corner[1][k] - c->corner[0][k];
        b[k] = c->corner[2][k] - c->corner[0][k];
    }
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;

        front[k] = a[i] * b[j] - a[j] * b[i];
    }
    step(shift, n, -ULP / c->scale);
    step(shift, front, ULP / c->scale);
    for (int i = 0; i < c->corners; i++) {
        for (int k = 0; k < 3; k++) {
            corner[i][k] = c->corner[i][k] + shift[k];
        }
    }
    if (c->corners == 3) {
        return lambert_triangle_sampling((const double(*)[3])corner, n, side);
    }
    for (int k = 0; k < 3; k++) {
        b[k] = corner[3][k] - corner[0][k];
    }
    moments = lambert_area_sampling(corner[0], a, b, n, NULL, side);
    return moments;
}

/* Of the wall, from the receiver one ulp up, one ulp nearer. x = d sinh(s), z
 * likewise, make the integrands of every moment smooth. */
static lambert_moments_t expected_wall(int32_t distance)
{
    enum { CELLS = 400 };
    const double unit = 10000, lift = ULP / unit;
    const double d = (distance - ULP) / unit;
    const double s_end = asinh(0.5 / d), t_low = asinh(-lift / d);
    const double t_end = asinh((1 - lift) / d);
    double power[3] = {0, 0, 0};
    lambert_moments_t moments;

    for (int i = 0; i < CELLS; i++) {
        const double s = s_end * (i + 0.5) / CELLS;

        for (int j = 0; j < CELLS; j++) {
            const double t = t_low + (t_end - t_low) * (j + 0.5) / CELLS;
            const double x = d * sinh(s), z = d * sinh(t);
            const double r2 = x * x + z * z + d * d;
            const double f = z > 0 ? z * d / (PI * r2 * r2) : 0;
            const double area = 2 * d * cosh(s) * s_end / CELLS * d * cosh(t) *
                                (t_end - t_low) / CELLS;

            power[0] += area * f;
            power[1] += area * f * f;
        }
    }
    moments.mean = power[0];
    moments.variance = power[1] - power[0] * power[0];
    moments.fourth = 0;
    return moments;
}

/* ---- Claims ------------------------------------------------------------ */

TEST(lambert_formula_gives_the_known_digits)
{
    for (int i = 0; i < CASES; i++) {
        const lambert_polygon_t p = polygon_of(cases + i);
        double n[3], f;

        normal_of(cases + i, n);
        f = lambert_form_factor(&p, n);
        CHECK(fabs(f - cases[i].form_factor) < 1e-12, "%s: %.16f, known %.16f",
                cases[i].name, f, cases[i].form_factor);
    }
    NOTE("%d polygons to 1e-12", CASES);
}

/* The shift by two ulps moves the expected mean by no more than this. */
TEST(expected_values_are_the_known_ones_but_for_two_ulps)
{
    for (int i = 0; i < CASES; i++) {
        const case_t *c = cases + i;
        const lambert_moments_t e = expected(c, 1000);
        const double slack =
                3 * ULP / c->scale * (c->corner[0][2] < 0.5 ? 10 : 1);

        CHECK(fabs(e.mean - c->form_factor) < slack + 2e-6, "%s: %.9f, %.9f",
                c->name, e.mean, c->form_factor);
        CHECK(c->variance == 0 ||
                        fabs(e.variance / c->variance - 1) < 10 * slack + 1e-5,
                "%s: variance %.10g, known %.10g", c->name, e.variance,
                c->variance);
    }
    for (int i = 0; i < WALLS; i++) {
        const lambert_moments_t e = expected_wall(wall[i].distance);
        const double slack = 20 * ULP / wall[i].distance + 1e-4;

        CHECK(fabs(e.mean - wall[i].form_factor) < slack,
                "wall at %ld: %.9f, %.9f", (long)wall[i].distance, e.mean,
                wall[i].form_factor);
    }
}

#define RADIANCE 0.5 /* of the emitters: sums round at 2^-24 */

TEST(random_samples_have_the_known_mean_and_variance)
{
    double worst_mean = 0, worst_variance = 0, first = 0;

    for (int i = 0; i < CASES; i++) {
        const uint32_t n = i == 0 ? 1u << 20 : 1u << 18;
        const ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 0, 1);
        const lambert_moments_t e = expected(cases + i, 1000);
        stats_moments_t got;
        double z, zv;

        make_scene(cases + i, RADIANCE);
        got = estimate_pixel(&m, &s, 0, 0, n);
        got.mean /= RADIANCE;
        z = estimate_z(&got, e.mean, e.variance);
        zv = (stats_variance(&got) / (RADIANCE * RADIANCE) - e.variance) /
             sqrt((e.fourth - e.variance * e.variance) / n);
        CHECK(fabs(z) < STATS_Z_MANY, "%s: mean %.8f, want %.8f, z %.1f",
                cases[i].name, got.mean, e.mean, z);
        CHECK(fabs(zv) < STATS_Z_MAX, "%s: variance %.6g, want %.6g, z %.1f",
                cases[i].name, stats_variance(&got) / (RADIANCE * RADIANCE),
                e.variance, zv);
        worst_mean = fmax(worst_mean, fabs(z));
        worst_variance = fmax(worst_variance, fabs(zv));
        first = i == 0 ? got.mean : first;
    }
    NOTE("square_at_1 %.7f; worst z %.1f of means, %.1f of variances", first,
            worst_mean, worst_variance);
}

/* On one triangle the error is a tenth of that of random samples. Which of two
 * triangles is another dimension, padded: what of the error comes from the pair
 * of both stays, so squares gain less. */
TEST(sobol_samples_have_the_known_mean_with_less_error)
{
    const uint32_t n = 1u << 16;
    double worst = 0;

    for (int i = 0; i < CASES; i++) {
        const ql_settings_t s = estimate_settings(QL_SAMPLER_SOBOL, 0, 2);
        const lambert_moments_t e = expected(cases + i, 1000);
        stats_moments_t got;
        const double gain = cases[i].corners == 3 ? 10 : 2;
        double z;

        make_scene(cases + i, RADIANCE);
        got = estimate_pixel(&m, &s, 0, 0, n);
        got.mean /= RADIANCE;
        z = estimate_z(&got, e.mean, e.variance) * gain;
        CHECK(fabs(z) < STATS_Z_MANY, "%s: mean %.8f, want %.8f, z %.2f",
                cases[i].name, got.mean, e.mean, z);
        worst = fmax(worst, fabs(z));
    }
    NOTE("worst z %.1f by a tenth (squares: half) of random's", worst);
}

/* Next to the wall the geometry term reaches 1e5 while the light is dim. */
TEST(dim_light_times_a_large_factor_is_not_cut)
{
    const ql_real_t factor = {0x80000000u, 20 - 31}; /* 2^20 */
    ql_diag_t diag = {0};
    uint64_t sum = 0;

    film_add(&sum, 1u << 12, factor, 0, &diag); /* 2^-19 */
    CHECK(sum == (uint64_t)2 << QL_SUM_BITS && diag.saturated == 0,
            "2^-19 x 2^20 added %g, %lu saturated",
            ldexp((double)sum, -QL_SUM_BITS), (unsigned long)diag.saturated);
}

TEST(light_that_touches_the_floor_stays_finite_and_unbiased)
{
    /* large values need room: 1/r^2 of the nearest points is 1e6 */
    const double radiance = 1 / 1024.0;
    double worst = 0, nearest = 0, error = 0;

    for (int i = 0; i < WALLS; i++) {
        /* in draft an ulp is a tenth of the shortest distance: too coarse for
         * an area of light to be sampled near it */
        const bool fits = QL_POS_BITS > 0 || wall[i].distance >= 100;
        const ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 0, 3);
        const lambert_moments_t e = expected_wall(wall[i].distance);
        stats_moments_t got;
        double z;

        make_wall(wall[i].distance, radiance);
        got = estimate_pixel(&m, &s, 0, 0, fits ? 1u << 20 : 1u << 10);
        got.mean /= radiance;
        z = estimate_z(&got, e.mean, e.variance);
        CHECK(!fits || fabs(z) < STATS_Z_MAX, "at %ld: %.6f, want %.6f, z %.1f",
                (long)wall[i].distance, got.mean, e.mean, z);
        worst = fits ? fmax(worst, fabs(z)) : worst;
        nearest = fits ? got.mean : nearest;
        error = fits ? sqrt(e.variance / got.n) : error;
    }
    NOTE("worst z %.1f; the nearest %.3f +- %.3f", worst, nearest, error);
}

/* ---- Faults ------------------------------------------------------------ */

/* An estimator of our own on the core's light samples, right or wrong. */
typedef enum {
    RIGHT,
    NO_COSINE,
    NO_LIGHT_COSINE,
    COSINE_WITHOUT_SIGN,
    DISTANCE_NOT_SQUARED,
    NO_PI,
    FAULTS
} fault_t;

static const char *const fault_names[FAULTS] = {"nothing", "receiver's cosine",
        "emitter's cosine", "sign of the cosine", "square of the distance",
        "1/pi"};

static double own_sample(const case_t *c, const ql_emit_point_t *p,
        const int32_t o[3], const double n[3], double lights, fault_t fault)
{
    double w[3], r2 = 0, cosine = 0, other = 0, area = 0, x;
    const double q[3] = {p->q.x * ULP, p->q.y * ULP, p->q.z * ULP};
    const double normal[3] = {p->n.x, p->n.y, p->n.z};

    for (int k = 0; k < 3; k++) {
        w[k] = (q[k] - o[k]) / c->scale;
        r2 += w[k] * w[k];
        cosine += w[k] * n[k];
        other -= w[k] * normal[k];
        area += normal[k] * normal[k];
    }
    area = sqrt(area);
    cosine /= sqrt(r2);
    other /= sqrt(r2) * area;
    area /= 2.0 * c->scale * c->scale;
    if (fault == COSINE_WITHOUT_SIGN) {
        cosine = fabs(cosine);
    }
    if (cosine <= 0 || other <= 0) {
        return 0;
    }
    x = area * lights / PI / r2;
    x *= fault == NO_COSINE ? 1 : cosine;
    x *= fault == NO_LIGHT_COSINE ? 1 : other;
    x *= fault == DISTANCE_NOT_SQUARED ? sqrt(r2) : 1;
    return fault == NO_PI ? x * PI : x;
}

static double own_z(const case_t *c, fault_t fault, uint32_t samples)
{
    const lambert_moments_t e = expected(c, 1000);
    stats_moments_t moments = {0, 0, 0};
    ql_sampler_t sampler;
    ql_scene_t scene;
    double n[3];

    normal_of(c, n);
    make_scene(c, RADIANCE);
    mini_open(&m, &scene);
    ql_sampler_begin(&sampler, QL_SAMPLER_RANDOM, 4, 0, 0);
    for (uint32_t i = 0; i < samples; i++) {
        ql_emit_point_t p;
        ql_uniform2_t u;

        ql_sampler_start(&sampler, i);
        u = ql_sampler_2d(&sampler, 0);
        ql_emit_triangle_point(&scene,
                ql_light_choose(
                        &scene, QL_LIGHTS_POWER, ql_sampler_1d(&sampler, 1)),
                u, &p);
        stats_add(&moments,
                own_sample(c, &p, origin_of(c), n, scene.light_count, fault));
    }
    return estimate_z(&moments, e.mean, e.variance);
}

TEST(mean_rejects_an_estimator_that_forgets_a_factor)
{
    static const int with[FAULTS] = {3, 3, 3, 5, 1, 0};

    for (int f = 0; f < FAULTS; f++) {
        const double z = own_z(cases + with[f], (fault_t)f, 1u << 16);

        CHECK((fabs(z) < STATS_Z_MAX) == (f == RIGHT), "without the %s: z %.1f",
                fault_names[f], z);
    }
    NOTE("%d faults", FAULTS - 1);
}

TEST(mean_rejects_light_pdf_scaled_by_1_02)
{
    const ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 0, 1);
    const lambert_moments_t e = expected(cases, 1000);
    stats_moments_t got;
    double z;

    make_scene(cases, RADIANCE);
    m.light_weight_scale = 1 / 1.02;
    got = estimate_pixel(&m, &s, 0, 0, 1u << 16);
    got.mean /= RADIANCE;
    z = estimate_z(&got, e.mean, e.variance);
    CHECK(fabs(z) > STATS_Z_MAX, "z %.1f", z);
    NOTE("z %.0f", z);
}

TEST(mean_rejects_a_forgotten_light_pmf)
{
    const ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 0, 1);
    const lambert_moments_t e = expected(cases, 1000);
    stats_moments_t got;
    double z;

    make_scene(cases, RADIANCE);
    m.forget_light_pmf = true;
    got = estimate_pixel(&m, &s, 0, 0, 1u << 16);
    got.mean /= RADIANCE;
    z = estimate_z(&got, e.mean, e.variance);
    CHECK(fabs(z) > STATS_Z_MAX, "z %.1f", z);
    NOTE("z %.0f", z);
}

/* The mean alone would not see estimators that are merely noisier. */
TEST(variance_rejects_another_estimator_of_the_same_mean)
{
    const lambert_moments_t area = expected(cases, 1000);
    const double f = cases[0].form_factor, hit = f * (1 - f);
    const double z =
            (hit - area.variance) /
            sqrt((area.fourth - area.variance * area.variance) / (1u << 18));

    CHECK(fabs(z) > STATS_Z_MAX, "cosine sampling's variance: z %.1f", z);
    NOTE("cosine sampling has variance %.4f", hit);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("known/form_factor", argc, argv);
    RUN(lambert_formula_gives_the_known_digits);
    RUN(expected_values_are_the_known_ones_but_for_two_ulps);
    RUN(random_samples_have_the_known_mean_and_variance);
    RUN(sobol_samples_have_the_known_mean_with_less_error);
    RUN(dim_light_times_a_large_factor_is_not_cut);
    RUN(light_that_touches_the_floor_stays_finite_and_unbiased);
    RUN(mean_rejects_an_estimator_that_forgets_a_factor);
    RUN(mean_rejects_light_pdf_scaled_by_1_02);
    RUN(mean_rejects_a_forgotten_light_pmf);
    RUN(variance_rejects_another_estimator_of_the_same_mean);
    return TEST_END();
}
