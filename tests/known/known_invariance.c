/* known_invariance.c - moving or scaling a scene does not change its picture */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <stdlib.h>

#include "support/picture/estimate.h"
#include "support/picture/picture.h"
#include "support/ql_test.h"
#include "qlux.h"

enum { SIZE = 24, VALUES = 3 * SIZE * SIZE };

static mini_scene_t m;

/* A room with a lamp and two blocks, of 31 grid units times scale a side,
 * seen from inside it. */
static void make_room(int32_t scale, unsigned node_bits)
{
    static const double right[3] = {0.25, 0, 0}, up[3] = {0, 0.25, 0};
    const int32_t s = scale;
    const int32_t low[3] = {8, 8, 8};
    const int32_t high[3] = {8 + 31 * s, 8 + 31 * s, 8 + 31 * s};
    const int32_t lamp[4][3] = {{8 + 10 * s, 8 + 30 * s, 8 + 10 * s},
            {8 + 20 * s, 8 + 30 * s, 8 + 10 * s},
            {8 + 20 * s, 8 + 30 * s, 8 + 20 * s},
            {8 + 10 * s, 8 + 30 * s, 8 + 20 * s}};
    const uint16_t white = (mini_begin(&m), mini_material(&m, 0.75, 0));
    const uint16_t gray = mini_material(&m, 0.5, 0);

    m.node_bits = node_bits;
    m.width = m.height = SIZE;
    m.radiance_exp = 2;
    mini_room(&m, low, high, white);
    for (int i = 0; i < 2; i++) {
        const int32_t x = 8 + (i == 0 ? 4 : 17) * s;
        const int32_t y = 8 + (i == 0 ? 9 : 16) * s, z = 8 + 16 * s;
        const int32_t a[3] = {x, 8 + s, z},
                      b[3] = {x + 9 * s, 8 + s, z - 4 * s};
        const int32_t c[3] = {x + 9 * s, y, z - 4 * s}, d[3] = {x, y, z};
        const int32_t e[3] = {x + 4 * s, 8 + s, z + 8 * s};
        const int32_t f[3] = {x + 4 * s, y, z + 8 * s};

        mini_quad(&m, a, d, c, b, gray);
        mini_quad(&m, b, c, f, e, gray);
        mini_quad(&m, e, f, d, a, gray);
        mini_triangle(&m, d, f, c, gray);
    }
    mini_quad(
            &m, lamp[0], lamp[1], lamp[2], lamp[3], mini_material(&m, 0.5, 3));
    mini_eye(&m, 8 + 15 * s, 8 + 14 * s, 8 + 2 * s);
    mini_look(&m, 0, 0, 0.25);
    mini_field(&m, right, up);
}

static void render(ql_sum_t sums[SIZE * SIZE], uint32_t spp)
{
    const ql_settings_t s = estimate_settings(QL_SAMPLER_SOBOL, 4, 11);
    ql_scene_t scene;
    ql_render_t r;

    mini_open(&m, &scene);
    memset(sums, 0, SIZE * SIZE * sizeof *sums);
    CHECK(ql_render_init(&r, &scene, &s) == QL_OK, "settings");
    for (uint16_t i = 0; i < SIZE * SIZE; i++) {
        ql_render_pixel(&r, i % SIZE, i / SIZE, 0, spp, sums + i);
    }
}

static unsigned differing(const ql_sum_t *a, const ql_sum_t *b)
{
    unsigned count = 0;

    for (int i = 0; i < SIZE * SIZE; i++) {
        count += memcmp(a + i, b + i, sizeof *a) != 0;
    }
    return count;
}

static ql_sum_t at_home[SIZE * SIZE], moved[SIZE * SIZE];

TEST(scene_moved_by_grid_units_gives_the_same_bits)
{
    static const int16_t moves[][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1},
            {255, 256, 257}, {1023, 4097, 7}, {10000, 77, 9999},
            {13000, 13000, 13000}};
    const unsigned count = sizeof moves / sizeof *moves;

    for (unsigned bits = 8; bits <= 16; bits += 8) {
        make_room(600, bits);
        render(at_home, 8);
        for (unsigned i = 0; i < count; i++) {
            unsigned pixels;

            make_room(600, bits);
            mini_move(&m, moves[i][0], moves[i][1], moves[i][2]);
            render(moved, 8);
            pixels = differing(at_home, moved);
            CHECK(pixels == 0, "by %d %d %d, %u-bit nodes: %u of %d px differ",
                    moves[i][0], moves[i][1], moves[i][2], bits, pixels,
                    SIZE * SIZE);
        }
    }
    NOTE("%u moves, both node widths", count);
}

TEST(node_width_and_leaf_size_do_not_change_a_bit)
{
    make_room(1000, 16);
    render(at_home, 8);
    for (unsigned leaf = 1; leaf <= 13; leaf += 3) {
        for (unsigned bits = 8; bits <= 16; bits += 8) {
            make_room(1000, bits);
            m.leaf_max = leaf;
            render(moved, 8);
            CHECK(differing(at_home, moved) == 0,
                    "%u-bit nodes, %u a leaf: %u px differ", bits, leaf,
                    differing(at_home, moved));
        }
    }
}

TEST(comparison_rejects_a_camera_moved_by_one_unit)
{
    make_room(600, 16);
    render(at_home, 8);
    m.camera.at[QL_CAMERA_BASE][0][1]++;
    render(moved, 8);
    CHECK(differing(at_home, moved) > SIZE * SIZE / 2, "%u px differ",
            differing(at_home, moved));
}

/* ---- Scales ------------------------------------------------------------ */

static double large[VALUES], small[VALUES];

static void to_radiance(const ql_sum_t *sums, uint32_t spp, double *values)
{
    for (int i = 0; i < VALUES; i++) {
        values[i] = ldexp((double)sums[i / 3].rgb[i % 3],
                            m.radiance_exp - QL_SUM_BITS) /
                    spp;
    }
}

static double mean_of(const double *values)
{
    double sum = 0;

    for (int i = 0; i < VALUES; i++) {
        sum += values[i] / VALUES;
    }
    return sum;
}

/* What is left of the difference, relative to the mean, without the pixels that
 * differ most: its mean and its root mean square. */
typedef struct {
    double mean, rms;
} rest_t;

static int by_size(const void *x, const void *y)
{
    const double p = fabs(*(const double *)x), q = fabs(*(const double *)y);

    return (p > q) - (p < q);
}

static rest_t rest_of(const double *a, const double *b, int without)
{
    enum { PIXELS = SIZE * SIZE };
    double off[PIXELS];
    rest_t rest = {0, 0};

    for (int i = 0; i < PIXELS; i++) {
        off[i] = a[3 * i] - b[3 * i]; /* everything is gray */
    }
    qsort(off, PIXELS, sizeof *off, by_size);
    for (int i = 0; i < PIXELS - without; i++) {
        rest.mean += off[i] / PIXELS / mean_of(b);
        rest.rms += off[i] * off[i] / PIXELS;
    }
    rest.rms = sqrt(rest.rms) / mean_of(b);
    return rest;
}

/* Rounding is a matter of ulps a scene unit, u; the room is 31 units wide. The
 * core lifts points off their planes by an ulp, which brightens the picture in
 * proportion to u; a few paths pass an edge on the other side and change as a
 * whole, in about 15,000 u of the 576 pixels. Measured: mean 0.09 u, root mean
 * square 0.08 u + 0.02 sqrt(u). Twice that may be.
 *
 * Below u = 2^-8 such paths are so few that a single one decides the mean, so
 * there the pixels of as many as there may be are left out, and all the others
 * have to be right by rounding alone. */
static int pixels_left_out(double u, int steps)
{
    const double n = SIZE * SIZE, share = 15000 * u / n;

    return u < 0x1p-8 ? (int)(n * (share + stats_mean_limit(steps, n, share, 1,
                                                   INFINITY)))
                      : 0;
}

TEST(scaled_scene_gives_the_same_picture_within_rounding)
{
    enum { SPP = 64, STEPS = 11 };
    double worst = 0, finest = 0;

    make_room(1 << (STEPS - 1), 16);
    render(at_home, SPP);
    to_radiance(at_home, SPP, large);
    for (int step = 0; step < STEPS - 1; step++) {
        const double u = ldexp(1, -step - QL_POS_BITS); /* ulps a unit */
        const int without = pixels_left_out(u, STEPS - 1);
        const double edges = without > 0 ? 0 : 0.04 * sqrt(u);
        rest_t rest;

        make_room(1 << step, 16);
        render(moved, SPP);
        to_radiance(moved, SPP, small);
        rest = rest_of(small, large, without);
        CHECK(rest.rms < 0.16 * u + edges && fabs(rest.mean) < 0.18 * u,
                "1:%d: rms %.3g, mean %.3g, u %.3g, %d pixels left out; see %s",
                1 << (STEPS - 1 - step), rest.rms, rest.mean, u, without,
                picture_fail("known_invariance", small, large, SIZE, SIZE));
        worst = fmax(worst, fabs(rest.mean) / u);
        finest = rest.mean;
    }
    NOTE("1:2 to 1:1024; mean off %.2f ulps a unit, at 1:2 %.0e", worst,
            finest);
}

/* The fault: at one scale the lamp hangs lower by a scene unit. */
TEST(scaled_scene_rejects_a_lamp_that_hangs_lower)
{
    enum { SPP = 64, SCALE = 1 << 9 };
    const double u = ldexp(1.0 / SCALE, -QL_POS_BITS);
    const int without = pixels_left_out(u, 10);
    rest_t rest;

    make_room(2 * SCALE, 16);
    render(at_home, SPP);
    to_radiance(at_home, SPP, large);
    make_room(SCALE, 16);
    for (unsigned i = 0; i < m.vertex_count; i++) {
        m.vertices[i][1] -= m.vertices[i][1] == 8 + 30 * SCALE ? SCALE : 0;
    }
    render(moved, SPP);
    to_radiance(moved, SPP, small);
    rest = rest_of(small, large, without);
    CHECK(rest.rms > 2 * 0.16 * u && fabs(rest.mean) > 2 * 0.18 * u,
            "rms %.3g, mean %.3g, u %.3g, %d pixels left out", rest.rms,
            rest.mean, u, without);
    NOTE("rms %.0f u, mean %.0f u", rest.rms / u, rest.mean / u);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("known/invariance", argc, argv);
    RUN(scene_moved_by_grid_units_gives_the_same_bits);
    RUN(node_width_and_leaf_size_do_not_change_a_bit);
    RUN(comparison_rejects_a_camera_moved_by_one_unit);
    RUN(scaled_scene_gives_the_same_picture_within_rounding);
    RUN(scaled_scene_rejects_a_lamp_that_hangs_lower);
    return TEST_END();
}
