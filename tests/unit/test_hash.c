/* test_hash.c - the hash is a bijection and avalanches */
/* SPDX-License-Identifier: MIT */

#include <math.h>

#include "sample/ql_hash.h"
#include "support/ql_nasty.h"
#include "support/ql_stats.h"
#include "support/ql_test.h"

/* a^-1 modulo 2^32 of an odd a: each step doubles the correct bits from 3. */
static uint32_t inverse(uint32_t a)
{
    uint32_t x = a;

    for (unsigned i = 0; i < 4; i++) {
        x *= 2 - a * x;
    }
    return x;
}

/* The hash run backwards: undo x ^ x >> 16 by itself, x ^ x >> 15 by two. */
static uint32_t unhash(uint32_t x)
{
    x ^= x >> 16;
    x *= inverse(0x846ca68bu);
    x ^= x >> 15 ^ x >> 30;
    x *= inverse(0x7feb352du);
    return x ^ x >> 16;
}

TEST(hash_can_be_undone_so_it_is_a_bijection)
{
    for (uint64_t i = 0; i <= 0xffffffffu; i += STRIDE(257)) {
        const uint32_t x = (uint32_t)i;

        CHECK(unhash(ql_hash32(x)) == x, "%08lx -> %08lx -> %08lx",
                (unsigned long)x, (unsigned long)ql_hash32(x),
                (unsigned long)unhash(ql_hash32(x)));
    }
    for (size_t i = 0; i < NASTY_COUNT; i++) {
        CHECK(unhash(ql_hash32(nasty32[i])) == nasty32[i], "%08lx",
                (unsigned long)nasty32[i]);
    }
    CHECK(ql_hash32(0) == 0, "0 -> %08lx", (unsigned long)ql_hash32(0));
    NOTE("16.7 million inputs");
}

/* A hash without its last step: high bits never reach the low ones. */
static uint32_t unfinished(uint32_t x)
{
    x = (x ^ x >> 16) * 0x7feb352du;
    return x * 0x846ca68bu;
}

enum { AVALANCHE_COUNT = MANY(1 << 18) };

typedef struct {
    double rms; /* bias of a cell, 0 for an ideal hash */
    double worst;
} avalanche_t;

/* How far from 1/2 output bits flip when one input bit does; as a bias in
 * [0, 1]. What sampling itself adds to the square is subtracted. */
static avalanche_t avalanche(uint32_t (*hash)(uint32_t))
{
    avalanche_t result = {0, 0};
    uint64_t state = 1;
    double squares = 0;

    for (unsigned in = 0; in < 32; in++) {
        uint32_t flips[32] = {0};

        for (long i = 0; i < AVALANCHE_COUNT; i++) {
            const uint32_t x = (uint32_t)stats_random(&state);
            const uint32_t d = hash(x) ^ hash(x ^ (uint32_t)1 << in);

            for (unsigned out = 0; out < 32; out++) {
                flips[out] += d >> out & 1u;
            }
        }
        for (unsigned out = 0; out < 32; out++) {
            const double bias = 2.0 * flips[out] / AVALANCHE_COUNT - 1;

            squares += bias * bias / 1024;
            result.worst = fmax(result.worst, fabs(bias));
        }
    }
    result.rms = sqrt(fmax(squares - 1.0 / AVALANCHE_COUNT, 0));
    return result;
}

static uint32_t product_hash(uint32_t x)
{
    return ql_hash32(x);
}

TEST(every_input_bit_flips_every_output_bit_half_the_time)
{
    const avalanche_t a = avalanche(product_hash);

    CHECK(a.rms <= 0.0017, "mean bias %.5f", a.rms);
    CHECK(a.worst <= 6 / sqrt(AVALANCHE_COUNT), "worst bias %.5f", a.worst);
    NOTE("mean bias %.2f %%, worst %.2f %%", 100 * a.rms, 100 * a.worst);
}

TEST(a_hash_without_its_last_step_is_rejected)
{
    const avalanche_t a = avalanche(unfinished);

    CHECK(a.rms > 0.0017 && a.worst > 6 / sqrt(AVALANCHE_COUNT),
            "mean bias %.5f, worst %.5f", a.rms, a.worst);
    NOTE("mean bias %.2f %%", 100 * a.rms);
}

TEST(hashes_of_consecutive_numbers_fill_all_buckets_alike)
{
    uint32_t counts[256];

    for (unsigned shift = 0; shift < 32; shift += 8) {
        double p;

        memset(counts, 0, sizeof counts);
        for (uint32_t i = 0; i < 1u << 18; i++) {
            counts[ql_hash32(i) >> shift & 255u]++;
        }
        p = stats_chi2_p(stats_chi2_equal(counts, 256, 1024), 255);
        CHECK(p > STATS_P_MIN, "byte %u: p = %.3g", shift / 8, p);
        NOTE("p = %.2f", p);
    }
}

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_hash", argc, argv);
    RUN(hash_can_be_undone_so_it_is_a_bijection);
    RUN(every_input_bit_flips_every_output_bit_half_the_time);
    RUN(a_hash_without_its_last_step_is_rejected);
    RUN(hashes_of_consecutive_numbers_fill_all_buckets_alike);
    return TEST_END();
}
