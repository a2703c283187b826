/* test_clamp.c - what is cut off and what stays are all there was */
/* SPDX-License-Identifier: MIT */

#include <math.h>

#include "film/ql_clamp.h"
#include "support/ql_stats.h"
#include "support/ql_test.h"

#if QL_CFG_CLAMP
static double value_of(ql_real_t a)
{
    return ldexp(a.m, a.e);
}

/* A contribution as paths have them, from faint to what saturates. */
static ql_real_t random_contribution(uint64_t *state, ql_uq31_t value[3])
{
    ql_real_t scale;

    for (unsigned i = 0; i < 3; i++) {
        value[i] =
                (uint32_t)stats_random(state) >> stats_random_below(state, 32);
    }
    scale.m = (uint32_t)stats_random(state) | 0x80000000u;
    scale.e = (int16_t)(-45 + (int)stats_random_below(state, 35));
    return scale;
}

TEST(what_stays_and_what_was_cut_are_what_there_was)
{
    ql_sum_t whole = {{0, 0, 0}}, kept = {{0, 0, 0}};
    ql_diag_t diag = {0};
    uint64_t state = 1, cuts = 0;
    ql_clamp_t clamp;

    ql_clamp_begin(&clamp, 3 << 15, 2); /* 1.5 of Ke */
    for (uint32_t i = 0; i < MANY(100000); i++) {
        const uint64_t before = clamp.cut[0] + clamp.cut[1] + clamp.cut[2];
        ql_uq31_t value[3];
        const ql_real_t scale = random_contribution(&state, value);

        ql_film_add(&whole, value, scale, i, &diag);
        ql_clamp_add(&kept, &clamp, value, scale, i, &diag);
        cuts += clamp.cut[0] + clamp.cut[1] + clamp.cut[2] != before;
    }
    for (unsigned i = 0; i < 3; i++) {
        CHECK(kept.rgb[i] + clamp.cut[i] == whole.rgb[i],
                "channel %u: %llu and %llu are not %llu", i,
                (unsigned long long)kept.rgb[i],
                (unsigned long long)clamp.cut[i],
                (unsigned long long)whole.rgb[i]);
    }
    CHECK(cuts > MANY(10000) && cuts < MANY(90000), "%lu cuts",
            (unsigned long)cuts);
}

/* Units of 2^-3 of Ke: a limit of 1.5 is 12 units. */
TEST(the_brightest_channel_is_at_the_limit_and_the_hue_stays)
{
    ql_diag_t diag = {0};
    uint64_t state = 2;
    ql_clamp_t clamp;

    ql_clamp_begin(&clamp, 3 << 15, -3);
    for (uint32_t i = 0; i < MANY(100000); i++) {
        ql_sum_t sum = {{0, 0, 0}};
        ql_uq31_t value[3];
        const ql_real_t scale = random_contribution(&state, value);
        double exact[3], most = 0;

        for (unsigned k = 0; k < 3; k++) {
            exact[k] = ldexp(value[k], -31) * value_of(scale);
            most = fmax(most, exact[k]);
        }
        ql_clamp_add(&sum, &clamp, value, scale, i, &diag);
        for (unsigned k = 0; k < 3; k++) {
            const double wanted = most > 12 ? exact[k] * (12 / most) : exact[k];
            const double got = ldexp((double)sum.rgb[k], -24);

            CHECK(fabs(got - wanted) < wanted * 1e-8 + 0x1p-24,
                    "%.9g of %.9g, brightest %.9g: %.9g", wanted, exact[k],
                    most, got);
        }
    }
}

TEST(a_limit_of_0_or_none_cuts_nothing)
{
    ql_diag_t diag = {0};
    uint64_t state = 3;
    ql_clamp_t clamp;

    ql_clamp_begin(&clamp, 0, 0);
    for (uint32_t i = 0; i < MANY(10000); i++) {
        ql_sum_t sum[3] = {{{0, 0, 0}}, {{0, 0, 0}}, {{0, 0, 0}}};
        ql_uq31_t value[3];
        const ql_real_t scale = random_contribution(&state, value);

        ql_film_add(sum, value, scale, i, &diag);
        ql_clamp_add(sum + 1, &clamp, value, scale, i, &diag);
        ql_clamp_add(sum + 2, NULL, value, scale, i, &diag);
        CHECK(memcmp(sum, sum + 1, sizeof *sum) == 0 &&
                        memcmp(sum, sum + 2, sizeof *sum) == 0,
                "contribution %lu differs", (unsigned long)i);
    }
    CHECK((clamp.cut[0] | clamp.cut[1] | clamp.cut[2]) == 0, "cut");
}
#else
TEST(without_the_gate_there_is_only_the_film)
{
    static const ql_uq31_t value[3] = {1u << 31, 1u << 30, 0};
    const ql_real_t scale = {0x80000000u, -31};
    ql_diag_t diag = {0};
    ql_sum_t sum = {{0, 0, 0}};

    ql_clamp_add(&sum, NULL, value, scale, 0, &diag);
    CHECK(sum.rgb[0] == 1u << 24 && sum.rgb[1] == 1u << 23, "%llu",
            (unsigned long long)sum.rgb[0]);
}
#endif

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_clamp", argc, argv);
#if QL_CFG_CLAMP
    RUN(what_stays_and_what_was_cut_are_what_there_was);
    RUN(the_brightest_channel_is_at_the_limit_and_the_hue_stays);
    RUN(a_limit_of_0_or_none_cuts_nothing);
#else
    RUN(without_the_gate_there_is_only_the_film);
#endif
    return TEST_END();
}
