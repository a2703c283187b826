/* test_warp_sphere.c - sphere, cosine hemisphere, triangle against densities */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <stdlib.h>

#include "support/ql_double.h"
#include "support/ql_stats.h"
#include "support/ql_table_error.h"
#include "support/ql_test.h"
#include "math/vec/ql_vec_unit.h"
#include "warp/ql_warp_hemisphere.h"
#include "warp/ql_warp_plane.h"
#include "warp/ql_warp_sphere.h"

#define LENGTH_ERROR BY_TABLES(QL_CFG_PRECISION == 0 ? 2e-5 : 7e-9)
#define HORIZON_LOG2 (QL_CFG_PRECISION == 0 ? -18 : -26)

enum {
    SAMPLES = MANY(1 << 20),
    ROWS = 16,
    COLUMNS = 32,
    BINS = ROWS * COLUMNS
};

typedef struct {
    double x, y, z;
} point_t;

typedef point_t (*warp_t)(uint32_t u1, uint32_t u2);

static point_t from_q29(ql_vec3_t v)
{
    const point_t p = {ldexp(v.x, -29), ldexp(v.y, -29), ldexp(v.z, -29)};

    return p;
}

static double dot(point_t a, point_t b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static point_t scaled(point_t a, double by)
{
    const point_t p = {a.x * by, a.y * by, a.z * by};

    return p;
}

static double length(point_t a)
{
    return sqrt(dot(a, a));
}

/* ---- The sphere and its faults ----------------------------------------- */

static point_t sphere(uint32_t u1, uint32_t u2)
{
    return from_q29(ql_warp_sphere(u1, u2));
}

/* What u1 (1 - u1) loses: with x = 2^32 u1 (1 - u1) the core has the integer
 * part of x - 1/2, so rho = 2 sqrt(u1 (1 - u1)) is short by this at most. */
static double pole_error(double u)
{
    const double x = 0x1p32 * u * (1 - u);

    return 0x1p-15 * (sqrt(x) - sqrt(fmax(x - 1.5, 0)));
}

/* How far a point is off, as a part of what it may be. */
static double sphere_off(uint32_t u1, uint32_t u2, double *off)
{
    const double u = ((double)u1 + 0.5) * 0x1p-32;
    const double phi = 2 * PI * (double)u2 * 0x1p-32;
    const double rho = 2 * sqrt(u * (1 - u));
    const point_t p = sphere(u1, u2);
    const point_t d = {
            p.x - rho * cos(phi), p.y - rho * sin(phi), p.z - (1 - 2 * u)};

    *off = length(d);
    return *off /
           (1.02 * (SINE_ERROR + WARP_ROOT_ERROR) + 0x1p-28 + pole_error(u));
}

/* However coarse the tables, no point is further off than they say, nor than
 * u1 (1 - u1) loses next to the poles: every u1 there, and random ones. */
TEST(sphere_points_are_off_by_no_more_than_the_tables)
{
    enum { POLE = 1 << 16 };
    uint64_t state = 21;
    double worst = 0, most = 0, off;

    for (long i = 0; i < MANY(1000000); i++) {
        const uint64_t bits = stats_random(&state);
        const uint32_t near = (uint32_t)(i / 2);
        const uint32_t u1 = near >= POLE ? (uint32_t)bits
                            : i % 2      ? ~near
                                         : near;
        const double share = sphere_off(u1, (uint32_t)(bits >> 32), &off);

        CHECK(share <= 1, "u1 = %08lx: %.3g, %.4f of the bound",
                (unsigned long)u1, off, share);
        worst = fmax(worst, share);
        most = fmax(most, off);
    }
    CHECK(most <= 3.8e-5 + 1.02 * (SINE_ERROR + WARP_ROOT_ERROR), "%.3g", most);
    /* the worst u1: all of the bound is needed */
    (void)sphere_off(1, 0, &off);
    CHECK(off > 3.7e-5, "u1 = 1: %.3g", off);
    NOTE("%.3f of the bound, worst %.2e at the poles", worst, most);
}

static point_t sphere_without_factor_2(uint32_t u1, uint32_t u2)
{
    point_t p = sphere(u1, u2);

    p.x /= 2; /* rho = sqrt(u (1 - u)) */
    p.y /= 2;
    return p;
}

static point_t sphere_of_one_half(uint32_t u1, uint32_t u2)
{
    const double z = 1 - ldexp(u1 + 0.5, -32); /* not 1 - 2 u */
    const double rho = sqrt(1 - z * z), angle = PI * ldexp(u2 + 0.5, -31);
    const point_t p = {rho * cos(angle), rho * sin(angle), z};

    return p;
}

static double azimuth(double y, double x)
{
    const double turn = atan2(y, x) / (2 * PI);

    return turn < 0 ? turn + 1 : turn;
}

/* p-value of 2^20 random samples in bins of equal probability about an axis:
 * rows are equal steps of height(cos theta), columns of azimuth. Heights a
 * little outside [0, 1] count in the row they are next to. */
static double chi2_about(warp_t warp, point_t axis, double (*height)(double))
{
    static uint32_t counts[BINS];
    const point_t helper =
            fabs(axis.x) < 0.6 ? (point_t){1, 0, 0} : (point_t){0, 1, 0};
    const point_t across = {helper.y * axis.z - helper.z * axis.y,
            helper.z * axis.x - helper.x * axis.z,
            helper.x * axis.y - helper.y * axis.x};
    const point_t s = scaled(across, 1 / length(across));
    const point_t t = {axis.y * s.z - axis.z * s.y, axis.z * s.x - axis.x * s.z,
            axis.x * s.y - axis.y * s.x};
    uint64_t state = 11;

    memset(counts, 0, sizeof counts);
    for (long i = 0; i < SAMPLES; i++) {
        const uint64_t bits = stats_random(&state);
        const point_t p = warp((uint32_t)bits, (uint32_t)(bits >> 32));
        const double at = height(dot(p, axis));
        int row, column;

        row = (int)fmin(fmax(floor(at * ROWS), 0), ROWS - 1);
        column = (int)(azimuth(dot(p, t), dot(p, s)) * COLUMNS) % COLUMNS;
        counts[row * COLUMNS + column]++;
    }
    return stats_chi2_p(
            stats_chi2_equal(counts, BINS, (double)SAMPLES / BINS), BINS - 1);
}

static double uniform_height(double z)
{
    return (1 - z) / 2;
}

static double cosine_height(double z)
{
    return z < 0 ? 0 : z * z;
}

static const point_t z_axis = {0, 0, 1};

TEST(sphere_is_uniform)
{
    const double p = chi2_about(sphere, z_axis, uniform_height);

    CHECK(p > STATS_P_MIN, "p = %.3g", p);
    NOTE("p = %.2f, %d bins", p, BINS);
}

TEST(sphere_of_z_from_0_is_rejected)
{
    const double p = chi2_about(sphere_of_one_half, z_axis, uniform_height);

    CHECK(p <= STATS_P_MIN, "p = %.3g", p);
}

TEST(sphere_points_have_unit_length)
{
    static const uint32_t ends[] = {0, 1, 2, 3, 255, 65535, 0x00ffffffu,
            0x3fffffffu, 0x40000000u, 0x7fffffffu, 0x80000000u, 0xbfffffffu,
            0xc0000000u, 0xff000000u, 0xffff0000u, 0xfffffffdu, 0xfffffffeu,
            0xffffffffu};
    const size_t n = sizeof ends / sizeof ends[0];
    uint64_t state = 1;
    double worst = 0;

    for (uint32_t i = 0; i < MANY(2000000) + n * n; i++) {
        const bool random = i >= n * n;
        const uint64_t bits = stats_random(&state);
        const uint32_t u1 = random ? (uint32_t)bits : ends[i % n];
        const uint32_t u2 = random ? (uint32_t)(bits >> 32) : ends[i / n];
        const double error = fabs(length(sphere(u1, u2)) - 1);

        worst = fmax(worst, error);
        CHECK(error <= LENGTH_ERROR, "u = %08lx, %08lx: length off by %.3g",
                (unsigned long)u1, (unsigned long)u2, error);
    }
    /* the worst that were found, root by root and angle by angle */
    worst = fmax(worst, fabs(length(sphere(0x7a60aad9u, 0x273ffffcu)) - 1));
    worst = fmax(worst, fabs(length(sphere(0x9f1bb237u, 0x1185c423u)) - 1));
    CHECK(worst <= LENGTH_ERROR, "off by %.3g", worst);
    CHECK(!TABLES_DEFAULT || worst > 0.8 * LENGTH_ERROR,
            "off by %.3g: less than is claimed", worst);
    NOTE("worst %.2e, bound %.1e", worst, LENGTH_ERROR);
}

TEST(sphere_without_the_factor_2_is_rejected)
{
    const double error =
            fabs(length(sphere_without_factor_2(0x60000000u, 77)) - 1);

    CHECK(error > LENGTH_ERROR, "length off by %.3g", error);
    NOTE("length off by %.2f", error);
}

/* Heights and azimuths of all 2^16 midpoints of 16 bits. */
TEST(sphere_marginals_are_uniform_over_all_16_bit_numbers)
{
    static double values[65536];
    double d;

    for (uint32_t k = 0; k < 65536; k++) {
        values[k] = uniform_height(sphere(k << 16 | 0x8000u, 12345).z);
        CHECK(k == 0 || values[k] > values[k - 1], "height of %lu",
                (unsigned long)k);
    }
    d = stats_ks_uniform(values, 65536);
    CHECK(d <= 0x1p-17 + 0x1p-29, "height: D = %.3g", d);
    for (uint32_t k = 0; k < 65536; k++) {
        const point_t p = sphere(0x80000000u, k << 16 | 0x8000u);

        values[k] = azimuth(p.y, p.x);
    }
    stats_sort(values, 65536);
    d = stats_ks_uniform(values, 65536);
    /* the sine's error, as an angle */
    CHECK(d <= 0x1p-17 + SINE_ERROR / 2, "azimuth: D = %.3g", d);
    NOTE("D = %.2e", d);
}

/* ---- Moments on the lattice of 8-bit numbers --------------------------- */

typedef struct {
    double x, y, z, xx, yy, zz, xy, yz, zx;
} sums_t;

/* Means over the 256 x 256 lattice; offset places u in its cell of 2^24. */
static sums_t lattice(warp_t warp, uint32_t offset)
{
    sums_t s = {0, 0, 0, 0, 0, 0, 0, 0, 0};
    const double n = 65536;

    for (uint32_t i = 0; i < 65536; i++) {
        const point_t p = warp(i << 16 << 8 | offset, (i >> 8) << 24 | offset);

        s.x += p.x / n;
        s.y += p.y / n;
        s.z += p.z / n;
        s.xx += p.x * p.x / n;
        s.yy += p.y * p.y / n;
        s.zz += p.z * p.z / n;
        s.xy += p.x * p.y / n;
        s.yz += p.y * p.z / n;
        s.zx += p.z * p.x / n;
    }
    return s;
}

#define MIDPOINT     0x800000u
#define MOMENT_LIMIT 1e-4
#define SQUARE_LIMIT 1e-8 /* beside what the tables say */

/* Mean x^2 and y^2 of the lattice, with the roots and angles that the tables
 * hold in place of the exact ones: two sums, as the two are independent. */
static point_t squares_by_tables(void)
{
    double rho = 0, cosines = 0;
    point_t p = {0, 0, 1.0 / 3};

    for (uint32_t i = 0; i < 256; i++) {
        /* 4 u (1 - u), u0.32, and its mantissa 2^30..2^32 as the root has it */
        const uint32_t u = i << 24 | MIDPOINT;
        const uint32_t x = (uint32_t)((uint64_t)u * ~u >> 32) << 2;
        const uint32_t m = x << 2 * (int)floor((32 - log2(x)) / 2);
        const double root = ldexp(ql_rsqrt_warp_m(m), -47);
        int32_t sine, cosine;

        ql_sincos(i << 24 | MIDPOINT, &sine, &cosine);
        rho += fmin(ldexp(x, -32) * m * root * root, 1) / 256;
        cosines += ldexp(cosine, -30) * ldexp(cosine, -30) / 256;
        p.y += ldexp(sine, -30) * ldexp(sine, -30) / 256;
    }
    p.x = rho * cosines;
    p.y *= rho;
    return p;
}

/* Tables that are not refined change the squares by what their entries are off
 * in the mean; that much is worked out, and what is left is rounding. */
TEST(sphere_moments_are_those_of_the_uniform_density)
{
    const sums_t s = lattice(sphere, MIDPOINT);
    const point_t wanted = squares_by_tables();

    CHECK(fabs(s.x) < MOMENT_LIMIT && fabs(s.y) < MOMENT_LIMIT &&
                    fabs(s.z) < MOMENT_LIMIT,
            "mean %.6f %.6f %.6f", s.x, s.y, s.z);
    CHECK(fabs(wanted.x - 1.0 / 3) <
                    MOMENT_LIMIT / 2 + SINE_ERROR + WARP_ROOT_ERROR,
            "by the tables %.6f", wanted.x);
    CHECK(fabs(s.xx - wanted.x) < SQUARE_LIMIT &&
                    fabs(s.yy - wanted.y) < SQUARE_LIMIT &&
                    fabs(s.zz - wanted.z) < MOMENT_LIMIT,
            "squares %.6f %.6f %.6f, by the tables %.6f %.6f", s.xx, s.yy, s.zz,
            wanted.x, wanted.y);
    CHECK(fabs(s.xy) < MOMENT_LIMIT && fabs(s.yz) < MOMENT_LIMIT &&
                    fabs(s.zx) < MOMENT_LIMIT,
            "products %.6f %.6f %.6f", s.xy, s.yz, s.zx);
    NOTE("mean z %.1e, squares off by %.1e %.1e", s.z, s.xx - wanted.x,
            s.yy - wanted.y);
}

TEST(left_edges_instead_of_midpoints_are_rejected)
{
    const sums_t s = lattice(sphere, 0);

    CHECK(fabs(s.z) >= MOMENT_LIMIT, "mean z %.6f", s.z);
    NOTE("mean z %.1e at 8 bits", s.z);
}

/* ---- The cosine hemisphere --------------------------------------------- */

static ql_vec3_t normal_q29;
static bool round_direction;

/* About normal_q29, as a unit vector; rounded as a ray's direction if asked. */
static point_t cosine(uint32_t u1, uint32_t u2)
{
    ql_vec3_t v = ql_warp_hemisphere_cosine(normal_q29, u1, u2);
    point_t p;

    if (round_direction) {
        v = ql_vec_to_dir(v);
    }
    p = from_q29(v);
    return scaled(p, 1 / fmax(length(p), 1e-300));
}

/* The planted fault: uniform over the hemisphere. */
static point_t hemisphere(uint32_t u1, uint32_t u2)
{
    const point_t p = sphere(u1, u2);

    return dot(p, from_q29(normal_q29)) < 0 ? scaled(p, -1) : p;
}

static ql_vec3_t normal_of(unsigned i)
{
    static const ql_vec3_t axes[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0},
            {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    uint64_t state = i;
    point_t p;
    ql_vec3_t n;

    if (i < 6) {
        n.x = axes[i].x * (1 << 29);
        n.y = axes[i].y * (1 << 29);
        n.z = axes[i].z * (1 << 29);
        return n;
    }
    do {
        p.x = 2 * stats_random_unit(&state) - 1;
        p.y = 2 * stats_random_unit(&state) - 1;
        p.z = 2 * stats_random_unit(&state) - 1;
    } while (length(p) > 1 || length(p) < 0.1);
    p = scaled(p, ldexp(1 / length(p), 29));
    n.x = (int32_t)lrint(p.x);
    n.y = (int32_t)lrint(p.y);
    n.z = (int32_t)lrint(p.z);
    return n;
}

enum { NORMALS = 10 };

static double least_p(bool rounded)
{
    double least = 1;

    round_direction = rounded;
    for (unsigned i = 0; i < NORMALS; i++) {
        double p;

        normal_q29 = normal_of(i);
        p = chi2_about(cosine, from_q29(normal_q29), cosine_height);
        least = fmin(least, p);
        CHECK(p > STATS_P_MIN, "normal %u (%ld %ld %ld): p = %.3g", i,
                (long)normal_q29.x, (long)normal_q29.y, (long)normal_q29.z, p);
    }
    return least;
}

TEST(cosine_hemisphere_matches_its_pdf_about_any_normal)
{
    NOTE("least p = %.3f of %d normals", least_p(false), NORMALS);
}

TEST(rounded_directions_match_the_pdf_too)
{
    NOTE("least p = %.3f of %d normals", least_p(true), NORMALS);
}

TEST(uniform_directions_instead_of_cosine_are_rejected)
{
    double p;

    normal_q29 = normal_of(6);
    p = chi2_about(hemisphere, from_q29(normal_q29), cosine_height);
    CHECK(p <= STATS_P_MIN, "p = %.3g", p);
}

/* Moments about the axis: E[cos] = 2/3, E[cos^2] = 1/2, none across it. */
TEST(cosine_moments_are_those_of_its_density)
{
    sums_t s;

    normal_q29 = normal_of(4);
    round_direction = false;
    s = lattice(cosine, MIDPOINT);
    CHECK(fabs(s.z - 2.0 / 3) < MOMENT_LIMIT && fabs(s.x) < MOMENT_LIMIT &&
                    fabs(s.y) < MOMENT_LIMIT,
            "mean %.6f %.6f %.6f", s.x, s.y, s.z);
    CHECK(fabs(s.zz - 0.5) < MOMENT_LIMIT && fabs(s.xx - 0.25) < MOMENT_LIMIT &&
                    fabs(s.yy - 0.25) < MOMENT_LIMIT,
            "squares %.6f %.6f %.6f", s.xx, s.yy, s.zz);
    NOTE("mean cosine %.6f", s.z);
}

TEST(cosine_of_left_edges_is_rejected)
{
    sums_t s;

    normal_q29 = normal_of(4);
    round_direction = false;
    s = lattice(cosine, 0);
    CHECK(fabs(s.z - 2.0 / 3) >= MOMENT_LIMIT, "mean cosine %.6f", s.z);
    NOTE("mean cosine %.6f at 8 bits", s.z);
}

/* What the sphere's length errs can put a grazing direction behind the surface;
 * the path tracer says how rarely. */
TEST(directions_below_the_horizon_are_as_rare_as_stated)
{
    const long count = MANY(1l << 24);
    uint64_t state = 21;
    long below = 0, zero = 0;

    for (long i = 0; i < count; i++) {
        const uint64_t bits = stats_random(&state);
        ql_vec3_t v;

        if ((i & 1023) == 0) {
            normal_q29 = normal_of(6 + (unsigned)(i >> 10 & 255));
        }
        v = ql_vec_to_dir(ql_warp_hemisphere_cosine(
                normal_q29, (uint32_t)bits, (uint32_t)(bits >> 32)));
        below += (int64_t)v.x * normal_q29.x + (int64_t)v.y * normal_q29.y +
                         (int64_t)v.z * normal_q29.z <=
                 0;
        zero += (v.x | v.y | v.z) == 0;
    }
    CHECK((double)below <= ldexp((double)count, HORIZON_LOG2),
            "%ld of %ld directions, %ld of them zero: 2^%.1f", below, count,
            zero, log2((double)below / (double)count));
    NOTE("%ld of %ld directions, %ld of them zero", below, count, zero);
}

/* ---- Rounding a direction ---------------------------------------------- */

static double worst_angle;

/* In [-2^30, 2^30]. */
static int32_t signed30(uint64_t *state)
{
    return (int32_t)stats_random_below(state, 0x80000001u) - (1 << 30);
}

static void check_round(ql_vec3_t v)
{
    const ql_vec3_t d = ql_vec_to_dir(v);
    const point_t a = {v.x, v.y, v.z}, b = {d.x, d.y, d.z};
    const point_t cross = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
            a.x * b.y - a.y * b.x};
    const double angle = asin(fmin(length(cross) / length(a) / length(b), 1));
    const double largest = fmax(fmax(fabs(b.x), fabs(b.y)), fabs(b.z));

    worst_angle = fmax(worst_angle, angle);
    CHECK(largest >= ldexp(1, QL_DIR_BITS - 1) &&
                    largest <= ldexp(1, QL_DIR_BITS),
            "(%ld %ld %ld) became (%ld %ld %ld)", (long)v.x, (long)v.y,
            (long)v.z, (long)d.x, (long)d.y, (long)d.z);
    CHECK(dot(a, b) > 0 && angle <= ldexp(sqrt(3), -QL_DIR_BITS),
            "(%ld %ld %ld) became (%ld %ld %ld), %.3f 2^-b rad off", (long)v.x,
            (long)v.y, (long)v.z, (long)d.x, (long)d.y, (long)d.z,
            ldexp(angle, QL_DIR_BITS));
}

TEST(rounded_directions_have_full_size_and_a_bounded_angle)
{
    static const int32_t ends[] = {-(1l << 30), -(1l << 29) - 1, -(1l << 29),
            -(1l << 29) + 1, -(1l << 20) - 1, -32768, -255, -1, 0, 1, 2, 3, 127,
            32767, 1l << 15, (1l << 22) + 1, 1l << 29, (1l << 29) + 127,
            (1l << 30) - 1, 1l << 30};
    const size_t n = sizeof ends / sizeof ends[0];
    uint64_t state = 31;

    worst_angle = 0;
    for (size_t i = 0; i < n * n * n; i++) {
        const ql_vec3_t v = {ends[i % n], ends[i / n % n], ends[i / n / n]};

        if ((v.x | v.y | v.z) != 0) {
            check_round(v);
        }
    }
    for (long i = 0; i < MANY(2000000); i++) {
        const unsigned shift = (unsigned)stats_random_below(&state, 30);
        ql_vec3_t v;

        v.x = signed30(&state);
        v.y = signed30(&state) / (1 << stats_random_below(&state, 24));
        v.z = signed30(&state);
        v.x /= 1 << shift;
        v.y /= 1 << shift;
        v.z /= 1 << shift;
        if ((v.x | v.y | v.z) != 0) {
            check_round(v);
        }
    }
    NOTE("worst %.3f 2^-b rad", ldexp(worst_angle, QL_DIR_BITS));
}

TEST(a_zero_direction_stays_zero)
{
    const ql_vec3_t zero = {0, 0, 0};
    const ql_vec3_t d = ql_vec_to_dir(zero);

    CHECK((d.x | d.y | d.z) == 0, "%ld %ld %ld", (long)d.x, (long)d.y,
            (long)d.z);
}

/* ---- The triangle ------------------------------------------------------ */

#define BARY_ONE ((uint64_t)1 << QL_BARY_BITS)

/* Undo the map: whether (b1, b2) leads back to the odd numbers (x, y). */
static bool leads_back(uint32_t b1, uint32_t b2, uint32_t x, uint32_t y)
{
    const uint64_t half = ((uint64_t)b1 + b2) / 2;

    return ((b1 ^ b2) & 1u) == 0 &&
           (b2 > b1 ? b1 == x && half == y : half == x && b2 == y);
}

/* In draft this is every point of the map's lattice. */
TEST(triangle_map_is_a_bijection_into_the_triangle)
{
    enum { BITS = (QL_BARY_BITS == 16 ? 14 : 13) - 2 * (MANY(2) < 2) };
    unsigned long wrong = 0;
    uint32_t first1 = 0, first2 = 0;

    for (uint32_t i = 0; i < 1u << BITS; i++) {
        const uint32_t u1 = i << (32 - BITS);

        for (uint32_t j = 0; j < 1u << BITS; j++) {
            const uint32_t u2 = j << (32 - BITS);
            uint32_t b1, b2;

            ql_warp_plane_triangle(u1, u2, &b1, &b2);
            if ((uint64_t)b1 + b2 >= BARY_ONE ||
                    !leads_back(b1, b2, u1 >> (34 - QL_BARY_BITS) << 1 | 1u,
                            u2 >> (34 - QL_BARY_BITS) << 1 | 1u)) {
                first1 = wrong == 0 ? u1 : first1;
                first2 = wrong == 0 ? u2 : first2;
                wrong++;
            }
        }
    }
    CHECK(wrong == 0, "%lu of 4^%d, first u = %08lx, %08lx", wrong, BITS,
            (unsigned long)first1, (unsigned long)first2);
    NOTE("4^%d points", BITS);
}

TEST(triangle_map_keeps_inside_at_the_ends_of_the_square)
{
    static const uint32_t ends[] = {0, 1, 0x3ffffu, 0x7fffffffu, 0x80000000u,
            0xfffc0000u, 0xfffffffcu, 0xfffffffeu, 0xffffffffu};
    const size_t n = sizeof ends / sizeof ends[0];

    for (size_t i = 0; i < n * n; i++) {
        uint32_t b1, b2;

        ql_warp_plane_triangle(ends[i % n], ends[i / n], &b1, &b2);
        CHECK(b1 > 0 && b2 > 0 && (uint64_t)b1 + b2 < BARY_ONE,
                "u = %08lx, %08lx: %08lx, %08lx", (unsigned long)ends[i % n],
                (unsigned long)ends[i / n], (unsigned long)b1,
                (unsigned long)b2);
    }
}

static point_t triangle(uint32_t u1, uint32_t u2)
{
    uint32_t b1, b2;
    point_t p;

    ql_warp_plane_triangle(u1, u2, &b1, &b2);
    p.x = ldexp(b1, -QL_BARY_BITS);
    p.y = ldexp(b2, -QL_BARY_BITS);
    p.z = 1 - p.x - p.y;
    return p;
}

/* Seen in the wild: u = sqrt(r1), v = (1 - u) sqrt(r2). */
static point_t wrong_triangle(uint32_t u1, uint32_t u2)
{
    point_t p;

    p.x = sqrt(ldexp(u1 + 0.5, -32));
    p.y = (1 - p.x) * sqrt(ldexp(u2 + 0.5, -32));
    p.z = 1 - p.x - p.y;
    return p;
}

TEST(triangle_moments_are_those_of_the_uniform_density)
{
    const sums_t s = lattice(triangle, MIDPOINT);

    CHECK(fabs(s.x - 1.0 / 3) < MOMENT_LIMIT &&
                    fabs(s.y - 1.0 / 3) < MOMENT_LIMIT &&
                    fabs(s.z - 1.0 / 3) < MOMENT_LIMIT,
            "means %.6f %.6f %.6f", s.x, s.y, s.z);
    CHECK(fabs(s.xx - 1.0 / 6) < MOMENT_LIMIT &&
                    fabs(s.yy - 1.0 / 6) < MOMENT_LIMIT &&
                    fabs(s.xy - 1.0 / 12) < MOMENT_LIMIT,
            "squares %.6f %.6f, product %.6f", s.xx, s.yy, s.xy);
    NOTE("means %.6f %.6f %.6f", s.x, s.y, s.z);
}

/* Sixteen steps a side cut a triangle into 256 of equal area. */
static double triangle_p(warp_t warp)
{
    static uint32_t counts[256];
    uint64_t state = 41;

    memset(counts, 0, sizeof counts);
    for (long i = 0; i < SAMPLES; i++) {
        const uint64_t bits = stats_random(&state);
        const point_t p = warp((uint32_t)bits, (uint32_t)(bits >> 32));
        const int column = (int)(16 * p.x), row = (int)(16 * p.y);
        const bool upper = 16 * (p.x + p.y) - column - row >= 1;

        /* row r has 16 - r upright and 15 - r other triangles */
        counts[256 - (16 - row) * (16 - row) + 2 * column + upper]++;
    }
    return stats_chi2_p(stats_chi2_equal(counts, 256, SAMPLES / 256.0), 255);
}

TEST(triangle_is_uniform)
{
    const double p = triangle_p(triangle);

    CHECK(p > STATS_P_MIN, "p = %.3g", p);
    NOTE("p = %.2f, 256 bins", p);
}

TEST(a_triangle_of_two_square_roots_is_rejected)
{
    const double p = triangle_p(wrong_triangle);

    CHECK(p <= STATS_P_MIN, "p = %.3g", p);
    CHECK(fabs(lattice(wrong_triangle, MIDPOINT).x - 1.0 / 3) > MOMENT_LIMIT,
            "means %.4f", lattice(wrong_triangle, MIDPOINT).x);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_warp_sphere", argc, argv);
    RUN_IF(TABLES_EXACT, sphere_is_uniform);
    RUN(sphere_of_z_from_0_is_rejected);
    RUN(sphere_points_have_unit_length);
    RUN(sphere_points_are_off_by_no_more_than_the_tables);
    RUN(sphere_without_the_factor_2_is_rejected);
    RUN(sphere_marginals_are_uniform_over_all_16_bit_numbers);
    RUN(sphere_moments_are_those_of_the_uniform_density);
    RUN(left_edges_instead_of_midpoints_are_rejected);
    RUN_IF(TABLES_EXACT, cosine_hemisphere_matches_its_pdf_about_any_normal);
    RUN_IF(TABLES_EXACT, rounded_directions_match_the_pdf_too);
    RUN(uniform_directions_instead_of_cosine_are_rejected);
    RUN(cosine_moments_are_those_of_its_density);
    RUN(cosine_of_left_edges_is_rejected);
    RUN_IF(TABLES_EXACT, directions_below_the_horizon_are_as_rare_as_stated);
    RUN(rounded_directions_have_full_size_and_a_bounded_angle);
    RUN(a_zero_direction_stays_zero);
    RUN(triangle_map_is_a_bijection_into_the_triangle);
    RUN(triangle_map_keeps_inside_at_the_ends_of_the_square);
    RUN(triangle_moments_are_those_of_the_uniform_density);
    RUN(triangle_is_uniform);
    RUN(a_triangle_of_two_square_roots_is_rejected);
    return TEST_END();
}
