/* test_warp_plane.c - disk and tent against their densities; faults fail */
/* SPDX-License-Identifier: MIT */

#include <math.h>

#include "support/ql_double.h"
#include "support/ql_stats.h"
#include "support/ql_table_error.h"
#include "support/ql_test.h"
#include "warp/lecture/ql_warp_lecture.h"
#include "warp/ql_warp_plane.h"

#define RADIUS_ERROR BY_TABLES(QL_CFG_PRECISION == 0 ? 2.1e-5 : 5.1e-8)

enum {
    SAMPLES = MANY(1 << 20),
    ROWS = 16,
    COLUMNS = 32,
    BINS = ROWS * COLUMNS
};

typedef struct {
    double x, y;
} point_t;

typedef point_t (*warp_t)(uint32_t u1, uint32_t u2);

static point_t disk(uint32_t u1, uint32_t u2)
{
    int32_t x, y;
    point_t p;

    ql_warp_plane_disk(u1, u2, &x, &y);
    p.x = ldexp(x, -29);
    p.y = ldexp(y, -29);
    return p;
}

/* 2 u - 1 at the midpoint of 31 bits. */
static double side(uint32_t u)
{
    return ldexp((double)(u | 1u), -31) - 1;
}

static point_t exact_disk(uint32_t u1, uint32_t u2)
{
    const double a = side(u1), b = side(u2);
    const bool by_a = fabs(a) > fabs(b);
    const double angle = by_a ? PI / 4 * b / a : PI / 2 - PI / 4 * a / b;
    const double r = by_a ? a : b;
    const point_t p = {r * cos(angle), r * sin(angle)};

    return p;
}

/* The faults: a radius without its root, the square itself. */
static point_t disk_without_root(uint32_t u1, uint32_t u2)
{
    const double r = ldexp(u1 + 0.5, -32), angle = PI * ldexp(u2 + 0.5, -31);
    const point_t p = {r * cos(angle), r * sin(angle)};

    return p;
}

static point_t square(uint32_t u1, uint32_t u2)
{
    const point_t p = {side(u1), side(u2)};

    return p;
}

static const uint32_t ends[] = {0, 1, 2, 3, 255, 65535, 0x3fffffffu,
        0x40000000u, 0x7ffffffcu, 0x7ffffffeu, 0x7fffffffu, 0x80000000u,
        0x80000001u, 0x80000002u, 0x80000003u, 0xbfffffffu, 0xc0000000u,
        0xffff0000u, 0xfffffffdu, 0xfffffffeu, 0xffffffffu};

enum { ENDS = sizeof ends / sizeof ends[0] };

TEST(disk_is_the_concentric_map)
{
    uint64_t state = 5;
    double worst = 0, radius = 0;

    for (uint32_t i = 0; i < MANY(2000000) + ENDS * ENDS; i++) {
        const bool random = i >= ENDS * ENDS;
        const uint64_t bits = stats_random(&state);
        const uint32_t u1 = random ? (uint32_t)bits : ends[i % ENDS];
        const uint32_t u2 = random ? (uint32_t)(bits >> 32) : ends[i / ENDS];
        const point_t p = disk(u1, u2), e = exact_disk(u1, u2);
        const double r = fmax(fabs(side(u1)), fabs(side(u2)));
        const double off = hypot(p.x - e.x, p.y - e.y);

        worst = fmax(worst, off);
        radius = fmax(radius, fabs(hypot(p.x, p.y) - r));
        CHECK(off <= RADIUS_ERROR * 1.5 && /* angle and radius together */
                        fabs(hypot(p.x, p.y) - r) <= RADIUS_ERROR * r + 0x1p-29,
                "u = %08lx, %08lx: off by %.3g", (unsigned long)u1,
                (unsigned long)u2, off);
    }
    NOTE("worst %.2e, radius %.2e", worst, radius);
}

TEST(disk_centre_is_never_divided_by)
{
    for (uint32_t i = 0; i < 16; i++) {
        const uint32_t u1 = 0x7ffffffeu + i % 4, u2 = 0x7ffffffeu + i / 4;
        const point_t p = disk(u1, u2);

        CHECK(hypot(p.x, p.y) <= 0x1p-28, "u = %08lx, %08lx: %g, %g",
                (unsigned long)u1, (unsigned long)u2, p.x, p.y);
    }
}

/* p-value of equal-probability bins: r^2 and azimuth. What lies outside the
 * disk by more than the stated error counts as an impossible hit. */
static double disk_p(warp_t warp)
{
    static uint32_t counts[BINS];
    uint64_t state = 17;

    memset(counts, 0, sizeof counts);
    for (long i = 0; i < SAMPLES; i++) {
        const uint64_t bits = stats_random(&state);
        const point_t p = warp((uint32_t)bits, (uint32_t)(bits >> 32));
        const double rr = p.x * p.x + p.y * p.y;
        const double turn = atan2(p.y, p.x) / (2 * PI) + 0.5;
        const int row = (int)fmin(rr * ROWS, ROWS - 1);

        if (rr > 1 + 3 * RADIUS_ERROR) {
            return 0;
        }
        counts[row * COLUMNS + (int)(turn * COLUMNS) % COLUMNS]++;
    }
    return stats_chi2_p(
            stats_chi2_equal(counts, BINS, (double)SAMPLES / BINS), BINS - 1);
}

TEST(disk_is_uniform)
{
    const double p = disk_p(disk);

    CHECK(p > STATS_P_MIN, "p = %.3g", p);
    NOTE("p = %.2f, %d bins", p, BINS);
}

TEST(a_disk_without_the_root_is_rejected)
{
    const double p = disk_p(disk_without_root);

    CHECK(p <= STATS_P_MIN, "p = %.3g", p);
}

TEST(the_square_instead_of_the_disk_is_rejected)
{
    CHECK(disk_p(square) <= STATS_P_MIN, "p = %.3g", disk_p(square));
}

/* Means of x, y, x^2, y^2, xy over 256 x 256 numbers of 8 bits. */
static void disk_moments(uint32_t offset, double sums[5])
{
    memset(sums, 0, 5 * sizeof sums[0]);
    for (uint32_t i = 0; i < 65536; i++) {
        const point_t p = disk(i << 24 | offset, (i >> 8) << 24 | offset);

        sums[0] += p.x / 65536;
        sums[1] += p.y / 65536;
        sums[2] += p.x * p.x / 65536;
        sums[3] += p.y * p.y / 65536;
        sums[4] += p.x * p.y / 65536;
    }
}

#define MOMENT_LIMIT 1e-4

TEST(disk_moments_are_those_of_the_uniform_density)
{
    double s[5];

    disk_moments(0x800000u, s);
    CHECK(fabs(s[0]) < MOMENT_LIMIT && fabs(s[1]) < MOMENT_LIMIT &&
                    fabs(s[2] - 0.25) < MOMENT_LIMIT &&
                    fabs(s[3] - 0.25) < MOMENT_LIMIT &&
                    fabs(s[4]) < MOMENT_LIMIT,
            "%.6f %.6f %.6f %.6f %.6f", s[0], s[1], s[2], s[3], s[4]);
    NOTE("mean x %.1e, x^2 %.6f", s[0], s[2]);
}

TEST(disk_of_left_edges_is_rejected)
{
    double s[5];

    disk_moments(0, s);
    CHECK(fabs(s[0]) >= MOMENT_LIMIT, "mean x %.6f", s[0]);
    NOTE("mean x %.1e at 8 bits", s[0]);
}

TEST(disk_density_is_1_over_pi)
{
    CHECK(fabs(ldexp(ql_warp_plane_disk_pdf(), -32) - 1 / PI) <= 0x1p-32,
            "%.12f", ldexp(ql_warp_plane_disk_pdf(), -32));
}

/* ---- The tent ---------------------------------------------------------- */

/* All 256 x 256 midpoints of 8 bits: x = k 2^-8 comes 256 - |k| times. */
TEST(tent_counts_are_exactly_its_density)
{
    static uint32_t counts[511];

    for (uint32_t i = 0; i < 65536; i++) {
        const int32_t x = ql_warp_lecture_tent(
                (i & 255) << 24 | 0x800000u, (i >> 8) << 24 | 0x800000u);

        CHECK(x % (1 << 23) == 0, "%ld", (long)x);
        counts[x / (1 << 23) + 255]++;
    }
    for (int k = -255; k <= 255; k++) {
        const uint32_t pdf = ql_warp_lecture_tent_pdf((int32_t)k * (1 << 23));

        CHECK(counts[k + 255] == (uint32_t)(256 - (k < 0 ? -k : k)),
                "%d: %lu times", k, (unsigned long)counts[k + 255]);
        CHECK(pdf == counts[k + 255] << 23, "%d: density %08lx", k,
                (unsigned long)pdf);
    }
    NOTE("65536 pairs");
}

TEST(tent_keeps_inside_and_exact_at_the_ends)
{
    for (uint32_t i = 0; i < ENDS * ENDS; i++) {
        const uint32_t u1 = ends[i % ENDS], u2 = ends[i / ENDS];
        const int32_t x = ql_warp_lecture_tent(u1, u2);

        CHECK(x > INT32_MIN && x == (int64_t)(u1 / 2) - (int64_t)(u2 / 2),
                "u = %08lx, %08lx: %ld", (unsigned long)u1, (unsigned long)u2,
                (long)x);
    }
}

static double uniform_side(uint32_t u1, uint32_t u2)
{
    (void)u2;
    return side(u1);
}

static double tent(uint32_t u1, uint32_t u2)
{
    return ldexp(ql_warp_lecture_tent(u1, u2), -31);
}

static double tent_p(double (*warp)(uint32_t, uint32_t))
{
    static uint32_t counts[BINS];
    uint64_t state = 23;

    memset(counts, 0, sizeof counts);
    for (long i = 0; i < SAMPLES; i++) {
        const uint64_t bits = stats_random(&state);
        const double x = warp((uint32_t)bits, (uint32_t)(bits >> 32));
        const double below =
                x < 0 ? (1 + x) * (1 + x) / 2 : 1 - (1 - x) * (1 - x) / 2;

        counts[(int)fmin(below * BINS, BINS - 1)]++;
    }
    return stats_chi2_p(
            stats_chi2_equal(counts, BINS, (double)SAMPLES / BINS), BINS - 1);
}

TEST(tent_is_distributed_as_a_tent)
{
    const double p = tent_p(tent);

    CHECK(p > STATS_P_MIN, "p = %.3g", p);
    NOTE("p = %.2f, %d bins", p, BINS);
}

TEST(a_box_instead_of_the_tent_is_rejected)
{
    CHECK(tent_p(uniform_side) <= STATS_P_MIN, "p = %.3g",
            tent_p(uniform_side));
}

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_warp_plane", argc, argv);
    RUN(disk_is_the_concentric_map);
    RUN(disk_centre_is_never_divided_by);
    RUN_IF(TABLES_EXACT, disk_is_uniform);
    RUN(a_disk_without_the_root_is_rejected);
    RUN(the_square_instead_of_the_disk_is_rejected);
    RUN(disk_moments_are_those_of_the_uniform_density);
    RUN(disk_of_left_edges_is_rejected);
    RUN(disk_density_is_1_over_pi);
    RUN(tent_counts_are_exactly_its_density);
    RUN(tent_keeps_inside_and_exact_at_the_ends);
    RUN(tent_is_distributed_as_a_tent);
    RUN(a_box_instead_of_the_tent_is_rejected);
    return TEST_END();
}
