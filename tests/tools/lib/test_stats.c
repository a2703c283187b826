/* test_stats.c - the limits of statistical claims are those of their laws */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <stdlib.h>

#include "support/ql_stats.h"
#include "support/ql_test.h"

static void check(const char *what, double got, double want)
{
    CHECK(fabs(got / want - 1) < 1e-3, "%s: %.5f, want %.5f", what, got, want);
}

TEST(normal_limits_are_quantiles_of_the_tables)
{
    check("1 comparison", stats_z_limit(1), 4.8916);
    check("1000 comparisons", stats_z_limit(1000), 6.1094);
    CHECK(stats_z_limit(1) < STATS_Z_MAX, "%.4f", stats_z_limit(1));
    CHECK(stats_z_limit(200) < STATS_Z_MANY, "%.4f", stats_z_limit(200));
}

/* 1 and 2 degrees of freedom have closed forms. */
TEST(limits_of_students_t_are_its_quantiles)
{
    check("1 degree", stats_t_limit(1, 2), 1 / tan(acos(-1) * 0.5e-6));
    check("2 degrees", stats_t_limit(1, 3), 1000);
    check("11 degrees", stats_t_limit(1, 12), 9.7014);
    check("63 degrees, 200 comparisons", stats_t_limit(200, 64), 6.7711);
    check("999 degrees", stats_t_limit(1, 1000), 4.9224);
}

/* Of a coin that shows 1 once in a thousand, exactly: the chance that the mean
 * of n is beyond its limit, in millionths; and not for nothing. */
TEST(means_of_rare_values_exceed_their_limit_seldom_enough)
{
    const double p = 0.001, n = 20000;
    const double off = stats_mean_limit(1, n, p, 1, INFINITY);
    double beyond = 0, term = exp(n * log1p(-p));

    for (int k = 0; k < 200; k++) {
        beyond += fabs(k / n - p) > off ? term : 0;
        term *= (n - k) / (k + 1) * p / (1 - p);
    }
    CHECK(beyond < STATS_ALARM && beyond > STATS_ALARM / 1000,
            "limit %.3g, chance %.3g", off, beyond);
    CHECK(off < 7.5 * sqrt(p / n), "limit %.3g", off);
    NOTE("%.1f standard errors, chance %.1g", off / sqrt(p / n), beyond);
}

/* Of n signs, exactly, for the n whose sum comes closest. */
TEST(sums_of_signs_exceed_their_limit_seldom_enough)
{
    double most = 0;

    for (int n = 30; n <= 400; n++) {
        double beyond = 0, term = pow(0.5, n);

        for (int k = 0; k <= n; k++) {
            beyond += abs(2 * k - n) > stats_sign_limit(1) * sqrt(n) ? term : 0;
            term *= (n - k) / (k + 1.0);
        }
        most = fmax(most, beyond);
    }
    CHECK(most < STATS_ALARM && most > STATS_ALARM / 100, "%.3g", most);
    NOTE("chance %.1g", most);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("tools/test_stats", argc, argv);
    RUN(normal_limits_are_quantiles_of_the_tables);
    RUN(limits_of_students_t_are_its_quantiles);
    RUN(means_of_rare_values_exceed_their_limit_seldom_enough);
    RUN(sums_of_signs_exceed_their_limit_seldom_enough);
    return TEST_END();
}
