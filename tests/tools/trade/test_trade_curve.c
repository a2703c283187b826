/* test_trade_curve.c - errors of more samples than were rendered */
/* SPDX-License-Identifier: MIT */

#include <math.h>

#include "support/ql_test.h"
#include "trade/scene/trade_curve.h"

/* Noise of 1 / sqrt(N), measured up to 2^(count - 1) samples. */
static trade_curve_t curve_of(unsigned count, double floor)
{
    trade_curve_t c = {.floor = floor, .count = count};

    for (unsigned i = 0; i < count; i++) {
        c.noise[i] = exp2(-0.5 * i);
    }
    trade_curve_extend(&c);
    return c;
}

TEST(noise_goes_on_as_it_did)
{
    for (unsigned count = 1; count <= TRADE_DOTS; count++) {
        const trade_curve_t c = curve_of(count, 0);

        for (unsigned i = 0; i < TRADE_DOTS; i++) {
            const double off = c.noise[i] / exp2(-0.5 * i) - 1;

            CHECK(fabs(off) < 1e-12, "count %u, 2^%u: %g", count, i, off);
        }
    }
}

TEST(what_is_missing_stays)
{
    const trade_curve_t c = curve_of(8, 0.02);
    unsigned i;

    CHECK(fabs(trade_curve_error(&c, 4) - hypot(0.25, 0.02)) < 1e-12, "error");
    CHECK(trade_curve_find(&c, 0.03, &i) && i == 11, "3 %% at 2^%u", i);
    CHECK(!trade_curve_find(&c, 0.01, &i), "1 %% at 2^%u", i);
}

TEST(the_fewest_samples_are_found)
{
    const trade_curve_t c = curve_of(8, 0);
    unsigned i;

    CHECK(trade_curve_find(&c, 1, &i) && i == 0, "100 %% at 2^%u", i);
    CHECK(trade_curve_find(&c, 0.125, &i) && i == 6, "12.5 %% at 2^%u", i);
    CHECK(trade_curve_find(&c, 0.124, &i) && i == 7, "12.4 %% at 2^%u", i);
    CHECK(trade_curve_find(&c, 0.01, &i) && i == 14, "1 %% at 2^%u", i);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("tools/test_trade_curve", argc, argv);
    RUN(noise_goes_on_as_it_did);
    RUN(what_is_missing_stays);
    RUN(the_fewest_samples_are_found);
    return TEST_END();
}
