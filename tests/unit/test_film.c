/* test_film.c - sums are exact integers, means round once, nothing wraps */
/* SPDX-License-Identifier: MIT */

#include <math.h>

#include "base/ql_settings.h"
#include "support/picture/film_add.h"
#include "support/ql_stats.h"
#include "support/ql_test.h"

static const ql_real_t one = {0x80000000u, -31};

/* What one contribution must add: value m 2^(e - 31 + 24), half up, cut. */
static uint64_t contribution(ql_uq31_t value, ql_real_t scale)
{
    const uint64_t product = (uint64_t)value * scale.m;
    const int down = 7 - scale.e;

    if (product == 0 || down > 64) {
        return 0;
    }
    if (down <= 0) {
        return down < -39 || product > QL_CONTRIBUTION_MAX >> -down
                       ? QL_CONTRIBUTION_MAX
                       : product << -down;
    } else {
        /* (product + 2^(down - 1)) >> down, without the carry */
        const uint64_t whole = down > 63 ? 0 : product >> down;
        const uint64_t sum = whole + (product >> (down - 1) & 1u);

        return sum > QL_CONTRIBUTION_MAX ? QL_CONTRIBUTION_MAX : sum;
    }
}

static void check_add(ql_uq31_t value, ql_real_t scale)
{
    const uint64_t expected = contribution(value, scale);
    ql_diag_t diag = {0};
    uint64_t sum = 1000;

    film_add(&sum, value, scale, 0, &diag);
    if (expected <= QL_FAINT) { /* of what is rounded by chance: either side */
        CHECK(sum - 1000 + 1 >= expected && sum - 1000 <= expected + 1,
                "%08lx * %08lx 2^%d added %llu, not about %llu",
                (unsigned long)value, (unsigned long)scale.m, scale.e,
                (unsigned long long)(sum - 1000), (unsigned long long)expected);
        return;
    }
    CHECK(sum - 1000 == expected, "%08lx * %08lx 2^%d added %llu, not %llu",
            (unsigned long)value, (unsigned long)scale.m, scale.e,
            (unsigned long long)(sum - 1000), (unsigned long long)expected);
}

static ql_uq31_t random_value(uint64_t *state)
{
    const uint32_t bits = (uint32_t)stats_random(state);

    return bits >> stats_random_below(state, 32);
}

TEST(contributions_are_rounded_half_up)
{
    uint64_t state = 1;

    for (int e = -80; e < -18; e++) {
        for (long i = 0; i < MANY(20000); i++) {
            ql_real_t scale;

            scale.m = (uint32_t)stats_random(&state) | 0x80000000u;
            scale.e = (int16_t)e;
            check_add(random_value(&state), scale);
        }
    }
    NOTE("every scale from 2^-49 to 2^13, from 256 units on");
}

/* Add the same number with many keys: how far the mean is off, in standard
 * errors of a number that is rounded up with the chance of its fraction. */
static double faint_z(double number, ql_uq31_t value, ql_real_t scale)
{
    enum { KEYS = MANY(1 << 16) };
    const double fraction = number - floor(number);
    ql_diag_t diag = {0};
    uint64_t sum = 0;

    for (uint32_t i = 0; i < KEYS; i++) {
        film_add(&sum, value, scale, 0x9e3779b9u * i, &diag);
    }
    CHECK(!QL_CFG_DIAG || diag.faint == KEYS, "%g counted %lu", number,
            (unsigned long)diag.faint);
    return ((double)sum / KEYS - number) * sqrt(KEYS) /
           sqrt(fraction * (1 - fraction) + 0x1p-16);
}

TEST(faint_contributions_keep_their_mean_however_faint_they_are)
{
    uint64_t state = 4;
    double worst = 0;
    unsigned count = 0;

    for (int down = 32; down < 96; down++) {
        for (unsigned i = 0; i < 4; i++) {
            const ql_real_t scale = {
                    (uint32_t)stats_random(&state) | 0x80000001u,
                    (int16_t)(7 - down)};
            /* below QL_FAINT 2^down */
            const uint32_t value = (uint32_t)stats_random(&state) >>
                                           (down < 56 ? 56 - down : 0) |
                                   1u;
            const double number = ldexp((double)value * (double)scale.m, -down);

            worst = fmax(worst, fabs(faint_z(number, value, scale)));
            count++;
        }
    }
    CHECK(worst < STATS_Z_MAX, "worst z %.1f", worst);
    NOTE("%u numbers from 2^-32 to 255 units, worst z %.1f", count, worst);
}

TEST(faint_contributions_that_are_whole_units_are_exact_and_not_counted)
{
    const ql_real_t scale = {0x80000000u, -31 - 16}; /* 2^8 units */
    ql_diag_t diag = {0};

    for (uint32_t n = 0; n < QL_FAINT; n++) {
        uint64_t sum = 0;

        for (uint32_t i = 0; i < 64; i++) {
            film_add(&sum, n << 23, scale, 0x9e3779b9u * i, &diag);
        }
        CHECK(sum == 64 * n, "%lu: %llu", (unsigned long)n,
                (unsigned long long)sum);
    }
    CHECK(diag.faint == 0, "counted %lu", (unsigned long)diag.faint);
}

/* A near emitter has a large scale however dim the surface is. */
TEST(small_values_of_large_scale_are_not_cut_at_the_limit)
{
    uint64_t state = 2;

    for (int e = -18; e < 8; e++) {
        for (long i = 0; i < MANY(20000); i++) {
            ql_real_t scale;

            scale.m = (uint32_t)stats_random(&state) | 0x80000000u;
            scale.e = (int16_t)e;
            check_add(random_value(&state), scale);
        }
    }
    NOTE("every scale from 2^13 to 2^39");
}

TEST(contributions_beyond_the_limit_are_cut_and_counted)
{
    static const int16_t exponents[] = {8, 100, 1000, 32000};

    for (unsigned i = 0; i < 4; i++) {
        const ql_real_t scale = {0xffffffffu, exponents[i]};
        ql_diag_t diag = {0};
        uint64_t sum = 5;

        film_add(&sum, QL_UQ31_ONE, scale, 0, &diag);
        CHECK(sum == 5 + QL_CONTRIBUTION_MAX, "2^%d: %llu", exponents[i],
                (unsigned long long)sum);
        CHECK(!QL_CFG_DIAG || diag.saturated == 1, "2^%d: counted %lu",
                exponents[i], (unsigned long)diag.saturated);
    }
}

TEST(contributions_below_the_limit_are_not_counted)
{
    const ql_real_t scale = {0xffffffffu, -18}; /* below 2^14 */
    ql_diag_t diag = {0};
    uint64_t sum = 0;

    film_add(&sum, QL_UQ31_ONE, scale, 0, &diag);
    CHECK(sum < QL_CONTRIBUTION_MAX && diag.saturated == 0, "%llu, counted %lu",
            (unsigned long long)sum, (unsigned long)diag.saturated);
}

TEST(zero_and_the_smallest_scales_add_nothing)
{
    static const int16_t exponents[] = {-32000, -1000, -100, -57, 0, 40};
    const ql_real_t zero = {0, 0};

    for (unsigned i = 0; i < 6; i++) {
        const ql_real_t scale = {0x80000000u, exponents[i]};

        check_add(0, scale);
        check_add(i < 4 ? QL_UQ31_ONE : 0, scale);
    }
    check_add(0xffffffffu, zero);
}

TEST(a_full_sum_stays_full_and_is_counted)
{
    for (uint64_t left = 0; left < 3; left++) {
        uint64_t sum = UINT64_MAX - left;
        ql_diag_t diag = {0};
        ql_real_t scale = one;

        scale.e = -31 - 22; /* 2^-22: four units */
        film_add(&sum, QL_UQ31_ONE, scale, 0, &diag);
        CHECK(sum == UINT64_MAX, "%llu", (unsigned long long)sum);
        CHECK(!QL_CFG_DIAG || diag.saturated == 1, "counted %lu",
                (unsigned long)diag.saturated);
    }
}

TEST(the_most_samples_of_the_largest_contribution_fit)
{
    const ql_real_t huge = {0xffffffffu, 100};
    ql_diag_t diag = {0};
    uint64_t sum = 0;

    for (unsigned long i = 0; i < QL_SPP_MAX; i++) {
        film_add(&sum, QL_UQ31_ONE, huge, 0, &diag);
    }
    CHECK(sum == QL_CONTRIBUTION_MAX << 24, "%llu", (unsigned long long)sum);
    CHECK(!QL_CFG_DIAG || diag.saturated == QL_SPP_MAX, "counted %lu",
            (unsigned long)diag.saturated);
    NOTE("2^24 samples of 2^15");
}

TEST(sums_do_not_depend_on_the_order)
{
    enum { COUNT = 1000 };
    static ql_uq31_t value[COUNT];
    static ql_real_t scale[COUNT];
    uint64_t state = 3, forward = 0, backward = 0, parts[7] = {0}, merged = 0;
    ql_diag_t diag = {0};

    for (unsigned i = 0; i < COUNT; i++) {
        value[i] = random_value(&state);
        scale[i].m = (uint32_t)stats_random(&state) | 0x80000000u;
        scale[i].e = (int16_t)((int)stats_random_below(&state, 40) - 60);
    }
    for (unsigned i = 0; i < COUNT; i++) {
        const unsigned j = COUNT - 1 - i;

        film_add(&forward, value[i], scale[i], 0, &diag);
        film_add(&backward, value[j], scale[j], 0, &diag);
        film_add(&parts[i % 7], value[i], scale[i], 0, &diag);
    }
    for (unsigned i = 0; i < 7; i++) {
        merged += parts[i];
    }
    CHECK(forward == backward && forward == merged, "%llu, %llu, %llu",
            (unsigned long long)forward, (unsigned long long)backward,
            (unsigned long long)merged);
}

/* A fixed-point mean that is updated freezes; a sum does not. */
TEST(a_sum_of_many_samples_keeps_every_one_of_them)
{
    const ql_real_t quarter = {0x80000000u, -33};
    ql_diag_t diag = {0};
    ql_sum_t sum = {{0, 0, 0}};
    ql_uq16_t linear[3];

    for (unsigned long i = 0; i < 200000; i++) {
        film_add(&sum.rgb[0], QL_UQ31_ONE, quarter, 0, &diag);
    }
    ql_film_display(&sum, 200000, one, linear);
    CHECK(linear[0] == 16384, "mean %lu of 65536", (unsigned long)linear[0]);
}

/* ---- Display ----------------------------------------------------------- */

TEST(constant_radiance_gives_the_constant_for_any_number_of_samples)
{
    static const uint32_t samples[] = {1, 2, 3, 7, 100, 255, 1000, 65535,
            1ul << 16, (1ul << 16) + 1, 9999999, (1ul << 24) - 1, 1ul << 24};
    static const uint32_t constants[] = {0, 1, 2, 255, 11796, 32767, 32768,
            65535, 65536, 65537, 100000, 1 << 20}; /* u16.16 */
    unsigned count = 0;

    for (size_t i = 0; i < sizeof samples / sizeof samples[0]; i++) {
        for (size_t k = 0; k < sizeof constants / sizeof constants[0]; k++) {
            ql_uq16_t linear[3];
            ql_sum_t sum;

            sum.rgb[0] = (uint64_t)constants[k] * samples[i] << 8;
            sum.rgb[1] = sum.rgb[2] = 0;
            ql_film_display(&sum, samples[i], one, linear);
            count++;
            CHECK(linear[0] == constants[k] && linear[1] == 0 && linear[2] == 0,
                    "%lu samples of %lu: %lu", (unsigned long)samples[i],
                    (unsigned long)constants[k], (unsigned long)linear[0]);
        }
    }
    NOTE("%u pairs", count);
}

TEST(no_samples_give_black)
{
    const ql_sum_t sum = {{0, 1, UINT64_MAX}};
    ql_uq16_t linear[3] = {1, 2, 3};

    ql_film_display(&sum, 0, one, linear);
    CHECK(linear[0] == 0 && linear[1] == 0 && linear[2] == 0, "%lu %lu %lu",
            (unsigned long)linear[0], (unsigned long)linear[1],
            (unsigned long)linear[2]);
}

static double display_worst;

TEST(means_are_within_their_bound)
{
    uint64_t state = 4;

    display_worst = 0;
    for (long i = 0; i < MANY(1000000); i++) {
        const uint32_t samples = 1 + stats_random_below(&state, 1ul << 24);
        ql_real_t exposure;
        ql_uq16_t linear[3];
        ql_sum_t sum;
        double exact, bound;

        exposure.m = (uint32_t)stats_random(&state) | 0x80000000u;
        exposure.e = (int16_t)((int)stats_random_below(&state, 40) - 51);
        sum.rgb[0] = stats_random(&state) >> stats_random_below(&state, 64);
        sum.rgb[1] = sum.rgb[2] = 0;
        ql_film_display(&sum, samples, exposure, linear);
        exact = ldexp((double)sum.rgb[0] * exposure.m, exposure.e - 8) /
                samples;
        if (exact >= 4294967040.0) {
            CHECK(linear[0] >= 4294967000.0, "sum %llu / %lu: %lu, not full",
                    (unsigned long long)sum.rgb[0], (unsigned long)samples,
                    (unsigned long)linear[0]);
            continue;
        }
        bound = 0.5 + exact * 0x1p-28 + exact * 0x1p-50;
        display_worst = fmax(display_worst, fabs(linear[0] - exact) / bound);
        CHECK(fabs(linear[0] - exact) <= bound,
                "sum %llu / %lu * %08lx 2^%d: %lu, not %.4f",
                (unsigned long long)sum.rgb[0], (unsigned long)samples,
                (unsigned long)exposure.m, exposure.e, (unsigned long)linear[0],
                exact);
    }
    NOTE("worst %.2f of the bound", display_worst);
}

TEST(means_saturate_and_never_wrap)
{
    static const uint32_t samples[] = {1, 2, 1ul << 24};
    static const int16_t exponents[] = {-30, 0, 33, 300};

    for (unsigned i = 0; i < 12; i++) {
        const ql_sum_t sum = {{UINT64_MAX, UINT64_MAX / 2, (uint64_t)1 << 63}};
        const ql_real_t exposure = {0xffffffffu, exponents[i / 3]};
        ql_uq16_t linear[3];

        ql_film_display(&sum, samples[i % 3], exposure, linear);
        for (unsigned k = 0; k < 3; k++) {
            CHECK(linear[k] == 0xffffffffu, "%lu samples, 2^%d: %08lx",
                    (unsigned long)samples[i % 3], exponents[i / 3],
                    (unsigned long)linear[k]);
        }
    }
}

TEST(exposures_are_powers_of_two)
{
    double worst = 0;

    for (int radiance = -64; radiance <= 64; radiance += 16) {
        for (int32_t q8 = -32768; q8 <= 32767; q8++) {
            const ql_real_t r =
                    ql_film_exposure((int16_t)radiance, (int16_t)q8);
            const double off =
                    ldexp(r.m, r.e - radiance) / exp2(q8 / 256.0) - 1;

            worst = fmax(worst, fabs(off));
            /* seven products cut below 2^-30 each, and the roots */
            CHECK(r.m >= 0x80000000u && fabs(off) <= 0x1p-27,
                    "2^(%d + %ld/256) is off by %.3g", radiance, (long)q8, off);
        }
    }
    NOTE("worst %.1e", worst);
}

TEST(whole_exposures_are_exact)
{
    for (int stops = -128; stops <= 127; stops++) {
        const ql_real_t r = ql_film_exposure(5, (int16_t)(stops * 256));

        CHECK(r.m == 0x80000000u && r.e == 5 + stops - 31, "%d stops", stops);
    }
}

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_film", argc, argv);
    RUN(contributions_are_rounded_half_up);
    RUN(faint_contributions_keep_their_mean_however_faint_they_are);
    RUN(faint_contributions_that_are_whole_units_are_exact_and_not_counted);
    RUN(small_values_of_large_scale_are_not_cut_at_the_limit);
    RUN(contributions_beyond_the_limit_are_cut_and_counted);
    RUN(contributions_below_the_limit_are_not_counted);
    RUN(zero_and_the_smallest_scales_add_nothing);
    RUN(a_full_sum_stays_full_and_is_counted);
    RUN(the_most_samples_of_the_largest_contribution_fit);
    RUN(sums_do_not_depend_on_the_order);
    RUN(a_sum_of_many_samples_keeps_every_one_of_them);
    RUN(constant_radiance_gives_the_constant_for_any_number_of_samples);
    RUN(no_samples_give_black);
    RUN(means_are_within_their_bound);
    RUN(means_saturate_and_never_wrap);
    RUN(exposures_are_powers_of_two);
    RUN(whole_exposures_are_exact);
    return TEST_END();
}
