/* test_sampler.c - same arguments same numbers, all others unrelated */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <stdlib.h>

#include "support/ql_stats.h"
#include "support/ql_test.h"
#include "sample/ql_sampler.h"

static const uint8_t kinds[] = {
#if QL_CFG_SAMPLERS & 1
        QL_SAMPLER_RANDOM,
#endif
#if QL_CFG_SAMPLERS & 2
        QL_SAMPLER_SOBOL,
#endif
};

static ql_uniform2_t draw(uint8_t kind, uint32_t seed, uint16_t x, uint16_t y,
        uint32_t index, uint32_t dim)
{
    ql_sampler_t sampler;

    ql_sampler_begin(&sampler, kind, seed, x, y);
    ql_sampler_start(&sampler, index);
    return ql_sampler_2d(&sampler, dim);
}

static double unit(uint32_t u)
{
    return ldexp(u + 0.5, -32);
}

TEST(same_arguments_give_the_same_numbers_in_any_order)
{
    enum { COUNT = 64 };
    ql_uniform2_t first[2][COUNT];

    for (unsigned k = 0; k < sizeof kinds; k++) {
        ql_sampler_t sampler;

        ql_sampler_begin(&sampler, kinds[k], 7, 100, 200);
        for (uint32_t i = 0; i < COUNT; i++) {
            ql_sampler_start(&sampler, i / 8);
            first[k][i] = ql_sampler_2d(&sampler, i % 8);
        }
        for (uint32_t i = COUNT; i-- > 0;) {
            const ql_uniform2_t u = draw(kinds[k], 7, 100, 200, i / 8, i % 8);

            CHECK(u.u1 == first[k][i].u1 && u.u2 == first[k][i].u2,
                    "kind %u, number %lu", k, (unsigned long)i);
        }
    }
}

TEST(a_pixel_begins_at_sample_zero)
{
    for (unsigned k = 0; k < sizeof kinds; k++) {
        ql_sampler_t sampler;
        const ql_uniform2_t zero = draw(kinds[k], 3, 4, 5, 0, 6);
        ql_uniform2_t u;

        ql_sampler_begin(&sampler, kinds[k], 3, 4, 5);
        u = ql_sampler_2d(&sampler, 6);
        CHECK(u.u1 == zero.u1 && u.u2 == zero.u2, "kind %u", k);
    }
}

TEST(one_number_is_the_first_of_its_pair)
{
    for (unsigned k = 0; k < sizeof kinds; k++) {
        for (uint32_t i = 0; i < MANY(100000); i++) {
            ql_sampler_t sampler;

            ql_sampler_begin(&sampler, kinds[k], i, 9, 11);
            ql_sampler_start(&sampler, i * 65537u);
            CHECK(ql_sampler_1d(&sampler, i % 200) ==
                            ql_sampler_2d(&sampler, i % 200).u1,
                    "kind %u, seed and index %lu", k, (unsigned long)i);
        }
    }
}

static uint8_t names[QL_DIMS_A_SAMPLE];

static void add_name(uint32_t dim)
{
    CHECK(names[dim % QL_DIMS_A_SAMPLE]++ == 0, "dimension %lu has two names",
            (unsigned long)dim);
}

/* Every name of the camera and of each vertex: one more than there are bounces.
 * Those of samples of emitters come again every QL_DIMS_A_SAMPLE, in as many
 * samples as are drawn, so all have to differ modulo that. */
TEST(names_of_dimensions_never_collide)
{
    add_name(QL_DIM_PIXEL);
    add_name(QL_DIM_LENS);
    for (uint32_t bounce = 0; bounce <= QL_BOUNCES_MAX; bounce++) {
        const uint32_t dim = QL_DIM_BOUNCE(bounce);

        add_name(dim + QL_DIM_LIGHT_POINT);
        add_name(dim + QL_DIM_LIGHT_PICK);
        add_name(dim + QL_DIM_DIRECTION);
        add_name(dim + QL_DIM_CHOICE);
        add_name(dim + QL_DIM_LOOK);
        add_name(dim + QL_DIM_LOOK_CHOICE);
    }
    NOTE("%u vertices, any number of samples of emitters", QL_BOUNCES_MAX + 1);
}

/* ---- Unrelated streams ------------------------------------------------- */

enum { N = 1 << 14 };

static double a[N], b[N];

/* r of independent numbers is normal with variance 1 / N; comparisons are all
 * that the claim makes. */
static void check_uncorrelated(unsigned kind, const char *what, unsigned i,
        double variance, double comparisons)
{
    const double r = stats_correlation(a, b, N);

    CHECK(fabs(r) < stats_z_limit(comparisons) * sqrt(variance / N),
            "kind %u, %s %u: r = %.4f", kind, what, i, r);
}

/* Samples of one pixel: what another pair of dimensions draws says nothing.
 *
 * Two Sobol points i and j whose highest bit that differs is h are scrambled
 * and shuffled to numbers whose correlation is -3/4 8^-h: their low h bits are
 * independent, and if the first l of these agree it is 1 - 7/4 4^-l. For one i
 * there are 2^h such j, and r sums products of two independent streams, so N
 * times its variance is 1 + sum of 2^h (3/4 8^-h)^2, which is 49/31. */
TEST(pairs_of_dimensions_are_uncorrelated)
{
    unsigned count = 0;

    for (unsigned k = 0; k < sizeof kinds; k++) {
        for (uint32_t d = 0; d < 12; d++) {
            for (uint32_t e = 0; e < d; e++) {
                for (unsigned which = 0; which < 2; which++) {
                    for (uint32_t i = 0; i < N; i++) {
                        const ql_uniform2_t u = draw(kinds[k], 1, 2, 3, i, d);
                        const ql_uniform2_t v = draw(kinds[k], 1, 2, 3, i, e);

                        a[i] = unit(u.u1);
                        b[i] = unit(which ? v.u2 : v.u1);
                    }
                    check_uncorrelated(k, "dimensions", 12 * d + e,
                            kinds[k] == QL_SAMPLER_SOBOL ? 49.0 / 31 : 1,
                            2 * 2 * 66);
                    count++;
                }
            }
        }
    }
    NOTE("%u pairs of %d samples", count, N);
}

/* First samples of many pixels: neighbours, in each direction. */
TEST(neighbouring_pixels_are_uncorrelated)
{
    for (unsigned k = 0; k < sizeof kinds; k++) {
        for (unsigned step = 1; step <= 128; step *= 2) {
            for (unsigned axis = 0; axis < 2; axis++) {
                for (uint32_t i = 0; i < N; i++) {
                    const unsigned x = i % 128, y = i / 128;

                    a[i] = unit(
                            draw(kinds[k], 1, (uint16_t)x, (uint16_t)y, 0, 0)
                                    .u1);
                    b[i] = unit(
                            draw(kinds[k], 1, (uint16_t)(x + (axis ? 0 : step)),
                                    (uint16_t)(y + (axis ? step : 0)), 0, 0)
                                    .u1);
                }
                check_uncorrelated(k, "step", step, 1, 2 * 8 * 2);
            }
        }
    }
}

TEST(seeds_that_differ_in_one_bit_are_uncorrelated)
{
    for (unsigned k = 0; k < sizeof kinds; k++) {
        for (unsigned bit = 0; bit < 32; bit++) {
            for (uint32_t i = 0; i < N; i++) {
                const uint16_t x = (uint16_t)(i % 128), y = (uint16_t)(i / 128);

                a[i] = unit(draw(kinds[k], 5, x, y, 3, 2).u2);
                b[i] = unit(
                        draw(kinds[k], 5 ^ (uint32_t)1 << bit, x, y, 3, 2).u2);
            }
            check_uncorrelated(k, "seed bit", bit, 1, 2 * 32);
        }
    }
    NOTE("32 bits, both samplers");
}

static int compare_words(const void *x, const void *y)
{
    const uint64_t p = *(const uint64_t *)x, q = *(const uint64_t *)y;

    return (p > q) - (p < q);
}

/* Equal numbers among the 64-bit pairs of many streams. */
static unsigned long repeats(uint64_t *words, size_t n)
{
    unsigned long count = 0;

    qsort(words, n, sizeof *words, compare_words);
    for (size_t i = 1; i < n; i++) {
        count += words[i] == words[i - 1];
    }
    return count;
}

/* Keys are 32-bit hashes, so of n pixels about n^2 / 2^33 have one
 * in common by chance. */
TEST(distinct_pixels_have_distinct_scrambles)
{
    enum { SIDE = 512 };
    static uint64_t words[SIDE * SIDE];
    const double chance = (double)SIDE * SIDE * SIDE * SIDE / 8589934592.0;

    for (unsigned k = 0; k < sizeof kinds; k++) {
        unsigned long count;

        for (unsigned i = 0; i < SIDE * SIDE; i++) {
            const ql_uniform2_t u = draw(kinds[k], 0, (uint16_t)(i % SIDE),
                    (uint16_t)(i / SIDE), 0, 0);

            words[i] = (uint64_t)u.u1 << 32 | u.u2;
        }
        count = repeats(words, SIDE * SIDE);
        CHECK((double)count <= chance + STATS_Z_MAX * sqrt(chance) + 1,
                "kind %u: %lu of %d pixels repeat, chance %.1f", k, count,
                SIDE * SIDE, chance);
        NOTE("%lu of %d pixels repeat, chance %.0f", count, SIDE * SIDE,
                chance);
    }
}

TEST(pixels_at_the_ends_of_the_picture_are_distinct)
{
    static const uint16_t at[] = {0, 1, 255, 256, 16382, 16383, 65535};
    uint64_t words[49];

    for (unsigned k = 0; k < sizeof kinds; k++) {
        for (unsigned i = 0; i < 49; i++) {
            const ql_uniform2_t u =
                    draw(kinds[k], 0, at[i % 7], at[i / 7], 0, 0);

            words[i] = (uint64_t)u.u1 << 32 | u.u2;
        }
        CHECK(repeats(words, 49) == 0, "kind %u", k);
    }
}

/* ---- Uniform ----------------------------------------------------------- */

TEST(numbers_of_every_kind_are_uniform)
{
    static double values[N];
    double least = 1;

    for (unsigned k = 0; k < sizeof kinds; k++) {
        for (unsigned which = 0; which < 4; which++) {
            double d, p;

            /* over pixels, and over the samples of one */
            for (uint32_t i = 0; i < N; i++) {
                const bool pixels = which < 2;
                const ql_uniform2_t u = draw(kinds[k], 1,
                        (uint16_t)(pixels ? i % 128 : 7),
                        (uint16_t)(pixels ? i / 128 : 7), pixels ? 0 : i, 4);

                values[i] = unit(which % 2 ? u.u2 : u.u1);
            }
            stats_sort(values, N);
            d = stats_ks_uniform(values, N);
            p = stats_ks_p(d, N);
            least = fmin(least, p);
            CHECK(p > STATS_P_MIN, "kind %u, stream %u: D = %.5f, p = %.3g", k,
                    which, d, p);
            if (kinds[k] == QL_SAMPLER_SOBOL && which >= 2) {
                CHECK(d <= 1.0001 / N, "Sobol, %d samples: D = %.3g", N, d);
            }
        }
    }
    NOTE("least p = %.2f", least);
}

#if QL_CFG_SAMPLERS & 2
TEST(sobol_pairs_are_stratified_in_every_dimension)
{
    uint8_t cell[256];

    for (uint32_t dim = 0; dim < 200; dim++) {
        for (unsigned a_bits = 0; a_bits <= 8; a_bits++) {
            memset(cell, 0, sizeof cell);
            for (uint32_t i = 0; i < 256; i++) {
                const ql_uniform2_t u = draw(QL_SAMPLER_SOBOL, 9, 1, 2, i, dim);
                const uint64_t column = (uint64_t)u.u1 >> (32 - a_bits);
                const uint64_t row = (uint64_t)u.u2 >> (24 + a_bits);

                cell[column << (8 - a_bits) | row]++;
            }
            for (unsigned i = 0; i < 256; i++) {
                CHECK(cell[i] == 1, "dimension %lu, %u bits: cell %u has %u",
                        (unsigned long)dim, a_bits, i, cell[i]);
            }
        }
    }
    NOTE("200 dimensions of 256 samples");
}
#endif

/* ---- Far indices ------------------------------------------------------- */

TEST(sample_indices_up_to_2_to_32_repeat_no_numbers)
{
    static const uint32_t starts[] = {
            0, 0x00fffff0u, 0x7ffffff0u, 0x80000000u, 0xfffffff0u};
    uint64_t words[5 * 16];

    for (unsigned k = 0; k < sizeof kinds; k++) {
        for (unsigned i = 0; i < 5 * 16; i++) {
            const ql_uniform2_t u =
                    draw(kinds[k], 1, 2, 3, starts[i / 16] + i % 16, 0);

            words[i] = (uint64_t)u.u1 << 32 | u.u2;
        }
        CHECK(repeats(words, 5 * 16) == 0, "kind %u", k);
    }
}

#if QL_CFG_SAMPLERS & 2
TEST(sobol_samples_beyond_2_to_31_are_still_a_net)
{
    uint8_t cell[1024];

    for (uint64_t start = 0; start <= 0xffffffffu; start += 0x10000000u) {
        memset(cell, 0, sizeof cell);
        for (uint32_t i = 0; i < 1024; i++) {
            const ql_uniform2_t u =
                    draw(QL_SAMPLER_SOBOL, 1, 2, 3, (uint32_t)start + i, 0);

            cell[u.u1 >> 27 << 5 | u.u2 >> 27]++;
        }
        for (unsigned i = 0; i < 1024; i++) {
            CHECK(cell[i] == 1, "from %08lx: cell %u has %u",
                    (unsigned long)start, i, cell[i]);
        }
    }
}
#endif

/* The first numbers of both kinds, pinned: a change changes every picture. */
TEST(numbers_are_the_ones_every_golden_was_made_with)
{
    ql_uniform2_t u;

#if QL_CFG_SAMPLERS & 1
    u = draw(QL_SAMPLER_RANDOM, 1, 2, 3, 4, 5);
    CHECK(u.u1 == 0x9fcde17eu && u.u2 == 0xb4b78061u, "random %08lx %08lx",
            (unsigned long)u.u1, (unsigned long)u.u2);
#endif
#if QL_CFG_SAMPLERS & 2
    u = draw(QL_SAMPLER_SOBOL, 1, 2, 3, 4, 5);
    CHECK(u.u1 == 0x860f7883u && u.u2 == 0x89551db7u, "Sobol %08lx %08lx",
            (unsigned long)u.u1, (unsigned long)u.u2);
#endif
}

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_sampler", argc, argv);
    RUN(same_arguments_give_the_same_numbers_in_any_order);
    RUN(a_pixel_begins_at_sample_zero);
    RUN(one_number_is_the_first_of_its_pair);
    RUN(names_of_dimensions_never_collide);
    RUN(pairs_of_dimensions_are_uncorrelated);
    RUN(neighbouring_pixels_are_uncorrelated);
    RUN(seeds_that_differ_in_one_bit_are_uncorrelated);
    RUN(distinct_pixels_have_distinct_scrambles);
    RUN(pixels_at_the_ends_of_the_picture_are_distinct);
    RUN(numbers_of_every_kind_are_uniform);
#if QL_CFG_SAMPLERS & 2
    RUN(sobol_pairs_are_stratified_in_every_dimension);
#endif
    RUN(sample_indices_up_to_2_to_32_repeat_no_numbers);
#if QL_CFG_SAMPLERS & 2
    RUN(sobol_samples_beyond_2_to_31_are_still_a_net);
#endif
    RUN_AS_SEEDED(numbers_are_the_ones_every_golden_was_made_with);
    return TEST_END();
}
