/* test_real.c - reciprocals, roots, sums within their bounds */
/* SPDX-License-Identifier: MIT */

#include <math.h>

#include "math/ql_real.h"
#include "support/ql_nasty.h"
#include "support/ql_stats.h"
#include "support/ql_table_error.h"
#include "support/ql_test.h"

/* Odd, so the mantissas that are tried differ in all their low bits. */
enum { STRIDE = (61 * QL_TEST_SHARE) | 1 };

#define ULP (1 / 4294967296.0) /* of u0.32 */

/* ---- Mantissas --------------------------------------------------------- */

static double recip_worst;

static void check_recip(uint32_t m)
{
    const uint32_t r = ql_recip_m(m);
    const double error = fabs((double)r - ldexp(1, 63) / m);

    recip_worst = fmax(recip_worst, error);
    CHECK(error <= 4, "ql_recip_m(%08lx) = %08lx, off by %.2f ulp",
            (unsigned long)m, (unsigned long)r, error);
    CHECK(r >= 0x80000000u, "ql_recip_m(%08lx) = %08lx lacks its top bit",
            (unsigned long)m, (unsigned long)r);
}

/* Where errors peak: both sides of each boundary of the table, and the ends. */
static void around_boundaries(void (*check)(uint32_t), uint32_t lowest)
{
    for (uint64_t cell = lowest; cell <= 0x100000000u; cell += 0x1000000u) {
        for (uint32_t i = 0; i < 2000; i++) {
            if (cell + i <= 0xffffffffu) {
                check((uint32_t)(cell + i));
            }
            if (cell > lowest + i) {
                check((uint32_t)(cell - 1 - i));
            }
        }
    }
}

TEST(reciprocal_of_a_mantissa_is_within_4_ulp)
{
    recip_worst = 0;
    for (uint64_t m = 0x80000000u; m <= 0xffffffffu; m += STRIDE) {
        check_recip((uint32_t)m);
    }
    around_boundaries(check_recip, 0x80000000u);
    NOTE("worst %.2f ulp", recip_worst);
}

/* What ql_recip_m() is, in 64-bit numbers: 2^24 / (2 i + 257) half up, then two
 * steps of Newton's method, each product cut. */
static uint32_t recip_by_steps(uint32_t m)
{
    const uint64_t by = 2 * ((m >> 24) - 128) + 257;
    const uint64_t entry = (((uint64_t)1 << 25) / by + 1) / 2;
    uint64_t r = entry << 16;

    r = (r * (4294967296u - (m * r >> 32)) >> 32) << 1;
    r = r * (4294967296u - (m * r >> 32)) >> 32;
    return r < 0x80000000u ? (uint32_t)(r << 1) : 0xffffffffu;
}

static void check_steps(uint32_t m)
{
    CHECK(ql_recip_m(m) == recip_by_steps(m),
            "ql_recip_m(%08lx) = %08lx, by its steps %08lx", (unsigned long)m,
            (unsigned long)ql_recip_m(m), (unsigned long)recip_by_steps(m));
}

/* So it is the same number of long code and of short. */
TEST(reciprocals_are_two_steps_from_the_nearest_entry)
{
    unsigned long count = 0;

    for (uint64_t m = 0x80000000u; m <= 0xffffffffu; m += 16 * STRIDE) {
        check_steps((uint32_t)m);
        count++;
    }
    around_boundaries(check_steps, 0x80000000u);
    NOTE("%lu and the ends of cells", count);
}

static double rsqrt_worst;

static void check_rsqrt(uint32_t m)
{
    const uint32_t r = ql_rsqrt_m(m);
    const double exact = ldexp(1, 47) / sqrt(m);
    const double error = fabs(r / exact - 1);

    rsqrt_worst = fmax(rsqrt_worst, error);
    CHECK(error <= RSQRT_ERROR, "ql_rsqrt_m(%08lx) = %08lx, off by %.3g",
            (unsigned long)m, (unsigned long)r, error);
}

TEST(reciprocal_root_of_a_mantissa_is_within_its_bound)
{
    rsqrt_worst = 0;
    for (uint64_t m = 0x40000000u; m <= 0xffffffffu; m += STRIDE) {
        check_rsqrt((uint32_t)m);
    }
    around_boundaries(check_rsqrt, 0x40000000u);
    NOTE("worst %.2e, bound %.2e", rsqrt_worst, RSQRT_ERROR);
}

/* ---- Square root ------------------------------------------------------- */

static double sqrt_worst;

static void check_sqrt(uint32_t x)
{
    const uint32_t r = ql_sqrt_uq32(x);
    const double exact = sqrt(x * ULP);
    const double error = fabs(r * ULP - exact);

    sqrt_worst = fmax(sqrt_worst, error);
    CHECK(error <= exact * WARP_ROOT_ERROR + 2 * ULP,
            "ql_sqrt_uq32(%08lx) = %08lx, off by %.3g", (unsigned long)x,
            (unsigned long)r, error);
}

TEST(square_root_is_within_its_bound)
{
    sqrt_worst = 0;
    for (uint32_t x = 0; x < MANY(1000000); x++) {
        check_sqrt(x);
        check_sqrt(0xffffffffu - x);
    }
    for (uint64_t x = 0; x <= 0xffffffffu; x += STRIDE) {
        check_sqrt((uint32_t)x);
    }
    for (unsigned k = 0; k < 32; k++) {
        check_sqrt((uint32_t)1 << k);
        check_sqrt(((uint32_t)1 << k) - 1);
    }
    NOTE("worst %.2e, absolute", sqrt_worst);
}

TEST(square_root_of_zero_is_zero)
{
    CHECK(ql_sqrt_uq32(0) == 0, "got %lu", (unsigned long)ql_sqrt_uq32(0));
}

/* ---- Reals ------------------------------------------------------------- */

/* m in [2^31, 2^32), or zero with nothing else set. */
static bool normal(ql_real_t r)
{
    return r.m >= 0x80000000u || r.m == 0;
}

static void check_from(uint64_t n)
{
    const ql_real_t r = ql_real_from_u64(n);
    const int e = r.e;
    uint64_t back;

    CHECK(normal(r) && (r.m == 0) == (n == 0), "of %llx",
            (unsigned long long)n);
    if (n == 0) {
        return;
    }
    /* cut, never raised; what was cut is below 2^-31 of the number */
    back = e >= 0 ? (uint64_t)r.m << e : (uint64_t)r.m >> -e;
    CHECK(back <= n && n - back <= n >> 31 &&
                    (e >= 0 || back << -e == (uint64_t)r.m),
            "%llx became %08lx 2^%d", (unsigned long long)n, (unsigned long)r.m,
            e);
}

TEST(whole_numbers_become_reals_cut_below_one_ulp)
{
    uint64_t state = 1;

    for (uint64_t n = 0; n < MANY(1000000); n++) {
        check_from(n);
        check_from(UINT64_MAX - n);
    }
    for (unsigned k = 0; k < 64; k++) {
        check_from((uint64_t)1 << k);
        check_from(((uint64_t)1 << k) - 1);
        check_from(((uint64_t)1 << k) + 1);
    }
    for (long i = 0; i < MANY(1000000); i++) {
        const uint64_t n = stats_random(&state);

        check_from(n >> (stats_random(&state) & 63u));
    }
}

static void check_mul(uint32_t a, uint32_t b)
{
    const ql_real_t x = {a, 5}, y = {b, -70};
    const ql_real_t r = ql_real_mul(x, y);
    const uint64_t exact = (uint64_t)a * b;
    const int shift = r.e - (5 - 70);

    if (a == 0 || b == 0) {
        CHECK(r.m == 0, "%08lx * %08lx is not zero", (unsigned long)a,
                (unsigned long)b);
    } else {
        const uint64_t back = (uint64_t)r.m << (shift == 32 ? 32 : 31);

        CHECK((shift == 31 || shift == 32) && r.m >= 0x80000000u &&
                        back <= exact && exact - back < exact >> 30,
                "%08lx * %08lx = %08lx 2^%d", (unsigned long)a,
                (unsigned long)b, (unsigned long)r.m, shift);
    }
}

TEST(products_of_reals_are_cut_below_two_ulp)
{
    uint64_t state = 2;

    for (size_t i = 0; i < NASTY_COUNT; i++) {
        check_mul(nasty32[i] | 0x80000000u, 0);
        check_mul(0, nasty32[i] | 0x80000000u);
        for (size_t j = 0; j < NASTY_COUNT; j++) {
            check_mul(nasty32[i] | 0x80000000u, nasty32[j] | 0x80000000u);
        }
    }
    check_mul(0, 0);
    for (long i = 0; i < MANY(2000000); i++) {
        const uint64_t bits = stats_random(&state);

        check_mul((uint32_t)bits | 0x80000000u,
                (uint32_t)(bits >> 32) | 0x80000000u);
    }
}

TEST(reciprocal_of_a_real_is_normal_and_of_zero_is_zero)
{
    const ql_real_t zero = {0, 0};
    uint64_t state = 3;

    CHECK(ql_real_recip(zero).m == 0, "1/0 has mantissa %08lx",
            (unsigned long)ql_real_recip(zero).m);
    for (long i = 0; i < MANY(1000000); i++) {
        const uint32_t m = (i < 65536 ? (uint32_t)i * 0x8000u + 0x80000000u
                                      : (uint32_t)stats_random(&state)) |
                           0x80000000u;
        const ql_real_t a = {m, (int16_t)(i % 200 - 100)};
        const ql_real_t r = ql_real_recip(a);
        const double one = ldexp((double)r.m * a.m, r.e + a.e);

        /* 4 of at least 2^31 */
        CHECK(r.m >= 0x80000000u && fabs(one - 1) <= 0x1p-29,
                "1/(%08lx 2^%d) = %08lx 2^%d", (unsigned long)m, a.e,
                (unsigned long)r.m, r.e);
    }
}

/* ---- Root, product, sum and difference of reals ------------------------ */

static long double value(ql_real_t a)
{
    return ldexpl(a.m, a.e);
}

static ql_real_t random_real(uint64_t *state, int below)
{
    const uint64_t bits = stats_random(state);
    ql_real_t a = {(uint32_t)bits | 0x80000000u, 0};

    a.e = (int16_t)((int)(bits >> 32) % (2 * below + 1) - below);
    return a;
}

/* Of a bit that may be cut and of rounding 2^-31; of one step from a root that
 * errs by E 1.5 E^2. */
#define REAL_ROOT_ERROR (QL_CFG_PRECISION == 0 ? 1.3e-9L : 4.7e-10L)

static long double root_worst;

static void check_real_root(uint32_t m, int16_t e)
{
    const ql_real_t a = {m, e};
    const ql_real_t r = ql_real_sqrt(a);
    const long double error = fabsl(value(r) / sqrtl(value(a)) - 1);

    root_worst = fmaxl(root_worst, error);
    CHECK(r.m >= 0x80000000u && error <= REAL_ROOT_ERROR,
            "sqrt(%08lx 2^%d) = %08lx 2^%d, off by %.3Lg", (unsigned long)m, e,
            (unsigned long)r.m, r.e, error);
}

TEST(square_root_of_a_real_is_within_its_bound)
{
    const ql_real_t zero = {0, 5};

    root_worst = 0;
    CHECK(ql_real_sqrt(zero).m == 0, "sqrt(0) is not 0");
    for (uint64_t m = 0x80000000u; m <= 0xffffffffu; m += 16 * STRIDE) {
        check_real_root((uint32_t)m, -32);
        check_real_root((uint32_t)m, -31);
    }
    for (uint32_t cell = 0x80000000u; cell != 0; cell += 0x800000u) {
        for (uint32_t i = 0; i < 500; i++) {
            check_real_root(cell + i, 0);
            check_real_root(cell + i, 1);
            check_real_root((cell - 1 - i) | 0x80000000u, -64);
            check_real_root((cell - 1 - i) | 0x80000000u, -65);
        }
    }
    for (int16_t e = -1000; e <= 1000; e++) {
        check_real_root(0x80000000u, e);
        check_real_root(0xffffffffu, e);
        check_real_root(0x9e3779b9u, e);
    }
    NOTE("worst %.2Le, bound %.2Le", root_worst, REAL_ROOT_ERROR);
}

/* The high word of the product, a bit further up if its top bit is not set: so
 * it is the same number of long code and of short. The same of the mantissa of
 * a whole number, and of the reciprocal's exponent. */
TEST(products_and_whole_numbers_have_every_bit_of_their_formula)
{
    uint64_t state = 9;

    for (long i = 0; i < MANY(200000); i++) {
        const ql_real_t a = random_real(&state, 90);
        const ql_real_t b = random_real(&state, 90);
        const uint64_t n = stats_random(&state) >> (i & 63);
        const uint32_t high = (uint32_t)((uint64_t)a.m * b.m >> 32);
        const int short_by = high < 0x80000000u;
        const ql_real_t r = ql_real_mul(a, b), inverse = ql_real_recip(a);
        const ql_real_t whole = ql_real_from_u64(n);
        int zeros = 0;

        while (n != 0 && n << zeros >> 63 == 0) {
            zeros++;
        }
        CHECK(r.m == high << short_by && r.e == a.e + b.e + 32 - short_by,
                "%08lx 2^%d * %08lx 2^%d", (unsigned long)a.m, a.e,
                (unsigned long)b.m, b.e);
        CHECK(inverse.m == recip_by_steps(a.m) && inverse.e == -63 - a.e,
                "1 / %08lx 2^%d", (unsigned long)a.m, a.e);
        CHECK(whole.m == (uint32_t)(n << zeros >> 32) &&
                        (n == 0 || whole.e == 32 - zeros),
                "of %016llx", (unsigned long long)n);
    }
}

TEST(products_and_quotients_as_calls_are_the_same)
{
    const ql_real_t zero = {0, 0};
    uint64_t state = 7;
    long double worst = 0;

    for (long i = 0; i < MANY(500000); i++) {
        const ql_real_t a = random_real(&state, 90);
        const ql_real_t b = random_real(&state, 90);
        const ql_real_t product = ql_real_mul(a, b);
        const ql_real_t called = ql_real_mul_call(a, b);
        const ql_real_t ratio = ql_real_div(a, b);
        const long double error =
                fabsl(value(ratio) / (value(a) / value(b)) - 1);

        worst = fmaxl(worst, error);
        CHECK(product.m == called.m && product.e == called.e, "%Lg * %Lg",
                value(a), value(b));
        CHECK(normal(ratio) && error <= 0x1p-28L, "%Lg / %Lg: off by %.3Lg",
                value(a), value(b), error);
        CHECK(ql_real_div(a, zero).m == 0 && ql_real_div(zero, a).m == 0,
                "%Lg and 0", value(a));
    }
    NOTE("worst %.2Le, bound %.2e", worst, 0x1p-28);
}

TEST(sums_of_reals_are_within_2_to_the_minus_30)
{
    const ql_real_t zero = {0, 90};
    uint64_t state = 4;
    long double worst = 0;

    for (long i = 0; i < MANY(1000000); i++) {
        const ql_real_t a = random_real(&state, 20);
        const ql_real_t b = random_real(&state, i & 1 ? 20 : 60);
        const ql_real_t r = ql_real_add(a, b);
        const long double error = value(r) / (value(a) + value(b)) - 1;

        worst = fminl(worst, error);
        CHECK(normal(r) && error <= 0 && error > -0x1p-30L, "%Lg + %Lg: %Lg",
                value(a), value(b), error);
        CHECK(value(ql_real_add(a, zero)) == value(a) &&
                        value(ql_real_add(zero, a)) == value(a),
                "%Lg + 0", value(a));
    }
    CHECK(ql_real_add(zero, zero).m == 0, "0 + 0");
    NOTE("worst %.2Le", worst);
}

TEST(differences_of_reals_are_within_an_ulp_of_the_first)
{
    const ql_real_t zero = {0, 90};
    uint64_t state = 5;

    for (long i = 0; i < MANY(1000000); i++) {
        const ql_real_t a = random_real(&state, 20);
        ql_real_t b = random_real(&state, i & 1 ? 20 : 60);
        long double exact, got;

        if (i % 4 == 3) { /* nearly equal */
            b = a;
            b.m ^= (uint32_t)(i & 0xffff);
        }
        exact = fmaxl(value(a) - value(b), 0);
        got = value(ql_real_sub(a, b));
        CHECK(normal(ql_real_sub(a, b)) && got >= exact &&
                        got - exact <= 0x1p-31L * value(a),
                "%Lg - %Lg = %Lg", value(a), value(b), got);
        CHECK(value(ql_real_sub(a, zero)) == value(a) &&
                        ql_real_sub(zero, a).m == 0 && ql_real_sub(a, a).m == 0,
                "%Lg and 0", value(a));
    }
}

TEST(midpoints_are_exact_below_a_half_and_cut_above)
{
    uint64_t state = 6;

    for (long i = 0; i < MANY(1000000); i++) {
        const uint64_t bits = stats_random(&state);
        const uint32_t u = i < 1000   ? (uint32_t)i
                           : i < 2000 ? 0u - (uint32_t)(i - 999)
                                      : (uint32_t)bits >> (bits >> 32 & 31);
        const ql_real_t a = ql_real_midpoint(u);
        const long double exact = ldexpl(u + 0.5L, -32);

        CHECK(a.m >= 0x80000000u &&
                        (u < 0x80000000u ? value(a) == exact
                                         : value(a) == exact - 0x1p-33L),
                "%08lx", (unsigned long)u);
        CHECK(ql_real_to_uq32(a) == u, "%08lx back", (unsigned long)u);
    }
}

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_real", argc, argv);
    RUN(reciprocal_of_a_mantissa_is_within_4_ulp);
    RUN(reciprocals_are_two_steps_from_the_nearest_entry);
    RUN(reciprocal_root_of_a_mantissa_is_within_its_bound);
    RUN(square_root_is_within_its_bound);
    RUN(square_root_of_zero_is_zero);
    RUN(whole_numbers_become_reals_cut_below_one_ulp);
    RUN(products_of_reals_are_cut_below_two_ulp);
    RUN(reciprocal_of_a_real_is_normal_and_of_zero_is_zero);
    RUN(square_root_of_a_real_is_within_its_bound);
    RUN(products_and_whole_numbers_have_every_bit_of_their_formula);
    RUN(products_and_quotients_as_calls_are_the_same);
    RUN(sums_of_reals_are_within_2_to_the_minus_30);
    RUN(differences_of_reals_are_within_an_ulp_of_the_first);
    RUN(midpoints_are_exact_below_a_half_and_cut_above);
    return TEST_END();
}
