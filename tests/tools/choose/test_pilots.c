/* test_pilots.c - what a pilot is worth, and how often the sky is chosen */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/math/build_cdf.h"
#include "scene/choose/pilot.h"
#include "scene/choose/sky_share.h"
#include "support/ql_test.h"

enum { PIXELS = 100, UNIT = 1 << 24 };

/* Two pictures of grey pixels, which differ by 2 * off. */
static void open_pilot(pilot_t *pilot, uint64_t grey, uint64_t off)
{
    pilot->pixels = PIXELS;
    pilot->instructions = 1000;
    for (unsigned k = 0; k < PILOT_PICTURES; k++) {
        pilot->sums[k] = calloc(PIXELS, sizeof *pilot->sums[k]);
        for (unsigned i = 0; i < 3 * PIXELS; i++) {
            pilot->sums[k][i / 3].rgb[i % 3] = k == 0 ? grey + off : grey - off;
        }
    }
}

static void free_pilots(pilot_t *pilots, unsigned count)
{
    for (unsigned i = 0; i < count; i++) {
        pilot_free(pilots + i);
    }
}

/* x and y are off by d, so half the square of what they differ by is 2 d^2; the
 * mean of all is 1, and a hundredth is added to its square. */
TEST(work_is_the_relative_squared_error_times_the_instructions)
{
    pilot_t pilots[2];
    soft_t work[2];

    open_pilot(pilots, UNIT, UNIT / 8);
    open_pilot(pilots + 1, UNIT, UNIT / 16);
    pilots[1].instructions = 3000;
    pilot_compare(work, pilots, 2);
    for (unsigned i = 0; i < 2; i++) {
        const double off = i == 0 ? 1 / 8.0 : 1 / 16.0;
        const double error = 3 * PIXELS * 2 * off * off / 1.01;
        const double wanted = error * (i == 0 ? 1000 : 3000);

        CHECK(fabs(soft_double(work[i]) / wanted - 1) < 1e-12,
                "work is %.9g, not %.9g", soft_double(work[i]), wanted);
    }
    free_pilots(pilots, 2);
}

/* A way with one white dot is worse than one that is noisy all over by as much
 * as its own mean would forgive: the dot is 100 where others are 1, its pixel's
 * mean is 25.75, so the error is 0.5 (99 / 25.75)^2, about 7.4 a channel. */
TEST(a_white_dot_is_not_forgiven)
{
    pilot_t pilots[2];
    soft_t work[2];
    double dot, noise;

    open_pilot(pilots, UNIT, UNIT / 16);
    open_pilot(pilots + 1, UNIT, UNIT / 8);
    for (unsigned c = 0; c < 3; c++) {
        pilots[0].sums[0][7].rgb[c] = 100u * UNIT;
    }
    pilot_compare(work, pilots, 2);
    dot = soft_double(work[0]);
    noise = soft_double(work[1]);
    CHECK(dot > 1.5 * noise, "a dot is %.4g, noise %.4g", dot, noise);
    free_pilots(pilots, 2);
}

TEST(errors_that_nobody_sees_are_equal_and_work_is_not)
{
    pilot_t pilots[3];
    soft_t work[3];

    open_pilot(pilots, UNIT, UNIT / 4096);
    open_pilot(pilots + 1, UNIT, 0);
    open_pilot(pilots + 2, UNIT, UNIT / 512);
    pilots[1].instructions = 2000;
    pilot_compare(work, pilots, 3);
    CHECK(soft_compare(soft_mul(work[0], soft_int(2, 0)), work[1]) == 0,
            "%.9g is not twice %.9g", soft_double(work[1]),
            soft_double(work[0]));
    CHECK(soft_compare(work[0], work[2]) < 0, "2^-17 is seen");
    free_pilots(pilots, 3);
}

TEST(black_pictures_have_no_error)
{
    pilot_t pilots[2];
    soft_t work[2];

    open_pilot(pilots, 0, 0);
    open_pilot(pilots + 1, 0, 0);
    pilot_compare(work, pilots, 2);
    CHECK(soft_compare(work[0], work[1]) == 0 && work[0].m != 0, "%g and %g",
            soft_double(work[0]), soft_double(work[1]));
    free_pilots(pilots, 2);
}

/* Lights whose chances are as their numbers, the last one the sky. */
static void open_lights(model_t *model, uint32_t count, uint64_t first)
{
    uint64_t cum = 0;

    memset(model, 0, sizeof *model);
    model->sky_count = 1;
    model->lights_count = count;
    model->lights = calloc(count, sizeof *model->lights);
    for (uint32_t i = 0; i < count; i++) {
        model->lights[i].cum = (uint32_t)cum;
        cum += first * (i + 1);
    }
}

static uint64_t share_of(const model_t *model, uint32_t light)
{
    const uint64_t end = light + 1 < model->lights_count
                                 ? model->lights[light + 1].cum
                                 : (uint64_t)1 << 32;

    return end - model->lights[light].cum;
}

TEST(the_sky_is_chosen_as_often_as_asked_and_weighed_by_that)
{
    static const unsigned parts[] = {2, 4, 16, 64};

    for (unsigned i = 0; i < 4 * 3; i++) {
        const uint32_t count = 2 + i % 3;
        const double sky = 0x1p32 / parts[i / 3];
        model_t model;
        uint64_t sum = 0;

        open_lights(&model, count, 1000 + 77777 * (i % 3));
        sky_share_set(&model, parts[i / 3]);
        CHECK(fabs((double)share_of(&model, count - 1) - sky) < 2,
                "the sky has %.0f", (double)share_of(&model, count - 1));
        for (uint32_t k = 0; k < count; k++) {
            const double part = (0x1p32 - sky) * (k + 1) * 2 /
                                ((double)count * (count - 1));
            const uint64_t share = share_of(&model, k);
            uint32_t m;
            int16_t e;

            CHECK(k + 1 == count || fabs((double)share - part) < 2,
                    "light %u of %u has %.0f", k, count, (double)share);
            cdf_weight(share, &m, &e);
            CHECK(model.lights[k].weight_m == m &&
                            model.lights[k].weight_exp == e,
                    "weight %u of %u", k, count);
            sum += share;
        }
        CHECK(sum == (uint64_t)1 << 32 && model.lights[0].cum == 0, "the sum");
        free(model.lights);
    }
}

int main(int argc, char **argv)
{
    TEST_BEGIN("tools/pilots", argc, argv);
    RUN(work_is_the_relative_squared_error_times_the_instructions);
    RUN(a_white_dot_is_not_forgiven);
    RUN(errors_that_nobody_sees_are_equal_and_work_is_not);
    RUN(black_pictures_have_no_error);
    RUN(the_sky_is_chosen_as_often_as_asked_and_weighed_by_that);
    return TEST_END();
}
