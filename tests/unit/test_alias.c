/* test_alias.c - alias tables: probabilities equal weights exactly */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <stdlib.h>

#include "support/ql_stats.h"
#include "support/ql_test.h"
#include "sample/lecture/ql_alias.h"
#include "sample/ql_table.h"
#include "lib/math/build_table.h"

enum { COUNT_MAX = 65535, VECTORS = 3000, DRAWS = MANY(1 << 20) };

static uint32_t words[COUNT_MAX * QL_ALIAS_WORDS];
static uint32_t weights[COUNT_MAX];
static uint64_t places[COUNT_MAX];
static uint32_t hits[COUNT_MAX];
static double expected[COUNT_MAX];
static double reals[COUNT_MAX];
static uint16_t row[COUNT_MAX];
static uint64_t state;

static uint32_t word(uint32_t i, unsigned which)
{
    return QL_LE32(words[i * QL_ALIAS_WORDS + which]);
}

/* Build from weights[]; the view of it. */
static ql_alias_t build(uint16_t count)
{
    ql_alias_t alias = {words, 0, count};
    const table_error_t error =
            alias_build(words, weights, count, &alias.total);

    CHECK(error == TABLE_OK, "%s", table_error_text(error));
    return alias;
}

/* Each entry fills exactly n w of the n W places. at_most plants a fault: the
 * threshold itself counts as below. Entries that are wrong. */
static unsigned count_wrong(const ql_alias_t *alias, unsigned at_most)
{
    const uint16_t n = alias->count;
    unsigned wrong = 0;

    memset(places, 0, sizeof places);
    for (uint32_t j = 0; j < n; j++) {
        const uint32_t other = word(j, QL_ALIAS_OTHER);
        uint64_t below = word(j, QL_ALIAS_THRESHOLD);

        if (below > alias->total || other >= n) {
            return n;
        }
        below += below < alias->total ? at_most : 0;
        places[j] += below;
        places[other] += alias->total - below;
    }
    for (uint32_t i = 0; i < n; i++) {
        wrong += places[i] != (uint64_t)n * weights[i] ||
                 ql_alias_pmf(alias, (uint16_t)i) != weights[i];
    }
    return wrong;
}

/* A vector of up to 64 entries of up to the given bits, a third of them 0. */
static uint16_t random_weights(void)
{
    const uint16_t n = (uint16_t)(1 + stats_random_below(&state, 64));
    const unsigned bits = 1 + stats_random_below(&state, 26);
    uint64_t sum = 0;

    for (uint16_t i = 0; i < n; i++) {
        weights[i] = stats_random_below(&state, 3) == 0
                             ? 0
                             : stats_random_below(&state, 1ull << bits);
        sum += weights[i];
    }
    if (sum == 0) {
        weights[stats_random_below(&state, n)] = 1;
    }
    return n;
}

TEST(entries_are_chosen_exactly_as_often_as_their_weight)
{
    unsigned long zeros = 0;

    state = 1;
    for (unsigned k = 0; k < VECTORS; k++) {
        const uint16_t n = random_weights();
        const ql_alias_t alias = build(n);
        const unsigned wrong = count_wrong(&alias, 0);

        CHECK(wrong == 0, "vector %u: %u of %u entries", k, wrong, n);
        for (uint16_t i = 0; i < n; i++) {
            zeros += weights[i] == 0;
        }
    }
    NOTE("%d vectors, %lu weights of 0", VECTORS, zeros);
}

TEST(a_threshold_that_counts_as_below_is_rejected)
{
    unsigned rejected = 0, vectors = 0;

    state = 1;
    for (unsigned k = 0; k < VECTORS; k++) {
        const ql_alias_t alias = build(random_weights());
        unsigned paired = 0;

        for (uint16_t j = 0; j < alias.count; j++) {
            paired += word(j, QL_ALIAS_OTHER) != j;
        }
        vectors += paired > 0;
        rejected += count_wrong(&alias, 1) > 0;
    }
    CHECK(rejected > vectors * 9 / 10, "%u of %u", rejected, vectors);
    NOTE("%u of %u vectors", rejected, vectors);
}

/* Every place of small tables is looked up, not summed. */
TEST(looking_up_every_place_counts_the_same)
{
    unsigned long looked_up = 0;

    state = 2;
    for (unsigned k = 0; k < 200; k++) {
        const uint16_t n = (uint16_t)(1 + stats_random_below(&state, 20));
        ql_alias_t alias;

        for (uint16_t i = 0; i < n; i++) {
            weights[i] = stats_random_below(&state, 50);
        }
        weights[n / 2] += 1;
        alias = build(n);
        memset(hits, 0, sizeof hits);
        for (uint16_t j = 0; j < n; j++) {
            for (uint32_t r = 0; r < alias.total; r++) {
                hits[ql_alias_at(&alias, j, r)]++;
                looked_up++;
            }
        }
        for (uint16_t i = 0; i < n; i++) {
            CHECK(hits[i] == n * weights[i], "entry %u: %lu", i,
                    (unsigned long)hits[i]);
        }
    }
    NOTE("%lu places", looked_up);
}

static void check_vector(uint16_t n, const char *name)
{
    const ql_alias_t alias = build(n);
    const unsigned wrong = count_wrong(&alias, 0);

    CHECK(wrong == 0, "%s: %u wrong", name, wrong);
}

TEST(extreme_weights_are_exact)
{
    weights[0] = 1;
    check_vector(1, "one entry");
    weights[0] = UINT32_MAX;
    check_vector(1, "one entry of the largest weight");
    weights[0] = 1;
    weights[1] = 0x80000000u;
    check_vector(2, "1 to 2^31");
    for (unsigned at = 0; at < 9; at++) {
        memset(weights, 0, 9 * sizeof *weights);
        weights[at] = 7;
        check_vector(9, "one weight only");
    }
    /* nearly equal weights: what rounding errors of floats break */
    for (unsigned i = 0; i < 1000; i++) {
        weights[i] = 4000000 + i % 2;
    }
    check_vector(1000, "nearly equal");
    for (unsigned i = 0; i < 1000; i++) {
        weights[i] = 4000000;
    }
    weights[999]--;
    check_vector(1000, "one less");
    for (unsigned i = 0; i < COUNT_MAX; i++) {
        weights[i] = i == 7 ? 65536 : i == 60000 ? 65534 : 65535;
    }
    check_vector(COUNT_MAX, "the largest table");
    NOTE("%d entries at most", COUNT_MAX);
}

TEST(nearly_equal_reals_share_exactly)
{
    ql_alias_t alias = {words, 0, 1000};
    uint64_t sum = 0;
    unsigned wrong;

    for (unsigned i = 0; i < 1000; i++) {
        reals[i] = 0.1 + 1e-16 * (double)(i % 3);
    }
    CHECK(alias_build_real(words, reals, 1000, &alias.total) == TABLE_OK,
            "not built");
    CHECK(alias.total == 0x80000000u, "total %lu", (unsigned long)alias.total);
    for (unsigned i = 0; i < 1000; i++) {
        weights[i] = word(i, QL_ALIAS_WEIGHT);
        CHECK(weights[i] == 2147483 || weights[i] == 2147484, "entry %u: %lu",
                i, (unsigned long)weights[i]);
        sum += weights[i];
    }
    CHECK(sum == alias.total, "sum %llu", (unsigned long long)sum);
    wrong = count_wrong(&alias, 0);
    CHECK(wrong == 0, "%u wrong", wrong);
}

/* Over 2^16 values of u for the column and 2^16 for the height, each pair of
 * neighbours in turn: all of u1, and all of u2 in every column. */
TEST(weights_of_zero_are_never_chosen)
{
    static const uint32_t w[7] = {0, 3, 0, 0, 0x40000000u, 1, 0};
    unsigned long drawn = 0;
    ql_alias_t alias;

    memcpy(weights, w, sizeof w);
    alias = build(7);
    for (uint32_t column = 0; column < 7; column++) {
        const uint32_t u1 = column * 613566757u + 1000; /* 2^32 / 7 */

        for (uint32_t k = 0; k < 65536; k++) {
            for (unsigned end = 0; end < 2; end++) {
                const uint32_t u = end ? k << 16 | 0xffffu : k << 16;
                uint32_t a, b;
                const uint16_t i = ql_alias_sample(&alias, u1, u, &a);
                const uint16_t j = ql_alias_sample(&alias, u, u * 7, &b);

                CHECK(i < 7 && a == w[i] && a > 0, "entry %u, weight %lu", i,
                        (unsigned long)a);
                CHECK(j < 7 && b == w[j] && b > 0, "entry %u, weight %lu", j,
                        (unsigned long)b);
                drawn += 2;
            }
        }
    }
    NOTE("%lu draws", drawn);
}

/* p of DRAWS random draws; fault forgets the thresholds. */
static double draw(const ql_alias_t *alias, bool fault, bool one_number)
{
    double dof, chi2;

    memset(hits, 0, sizeof hits);
    for (unsigned k = 0; k < DRAWS; k++) {
        const uint64_t random = stats_random(&state);
        const uint32_t u1 = (uint32_t)(random >> 32);
        const uint32_t u2 = one_number ? u1 * alias->count : (uint32_t)random;
        uint32_t weight;

        hits[ql_alias_sample(alias, u1, fault ? 0 : u2, &weight)]++;
    }
    for (uint16_t i = 0; i < alias->count; i++) {
        expected[i] = (double)DRAWS * weights[i] / alias->total;
    }
    chi2 = stats_chi2(hits, expected, alias->count, &dof);
    return stats_chi2_p(chi2, dof);
}

TEST(random_draws_match_the_weights)
{
    ql_alias_t alias;
    double p, p_one, p_fault;

    state = 3;
    for (unsigned i = 0; i < 100; i++) {
        weights[i] = i * i;
    }
    alias = build(100);
    p = draw(&alias, false, false);
    p_one = draw(&alias, false, true);
    p_fault = draw(&alias, true, false);
    CHECK(p > STATS_P_MIN, "p=%g", p);
    CHECK(p_one > STATS_P_MIN, "from one number: p=%g", p_one);
    CHECK(p_fault < STATS_P_MIN, "without thresholds: p=%g", p_fault);
    NOTE("p=%.3f, from one number %.3f; no threshold %.1g", p, p_one, p_fault);
}

TEST(weights_that_make_no_table_are_refused)
{
    uint32_t total;

    memset(weights, 0, 4 * sizeof *weights);
    CHECK(alias_build(words, weights, 4, &total) == TABLE_ERR_ZERO, "zeros");
    CHECK(alias_build(words, weights, 0, &total) == TABLE_ERR_RANGE, "none");
    CHECK(alias_build(words, weights, 65536, &total) == TABLE_ERR_RANGE,
            "many");
    weights[0] = weights[1] = 0x80000000u;
    CHECK(alias_build(words, weights, 4, &total) == TABLE_ERR_RANGE, "2^32");
    reals[0] = 1;
    reals[1] = -1e-300;
    CHECK(alias_build_real(words, reals, 2, &total) == TABLE_ERR_NEGATIVE,
            "negative");
    reals[1] = NAN;
    CHECK(alias_build_real(words, reals, 2, &total) == TABLE_ERR_NAN, "nan");
    reals[0] = reals[1] = 0;
    CHECK(alias_build_real(words, reals, 2, &total) == TABLE_ERR_ZERO, "zeros");
}

/* What ql_table_pick() does, counting comparisons. */
static unsigned count_search(const uint16_t *cells, uint32_t u)
{
    uint32_t low = 0, high = QL_LE16(cells[0]);
    unsigned compares = 0;

    for (; high - low > 1; compares++) {
        const uint32_t mid = (low + high) / 2;

        if (QL_LE16(cells[mid]) <= u >> 16) {
            low = mid;
        } else {
            high = mid;
        }
    }
    return compares;
}

/* Operations are additions, shifts, multiplications, comparisons, loads and
 * stores. A step of the search: 5 (add, shift, load, compare, compare the
 * ends); an alias draw: 2 multiplications, the address (2), 2 loads, 1
 * comparison: 7. Prefix sums: add, load, store, 3 an entry. Vose: 3 for the
 * amount, 3 to classify, 9 a pairing (4 loads, 2 subtractions, 1 comparison, 2
 * stores), 3 an entry to store; break-even is on what it costs more.
 *
 * The second half of the weights is the first half backwards, so that a scan
 * takes (n + 1) / 2 steps on average whatever is drawn. */
static void compare(uint16_t n, double *search_ops, double *even)
{
    const uint16_t count = n;
    unsigned long compares = 0, paired = 0;
    uint64_t sum = 0;

    for (uint16_t i = 0; i < n; i++) {
        weights[i] = i < n / 2 ? 1 + stats_random_below(&state, 1000)
                               : weights[n - 1 - i];
        reals[i] = weights[i];
        sum += weights[i];
    }
    CHECK(table_build(row, reals, 1, &count) == TABLE_OK, "row of %u", n);
    (void)build(n);
    for (uint16_t i = 0; i < n; i++) {
        paired += word(i, QL_ALIAS_OTHER) != i;
    }
    for (unsigned k = 0; k < 65536; k++) {
        compares += count_search(row, k << 16);
    }
    CHECK(sum > 0, "no weight");
    *search_ops = 5.0 * (double)compares / 65536;
    *even = (6.0 * n + 9.0 * (double)paired) / (*search_ops - 7);
}

TEST(alias_pays_off_after_this_many_samples)
{
    double s16, s256, s4096, n16, n256, n4096;

    state = 4;
    compare(16, &s16, &n16);
    compare(256, &s256, &n256);
    compare(4096, &s4096, &n4096);
    CHECK(s16 < s256 && s256 < s4096 && n16 < n256 && n256 < n4096,
            "%g %g %g ops", s16, s256, s4096);
    NOTE("16/256/4096 entries: search %.0f/%.0f/%.0f ops, alias 7; even at "
         "%.0f/%.0f/%.0f samples",
            s16, s256, s4096, n16, n256, n4096);
}

/* Without a table: adding up weights until u is passed, 3 operations each. The
 * 3 n of prefix sums are earned back by the samples that need only a search. */
TEST(prefix_sums_pay_off_after_this_many_samples)
{
    static const uint16_t counts[] = {16, 256, 4096};
    double even[3], ops, unused;

    state = 4;
    for (unsigned k = 0; k < 3; k++) {
        const uint16_t n = counts[k];
        double scan = 0, sum = 0;

        compare(n, &ops, &unused);
        for (uint16_t i = 0; i < n; i++) {
            scan += 3.0 * (i + 1) * weights[i];
            sum += weights[i];
        }
        even[k] = 3.0 * n / (scan / sum - ops);
        CHECK(even[k] > 1 && even[k] < 10, "%u entries: %g", n, even[k]);
    }
    NOTE("16/256/4096 entries: even with a scan at %.1f/%.1f/%.1f samples",
            even[0], even[1], even[2]);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_alias", argc, argv);
    RUN(entries_are_chosen_exactly_as_often_as_their_weight);
    RUN(a_threshold_that_counts_as_below_is_rejected);
    RUN(looking_up_every_place_counts_the_same);
    RUN(extreme_weights_are_exact);
    RUN(nearly_equal_reals_share_exactly);
    RUN(weights_of_zero_are_never_chosen);
    RUN(random_draws_match_the_weights);
    RUN(weights_that_make_no_table_are_refused);
    RUN(alias_pays_off_after_this_many_samples);
    RUN(prefix_sums_pay_off_after_this_many_samples);
    return TEST_END();
}
