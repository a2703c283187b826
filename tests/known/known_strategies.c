/* known_strategies.c - every strategy: the known mean, its own variance */
/* SPDX-License-Identifier: MIT */

/* One radiance, five estimators of direct light, three choices of emitter,
 * three densities of directions: means are the same, known where a formula
 * gives them, and one sample's variance is that of the estimator asked for. The
 * core lifts a receiver by one ulp, and lowers a point on an emitter by one
 * (the exact side test); expected values are worked out for where they are. */

#include <math.h>
#include <stdlib.h>

#include "support/picture/estimate.h"
#include "support/picture/lambert.h"
#include "support/ql_double.h"
#include "support/ql_test.h"
#include "qlux.h"

#define ULP      (1.0 / (1 << QL_POS_BITS)) /* grid units */
#define RADIANCE 0.5 /* of the emitters: sums round at 2^-24 */

static mini_scene_t m;

static ql_settings_t settings_of(int strategy, uint8_t bounces, uint32_t seed)
{
    ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, bounces, seed);

    s.direct = strategies[strategy].direct;
    return s;
}

/* ---- One point under emitters of one radiance ---------------------------- */

enum { EMITTERS_MAX = 128, POINT_Z = 1000 };
static const int32_t origin[3] = {16000, 16000, POINT_Z};

static struct {
    double corner[EMITTERS_MAX][3][3]; /* from the origin, grid units */
    int count;
    double receiver_x;      /* grid units from the origin */
    lambert_visible_t free; /* NULL: nothing is in the way */
} light;

/* The white receiver, seen from above; x and y of the point are exact. */
static void begin_point(int32_t x)
{
    static const int32_t reach = 100;
    const int32_t a[3] = {origin[0] + x - reach, origin[1] - reach, POINT_Z};
    const int32_t b[3] = {origin[0] + x + reach, origin[1] - reach, POINT_Z};
    const int32_t c[3] = {origin[0] + x + reach, origin[1] + reach, POINT_Z};
    const int32_t d[3] = {origin[0] + x - reach, origin[1] + reach, POINT_Z};

    mini_begin(&m);
    mini_material(&m, 0, RADIANCE); /* 0: of emitters */
    mini_quad(&m, a, b, c, d, mini_material(&m, 1, 0));
    mini_eye(&m, origin[0] + x, origin[1], POINT_Z + 64);
    mini_look(&m, 0, 0, -0.5);
    light.count = 0;
    light.receiver_x = x;
    light.free = NULL;
}

/* Corners in grid units from the origin, counter-clockwise from below. */
static void emitter(double corner[3][3])
{
    int32_t at[3][3];

    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            const int32_t v = (int32_t)lround(corner[i][k]);

            at[i][k] = origin[k] + v;
            light.corner[light.count][i][k] = v;
        }
    }
    mini_triangle(&m, at[0], at[1], at[2], 0);
    light.count++;
}

static void square_emitter(double side, double height)
{
    const double h = side / 2;
    double one[3][3] = {{-h, -h, height}, {-h, h, height}, {h, h, height}};
    double two[3][3] = {{-h, -h, height}, {h, h, height}, {h, -h, height}};

    emitter(one);
    emitter(two);
}

static void triangle_normal(double v[3][3], double n[3])
{
    double e1[3], e2[3];

    for (int k = 0; k < 3; k++) {
        e1[k] = v[1][k] - v[0][k];
        e2[k] = v[2][k] - v[0][k];
    }
    cross3(e1, e2, n);
}

/* ---- What is expected: quadrature over the emitters' area ---------------- */

/* What a cell of an emitter is to the receiver. */
typedef struct {
    double p;      /* chance of its emitter, of the cell's share of area */
    double cosine; /* at the receiver */
    double omega;  /* solid angle of the cell */
    double g;      /* what area sampling makes of a point */
    double near;   /* likewise, an ulp lower */
    double ratio;  /* solid angle of its emitter / chance of that */
    bool free;     /* nothing is in the way */
} cell_t;

/* cos cos' / (pi r^2) times twice the area of the normal n. */
static double geometry(const double w[3], const double n[3])
{
    const double r2 = dot3(w, w), other = -dot3(w, n);

    return w[2] > 0 && other > 0 ? w[2] * other / (PI * r2 * r2) : 0;
}

/* Sums of weight (x - about)^k, k 0 to 4, of one part of an estimator, and of a
 * second one that is independent of it. */
typedef struct {
    double about, first[5], second[5];
} powers_t;

static void add_powers(double power[5], double about, double weight, double x)
{
    for (int k = 0; k < 5; k++) {
        power[k] += weight;
        weight *= x - about;
    }
}

static void add_cell(int strategy, const cell_t *c, powers_t *sum)
{
    const double s = c->g / (1 + c->g), s_near = c->near / (1 + c->near);

    switch (strategy) {
    case AREA:
        add_powers(sum->first, sum->about, c->p, c->near);
        break;
    case HEMISPHERE:
        add_powers(sum->first, sum->about, c->omega / (2 * PI), 2 * c->cosine);
        break;
    case COSINE:
        add_powers(sum->first, sum->about, c->omega * c->cosine / PI, 1);
        break;
    case SOLID_ANGLE:
        add_powers(sum->first, sum->about, c->omega / c->ratio,
                c->ratio * c->cosine / PI);
        break;
    default: /* g is the cosine density over that of points */
        add_powers(sum->first, sum->about, c->p, s_near);
        add_powers(sum->second, sum->about, c->p * c->g, s);
        break;
    }
}

/* Mean, variance, fourth cumulant; what weight is left is of samples of 0. */
static void add_cumulants(double power[5], double about, double cumulant[3])
{
    const double left = 1 - power[0];
    double m1, m2, m3, m4, fourth;

    if (left > 1e-9) {
        add_powers(power, about, left, 0);
    }
    m1 = power[1], m2 = power[2], m3 = power[3], m4 = power[4];
    m2 -= m1 * m1;
    fourth = m4 - 4 * m1 * m3 + 6 * m1 * m1 * power[2] - 3 * m1 * m1 * m1 * m1;
    cumulant[0] += about + m1;
    cumulant[1] += m2;
    cumulant[2] += fourth - 3 * m2 * m2;
}

/* Cell j of row i of side^2: i + j < side stand upright and, but for the last,
 * upside down. False if none of it can be sampled. */
static bool cell_at(double v[3][3], int side, int i, int j, cell_t *c)
{
    const double third = j % 2 == 0 ? 1 / 3.0 : 2 / 3.0;
    double w[3], n[3], r;

    triangle_normal(v, n);
    for (int k = 0; k < 3; k++) {
        w[k] = v[0][k] + (v[1][k] - v[0][k]) * (i + third) / side +
               (v[2][k] - v[0][k]) * (j / 2 + third) / side;
    }
    r = sqrt(dot3(w, w));
    c->g = geometry(w, n) / 2;
    c->cosine = w[2] / r;
    c->omega = -dot3(w, n) / 2 / ((double)side * side * r * r * r);
    c->free = light.free == NULL || light.free(w) != 0;
    w[2] -= ULP;
    c->near = geometry(w, n) / 2;
    return c->g > 0;
}

static void add_emitter(
        int strategy, double v[3][3], double chance, int side, powers_t *sum)
{
    double omega = 0;
    cell_t c;

    for (int pass = 0; pass < 2; pass++) {
        for (int i = 0; i < side; i++) {
            for (int j = 0; j < 2 * (side - i) - 1; j++) {
                if (!cell_at(v, side, i, j, &c)) {
                    continue;
                }
                if (pass == 0) {
                    omega += c.omega;
                } else if (c.free) {
                    c.p = chance / ((double)side * side);
                    c.ratio = omega / chance;
                    c.g /= chance;
                    c.near /= chance;
                    add_cell(strategy, &c, sum);
                }
            }
        }
    }
}

/* Moments of one sample, for an emitted radiance of 1; worked out about a mean
 * that is nearly right, so that small variances are not lost. */
static lambert_moments_t expected(int strategy, int side, double about)
{
    double twice_area[EMITTERS_MAX], total = 0, cumulant[3] = {0, 0, 0};
    powers_t sum;
    lambert_moments_t moments;

    memset(&sum, 0, sizeof sum);
    sum.about = strategy == MIS ? 0 : about;
    for (int i = 0; i < light.count; i++) {
        double n[3];

        triangle_normal(light.corner[i], n);
        twice_area[i] = sqrt(dot3(n, n));
        total += twice_area[i];
    }
    for (int i = 0; i < light.count; i++) {
        double v[3][3];

        memcpy(v, light.corner[i], sizeof v);
        for (int j = 0; j < 3; j++) {
            v[j][0] -= light.receiver_x;
            v[j][2] -= ULP; /* the receiver is lifted */
        }
        add_emitter(strategy, v, twice_area[i] / total, side, &sum);
    }
    add_cumulants(sum.first, sum.about, cumulant);
    if (strategy == MIS) {
        add_cumulants(sum.second, 0, cumulant);
    }
    moments.mean = cumulant[0];
    moments.variance = cumulant[1];
    moments.fourth = cumulant[2] + 3 * cumulant[1] * cumulant[1];
    return moments;
}

/* ---- Mean and variance of every strategy --------------------------------- */

static stats_moments_t measure(
        int strategy, ql_sampler_kind_t sampler, uint32_t samples)
{
    ql_settings_t s = settings_of(strategy, 0, 11);
    stats_moments_t got;

    s.sampler = (uint8_t)sampler;
    got = estimate_pixel(&m, &s, 0, 0, samples);
    got.mean /= RADIANCE;
    got.m2 /= RADIANCE * RADIANCE;
    return got;
}

/* How many standard errors a variance is off. */
static double variance_z(const stats_moments_t *got, const lambert_moments_t *e)
{
    return (stats_variance(got) - e->variance) /
           sqrt((e->fourth - e->variance * e->variance) / got->n);
}

/* Of one sample, for emitters of radiance 1: side 1 and side 0.1 at height 1.
 * 0 where no closed form is known. */
static const struct {
    const char *name;
    double side, form_factor, variance[STRATEGIES];
} squares[] = {
        {"side_1", 1, 0.2394564704607735,
                {0.0017405096, 0.3908040397, 0.1821170692, 0.0001074045, 0}},
        {"side_0.1", 0.1, 0.003172525532555426,
                {4.452103e-11, 6.329715e-3, 3.162461e-3, 0, 0}}};
enum { SQUARES = 2, UNIT = 8000, SIDE_CELLS = 400 };

static void make_square(int i)
{
    begin_point(0);
    square_emitter(squares[i].side * UNIT, UNIT);
}

TEST(quadrature_gives_the_known_means_and_variances)
{
    /* two ulps nearer, and variances go with the eighth power of that */
    const double slack = 16 * ULP / UNIT + 2e-5;

    for (int i = 0; i < SQUARES; i++) {
        make_square(i);
        for (int k = 0; k < STRATEGIES; k++) {
            const lambert_moments_t e =
                    expected(k, SIDE_CELLS, squares[i].form_factor);
            const double known = squares[i].variance[k];

            CHECK(fabs(e.mean / squares[i].form_factor - 1) < slack,
                    "%s, %s: mean %.10f, known %.10f", squares[i].name,
                    strategies[k].name, e.mean, squares[i].form_factor);
            CHECK(known == 0 || fabs(e.variance / known - 1) < slack,
                    "%s, %s: variance %.9g, known %.9g", squares[i].name,
                    strategies[k].name, e.variance, known);
        }
    }
}

/* Each variance, and each of another strategy in its place. */
static void claim_variances(int i, const stats_moments_t got[STRATEGIES],
        const lambert_moments_t e[STRATEGIES], double *worst)
{
    for (int k = 0; k < STRATEGIES; k++) {
        for (int other = 0; other < STRATEGIES; other++) {
            const double z = variance_z(got + k, e + other);

            CHECK((fabs(z) < STATS_Z_MAX) == (k == other),
                    "%s: %s's variance %.6g passes or not for %s's %.6g: z "
                    "%.1f",
                    squares[i].name, strategies[k].name,
                    stats_variance(got + k), strategies[other].name,
                    e[other].variance, z);
            *worst = k == other ? fmax(*worst, fabs(z)) : *worst;
        }
    }
}

TEST(every_strategy_has_the_known_mean_and_no_other_ones_variance)
{
    double worst = 0, worst_variance = 0;

    for (int i = 0; i < SQUARES; i++) {
        const uint32_t n = i == 0 ? 1u << 20 : 1u << 18;
        stats_moments_t got[STRATEGIES];
        lambert_moments_t e[STRATEGIES];

        make_square(i);
        for (int k = 0; k < STRATEGIES; k++) {
            double z;

            e[k] = expected(k, SIDE_CELLS, squares[i].form_factor);
            got[k] = measure(k, QL_SAMPLER_RANDOM, n);
            z = estimate_z(got + k, e[k].mean, e[k].variance);
            CHECK(fabs(z) < STATS_Z_MANY, "%s, %s: %.9f, want %.9f, z %.1f",
                    squares[i].name, strategies[k].name, got[k].mean, e[k].mean,
                    z);
            worst = fmax(worst, fabs(z));
        }
        claim_variances(i, got, e, &worst_variance);
    }
    NOTE("worst z %.1f of means, %.1f of variances", worst, worst_variance);
}

/* Of the mean of n samples: cumulants of independent ones add up. */
static lambert_moments_t mean_of(const lambert_moments_t *e, double n)
{
    const double square = e->variance * e->variance;
    const double cumulant = e->fourth - 3 * square;
    const lambert_moments_t moments = {e->mean, e->variance / n,
            cumulant / (n * n * n) + 3 * square / (n * n)};

    return moments;
}

/* A sum divided by one less has a mean and a variance that are refused, by
 * twice the limit, so with any seed; their standard errors are those of e. */
static void claim_directions(
        int strategy, const lambert_moments_t *one, unsigned n, double *worst)
{
    ql_settings_t s = settings_of(strategy, 0, 20 + n);
    const lambert_moments_t e = mean_of(one, n);
    lambert_moments_t bad = e;
    stats_moments_t got;
    double z, variance;

    s.light_samples = (uint8_t)n;
    got = estimate_pixel(&m, &s, 0, 0, 1u << 14);
    got.mean /= RADIANCE;
    got.m2 /= RADIANCE * RADIANCE;
    z = estimate_z(&got, e.mean, e.variance);
    variance = variance_z(&got, &e);
    CHECK(fabs(z) < STATS_Z_MAX && fabs(variance) < STATS_Z_MAX,
            "%u of %s: mean %.6f, want %.6f; variance %.6f, want %.6f", n,
            strategies[strategy].name, got.mean, e.mean, stats_variance(&got),
            e.variance);
    *worst = fmax(*worst, fmax(fabs(z), fabs(variance)));
    bad.mean *= n / (n - 1.0);
    bad.variance *= n / (n - 1.0);
    bad.fourth += bad.variance * bad.variance - e.variance * e.variance;
    CHECK(fabs(estimate_z(&got, bad.mean, e.variance)) > 2 * STATS_Z_MAX &&
                    fabs(variance_z(&got, &bad)) > 2 * STATS_Z_MAX,
            "%u of %s divided by one less pass: mean %.6f, variance %.6f", n,
            strategies[strategy].name, got.mean, stats_variance(&got));
}

TEST(n_directions_have_the_mean_of_one_and_an_nth_of_its_variance)
{
    static const unsigned counts[] = {2, 5};
    double worst = 0;

    make_square(0);
    for (int k = HEMISPHERE; k <= COSINE; k++) {
        const lambert_moments_t one =
                expected(k, SIDE_CELLS, squares[0].form_factor);

        for (unsigned i = 0; i < sizeof counts / sizeof *counts; i++) {
            claim_directions(k, &one, counts[i], &worst);
        }
    }
    NOTE("worst z %.1f; divided by one less refused", worst);
}

/* Samples that are not 0, and whether all of those are the same. */
static uint32_t count_hits(int strategy, uint32_t samples, bool *same)
{
    const ql_settings_t s = settings_of(strategy, 0, 12);
    ql_scene_t scene;
    ql_render_t render;
    uint64_t value = 0;
    uint32_t hits = 0;

    mini_open(&m, &scene);
    *same = true;
    CHECK(ql_render_init(&render, &scene, &s) == QL_OK, "settings");
    for (uint32_t i = 0; i < samples; i++) {
        ql_sum_t sum = {{0, 0, 0}};

        ql_render_pixel(&render, 0, 0, i, 1, &sum);
        hits += sum.rgb[0] != 0;
        *same = *same && (sum.rgb[0] == 0 || value == 0 || sum.rgb[0] == value);
        value = sum.rgb[0] != 0 ? sum.rgb[0] : value;
    }
    *same = *same && value == (uint64_t)ldexp(RADIANCE, QL_SUM_BITS);
    return hits;
}

/* Exact intervals of the binomial distribution, both tails 1e-6. */
TEST(directions_hit_the_square_as_often_as_a_binomial_says)
{
    bool same;
    uint32_t cosine, uniform;

    make_square(0);
    cosine = count_hits(COSINE, 1u << 20, &same);
    CHECK(cosine >= 248953 && cosine <= 253228, "cosine: %lu hits",
            (unsigned long)cosine);
    CHECK(same, "a hit of the cosine strategy is not the radiance itself");
    uniform = count_hits(HEMISPHERE, 1u << 20, &same);
    CHECK(uniform >= 132744 && uniform <= 136093, "uniform: %lu hits",
            (unsigned long)uniform);
    CHECK(!same, "uniform directions: every hit is worth the same");
    NOTE("%lu and %lu of 2^20", (unsigned long)cosine, (unsigned long)uniform);
}

/* A point close to the square: points of its area vary more than directions,
 * and both together less than either. */
TEST(mis_varies_less_than_both_of_its_parts_near_a_light)
{
    lambert_moments_t e[STRATEGIES];
    stats_moments_t got;
    double z;

    begin_point(0);
    square_emitter(UNIT, UNIT * 0.25);
    for (int k = 0; k < STRATEGIES; k++) {
        e[k] = expected(k, SIDE_CELLS, 0);
    }
    got = measure(MIS, QL_SAMPLER_RANDOM, 1u << 18);
    z = variance_z(&got, &e[MIS]);
    CHECK(fabs(z) < STATS_Z_MAX && fabs(estimate_z(&got, e[MIS].mean,
                                           e[MIS].variance)) < STATS_Z_MAX,
            "mean %.6f, want %.6f; variance %.6f, want %.6f", got.mean,
            e[MIS].mean, stats_variance(&got), e[MIS].variance);
    for (int k = 0; k < STRATEGIES; k++) {
        if (k == AREA || k == COSINE) {
            CHECK(e[k].variance > stats_variance(&got),
                    "%s: variance %.6f, of mis %.6f", strategies[k].name,
                    e[k].variance, stats_variance(&got));
        }
    }
    NOTE("area %.4f, cosine %.4f, mis %.4f", e[AREA].variance,
            e[COSINE].variance, stats_variance(&got));
}

/* The square turned over: seen from behind it is as bright, or black. */
TEST(emitters_shine_to_both_sides_only_if_they_are_told_to)
{
    double worst = 0;

    for (int i = 0; i < 2 * STRATEGIES; i++) {
        const int k = i / 2;
        lambert_moments_t e;
        stats_moments_t got;

        make_square(0);
        e = expected(k, SIDE_CELLS / 4, squares[0].form_factor);
        for (unsigned t = 0; t < m.triangle_count; t++) {
            const uint16_t b = m.triangles[t].vertex[1];

            if (m.triangles[t].material == 0) {
                m.triangles[t].vertex[1] = m.triangles[t].vertex[2];
                m.triangles[t].vertex[2] = b;
            }
        }
        m.two_sided = i % 2 != 0;
        got = measure(k, QL_SAMPLER_RANDOM, 1u << 16);
        CHECK(m.two_sided ? fabs(estimate_z(&got, e.mean, e.variance)) <
                                    STATS_Z_MAX
                          : got.mean == 0 && got.m2 == 0,
                "%s, two-sided %d: %.7f, want %.7f", strategies[k].name,
                m.two_sided, got.mean, m.two_sided ? e.mean : 0);
        if (m.two_sided) {
            worst = fmax(worst, fabs(estimate_z(&got, e.mean, e.variance)));
        }
    }
    NOTE("worst z %.1f; one-sided exactly 0", worst);
}

TEST(means_reject_faults_in_every_strategy)
{
    for (int k = 0; k < STRATEGIES; k++) {
        const bool aims = k == AREA || k == SOLID_ANGLE || k == MIS;
        lambert_moments_t e;
        stats_moments_t got;

        make_square(0);
        e = expected(k, SIDE_CELLS, squares[0].form_factor);
        got = measure(k, QL_SAMPLER_RANDOM, 1u << 17);
        CHECK(fabs(estimate_z(&got, e.mean * 1.1, e.variance)) > STATS_Z_MAX,
                "%s: a mean 1.1 times as large passes", strategies[k].name);
        m.light_weight_scale = 1 / 1.02;
        got = measure(k, QL_SAMPLER_RANDOM, 1u << 17);
        CHECK((fabs(estimate_z(&got, e.mean, e.variance)) > STATS_Z_MAX) ==
                        aims,
                "%s: light pdf scaled by 1.02: %.6f, want %.6f",
                strategies[k].name, got.mean, e.mean);
        m.light_weight_scale = 1;
        m.forget_light_pmf = true;
        got = measure(k, QL_SAMPLER_RANDOM, 1u << 17);
        CHECK((fabs(estimate_z(&got, e.mean, e.variance)) > STATS_Z_MAX) ==
                        aims,
                "%s: pmf forgotten: %.6f, want %.6f", strategies[k].name,
                got.mean, e.mean);
    }
    NOTE("1.1 in the mean, 1.02 in the light's pdf; its pmf forgotten");
}

/* ---- Disks and penumbrae ------------------------------------------------- */

/* A disk at height h of radius r, its centre a from the point: h / unit, ... */
static const struct {
    double h, r, a, form_factor;
    int32_t unit;
} disks[] = {{1, 1, 0, 0.5, 8000}, {1, .5, 0, 0.2, 8000}, {.5, 1, 0, 0.8, 8000},
        {1, 1, 1, 0.2763932022500210, 7000},
        {1, 1, 2, 0.05278640450004206, 5000},
        {.1, 1, .9, 0.8344823658112248, 8000},
        {.1, 1, 1.1, 0.1300299633020281, 7000}};
enum { DISKS = sizeof disks / sizeof *disks, DISK_CORNERS = 96 };

/* A polygon of the disk's area around the origin. */
static void make_disk(int i)
{
    const double turn = 2 * PI / DISK_CORNERS, unit = disks[i].unit;
    const double radius = disks[i].r * unit * sqrt(turn / sin(turn));
    const double h = disks[i].h * unit;

    begin_point(-(int32_t)lround(disks[i].a * unit));
    for (int k = 0; k < DISK_CORNERS; k++) {
        double v[3][3] = {{0, 0, h},
                {radius * cos(turn * (k + 1)), radius * sin(turn * (k + 1)), h},
                {radius * cos(turn * k), radius * sin(turn * k), h}};

        emitter(v);
    }
}

static double polygon_form_factor(void)
{
    static const double up[3] = {0, 0, 1};
    double sum = 0;

    for (int i = 0; i < light.count; i++) {
        lambert_polygon_t p;

        p.count = 3;
        for (int j = 0; j < 3; j++) {
            /* the formula wants the other turn */
            memcpy(p.corner[j], light.corner[i][2 - j], sizeof p.corner[j]);
            p.corner[j][0] -= light.receiver_x;
            p.corner[j][2] -= ULP;
        }
        sum += lambert_form_factor(&p, up);
    }
    return sum;
}

TEST(disks_have_the_known_form_factors_by_every_strategy)
{
    double worst = 0;

    for (int i = 0; i < DISKS; i++) {
        double f;

        make_disk(i);
        f = polygon_form_factor();
        CHECK(fabs(f / disks[i].form_factor - 1) <
                        1e-3 + 8 * ULP / (disks[i].h * disks[i].unit),
                "disk %d: polygon %.7f, disk %.7f", i, f, disks[i].form_factor);
        for (int k = 0; k < STRATEGIES; k++) {
            const lambert_moments_t e = expected(k, 24, f);
            const stats_moments_t got = measure(k, QL_SAMPLER_RANDOM, 1u << 15);
            /* a point on the emitter is an ulp lower still; that is in e */
            const double mean = k == AREA || k == MIS ? e.mean : f;
            const double z = estimate_z(&got, mean, e.variance);

            CHECK(fabs(z) < STATS_Z_MANY,
                    "disk %d, %s: %.7f, want %.7f, z %.1f", i,
                    strategies[k].name, got.mean, mean, z);
            worst = fmax(worst, fabs(z));
        }
    }
    NOTE("%d disks of %d triangles, worst z %.1f", DISKS, DISK_CORNERS, worst);
}

/* A square light at height 1, an opaque half-plane x > 0 at height 1/2. */
static const struct {
    double p, form_factor;
} penumbra[] = {{-.6, 0.159743216399}, {-.5, 0.180368741123},
        {-.25, 0.185910849014}, {0, 0.11972823523}, {.25, 0.03705534802},
        {.5, 0}};
enum { PENUMBRAE = sizeof penumbra / sizeof *penumbra };

static double is_free(const double w[3])
{
    /* where the segment is at height 1/2 */
    return light.receiver_x + w[0] * (UNIT / 2.0 - ULP) / w[2] < 0;
}

static void make_penumbra(double p, bool occluder)
{
    const int32_t z = POINT_Z + UNIT / 2, y = UNIT * 3 / 4;
    const int32_t a[3] = {origin[0], origin[1] - y, z};
    const int32_t b[3] = {origin[0] + y, origin[1] - y, z};
    const int32_t c[3] = {origin[0] + y, origin[1] + y, z};
    const int32_t d[3] = {origin[0], origin[1] + y, z};

    begin_point((int32_t)lround(p * UNIT));
    square_emitter(UNIT, UNIT);
    if (occluder) {
        mini_quad(&m, a, b, c, d, mini_material(&m, 0, 0));
        light.free = is_free;
    }
}

TEST(penumbra_has_the_known_form_factors_by_every_strategy)
{
    double worst = 0;

    for (int i = 0; i < PENUMBRAE; i++) {
        for (int k = 0; k < STRATEGIES; k++) {
            lambert_moments_t e;
            stats_moments_t got;
            double z;

            make_penumbra(penumbra[i].p, true);
            e = expected(k, SIDE_CELLS, penumbra[i].form_factor);
            got = measure(k, QL_SAMPLER_RANDOM, 1u << 15);
            z = e.mean > 0 ? estimate_z(&got, e.mean, e.variance)
                           : got.mean * HUGE_VAL;
            CHECK(fabs(e.mean - penumbra[i].form_factor) <
                            1e-5 + 4 * ULP / UNIT,
                    "at %g: expected %.9f, known %.9f", penumbra[i].p, e.mean,
                    penumbra[i].form_factor);
            CHECK(penumbra[i].form_factor == 0 ? got.mean == 0 && got.m2 == 0
                                               : fabs(z) < STATS_Z_MAX,
                    "at %g, %s: %.7f, want %.7f, z %.1f", penumbra[i].p,
                    strategies[k].name, got.mean, e.mean, z);
            worst = got.mean > 0 ? fmax(worst, fabs(z)) : worst;
        }
    }
    NOTE("%d points, worst z %.1f; the hidden one exactly black", PENUMBRAE,
            worst);
}

TEST(penumbra_rejects_shadows_left_out)
{
    for (int k = 0; k < STRATEGIES; k++) {
        lambert_moments_t e;
        stats_moments_t got;

        make_penumbra(0, true);
        e = expected(k, SIDE_CELLS, penumbra[3].form_factor);
        make_penumbra(0, false);
        got = measure(k, QL_SAMPLER_RANDOM, 1u << 16);
        CHECK(fabs(estimate_z(&got, e.mean, e.variance)) > STATS_Z_MAX,
                "%s: %.7f passes for %.7f", strategies[k].name, got.mean,
                e.mean);
    }
}

/* ---- A furnace: a room that shines everywhere ---------------------------- */

/* A cube. By area 1/r^2 is unbounded next to its edges and one sample has no
 * variance at all, so by area it is a ball of many triangles, in which every
 * sample is nearly the same. */
static void make_furnace(uint8_t direct, double albedo)
{
    static const int32_t low[3] = {384, 384, 384},
                         high[3] = {32384, 32384, 32384};
    static const double right[3] = {0.25, 0, -0.125}, up[3] = {0, 0.25, 0};
    const uint16_t material =
            (mini_begin(&m), mini_material(&m, albedo, RADIANCE));

    if (direct == QL_DIRECT_AREA) {
        mini_ball(&m, 12, material);
    } else {
        mini_room(&m, low, high, material);
    }
    m.radiance_exp = 4; /* room for what is weighed by a small chance */
    mini_eye(&m, 14000, 17000, 12000);
    mini_look(&m, 0.125, 0.0625, 0.25);
    mini_field(&m, right, up);
}

/* After so many reflections; bounces are the indirect ones of them. */
static double series(double albedo, unsigned reflections)
{
    return (1 - pow(albedo, reflections + 1.0)) / (1 - albedo);
}

/* Of samples, or by area of the means of pictures: few samples of a ball are
 * enough, and what they err by is not independent of one another. */
enum { PICTURES = 48, FURNACES = 2 * 2 * STRATEGIES * 3 * 3 };

static stats_moments_t furnace_pictures(
        const ql_settings_t *settings, uint32_t samples)
{
    stats_moments_t got = {0, 0, 0};
    ql_scene_t scene;

    mini_open(&m, &scene);
    for (uint32_t i = 0; i < PICTURES; i++) {
        ql_settings_t s = *settings;
        ql_sum_t sum = {{0, 0, 0}};
        ql_render_t render;

        s.seed += i;
        CHECK(ql_render_init(&render, &scene, &s) == QL_OK, "settings");
        ql_render_pixel(&render, 0, 0, 0, samples, &sum);
        CHECK(render.diag.saturated == 0, "cut");
        stats_add(
                &got, ldexp((double)sum.rgb[0], m.radiance_exp - QL_SUM_BITS) /
                              samples);
    }
    return got;
}

static stats_moments_t furnace(const ql_settings_t *settings, uint32_t samples)
{
    stats_moments_t got =
            settings->direct == QL_DIRECT_AREA
                    ? furnace_pictures(settings, samples / PICTURES)
                    : estimate_pixel(&m, settings, 0, 0, samples);

    got.mean /= RADIANCE;
    got.m2 /= RADIANCE * RADIANCE;
    return got;
}

/* In units of what is allowed. A part in 10^6 is the rounding of sums and
 * albedos, all there is where no sample varies; of a ball ulps in draft are a
 * part in 250 (known_furnace). */
static double furnace_off(
        const ql_settings_t *settings, const stats_moments_t *got, double want)
{
    static double t_max, z_max;
    const bool pictures = settings->direct == QL_DIRECT_AREA;
    const double error = sqrt(stats_variance(got) / got->n);

    if (z_max == 0) {
        z_max = stats_z_limit(FURNACES);
        t_max = stats_t_limit(FURNACES, PICTURES);
    }
    return (got->mean - want) / ((pictures ? t_max : z_max) * error +
                                        (pictures ? 4e-3 : 1e-6) * want);
}

static void claim_furnace(const ql_settings_t *s, uint32_t samples, double want)
{
    const stats_moments_t got = furnace(s, samples);

    CHECK(fabs(furnace_off(s, &got, want)) < 1,
            "sampler %d, direct %d, lights %d x %d, indirect %d, roulette %d: "
            "%.6f, want %.6f",
            s->sampler, s->direct, s->lights, s->light_samples, s->indirect,
            s->roulette, got.mean, want);
}

/* Of every combination of choices: i in [0, 90). */
enum { COMBINATIONS = 2 * STRATEGIES * 3 * 3 };

static ql_settings_t combination(int i)
{
    ql_settings_t s = settings_of(i / 18, 2, 100 + (uint32_t)i);

    s.sampler = (uint8_t)(i % 2);
    s.lights = (uint8_t)(i / 2 % 3);
    s.indirect = (uint8_t)(i / 6 % 3 + QL_INDIRECT_COSINE);
    return s;
}

/* Every emitter asked costs a ray, and a ball has 1,152 of them. */
static bool asks_a_ball(const ql_settings_t *s)
{
    return s->direct == QL_DIRECT_AREA && s->lights == QL_LIGHTS_ALL;
}

/* Directions alone are the same for every choice of emitter. */
static uint32_t furnace_samples(const ql_settings_t *s)
{
    const bool aims =
            s->direct != QL_DIRECT_COSINE && s->direct != QL_DIRECT_HEMISPHERE;

    if (asks_a_ball(s)) {
        return PICTURES * (s->indirect == QL_INDIRECT_UNIFORM ? 2 : 1);
    }
    if (s->direct == QL_DIRECT_AREA) {
        return PICTURES * 32;
    }
    return s->lights == QL_LIGHTS_ALL             ? 1u << 11
           : aims || s->lights == QL_LIGHTS_POWER ? 1u << 13
                                                  : 1u << 11;
}

/* Of every combination with an albedo. */
static void measure_furnace(double albedo, stats_moments_t got[COMBINATIONS])
{
    for (int i = 0; i < COMBINATIONS; i++) {
        const ql_settings_t s = combination(i);

        make_furnace(s.direct, albedo);
        got[i] = furnace(&s, furnace_samples(&s));
    }
}

TEST(furnace_gives_the_series_in_every_combination_and_no_other)
{
    static const double albedos[] = {0.5, 0.8};
    stats_moments_t got[COMBINATIONS];
    double worst = 0, error = 0, nearest = INFINITY;

    for (int a = 0; a < 2; a++) {
        const double want = series(albedos[a], 3);

        measure_furnace(albedos[a], got);
        for (int i = 0; i < COMBINATIONS; i++) {
            const ql_settings_t s = combination(i);
            const double off = furnace_off(&s, got + i, want);

            CHECK(fabs(off) < 1,
                    "sampler %d, direct %d, lights %d, indirect %d: %.6f, want "
                    "%.6f",
                    s.sampler, s.direct, s.lights, s.indirect, got[i].mean,
                    want);
            worst = fmax(worst, fabs(off));
            error = fmax(error, sqrt(stats_variance(got + i) / got[i].n));
            /* emitters counted once more wherever hit; a reflection less, where
             * uniform directions in a few samples of a ball do not hide it */
            nearest =
                    fmin(nearest, fabs(furnace_off(&s, got + i, 2 * want - 1)));
            if (a == 1 &&
                    !(asks_a_ball(&s) && s.indirect == QL_INDIRECT_UNIFORM)) {
                nearest = fmin(nearest,
                        fabs(furnace_off(&s, got + i, series(albedos[a], 2))));
            }
        }
    }
    /* by twice the limit, so with any seed */
    CHECK(nearest > 2, "a wrong series is off by %.2f of the limit", nearest);
    NOTE("2 x %d; %.2f of the limit, wrong ones %.2f; standard errors up to "
         "%.3f",
            COMBINATIONS, worst, nearest, error);
}

TEST(furnace_gives_the_series_with_more_light_samples_and_roulette)
{
    for (int i = 0; i < COMBINATIONS; i++) {
        ql_settings_t s = combination(i);

        if (i % 5 < 2) {
            make_furnace(s.direct, i % 3 == 0 ? 0.5 : 0.8);
            /* halves are binary numbers: sums do not round them */
            s.light_samples = i % 5 == 0 ? 2 : 1;
            s.roulette = i % 4 != 0 || s.light_samples == 1;
            claim_furnace(
                    &s, furnace_samples(&s), series(i % 3 == 0 ? 0.5 : 0.8, 3));
        }
    }
    NOTE("%d combinations", 2 * COMBINATIONS / 5);
}

/* Every direction ends on a wall, and cosine directions weigh the albedo: no
 * sample differs from the series, which one half makes a binary number. */
TEST(furnace_by_cosine_is_exact_in_every_sample)
{
    for (int i = 0; i < COMBINATIONS; i++) {
        ql_settings_t s = combination(i);
        stats_moments_t got;

        if (s.direct != QL_DIRECT_COSINE || s.indirect == QL_INDIRECT_UNIFORM) {
            continue;
        }
        make_furnace(s.direct, 0.5);
        s.bounces = 12;
        got = furnace(&s, 500);
        CHECK(got.m2 == 0 && got.mean == series(0.5, 13),
                "%.9f, want %.9f, variance %g", got.mean, series(0.5, 13),
                stats_variance(&got));
    }
    NOTE("13 reflections, 500 paths each, bit for bit");
}

TEST(direct_none_sees_emitters_and_indirect_none_reflects_them_once)
{
    for (int i = 0; i < COMBINATIONS; i++) {
        ql_settings_t s = combination(i);
        stats_moments_t got;

        make_furnace(s.direct, 0.5);
        s.bounces = 64;
        s.indirect = QL_INDIRECT_NONE;
        claim_furnace(&s, furnace_samples(&s), 1.5);
        s = combination(i);
        s.direct = QL_DIRECT_NONE;
        got = furnace(&s, 200);
        CHECK(got.m2 == 0 && got.mean == 1, "direct none: %.9f", got.mean);
    }
}

/* ---- Scenes without a formula: all strategies against each other --------- */

typedef void (*make_t)(void);

/* A floor seen by one pixel, and the room around it. */
static void begin_room(uint16_t *gray)
{
    static const int32_t a[3] = {4000, 4000, 1000}, b[3] = {28000, 4000, 1000};
    static const int32_t c[3] = {28000, 28000, 1000},
                         d[3] = {4000, 28000, 1000};
    static const int32_t e[3] = {4000, 28000, 16000};
    static const int32_t f[3] = {4000, 4000, 16000};
    static const double right[3] = {3000, 0, 0}, up[3] = {0, 3000, 0};

    mini_begin(&m);
    *gray = mini_material(&m, 0.7, 0);
    mini_quad(&m, a, b, c, d, *gray);
    mini_quad(&m, a, d, e, f, *gray);
    m.radiance_exp = 6; /* room for what is weighed by a small chance */
    mini_eye(&m, 15000, 15000, 1200);
    mini_window(&m, right, up);
    mini_look(&m, 0, 0, -0.5);
}

static void lamp(int32_t x, int32_t y, int32_t z, int32_t side, uint16_t of)
{
    const int32_t a[3] = {x, y, z}, b[3] = {x, y + side, z};
    const int32_t c[3] = {x + side, y + side, z}, d[3] = {x + side, y, z};

    mini_quad(&m, a, b, c, d, of);
}

static void ball(int32_t x, int32_t y, int32_t z, int32_t radius, uint16_t of)
{
    const int32_t centre[3] = {x * 256, y * 256, z * 256};

    (void)mini_sphere(&m, centre, radius * 256, of);
}

/* What the scene is made without, to see that it is missed. */
static bool without_small_lamp;

static void make_mixed(void)
{
    static const int32_t low[3] = {17000, 9000, 1200};
    static const int32_t high[3] = {20000, 12000, 5000};
    static const int32_t a[3] = {9000, 20000, 5000},
                         b[3] = {12000, 20000, 9000};
    static const int32_t c[3] = {10000, 21500, 9500};
    uint16_t gray;

    begin_room(&gray);
    mini_room(&m, low, high, gray);
    lamp(12000, 12000, 14000, 4000, mini_material(&m, 0, 0.5));
    if (!without_small_lamp) {
        lamp(21000, 15000, 4000, 500, mini_material(&m, 0, 40));
    }
    mini_triangle(&m, a, b, c, mini_material(&m, 0.2, 3));
    ball(19000, 18000, 6000, 1500, mini_material(&m, 0.3, 2));
    ball(17000, 16500, 4500, 500, mini_material(&m, 0, 8));
}

static void make_mixed_two_sided(void)
{
    make_mixed();
    m.two_sided = true;
}

/* The floor itself shines, and what shines reflects. */
static void make_reflecting_emitters(void)
{
    const uint16_t glow = (mini_begin(&m), mini_material(&m, 0.5, 0.25));
    uint16_t gray;

    (void)glow;
    begin_room(&gray);
    for (int k = 0; k < 3; k++) {
        m.materials[gray].emission[k] = 0.25;
    }
    lamp(12000, 12000, 9000, 6000, mini_material(&m, 0.6, 1));
    ball(20000, 20000, 4000, 1500, mini_material(&m, 0.5, 2));
}

/* A mirror beside the floor, its front towards the lights. */
static void make_mirror(void)
{
    static const int32_t a[3] = {24000, 4000, 1000}, b[3] = {24000, 4000, 9000};
    static const int32_t c[3] = {24000, 28000, 9000};
    static const int32_t d[3] = {24000, 28000, 1000};
    uint16_t gray, mirror;

    begin_room(&gray);
    mirror = mini_material(&m, 0.2, 0);
    mini_gloss(&m, mirror, QL_GLOSS_MIRROR, 0.7, 0);
    mini_quad(&m, a, b, c, d, mirror);
    lamp(13000, 13000, 9000, 3000, mini_material(&m, 0.3, 2));
    ball(18000, 16000, 5000, 1000, mini_material(&m, 0, 4));
}

/* A pane of glass over all of the floor that is seen, the lights above. */
static void make_glass(void)
{
    static const int32_t low[3] = {8000, 8000, 4000};
    static const int32_t high[3] = {22000, 22000, 4600};
    static const int32_t v[4][3] = {{8000, 8000, 0}, {22000, 8000, 0},
            {22000, 22000, 0}, {8000, 22000, 0}};
    int32_t c[2][4][3];
    uint16_t gray, glass;

    begin_room(&gray);
    glass = mini_material(&m, 0, 0);
    mini_gloss(&m, glass, QL_GLOSS_GLASS, 0.9, 1.5);
    for (int i = 0; i < 8; i++) {
        memcpy(c[i / 4][i % 4], v[i % 4], sizeof c[0][0]);
        c[i / 4][i % 4][2] = i < 4 ? low[2] : high[2];
    }
    mini_quad(&m, c[1][0], c[1][1], c[1][2], c[1][3], glass);
    mini_quad(&m, c[0][0], c[0][3], c[0][2], c[0][1], glass);
    for (int i = 0; i < 4; i++) {
        const int j = (i + 1) % 4;

        mini_quad(&m, c[0][i], c[0][j], c[1][j], c[1][i], glass);
    }
    lamp(11000, 11000, 9000, 8000, mini_material(&m, 0, 1));
    lamp(5000, 14000, 3000, 1500, mini_material(&m, 0, 4));
}

/* A glossy floor: two lobes, each by its chance. */
static void make_glossy(void)
{
    uint16_t gray;

    make_mixed();
    gray = 0;
    for (int k = 0; k < 3; k++) {
        m.materials[gray].albedo[k] = 0.4;
    }
    mini_gloss(&m, gray, QL_GLOSS_PHONG, 0.5, 30);
    /* seen at a slant, so that the lobe meets the lamps */
    mini_look(&m, 0.25, 0.25, -0.25);
}

/* Choices beside the strategy, all of which have the same mean. */
static stats_moments_t ask(make_t make, const ql_settings_t *s, uint32_t n)
{
    make();
    return estimate_pixel(&m, s, 0, 0, n);
}

static double apart(const stats_moments_t *a, const stats_moments_t *b)
{
    return (a->mean - b->mean) /
           sqrt(stats_variance(a) / a->n + stats_variance(b) / b->n + 1e-14);
}

/* All pairs within four standard errors of their difference. */
static double claim_agreement(const char *name, make_t make, uint8_t bounces,
        uint32_t n, stats_moments_t got[STRATEGIES])
{
    double worst = 0;

    for (int k = 0; k < STRATEGIES; k++) {
        const ql_settings_t s = settings_of(k, bounces, 200 + (uint32_t)k);

        got[k] = ask(make, &s, n);
        for (int j = 0; j < k; j++) {
            const double z = apart(got + k, got + j);

            CHECK(fabs(z) < 4, "%s, %d bounces: %s %.7f, %s %.7f, z %.1f", name,
                    bounces, strategies[j].name, got[j].mean,
                    strategies[k].name, got[k].mean, z);
            worst = fmax(worst, fabs(z));
        }
    }
    return worst;
}

TEST(all_strategies_agree_on_triangles_and_spheres)
{
    stats_moments_t got[STRATEGIES], one[STRATEGIES];
    double worst = claim_agreement("mixed", make_mixed, 1, 1u << 20, got);
    double worst_two = claim_agreement(
            "two-sided", make_mixed_two_sided, 1, 1u << 16, one);
    const double brighter = apart(&one[MIS], &got[MIS]);

    CHECK(brighter > STATS_Z_MAX, "two sides shine no more than one: z %.1f",
            brighter);
    NOTE("2^20 samples each: worst z %.1f; two-sided %.1f; %.5f", worst,
            worst_two, got[MIS].mean);
}

TEST(light_choices_densities_and_roulette_change_no_mean)
{
    const ql_settings_t s = settings_of(MIS, 2, 300);
    const stats_moments_t want = ask(make_mixed, &s, 1u << 18);
    double worst = 0;
    int count = 0;

    for (int i = 0; i < COMBINATIONS; i += 2) {
        ql_settings_t other = combination(i);
        stats_moments_t got;
        double z;

        other.roulette = (uint8_t)(i / 2 % 2);
        other.light_samples = i % 5 == 0 ? 2 : 1;
        got = ask(make_mixed, &other, 1u << 14);
        z = apart(&got, &want);
        CHECK(fabs(z) < STATS_Z_MANY,
                "direct %d, lights %d x %d, indirect %d, roulette %d: %.6f, "
                "want %.6f, z %.1f",
                other.direct, other.lights, other.light_samples, other.indirect,
                other.roulette, got.mean, want.mean, z);
        worst = fmax(worst, fabs(z));
        count++;
    }
    NOTE("%d combinations, worst z %.1f", count, worst);
}

TEST(agreement_rejects_a_lamp_left_out_and_a_wrong_pdf)
{
    const ql_settings_t s = settings_of(SOLID_ANGLE, 1, 400);
    const ql_settings_t area = settings_of(AREA, 1, 401);
    stats_moments_t want, got;

    want = ask(make_mixed, &area, 1u << 18);
    without_small_lamp = true;
    got = ask(make_mixed, &s, 1u << 16);
    without_small_lamp = false;
    CHECK(fabs(apart(&got, &want)) > 4, "without a lamp: %.6f, with %.6f",
            got.mean, want.mean);
    make_mixed();
    m.forget_light_pmf = true;
    got = estimate_pixel(&m, &s, 0, 0, 1u << 16);
    CHECK(fabs(apart(&got, &want)) > 4, "pmf forgotten: %.6f, with %.6f",
            got.mean, want.mean);
    make_mixed();
    m.light_weight_scale = 1 / 1.05;
    got = estimate_pixel(&m, &s, 0, 0, 1u << 18);
    CHECK(fabs(apart(&got, &want)) > 4, "pdf 1.05 times: %.6f, right %.6f",
            got.mean, want.mean);
}

/* ---- Emitters count once, whatever is in between ------------------------- */

static const struct {
    const char *name;
    make_t make;
} scenes[] = {{"reflecting emitters", make_reflecting_emitters},
        {"mirror", make_mirror}, {"glass", make_glass},
        {"glossy", make_glossy}};
enum { SCENES = sizeof scenes / sizeof *scenes };

TEST(emitters_count_once_behind_mirrors_and_glass_and_on_gloss)
{
    double worst = 0;

    for (int i = 0; i < SCENES; i++) {
        for (uint8_t bounces = 0; bounces <= 2; bounces++) {
            stats_moments_t got[STRATEGIES];

            worst = fmax(worst, claim_agreement(scenes[i].name, scenes[i].make,
                                        bounces, 1u << 15, got));
        }
    }
    NOTE("%d scenes, 0 to 2 bounces, worst z %.1f", SCENES, worst);
}

TEST(emitters_count_once_for_every_density_and_choice)
{
    double worst = 0;

    for (int i = 0; i < SCENES; i++) {
        const ql_settings_t s = settings_of(MIS, 2, 500);
        const stats_moments_t want = ask(scenes[i].make, &s, 1u << 16);

        for (int k = i; k < COMBINATIONS; k += 4) {
            ql_settings_t other = combination(k);
            stats_moments_t got;
            double z;

            other.sampler = QL_SAMPLER_RANDOM;
            other.roulette = (uint8_t)(k / 4 % 2);
            got = ask(scenes[i].make, &other, 1u << 13);
            z = apart(&got, &want);
            CHECK(fabs(z) < STATS_Z_MANY,
                    "%s: direct %d, lights %d, indirect %d, roulette %d: "
                    "%.6f, want %.6f, z %.1f",
                    scenes[i].name, other.direct, other.lights, other.indirect,
                    other.roulette, got.mean, want.mean, z);
            worst = fmax(worst, fabs(z));
        }
    }
    NOTE("%d combinations on %d scenes, worst z %.1f", COMBINATIONS, SCENES,
            worst);
}

/* Through glass light comes by glass alone: no point on a lamp is seen. */
TEST(light_through_glass_needs_a_bounce_a_face)
{
    const ql_settings_t dark = settings_of(AREA, 1, 600);
    const ql_settings_t lit = settings_of(AREA, 2, 600); /* a face each */
    stats_moments_t none, some;

    make_glass();
    none = estimate_pixel(&m, &dark, 0, 0, 1u << 13);
    some = estimate_pixel(&m, &lit, 0, 0, 1u << 13);
    CHECK(some.mean > none.mean + 0.01, "%.6f with two bounces, %.6f with one",
            some.mean, none.mean);
    NOTE("%.4f with one bounce, %.4f with two", none.mean, some.mean);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("known/strategies", argc, argv);
    RUN(quadrature_gives_the_known_means_and_variances);
    RUN(every_strategy_has_the_known_mean_and_no_other_ones_variance);
    RUN(n_directions_have_the_mean_of_one_and_an_nth_of_its_variance);
    RUN(directions_hit_the_square_as_often_as_a_binomial_says);
    RUN(mis_varies_less_than_both_of_its_parts_near_a_light);
    RUN(emitters_shine_to_both_sides_only_if_they_are_told_to);
    RUN(means_reject_faults_in_every_strategy);
    RUN(disks_have_the_known_form_factors_by_every_strategy);
    RUN(penumbra_has_the_known_form_factors_by_every_strategy);
    RUN(penumbra_rejects_shadows_left_out);
    RUN(furnace_gives_the_series_in_every_combination_and_no_other);
    RUN(furnace_gives_the_series_with_more_light_samples_and_roulette);
    RUN(furnace_by_cosine_is_exact_in_every_sample);
    RUN(direct_none_sees_emitters_and_indirect_none_reflects_them_once);
    RUN(all_strategies_agree_on_triangles_and_spheres);
    RUN(light_choices_densities_and_roulette_change_no_mean);
    RUN(agreement_rejects_a_lamp_left_out_and_a_wrong_pdf);
    RUN(emitters_count_once_behind_mirrors_and_glass_and_on_gloss);
    RUN(emitters_count_once_for_every_density_and_choice);
    RUN(light_through_glass_needs_a_bounce_a_face);
    return TEST_END();
}
