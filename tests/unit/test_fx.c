/* test_fx.c - shifts, products and reinterpretation against wide arithmetic */
/* SPDX-License-Identifier: MIT */

#include <math.h>

#include "math/ql_fx.h"
#include "support/ql_nasty.h"
#include "support/ql_stats.h"
#include "support/ql_test.h"

/* The products put together from halves, under names of their own, so that
 * every build tries both. */
#if QL_PORT_WIDE_MUL
#define ql_mulhi_u32         halves_mulhi_u32
#define ql_mulhi_u32_rounded halves_mulhi_u32_rounded
#define ql_mulhi_su32        halves_mulhi_su32
#define ql_product_u32       halves_product_u32
#define ql_mul_uq31          halves_mul_uq31
#define ql_dot_s16_s32       halves_dot_s16_s32
#undef QL_FX_INLINE
#include "math/ql_fx_halves.h"
#undef ql_mulhi_u32
#undef ql_mulhi_u32_rounded
#undef ql_mulhi_su32
#undef ql_product_u32
#undef ql_mul_uq31
#undef ql_dot_s16_s32
#else
#define halves_mulhi_u32         ql_mulhi_u32
#define halves_mulhi_u32_rounded ql_mulhi_u32_rounded
#define halves_mulhi_su32        ql_mulhi_su32
#define halves_product_u32       ql_product_u32
#define halves_mul_uq31          ql_mul_uq31
#define halves_dot_s16_s32       ql_dot_s16_s32
#endif

enum { RANDOM_PAIRS = MANY(2000000) };

static uint64_t state;

static uint32_t random32(void)
{
    return (uint32_t)(stats_random(&state) >> 32);
}

/* floor(x / 2^n) by division, which truncates. */
static int64_t floor_shift(int64_t x, unsigned n)
{
    if (n == 63) {
        return x < 0 ? -1 : 0;
    } else {
        const int64_t by = (int64_t)1 << n;

        return x / by - (x % by < 0);
    }
}

TEST(bits_read_as_signed_keep_their_value_modulo_2_to_n)
{
    for (uint32_t bits = 0; bits <= 0xffffu; bits++) {
        const int32_t expected =
                bits < 0x8000u ? (int32_t)bits : (int32_t)bits - 65536;

        CHECK(ql_i16((uint16_t)bits) == expected, "ql_i16(%04lx) = %d",
                (unsigned long)bits, ql_i16((uint16_t)bits));
    }
    for (size_t i = 0; i < NASTY_COUNT; i++) {
        for (size_t j = 0; j < NASTY_COUNT; j++) {
            const uint32_t a = nasty32[i];
            const uint64_t w = (uint64_t)a << 32 | nasty32[j];

            CHECK((uint32_t)ql_i32(a) == a && (ql_i32(a) < 0) == (a >> 31),
                    "ql_i32(%08lx)", (unsigned long)a);
            CHECK((uint64_t)ql_i64(w) == w && (ql_i64(w) < 0) == (a >> 31),
                    "ql_i64(%08lx %08lx)", (unsigned long)a,
                    (unsigned long)nasty32[j]);
        }
    }
    NOTE("all of 16 bits, %u nasty words", (unsigned)NASTY_COUNT);
}

TEST(arithmetic_shifts_round_towards_minus_infinity)
{
    for (size_t i = 0; i < NASTY_COUNT; i++) {
        const int32_t a = ql_i32(nasty32[i]);

        for (unsigned n = 0; n < 32; n++) {
            CHECK(ql_asr32(a, n) == floor_shift(a, n), "%ld >> %u = %ld",
                    (long)a, n, (long)ql_asr32(a, n));
        }
        for (size_t j = 0; j < NASTY_COUNT; j++) {
            const int64_t w = ql_i64((uint64_t)nasty32[i] << 32 | nasty32[j]);

            for (unsigned n = 0; n < 64; n++) {
                CHECK(ql_asr64(w, n) == floor_shift(w, n), "%lld >> %u = %lld",
                        (long long)w, n, (long long)ql_asr64(w, n));
            }
        }
    }
}

TEST(leading_zeros_are_counted_at_every_bit)
{
    CHECK(ql_clz32(0) == 32, "ql_clz32(0) = %u", ql_clz32(0));
    CHECK(ql_clz64(0) == 64, "ql_clz64(0) = %u", ql_clz64(0));
    for (unsigned k = 0; k < 64; k++) {
        const uint64_t bit = (uint64_t)1 << k;

        CHECK(ql_clz64(bit) == 63 - k, "ql_clz64(2^%u)", k);
        CHECK(ql_clz64(bit | (bit - 1)) == 63 - k, "ql_clz64(2^%u + ..)", k);
        if (k < 32) {
            CHECK(ql_clz32((uint32_t)bit) == 31 - k, "ql_clz32(2^%u)", k);
            CHECK(ql_clz32((uint32_t)(2 * bit - 1)) == 31 - k,
                    "ql_clz32(2^%u - 1)", k + 1);
        }
    }
}

TEST(absolute_values_are_defined_for_the_smallest_number_too)
{
    for (size_t i = 0; i < NASTY_COUNT; i++) {
        const int32_t a = ql_i32(nasty32[i]);
        const int64_t wide = a;
        const uint64_t w = (uint64_t)nasty32[i] << 32;

        CHECK(ql_abs32(a) == (uint64_t)(wide < 0 ? -wide : wide), "|%ld|",
                (long)a);
        CHECK(ql_abs64(ql_i64(w)) == (uint64_t)ql_abs32(a) << 32, "|%lld|",
                (long long)ql_i64(w));
    }
    CHECK(ql_abs64(INT64_MIN) == (uint64_t)1 << 63, "of INT64_MIN");
}

/* By one file, or by the other. */
typedef struct {
    const char *by;
    uint32_t high, rounded, unit;
    int32_t high_signed;
    uint64_t whole;
} products_t;

static void check_products_by(products_t p, uint32_t a, uint32_t b)
{
    const uint64_t uu = (uint64_t)a * b;
    const int64_t su = (int64_t)ql_i32(a) * (int64_t)b;
    /* a b + 2^30 can need 65 bits: halve first, which drops no bit of >> 31 */
    const uint64_t half = (uu >> 1) + 0x20000000u;

    CHECK(p.high == uu >> 32, "%s: ql_mulhi_u32(%08lx, %08lx)", p.by,
            (unsigned long)a, (unsigned long)b);
    CHECK(p.rounded == (uu >> 32) + (uu >> 31 & 1),
            "%s: ql_mulhi_u32_rounded(%08lx, %08lx)", p.by, (unsigned long)a,
            (unsigned long)b);
    CHECK(p.whole == uu, "%s: ql_product_u32(%08lx, %08lx)", p.by,
            (unsigned long)a, (unsigned long)b);
    CHECK(p.high_signed == floor_shift(su, 32),
            "%s: ql_mulhi_su32(%ld, %08lx) = %ld", p.by, (long)ql_i32(a),
            (unsigned long)b, (long)p.high_signed);
    CHECK(p.unit == (uint32_t)(half >> 30),
            "%s: ql_mul_uq31(%08lx, %08lx) = %08lx, not %08lx", p.by,
            (unsigned long)a, (unsigned long)b, (unsigned long)p.unit,
            (unsigned long)(uint32_t)(half >> 30));
}

static void check_products(uint32_t a, uint32_t b)
{
    const products_t built = {"as built", ql_mulhi_u32(a, b),
            ql_mulhi_u32_rounded(a, b), ql_mul_uq31(a, b),
            ql_mulhi_su32(ql_i32(a), b), ql_product_u32(a, b)};
    const products_t halves = {"by halves", halves_mulhi_u32(a, b),
            halves_mulhi_u32_rounded(a, b), halves_mul_uq31(a, b),
            halves_mulhi_su32(ql_i32(a), b), halves_product_u32(a, b)};

    check_products_by(built, a, b);
    check_products_by(halves, a, b);
}

/* 64-bit numbers of every size times all nasty 16-bit ones. */
TEST(products_with_16_bits_wrap_as_64_bit_ones)
{
    static const uint16_t by[] = {
            0, 1, 2, 3, 255, 256, 21845, 32767, 32768, 43690, 65534, 65535};
    unsigned long count = 0;

    for (size_t k = 0; k < sizeof by / sizeof by[0]; k++) {
        for (size_t i = 0; i < NASTY_COUNT * NASTY_COUNT; i++) {
            const uint64_t a = (uint64_t)nasty32[i % NASTY_COUNT] << 32 |
                               nasty32[i / NASTY_COUNT];

            CHECK((uint64_t)ql_mul_s64_u16(ql_i64(a), by[k]) == a * by[k],
                    "%016llx * %u", (unsigned long long)a, by[k]);
            count++;
        }
    }
    NOTE("%lu products", count);
}

TEST(products_equal_64_bit_ones_for_all_nasty_pairs)
{
    for (size_t i = 0; i < NASTY_COUNT; i++) {
        for (size_t j = 0; j < NASTY_COUNT; j++) {
            check_products(nasty32[i], nasty32[j]);
        }
    }
    NOTE("%u pairs, wide multiplication %d",
            (unsigned)(NASTY_COUNT * NASTY_COUNT), QL_PORT_WIDE_MUL);
}

TEST(products_equal_64_bit_ones_for_random_pairs)
{
    state = 1;
    for (long i = 0; i < RANDOM_PAIRS; i++) {
        const uint32_t a = random32();

        check_products(a, random32());
    }
    NOTE("%d pairs", RANDOM_PAIRS);
}

TEST(unit_products_keep_zero_and_one_exactly)
{
    for (size_t i = 0; i < NASTY_COUNT; i++) {
        const uint32_t a = nasty32[i];

        CHECK(ql_mul_uq31(a, QL_UQ31_ONE) == a, "%08lx * 1", (unsigned long)a);
        CHECK(ql_mul_uq31(QL_UQ31_ONE, a) == a, "1 * %08lx", (unsigned long)a);
        CHECK(ql_mul_uq31(a, 0) == 0, "%08lx * 0", (unsigned long)a);
    }
}

/* Mean rounding error in ulp, of the product itself or of a truncating one. */
static double mean_error(bool truncate)
{
    double sum = 0;

    state = 2;
    for (long i = 0; i < RANDOM_PAIRS; i++) {
        const uint32_t a = random32() >> 1, b = random32() >> 1;
        const uint64_t exact = (uint64_t)a * b;
        const uint32_t got =
                truncate ? (uint32_t)(exact >> 31) : ql_mul_uq31(a, b);

        sum += got - (double)(exact >> 31) -
               ldexp((double)(exact & 0x7fffffffu), -31);
    }
    return sum / RANDOM_PAIRS;
}

/* The error of one product is uniform in +-1/2 ulp: sigma = 1/sqrt(12). */
#define MEAN_ERROR_LIMIT (STATS_Z_MAX / sqrt(12.0 * RANDOM_PAIRS))

TEST(unit_products_round_without_bias)
{
    CHECK(fabs(mean_error(false)) < MEAN_ERROR_LIMIT, "mean %g ulp, limit %g",
            mean_error(false), MEAN_ERROR_LIMIT);
    NOTE("mean error %.1e ulp", mean_error(false));
}

TEST(unit_products_that_truncate_are_rejected)
{
    CHECK(fabs(mean_error(true)) > MEAN_ERROR_LIMIT, "mean %g ulp",
            mean_error(true));
    NOTE("mean error %.2f ulp", mean_error(true));
}

/* The widest dot product that the header promises to be exact. */
#define DOT_LIMIT ((int64_t)1 << 47)

TEST(dot_products_of_16_and_32_bit_vectors_are_exact)
{
    static const int32_t short_nasty[] = {-32768, -32767, -32766, -16384, -257,
            -2, -1, 0, 1, 3, 255, 4096, 32766, 32767};
    const size_t n = sizeof short_nasty / sizeof short_nasty[0];
    unsigned long count = 0;

    state = 3;
    for (size_t i = 0; i < n * n * n; i++) {
        const int32_t ax = short_nasty[i % n], ay = short_nasty[i / n % n];
        const int32_t az = short_nasty[i / n / n];

        for (unsigned j = 0; j < 600; j++) {
            const bool ends = j < 27; /* all triples of the two ends and 0 */
            const uint32_t end[3] = {0x80000000u, 0x7fffffffu, 0};
            const int32_t bx = ql_i32(
                    ends ? end[j % 3] : nasty32[random32() % NASTY_COUNT]);
            const int32_t by = ql_i32(
                    ends ? end[j / 3 % 3] : nasty32[random32() % NASTY_COUNT]);
            const int32_t bz = ql_i32(ends ? end[j / 9] : random32());
            const int64_t exact =
                    (int64_t)ax * bx + (int64_t)ay * by + (int64_t)az * bz;

            if (exact <= -DOT_LIMIT || exact >= DOT_LIMIT) {
                continue;
            }
            count++;
            CHECK(halves_dot_s16_s32(ax, ay, az, bx, by, bz) == exact,
                    "by halves: (%ld %ld %ld).(%ld %ld %ld)", (long)ax,
                    (long)ay, (long)az, (long)bx, (long)by, (long)bz);
            CHECK(ql_dot_s16_s32(ax, ay, az, bx, by, bz) == exact,
                    "(%ld %ld %ld).(%ld %ld %ld) = %lld, not %lld", (long)ax,
                    (long)ay, (long)az, (long)bx, (long)by, (long)bz,
                    (long long)ql_dot_s16_s32(ax, ay, az, bx, by, bz),
                    (long long)exact);
        }
    }
    NOTE("%lu pairs of vectors", count);
}

TEST(long_division_by_16_bits_equals_64_bit_division)
{
    static const uint16_t by[] = {
            1, 2, 3, 7, 255, 256, 257, 1080, 16384, 32767, 32768, 65534, 65535};
    unsigned long count = 0;

    state = 4;
    for (size_t k = 0; k < sizeof by / sizeof by[0]; k++) {
        for (long i = 0; i < MANY(200000); i++) {
            const bool nasty = i < (long)(NASTY_COUNT * NASTY_COUNT);
            const uint64_t bits =
                    nasty ? (uint64_t)nasty32[(size_t)i % NASTY_COUNT] << 32 |
                                    nasty32[(size_t)i / NASTY_COUNT]
                          : stats_random(&state) >> (i & 63);
            const int64_t a = ql_i64(bits);

            count++;
            CHECK(ql_div_s64_u16(a, by[k]) == a / by[k], "%lld / %u = %lld",
                    (long long)a, by[k], (long long)ql_div_s64_u16(a, by[k]));
        }
    }
    NOTE("%lu quotients", count);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_fx", argc, argv);
    RUN(bits_read_as_signed_keep_their_value_modulo_2_to_n);
    RUN(arithmetic_shifts_round_towards_minus_infinity);
    RUN(leading_zeros_are_counted_at_every_bit);
    RUN(absolute_values_are_defined_for_the_smallest_number_too);
    RUN(products_equal_64_bit_ones_for_all_nasty_pairs);
    RUN(products_equal_64_bit_ones_for_random_pairs);
    RUN(products_with_16_bits_wrap_as_64_bit_ones);
    RUN(unit_products_keep_zero_and_one_exactly);
    RUN(unit_products_round_without_bias);
    RUN(unit_products_that_truncate_are_rejected);
    RUN(dot_products_of_16_and_32_bit_vectors_are_exact);
    RUN(long_division_by_16_bits_equals_64_bit_division);
    return TEST_END();
}
