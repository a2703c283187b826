/* test_sobol.c - Owen-scrambled Sobol points: vectors, nets, unbiasedness */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <stdlib.h>

#include "support/ql_stats.h"
#include "support/ql_test.h"
#include "sample/ql_sobol.h"

/* Scrambling of a natural-order number: "nested uniform scramble". */
static uint32_t scramble(uint32_t x, uint32_t seed)
{
    return ql_reverse32(ql_owen_reversed(ql_reverse32(x), seed));
}

static uint32_t sobol(uint32_t index, unsigned d)
{
    return ql_reverse32(d == 0 ? index : ql_sobol_1_reversed(index));
}

/* ---- Vectors ----------------------------------------------------------- */

TEST(bits_reverse)
{
    for (unsigned k = 0; k < 32; k++) {
        const uint32_t bit = (uint32_t)1 << k;

        CHECK(ql_reverse32(bit) == (uint32_t)1 << (31 - k), "bit %u", k);
    }
    CHECK(ql_reverse32(0x12345678u) == 0x1e6a2c48u, "%08lx",
            (unsigned long)ql_reverse32(0x12345678u));
    for (uint32_t i = 0; i < MANY(1000000); i++) {
        CHECK(ql_reverse32(ql_reverse32(i * 4099)) == i * 4099, "%lu",
                (unsigned long)i);
    }
}

/* Joe and Kuo's direction numbers give these (new-joe-kuo-6.21201). */
TEST(points_equal_the_published_sequence)
{
    static const uint32_t known[][3] = {{0, 0, 0},
            {1, 0x80000000u, 0x80000000u}, {2, 0x40000000u, 0xc0000000u},
            {3, 0xc0000000u, 0x40000000u}, {4, 0x20000000u, 0xa0000000u},
            {5, 0xa0000000u, 0x20000000u}, {6, 0x60000000u, 0x60000000u},
            {7, 0xe0000000u, 0xe0000000u}, {15, 0xf0000000u, 0x10000000u},
            {255, 0xff000000u, 0x01000000u}, {1023, 0xffc00000u, 0x41400000u},
            {65535, 0xffff0000u, 0x00010000u},
            {0xffffffffu, 0xffffffffu, 0x00000001u}};

    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        CHECK(sobol(known[i][0], 0) == known[i][1] &&
                        sobol(known[i][0], 1) == known[i][2],
                "point %lu is %08lx %08lx", (unsigned long)known[i][0],
                (unsigned long)sobol(known[i][0], 0),
                (unsigned long)sobol(known[i][0], 1));
    }
    NOTE("%u points", (unsigned)(sizeof known / sizeof known[0]));
}

TEST(columns_follow_their_recurrence)
{
    uint32_t column = 0x80000000u;

    for (unsigned k = 0; k < 32; k++) {
        CHECK(sobol((uint32_t)1 << k, 0) == 0x80000000u >> k, "d0, %u", k);
        CHECK(sobol((uint32_t)1 << k, 1) == column, "d1 column %u is %08lx", k,
                (unsigned long)sobol((uint32_t)1 << k, 1));
        column ^= column >> 1;
    }
}

TEST(scrambling_equals_the_published_vectors)
{
    /* x, seed, hash of x, scramble of x (Vegdahl's constants) */
    static const uint32_t known[][4] = {
            {0x00000001u, 0x00000000u, 0x3eaef8ddu, 0x00000001u},
            {0x00000000u, 0x00000001u, 0xbc7f85abu, 0xd5a1fe3du},
            {0x80000000u, 0x00000000u, 0x80000000u, 0xbb1f757cu},
            {0xffffffffu, 0x00000000u, 0x788bc5f3u, 0xcfa3d11eu},
            {0x12345678u, 0x9abcdef0u, 0xfb1d0b68u, 0x1f8b4945u},
            {0xdeadbeefu, 0xcafebabeu, 0x7cd98133u, 0xfb54716eu},
            {0x55555555u, 0xaaaaaaaau, 0xaa6883cdu, 0x1ca15d98u}};

    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        const uint32_t x = known[i][0], seed = known[i][1];

        CHECK(ql_owen_reversed(x, seed) == known[i][2], "hash(%08lx, %08lx)",
                (unsigned long)x, (unsigned long)seed);
        CHECK(scramble(x, seed) == known[i][3], "scramble(%08lx, %08lx)",
                (unsigned long)x, (unsigned long)seed);
    }
    NOTE("%u vectors", (unsigned)(sizeof known / sizeof known[0]));
}

/* ---- Structure --------------------------------------------------------- */

TEST(high_bits_of_a_scramble_depend_on_high_bits_only)
{
    uint64_t state = 1;
    unsigned long count = 0;

    for (unsigned k = 1; k < 32; k++) {
        for (unsigned i = 0; i < MANY(20000); i++) {
            const uint32_t x = (uint32_t)stats_random(&state);
            const uint32_t other = (uint32_t)stats_random(&state) >> k;
            const uint32_t seed = (uint32_t)(stats_random(&state) >> 32);
            const uint32_t a = scramble(x, seed), b = scramble(x ^ other, seed);

            count++;
            CHECK((a ^ b) >> (32 - k) == 0, "top %u bits of %08lx, seed %08lx",
                    k, (unsigned long)x, (unsigned long)seed);
        }
    }
    NOTE("%lu pairs", count);
}

TEST(a_scramble_is_a_bijection_of_every_prefix)
{
    static uint8_t seen[1 << 16];
    uint64_t state = 2;

    for (unsigned k = 1; k <= 16; k++) {
        for (unsigned i = 0; i < 20; i++) {
            const uint32_t seed = (uint32_t)stats_random(&state);

            memset(seen, 0, (size_t)1 << k);
            for (uint32_t x = 0; x < (uint32_t)1 << k; x++) {
                const uint32_t y = scramble(x << (32 - k), seed) >> (32 - k);

                CHECK(!seen[y], "%u bits, seed %08lx: %08lx twice", k,
                        (unsigned long)seed, (unsigned long)y);
                seen[y] = 1;
            }
        }
    }
}

/* The original hash of Laine and Karras, whose seed is only an offset. */
static uint32_t weak_scramble(uint32_t x, uint32_t seed)
{
    x = ql_reverse32(x) + seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return ql_reverse32(x);
}

/* Of 2000 pairs of seeds that differ above bit 15 only, how many scramble the
 * first 16 points' top 16 bits alike. */
static unsigned alike(uint32_t (*scrambler)(uint32_t, uint32_t))
{
    uint64_t state = 3;
    unsigned count = 0;

    for (unsigned i = 0; i < 2000; i++) {
        const uint32_t seed = (uint32_t)stats_random(&state);
        const uint32_t high = (uint32_t)stats_random(&state) << 16;
        uint32_t differ = 0;

        for (uint32_t k = 0; k < 16; k++) {
            differ |=
                    scrambler(k << 28, seed) ^ scrambler(k << 28, seed ^ high);
        }
        count += differ >> 16 == 0;
    }
    return count;
}

TEST(seeds_that_differ_in_high_bits_scramble_differently)
{
    CHECK(alike(scramble) <= 20, "%u of 2000 pairs are alike", alike(scramble));
    NOTE("%u of 2000 pairs alike", alike(scramble));
}

TEST(the_original_hash_is_rejected)
{
    CHECK(alike(weak_scramble) > 20, "%u of 2000", alike(weak_scramble));
    NOTE("%u of 2000 pairs alike", alike(weak_scramble));
}

/* ---- Nets -------------------------------------------------------------- */

typedef struct {
    uint32_t x, y;
} point_t;

/* How qlux makes point i of a pair of dimensions: shuffled and scrambled. */
static point_t point_of(uint32_t i, const uint32_t seed[3], bool wrong)
{
    const uint32_t index =
            ql_reverse32(ql_owen_reversed(ql_reverse32(i), seed[2]));
    const uint32_t second =
            wrong ? index ^ index << 1 : ql_sobol_1_reversed(index);
    point_t p;

    p.x = ql_reverse32(ql_owen_reversed(index, seed[0]));
    p.y = ql_reverse32(ql_owen_reversed(second, seed[1]));
    return p;
}

/* Whether each elementary interval of area 2^-m holds exactly one point; cut
 * bits are dropped from every coordinate first. */
static bool is_net(unsigned m, const uint32_t seed[3], bool wrong, unsigned cut)
{
    static uint8_t cell[1 << 12];
    static point_t points[1 << 12];

    for (uint32_t i = 0; i < (uint32_t)1 << m; i++) {
        points[i] = point_of(i, seed, wrong);
        points[i].x = points[i].x >> cut << cut;
        points[i].y = points[i].y >> cut << cut;
    }
    for (unsigned a = 0; a <= m; a++) {
        memset(cell, 0, (size_t)1 << m);
        for (uint32_t i = 0; i < (uint32_t)1 << m; i++) {
            const uint64_t column = (uint64_t)points[i].x >> (32 - a);
            const uint64_t row = (uint64_t)points[i].y >> (32 - (m - a));

            cell[column << (m - a) | row]++;
        }
        for (uint32_t i = 0; i < (uint32_t)1 << m; i++) {
            if (cell[i] != 1) {
                return false;
            }
        }
    }
    return true;
}

TEST(every_elementary_interval_holds_one_point)
{
    static const unsigned sizes[] = {1, 2, 4, 8, 10, 12};
    uint64_t state = 4;
    unsigned nets = 0;

    for (size_t k = 0; k < sizeof sizes / sizeof sizes[0]; k++) {
        for (unsigned i = 0; i < 100; i++) {
            uint32_t seed[3] = {0, 0, 0};

            for (unsigned j = 0; j < 3 && i > 0; j++) {
                seed[j] = (uint32_t)stats_random(&state);
            }
            nets++;
            CHECK(is_net(sizes[k], seed, false, 0),
                    "2^%u points, seeds %08lx %08lx %08lx", sizes[k],
                    (unsigned long)seed[0], (unsigned long)seed[1],
                    (unsigned long)seed[2]);
            CHECK(is_net(sizes[k], seed, false, 16),
                    "2^%u points of 16 bits, seeds %08lx %08lx %08lx", sizes[k],
                    (unsigned long)seed[0], (unsigned long)seed[1],
                    (unsigned long)seed[2]);
        }
    }
    NOTE("%u nets, also cut to 16 bits", nets);
}

TEST(a_gray_code_as_second_dimension_is_rejected)
{
    const uint32_t seed[3] = {1, 2, 3};

    CHECK(!is_net(8, seed, true, 0), "x ^ (x >> 1) passed as a net");
}

/* ---- Integrals --------------------------------------------------------- */

enum { SEEDS = 400, POINTS = 256 };

static double product(double x, double y)
{
    return x * y;
}

static double quarter_disk(double x, double y)
{
    return x * x + y * y < 1 ? 1 : 0;
}

static double exponential(double x, double y)
{
    return exp(-x - y);
}

typedef struct {
    const char *name;
    double (*f)(double, double);
    double mean, sigma; /* of one point */
    double ratio_max;   /* error against independent points */
} integral_t;

/* sigma of x y: sqrt(1/9 - 1/16); of exp: sqrt(((1 - e^-2)/2)^2 - mean^2) */
static const integral_t integrals[] = {
        {"x y", product, 0.25, 0.220479275922, 0.03},
        {"quarter disk", quarter_disk, 0.785398163397, 0.410545840, 0.45},
        {"exp(-x-y)", exponential, 0.399576400894, 0.165240, 0.03}};

static stats_moments_t estimates(const integral_t *integral, unsigned points)
{
    stats_moments_t moments = {0, 0, 0};
    uint64_t state = 5;

    for (unsigned s = 0; s < SEEDS; s++) {
        uint32_t seed[3];
        double sum = 0;

        for (unsigned j = 0; j < 3; j++) {
            seed[j] = (uint32_t)stats_random(&state);
        }
        for (uint32_t i = 0; i < points; i++) {
            const point_t p = point_of(i, seed, false);

            sum += integral->f(ldexp(p.x + 0.5, -32), ldexp(p.y + 0.5, -32));
        }
        stats_add(&moments, sum / points);
    }
    return moments;
}

TEST(estimates_are_unbiased_for_any_number_of_points)
{
    static const unsigned points[] = {1, 3, 64, 100, 256};
    double worst = 0;

    for (size_t k = 0; k < 3; k++) {
        for (size_t n = 0; n < sizeof points / sizeof points[0]; n++) {
            const stats_moments_t m = estimates(&integrals[k], points[n]);
            const double z = (m.mean - integrals[k].mean) /
                             sqrt(stats_variance(&m) / SEEDS);

            worst = fmax(worst, fabs(z));
            CHECK(fabs(z) < STATS_Z_MAX, "%s of %u points: %.6f, z = %.2f",
                    integrals[k].name, points[n], m.mean, z);
        }
    }
    NOTE("%d seeds, worst z = %.2f", SEEDS, worst);
}

TEST(errors_are_far_below_those_of_independent_points)
{
    double ratio[3];

    for (size_t k = 0; k < 3; k++) {
        const stats_moments_t m = estimates(&integrals[k], POINTS);

        ratio[k] =
                sqrt(stats_variance(&m)) / (integrals[k].sigma / sqrt(POINTS));
        CHECK(ratio[k] < integrals[k].ratio_max, "%s: ratio %.4f",
                integrals[k].name, ratio[k]);
    }
    NOTE("ratios %.4f, %.2f, %.4f", ratio[0], ratio[1], ratio[2]);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_sobol", argc, argv);
    RUN(bits_reverse);
    RUN(points_equal_the_published_sequence);
    RUN(columns_follow_their_recurrence);
    RUN(scrambling_equals_the_published_vectors);
    RUN(high_bits_of_a_scramble_depend_on_high_bits_only);
    RUN(a_scramble_is_a_bijection_of_every_prefix);
    RUN(seeds_that_differ_in_high_bits_scramble_differently);
    RUN(the_original_hash_is_rejected);
    RUN(every_elementary_interval_holds_one_point);
    RUN(a_gray_code_as_second_dimension_is_rejected);
    RUN(estimates_are_unbiased_for_any_number_of_points);
    RUN(errors_are_far_below_those_of_independent_points);
    return TEST_END();
}
