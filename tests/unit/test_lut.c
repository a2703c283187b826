/* test_lut.c - every table entry is the nearest number to its function */
/* SPDX-License-Identifier: MIT */

/* tests/tools/test_lut.sh compares the file with what qlux-lut writes; here
 * each entry is derived again without the tool. */

#include <math.h>

#include "math/lut/ql_lut.h"
#include "support/ql_test.h"

/* Half a unit, and what double may err: far less than any entry's distance
 * from a tie. */
#define NEAREST (0.5 + 1e-5)

static void check(const char *table, unsigned i, double entry, double exact)
{
    CHECK(fabs(entry - exact) <= NEAREST, "%s[%u] = %.0f, not %.3f", table, i,
            entry, exact);
}

TEST(sine_entries_are_nearest)
{
    for (unsigned i = 0; i <= QL_SIN_CELLS; i++) {
        check("ql_lut_sin", i, ql_lut_sin[i],
                ldexp(sin(acos(0.0) * i / QL_SIN_CELLS), 30));
    }
    CHECK(ql_lut_sin[0] == 0 && ql_lut_sin[QL_SIN_CELLS] == 1l << 30,
            "the ends are %ld, %ld", (long)ql_lut_sin[0],
            (long)ql_lut_sin[QL_SIN_CELLS]);
    NOTE("%d entries", QL_SIN_CELLS + 1);
}

TEST(reciprocal_root_entries_are_nearest)
{
    for (unsigned i = 0; i < QL_RSQRT_CELLS; i++) {
        const double m = 0.25 + 0.75 * (i + 0.5) / QL_RSQRT_CELLS;

        check("ql_lut_rsqrt", i, ql_lut_rsqrt[i], ldexp(1 / sqrt(m), 15));
    }
    NOTE("%d entries", QL_RSQRT_CELLS);
}

TEST(reciprocal_entries_are_nearest)
{
    for (unsigned i = 0; i < QL_RECIP_CELLS; i++) {
        const double m = 0.5 + 0.5 * (i + 0.5) / QL_RECIP_CELLS;

        check("ql_lut_recip", i, ql_lut_recip[i], ldexp(1 / m, 15));
    }
    NOTE("%d entries", QL_RECIP_CELLS);
}

TEST(srgb_entries_are_nearest)
{
    for (unsigned i = 0; i <= QL_SRGB_OCTAVES * QL_SRGB_STEPS; i++) {
        const double x = ldexp(1 + (double)(i % QL_SRGB_STEPS) / QL_SRGB_STEPS,
                (int)(i / QL_SRGB_STEPS) - QL_SRGB_OCTAVES);
        const double y =
                x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055;

        check("ql_lut_srgb", i, ql_lut_srgb[i], y * 255 * 256);
    }
    NOTE("%d entries", QL_SRGB_OCTAVES * QL_SRGB_STEPS + 1);
}

TEST(logarithm_entries_are_nearest)
{
    for (unsigned i = 0; i < QL_RECIP_CELLS; i++) {
        check("ql_lut_log2", i, ql_lut_log2[i],
                ldexp(log(ldexp(ql_lut_recip[i], -15)) / log(2), 32));
    }
    NOTE("%d entries", QL_RECIP_CELLS);
}

TEST(power_entries_are_nearest)
{
    for (unsigned i = 0; i < QL_EXP2_CELLS; i++) {
        check("ql_lut_exp2", i, ql_lut_exp2[i],
                ldexp(-expm1(-log(2) * i / QL_EXP2_CELLS), 32));
    }
    CHECK(ql_lut_exp2[0] == 0, "it begins with %lu",
            (unsigned long)ql_lut_exp2[0]);
    NOTE("%d entries", QL_EXP2_CELLS);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_lut", argc, argv);
    RUN(sine_entries_are_nearest);
    RUN(reciprocal_root_entries_are_nearest);
    RUN(reciprocal_entries_are_nearest);
    RUN(srgb_entries_are_nearest);
    RUN(logarithm_entries_are_nearest);
    RUN(power_entries_are_nearest);
    return TEST_END();
}
