/* check.c - samples against densities: chi-square, marginals, moments */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/program/cli.h"
#include "sample/ql_cdf.h"
#include "warp/warps.h"

enum {
    BINS_POLAR = 16, /* of the 512, along the first coordinate */
    BINS_OTHER = WARP_TEST_BINS / BINS_POLAR,
    KS_BINS = 1 << 16
};

/* The core states errors of densities far below this; a wrong one is not. */
#define DENSITY_ERROR_MAX 1e-4

/* Regularised upper incomplete gamma function, by its series for small x and
 * by Legendre's continued fraction (evaluated as Lentz does) for large. */
static double gamma_q(double a, double x)
{
    const double front = exp(a * log(x) - x - lgamma(a));

    if (x < a + 1) {
        double term = 1 / a, sum = term;

        for (double n = a + 1; term > sum * 1e-16; n++) {
            term *= x / n;
            sum += term;
        }
        return 1 - front * sum;
    } else {
        double b = x + 1 - a, c = 1e300, d = 1 / b, result = d, step = 0;

        for (int i = 1; i < 10000 && fabs(step - 1) > 1e-15; i++) {
            const double numerator = i * (a - i);

            b += 2;
            d = 1 / (b + numerator * d);
            c = b + numerator / c;
            step = c * d;
            result *= step;
        }
        return front * result;
    }
}

/* Probability of a chi-square value at least this large. */
static double chi2_p(double chi2, double dof)
{
    return chi2 <= 0 ? 1 : gamma_q(dof / 2, chi2 / 2);
}

/* Kolmogorov's: of a distance at least d after n samples. */
static double ks_p(double d, double n)
{
    const double x = d * (sqrt(n) + 0.12 + 0.11 / sqrt(n));
    double sum = 0;

    if (x < 0.2) { /* within 1e-12 of 1, where the series is slow */
        return 1;
    }
    for (int k = 1; k <= 100; k++) {
        sum += (k % 2 != 0 ? 2 : -2) * exp(-2.0 * k * k * x * x);
    }
    return fmin(fmax(sum, 0), 1);
}

/* What is summed up over the samples. */
typedef struct {
    uint32_t bins[WARP_TEST_BINS];
    uint32_t marginal[3][KS_BINS];
    double wanted[9], sum[9], square[9]; /* x y z and their products: exact
                                            means; what is off from them */
} sums_t;

static uint32_t part_of(double c, uint32_t n)
{
    const double at = c * n;

    return at < 0 ? 0 : at >= n ? n - 1 : (uint32_t)at;
}

/* Distributions over cells have those as bins, in one dimension each cut in
 * 16; the others have 512 of equal probability. */
static uint32_t bin_of(
        const warp_t *as, const warp_setup_t *s, const double *x, double *c)
{
    if (as->kind == WARP_ENTRY) {
        return (uint32_t)x[0];
    }
    if (as->kind == WARP_TABLE && as->dims == 1) {
        return part_of(x[0], s->cells.n * BINS_POLAR);
    }
    if (as->kind == WARP_TABLE) {
        const uint16_t *n = s->cells.count;
        const uint32_t z = as->dims == 3 ? part_of(x[2], n[2]) : 0;

        return (z * n[1] + part_of(x[1], n[1])) * n[0] + part_of(x[0], n[0]);
    }
    return part_of(c[0], BINS_POLAR) * BINS_OTHER + part_of(c[1], BINS_OTHER);
}

static uint32_t bin_count(const warp_t *as, const warp_setup_t *s)
{
    return as->kind == WARP_ENTRY                    ? s->cells.n
           : as->kind == WARP_TABLE && as->dims == 1 ? s->cells.n * BINS_POLAR
           : as->kind == WARP_TABLE                  ? s->cells.n
                                                     : WARP_TEST_BINS;
}

static double bin_mass(const warp_t *as, const warp_setup_t *s, uint32_t bin)
{
    return as->kind == WARP_ENTRY ? s->cells.mass[bin]
           : as->kind == WARP_TABLE && as->dims == 1
                   ? s->cells.mass[bin / BINS_POLAR] / BINS_POLAR
           : as->kind == WARP_TABLE ? s->cells.mass[bin]
                                    : 1.0 / WARP_TEST_BINS;
}

/* Uniform numbers that a point of this density would come from. */
static unsigned marginals(const warp_t *as)
{
    return as->kind == WARP_ENTRY ? 1 : as->kind == WARP_TABLE ? as->dims : 2;
}

static void add(sums_t *sums, const double *x)
{
    const double values[9] = {x[0], x[1], x[2], x[0] * x[0], x[1] * x[1],
            x[2] * x[2], x[0] * x[1], x[0] * x[2], x[1] * x[2]};

    for (int k = 0; k < 9; k++) {
        const double off = values[k] - sums->wanted[k];

        sums->sum[k] += off;
        sums->square[k] += off * off;
    }
}

/* Another for each warp, so that their errors are not the same. */
static uint32_t seed_of(const warp_t *warp)
{
    unsigned i = 0;

    while (warp_at(i) != warp) {
        i++;
    }
    return i + 1;
}

static void collect(const warp_t *warp, const warp_setup_t *s, const warp_t *as,
        sums_t *sums, warp_fit_t *fit)
{
    const uint32_t seed = seed_of(warp);

    for (uint32_t i = 0; i < WARP_TEST_SAMPLES; i++) {
        uint32_t u[WARP_NUMBERS];
        warp_point_t p = {{0, 0, 0}, 0, false};
        double c[3] = {0, 0, 0}, exact;

        warp_numbers(QL_SAMPLER_RANDOM, seed, i, u);
        warp_draw(warp, s, u, &p);
        if (!p.inside || p.density <= 0) {
            fit->outside++;
            continue;
        }
        warp_invert(as, s, p.x, c);
        sums->bins[bin_of(as, s, p.x, c)]++;
        for (unsigned d = 0; d < marginals(as); d++) {
            sums->marginal[d][part_of(c[d], KS_BINS)]++;
        }
        add(sums, p.x);
        exact = warp_density(warp, s, p.x);
        fit->density_error = fmax(fit->density_error,
                fabs(p.density - exact) / fmax(exact, warp->density_floor));
    }
}

static void fit_bins(const warp_t *as, const warp_setup_t *s,
        const sums_t *sums, warp_fit_t *fit)
{
    const uint32_t n = bin_count(as, s);

    fit->dof = -1;
    for (uint32_t i = 0; i < n; i++) {
        const double expected = WARP_TEST_SAMPLES * bin_mass(as, s, i);
        const double off = sums->bins[i] - expected;

        if (expected > 0) {
            fit->chi2 += off * off / expected;
            fit->dof++;
        } else {
            fit->outside += sums->bins[i];
        }
    }
    fit->chi2_p = chi2_p(fit->chi2, fit->dof);
}

/* Largest distance of a marginal's distribution function from the diagonal; of
 * entries, from their steps, whose middles invert() returns. */
static void fit_marginals(const warp_t *as, const warp_setup_t *s,
        const sums_t *sums, warp_fit_t *fit)
{
    for (unsigned d = 0; d < marginals(as); d++) {
        double below = 0, exact = 0;

        if (as->kind == WARP_ENTRY) {
            for (uint32_t i = 0; i < s->cells.n; i++) {
                below += (double)sums->bins[i] / WARP_TEST_SAMPLES;
                exact += s->cells.mass[i];
                fit->ks = fmax(fit->ks, fabs(below - exact));
            }
            continue;
        }
        for (uint32_t i = 0; i < KS_BINS; i++) {
            below += (double)sums->marginal[d][i] / WARP_TEST_SAMPLES;
            exact = (i + 1.0) / KS_BINS;
            fit->ks = fmax(fit->ks, fabs(below - exact));
        }
    }
    fit->ks_p = ks_p(fit->ks, WARP_TEST_SAMPLES);
}

static void fit_moments(const sums_t *sums, warp_fit_t *fit)
{
    const double n = WARP_TEST_SAMPLES - fit->outside;

    for (int k = 0; k < 9; k++) {
        const double off = sums->sum[k] / n, error = fabs(off);
        const double variance = sums->square[k] / n - off * off;

        if (k < 3) {
            fit->mean_error = fmax(fit->mean_error, error);
        } else {
            fit->second_error = fmax(fit->second_error, error);
        }
        if (variance > 0) {
            fit->z = fmax(fit->z, error / sqrt(variance / n));
        } else if (error > 0) { /* what never varies must be right */
            fit->z = HUGE_VAL;
        }
    }
}

/* The cell that numbers choose, along axis d. */
static uint32_t choice(const warp_t *warp, const warp_setup_t *s,
        const uint32_t *u, unsigned d)
{
    ql_table_point_t point;

    if (warp->kind == WARP_ENTRY) {
        return ql_cdf_sample(s->cells.bounds, 1, s->cells.used, u[0]);
    }
    ql_table_sample(&s->cells.table, u, &point);
    return point.cell[d];
}

/* How many of the 2^32 values of u[d] are below those that choose cell k or a
 * later one: by bisection, since a larger u never chooses an earlier one. */
static uint64_t count_below(const warp_t *warp, const warp_setup_t *s,
        uint32_t *u, unsigned d, uint32_t k)
{
    uint64_t low = 0, high = (uint64_t)1 << 32;

    while (low < high) {
        const uint64_t middle = (low + high) / 2;

        u[d] = (uint32_t)middle;
        if (choice(warp, s, u, d) >= k) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low;
}

/* Compare what each cell along axis d gets with its mass; below it the other
 * axes. share is that of the row, u a value that chooses it. */
static void count_row(const warp_t *warp, const warp_setup_t *s, uint32_t *u,
        unsigned d, uint32_t first, double share, warp_fit_t *fit)
{
    const uint16_t *n = s->cells.count;
    const uint32_t size = d == 0 ? 1 : d == 1 ? n[0] : (uint32_t)n[0] * n[1];
    uint64_t before = 0;

    for (uint32_t k = 0; k < n[d]; k++) {
        const uint64_t end = count_below(warp, s, u, d, k + 1);
        const double own = share * ldexp((double)(end - before), -32);
        const uint32_t cell = first + k * size;

        u[d] = (uint32_t)before;
        if (d > 0 && end > before) {
            count_row(warp, s, u, d - 1, cell, own, fit);
        } else {
            for (uint32_t i = 0; i < size; i++) {
                fit->cells++;
                fit->inexact += s->cells.mass[cell + i] != own;
            }
        }
        before = end;
    }
}

/* The n W places of an alias table, by the look-up of the core. */
static void count_places(const warp_setup_t *s, warp_fit_t *fit)
{
    static uint64_t places[WARP_CELLS_MAX];
    const ql_alias_t *alias = &s->cells.alias;

    memset(places, 0, sizeof places);
    for (uint16_t j = 0; j < alias->count; j++) {
        uint32_t low = 0, high = alias->total - 1;

        /* the last height is above the threshold unless the column is whole,
         * and then its alias is the entry itself */
        while (low < high) {
            const uint32_t middle = low + (high - low) / 2;

            if (ql_alias_at(alias, j, middle) != j) {
                high = middle;
            } else {
                low = middle + 1;
            }
        }
        places[j] += low;
        places[ql_alias_at(alias, j, alias->total - 1)] += alias->total - low;
    }
    for (uint16_t i = 0; i < alias->count; i++) {
        fit->cells++;
        fit->inexact +=
                places[i] != (uint64_t)alias->count * s->cells.shares[i];
    }
}

static void count_exactly(
        const warp_t *warp, const warp_setup_t *s, warp_fit_t *fit)
{
    uint32_t u[WARP_NUMBERS] = {0};

    if (warp->kind == WARP_ENTRY && s->cells.alias.count > 0) {
        count_places(s, fit);
    } else if (warp->kind == WARP_ENTRY || warp->kind == WARP_TABLE) {
        count_row(warp, s, u, warp->dims - 1, 0, 1, fit);
    }
}

void warp_measure(const warp_t *warp, const warp_setup_t *s, const warp_t *as,
        warp_fit_t *fit)
{
    sums_t *sums = cli_alloc(1, sizeof *sums);
    warp_moments_t exact;

    memset(fit, 0, sizeof *fit);
    warp_moments(as, s, &exact);
    memcpy(sums->wanted, exact.mean, sizeof exact.mean);
    memcpy(sums->wanted + 3, exact.second, sizeof exact.second);
    collect(warp, s, as, sums, fit);
    fit_bins(as, s, sums, fit);
    fit_marginals(as, s, sums, fit);
    fit_moments(sums, fit);
    count_exactly(warp, s, fit);
    free(sums);
}

static bool fits(const warp_fit_t *f)
{
    return f->chi2_p >= WARP_P_MIN && f->ks_p >= WARP_P_MIN &&
           f->z <= WARP_Z_MAX && f->outside == 0 && f->inexact == 0 &&
           f->density_error <= DENSITY_ERROR_MAX;
}

static void write_p(double p, char *text, size_t size)
{
    snprintf(text, size, p > 0 ? "%.2g" : "<1e-300", p);
}

static void print_head(void)
{
    printf("%d random samples each; 512 bins of equal probability, or the "
           "cells.\n\n"
           "  chi2, dof, p  chi-square\n"
           "  KS, p         largest distance of a marginal's distribution "
           "function\n"
           "  mean, 2nd     largest error of the mean of x, y, z, and of "
           "their products\n"
           "  z             the largest of these in standard deviations\n"
           "  pdf           largest relative error of the core's density\n"
           "  zero          samples where the density is 0\n"
           "  exact         cells whose share of all numbers, counted, is "
           "their mass\n\n"
           "Fails: p below %.0e, z above %.1f, pdf above %.0e, zero above 0, "
           "a cell not exact.\n\n",
            WARP_TEST_SAMPLES, WARP_P_MIN, WARP_Z_MAX, DENSITY_ERROR_MAX);
    printf("%-18s %-13s %8s %4s %7s %8s %7s %7s %7s %4s %7s %4s %7s  %s\n",
            "warp", "", "chi2", "dof", "p", "KS", "p", "mean", "2nd", "z",
            "pdf", "zero", "exact", "verdict");
}

static void print_row(const warp_t *warp, const char *label,
        const warp_fit_t *f, const char *verdict)
{
    char exact[24] = "-", density[24], chi2_p[24], ks_p[24];

    if (f->cells > 0) {
        snprintf(exact, sizeof exact, "%lu/%lu",
                (unsigned long)(f->cells - f->inexact),
                (unsigned long)f->cells);
    }
    snprintf(density, sizeof density, "%.1e", f->density_error);
    write_p(f->chi2_p, chi2_p, sizeof chi2_p);
    write_p(f->ks_p, ks_p, sizeof ks_p);
    printf("%-18s %-13s %8.1f %4.0f %7s %8.2g %7s %.1e %.1e %4.3g %7s %4lu "
           "%7s  %s\n",
            warp->name, label, f->chi2, f->dof, chi2_p, f->ks, ks_p,
            f->mean_error, f->second_error, f->z, density,
            (unsigned long)f->outside, exact, verdict);
    fflush(stdout);
}

/* Test one parameter of a warp against its own density. */
static bool test_one(const warp_t *warp, double parameter)
{
    static warp_setup_t setup;
    warp_fit_t fit;
    char label[24] = "";
    bool ok;

    warp_begin(warp, &setup, parameter);
    if (warp->label != NULL) {
        snprintf(label, sizeof label, warp->label, setup.parameter);
    }
    warp_measure(warp, &setup, warp, &fit);
    ok = fits(&fit);
    print_row(warp, label, &fit, ok ? "ok" : "FAIL");
    return ok;
}

/* The naive warp is there to show that it is not uniform: it must fail. */
static bool test_that_naive_fails(void)
{
    static warp_setup_t setup;
    const warp_t *naive = warp_find("naive-hemisphere");
    warp_fit_t fit;
    bool fails;

    warp_begin(naive, &setup, 0);
    warp_measure(naive, &setup, warp_find("uniform-hemisphere"), &fit);
    fails = fit.chi2_p < WARP_P_MIN;
    print_row(naive, "as uniform", &fit,
            fails ? "NOT UNIFORM, as expected" : "FAIL: looks uniform");
    return fails;
}

static bool test_warp(const warp_t *warp, double power)
{
    const bool powers = strcmp(warp->name, "cosine-power") == 0;
    const unsigned n = warp->label != NULL ? warp->n_parameters : 1;
    bool ok = true;

    if (powers && power >= 0) {
        return test_one(warp, power);
    }
    for (unsigned k = 0; k < n; k++) {
        ok = test_one(warp, warp->parameters[k]) && ok;
    }
    if (strcmp(warp->name, "naive-hemisphere") == 0) {
        ok = test_that_naive_fails() && ok;
    }
    return ok;
}

static bool is(const warp_t *only, const char *a, const char *b)
{
    return only == NULL || strcmp(only->name, a) == 0 ||
           strcmp(only->name, b) == 0;
}

int warp_test(const warp_t *only, double power)
{
    bool ok = true;

    print_head();
    for (unsigned i = 0; warp_at(i) != NULL; i++) {
        if (only == NULL || warp_at(i) == only) {
            ok = test_warp(warp_at(i), power) && ok;
        }
    }
    if (is(only, "naive-hemisphere", "naive-hemisphere")) {
        printf("\nnaive-hemisphere: drawing polar angle and azimuth evenly is "
               "not uniform, which\nthe line \"as uniform\" shows; divided by "
               "its own density it is right.\n");
    }
    if (is(only, "discrete", "alias")) {
        ok = cost_of_search() && ok;
    }
    if (is(only, "cosine-power", "table-1d")) {
        ok = cost_of_analytic(power >= 0 ? power : WARP_POWER_DEFAULT) && ok;
    }
    if (!ok) {
        fflush(stdout); /* the verdicts before the message */
        cli_fail(CLI_INPUT, "a warp does not match its density");
    }
    return CLI_DONE;
}
