/* test_trig.c - sine and cosine over the whole turn against double */
/* SPDX-License-Identifier: MIT */

#include <math.h>

#include "math/ql_lut.h"
#include "math/ql_trig.h"
#include "ql_test.h"

#define BOUND (QL_CFG_PRECISION == 0 ? 2.0e-5 : 4.2e-8)
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
    for (uint64_t i = 0; i <= 0xffffffffu; i += 2053) {
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
    for (uint64_t i = 0; i <= 0xffffffffu; i += 4099) {
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
    for (uint64_t i = 0; i <= 0xffffffffu; i += 65537) {
        int32_t s0, c0, s1, c1;

        ql_sincos((uint32_t)i, &s0, &c0);
        ql_sincos((uint32_t)i + 0x40000000u, &s1, &c1);
        CHECK(s1 == c0 && c1 == -s0, "turn %08lx", (unsigned long)i);
    }
}

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_trig", argc, argv);
    RUN(sine_and_cosine_are_within_their_bound);
    RUN(no_angle_halfway_between_table_entries_exceeds_the_bound);
    RUN(points_lie_on_the_unit_circle);
    RUN(quarter_turns_are_exact);
    RUN(a_quarter_turn_more_swaps_sine_and_cosine_exactly);
    return TEST_END();
}
