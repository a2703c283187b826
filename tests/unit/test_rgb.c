/* test_rgb.c - colours with one exponent keep their stated bounds */
/* SPDX-License-Identifier: MIT */

#include <math.h>

#include "math/vec/ql_rgb.h"
#include "support/ql_nasty.h"
#include "support/ql_stats.h"
#include "support/ql_test.h"

/* An ulp of 2^-30 of the largest channel is this times it. */
#define ULP 0x1p-30

static double channel(const ql_rgb_t *a, unsigned i)
{
    return ldexp(a->c[i], a->e - 31);
}

static double largest(const ql_rgb_t *a)
{
    return ldexp(ql_rgb_most(a), a->e - 31);
}

static double real(ql_real_t a)
{
    return ldexp(a.m, a.e);
}

/* Channels of any size, some of them nasty, some zero. */
static ql_rgb_t random_rgb(uint64_t *state)
{
    ql_rgb_t a;

    for (unsigned i = 0; i < 3; i++) {
        const uint64_t bits = stats_random(state);

        a.c[i] = (bits >> 60) == 0 ? nasty32[(uint32_t)bits % NASTY_COUNT]
                                   : (uint32_t)bits >> (bits >> 40 & 31u);
    }
    a.e = (int16_t)((int32_t)stats_random_below(state, 200) - 100);
    return a;
}

static ql_real_t random_real(uint64_t *state)
{
    const uint64_t bits = stats_random(state);
    ql_real_t r;

    r.m = (bits >> 60) == 0 ? nasty32[(uint32_t)bits % NASTY_COUNT]
                            : (uint32_t)bits;
    r.m |= 0x80000000u;
    r.e = (int16_t)((int32_t)(bits >> 32 & 255u) - 160);
    return r;
}

/* Products of 32 bits each are exact in 64; a double holds 53, so the error
 * of the check itself is below 2^-52 of the largest. */
TEST(scaling_is_within_half_an_ulp_of_2_to_the_minus_30)
{
    uint64_t state = 1;
    double worst = 0;

    for (long k = 0; k < MANY(1000000); k++) {
        const ql_rgb_t a = random_rgb(&state);
        const ql_real_t by = random_real(&state);
        ql_rgb_t r = a;

        ql_rgb_scale(&r, by);
        for (unsigned i = 0; i < 3; i++) {
            const double exact = channel(&a, i) * real(by);
            const double ulp = ULP * fmax(largest(&a) * real(by), largest(&r));
            const double error = fabs(channel(&r, i) - exact);

            worst = ulp > 0 ? fmax(worst, error / ulp) : worst;
            CHECK(error <= 0.5000001 * ulp,
                    "%08lx 2^%d by %08lx 2^%d: %.17g, not %.17g",
                    (unsigned long)a.c[i], a.e, (unsigned long)by.m, by.e,
                    channel(&r, i), exact);
        }
        CHECK(ql_rgb_most(&r) == 0 || ql_rgb_most(&r) >= 0x40000000u, "%08lx",
                (unsigned long)ql_rgb_most(&r));
    }
    NOTE("worst %.6f ulp", worst);
}

/* A chain of scalings must not drift: the mean error of one is nearly none. */
TEST(scaling_rounds_without_bias)
{
    uint64_t state = 2;
    stats_moments_t error = {0, 0, 0}, cut = {0, 0, 0};

    for (long k = 0; k < MANY(300000); k++) {
        const uint64_t bits = stats_random(&state);
        const ql_real_t by = random_real(&state);
        ql_rgb_t r = {{(uint32_t)bits | 0x80000000u, 0, 0}, 0};
        double exact = ldexp(r.c[0], -31) * real(by), unit;

        ql_rgb_scale(&r, by);
        unit = ldexp(1, r.e - 31);
        stats_add(&error, (channel(&r, 0) - exact) / unit);
        stats_add(&cut, (floor(exact / unit) * unit - exact) / unit);
    }
    CHECK(fabs(error.mean) <
                    STATS_Z_MAX * sqrt(stats_variance(&error) / error.n),
            "mean error %.5f units", error.mean);
    CHECK(fabs(cut.mean) > 0.4, "cutting is not seen: %.5f", cut.mean);
    NOTE("mean %.4f units; cut it would be %.4f", error.mean, cut.mean);
}

TEST(scaling_by_powers_of_two_is_exact_below_2_to_the_31)
{
    uint64_t state = 3;

    for (long k = 0; k < MANY(200000); k++) {
        ql_rgb_t a = random_rgb(&state), r;
        ql_real_t by = {0x80000000u, 0};

        by.e = (int16_t)((int32_t)stats_random_below(&state, 100) - 80);
        for (unsigned i = 0; i < 3; i++) {
            a.c[i] &= 0x7fffffffu;
        }
        r = a;
        ql_rgb_scale(&r, by);
        for (unsigned i = 0; i < 3; i++) {
            CHECK(channel(&r, i) == channel(&a, i) * real(by), "%08lx: %.17g",
                    (unsigned long)a.c[i], channel(&r, i));
        }
    }
}

TEST(scaling_of_and_by_zero_is_zero)
{
    const ql_real_t zero = {0, 0}, large = {0xffffffffu, 1000};
    ql_rgb_t a = {{5, 0xffffffffu, 0}, 100}, b = {{0, 0, 0}, -77};

    ql_rgb_scale(&a, zero);
    ql_rgb_scale(&b, large);
    ql_rgb_scale(&b, large);
    CHECK(ql_rgb_most(&a) == 0 && ql_rgb_most(&b) == 0, "%lu %lu",
            (unsigned long)ql_rgb_most(&a), (unsigned long)ql_rgb_most(&b));
    ql_rgb_mul(&b, &a);
    ql_rgb_add(&b, &a);
    CHECK(ql_rgb_most(&b) == 0, "sum %lu", (unsigned long)ql_rgb_most(&b));
}

TEST(products_are_within_half_an_ulp_of_2_to_the_minus_30)
{
    uint64_t state = 7;
    double worst = 0;

    for (long k = 0; k < MANY(1000000); k++) {
        const ql_rgb_t a = random_rgb(&state), b = random_rgb(&state);
        ql_rgb_t r = a, other = b;

        ql_rgb_mul(&r, &b);
        ql_rgb_mul(&other, &a);
        for (unsigned i = 0; i < 3; i++) {
            const double exact = channel(&a, i) * channel(&b, i);
            const double ulp = ULP * largest(&a) * largest(&b);
            const double error = fabs(channel(&r, i) - exact);

            worst = ulp > 0 ? fmax(worst, error / ulp) : worst;
            CHECK(error <= 0.5000001 * ulp, "%.17g, not %.17g; %.3f ulp",
                    channel(&r, i), exact, error / ulp);
            CHECK(channel(&r, i) == channel(&other, i), "order: %.17g, %.17g",
                    channel(&r, i), channel(&other, i));
        }
    }
    NOTE("worst %.6f ulp", worst);
}

TEST(products_with_gray_powers_of_two_are_exact_below_2_to_the_31)
{
    uint64_t state = 8;

    for (long k = 0; k < MANY(200000); k++) {
        ql_rgb_t a = random_rgb(&state), r;
        const uint32_t c = (uint32_t)1 << (k & 31);
        const ql_rgb_t by = {{c, c, c}, (int16_t)(k % 50 - 25)};

        for (unsigned i = 0; i < 3; i++) {
            a.c[i] &= 0x7fffffffu;
        }
        r = a;
        ql_rgb_mul(&r, &by);
        for (unsigned i = 0; i < 3; i++) {
            CHECK(channel(&r, i) == channel(&a, i) * channel(&by, i),
                    "%08lx: %.17g", (unsigned long)a.c[i], channel(&r, i));
        }
    }
}

/* Of both orders, near and far exponents. */
TEST(sums_are_within_an_ulp_of_2_to_the_minus_30)
{
    uint64_t state = 4;
    double worst = 0;

    for (long k = 0; k < MANY(1000000); k++) {
        const ql_rgb_t a = random_rgb(&state);
        ql_rgb_t b = random_rgb(&state), r = a, other;

        b.e = (int16_t)(k % 3 == 0 ? a.e : k % 3 == 1 ? b.e : a.e + k % 8 - 4);
        other = b;
        ql_rgb_add(&r, &b);
        ql_rgb_add(&other, &a);
        for (unsigned i = 0; i < 3; i++) {
            const double exact = channel(&a, i) + channel(&b, i);
            const double ulp = ULP * fmax(largest(&a), largest(&b));
            const double error = fabs(channel(&r, i) - exact);

            worst = ulp > 0 ? fmax(worst, error / ulp) : worst;
            CHECK(error <= 1.0000001 * ulp, "%.17g, not %.17g; %.3f ulp",
                    channel(&r, i), exact, error / ulp);
            CHECK(channel(&r, i) == channel(&other, i), "order: %.17g, %.17g",
                    channel(&r, i), channel(&other, i));
        }
    }
    NOTE("worst %.6f ulp", worst);
}

TEST(sums_with_zero_are_exact)
{
    uint64_t state = 5;

    for (long k = 0; k < MANY(100000); k++) {
        const ql_rgb_t a = random_rgb(&state);
        ql_rgb_t zero = {{0, 0, 0}, (int16_t)(k % 100)}, r = a;

        ql_rgb_add(&r, &zero);
        ql_rgb_add(&zero, &a);
        for (unsigned i = 0; i < 3; i++) {
            CHECK(channel(&r, i) == channel(&a, i) &&
                            channel(&zero, i) == channel(&a, i),
                    "%.17g, %.17g, not %.17g", channel(&r, i),
                    channel(&zero, i), channel(&a, i));
        }
    }
}

/* The largest sum: both would round up to 2^31. */
TEST(sums_of_the_largest_do_not_wrap)
{
    for (int k = 0; k < 4; k++) {
        ql_rgb_t a = {{0xffffffffu, 0xfffffffeu, 1}, 0};
        const ql_rgb_t b = {
                {0xffffffffu, 0xffffffffu, 0xffffffffu}, (int16_t)(k - 2)};
        const double exact = channel(&a, 0) + channel(&b, 0);

        ql_rgb_add(&a, &b);
        CHECK(fabs(channel(&a, 0) / exact - 1) <= ULP, "%.17g, not %.17g",
                channel(&a, 0), exact);
    }
}

/* What is 2^32 times smaller still rounds up to 1, of one more bit to 0. */
TEST(a_small_summand_is_rounded_to_its_last_bit)
{
    for (int k = 20; k < 40; k++) {
        ql_rgb_t a = {{0x80000000u, 0x80000000u, 0x80000000u}, 0};
        const ql_rgb_t b = {
                {0xffffffffu, 0xffffffffu, 0xffffffffu}, (int16_t)-k};
        const double exact = ldexp(0xffffffffu, -k - 1);

        ql_rgb_add(&a, &b);
        CHECK(a.c[0] - 0x40000000u == floor(exact + 0.5), "2^-%d: %08lx", k,
                (unsigned long)a.c[0]);
    }
}

/* A path of 64 bounces may be multiplied by 2^-4096 each time. Products keep
 * their largest channel in [2^30, 2^31). */
TEST(products_of_ever_smaller_numbers_become_zero)
{
    const ql_real_t small = {0x80000000u, -4127}; /* 2^-4096 */
    ql_rgb_t by_real = {{0x80000000u, 0x40000000u, 1}, 0};
    ql_rgb_t by_rgb = by_real;
    const ql_rgb_t factor = {{0x80000000u, 0x80000000u, 0x80000000u}, -4096};

    ql_rgb_scale(&by_real, small);
    ql_rgb_mul(&by_rgb, &factor);
    CHECK(by_real.e == -4095 && by_rgb.e == -4095, "e = %d and %d", by_real.e,
            by_rgb.e);
    for (int k = 1; k < 64; k++) {
        ql_rgb_scale(&by_real, small);
        ql_rgb_mul(&by_rgb, &factor);
        CHECK(k < 2 || (ql_rgb_most(&by_real) == 0 &&
                               ql_rgb_most(&by_rgb) == 0),
                "2^-4096 to the %d: e = %d and %d", k + 1, by_real.e, by_rgb.e);
    }
}

TEST(filters_round_to_nearest_and_keep_1)
{
    uint64_t state = 6;

    for (long k = 0; k < MANY(300000); k++) {
        const ql_rgb_t a = random_rgb(&state);
        uint32_t by[3], raw[3];
        ql_rgb_t r = a;

        for (unsigned i = 0; i < 3; i++) {
            by[i] = (uint32_t)stats_random(&state) >> (k & 15);
            by[i] = by[i] > QL_UQ31_ONE ? QL_UQ31_ONE : by[i];
            raw[i] = QL_LE32(by[i]);
        }
        ql_rgb_filter(&r, raw);
        for (unsigned i = 0; i < 3; i++) {
            const uint64_t product = (uint64_t)a.c[i] * by[i];

            CHECK(r.c[i] == (product + 0x40000000u) >> 31 && r.e == a.e,
                    "%08lx by %08lx: %08lx", (unsigned long)a.c[i],
                    (unsigned long)by[i], (unsigned long)r.c[i]);
            CHECK(by[i] != QL_UQ31_ONE || r.c[i] == a.c[i], "not kept by 1");
        }
    }
}

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_rgb", argc, argv);
    RUN(scaling_is_within_half_an_ulp_of_2_to_the_minus_30);
    RUN(scaling_rounds_without_bias);
    RUN(scaling_by_powers_of_two_is_exact_below_2_to_the_31);
    RUN(scaling_of_and_by_zero_is_zero);
    RUN(products_are_within_half_an_ulp_of_2_to_the_minus_30);
    RUN(products_with_gray_powers_of_two_are_exact_below_2_to_the_31);
    RUN(sums_are_within_an_ulp_of_2_to_the_minus_30);
    RUN(sums_with_zero_are_exact);
    RUN(sums_of_the_largest_do_not_wrap);
    RUN(a_small_summand_is_rounded_to_its_last_bit);
    RUN(products_of_ever_smaller_numbers_become_zero);
    RUN(filters_round_to_nearest_and_keep_1);
    return TEST_END();
}
