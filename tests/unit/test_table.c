/* test_table.c - tabulated distributions: masses, reuse of u, densities */
/* SPDX-License-Identifier: MIT */

#include <math.h>

#include "support/ql_stats.h"
#include "support/ql_test.h"
#include "sample/ql_table.h"
#include "lib/math/build_table.h"

enum { CELLS_MAX = 65536, WORDS_MAX = 2 * CELLS_MAX, DRAWS = MANY(1 << 20) };

static double weights[CELLS_MAX];
static uint32_t shares[CELLS_MAX];
static uint16_t words[WORDS_MAX];
static uint32_t hits[8 * CELLS_MAX];
static double expected[8 * CELLS_MAX];
static uint64_t state;

static size_t cells_of(unsigned dims, const uint16_t *count)
{
    size_t cells = 1;

    for (unsigned d = 0; d < dims; d++) {
        cells *= count[d];
    }
    return cells;
}

/* Build from weights[] and open. */
static ql_table_t build(unsigned dims, const uint16_t *count)
{
    ql_table_t table = {words, {1, 1, 1}, 0};
    const uint32_t n = table_words(dims, count);
    table_error_t error;

    CHECK(n > 0 && n <= WORDS_MAX, "%lu words", (unsigned long)n);
    error = table_build(words, weights, dims, count);
    CHECK(error == TABLE_OK, "%s", table_error_text(error));
    CHECK(ql_table_open(&table, words, n, dims, count) == QL_OK, "not opened");
    return table;
}

/* Weights of up to the given bits, about a third of them 0. */
static void random_weights(size_t cells, unsigned bits)
{
    for (size_t i = 0; i < cells; i++) {
        weights[i] = stats_random_below(&state, 3) == 0
                             ? 0
                             : stats_random_below(&state, 1ull << bits);
    }
    weights[stats_random_below(&state, cells)] = 1;
}

/* Cell number i, x varying fastest, as coordinates. */
static void cell_at(const ql_table_t *table, size_t i, uint16_t *cell)
{
    for (unsigned d = 0; d < table->dims; d++) {
        cell[d] = (uint16_t)(i % table->count[d]);
        i /= table->count[d];
    }
}

/* Over all cells: masses above 0 where weights are, and their sum is one. */
static void check_masses(const ql_table_t *table, const char *name)
{
    const size_t cells = cells_of(table->dims, table->count);
    uint64_t sum = 0;
    uint16_t cell[3];

    for (size_t i = 0; i < cells; i++) {
        uint64_t mass;

        cell_at(table, i, cell);
        mass = ql_table_mass(table, cell);
        CHECK((mass > 0) == (weights[i] > 0), "%s, cell %lu: %llu of weight %g",
                name, (unsigned long)i, (unsigned long long)mass, weights[i]);
        sum += mass;
    }
    CHECK(sum == 1ull << 16 * table->dims, "%s: sum %llu", name,
            (unsigned long long)sum);
}

TEST(cells_of_a_row_are_chosen_exactly_as_often_as_their_mass)
{
    static const uint16_t counts[] = {
            1, 2, 3, 4, 5, 31, 32, 33, 255, 256, 257, 1000, 65535};

    state = 1;
    for (size_t k = 0; k < sizeof counts / sizeof counts[0]; k++) {
        const uint16_t n = counts[k];
        ql_table_t table;
        uint16_t before = 0;

        random_weights(n, 1 + stats_random_below(&state, 40) / 2);
        table = build(1, &n);
        check_masses(&table, "row");
        memset(hits, 0, n * sizeof *hits);
        for (uint32_t v = 0; v < 65536; v++) {
            ql_uq32_t rest;
            uint32_t mass, mass_last;
            const uint16_t i = ql_table_pick(words, v << 16, &rest, &mass);
            const uint16_t last =
                    ql_table_pick(words, v << 16 | 0xffffu, &rest, &mass_last);

            CHECK(i == last && mass == mass_last, "u = %lx: %u, %u",
                    (unsigned long)v, i, last);
            CHECK(i >= before && i < n && weights[i] > 0,
                    "u = %lx: %u after %u of %u, weight %g", (unsigned long)v,
                    i, before, n, weights[i < n ? i : 0]);
            CHECK(mass == ql_table_mass(&table, &i), "mass %lu",
                    (unsigned long)mass);
            before = i;
            hits[i]++;
        }
        for (uint16_t i = 0; i < n; i++) {
            CHECK(hits[i] == ql_table_mass(&table, &i), "cell %u of %u: %lu", i,
                    n, (unsigned long)hits[i]);
        }
    }
    NOTE("all of u, up to 65,535 cells");
}

/* All mass 2^16 values of u that choose a cell: each of the top 16 bits of the
 * rest comes out mass times, and each rest is its interval's midpoint. forget
 * plants a fault: u itself is used again. Values that are wrong. */
static unsigned long count_uneven(uint32_t mass, bool forget)
{
    const uint32_t start = 65533 - mass;
    const uint16_t row[3] = {
            QL_LE16(3), QL_LE16((uint16_t)start), QL_LE16(65533)};
    const uint32_t first = start << 16;
    unsigned long wrong = 0;

    memset(hits, 0, 65536 * sizeof *hits);
    for (uint32_t d = 0; d < mass << 16; d++) {
        ql_uq32_t rest;
        uint32_t got;

        (void)ql_table_pick(row, first + d, &rest, &got);
        rest = forget ? first + d : rest;
        wrong += got != mass;
        wrong += rest != ((uint64_t)d * 65536 + 32768) / mass;
        hits[rest >> 16]++;
    }
    for (unsigned i = 0; i < 65536; i++) {
        wrong += hits[i] != mass;
    }
    return wrong;
}

TEST(what_is_left_of_u_is_uniform)
{
    static const uint32_t masses[] = {1, 2, 3, 4, 5, 7, 16, 31, 100, 255};
    unsigned long wrong, n = 0;

    for (size_t k = 0;
            k < sizeof masses / sizeof masses[0] && masses[k] < MANY(256);
            k++) {
        wrong = count_uneven(masses[k], false);
        CHECK(wrong == 0, "mass %lu: %lu wrong", (unsigned long)masses[k],
                wrong);
        n += masses[k] << 16;
    }
    wrong = count_uneven(7, true);
    CHECK(wrong > 65536, "u used again: %lu wrong", wrong);
    NOTE("%lu values of u; used again as it is, %lu wrong", n, wrong);
}

TEST(a_cell_that_has_all_mass_leaves_u_as_it_is)
{
    const uint16_t row[4] = {QL_LE16(3), 0, 0, 0};

    for (uint32_t k = 0; k < 65536; k++) {
        const uint32_t u = k * 65537u;
        ql_uq32_t rest;
        uint32_t mass;

        CHECK(ql_table_pick(row, u, &rest, &mass) == 2 && mass == 65536 &&
                        rest == u,
                "u %lx, rest %lx", (unsigned long)u, (unsigned long)rest);
    }
}

TEST(positions_are_looked_up_in_their_cell)
{
    static const uint16_t counts[] = {1, 2, 3, 5, 64, 100, 257, 60000, 65535};
    static const uint32_t rests[] = {
            0, 1, 0x7fffffffu, 0xfffffffeu, UINT32_MAX};
    double worst = 0;

    for (size_t k = 0; k < sizeof counts / sizeof counts[0]; k++) {
        for (uint32_t i = 0; i < counts[k]; i++) {
            for (size_t r = 0; r < sizeof rests / sizeof rests[0]; r++) {
                const uint32_t x =
                        ql_table_position((uint16_t)i, rests[r], counts[k]);
                const double exact = (i * 4294967296.0 + rests[r]) / counts[k];

                worst = fmax(worst, fabs(x - exact));
                CHECK(ql_mulhi_u32(x, counts[k]) == i, "cell %lu of %u: %lx",
                        (unsigned long)i, counts[k], (unsigned long)x);
            }
        }
    }
    CHECK(worst < 1, "error %g", worst);
    NOTE("error at most %.3f of 2^-32", worst);
}

TEST(masses_sum_to_exactly_one)
{
    unsigned tables = 0;

    state = 2;
    for (unsigned k = 0; k < 300; k++) {
        const unsigned dims = 1 + k % 3;
        uint16_t count[3];
        ql_table_t table;

        for (unsigned d = 0; d < 3; d++) {
            count[d] = (uint16_t)(1 + stats_random_below(&state, 20));
        }
        random_weights(
                cells_of(dims, count), 1 + stats_random_below(&state, 24));
        table = build(dims, count);
        check_masses(&table, "random");
        tables++;
    }
    NOTE("%u tables of 1, 2 and 3 dimensions", tables);
}

/* Every point drawn lies in a cell that weighs something, and its mass and
 * density are those looked up. */
static void check_draws(const ql_table_t *table, unsigned n)
{
    for (unsigned k = 0; k < n; k++) {
        ql_uq32_t u[3];
        ql_table_point_t point;
        ql_real_t given, found;
        size_t i = 0;

        for (unsigned d = 0; d < 3; d++) {
            u[d] = (uint32_t)stats_random(&state);
            u[d] = k % 8 == d ? 0 : k % 8 == d + 3 ? UINT32_MAX : u[d];
        }
        ql_table_sample(table, u, &point);
        for (unsigned d = table->dims; d-- > 0;) {
            i = i * table->count[d] + point.cell[d];
        }
        given = ql_table_density(table, point.mass);
        found = ql_table_pdf(table, point.x);
        CHECK(weights[i] > 0 && point.mass > 0 &&
                        point.mass == ql_table_mass(table, point.cell),
                "cell %lu, weight %g", (unsigned long)i, weights[i]);
        CHECK(given.m == found.m && given.e == found.e, "density %lx, %lx",
                (unsigned long)given.m, (unsigned long)found.m);
        for (unsigned d = table->dims; d < 3; d++) {
            CHECK(point.x[d] == 0 && point.cell[d] == 0, "dimension %u", d);
        }
    }
}

TEST(narrow_tables_and_spikes_work)
{
    static const uint16_t shapes[][3] = {{1, 1, 1}, {9, 1, 1}, {1, 9, 1},
            {1, 1, 9}, {5, 1, 7}, {1, 4, 6}, {7, 3, 1}, {3, 4, 5}};
    unsigned tables = 0;

    state = 3;
    for (size_t s = 0; s < sizeof shapes / sizeof shapes[0]; s++) {
        for (unsigned dims = 1; dims <= 3; dims++) {
            const size_t cells = cells_of(dims, shapes[s]);
            ql_table_t table;

            random_weights(cells, 8);
            table = build(dims, shapes[s]);
            check_masses(&table, "narrow");
            check_draws(&table, 1000);
            for (size_t spike = 0; spike < cells; spike++) {
                memset(weights, 0, cells * sizeof *weights);
                weights[spike] = 1e-300;
                table = build(dims, shapes[s]);
                check_masses(&table, "spike");
                check_draws(&table, 64);
                tables++;
            }
        }
    }
    NOTE("%u spikes", tables);
}

TEST(rows_without_weight_are_never_entered)
{
    static const uint16_t count[3] = {6, 5, 4};
    ql_table_t table;

    state = 4;
    random_weights(120, 10);
    for (size_t i = 0; i < 120; i++) {
        const size_t y = i / 6 % 5, z = i / 30;

        if (y == 0 || y == 4 || (z + y) % 3 == 0 || z == 3) {
            weights[i] = 0;
        }
    }
    weights[6] = 1e-9; /* a mass of 2^-16 at each turn */
    weights[7] = 1;
    table = build(3, count);
    check_masses(&table, "gaps");
    for (uint32_t k = 0; k < 3 * 65536; k++) {
        const unsigned d = k >> 16;
        ql_uq32_t u[3];
        ql_table_point_t point;

        for (unsigned e = 0; e < 3; e++) {
            u[e] = (uint32_t)stats_random(&state);
        }
        u[d] = (k & 0xffffu) << 16;
        ql_table_sample(&table, u, &point);
        CHECK(weights[point.cell[0] +
                      6u * (point.cell[1] + 5u * point.cell[2])] > 0,
                "cell %u %u %u", point.cell[0], point.cell[1], point.cell[2]);
    }
    check_draws(&table, 20000);
    NOTE("all of u in each dimension");
}

typedef enum { NONE, SEARCH, ROW, REMAP } fault_t;

/* The same sampler once more, in double where it is easier, with a fault. */
static void draw(const ql_table_t *table, fault_t fault, const ql_uq32_t *u,
        ql_table_point_t *point)
{
    const uint16_t *rows = table->words;
    uint32_t row = 0, n_rows = 1;

    memset(point, 0, sizeof *point);
    for (unsigned d = table->dims; d-- > 0;) {
        const uint16_t n = table->count[d];
        const uint16_t *r =
                rows + (fault == ROW && row > 0 ? row - 1 : row) * n;
        const uint32_t used = QL_LE16(r[0]), v = u[d] >> 16;
        uint32_t i = 0, low, end;
        double rest;

        while (i + 1 < used && (fault == SEARCH ? QL_LE16(r[i + 1]) < v
                                                : QL_LE16(r[i + 1]) <= v)) {
            i++;
        }
        low = i > 0 ? QL_LE16(r[i]) : 0;
        end = i + 1 < used ? QL_LE16(r[i + 1]) : 65536;
        rest = fault == REMAP || end == low
                       ? u[d] / 4294967296.0
                       : (u[d] / 65536.0 - low) / (end - low);
        point->cell[d] = (uint16_t)i;
        point->x[d] = (uint32_t)((i + rest) / n * 4294967295.0);
        row = row * n + i;
        n_rows *= n;
        rows += n_rows;
    }
}

/* p of DRAWS points in bins of half a cell a side. With a fault, or with the
 * sampler under test. */
static double p_of(const ql_table_t *table, bool tested, fault_t fault)
{
    const unsigned dims = table->dims;
    const size_t cells = cells_of(dims, table->count);
    double chi2, dof;

    memset(hits, 0, (cells << dims) * sizeof *hits);
    for (unsigned k = 0; k < DRAWS; k++) {
        ql_uq32_t u[3];
        ql_table_point_t point;
        size_t bin = 0;

        for (unsigned d = 0; d < 3; d++) {
            u[d] = (uint32_t)(stats_random(&state) >> 32);
        }
        if (tested) {
            ql_table_sample(table, u, &point);
        } else {
            draw(table, fault, u, &point);
        }
        for (unsigned d = dims; d-- > 0;) {
            const uint32_t n = 2u * table->count[d];

            bin = bin * n + ql_mulhi_u32(point.x[d], n);
        }
        hits[bin]++;
    }
    for (size_t bin = 0; bin < cells << dims; bin++) {
        size_t rest = bin;
        uint16_t cell[3];

        for (unsigned d = 0; d < dims; d++) {
            cell[d] = (uint16_t)(rest % (2u * table->count[d]) / 2);
            rest /= 2u * table->count[d];
        }
        expected[bin] = ldexp(DRAWS * (double)ql_table_mass(table, cell),
                -16 * (int)dims - (int)dims);
    }
    chi2 = stats_chi2(hits, expected, cells << dims, &dof);
    return isinf(chi2) ? 0 : stats_chi2_p(chi2, dof);
}

/* The first cell of every row is empty, so that a search that takes u = 0 for
 * below the first bound is seen. */
static void check_draws_match(unsigned dims, const uint16_t *count)
{
    const size_t cells = cells_of(dims, count);
    ql_table_t table;
    double p, model, p_search, p_row, p_remap;

    for (size_t i = 0; i < cells; i++) {
        const size_t x = i % count[0], y = i / count[0];

        weights[i] = x == 0 || y == 2 ? 0 : (double)(1 + (x * x + 5 * y) % 17);
    }
    table = build(dims, count);
    check_masses(&table, "chi-square");
    p = p_of(&table, true, NONE);
    model = p_of(&table, false, NONE);
    p_search = p_of(&table, false, SEARCH);
    p_row = p_of(&table, false, ROW);
    p_remap = p_of(&table, false, REMAP);
    CHECK(p > STATS_P_MIN, "p=%g", p);
    CHECK(model > STATS_P_MIN, "the model without a fault: p=%g", model);
    CHECK(p_search < STATS_P_MIN, "< for <=: p=%g", p_search);
    CHECK(p_row < STATS_P_MIN, "the row before: p=%g", p_row);
    CHECK(p_remap < STATS_P_MIN, "u used again: p=%g", p_remap);
    NOTE("p=%.3f, model %.3f; faults: search %.0e, row %.0e, reuse %.0e", p,
            model, p_search, p_row, p_remap);
}

TEST(points_of_a_square_match_the_table)
{
    static const uint16_t count[2] = {16, 8};

    state = 5;
    check_draws_match(2, count);
}

TEST(points_of_a_cube_match_the_table)
{
    static const uint16_t count[3] = {8, 4, 4};

    state = 6;
    check_draws_match(3, count);
}

static double real(ql_real_t r)
{
    return ldexp(r.m, r.e);
}

TEST(densities_are_masses_times_cells)
{
    double worst[3] = {0, 0, 0};

    state = 7;
    for (unsigned k = 0; k < 3000; k++) {
        ql_table_t table = {words, {1, 1, 1}, 0};
        double cells = 1;
        uint64_t mass = 1;

        table.dims = (uint8_t)(1 + k % 3);
        for (unsigned d = 0; d < table.dims; d++) {
            table.count[d] = (uint16_t)(1 + stats_random_below(&state, 65535));
            cells *= table.count[d];
            mass *= 1 + stats_random_below(&state, 65536);
        }
        {
            const double exact =
                    ldexp((double)mass * cells, -16 * (int)table.dims);
            const double error =
                    real(ql_table_density(&table, mass)) / exact - 1;
            double *w = &worst[table.dims - 1];

            CHECK(error < 1e-15, "error %g", error);
            *w = fmin(*w, error);
        }
        CHECK(ql_table_density(&table, 0).m == 0, "density of 0");
    }
    CHECK(worst[0] == 0 && worst[1] > -ldexp(1, -29) &&
                    worst[2] > -ldexp(1, -28),
            "%g %g %g", worst[0], worst[1], worst[2]);
    NOTE("relative error 0, %.1e, %.1e", worst[1], worst[2]);
}

TEST(estimates_with_the_quantised_density_have_no_bias)
{
    /* f is the cell's weight; its integral is a sum over the cells of mass
     * times f / density, whatever the quantisation did to the mass */
    static const uint16_t count[2] = {30, 20};
    double sum = 0, exact = 0, one = 0;
    ql_table_t table;

    for (unsigned i = 0; i < 600; i++) {
        weights[i] = exp(0.05 * (i % 97)) * 1e-5 + (i == 77 ? 1e9 : 0);
        exact += weights[i] / 600;
    }
    table = build(2, count);
    for (unsigned i = 0; i < 600; i++) {
        uint16_t cell[2];
        uint64_t mass;

        cell_at(&table, i, cell);
        mass = ql_table_mass(&table, cell);
        sum += ldexp((double)mass, -32) * weights[i] /
               real(ql_table_density(&table, mass));
        one += real(ql_table_density(&table, mass)) / 600;
    }
    CHECK(fabs(sum / exact - 1) < 2e-9, "%g for %g", sum, exact);
    CHECK(fabs(one - 1) < 2e-9, "density integrates to %.12f", one);
    NOTE("relative error %.1e", sum / exact - 1);
}

TEST(shares_are_within_one_of_proportional)
{
    double worst = 0;

    state = 8;
    for (unsigned k = 0; k < 400; k++) {
        const uint32_t n = 1 + stats_random_below(&state, 2000);
        const unsigned bits = 16 + stats_random_below(&state, 16);
        double total = 0;
        uint64_t sum = 0;

        for (uint32_t i = 0; i < n; i++) {
            weights[i] = 1000 + stats_random_below(&state, 1000);
            total += weights[i];
        }
        CHECK(table_shares(shares, weights, n, bits) == TABLE_OK, "not shared");
        for (uint32_t i = 0; i < n; i++) {
            worst = fmax(worst,
                    fabs(shares[i] - ldexp(weights[i], (int)bits) / total));
            sum += shares[i];
        }
        CHECK(sum == 1ull << bits, "sum %llu", (unsigned long long)sum);
    }
    CHECK(worst < 1, "off by %g", worst);
    NOTE("off by %.3f at most", worst);
}

TEST(no_weight_is_too_small_for_a_share)
{
    /* half of the largest count is due nothing, the others two each */
    uint64_t sum = 0;

    for (uint32_t i = 0; i < 65535; i++) {
        weights[i] = i % 2 ? 5e-324 : 1.7e308;
    }
    CHECK(table_shares(shares, weights, 65535, 16) == TABLE_OK, "not shared");
    for (uint32_t i = 0; i < 65535; i++) {
        CHECK(shares[i] >= 1, "entry %lu", (unsigned long)i);
        sum += shares[i];
    }
    CHECK(sum == 65536, "sum %llu", (unsigned long long)sum);
    weights[0] = weights[1] = weights[2] = 1;
    CHECK(table_shares(shares, weights, 3, 16) == TABLE_OK &&
                    shares[0] == 21846 && shares[1] == 21845 &&
                    shares[2] == 21845,
            "ties: %lu %lu", (unsigned long)shares[0],
            (unsigned long)shares[1]);
    /* 65536 / 7 = 9362.3, 18724.6, 37449.1: the one left is the second's */
    weights[1] = 2;
    weights[2] = 4;
    CHECK(table_shares(shares, weights, 3, 16) == TABLE_OK &&
                    shares[0] == 9362 && shares[1] == 18725 &&
                    shares[2] == 37449,
            "remainders: %lu %lu", (unsigned long)shares[0],
            (unsigned long)shares[1]);
}

TEST(extreme_weights_keep_their_sums_finite)
{
    static const uint16_t count[2] = {3, 3};
    static const double w[9] = {
            1.7e308, 1.7e308, 1.7e308, 1.7e308, 0, 0, 5e-324, 0, 5e-324};
    ql_table_t table;

    memcpy(weights, w, sizeof w);
    table = build(2, count);
    check_masses(&table, "extreme");
    check_draws(&table, 1000);
}

TEST(weights_that_make_no_table_are_refused)
{
    uint16_t count[3] = {4, 3, 2};

    memset(weights, 0, 24 * sizeof *weights);
    for (unsigned dims = 1; dims <= 3; dims++) {
        CHECK(table_build(words, weights, dims, count) == TABLE_ERR_ZERO,
                "zeros in %u dimensions", dims);
    }
    weights[3] = 1;
    weights[23] = -1;
    CHECK(table_build(words, weights, 3, count) == TABLE_ERR_NEGATIVE, "-1");
    weights[23] = NAN;
    CHECK(table_build(words, weights, 3, count) == TABLE_ERR_NAN, "nan");
    weights[23] = INFINITY;
    CHECK(table_build(words, weights, 3, count) == TABLE_ERR_NAN, "infinity");
    CHECK(table_build(words, weights, 0, count) == TABLE_ERR_RANGE, "0-D");
    CHECK(table_build(words, weights, 4, count) == TABLE_ERR_RANGE, "4-D");
    count[1] = 0;
    CHECK(table_build(words, weights, 2, count) == TABLE_ERR_RANGE, "4 x 0");
}

TEST(broken_tables_are_not_opened)
{
    static const uint16_t count[2] = {4, 3};
    static const uint16_t none[2] = {4, 0};
    ql_table_t table;

    for (unsigned i = 0; i < 12; i++) {
        weights[i] = i < 8 ? 1 : 0; /* the last row is empty */
    }
    table = build(2, count);
    CHECK(table.words == words, "not opened");
    CHECK(ql_table_open(&table, words, 14, 2, count) == QL_ERR_TRUNCATED, "14");
    CHECK(ql_table_open(&table, words, 15, 2, none) == QL_ERR_RANGE, "none");
    CHECK(ql_table_open(&table, words, 15, 0, count) == QL_ERR_RANGE, "0-D");
    CHECK(ql_table_open(&table, words, 15, 4, count) == QL_ERR_RANGE, "4-D");
    words[3] = QL_LE16(5); /* more cells than there are */
    CHECK(ql_table_open(&table, words, 15, 2, count) == QL_ERR_RANGE, "used");
    words[3] = 0; /* empty, but entered */
    CHECK(ql_table_open(&table, words, 15, 2, count) == QL_ERR_RANGE, "empty");
    words[3] = QL_LE16(4);
    words[4] = QL_LE16(60000); /* decreases after it */
    CHECK(ql_table_open(&table, words, 15, 2, count) == QL_ERR_RANGE, "order");
    words[4] = 0;
    CHECK(ql_table_open(&table, words, 15, 2, count) == QL_OK, "mended");
}

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_table", argc, argv);
    RUN(cells_of_a_row_are_chosen_exactly_as_often_as_their_mass);
    RUN(what_is_left_of_u_is_uniform);
    RUN(a_cell_that_has_all_mass_leaves_u_as_it_is);
    RUN(positions_are_looked_up_in_their_cell);
    RUN(masses_sum_to_exactly_one);
    RUN(narrow_tables_and_spikes_work);
    RUN(rows_without_weight_are_never_entered);
    RUN(points_of_a_square_match_the_table);
    RUN(points_of_a_cube_match_the_table);
    RUN(densities_are_masses_times_cells);
    RUN(estimates_with_the_quantised_density_have_no_bias);
    RUN(shares_are_within_one_of_proportional);
    RUN(no_weight_is_too_small_for_a_share);
    RUN(extreme_weights_keep_their_sums_finite);
    RUN(weights_that_make_no_table_are_refused);
    RUN(broken_tables_are_not_opened);
    return TEST_END();
}
