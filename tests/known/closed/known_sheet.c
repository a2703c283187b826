/* known_sheet.c - a lamp of two faces, back to back, by every strategy */
/* SPDX-License-Identifier: MIT */

#include <math.h>

#include "support/picture/estimate.h"
#include "support/ql_test.h"

enum { SAMPLES = 1 << 14 };

static mini_scene_t m;

/* A floor under a square lamp that has a face up and a face down, cut along the
 * two diagonals; the one up is the first of the file or the last. */
static void build(bool order, bool two_sided, bool up_first)
{
    static const int32_t v[4][3] = {{14000, 14000, 16000},
            {18000, 14000, 16000}, {18000, 18000, 16000},
            {14000, 18000, 16000}};
    static const int32_t f[4][3] = {{2000, 2000, 12000}, {30000, 2000, 12000},
            {30000, 30000, 12000}, {2000, 30000, 12000}};
    uint16_t lamp;

    mini_begin(&m);
    m.order = order;
    m.two_sided = two_sided;
    mini_quad(&m, f[0], f[1], f[2], f[3], mini_material(&m, 0.5, 0));
    lamp = mini_material(&m, 0.2, 0.5);
    if (up_first) {
        mini_quad(&m, v[0], v[1], v[2], v[3], lamp);
    }
    mini_quad(&m, v[3], v[2], v[1], v[0], lamp);
    if (!up_first) {
        mini_quad(&m, v[0], v[1], v[2], v[3], lamp);
    }
    mini_eye(&m, 15000, 17000, 14000);
    mini_look(&m, 0, 0, -0.5);
}

/* How many standard errors a strategy is off the cosine's. */
static double off(uint8_t direct)
{
    ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 0, 3);
    stats_moments_t a, b;

    s.direct = QL_DIRECT_COSINE;
    a = estimate_pixel(&m, &s, 0, 0, SAMPLES);
    s.seed = 4;
    s.direct = direct;
    b = estimate_pixel(&m, &s, 0, 0, SAMPLES);
    return (a.mean - b.mean) /
           sqrt((stats_variance(&a) + stats_variance(&b)) / SAMPLES);
}

TEST(every_strategy_finds_the_light_of_one_face)
{
    double worst = 0;

    for (int i = 0; i < 4 * STRATEGIES; i++) {
        double z;

        build(true, i % 2 != 0, i / 2 % 2 != 0);
        z = off(strategies[i / 4].direct);
        CHECK(fabs(z) < stats_z_limit(4 * STRATEGIES), "%s, case %d: z %.1f",
                strategies[i / 4].name, i % 4, z);
        worst = fmax(worst, fabs(z));
    }
    NOTE("worst z %.1f", worst);
}

TEST(without_an_order_two_sided_lamps_shine_twice)
{
    build(false, true, true);
    CHECK(fabs(off(QL_DIRECT_AREA)) > 10, "z %.1f", off(QL_DIRECT_AREA));
}

int main(int argc, char **argv)
{
    TEST_BEGIN("known/sheet", argc, argv);
    RUN(every_strategy_finds_the_light_of_one_face);
    RUN(without_an_order_two_sided_lamps_shine_twice);
    return TEST_END();
}
