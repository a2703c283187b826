/* ql_stats.c - incomplete gamma, Kolmogorov-Smirnov, normal quantile */
/* SPDX-License-Identifier: MIT */

#include "support/ql_stats.h"

#include <math.h>
#include <stdlib.h>

#define SERIES_MAX     20000
#define SERIES_EPSILON 1e-15

/* Series for P(a, x), good for x < a + 1. */
static double gamma_p_series(double a, double x)
{
    double term = 1 / a, sum = term;

    for (int i = 1; i < SERIES_MAX && term > sum * SERIES_EPSILON; i++) {
        term *= x / (a + i);
        sum += term;
    }
    return sum * exp(a * log(x) - x - lgamma(a));
}

/* Lentz's continued fraction for Q(a, x), good for x >= a + 1. */
static double gamma_q_fraction(double a, double x)
{
    const double tiny = 1e-300;
    double b = x + 1 - a, c = 1 / tiny, d = 1 / b, h = d;

    for (int i = 1; i < SERIES_MAX; i++) {
        const double an = i * (a - i);
        double change;

        b += 2;
        d = an * d + b;
        d = 1 / (fabs(d) < tiny ? tiny : d);
        c = b + an / c;
        c = fabs(c) < tiny ? tiny : c;
        change = c * d;
        h *= change;
        if (fabs(change - 1) < SERIES_EPSILON) {
            break;
        }
    }
    return h * exp(a * log(x) - x - lgamma(a));
}

double stats_gamma_q(double a, double x)
{
    if (x <= 0) {
        return 1;
    }
    if (isinf(x)) {
        return 0;
    }
    return x < a + 1 ? 1 - gamma_p_series(a, x) : gamma_q_fraction(a, x);
}

double stats_chi2_p(double chi2, double dof)
{
    return dof > 0 ? stats_gamma_q(dof / 2, chi2 / 2) : 1;
}

double stats_chi2_equal(const uint32_t *counts, size_t n, double expected)
{
    double sum = 0;

    for (size_t i = 0; i < n; i++) {
        const double off = counts[i] - expected;

        sum += off * off / expected;
    }
    return sum;
}

double stats_chi2(
        const uint32_t *counts, const double *expected, size_t n, double *dof)
{
    double sum = 0, pool_count = 0, pool_expected = 0;
    double last_count = 0, last_expected = 0;

    *dof = -1;
    for (size_t i = 0; i < n; i++) {
        if (expected[i] <= 0 && counts[i] > 0) {
            return INFINITY;
        }
        pool_count += counts[i];
        pool_expected += expected[i];
        if (pool_expected >= 5) {
            const double off = pool_count - pool_expected;

            sum += off * off / pool_expected;
            *dof += 1;
            last_count = pool_count;
            last_expected = pool_expected;
            pool_count = pool_expected = 0;
        }
    }
    /* What is left over joins the last pool. */
    if (pool_expected > 0 && last_expected > 0) {
        const double before = last_count - last_expected;
        const double off = before + pool_count - pool_expected;

        sum -= before * before / last_expected;
        sum += off * off / (last_expected + pool_expected);
    }
    return sum;
}

double stats_normal_p_two_sided(double z)
{
    return erfc(fabs(z) / sqrt(2));
}

double stats_normal_quantile(double p)
{
    /* Tail by Abramowitz and Stegun 26.2.23 (error 4.5e-4), then Newton. */
    const double tail = p < 0.5 ? p : 1 - p;
    const double t = sqrt(-2 * log(tail));
    double z = t - (2.515517 + t * (0.802853 + t * 0.010328)) /
                           (1 + t * (1.432788 + t * (0.189269 + t * 0.001308)));

    for (int i = 0; i < 6; i++) {
        const double density = exp(-z * z / 2) / sqrt(2 * acos(-1.0));

        z += (erfc(z / sqrt(2)) / 2 - tail) / density;
    }
    return p < 0.5 ? -z : z;
}

double stats_z_limit(double comparisons)
{
    return -stats_normal_quantile(STATS_ALARM / 2 / comparisons);
}

/* Both tails beyond t: cos^(n - 2) of angles from atan(t / root(n - 1)) to a
 * right angle, over that from 0, by Simpson's rule. */
static double t_tails(double t, double replicates)
{
    enum { STEPS = 400 };
    const double dof = replicates - 1, right = acos(0);
    const double from = atan(t / sqrt(dof)), step = (right - from) / STEPS;
    const double whole =
            sqrt(acos(-1)) / 2 * exp(lgamma(dof / 2) - lgamma((dof + 1) / 2));
    double sum = 0;

    for (int i = 0; i < STEPS; i++) { /* the last is 0, but for dof 1 */
        sum += (i == 0         ? 1
                       : i % 2 ? 4
                               : 2) *
               pow(cos(from + i * step), dof - 1);
    }
    sum += dof == 1;
    return sum * step / 3 / whole;
}

double stats_t_limit(double comparisons, double replicates)
{
    double low = 0, high = 1;

    while (t_tails(high, replicates) > STATS_ALARM / comparisons) {
        high *= 2;
    }
    while (high - low > 1e-6 * high) {
        const double middle = (low + high) / 2;

        if (t_tails(middle, replicates) > STATS_ALARM / comparisons) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return high;
}

double stats_mean_limit(
        double comparisons, double n, double mean, double most, double variance)
{
    const double most_variance = fmin(variance, mean * (most - mean));
    const double l = log(2 * comparisons / STATS_ALARM);
    const double range = most * l / (3 * n);

    return range + sqrt(range * range + 2 * most_variance * l / n);
}

double stats_sign_limit(double comparisons)
{
    return sqrt(2 * log(2 * comparisons / STATS_ALARM));
}

double stats_ks_uniform(const double *sorted, size_t n)
{
    double d = 0;

    for (size_t i = 0; i < n; i++) {
        const double above = (double)(i + 1) / (double)n - sorted[i];
        const double below = sorted[i] - (double)i / (double)n;

        d = fmax(d, fmax(above, below));
    }
    return d;
}

double stats_ks_p(double d, size_t n)
{
    const double root = sqrt((double)n);
    const double x = (root + 0.12 + 0.11 / root) * d;
    double sum = 0;

    if (x < 0.2) {
        return 1;
    }
    for (int k = 1; k <= 100; k++) {
        sum += (k % 2 ? 2 : -2) * exp(-2.0 * k * k * x * x);
    }
    return fmin(fmax(sum, 0), 1);
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;

    return (x > y) - (x < y);
}

void stats_sort(double *values, size_t n)
{
    qsort(values, n, sizeof *values, compare);
}

double stats_correlation(const double *a, const double *b, size_t n)
{
    double mean_a = 0, mean_b = 0, aa = 0, bb = 0, ab = 0;

    for (size_t i = 0; i < n; i++) {
        mean_a += a[i] / (double)n;
        mean_b += b[i] / (double)n;
    }
    for (size_t i = 0; i < n; i++) {
        aa += (a[i] - mean_a) * (a[i] - mean_a);
        bb += (b[i] - mean_b) * (b[i] - mean_b);
        ab += (a[i] - mean_a) * (b[i] - mean_b);
    }
    return aa > 0 && bb > 0 ? ab / sqrt(aa * bb) : 0;
}

void stats_add(stats_moments_t *moments, double value)
{
    const double off = value - moments->mean;

    moments->n += 1;
    moments->mean += off / moments->n;
    moments->m2 += off * (value - moments->mean);
}

double stats_variance(const stats_moments_t *moments)
{
    return moments->n > 1 ? moments->m2 / (moments->n - 1) : 0;
}

uint64_t stats_seed;

uint64_t stats_random(uint64_t *state)
{
    uint64_t x = (*state += 0x9e3779b97f4a7c15u) ^ stats_seed;

    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
    x = (x ^ x >> 27) * 0x94d049bb133111ebu;
    return x ^ x >> 31;
}

uint32_t stats_random_below(uint64_t *state, uint64_t n)
{
    return (uint32_t)((stats_random(state) >> 32) * n >> 32);
}

double stats_random_unit(uint64_t *state)
{
    return (double)(stats_random(state) >> 11) / 9007199254740992.0;
}
