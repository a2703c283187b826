/* cost.c - what tables cost to build and save to draw from, counted */
/* SPDX-License-Identifier: MIT */

/* Copies of the core's functions count what they do and are compared with the
 * core bit for bit, so a change there shows here. An operation is an addition,
 * shift, logical, comparison, load, store, multiplication or division of words.
 * Assignments between registers and jumps are not counted. */

#include <math.h>
#include <string.h>

#include "lib/program/cli.h"
#include "math/lut/ql_lut.h"
#include "sample/ql_cdf.h"
#include "lib/math/build_table.h"
#include "warp/ql_warp_lobe.h"
#include "warp/warps.h"

enum {
    ENTRIES_MAX = 4096,
    DRAWS = 65536,
    SLOW_DIVISION = 32, /* operations of one without an instruction for it */

    /* each entry: add, load, store */
    PREFIX_ENTRY = 3,
    /* add, load, compare of each entry passed */
    SCAN_ENTRY = 3,
    /* each entry: 3 for its amount, 3 to classify it, 3 to store the column */
    ALIAS_ENTRY = 9,
    /* each pair: 4 loads, 2 subtractions, 1 comparison, 2 stores */
    ALIAS_PAIR = 9,
    /* 2 multiplications, 2 for the address, 2 loads, 1 comparison */
    ALIAS_DRAW = 7
};

typedef struct {
    unsigned long plain, multiply, divide;
} ops_t;

static void did(ops_t *ops, unsigned plain, unsigned multiply, unsigned divide)
{
    ops->plain += plain;
    ops->multiply += multiply;
    ops->divide += divide;
}

static double cost(const ops_t *ops, double division)
{
    return ((double)(ops->plain + ops->multiply) +
                   division * (double)ops->divide) /
           DRAWS;
}

/* ql_cdf_sample() */
static uint16_t search(
        ops_t *ops, const uint32_t *bounds, uint16_t count, uint32_t u)
{
    uint32_t low = 0, high = count;

    while (high - low > 1) {
        const uint32_t mid = (low + high) / 2;

        if (QL_LE32(bounds[mid]) <= u) {
            low = mid;
        } else {
            high = mid;
        }
        did(ops, 5, 0, 0); /* add, shift, load, compare, compare the ends */
    }
    return (uint16_t)low;
}

/* How many samples earn back a cost of building; HUGE_VAL if none do. */
static double even(double build, double saved)
{
    return saved > 0 ? ceil(build / saved) : HUGE_VAL;
}

static void print_even(double samples)
{
    if (samples < HUGE_VAL) {
        printf(" %10.0f", samples);
    } else {
        printf(" %10s", "never");
    }
}

/* Weights 1 to 1000, in no order: the same on every host. */
static double weight_of(uint32_t i)
{
    uint32_t u[WARP_NUMBERS];

    warp_numbers(QL_SAMPLER_RANDOM, 4, i, u);
    return 1 + ql_mulhi_u32(u[0], 1000);
}

static bool compare_search(uint32_t n)
{
    static double weights[ENTRIES_MAX];
    static uint32_t shares[ENTRIES_MAX], bounds[ENTRIES_MAX];
    static uint32_t words[ENTRIES_MAX * QL_ALIAS_WORDS];
    ops_t ops = {0, 0, 0};
    double scan = 0, sum = 0, pairs = 0, prefix, alias, step;
    uint32_t total, bound = 0;
    bool same = true;

    for (uint32_t i = 0; i < n; i++) {
        weights[i] = weight_of(i);
        sum += weights[i];
        scan += weights[i] * (i + 1) * SCAN_ENTRY;
    }
    if (table_shares(shares, weights, n, 31) != TABLE_OK ||
            alias_build(words, shares, n, &total) != TABLE_OK) {
        return false;
    }
    for (uint32_t i = 0; i < n; i++) {
        bounds[i] = bound;
        bound += 2 * shares[i];
        pairs += QL_LE32(words[i * QL_ALIAS_WORDS + QL_ALIAS_OTHER]) != i;
    }
    for (uint32_t k = 0; k < DRAWS; k++) {
        const uint32_t u = k << 16 | 0x8000u;

        same = same && search(&ops, bounds, (uint16_t)n, u) ==
                               ql_cdf_sample(bounds, 1, (uint16_t)n, u);
    }
    scan /= sum;
    step = cost(&ops, 1);
    prefix = (double)PREFIX_ENTRY * n;
    alias = (double)ALIAS_ENTRY * n + ALIAS_PAIR * pairs;
    printf("%7lu %8.1f   %8.0f %8.1f", (unsigned long)n, scan, prefix, step);
    print_even(even(prefix, scan - step));
    printf("   %8.0f %8d", alias, ALIAS_DRAW);
    print_even(fmax(even(alias, scan - ALIAS_DRAW),
            even(alias - prefix, step - ALIAS_DRAW)));
    putchar('\n');
    return same;
}

bool cost_of_search(void)
{
    bool same = true;

    printf("\nSearch against alias: entries of weights 1 to 1000, operations "
           "to build and for\none sample, and the samples after which a method "
           "costs less than all to its left.\nCounted: additions, shifts, "
           "comparisons, loads, stores, multiplications (2 of an\nalias draw). "
           "Scan: no table, add up weights. Search: 5 a step. Building an alias"
           "\ntable: 9 an entry, 9 a pair of entries.\n\n"
           "           scan   prefix sums, search               alias\n"
           "entries   sample      build   sample  pays after      build   "
           "sample  pays after\n");
    for (uint32_t n = 4; n <= ENTRIES_MAX; n *= 4) {
        same = compare_search(n) && same;
    }
    printf("counted search against the core: %s\n",
            same ? "the same entries" : "DIFFERS");
    return same;
}

static ql_real_t real_of(uint32_t m, int e)
{
    const ql_real_t r = {m, (int16_t)e};

    return r;
}

/* Counted as one multiplication, 2 additions and the normalising of one bit:
 * a comparison, a shift, a subtraction. */
static ql_real_t multiply(ops_t *ops, ql_real_t a, ql_real_t b)
{
    did(ops, 5, 1, 0);
    return ql_real_mul(a, b);
}

/* Two words: count zeros, 2 comparisons, 3 shifts, an or, a subtraction. */
static ql_real_t normal(ops_t *ops, uint64_t n, int e)
{
    const ql_real_t r = ql_real_from_u64(n);

    did(ops, 9, 0, 0);
    return real_of(r.m, r.e + e);
}

/* Subtraction, comparison, shift. */
static uint32_t fixed(ops_t *ops, ql_real_t r)
{
    const int shift = -32 - r.e;

    did(ops, 3, 0, 0);
    return shift < 32 ? r.m >> shift : 0;
}

/* u's midpoint: count zeros, comparison, 2 shifts, or, 2 subtractions. */
static ql_real_t midpoint(ops_t *ops, uint32_t u)
{
    const unsigned zeros = ql_clz32(u);

    did(ops, 7, 0, 0);
    return zeros == 0 ? real_of(u, -32)
                      : real_of((u << 1 | 1u) << (zeros - 1), -32 - (int)zeros);
}

enum { SIXTH = 0x2aaaaaab }; /* 2^32 / 6 */
#define LN2   0xb17217f8u    /* 2^32 ln 2 */
#define LOG2E 0xb8aa3b29u    /* 2^31 / ln 2 */

static ql_real_t log_of(ops_t *ops, ql_real_t u, ql_real_t w)
{
    did(ops, 1, 0, 0); /* which of the two */
    if (w.e < -39) {
        const uint32_t x = fixed(ops, w), x2 = ql_mulhi_u32(x, x);
        const uint32_t sum = 0x80000000u + (x >> 2) + ql_mulhi_u32(x2, SIXTH) +
                             (ql_mulhi_u32(x2, x) >> 3);

        did(ops, 5, 3, 0);
        return multiply(
                ops, multiply(ops, w, real_of(sum, -31)), real_of(LOG2E, -31));
    } else {
        const uint32_t cell = (u.m >> 24) - QL_RECIP_CELLS;
        const uint32_t r = (uint32_t)ql_lut_recip[cell] << 16;
        const int32_t d = ql_i32(ql_mulhi_u32(u.m, r) << 7 | (u.m * r) >> 25);
        const uint32_t da = ql_abs32(d), d2 = ql_mulhi_u32(da, da);
        int32_t ln = (int32_t)(ql_mulhi_u32(ql_mulhi_u32(d2, da), SIXTH) >> 11);
        uint64_t sum;

        ln = d - (int32_t)(d2 >> 7) + (d < 0 ? -ln : ln);
        sum = ((uint64_t)(uint16_t)(-32 - u.e) << 32) + ql_lut_log2[cell];
        sum -= (uint64_t)(int64_t)ql_asr32(ql_mulhi_su32(ln, LOG2E) + 16, 5);
        /* cell 2, r 2, d 3, da 2, ln 1 + 5, sum 3 + 5 */
        did(ops, 23, 6, 0);
        return normal(ops, sum, -32);
    }
}

static uint32_t decay_over_x(ops_t *ops, uint32_t x)
{
    const uint32_t x2 = ql_mulhi_u32(x, x);

    did(ops, 5, 4, 0);
    return ~(x >> 1) + ql_mulhi_u32(x2, SIXTH) -
           (ql_mulhi_u32(ql_mulhi_u32(x2, x), SIXTH) >> 2);
}

static ql_real_t decay(ops_t *ops, ql_real_t y)
{
    uint64_t whole;
    uint32_t f, a, x, b, s;

    did(ops, 1, 0, 0);
    if (y.e < -37) {
        const ql_real_t z = multiply(ops, y, real_of(LN2, -32));

        return multiply(ops, z, real_of(decay_over_x(ops, fixed(ops, z)), -32));
    }
    whole = (uint64_t)y.m << (y.e + 38); /* 6 of two words */
    f = (uint32_t)(whole >> 6);
    whole >>= 38;
    a = ql_lut_exp2[f >> (32 - QL_EXP2_BITS)];
    x = ql_mulhi_u32(f << QL_EXP2_BITS, LN2);
    b = ql_mulhi_u32(x, decay_over_x(ops, x >> QL_EXP2_BITS)) >> QL_EXP2_BITS;
    s = a + ql_mulhi_u32(~a, b);
    s = whole < 32 ? ~(~s >> whole) : 0xffffffffu;
    /* split 6, a 2, x 1, its shift 1, b 1, s 2, 4 */
    did(ops, 17, 3, 0);
    return normal(ops, s, -32);
}

/* 1 - cos of ql_warp_lobe() */
static ql_uq31_t draw_analytic(ops_t *ops, ql_real_t inverse, uint32_t u)
{
    const ql_real_t log = log_of(ops, midpoint(ops, u), midpoint(ops, ~u));
    const uint32_t s = fixed(ops, decay(ops, multiply(ops, log, inverse)));

    did(ops, 4, 0, 0); /* the complement; rounding */
    return (s >> 1) + (s & 1u);
}

/* The one coordinate of ql_table_sample() */
static uint32_t draw_table(
        ops_t *ops, const uint16_t *row, uint16_t count, uint32_t u)
{
    const uint32_t used = QL_LE16(row[0]), n = count;
    uint32_t low = 0, high = used, first, mass, within, whole, rest, top, x;

    while (high - low > 1) {
        const uint32_t mid = (low + high) / 2;

        if ((uint32_t)QL_LE16(row[mid]) <= u >> 16) {
            low = mid;
        } else {
            high = mid;
        }
        did(ops, 5, 0, 0);
    }
    first = low == 0 ? 0 : QL_LE16(row[low]);
    mass = (low + 1 < used ? QL_LE16(row[low + 1]) : QL_TABLE_WHOLE) - first;
    within = u - (first << 16);
    whole = within / mass;
    rest = whole << 16 | ((within - whole * mass) << 16 | 0x8000u) / mass;
    did(ops, 15, 1, 2); /* used 1, u 1, first 2, mass 4, within 2, rest 5 */
    top = low << 16 | rest >> 16;
    x = top / n;
    x = x << 16 | ((top - x * n) << 16 | (rest & 0xffffu)) / n;
    did(ops, 12, 2, 2); /* top 3, x 4 + 2, the first place of a cell 3 */
    return x + (ql_mulhi_u32(x, n) != low);
}

/* Weights of 1 - cos in n cells for a power of the cosine. */
static void fill_weights(double *weights, uint32_t n, double power)
{
    for (uint32_t i = 0; i < n; i++) {
        weights[i] = pow(1 - (double)i / n, power + 1) -
                     pow(1 - (i + 1.0) / n, power + 1);
    }
}

/* How the table compares with ops of the analytic warp. */
static bool compare_analytic(uint32_t n, double power, const ops_t *analytic)
{
    static double weights[ENTRIES_MAX];
    static uint16_t words[ENTRIES_MAX];
    const uint16_t count[QL_TABLE_DIMS_MAX] = {(uint16_t)n, 1, 1};
    const double build = n * (cost(analytic, 1) + PREFIX_ENTRY);
    ops_t ops = {0, 0, 0};
    ql_table_t table;
    bool same = true;

    fill_weights(weights, n, power);
    if (table_build(words, weights, 1, count) != TABLE_OK ||
            ql_table_open(&table, words, n, 1, count) != QL_OK) {
        return false;
    }
    for (uint32_t k = 0; k < DRAWS; k++) {
        const uint32_t u = k << 16 | 0x8000u;
        ql_table_point_t point;

        ql_table_sample(&table, &u, &point);
        same = same && draw_table(&ops, words, count[0], u) == point.x[0];
    }
    printf("%7lu   %8.0f", (unsigned long)n, build);
    for (int slow = 0; slow < 2; slow++) {
        const double division = slow ? SLOW_DIVISION : 1;

        printf(" %8.1f", cost(&ops, division));
        print_even(even(build, cost(analytic, 1) - cost(&ops, division)));
    }
    putchar('\n');
    return same;
}

bool cost_of_analytic(double power)
{
    static warp_setup_t setup;
    ops_t analytic = {0, 0, 0};
    bool same = true;

    warp_begin(warp_find("cosine-power"), &setup, power);
    for (uint32_t k = 0; k < DRAWS; k++) {
        const uint32_t u = k << 16 | 0x8000u;
        ql_uq31_t s;

        (void)ql_warp_lobe(setup.inverse, u, 0, &s);
        same = same && draw_analytic(&analytic, setup.inverse, u) == s;
    }
    printf("\nAnalytic against table: 1 - cos(theta) of cos^%g, operations as "
           "above; what\nfollows, the azimuth and the root, is the same for "
           "both. Analytic: nothing to\nbuild, %.1f a sample, %.1f of them "
           "multiplications. Table: its cells need a power\neach and its "
           "prefix sums 3; a sample is a search and 4 divisions, which count\n"
           "1 (an instruction) or %d (none), and steps where the lobe does "
           "not.\n\n"
           "                    divisions count 1   divisions count %d\n"
           "  cells      build   sample  pays after   sample  pays after\n",
            setup.parameter, cost(&analytic, 1),
            (double)analytic.multiply / DRAWS, SLOW_DIVISION, SLOW_DIVISION);
    for (uint32_t n = 16; n <= ENTRIES_MAX; n *= 4) {
        same = compare_analytic(n, setup.parameter, &analytic) && same;
    }
    printf("counted copies against the core: %s\n",
            same ? "the same bits" : "DIFFER");
    return same;
}
