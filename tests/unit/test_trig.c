/* test_trig.c - sines, cosines, arc tangents against double and better */
/* SPDX-License-Identifier: MIT */

#include <math.h>

#include "math/lut/ql_lut.h"
#include "math/ql_trig.h"
#include "support/ql_nasty.h"
#include "support/ql_stats.h"
#include "support/ql_table_error.h"
#include "support/ql_test.h"

#define BOUND SINE_ERROR
#define ONE   (1l << 30)

static const double turn_rad = 6.283185307179586 / 4294967296.0;
static double worst, worst_circle;

static void check(ql_turn32_t turn)
{
    int32_t sine, cosine;
    double s, c, error, circle;

    ql_sincos(turn, &sine, &cosine);
    s = ldexp(sine, -30);
    c = ldexp(cosine, -30);
    error = fmax(
            fabs(s - sin(turn * turn_rad)), fabs(c - cos(turn * turn_rad)));
    circle = fabs(s * s + c * c - 1);
    worst = fmax(worst, error);
    worst_circle = fmax(worst_circle, circle);
    CHECK(error <= BOUND, "turn %08lx: sine %.9f, cosine %.9f, off by %.3g",
            (unsigned long)turn, s, c, error);
    CHECK(fabs(s) <= 1 + BOUND && fabs(c) <= 1 + BOUND,
            "turn %08lx: sine %ld, cosine %ld, beyond 2^30",
            (unsigned long)turn, (long)sine, (long)cosine);
    /* |(s + ds)^2 + (c + dc)^2 - 1| <= 2 (|s| + |c|) bound, |s| + |c| < 1.42 */
    CHECK(circle <= 2.85 * BOUND, "turn %08lx: s^2 + c^2 - 1 = %.3g",
            (unsigned long)turn, circle);
}

TEST(sine_and_cosine_are_within_their_bound)
{
    worst = 0;
    for (uint32_t i = 0; i < 65536; i++) {
        check(i << 16);
        check((i << 16) + 1);
        check((i << 16) - 1);
        check((i << 16) + 0x7fffu);
    }
    for (uint64_t i = 0; i <= 0xffffffffu; i += STRIDE(2053)) {
        check((uint32_t)i);
    }
    NOTE("worst %.2e, bound %.1e; 2.3 million angles", worst, BOUND);
}

/* The error peaks halfway between two angles of the table, where the nearest
 * one changes. */
TEST(no_angle_halfway_between_table_entries_exceeds_the_bound)
{
    const uint32_t cell = (uint32_t)1 << (30 - QL_SIN_BITS);

    worst = 0;
    for (uint32_t i = 0; i < 4u << QL_SIN_BITS; i++) {
        for (uint32_t k = 0; k < 200; k++) {
            check(i * cell + cell / 2 + k);
            check(i * cell + cell / 2 - 1 - k);
            check(i * cell + k);
            check(i * cell - k);
        }
    }
    NOTE("worst %.2e", worst);
}

TEST(points_lie_on_the_unit_circle)
{
    worst_circle = 0;
    for (uint64_t i = 0; i <= 0xffffffffu; i += STRIDE(4099)) {
        check((uint32_t)i);
    }
    NOTE("worst %.2e", worst_circle);
}

TEST(quarter_turns_are_exact)
{
    static const int32_t quarter[5] = {0, ONE, 0, -ONE, 0};

    for (uint32_t i = 0; i < 4; i++) {
        int32_t sine, cosine;

        ql_sincos(i << 30, &sine, &cosine);
        CHECK(sine == quarter[i] && cosine == quarter[i + 1],
                "%lu quarters: %ld, %ld", (unsigned long)i, (long)sine,
                (long)cosine);
    }
}

TEST(a_quarter_turn_more_swaps_sine_and_cosine_exactly)
{
    for (uint64_t i = 0; i <= 0xffffffffu; i += STRIDE(65537)) {
        int32_t s0, c0, s1, c1;

        ql_sincos((uint32_t)i, &s0, &c0);
        ql_sincos((uint32_t)i + 0x40000000u, &s1, &c1);
        CHECK(s1 == c0 && c1 == -s0, "turn %08lx", (unsigned long)i);
    }
}

/* ---- Real sine and arc tangent ----------------------------------------- */

static const long double pi = 3.14159265358979323846264338327950288L;

static long double value(ql_real_t a)
{
    return ldexpl(a.m, a.e);
}

static ql_real_t real_of(uint32_t m, int e)
{
    const ql_real_t r = {m, (int16_t)e};

    return r;
}

static bool normal(ql_real_t a)
{
    return a.m >= 0x80000000u || a.m == 0;
}

static long double worst_small, worst_large;

static void check_sin(ql_real_t x)
{
    const ql_real_t r = ql_real_sin(x);
    const long double exact = value(x) >= pi ? 0 : sinl(value(x));
    const long double error = fabsl(value(r) - exact);

    if (value(x) <= pi / 2) {
        worst_small = fmaxl(worst_small, error / exact);
        CHECK(normal(r) && error <= exact * 0x1p-28L,
                "sin %.12Lg: off by %.3Lg of itself", value(x), error / exact);
    } else {
        worst_large = fmaxl(worst_large, error);
        CHECK(normal(r) && error <= 0x1p-29L, "sin %.12Lg: off by %.3Lg",
                value(x), error);
    }
}

TEST(real_sines_keep_the_bits_of_small_angles)
{
    const uint32_t middle = 0xc90fdaa2u; /* pi / 4, / 2, / 1 */

    worst_small = worst_large = 0;
    for (uint64_t m = 0x80000000u; m <= 0xffffffffu; m += STRIDE(9973)) {
        check_sin(real_of((uint32_t)m, -30));
        check_sin(real_of((uint32_t)m, -31));
        check_sin(real_of((uint32_t)m, -32));
        check_sin(real_of((uint32_t)m, -33 - (int)(m % 60)));
    }
    for (uint32_t i = 0; i < 1000; i++) {
        check_sin(real_of(middle - i, -31));
        check_sin(real_of(middle + i, -31));
        check_sin(real_of(middle - i, -30));
        check_sin(real_of(middle + i, -30));
    }
    CHECK(ql_real_sin(real_of(0, 0)).m == 0, "sin 0");
    CHECK(ql_real_sin(real_of(0x80000000u, 100)).m == 0, "sin of 2^131");
    NOTE("worst %.2Le relative, %.2Le above pi/2", worst_small, worst_large);
}

static void check_atan(ql_real_t a)
{
    const ql_real_t r = ql_real_atan(a);
    const long double error = fabsl(value(r) / atanl(value(a)) - 1);

    worst_small = fmaxl(worst_small, error);
    CHECK(normal(r) && error <= 0x1p-28L, "atan %.12Lg: off by %.3Lg of itself",
            value(a), error);
}

TEST(real_arc_tangents_are_within_2_to_the_minus_28)
{
    worst_small = 0;
    for (uint64_t m = 0x80000000u; m <= 0xffffffffu; m += STRIDE(9973)) {
        check_atan(real_of((uint32_t)m, -30));
        check_atan(real_of((uint32_t)m, -31));
        check_atan(real_of((uint32_t)m, -32));
        check_atan(real_of((uint32_t)m, -33));
        check_atan(real_of((uint32_t)m, -34));
        check_atan(real_of((uint32_t)m, 100 - (int)(m % 200)));
    }
    for (uint32_t i = 0; i < 1000; i++) {
        check_atan(real_of(0xffffffffu - i, -32));
        check_atan(real_of(0x80000000u + i, -31));
    }
    CHECK(ql_real_atan(real_of(0, 0)).m == 0, "atan 0");
    NOTE("worst %.2Le, bound %.2e", worst_small, 0x1p-28);
}

/* ---- The angle of a point ---------------------------------------------- */

static void check_atan2(int32_t y, int32_t x)
{
    const ql_turn32_t got = ql_atan2(y, x);
    const long double exact = ldexpl(atan2l(y, x) / (2 * pi), 32);
    const long double off = remainderl(got - exact, 0x1p32L);

    worst_small = fmaxl(worst_small, fabsl(off));
    CHECK(fabsl(off) <= 4, "atan2(%ld, %ld) = %08lx, off by %.2Lf of 2^-32",
            (long)y, (long)x, (unsigned long)got, off);
}

TEST(angles_of_points_are_within_2_to_the_minus_30_of_a_turn)
{
    uint64_t state = 1;

    worst_small = 0;
    for (size_t i = 0; i < NASTY_COUNT; i++) {
        for (size_t j = 0; j < NASTY_COUNT; j++) {
            check_atan2(ql_i32(nasty32[i]), ql_i32(nasty32[j]));
        }
    }
    for (int32_t y = -300; y <= 300; y++) {
        for (int32_t x = -300; x <= 300; x++) {
            if (x != 0 || y != 0) {
                check_atan2(y, x);
            }
        }
    }
    for (long i = 0; i < MANY(1000000); i++) {
        const uint64_t bits = stats_random(&state);
        const unsigned down = (unsigned)stats_random_below(&state, 1024);

        check_atan2(ql_asr32(ql_i32((uint32_t)bits), down & 31),
                ql_asr32(ql_i32((uint32_t)(bits >> 32)), down >> 5));
    }
    /* a fine circle, and both sides of every diagonal and axis */
    for (uint32_t i = 0; i < MANY(400000); i++) {
        const double angle = ldexp(i * 10737u + 0.5, -32) * 2 * (double)pi;

        check_atan2((int32_t)lrint(ldexp(sin(angle), 30)),
                (int32_t)lrint(ldexp(cos(angle), 30)));
    }
    for (int32_t i = -1000; i <= 1000; i++) {
        check_atan2((1 << 30) + i, 1 << 30);
        check_atan2((1 << 30) + i, -(1 << 30));
        check_atan2(-(1 << 30) + i, 1 << 30);
        check_atan2(-(1 << 30) + i, -(1 << 30));
        check_atan2(i, INT32_MIN);
        check_atan2(INT32_MIN, i);
        check_atan2(i, INT32_MAX);
        check_atan2(INT32_MAX, i);
    }
    NOTE("worst %.2Lf of 2^-32 turn, bound 4", worst_small);
}

TEST(the_axes_have_exact_angles_and_the_origin_has_0)
{
    static const int32_t sizes[] = {1, 2, 3, 1000, 1 << 30, INT32_MAX};

    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        const int32_t r = sizes[i];

        CHECK(ql_atan2(0, r) == 0 && ql_atan2(r, 0) == 0x40000000u &&
                        ql_atan2(0, -r) == 0x80000000u &&
                        ql_atan2(-r, 0) == 0xc0000000u,
                "size %ld", (long)r);
    }
    CHECK(ql_atan2(0, INT32_MIN) == 0x80000000u &&
                    ql_atan2(INT32_MIN, 0) == 0xc0000000u &&
                    ql_atan2(0, 0) == 0,
            "the ends and the origin");
}

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_trig", argc, argv);
    RUN(sine_and_cosine_are_within_their_bound);
    RUN(no_angle_halfway_between_table_entries_exceeds_the_bound);
    RUN(points_lie_on_the_unit_circle);
    RUN(quarter_turns_are_exact);
    RUN(a_quarter_turn_more_swaps_sine_and_cosine_exactly);
    RUN(real_sines_keep_the_bits_of_small_angles);
    RUN(real_arc_tangents_are_within_2_to_the_minus_28);
    RUN(angles_of_points_are_within_2_to_the_minus_30_of_a_turn);
    RUN(the_axes_have_exact_angles_and_the_origin_has_0);
    return TEST_END();
}
