/* known_double.c - the Cornell box agrees with a path tracer in double */
/* SPDX-License-Identifier: MIT */

/* Usage: known_double [CLAIM [CORNELL.qlb CORNELL.obj]]. Both pictures have
 * 64x64 pixels and 4 bounces, the core's 256 samples a pixel, the other one
 * 144 stratified ones. Their relative mean squared error is the noise of both;
 * a mean over 16x16 pixels has far less, so there the tracers must agree much
 * closer. */

#include <math.h>
#include <stdlib.h>

#include "known/double/double_pt.h"
#include "support/picture/picture.h"
#include "support/ql_test.h"
#include "qlux.h"

enum { SIZE = 64, SPP = 256, BOUNCES = 4 };
enum { SIDE = 12 }; /* of the reference: 144 samples */
enum { BLOCK = 16, BLOCKS = SIZE / BLOCK };
enum { VALUES = 3 * SIZE * SIZE, BLOCK_VALUES = 3 * BLOCKS * BLOCKS };

static const dpt_camera_t camera = {
        {{278, 273, -800}}, {{278, 273, 0}}, {{0, 1, 0}}, 39.3};

static double core[VALUES], reference[VALUES];
static const char *fail;

/* The picture of the core, in the units of Ke. */
static void render_core(const char *path)
{
    ql_settings_t settings = QL_SETTINGS_DEFAULT;
    ql_scene_t scene;
    ql_render_t render;
    size_t size;
    void *blob = picture_load(path, &size);
    double unit;

    settings.width = settings.height = SIZE;
    settings.spp = SPP;
    settings.bounces = BOUNCES;
    settings.direct = QL_DIRECT_AREA;
    settings.lights = QL_LIGHTS_POWER;
    if (blob == NULL || ql_blob_open(&scene, blob, size) != QL_OK ||
            ql_render_init(&render, &scene, &settings) != QL_OK) {
        fail = "cannot open the blob";
        free(blob);
        return;
    }
    unit = picture_radiance_unit(&scene) / settings.spp;
    for (size_t i = 0; i < VALUES / 3; i++) {
        ql_sum_t sum = {{0, 0, 0}};

        ql_render_pixel(&render, (uint16_t)(i % SIZE), (uint16_t)(i / SIZE), 0,
                settings.spp, &sum);
        for (size_t k = 0; k < 3; k++) {
            core[3 * i + k] = ldexp((double)sum.rgb[k], -QL_SUM_BITS) * unit;
        }
    }
    fail = render.diag.saturated > 0 ? "contributions saturated" : fail;
    free(blob);
}

static void render_reference(const char *path)
{
    static dpt_scene_t scene;
    const char *error = dpt_read(&scene, path);

    if (error != NULL) {
        fail = error;
        return;
    }
    dpt_render(&scene, &camera, SIZE, SIZE, SIDE, BOUNCES, 1, reference);
}

static double mean_of(
        const double *values, size_t first, size_t step, size_t count)
{
    double sum = 0;

    for (size_t i = first; i < count; i += step) {
        sum += values[i];
    }
    return sum / (double)(count / step);
}

/* Rousselle, Knaus and Zwicker's relative error, its epsilon relative to the
 * mean, as qlux-diff prints it. */
static double rel_mse(const double *a, const double *b, size_t count)
{
    const double mean = mean_of(b, 0, 1, count);
    double sum = 0;

    for (size_t i = 0; i < count; i++) {
        sum += (a[i] - b[i]) * (a[i] - b[i]) /
               (b[i] * b[i] + 0.01 * mean * mean);
    }
    return sum / (double)count;
}

static void average_blocks(const double *from, double *to)
{
    for (size_t i = 0; i < BLOCK_VALUES; i++) {
        to[i] = 0;
    }
    for (size_t i = 0; i < VALUES; i++) {
        const size_t x = i / 3 % SIZE, y = i / 3 / SIZE;

        to[3 * (y / BLOCK * BLOCKS + x / BLOCK) + i % 3] +=
                from[i] / (BLOCK * BLOCK);
    }
}

static bool means_agree(const double *picture)
{
    bool agree = true;

    for (size_t k = 0; k < 3; k++) {
        const double a = mean_of(picture, k, 3, VALUES);
        const double b = mean_of(reference, k, 3, VALUES);

        agree = agree && fabs(a / b - 1) < 0.005;
    }
    return agree;
}

static double block_error(const double *picture)
{
    static double a[BLOCK_VALUES], b[BLOCK_VALUES];

    average_blocks(picture, a);
    average_blocks(reference, b);
    return rel_mse(a, b, BLOCK_VALUES);
}

TEST(cornell_means_agree_within_half_a_percent)
{
    double a[3], b[3];

    CHECK(fail == NULL, "%s", fail);
    for (size_t k = 0; k < 3; k++) {
        a[k] = mean_of(core, k, 3, VALUES);
        b[k] = mean_of(reference, k, 3, VALUES);
    }
    CHECK(means_agree(core), "core %.5f %.5f %.5f, double %.5f %.5f %.5f", a[0],
            a[1], a[2], b[0], b[1], b[2]);
    NOTE("core %.5f %.5f %.5f, double %.5f %.5f %.5f", a[0], a[1], a[2], b[0],
            b[1], b[2]);
}

TEST(cornell_agrees_within_relative_mse_of_0_01)
{
    const double error = rel_mse(core, reference, VALUES);

    CHECK(fail == NULL, "%s", fail);
    CHECK(error < 0.01, "relative MSE %.5f, limit 0.01, see %s", error,
            picture_fail("known_double", core, reference, SIZE, SIZE));
    NOTE("%.5f, limit 0.01, the noise of both", error);
}

/* Three times what is measured, and half of what light too strong by 1 % gives.
 */
#define BLOCK_LIMIT 5e-5

TEST(cornell_agrees_where_noise_is_averaged_out)
{
    const double error = block_error(core);

    CHECK(error < BLOCK_LIMIT, "relative MSE of %dx%d px: %.3g, limit %.3g",
            BLOCK, BLOCK, error, BLOCK_LIMIT);
    NOTE("relative MSE of %dx%d px: %.2g, limit %.2g", BLOCK, BLOCK, error,
            BLOCK_LIMIT);
}

TEST(comparison_rejects_light_too_strong_by_1_percent)
{
    static double faulty[VALUES];

    for (size_t i = 0; i < VALUES; i++) {
        faulty[i] = core[i] * 1.01;
    }
    CHECK(!means_agree(faulty), "the means still agree");
    CHECK(block_error(faulty) > BLOCK_LIMIT, "blocks agree: %.3g",
            block_error(faulty));
}

/* A wrong corner or centre of the picture shifts it by a pixel. */
TEST(comparison_rejects_a_camera_off_by_a_pixel)
{
    static double faulty[VALUES];

    for (size_t i = 0; i < VALUES; i++) {
        faulty[i] = core[i >= 3 ? i - 3 : i];
    }
    CHECK(block_error(faulty) > BLOCK_LIMIT, "blocks agree: %.3g",
            block_error(faulty));
    NOTE("relative MSE %.3g", block_error(faulty));
}

int main(int argc, char **argv)
{
    TEST_BEGIN("known/double", argc, argv);
    render_core(argc > 3 ? argv[2] : picture_built("cornell.qlb"));
    render_reference(argc > 3 ? argv[3] : "tests/scenes/cornell.obj");
    RUN(cornell_means_agree_within_half_a_percent);
    RUN(cornell_agrees_within_relative_mse_of_0_01);
    RUN(cornell_agrees_where_noise_is_averaged_out);
    RUN(comparison_rejects_light_too_strong_by_1_percent);
    RUN(comparison_rejects_a_camera_off_by_a_pixel);
    return TEST_END();
}
