/* extreme_choices.c - lights, tables, seeds: cases 36 to 39 and 45 to 48 */
/* SPDX-License-Identifier: MIT */

#include <math.h>

#include "support/built.h"
#include "support/picture/estimate.h"
#include "support/ql_stats.h"
#include "support/ql_test.h"
#include "sample/lecture/ql_alias.h"
#include "sample/ql_cdf.h"
#include "sample/ql_sampler.h"
#include "sample/ql_sobol.h"
#include "sample/ql_table.h"
#include "lib/math/build_cdf.h"
#include "lib/math/build_table.h"
#include "light/ql_light.h"

static mini_scene_t m;
static uint64_t state;

/* ---- Emitters ---------------------------------------------------------- */

/* Triangles side by side; bit i of lit says whether number i shines. */
static void make_row(unsigned count, unsigned lit, ql_scene_t *scene)
{
    uint16_t dark, light;

    mini_begin(&m);
    dark = mini_material(&m, 0.5, 0);
    light = mini_material(&m, 0, 0.5);
    for (unsigned i = 0; i < count; i++) {
        const int32_t x = 1000 + 900 * (int32_t)i;
        const int32_t a[3] = {x, 1000, 9000}, b[3] = {x + 800, 1000, 9000};
        const int32_t c[3] = {x, 1800, 9000};

        mini_triangle(&m, a, b, c, lit >> i & 1u ? light : dark);
    }
    mini_eye(&m, 1100, 1100, 5000);
    mini_open(&m, scene);
}

static bool shines(const ql_scene_t *scene, uint16_t light)
{
    const ql_blob_tri_t *tri =
            scene->triangles + QL_LE16(scene->lights[light].triangle);

    return ql_scene_material(scene, tri)->emission[0] != 0;
}

/* Whatever number picks, an emitter is picked; and each one by some. */
static void check_row(unsigned count, unsigned lit, unsigned lights)
{
    uint32_t hits[32] = {0};
    ql_scene_t scene;

    make_row(count, lit, &scene);
    CHECK(scene.light_count == lights, "row %x: %u lights", lit,
            scene.light_count);
    for (uint32_t v = 0; lights > 0 && v < 1ul << 17; v++) {
        /* the lowest and the highest of each 2^16 numbers */
        const ql_uq32_t u = v >> 1 << 16 | (v & 1 ? 0xffffu : 0);
        const uint16_t i = ql_light_choose(&scene, QL_LIGHTS_POWER, u);

        CHECK(i < lights && shines(&scene, i), "row %x, u = %lx: light %u", lit,
                (unsigned long)u, i);
        hits[i < 32 ? i : 0]++;
    }
    for (unsigned i = 0; i < lights; i++) {
        CHECK(fabs(hits[i] / 131072.0 - 1.0 / lights) < 0x1p-16,
                "row %x, light %u: %lu of 2^17", lit, i,
                (unsigned long)hits[i]);
    }
}

/* Weights of 1 to 2^31, and 0 next to them, by the compiler's own shares. */
static void check_unequal(void)
{
    static const u128_t weights[2] = {{0, 1}, {0, 0x80000000u}};
    uint32_t cum[2];
    uint64_t shares[2];

    cdf_shares(shares, weights, 2);
    CHECK(shares[0] >= 1 && shares[0] <= 2 &&
                    shares[0] + shares[1] == (uint64_t)1 << 32,
            "shares %llu and %llu", (unsigned long long)shares[0],
            (unsigned long long)shares[1]);
    cum[0] = 0;
    cum[1] = QL_LE32((uint32_t)shares[0]);
    CHECK(ql_cdf_sample(cum, 1, 2, (uint32_t)shares[0] - 1) == 0 &&
                    ql_cdf_sample(cum, 1, 2, (uint32_t)shares[0]) == 1 &&
                    ql_cdf_sample(cum, 1, 2, 0xffffffffu) == 1,
            "the bound is not met");
}

TEST(case_36_lights_of_no_weight_are_never_chosen_and_none_is_black)
{
    const ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 3, 1);

    check_row(7, 0x7e, 6); /* the first is dark */
    check_row(7, 0x77, 6); /* one in the middle */
    check_row(7, 0x3f, 6); /* the last */
    check_row(7, 0x14, 2);
    check_row(7, 0x08, 1);
    check_row(1, 1, 1);
    check_row(7, 0, 0);
    CHECK(estimate_brightest(&m, &s, 64) == 0, "no lights, not black");
    check_unequal();
    NOTE("7 rows, 2^17 numbers each; 1 : 2^31");
}

/* ---- What is left of u ------------------------------------------------- */

static uint16_t row[1024];
static uint32_t hits[65536];

/* A row of cells that begin at these bounds; the last ends at 2^16. */
static void set_row(const uint16_t *bounds, uint16_t used)
{
    row[0] = QL_LE16(used);
    for (uint16_t i = 1; i < used; i++) {
        row[i] = QL_LE16(bounds[i]);
    }
}

/* The 2^16 mass numbers of one cell meet each of the 2^16 places alike. */
static void check_rest(uint16_t cell, uint32_t low, uint32_t end)
{
    unsigned wrong = 0;

    memset(hits, 0, sizeof hits);
    for (uint64_t u = (uint64_t)low << 16; u < (uint64_t)end << 16; u++) {
        uint32_t mass;
        ql_uq32_t rest;

        CHECK(ql_table_pick(row, (uint32_t)u, &rest, &mass) == cell &&
                        mass == end - low,
                "u = %lx", (unsigned long)u);
        hits[rest >> 16]++;
    }
    for (uint32_t i = 0; i < 65536; i++) {
        wrong += hits[i] != end - low;
    }
    CHECK(wrong == 0, "cell %u: %u places", cell, wrong);
}

/* A light's number is another dimension, so nothing is left of it to use. A
 * table uses the same number twice: cells of 1, 2, 3, 58 and the rest. */
TEST(case_37_the_rest_of_a_number_is_uniform_and_each_light_is_chosen)
{
    static const uint16_t bounds[5] = {0, 1, 3, 6, 64};
    ql_scene_t scene;
    unsigned seen = 0;

    set_row(bounds, 5);
    for (uint16_t i = 0; i < 4; i++) {
        check_rest(i, bounds[i], bounds[i + 1]);
    }
    make_row(20, 0xfffff, &scene);
    for (unsigned choice = 0; choice < 3; choice += 2) {
        uint32_t found = 0;

        if (!BUILT_HAS_LIGHTS(choice)) {
            continue;
        }

        for (uint32_t v = 0; v < 65536; v++) {
            const uint16_t i =
                    ql_light_choose(&scene, choice, v << 16 | 0x8000u);

            found |= (uint32_t)1 << i;
        }
        CHECK(found == 0xfffff, "choice %u: %lx", choice, (unsigned long)found);
        seen++;
    }
    NOTE("4194304 numbers in 4 cells; 20 lights by %u choices", seen);
}

/* ---- Alias and prefix sums --------------------------------------------- */

static uint32_t alias_words[3 * 1000];
static uint32_t weights[1000];

/* Places of each entry over the whole bar: n w of n W. */
static void check_alias(uint16_t n, const char *what)
{
    static uint64_t places[1000];
    ql_alias_t alias = {alias_words, 0, n};
    unsigned wrong = 0;

    CHECK(alias_build(alias_words, weights, n, &alias.total) == TABLE_OK,
            "%s: not built", what);
    memset(places, 0, sizeof places);
    for (uint32_t j = 0; j < n; j++) {
        const uint32_t t = QL_LE32(alias_words[3 * j + QL_ALIAS_THRESHOLD]);

        places[j] += t;
        places[QL_LE32(alias_words[3 * j + QL_ALIAS_OTHER]) % n] +=
                alias.total - t;
    }
    for (uint32_t i = 0; i < n; i++) {
        wrong += places[i] != (uint64_t)n * weights[i];
    }
    CHECK(wrong == 0, "%s: %u entries", what, wrong);
}

/* What broke tables of floats: columns that should be full and are a rounding
 * error short of it point at an entry of weight 0. */
TEST(case_38_alias_tables_and_prefix_sums_are_exact)
{
    uint32_t cum[1000];
    uint32_t at = 0;

    for (unsigned i = 0; i < 1000; i++) {
        weights[i] = i % 10 == 0 ? 0 : 4294967u;
    }
    check_alias(1000, "equal weights and zeros");
    for (unsigned i = 0; i < 1000; i++) {
        weights[i] = 4294967u - (i * 7919 % 3);
    }
    check_alias(1000, "nearly equal weights");
    for (unsigned i = 0; i < 32; i++) {
        weights[i] = i == 31 ? 0 : (uint32_t)1 << i;
    }
    check_alias(32, "powers of two and a zero");
    weights[0] = weights[2] = 0;
    weights[1] = 0xffffffffu;
    check_alias(3, "one weight");
    /* prefix sums of 0, 1, 2, .. and the rest: both ends of every entry */
    for (uint32_t i = 0; i < 1000; i++) {
        cum[i] = QL_LE32(at);
        at += i;
    }
    for (uint32_t i = 1; i < 999; i++) {
        const uint32_t low = QL_LE32(cum[i]);

        CHECK(ql_cdf_sample(cum, 1, 1000, low) == i &&
                        ql_cdf_sample(cum, 1, 1000, low + i - 1) == i,
                "entry %lu", (unsigned long)i);
    }
    CHECK(ql_cdf_sample(cum, 1, 1000, 0xffffffffu) == 999, "the last entry");
    NOTE("4 vectors of up to 1000 weights, summed; 1000 bounds");
}

/* ---- Tables ------------------------------------------------------------ */

static uint16_t words[4096];
static double reals[4096];

/* Only cells of weight are drawn; masses sum to 2^32, and the density is mass
 * times cells, exactly where that fits its 32 bits. */
static void check_table(uint16_t nx, uint16_t ny, const char *what)
{
    const uint16_t count[2] = {nx, ny};
    const uint32_t n = table_words(2, count);
    uint64_t sum = 0;
    ql_table_t t;

    CHECK(n <= 4096 && table_build(words, reals, 2, count) == TABLE_OK &&
                    ql_table_open(&t, words, n, 2, count) == QL_OK,
            "%s: not built", what);
    for (uint16_t y = 0; y < ny; y++) {
        for (uint16_t x = 0; x < nx; x++) {
            const uint16_t cell[2] = {x, y};
            const uint64_t mass = ql_table_mass(&t, cell);
            const ql_real_t r = ql_table_density(&t, mass);
            const double exact = ldexp((double)mass, -32) * nx * ny;

            CHECK((mass > 0) == (reals[y * nx + x] > 0), "%s, cell %u %u", what,
                    x, y);
            CHECK(fabs(ldexp(r.m, r.e) - exact) <= exact * 0x1p-29,
                    "%s, cell %u %u: density %.12g, not %.12g", what, x, y,
                    ldexp(r.m, r.e), exact);
            sum += mass;
        }
    }
    CHECK(sum == (uint64_t)1 << 32, "%s: sum %llu", what,
            (unsigned long long)sum);
    for (uint32_t i = 0; i < 65536; i++) {
        const ql_uq32_t u[2] = {(i & 255) * 0x01010101u, /* 0 and max too */
                (i >> 8) * 0x01010101u};
        ql_table_point_t p;

        ql_table_sample(&t, u, &p);
        CHECK(p.mass > 0 && p.cell[0] < nx && p.cell[1] < ny &&
                        reals[p.cell[1] * nx + p.cell[0]] > 0,
                "%s: drew cell %u %u", what, p.cell[0], p.cell[1]);
    }
}

TEST(case_39_tables_with_empty_rows_spikes_and_of_one_row_are_exact)
{
    static const uint16_t one[2] = {1, 1};

    for (unsigned i = 0; i < 64 * 32; i++) {
        reals[i] = i / 64 % 3 == 1 ? 1 + i % 7 : 0; /* two rows of three */
    }
    check_table(64, 32, "empty rows");
    memset(reals, 0, sizeof reals);
    reals[17 * 64 + 63] = 1e-300;
    check_table(64, 32, "a spike");
    memset(reals, 0, sizeof reals);
    reals[0] = reals[99] = 1;
    check_table(100, 1, "one row");
    check_table(1, 100, "one column");
    check_table(10, 10, "two corners");
    reals[0] = 0;
    CHECK(table_build(words, reals, 2, one) == TABLE_ERR_ZERO, "zeros");
    NOTE("5 tables, 2^16 points each, both ends of u among them");
}

/* ---- Seeds ------------------------------------------------------------- */

static const uint8_t kinds[2] = {QL_SAMPLER_RANDOM, QL_SAMPLER_SOBOL};

static ql_uniform2_t number(unsigned kind, uint32_t seed, uint16_t x,
        uint16_t y, uint32_t index, uint32_t dim)
{
    ql_sampler_t sampler;

    ql_sampler_begin(&sampler, kinds[kind], seed, x, y);
    ql_sampler_start(&sampler, index);
    return ql_sampler_2d(&sampler, dim);
}

/* A quarter disk by 64 points: a picture of one pixel. */
static double quarter(unsigned kind, uint32_t seed)
{
    unsigned inside = 0;

    for (uint32_t i = 0; i < 64; i++) {
        const ql_uniform2_t u = number(kind, seed, 0, 0, i, 0);

        inside += hypot(u.u1 * 0x1p-32, u.u2 * 0x1p-32) < 1;
    }
    return inside / 64.0;
}

TEST(case_45_seeds_that_differ_in_high_bits_or_one_bit_are_other_streams)
{
    enum { SEEDS = 2000 };
    double least = 1;

    state = 45;
    for (unsigned kind = 0; kind < 2; kind++) {
        stats_moments_t means = {0, 0, 0};

        /* bit 32 stands for another high half */
        for (unsigned bit = 0; bit <= 32; bit++) {
            unsigned differ = 0, scrambles = 0;

            for (unsigned i = 0; i < SEEDS; i++) {
                const uint32_t seed = (uint32_t)stats_random(&state);
                const uint32_t other = bit < 32
                                               ? seed ^ (uint32_t)1 << bit
                                               : seed ^ (uint32_t)(i + 1) << 16;

                differ += number(kind, seed, 0, 0, 5, 3).u1 >> 16 !=
                          number(kind, other, 0, 0, 5, 3).u1 >> 16;
                scrambles += ql_reverse32(ql_owen_reversed(1, seed)) >> 16 !=
                             ql_reverse32(ql_owen_reversed(1, other)) >> 16;
            }
            least = fmin(least, (double)differ / SEEDS);
            CHECK(differ >= SEEDS * 99 / 100, "bit %u: %u of %d", bit, differ,
                    SEEDS);
            /* the scramble itself, its seed not hashed */
            CHECK(bit < 32 || scrambles >= SEEDS * 99 / 100,
                    "high halves: %u of %d scrambles", scrambles, SEEDS);
        }
        for (uint32_t pixel = 0; pixel < 256; pixel++) {
            stats_add(&means, quarter(kind, pixel << 16));
        }
        CHECK(stats_variance(&means) > 1e-5, "kind %u: every pixel is %.4f",
                kind, means.mean);
        CHECK(fabs(means.mean - 0.78539816) <
                        STATS_Z_MAX * sqrt(stats_variance(&means) / 256),
                "kind %u: pi/4 is %.5f", kind, means.mean);
    }
    NOTE("32 bits and high halves, both kinds: %.1f %% differ at least",
            100 * least);
}

/* Pixels that y width + x, times 2^24 samples, would confuse modulo 2^32. */
TEST(case_46_pixels_and_samples_beyond_2_to_32_repeat_no_stream)
{
    enum { PAIRS = 100000 };
    unsigned same = 0, half = 0;

    state = 46;
    for (unsigned i = 0; i < PAIRS; i++) {
        const unsigned kind = i / 3 & 1;
        const uint16_t x = (uint16_t)stats_random_below(&state, 16384 - 256);
        const uint16_t y = (uint16_t)(1 + stats_random_below(&state, 16382));
        const uint32_t index = stats_random_below(&state, QL_SPP_MAX);
        const ql_uniform2_t a = number(kind, 0, x, y, index, 7);
        /* 2^32 samples on, a row on, and where x + y is the same */
        const uint16_t right[3] = {256, 0, 1}, up[3] = {0, 0, 1};
        const ql_uniform2_t b = number(kind, 0, (uint16_t)(x + right[i % 3]),
                (uint16_t)(y + (i % 3 == 1) - up[i % 3]), index, 7);

        same += a.u1 == b.u1 && a.u2 == b.u2;
        half += a.u1 == b.u1 || a.u2 == b.u2;
    }
    CHECK(same == 0, "%u of %d pairs", same, PAIRS);
    CHECK(half < 5, "one number in %u of %d pairs", half, PAIRS);
    /* the last pixel's last sample is none of the first's */
    for (unsigned kind = 0; kind < 2; kind++) {
        const ql_uniform2_t a =
                number(kind, 0, 16383, 16383, QL_SPP_MAX - 1, 0);
        const ql_uniform2_t b = number(kind, 0, 0, 0, QL_SPP_MAX - 1, 0);

        CHECK(a.u1 != b.u1 && a.u2 != b.u2, "kind %u", kind);
    }
    NOTE("%d pairs of pixels 2^32 samples apart, none alike", PAIRS);
}

/* ---- Sobol ------------------------------------------------------------- */

/* Index, and both coordinates, of the published sequence. */
static const uint32_t published[][3] = {{1, 0x80000000u, 0x80000000u},
        {2, 0x40000000u, 0xc0000000u}, {3, 0xc0000000u, 0x40000000u},
        {4, 0x20000000u, 0xa0000000u}, {5, 0xa0000000u, 0x20000000u},
        {6, 0x60000000u, 0x60000000u}, {7, 0xe0000000u, 0xe0000000u},
        {15, 0xf0000000u, 0x10000000u}, {255, 0xff000000u, 0x01000000u},
        {1023, 0xffc00000u, 0x41400000u}, {65535, 0xffff0000u, 0x00010000u},
        {0xffffffffu, 0xffffffffu, 0x00000001u}};

/* How many standard errors the mean of x y is off, of numbers cut to some
 * bits. */
static double mean_off(uint32_t spp, uint32_t bits)
{
    stats_moments_t mean = {0, 0, 0};

    for (uint32_t seed = 0; seed < 256; seed++) {
        double sum = 0;

        for (uint32_t i = 0; i < spp; i++) {
            const ql_uniform2_t u = number(1, seed, 0, 0, i, 0);

            sum += (u.u1 & bits) * 0x1p-32 * ((u.u2 & bits) * 0x1p-32);
        }
        stats_add(&mean, sum / spp);
    }
    return (mean.mean - 0.25) / sqrt(stats_variance(&mean) / 256);
}

TEST(case_47_sobol_is_right_at_its_last_index_and_unbiased_for_any_count)
{
    static const uint32_t counts[] = {1, 3, 7, 100, 255, 257, 999};
    const unsigned n = sizeof published / sizeof published[0];

    for (unsigned i = 0; i < n; i++) {
        const uint32_t x = ql_reverse32(published[i][0]);
        const uint32_t y = ql_reverse32(ql_sobol_1_reversed(published[i][0]));

        CHECK(x == published[i][1] && y == published[i][2],
                "point %lu: %08lx %08lx", (unsigned long)published[i][0],
                (unsigned long)x, (unsigned long)y);
    }
    for (unsigned i = 0; i < sizeof counts / sizeof counts[0]; i++) {
        const double z = mean_off(counts[i], 0xffffffffu);

        CHECK(fabs(z) < STATS_Z_MAX, "%lu samples: z %.1f",
                (unsigned long)counts[i], z);
    }
    CHECK(mean_off(999, 0xff000000u) < -STATS_Z_MAX,
            "numbers cut to 8 bits are taken for unbiased");
    /* the last 2^8 of 2^32 indices are a net as the first are: each of the
     * 2^8 intervals of either coordinate holds one */
    memset(hits, 0, sizeof hits);
    for (uint32_t i = 0; i < 256; i++) {
        const ql_uniform2_t u = number(1, 9, 3, 4, 0xffffffffu - i, 11);

        hits[u.u1 >> 24]++;
        hits[256 + (u.u2 >> 24)]++;
    }
    for (unsigned i = 0; i < 512; i++) {
        CHECK(hits[i] == 1, "interval %u holds %lu", i, (unsigned long)hits[i]);
    }
    NOTE("%u points, %u counts by 256 seeds, the last 256 indices", n,
            (unsigned)(sizeof counts / sizeof counts[0]));
}

/* Scrambled and shuffled by seeds of their own, pairs are independent; a net
 * makes what is left of a correlation smaller still. */
TEST(case_48_padded_dimensions_are_uncorrelated)
{
    enum { N = 1 << 12 };
    static const uint32_t dims[] = {QL_DIM_PIXEL, QL_DIM_LENS, QL_DIM_BOUNCE(0),
            QL_DIM_BOUNCE(0) + 1, QL_DIM_BOUNCE(0) + 2, QL_DIM_BOUNCE(1) + 1,
            QL_DIM_BOUNCE(63) + 2, QL_DIM_BOUNCE(0) + QL_DIM_CHOICE,
            QL_DIM_BOUNCE(64) + QL_DIM_LOOK,
            QL_DIM_BOUNCE(0) + 255 * QL_DIMS_A_SAMPLE};
    enum { DIMS = sizeof dims / sizeof dims[0] };
    static double value[2 * DIMS][N];
    double worst = 0;

    for (unsigned kind = 0; kind < 2; kind++) {
        for (unsigned d = 0; d < DIMS; d++) {
            for (uint32_t i = 0; i < N; i++) {
                const ql_uniform2_t u = number(kind, 48, 1, 1, i, dims[d]);

                value[2 * d][i] = u.u1;
                value[2 * d + 1][i] = u.u2;
            }
        }
        for (unsigned a = 0; a < 2 * DIMS; a++) {
            for (unsigned b = 0; b < a; b++) {
                const double r = stats_correlation(value[a], value[b], N);

                CHECK(fabs(r) < STATS_Z_MAX / sqrt(N),
                        "kind %u, numbers %u and %u: %.4f", kind, a, b, r);
                worst = fmax(worst, fabs(r));
            }
        }
    }
    NOTE("380 pairs of numbers; worst |r| %.4f of %.4f", worst,
            STATS_Z_MAX / sqrt(N));
}

int main(int argc, char **argv)
{
    TEST_BEGIN("extreme/choices", argc, argv);
    RUN(case_36_lights_of_no_weight_are_never_chosen_and_none_is_black);
    RUN(case_37_the_rest_of_a_number_is_uniform_and_each_light_is_chosen);
    RUN(case_38_alias_tables_and_prefix_sums_are_exact);
    RUN(case_39_tables_with_empty_rows_spikes_and_of_one_row_are_exact);
    RUN(case_45_seeds_that_differ_in_high_bits_or_one_bit_are_other_streams);
    RUN(case_46_pixels_and_samples_beyond_2_to_32_repeat_no_stream);
    RUN(case_47_sobol_is_right_at_its_last_index_and_unbiased_for_any_count);
    RUN(case_48_padded_dimensions_are_uncorrelated);
    return TEST_END();
}
