/* test_curve.c - curves are their formulas, from black to white */
/* SPDX-License-Identifier: MIT */

#include <math.h>

#include "film/ql_curve.h"
#include "support/ql_test.h"

#define WHITE ((uint32_t)QL_CURVE_WHITE << 16)

#if QL_ROLL_OFF
#if QL_CFG_CURVES & 1
static double narkowicz(double v)
{
    return v * (2.51 * v + 0.03) / (v * (2.43 * v + 0.59) + 0.14);
}

static double filmic(double x)
{
    return fmin(narkowicz(0.72 * x) / narkowicz(0.72 * 8), 1);
}

/* Planted: 0.6, the ACES curve's exposure. */
static double another_filmic(double x)
{
    return fmin(narkowicz(0.6 * x), 1);
}
#endif

#if QL_CFG_CURVES & 2
static double reinhard(double x)
{
    const double l = 1.2 * x;

    return fmin(l * (1 + l / (9.6 * 9.6)) / (1 + l), 1);
}

/* Planted: equation 3, which is never white. */
static double another_reinhard(double x)
{
    return 1.2 * x / (1 + 1.2 * x);
}
#endif

static double srgb(double x)
{
    return 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055);
}

static const struct {
    ql_curve_t curve;
    double (*exact)(double);
    double (*another)(double);
    const char *name;
} curves[] = {
#if QL_CFG_CURVES & 1
        {QL_CURVE_FILMIC, filmic, another_filmic, "filmic"},
#endif
#if QL_CFG_CURVES & 2
        {QL_CURVE_REINHARD, reinhard, another_reinhard, "reinhard"},
#endif
};

enum { CURVES = sizeof curves / sizeof *curves };

static uint32_t shown(ql_curve_t curve, uint32_t linear)
{
    uint32_t rgb[3] = {0, linear, 0};

    ql_curve_roll_off(curve, rgb);
    CHECK(rgb[0] == 0 && rgb[2] == 0, "%lu, %lu beside %lu",
            (unsigned long)rgb[0], (unsigned long)rgb[2],
            (unsigned long)linear);
    return rgb[1];
}

/* How far a curve is from a formula, in levels of a display of 255. */
static double worst_error(ql_curve_t curve, double (*exact)(double))
{
    double worst = 0;

    for (uint32_t i = 0; i <= WHITE + 4; i += QL_TEST_SHARE) {
        const double got = shown(curve, i) / 65536.0;

        worst = fmax(worst, fabs(srgb(got) - srgb(exact(i / 65536.0))));
    }
    return worst;
}

/* An input's own rounding is half of 2^-16, as it is without a curve. */
TEST(curves_are_their_formulas_for_every_input)
{
    double most = 0;

    for (unsigned c = 0; c < CURVES; c++) {
        const double worst = worst_error(curves[c].curve, curves[c].exact);

        CHECK(worst < 0.05, "%s is off by %.4f of 255", curves[c].name, worst);
        most = fmax(most, worst);
    }
    NOTE("worst %.4f of 255", most);
}

TEST(a_brighter_input_is_never_darker_and_white_is_white)
{
    for (unsigned c = 0; c < CURVES; c++) {
        uint32_t before = 0;

        for (uint32_t i = 0; i <= WHITE; i += QL_TEST_SHARE) {
            const uint32_t now = shown(curves[c].curve, i);

            CHECK(now >= before && now <= 65536, "%s of %lu: %lu after %lu",
                    curves[c].name, (unsigned long)i, (unsigned long)now,
                    (unsigned long)before);
            before = now;
        }
        CHECK(shown(curves[c].curve, 0) == 0, "%s", curves[c].name);
        CHECK(shown(curves[c].curve, WHITE) == 65536, "%s", curves[c].name);
        CHECK(shown(curves[c].curve, 0xffffffffu) == 65536, "%s",
                curves[c].name);
    }
}

/* What would be cut without a curve keeps its differences. */
TEST(middle_grey_stays_and_highlights_roll_off)
{
    for (unsigned c = 0; c < CURVES; c++) {
        const double grey = shown(curves[c].curve, 11796) / 65536.0;

        CHECK(fabs(grey - 0.18) < 0.0021, "%s: %.4f", curves[c].name, grey);
        for (uint32_t x = 1; x < QL_CURVE_WHITE; x *= 2) {
            CHECK(shown(curves[c].curve, 2 * x << 16) >
                            shown(curves[c].curve, x << 16) + 512,
                    "%s: %lu is as bright as %lu", curves[c].name, 2ul * x,
                    1ul * x);
        }
    }
}

TEST(other_formulas_are_rejected)
{
    for (unsigned c = 0; c < CURVES; c++) {
        CHECK(worst_error(curves[c].curve, curves[c].another) > 1, "%s",
                curves[c].name);
    }
}
#endif

TEST(srgb_alone_changes_nothing)
{
    uint32_t rgb[3] = {0, 65537, 0xffffffffu};

    ql_curve_roll_off(QL_CURVE_SRGB, rgb);
    CHECK(rgb[0] == 0 && rgb[1] == 65537 && rgb[2] == 0xffffffffu,
            "%lu %lu %lu", (unsigned long)rgb[0], (unsigned long)rgb[1],
            (unsigned long)rgb[2]);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_curve", argc, argv);
#if QL_ROLL_OFF
    RUN(curves_are_their_formulas_for_every_input);
    RUN(a_brighter_input_is_never_darker_and_white_is_white);
    RUN(middle_grey_stays_and_highlights_roll_off);
    RUN(other_formulas_are_rejected);
#endif
    RUN(srgb_alone_changes_nothing);
    return TEST_END();
}
