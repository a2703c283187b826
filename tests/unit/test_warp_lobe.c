/* test_warp_lobe.c - lobes against their densities; planted faults fail */
/* SPDX-License-Identifier: MIT */

#include <math.h>

#include "support/ql_double.h"
#include "support/ql_stats.h"
#include "support/ql_table_error.h"
#include "support/ql_test.h"
#include "math/vec/ql_frame.h"
#include "warp/lecture/ql_warp_lecture.h"
#include "warp/ql_warp_cone.h"
#include "warp/ql_warp_hemisphere.h"
#include "warp/ql_warp_lobe.h"

#define LENGTH_ERROR BY_TABLES(QL_CFG_PRECISION == 0 ? 2.4e-5 : 5e-9)
#define NAIVE_ERROR  BY_TABLES(QL_CFG_PRECISION == 0 ? 4.5e-5 : 5e-9)
#define FRAME_ERROR  6e-9

enum {
    SAMPLES = MANY(1 << 20),
    ROWS = 16,
    COLUMNS = 32,
    BINS = ROWS * COLUMNS
};

/* A direction, and 1 - z where it is known better than from z. */
typedef struct {
    double x, y, z, s;
} point_t;

typedef point_t (*warp_t)(uint32_t u1, uint32_t u2);

/* Probability of a direction nearer the axis than this one. */
typedef double (*below_t)(point_t p);

static point_t from_q29(ql_vec3_t v)
{
    const point_t p = {ldexp(v.x, -29), ldexp(v.y, -29), ldexp(v.z, -29),
            1 - ldexp(v.z, -29)};

    return p;
}

static double dot(point_t a, point_t b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static double midpoint(uint32_t u)
{
    return ldexp(u + 0.5, -32);
}

static double real(ql_real_t a)
{
    return ldexp(a.m, a.e);
}

static const uint32_t ends[] = {0, 1, 2, 3, 255, 65535, 0x00ffffffu,
        0x3fffffffu, 0x40000000u, 0x7fffffffu, 0x80000000u, 0xbfffffffu,
        0xc0000000u, 0xfeffffffu, 0xff000000u, 0xffff0000u, 0xfffffffdu,
        0xfffffffeu, 0xffffffffu};

enum { ENDS = sizeof ends / sizeof ends[0] };

/* ---- What every warp is asked ------------------------------------------ */

/* p-value of equal-probability bins. A direction below the horizon is never
 * right. */
static double chi2_p(warp_t warp, below_t below)
{
    static uint32_t counts[BINS];
    uint64_t state = 41;

    memset(counts, 0, sizeof counts);
    for (long i = 0; i < SAMPLES; i++) {
        const uint64_t bits = stats_random(&state);
        const point_t p = warp((uint32_t)bits, (uint32_t)(bits >> 32));
        const double turn = atan2(p.y, p.x) / (2 * PI) + 0.5;
        const double at = below(p);

        if (p.z < 0) {
            return 0;
        }
        counts[(int)fmin(fmax(at * ROWS, 0), ROWS - 1) * COLUMNS +
                (int)(turn * COLUMNS) % COLUMNS]++;
    }
    return stats_chi2_p(
            stats_chi2_equal(counts, BINS, (double)SAMPLES / BINS), BINS - 1);
}

/* Distance from the density of the marginal over all midpoints of 16 bits. */
static double marginal_d(warp_t warp, below_t below)
{
    static double values[65536];

    for (uint32_t k = 0; k < 65536; k++) {
        values[k] = below(warp(k << 16 | 0x8000u, 12345));
    }
    stats_sort(values, 65536);
    return stats_ks_uniform(values, 65536);
}

static double azimuth_d(warp_t warp, uint32_t u1)
{
    static double values[65536];

    for (uint32_t k = 0; k < 65536; k++) {
        const point_t p = warp(u1, k << 16 | 0x8000u);
        const double turn = atan2(p.y, p.x) / (2 * PI);

        values[k] = turn < 0 ? turn + 1 : turn;
    }
    stats_sort(values, 65536);
    return stats_ks_uniform(values, 65536);
}

/* Worst distance of the length from 1; the ends and random numbers. Checks
 * that the direction is in the upper hemisphere. */
static double length_error(warp_t warp, uint32_t count)
{
    uint64_t state = 3;
    double worst = 0;

    for (uint32_t i = 0; i < count + ENDS * ENDS; i++) {
        const bool random = i >= ENDS * ENDS;
        const uint64_t bits = stats_random(&state);
        const uint32_t u1 = random ? (uint32_t)bits : ends[i % ENDS];
        const uint32_t u2 = random ? (uint32_t)(bits >> 32) : ends[i / ENDS];
        const point_t p = warp(u1, u2);

        CHECK(p.z >= 0 && p.z <= 1, "u = %08lx, %08lx: z = %.10f",
                (unsigned long)u1, (unsigned long)u2, p.z);
        worst = fmax(worst, fabs(sqrt(dot(p, p)) - 1));
    }
    return worst;
}

/* Means of z, z^2, x, y, x^2 over 256 x 256 numbers of 8 bits. */
static void moments(warp_t warp, uint32_t offset, double sums[5])
{
    memset(sums, 0, 5 * sizeof sums[0]);
    for (uint32_t i = 0; i < 65536; i++) {
        const point_t p = warp(i << 24 | offset, (i >> 8) << 24 | offset);

        sums[0] += p.z / 65536;
        sums[1] += p.z * p.z / 65536;
        sums[2] += p.x / 65536;
        sums[3] += p.y / 65536;
        sums[4] += p.x * p.x / 65536;
    }
}

#define MIDPOINT     0x800000u
#define MOMENT_LIMIT 1e-4

static void check_moments(warp_t warp, double z, double zz)
{
    double s[5];

    moments(warp, MIDPOINT, s);
    CHECK(fabs(s[0] - z) < MOMENT_LIMIT && fabs(s[1] - zz) < MOMENT_LIMIT &&
                    fabs(s[2]) < MOMENT_LIMIT && fabs(s[3]) < MOMENT_LIMIT &&
                    fabs(s[4] - (1 - zz) / 2) < MOMENT_LIMIT,
            "%.6f %.6f %.6f %.6f %.6f", s[0], s[1], s[2], s[3], s[4]);
    NOTE("mean z %.6f, z^2 %.6f", s[0], s[1]);
}

static void check_accepted(warp_t warp, below_t below)
{
    const double p = chi2_p(warp, below);

    CHECK(p > STATS_P_MIN, "p = %.3g", p);
    NOTE("p = %.2f, %d bins", p, BINS);
}

static void check_rejected(warp_t warp, below_t below)
{
    const double p = chi2_p(warp, below);

    CHECK(p <= STATS_P_MIN, "p = %.3g", p);
    NOTE("p = %.1e", p);
}

static double uniform_below(point_t p)
{
    return p.s;
}

static double cosine_below(point_t p)
{
    return 1 - p.z * p.z;
}

/* ---- Uniform and naive hemisphere -------------------------------------- */

static point_t uniform(uint32_t u1, uint32_t u2)
{
    return from_q29(ql_warp_hemisphere_uniform(u1, u2));
}

static point_t naive(uint32_t u1, uint32_t u2)
{
    return from_q29(ql_warp_lecture_naive(u1, u2));
}

static double naive_below(point_t p)
{
    return acos(fmin(p.z, 1)) / (PI / 2);
}

TEST(uniform_hemisphere_is_uniform)
{
    check_accepted(uniform, uniform_below);
}

TEST(naive_hemisphere_is_rejected_as_uniform)
{
    check_rejected(naive, uniform_below);
}

TEST(naive_hemisphere_matches_its_own_density)
{
    check_accepted(naive, naive_below);
}

TEST(uniform_hemisphere_is_rejected_as_naive)
{
    check_rejected(uniform, naive_below);
}

TEST(uniform_hemisphere_has_exact_marginals)
{
    double last = -1;
    const double d = marginal_d(uniform, uniform_below);
    const double around = azimuth_d(uniform, 0x80000000u);

    for (uint32_t k = 0; k < 65536; k++) {
        const double z = uniform(k << 16 | 0x8000u, 1).z;

        CHECK(z > last, "not monotone at %lu", (unsigned long)k);
        last = z;
    }
    CHECK(d <= 0x1p-17 + 0x1p-30, "height: D = %.3g", d);
    CHECK(around <= 0x1p-17 + SINE_ERROR / 2, "azimuth: D = %.3g", around);
    NOTE("height D = %.3e, azimuth %.3e", d, around);
}

TEST(naive_hemisphere_has_exact_marginals)
{
    const double d = marginal_d(naive, naive_below);

    /* an angle from its cosine: errors grow towards the pole */
    CHECK(d <= 0x1p-17 + (QL_CFG_PRECISION == 0 ? 4e-3 : 2e-4), "D = %.3g", d);
    NOTE("D = %.3e", d);
}

TEST(uniform_and_naive_directions_have_unit_length)
{
    const double a = length_error(uniform, 1000000);
    const double b = length_error(naive, 1000000);

    CHECK(a <= LENGTH_ERROR && b <= NAIVE_ERROR, "%.3g, %.3g", a, b);
    NOTE("worst %.2e uniform, %.2e naive", a, b);
}

TEST(uniform_hemisphere_moments_are_1_2_and_1_3)
{
    check_moments(uniform, 0.5, 1.0 / 3);
}

/* k / 2^b where midpoints belong. */
TEST(hemisphere_of_left_edges_is_rejected)
{
    double s[5];

    moments(uniform, 0, s);
    CHECK(fabs(s[0] - 0.5) >= MOMENT_LIMIT, "mean z %.6f", s[0]);
    NOTE("mean z %.6f at 8 bits", s[0]);
}

/* Weighted by 1 / density, naive directions measure the hemisphere. */
TEST(naive_density_measures_the_hemisphere)
{
    double area = 0, projected = 0;

    CHECK(fabs(ldexp(ql_warp_hemisphere_uniform_pdf(), -32) - 0.5 / PI) <
                    0x1p-32,
            "%lu", (unsigned long)ql_warp_hemisphere_uniform_pdf());
    for (uint32_t k = 0; k < 65536; k++) {
        const ql_vec3_t w =
                ql_warp_lecture_naive(k << 16 | 0x8000u, k * 0x9e3779b9u);
        const double pdf = real(ql_warp_lecture_naive_pdf(w));
        const double exact =
                1 / (PI * PI * hypot(ldexp(w.x, -29), ldexp(w.y, -29)));

        CHECK(fabs(pdf / exact - 1) < ldexp(1, QL_CFG_PRECISION ? -27 : -15),
                "%lu: %.9g, not %.9g", (unsigned long)k, pdf, exact);
        area += 1 / pdf / 65536;
        projected += ldexp(w.z, -29) / pdf / 65536;
    }
    CHECK(fabs(area / (2 * PI) - 1) < 3e-5 && fabs(projected / PI - 1) < 6e-5,
            "%.8f, %.8f", area, projected);
    NOTE("%.6f (2 pi), %.6f (pi)", area, projected);
}

TEST(naive_density_is_0_at_the_pole_and_below)
{
    const ql_vec3_t pole = {0, 0, 1 << 29}, below = {1 << 28, 0, -1};
    const ql_vec3_t rim = {1 << 29, 1 << 12, 0};

    CHECK(ql_warp_lecture_naive_pdf(pole).m == 0 &&
                    ql_warp_lecture_naive_pdf(below).m == 0 &&
                    fabs(real(ql_warp_lecture_naive_pdf(rim)) * PI * PI - 1) <
                            1e-4,
            "%g", real(ql_warp_lecture_naive_pdf(rim)));
}

/* ---- Cosine lobe ------------------------------------------------------- */

static point_t cosine(uint32_t u1, uint32_t u2)
{
    return from_q29(ql_warp_lecture_cosine(u1, u2));
}

TEST(cosine_lobe_matches_its_density)
{
    check_accepted(cosine, cosine_below);
}

TEST(uniform_hemisphere_is_rejected_as_cosine)
{
    check_rejected(uniform, cosine_below);
}

TEST(cosine_lobe_has_exact_marginals)
{
    const double d = marginal_d(cosine, cosine_below);

    /* z relative to 2^-15 or 2^-28, z^2 twice that */
    CHECK(d <= 0x1p-17 + BY_TABLES(QL_CFG_PRECISION ? 0x1p-26 : 0x1p-14),
            "D = %.3g", d);
    NOTE("D = %.3e", d);
}

TEST(cosine_lobe_moments_are_2_3_and_1_2)
{
    check_moments(cosine, 2.0 / 3, 0.5);
}

TEST(cosine_lobe_has_unit_length_and_never_meets_the_horizon)
{
    const double a = length_error(cosine, 2000000);

    CHECK(a <= LENGTH_ERROR, "%.3g", a);
    for (int i = 0; i < ENDS; i++) {
        CHECK(ql_warp_lecture_cosine(0xffffffffu, ends[i]).z > 0, "%d", i);
    }
    NOTE("worst %.2e", a);
}

TEST(cosine_lobe_is_the_cosine_hemisphere_about_z)
{
    const ql_vec3_t n = {0, 0, 1 << 29};
    uint64_t state = 7;
    double worst = 0;

    for (long i = 0; i < MANY(500000); i++) {
        const uint64_t bits = stats_random(&state);
        const uint32_t u1 = (uint32_t)bits, u2 = (uint32_t)(bits >> 32);
        const point_t a = cosine(u1, u2);
        const point_t b = from_q29(ql_warp_hemisphere_cosine(n, u1, u2));
        const double size = sqrt(dot(b, b));

        if (size > 0.01) {
            worst = fmax(worst,
                    fmax(fabs(a.x - b.x / size), fabs(a.z - b.z / size)));
        }
    }
    CHECK(worst <= (QL_CFG_PRECISION == 0 ? 5e-3 : 1e-5), "%.3g", worst);
    NOTE("worst %.2e", worst);
}

TEST(cosine_density_is_z_over_pi)
{
    for (int32_t k = -16; k <= 65536; k++) {
        const int32_t z = k * 8192;
        const double got = ldexp(ql_warp_lecture_cosine_pdf(z), -32);

        CHECK(fabs(got - fmax(ldexp(z, -29), 0) / PI) < 0x1p-31, "%ld: %.12f",
                (long)z, got);
    }
    CHECK(ql_warp_lecture_cosine_pdf(INT32_MIN) == 0, "below");
}

/* ---- cos^m ------------------------------------------------------------- */

static uint32_t power_q16;
static ql_real_t inverse_real;

static void set_power(uint32_t q16)
{
    power_q16 = q16;
    inverse_real = ql_warp_lobe_inverse(q16);
}

static point_t power(uint32_t u1, uint32_t u2)
{
    uint32_t s;
    point_t p = from_q29(ql_warp_lobe(inverse_real, u1, u2, &s));

    p.s = ldexp(s, -31);
    return p;
}

/* 1 - (1 - s)^(m + 1) */
static double power_below(point_t p)
{
    return p.s >= 1 ? 1 : -expm1(log1p(-p.s) * (ldexp(power_q16, -16) + 1));
}

/* The same from the sine: x and y have bits where z has none. */
static double power_below_by_sine(point_t p)
{
    const double ss = p.x * p.x + p.y * p.y;

    return ss >= 1 ? 1 : -expm1(0.5 * log1p(-ss) * (ldexp(power_q16, -16) + 1));
}

/* The fault: z = u^(1/(n + 2)). */
static point_t power_plus_2(uint32_t u1, uint32_t u2)
{
    point_t p = {0, 0, 0, 0};
    const double rho = 2 * PI * midpoint(u2);

    p.s = -expm1(log(midpoint(u1)) / (ldexp(power_q16, -16) + 2));
    p.z = 1 - p.s;
    p.x = sqrt(p.s * (2 - p.s)) * cos(rho);
    p.y = sqrt(p.s * (2 - p.s)) * sin(rho);
    return p;
}

/* The fault: z = u^(2/(n + 1)), rho = sqrt(1 - z): not of unit length. */
static point_t power_squared(uint32_t u1, uint32_t u2)
{
    point_t p = {0, 0, 0, 0};
    const double rho = 2 * PI * midpoint(u2);

    p.s = -expm1(2 * log(midpoint(u1)) / (ldexp(power_q16, -16) + 1));
    p.z = 1 - p.s;
    p.x = sqrt(p.s) * cos(rho);
    p.y = sqrt(p.s) * sin(rho);
    return p;
}

static const uint32_t powers[] = {
        0, 1, 2, 5, 8, 16, 20, 100, 1000, 10000, 65535};

enum { POWERS = sizeof powers / sizeof powers[0] };

/* Ideal 2^-17; s is rounded to 2^-32, and the density of s reaches m + 1; its
 * relative error of 2^-24 moves the distribution by less than half of that. */
TEST(power_lobes_have_exact_marginals)
{
    double worst = 0;

    for (int i = 0; i < POWERS; i++) {
        double d;

        set_power(powers[i] << 16);
        d = marginal_d(power, power_below);
        worst = fmax(worst, d);
        CHECK(d <= 0x1p-17 + ldexp(powers[i] + 1.0, -32) + 0x1p-25,
                "m = %lu: D = %.3g", (unsigned long)powers[i], d);
    }
    NOTE("worst D = %.3e", worst);
}

TEST(power_lobes_are_right_by_their_sines_too)
{
    double worst = 0;

    for (int i = 0; i < POWERS; i++) {
        double d;

        set_power(powers[i] << 16);
        d = marginal_d(power, power_below_by_sine);
        worst = fmax(worst, d);
        /* relative errors of sin^2 move the distribution by at most e^-1 of
         * themselves for large m; near the horizon a root costs more */
        CHECK(d <= (powers[i] == 0          ? 1e-2
                           : powers[i] == 1 ? 2e-4
                                            : 4e-5),
                "m = %lu: D = %.3g", (unsigned long)powers[i], d);
    }
    NOTE("worst D = %.3e", worst);
}

/* Everywhere, not only in distribution. */
TEST(power_lobe_is_within_its_error_of_the_exact_s)
{
    uint64_t state = 9;
    double worst = 0;

    for (uint32_t i = 0; i < MANY(1000000); i++) {
        const uint64_t bits = stats_random(&state);
        const uint32_t u1 =
                i < 2 * ENDS ? ends[i / 2]
                             : (uint32_t)bits >> stats_random_below(&state, 30);
        double exact, got, m;

        set_power(i & 1 ? (uint32_t)(bits >> 32)
                        : (uint32_t)(bits >> 32) >> (bits >> 58 & 31));
        m = ldexp(power_q16, -16);
        exact = -expm1(log(midpoint(u1)) / (m + 1));
        if (u1 >= 0x80000000u) {
            exact = -expm1(log1p(-midpoint(~u1)) / (m + 1));
        }
        got = power(u1, 0).s;
        worst = fmax(worst, (fabs(got - exact) - 0x1p-32) / exact);
        CHECK(fabs(got - exact) <= 0x1p-32 + ldexp(exact, -24),
                "m = %.5f, u = %08lx: %.12g, not %.12g", m, (unsigned long)u1,
                got, exact);
    }
    NOTE("worst 2^%.1f, relative", worst > 0 ? log2(worst) : -99.0);
}

TEST(power_lobes_match_their_densities)
{
    double least = 1;

    for (int i = 0; i < POWERS; i++) {
        double p;

        set_power(powers[i] << 16);
        p = chi2_p(power, power_below);
        least = fmin(least, p);
        CHECK(p > STATS_P_MIN, "m = %lu: p = %.3g", (unsigned long)powers[i],
                p);
    }
    NOTE("least p = %.3f of %d", least, POWERS);
}

TEST(a_power_lobe_of_exponent_1_over_n_plus_2_is_rejected)
{
    set_power(8u << 16);
    check_rejected(power_plus_2, power_below);
}

TEST(a_power_lobe_of_exponent_2_over_n_plus_1_is_rejected)
{
    point_t p;

    set_power(20u << 16);
    p = power_squared(0x20000000u, 99);
    CHECK(fabs(sqrt(dot(p, p)) - 1) > LENGTH_ERROR, "length %.6f",
            sqrt(dot(p, p)));
    check_rejected(power_squared, power_below);
}

TEST(power_lobes_have_unit_length)
{
    double worst = 0;

    for (int i = 0; i < POWERS; i++) {
        double a;

        set_power(powers[i] << 16);
        a = length_error(power, 100000);
        worst = fmax(worst, a);
        CHECK(a <= LENGTH_ERROR, "m = %lu: %.3g", (unsigned long)powers[i], a);
    }
    NOTE("worst %.2e", worst);
}

TEST(power_0_is_uniform_and_power_1_the_cosine)
{
    set_power(0);
    check_moments(power, 0.5, 1.0 / 3);
    check_accepted(power, uniform_below);
    set_power(65536);
    check_moments(power, 2.0 / 3, 0.5);
    check_accepted(power, cosine_below);
}

TEST(power_density_is_within_its_error)
{
    uint64_t state = 19;
    double worst = 0;

    for (uint32_t i = 0; i < MANY(300000); i++) {
        const uint64_t bits = stats_random(&state);
        const uint32_t q16 = (uint32_t)bits >> (bits >> 58 & 31);
        const uint32_t s =
                (uint32_t)(bits >> 33) >> stats_random_below(&state, 31);
        const double m = ldexp(q16, -16), at = ldexp(s, -31);
        const double log = at < 1 ? m * log1p(-at) : -1e9;
        const double exact = (m + 1) / (2 * PI) * exp(log);
        const double got = real(ql_warp_lobe_pdf(q16, s));
        const double limit = 0x1p-26 + m * 0x1p-32 + 0x1p-29 * 1.4427 * -log;

        if (log < -700) {
            CHECK(got <= exp(-690), "m = %.5f, s = %.9g: %g", m, at, got);
            continue;
        }
        worst = fmax(worst, fabs(got / exact - 1) / limit);
        CHECK(fabs(got / exact - 1) <= limit,
                "m = %.5f, s = %.12g: %.12g, not %.12g", m, at, got, exact);
    }
    CHECK(ql_warp_lobe_pdf(0, QL_UQ31_ONE).m == 0 &&
                    ql_warp_lobe_pdf(0xffffffffu, 0x7fffffffu).m == 0 &&
                    ql_warp_lobe_pdf(5, 0xffffffffu).m == 0,
            "not zero at the horizon");
    NOTE("worst %.2f of the bound", worst);
}

/* ---- The cone ---------------------------------------------------------- */

static ql_real_t cone_real;
static double cone_width;

/* To nearest; exact if width has no more than 32 bits. */
static ql_real_t real_of(double a)
{
    int e;
    const double m = frexp(a, &e);
    const ql_real_t r = {(uint32_t)llrint(fmin(ldexp(m, 32), 4294967295.0)),
            (int16_t)(e - 32)};

    return r;
}

static void set_cone(double s_max)
{
    cone_real = real_of(s_max);
    cone_width = real(cone_real);
}

static point_t cone(uint32_t u1, uint32_t u2)
{
    return from_q29(ql_warp_cone(cone_real, u1, u2));
}

static double cone_below(point_t p)
{
    return p.s / cone_width;
}

/* 1 - z = ss / (1 + sqrt(1 - ss)) of the sine: for narrow cones. */
static double cone_below_by_sine(point_t p)
{
    const double ss = fmin(p.x * p.x + p.y * p.y, 1);

    return ss / (1 + sqrt(1 - ss)) / cone_width;
}

/* The fault: sin^2 = s, without the 2 - s. */
static point_t cone_of_s(uint32_t u1, uint32_t u2)
{
    const double s = midpoint(u1) * cone_width;
    const double angle = 2 * PI * midpoint(u2), rho = sqrt(s);
    const point_t p = {rho * cos(angle), rho * sin(angle), 1 - s, s};

    return p;
}

/* The fault: s_max as u1.31, which small spheres do not have bits for. */
static point_t cone_of_u1_31(uint32_t u1, uint32_t u2)
{
    ql_real_t cut = ql_real_from_u64((uint64_t)ldexp(cone_width, 31));

    cut.e = (int16_t)(cut.e - 31);
    return from_q29(ql_warp_cone(cut, u1, u2));
}

/* 1 - cos(theta_max); the last three are spheres of R/d = 10^-4 .. 10^-6. */
static const double cones[] = {1, 0.5, 0.1339745962, 0.005012562893,
        5.000125006e-5, 5e-7, 0x1p-27, 5.0000000125e-9, 5.00000000001e-11,
        5e-13};

enum { CONES = sizeof cones / sizeof cones[0] };

/* x and y are rounded to 2^-30, so at the rim 1 - z is off by sqrt(2) times
 * that of its half, the rim's size. */
static double narrow_error(double s_max)
{
    return s_max > 0x1p-8 ? 0x1p-20 : 0x1p-28 / sqrt(2 * s_max);
}

TEST(cones_of_any_width_match_their_density)
{
    double least = 1, worst = 0;

    for (int i = 0; i < CONES; i++) {
        const bool wide = cones[i] > 0x1p-8;
        double p, d;

        set_cone(cones[i]);
        p = chi2_p(cone, wide ? cone_below : cone_below_by_sine);
        least = fmin(least, p);
        CHECK(p > STATS_P_MIN, "s_max = %g: p = %.3g", cones[i], p);
        d = marginal_d(cone, wide ? cone_below : cone_below_by_sine);
        worst = fmax(worst, d);
        CHECK(d <= 0x1p-17 + narrow_error(cones[i]) +
                                (QL_CFG_PRECISION || wide ? 2e-7 : 9e-5),
                "s_max = %g: D = %.3g", cones[i], d);
    }
    NOTE("least p = %.3f of %d, worst D = %.2e", least, CONES, worst);
}

TEST(a_cone_of_another_width_is_rejected)
{
    set_cone(5e-7);
    CHECK(chi2_p(cone_of_s, cone_below_by_sine) <= STATS_P_MIN, "narrow");
    set_cone(5.0000000125e-9);
    CHECK(chi2_p(cone_of_u1_31, cone_below_by_sine) <= STATS_P_MIN, "cut");
    set_cone(0.5);
    CHECK(chi2_p(cone, uniform_below) <= STATS_P_MIN, "as a hemisphere");
}

TEST(cone_directions_have_unit_length_and_keep_inside)
{
    double worst = 0;

    for (int i = 0; i < CONES; i++) {
        double a;

        set_cone(cones[i]);
        a = length_error(cone, 100000);
        worst = fmax(worst, a);
        CHECK(a <= LENGTH_ERROR, "s_max = %g: %.3g", cones[i], a);
        for (int k = 0; k < ENDS * ENDS; k++) {
            const point_t p = cone(ends[k % ENDS], ends[k / ENDS]);

            CHECK(p.s <= cone_width + 0x1p-30, "s_max = %g: %.10g", cones[i],
                    p.s);
        }
    }
    NOTE("worst %.2e", worst);
}

TEST(a_cone_of_no_width_is_its_axis)
{
    const ql_real_t zero = {0, 0};

    for (int k = 0; k < ENDS * ENDS; k++) {
        const ql_vec3_t v = ql_warp_cone(zero, ends[k % ENDS], ends[k / ENDS]);

        CHECK(v.x == 0 && v.y == 0 && v.z == 1 << 29, "%ld %ld %ld", (long)v.x,
                (long)v.y, (long)v.z);
    }
    CHECK(ql_warp_cone_pdf(zero).m == 0, "density %g",
            real(ql_warp_cone_pdf(zero)));
}

TEST(a_cone_too_wide_ends_at_the_horizon)
{
    const ql_real_t wide = {0xffffffffu, 20};

    for (int k = 0; k < ENDS * ENDS; k++) {
        const ql_vec3_t v = ql_warp_cone(wide, ends[k % ENDS], ends[k / ENDS]);

        CHECK(v.z >= 0 && v.z <= 1 << 29, "z = %ld", (long)v.z);
    }
}

/* R/d = 0.1: 1 - cos = 0.005012562893, solid angle 0.03149486152. */
TEST(cone_density_is_1_over_the_solid_angle)
{
    const double got = 1 / real(ql_warp_cone_pdf(real_of(0.005012562893)));
    uint64_t state = 17;

    CHECK(fabs(got / 0.03149486152 - 1) < 0x1p-28 + 2e-10, "%.12f", got);
    for (uint32_t k = 0; k < MANY(200000); k++) {
        const ql_real_t s = {(uint32_t)stats_random(&state) | 0x80000000u,
                (int16_t)(-32 - (int)stats_random_below(&state, 60))};
        const double is = real(ql_warp_cone_pdf(s)) * 2 * PI * real(s);

        CHECK(fabs(is - 1) < 0x1p-28, "s_max = %g: %.3g off", real(s), is - 1);
    }
    NOTE("solid angle %.11f", got);
}

/* 1 - sqrt(1 - x) of what the mantissa says, without cancelling. */
static double cone_error(ql_real_t ratio2)
{
    const long double x = ldexpl(ratio2.m, ratio2.e);
    const ql_real_t s = ql_warp_cone_of_sphere(ratio2);

    CHECK(s.m >= 0x80000000u, "%Lg: mantissa %08lx", x, (unsigned long)s.m);
    return (double)fabsl(ldexpl(s.m, s.e) * (1 + sqrtl(1 - x)) / x - 1);
}

TEST(the_cone_of_a_sphere_keeps_its_relative_precision)
{
    static const double ratios[][2] = {
            {0.5, 0.1339745962}, {0.1, 0.005012562893}, {0.01, 5.000125006e-5}};
    uint64_t state = 19;
    double worst = 0;

    for (int i = 0; i < 3; i++) {
        const double r = ratios[i][0];
        const double s = real(ql_warp_cone_of_sphere(real_of(r * r)));

        CHECK(fabs(s / ratios[i][1] - 1) < 1e-8, "R/d = %g: %.12g", r, s);
    }
    for (double r = 1e-6; r < 0.999999; r *= 1.0001) {
        worst = fmax(worst, cone_error(real_of(r * r)));
    }
    for (long i = 0; i < MANY(500000); i++) {
        const uint32_t bits = (uint32_t)stats_random(&state);
        const ql_real_t wide = {
                ~(bits >> stats_random_below(&state, 31) >> 1), -32};
        const ql_real_t any = {bits | 0x80000000u,
                (int16_t)(-32 - (int)stats_random_below(&state, 64))};

        worst = fmax(worst, fmax(cone_error(wide), cone_error(any)));
    }
    CHECK(worst <= 0x1p-27, "%.3g", worst);
    NOTE("worst %.2e, bound %.2e; R/d from 10^-6", worst, 0x1p-27);
}

TEST(the_cone_at_or_inside_a_sphere_is_a_hemisphere)
{
    const ql_real_t zero = {0, 7};

    CHECK(real(ql_warp_cone_of_sphere(real_of(1))) == 1 &&
                    real(ql_warp_cone_of_sphere(real_of(1e9))) == 1 &&
                    ql_warp_cone_of_sphere(zero).m == 0,
            "%g", real(ql_warp_cone_of_sphere(real_of(1))));
}

/* ---- Frames ------------------------------------------------------------ */

static double frame_worst;

static void check_frame(ql_vec3_t n)
{
    ql_frame_t f;
    point_t s, t, m, cross;
    double worst;

    ql_frame_from_normal(&f, n);
    s = from_q29(f.s);
    t = from_q29(f.t);
    m = from_q29(f.n);
    worst = fmax(fabs(sqrt(dot(s, s)) - 1), fabs(sqrt(dot(t, t)) - 1));
    worst = fmax(worst, fmax(fabs(dot(s, t)), fabs(dot(s, m))));
    worst = fmax(worst, fabs(dot(t, m)));
    cross = (point_t){s.y * t.z - s.z * t.y, s.z * t.x - s.x * t.z,
            s.x * t.y - s.y * t.x, 0};
    worst = fmax(worst, fabs(dot(cross, m) - 1));
    frame_worst = fmax(frame_worst, worst);
    CHECK(worst <= FRAME_ERROR, "n = %ld %ld %ld: off by %.3g", (long)n.x,
            (long)n.y, (long)n.z, worst);
}

static ql_vec3_t unit_q29(double x, double y, double z)
{
    const double by = ldexp(1 / sqrt(x * x + y * y + z * z), 29);
    const ql_vec3_t n = {(int32_t)lrint(x * by), (int32_t)lrint(y * by),
            (int32_t)lrint(z * by)};

    return n;
}

TEST(frames_are_orthonormal_and_right_handed)
{
    uint64_t state = 29;

    frame_worst = 0;
    for (int k = 0; k < 27; k++) {
        if (k != 13) {
            check_frame(unit_q29(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1));
        }
    }
    for (int e = 0; e <= 30; e++) {
        for (int k = 0; k < 16; k++) {
            const double tiny = ldexp(k & 1 ? 1 : -1, -e);

            check_frame(unit_q29(tiny, k & 2 ? 0 : tiny, k & 4 ? 1 : -1));
            check_frame(unit_q29(k & 4 ? 1 : -1, k & 2 ? 0 : 1, tiny));
        }
    }
    for (long i = 0; i < MANY(1000000); i++) {
        const double z = 2 * stats_random_unit(&state) - 1;
        const double angle = 2 * PI * stats_random_unit(&state);
        const double rho = sqrt(1 - z * z);

        check_frame(unit_q29(rho * cos(angle), rho * sin(angle), z));
    }
    NOTE("worst %.2e", frame_worst);
}

TEST(a_frame_without_the_sign_is_rejected)
{
    /* a = -1/(1 + z) for z < 0: near the pole below, 1 - x^2/(1 + |z|) with
     * s.z = -x is not across n */
    const ql_vec3_t n = unit_q29(0.6, 0, -0.8);
    ql_frame_t f;
    point_t s;

    ql_frame_from_normal(&f, n);
    s = from_q29(f.s);
    s.z = -s.z;
    CHECK(fabs(dot(s, from_q29(n))) > FRAME_ERROR, "%.3g", dot(s, from_q29(n)));
}

/* Any bits at all: some frame, no undefined step. */
TEST(frames_of_any_vector_are_defined)
{
    static const int32_t odd[] = {
            INT32_MIN, INT32_MIN + 1, -(1 << 30), -1, 0, 1, 1 << 29, INT32_MAX};

    for (int i = 0; i < 512; i++) {
        const ql_vec3_t n = {odd[i & 7], odd[i >> 3 & 7], odd[i >> 6]};
        ql_frame_t f;

        ql_frame_from_normal(&f, n);
        CHECK(f.n.x == n.x && f.n.y == n.y && f.n.z == n.z, "%d", i);
    }
}

TEST(frames_turn_local_directions_to_the_world)
{
    uint64_t state = 33;
    double worst = 0;

    set_power(8u << 16);
    for (long i = 0; i < MANY(200000); i++) {
        const uint64_t bits = stats_random(&state);
        const double z = 2 * stats_random_unit(&state) - 1;
        const double angle = 2 * PI * stats_random_unit(&state);
        const double rho = sqrt(1 - z * z);
        const ql_vec3_t n = unit_q29(rho * cos(angle), rho * sin(angle), z);
        uint32_t s;
        const ql_vec3_t v = ql_warp_lobe(
                inverse_real, (uint32_t)bits, (uint32_t)(bits >> 32), &s);
        ql_frame_t f;
        point_t a, w, axes[3];

        ql_frame_from_normal(&f, n);
        a = from_q29(v);
        w = from_q29(ql_frame_to_world(&f, v));
        axes[0] = from_q29(f.s);
        axes[1] = from_q29(f.t);
        axes[2] = from_q29(f.n);
        worst = fmax(worst, fabs(dot(w, axes[0]) - a.x));
        worst = fmax(worst, fabs(dot(w, axes[1]) - a.y));
        worst = fmax(worst, fabs(dot(w, axes[2]) - a.z));
    }
    CHECK(worst <= 3 * FRAME_ERROR, "%.3g", worst);
    NOTE("worst %.2e", worst);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_warp_lobe", argc, argv);
    RUN_IF(TABLES_EXACT, uniform_hemisphere_is_uniform);
    RUN(naive_hemisphere_is_rejected_as_uniform);
    RUN_IF(TABLES_EXACT, naive_hemisphere_matches_its_own_density);
    RUN(uniform_hemisphere_is_rejected_as_naive);
    RUN(uniform_hemisphere_has_exact_marginals);
    RUN_IF(TABLES_EXACT, naive_hemisphere_has_exact_marginals);
    RUN(uniform_and_naive_directions_have_unit_length);
    RUN_IF(TABLES_EXACT, uniform_hemisphere_moments_are_1_2_and_1_3);
    RUN(hemisphere_of_left_edges_is_rejected);
    RUN_IF(TABLES_EXACT, naive_density_measures_the_hemisphere);
    RUN(naive_density_is_0_at_the_pole_and_below);
    RUN_IF(TABLES_EXACT, cosine_lobe_matches_its_density);
    RUN(uniform_hemisphere_is_rejected_as_cosine);
    RUN(cosine_lobe_has_exact_marginals);
    RUN_IF(TABLES_EXACT, cosine_lobe_moments_are_2_3_and_1_2);
    RUN(cosine_lobe_has_unit_length_and_never_meets_the_horizon);
    RUN_IF(TABLES_EXACT, cosine_lobe_is_the_cosine_hemisphere_about_z);
    RUN(cosine_density_is_z_over_pi);
    RUN(power_lobes_have_exact_marginals);
    RUN_IF(TABLES_EXACT, power_lobes_are_right_by_their_sines_too);
    RUN(power_lobe_is_within_its_error_of_the_exact_s);
    RUN_IF(TABLES_EXACT, power_lobes_match_their_densities);
    RUN(a_power_lobe_of_exponent_1_over_n_plus_2_is_rejected);
    RUN_IF(TABLES_EXACT, a_power_lobe_of_exponent_2_over_n_plus_1_is_rejected);
    RUN(power_lobes_have_unit_length);
    RUN_IF(TABLES_EXACT, power_0_is_uniform_and_power_1_the_cosine);
    RUN(power_density_is_within_its_error);
    RUN_IF(TABLES_EXACT, cones_of_any_width_match_their_density);
    RUN(a_cone_of_another_width_is_rejected);
    RUN(cone_directions_have_unit_length_and_keep_inside);
    RUN(a_cone_of_no_width_is_its_axis);
    RUN(a_cone_too_wide_ends_at_the_horizon);
    RUN(cone_density_is_1_over_the_solid_angle);
    RUN(the_cone_of_a_sphere_keeps_its_relative_precision);
    RUN(the_cone_at_or_inside_a_sphere_is_a_hemisphere);
    RUN(frames_are_orthonormal_and_right_handed);
    RUN(a_frame_without_the_sign_is_rejected);
    RUN(frames_of_any_vector_are_defined);
    RUN(frames_turn_local_directions_to_the_world);
    return TEST_END();
}
