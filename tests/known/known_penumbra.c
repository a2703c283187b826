/* known_penumbra.c - half-hidden lights, and squares that light each other */
/* SPDX-License-Identifier: MIT */

#include <math.h>

#include "support/picture/estimate.h"
#include "support/picture/lambert.h"
#include "support/ql_test.h"

#define RADIANCE 0.5
#define ULP      (1.0 / (1 << QL_POS_BITS)) /* grid units */

static mini_scene_t m;

/* ---- Penumbra: a square light at height 1, an opaque half-plane x > 0 at
 * height 1/2, receivers at (p, 0, 0) -------------------------------------- */

enum { UNIT = 8000 }; /* grid units */
static const int32_t origin[3] = {16000, 16000, 2000};

static const struct {
    double p, form_factor;
} penumbra[] = {{-.6, 0.159743216399}, {-.5, 0.180368741123},
        {-.25, 0.185910849014}, {0, 0.11972823523}, {.25, 0.03705534802}};
enum { POINTS = sizeof penumbra / sizeof *penumbra };

static void add_square(double x0, double x1, double y0, double y1, double z,
        bool up, uint16_t material)
{
    int32_t c[4][3];

    for (int i = 0; i < 4; i++) {
        c[i][0] = origin[0] + (int32_t)lround(UNIT * (i & 2 ? x1 : x0));
        c[i][1] = origin[1] +
                  (int32_t)lround(UNIT * (i == 1 || i == 2 ? y1 : y0));
        c[i][2] = origin[2] + (int32_t)lround(UNIT * z);
    }
    /* 0 1 2 3 is clockwise from above */
    mini_quad(&m, c[0], c[up ? 3 : 1], c[2], c[up ? 1 : 3], material);
}

/* Looked at from above: x and y of the point are exact, its height is 1 ulp. */
static void make_penumbra(double p, bool occluder)
{
    const uint16_t light = (mini_begin(&m), mini_material(&m, 0, RADIANCE));
    const uint16_t white = mini_material(&m, 1, 0);

    add_square(-.5, .5, -.5, .5, 1, false, light);
    if (occluder) {
        add_square(0, .75, -.75, .75, .5, true, white);
    }
    add_square(-.75, .75, -.125, .125, 0, true, white);
    mini_eye(&m, origin[0] + UNIT * p, origin[1], origin[2] + UNIT / 4.0);
    mini_look(&m, 0, 0, -0.5);
}

static double receiver_x;

static double visible(const double w[3])
{
    /* the segment is at height 1/2 half way */
    return receiver_x + w[0] / 2 < 0;
}

static lambert_moments_t expected(double p, bool occluder)
{
    const double corner[3] = {-.5 - p, -.5, 1 - 2 * ULP / UNIT};
    const double a[3] = {0, 1, 0}, b[3] = {1, 0, 0}, up[3] = {0, 0, 1};

    receiver_x = p;
    return lambert_area_sampling(
            corner, a, b, up, occluder ? visible : NULL, 2000);
}

static stats_moments_t measure(double p, bool occluder, bool sobol)
{
    const ql_settings_t s = estimate_settings(
            sobol ? QL_SAMPLER_SOBOL : QL_SAMPLER_RANDOM, 0, 5);
    stats_moments_t got;

    make_penumbra(p, occluder);
    got = estimate_pixel(&m, &s, 0, 0, sobol ? 1u << 16 : 1u << 18);
    got.mean /= RADIANCE;
    return got;
}

TEST(penumbra_has_the_known_form_factors)
{
    double worst = 0;

    for (int i = 0; i < POINTS; i++) {
        const lambert_moments_t e = expected(penumbra[i].p, true);

        CHECK(fabs(e.mean - penumbra[i].form_factor) < 1e-5 + 3 * ULP / UNIT,
                "at %g: expected %.9f, known %.9f", penumbra[i].p, e.mean,
                penumbra[i].form_factor);
        for (int sobol = 0; sobol < 2; sobol++) {
            const stats_moments_t got =
                    measure(penumbra[i].p, true, sobol != 0);
            const double z = estimate_z(&got, e.mean, e.variance);

            CHECK(fabs(z) < STATS_Z_MANY, "at %g: %.7f, want %.7f, z %.1f",
                    penumbra[i].p, got.mean, e.mean, z);
            worst = fmax(worst, fabs(z));
        }
    }
    NOTE("%d points, both samplers, worst z %.1f", POINTS, worst);
}

TEST(receiver_whose_light_is_hidden_is_exactly_black)
{
    const ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 0, 6);
    static const double hidden[] = {.5, .501, .55, .6};

    for (int i = 0; i < 4; i++) {
        make_penumbra(hidden[i], true);
        CHECK(estimate_brightest(&m, &s, 1u << 16) == 0, "light at %g",
                hidden[i]);
    }
    NOTE("%d points, 65536 samples each", 4);
}

TEST(both_halves_of_the_light_add_up)
{
    for (int i = 2; i < POINTS; i++) {
        const double p = penumbra[i].p;
        const stats_moments_t left = measure(p, true, true);
        const stats_moments_t right = measure(-p, true, true);
        const stats_moments_t all = measure(p, false, true);
        const double off = left.mean + right.mean - all.mean;
        /* independent pictures, at most the random sampler's error each */
        const double limit =
                STATS_Z_MAX *
                sqrt((expected(p, true).variance + expected(-p, true).variance +
                             expected(p, false).variance) /
                        all.n);

        CHECK(fabs(off) < limit, "at %g: %.7f + %.7f is not %.7f", p, left.mean,
                right.mean, all.mean);
    }
}

TEST(penumbra_rejects_shadows_left_out)
{
    const lambert_moments_t e = expected(0, true);
    const stats_moments_t got = measure(0, false, false);

    CHECK(fabs(estimate_z(&got, e.mean, e.variance)) > STATS_Z_MAX,
            "%.7f passes for %.7f", got.mean, e.mean);
    NOTE("z %.0f", estimate_z(&got, e.mean, e.variance));
}

TEST(penumbra_rejects_an_occluder_off_by_a_64th)
{
    const lambert_moments_t e = expected(1 / 64.0, true);
    const stats_moments_t got = measure(0, true, false);

    CHECK(fabs(estimate_z(&got, e.mean, e.variance)) > STATS_Z_MAX,
            "%.7f passes for %.7f", got.mean, e.mean);
    NOTE("z %.0f", estimate_z(&got, e.mean, e.variance));
}

/* ---- Squares: one shines, one pixel covers the other --------------------- */

enum { SIDE = 8000 };

static const struct {
    const char *name;
    double form_factor; /* from the receiver to the emitter */
    int32_t gap;        /* of parallel squares; 0: a common edge */
    int32_t height;     /* of the wall */
} squares[] = {{"parallel_at_1", 0.1998248956983874, SIDE, 0},
        {"parallel_at_0.5", 0.4152532835771467, SIDE / 2, 0},
        {"parallel_at_2", 0.06858958881855245, 2 * SIDE, 0},
        {"edge_to_edge", 0.2000437760754032, 0, SIDE},
        {"edge_to_twice_as_high", 0.2328526027953619, 0, 2 * SIDE}};
enum { SQUARES = sizeof squares / sizeof *squares };

/* Where two squares meet, 1/r^2 leaves one sample without a variance. There the
 * pixel covers what is farther than this from the edge. */
enum { AWAY = SIDE / 8 };

static int32_t away_of(int i)
{
    return squares[i].gap > 0 ? 0 : AWAY;
}

/* A parallel projection whose one pixel is that part of the receiver. */
static void make_squares(int i)
{
    const int32_t low[3] = {8000, 8000, 1000};
    const int32_t x = low[0] + SIDE, y = low[1] + SIDE, z = low[2];
    const int32_t top =
            z + (squares[i].gap > 0 ? squares[i].gap : squares[i].height);
    const int32_t floor_at[4][3] = {
            {low[0], low[1], z}, {x, low[1], z}, {x, y, z}, {low[0], y, z}};
    const int32_t ceiling[4][3] = {{low[0], low[1], top}, {low[0], y, top},
            {x, y, top}, {x, low[1], top}};
    const int32_t wall[4][3] = {{low[0], low[1], z}, {low[0], y, z},
            {low[0], y, top}, {low[0], low[1], top}};
    const double half = (SIDE - away_of(i)) / 2.0;
    const double right[3] = {half, 0, 0}, up[3] = {0, SIDE / 2.0, 0};
    const uint16_t light = (mini_begin(&m), mini_material(&m, 0, RADIANCE));
    const int32_t(*const from)[3] = squares[i].gap > 0 ? ceiling : wall;

    mini_quad(&m, from[0], from[1], from[2], from[3], light);
    mini_quad(&m, floor_at[0], floor_at[1], floor_at[2], floor_at[3],
            mini_material(&m, 1, 0));
    mini_eye(&m, x - half, low[1] + SIDE / 2.0, z + 64);
    mini_window(&m, right, up);
    mini_look(&m, 0, 0, -0.5);
}

/* The mean of Lambert's formula over the receiver from a distance on. */
static double mean_form_factor(int i, int32_t from)
{
    enum { CELLS = 256 };
    const double up[3] = {0, 0, 1}, start = (double)from / SIDE;
    double sum = 0;

    for (int j = 0; j < CELLS * CELLS; j++) {
        const double x = start + (1 - start) * (j % CELLS + 0.5) / CELLS;
        const double y = (j / CELLS + 0.5) / CELLS;
        const double z = (double)squares[i].gap / SIDE;
        const double h = (double)squares[i].height / SIDE;
        const lambert_polygon_t above = {
                {{-x, -y, z}, {1 - x, -y, z}, {1 - x, 1 - y, z},
                        {-x, 1 - y, z}},
                4};
        const lambert_polygon_t beside = {
                {{-x, -y, 0}, {-x, -y, h}, {-x, 1 - y, h}, {-x, 1 - y, 0}}, 4};

        sum += lambert_form_factor(squares[i].gap > 0 ? &above : &beside, up);
    }
    return sum / (CELLS * CELLS);
}

TEST(mean_of_lambert_over_squares_is_the_known_form_factor)
{
    for (int i = 0; i < SQUARES; i++) {
        const double f = mean_form_factor(i, 0);

        CHECK(fabs(f / squares[i].form_factor - 1) < 1e-5, "%s: %.7f, %.7f",
                squares[i].name, f, squares[i].form_factor);
    }
}

/* The error of independent pictures, and what it should be at most: their own
 * spread, and the ulps by which the core moves both points off their planes. */
static double squares_error(int i, double weight_scale, double *limit)
{
    enum { PICTURES = 16 };
    const double wanted = mean_form_factor(i, away_of(i));
    stats_moments_t means = {0, 0, 0};

    for (uint32_t seed = 0; seed < PICTURES; seed++) {
        const ql_settings_t s =
                estimate_settings(QL_SAMPLER_SOBOL, 0, 100 + seed);

        make_squares(i);
        m.light_weight_scale = weight_scale;
        stats_add(
                &means, estimate_pixel(&m, &s, 0, 0, 1u << 16).mean / RADIANCE);
    }
    *limit = (STATS_Z_MAX * sqrt(stats_variance(&means) / means.n) +
                     4 * ULP / SIDE) /
             wanted;
    return means.mean / wanted - 1;
}

TEST(squares_have_the_known_form_factors)
{
    double worst = 0;

    for (int i = 0; i < SQUARES; i++) {
        double limit;
        const double error = squares_error(i, 1, &limit);

        CHECK(fabs(error) < limit && limit < 0.012,
                "%s: relative error %.6f, limit %.6f", squares[i].name, error,
                limit);
        worst = fmax(worst, fabs(error));
    }
    NOTE("%d pairs, worst relative error %.0e", SQUARES, worst);
}

TEST(squares_reject_light_pdf_scaled_by_1_02)
{
    for (int i = 0; i < SQUARES; i++) {
        double limit;

        CHECK(fabs(squares_error(i, 1 / 1.02, &limit)) > limit,
                "%s passes: limit %.6f", squares[i].name, limit);
    }
    NOTE("pdf scaled by 1.02, %d pairs", SQUARES);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("known/penumbra", argc, argv);
    RUN(penumbra_has_the_known_form_factors);
    RUN(receiver_whose_light_is_hidden_is_exactly_black);
    RUN(both_halves_of_the_light_add_up);
    RUN(penumbra_rejects_shadows_left_out);
    RUN(penumbra_rejects_an_occluder_off_by_a_64th);
    RUN(mean_of_lambert_over_squares_is_the_known_form_factor);
    RUN(squares_have_the_known_form_factors);
    RUN(squares_reject_light_pdf_scaled_by_1_02);
    return TEST_END();
}
