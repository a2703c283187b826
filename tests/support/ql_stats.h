/* ql_stats.h - p-values and moments for tests (double, host only) */
/* SPDX-License-Identifier: MIT */

/* How often a claim may fail though the program is right, with a seed that
 * nobody chose: once in a million, STATS_ALARM. A claim of one comparison has
 * STATS_P_MIN or STATS_Z_MAX for its limit; one of many divides the chance by
 * their number (Bonferroni's inequality, so they need not be independent). The
 * functions stats_.._limit() do that, each for a law of its own:
 *
 *   stats_z_limit()    normal, the standard deviation known
 *   stats_t_limit()    a mean of few that are normal, and their own spread
 *   stats_mean_limit() anything bounded, however rare its large values are
 *   stats_sign_limit() anything whose signs are a matter of chance
 *
 * A fault that a claim has to reject has to be beyond the limit by as much
 * again, or chance decides whether it is: stats_.._limit() twice. */

#ifndef QL_STATS_H
#define QL_STATS_H

#include <stddef.h>
#include <stdint.h>

#define STATS_ALARM 1e-6

/* For p-values of a suite of up to fifty comparisons. */
#define STATS_P_MIN (STATS_ALARM / 50)

/* stats_z_limit(1), and of any claim of up to 200 means; rounded up. */
#define STATS_Z_MAX  4.9
#define STATS_Z_MANY 5.9

/* |z| of one of so many normal values exceeds this with STATS_ALARM. */
double stats_z_limit(double comparisons);

/* |mean| in standard errors, by the spread of so many normal values of which it
 * is the mean (Student's t); exceeded as above. replicates >= 2. */
double stats_t_limit(double comparisons, double replicates);

/* How far the mean of n independent values in [0, most] may be off what it
 * should be, mean (Bernstein's inequality). Their variance need not be known:
 * it is mean (most - mean) at most; variance may be less, or INFINITY. */
double stats_mean_limit(double comparisons, double n, double mean, double most,
        double variance);

/* |sum| over the root of the sum of squares, of values that are as likely to
 * have the other sign, each for itself (Hoeffding's inequality). */
double stats_sign_limit(double comparisons);

/* Regularised upper incomplete gamma function Q(a, x); a > 0, x >= 0.
 * Relative error below 1e-10 where the result exceeds 1e-300. */
double stats_gamma_q(double a, double x);

/* Probability of a chi-square value at least this large. */
double stats_chi2_p(double chi2, double dof);

/* Sum of (count - expected)^2 / expected over n bins of equal expectation. */
double stats_chi2_equal(const uint32_t *counts, size_t n, double expected);

/* The same over bins of unequal expectation. Neighbours are pooled until their
 * expectation reaches 5; a hit where nothing is expected gives INFINITY.
 * *dof is the number of pools less one. */
double stats_chi2(
        const uint32_t *counts, const double *expected, size_t n, double *dof);

/* Probability of a standard normal at least |z| from 0, both tails. */
double stats_normal_p_two_sided(double z);

/* z with P(normal <= z) = p, for p in (0, 1); error below 1e-12. */
double stats_normal_quantile(double p);

/* Largest distance between the empirical distribution function of n sorted
 * values in [0, 1] and the uniform one. */
double stats_ks_uniform(const double *sorted, size_t n);

/* Probability of a Kolmogorov-Smirnov distance at least d from n values
 * (asymptotic series with Stephens' correction). */
double stats_ks_p(double d, size_t n);

/* Sort ascending. */
void stats_sort(double *values, size_t n);

/* Pearson's correlation of n pairs; 0 if either side is constant. */
double stats_correlation(const double *a, const double *b, size_t n);

/* Mean and variance, one value at a time (Welford). Begin with zeros. */
typedef struct {
    double n;
    double mean;
    double m2; /* sum of squared distances from the mean */
} stats_moments_t;

void stats_add(stats_moments_t *moments, double value);

/* Unbiased variance of what was added; 0 for fewer than two values. */
double stats_variance(const stats_moments_t *moments);

/* 0, or another number that changes everything drawn below, and all samplers:
 * of tests/seeds. */
extern uint64_t stats_seed;

/* RUN() for a claim about the numbers of one seed: with no other. */
#define RUN_AS_SEEDED(claim)                                                   \
    do {                                                                       \
        const uint64_t before = stats_seed;                                    \
                                                                               \
        stats_seed = 0;                                                        \
        RUN(claim);                                                            \
        stats_seed = before;                                                   \
    } while (0)

/* The next 64 random bits (SplitMix64); any state will do to begin. */
uint64_t stats_random(uint64_t *state);

/* The next number of [0, n), for n up to 2^32; bias below 2^-32. */
uint32_t stats_random_below(uint64_t *state, uint64_t n);

/* The next double of [0, 1), 53 bits. */
double stats_random_unit(uint64_t *state);

#endif
