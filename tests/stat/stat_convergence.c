/* stat_convergence.c - error shrinks as it should with the number of samples */
/* SPDX-License-Identifier: MIT */

/* Usage: stat_convergence [CLAIM [CORNELL.qlb]]. The error of a picture is the
 * spread of pictures with different seeds: no reference is needed. */

#include <math.h>
#include <stdlib.h>

#include "support/picture/picture.h"
#include "support/ql_stats.h"
#include "support/ql_test.h"
#include "qlux.h"

enum { SIZE = 16, VALUES = 3 * SIZE * SIZE, SEEDS = 8 };

static ql_scene_t scene;

static void render(
        double picture[VALUES], const ql_settings_t *settings, uint32_t repeats)
{
    ql_settings_t s = *settings;
    ql_render_t r;

    s.width = s.height = SIZE;
    if (ql_render_init(&r, &scene, &s) != QL_OK) {
        exit(2);
    }
    for (int i = 0; i < SIZE * SIZE; i++) {
        ql_sum_t sum = {{0, 0, 0}};

        for (uint32_t j = 0; j < repeats; j++) {
            ql_render_pixel(&r, (uint16_t)(i % SIZE), (uint16_t)(i / SIZE), 0,
                    s.spp, &sum);
        }
        for (int k = 0; k < 3; k++) {
            picture[3 * i + k] = (double)sum.rgb[k] / ((double)s.spp * repeats);
        }
    }
}

/* Variance of a pixel, relative to the square of its mean; the median over the
 * picture, so that no firefly decides. */
static double variance_of(ql_sampler_kind_t sampler, uint8_t bounces,
        uint32_t spp, uint32_t repeats)
{
    static double pictures[SEEDS][VALUES];
    double values[VALUES];
    size_t count = 0;

    for (uint32_t seed = 0; seed < SEEDS; seed++) {
        ql_settings_t s = QL_SETTINGS_DEFAULT;

        s.sampler = (uint8_t)sampler;
        s.bounces = bounces;
        s.direct = QL_DIRECT_AREA;
        s.lights = QL_LIGHTS_POWER;
        s.spp = spp;
        s.seed = 1000 + seed;
        render(pictures[seed], &s, repeats);
    }
    for (int i = 0; i < VALUES; i++) {
        stats_moments_t moments = {0, 0, 0};

        for (int seed = 0; seed < SEEDS; seed++) {
            stats_add(&moments, pictures[seed][i]);
        }
        if (moments.mean > 0) {
            values[count++] =
                    stats_variance(&moments) / (moments.mean * moments.mean);
        }
    }
    stats_sort(values, count);
    return count > 0 ? values[count / 2] : NAN;
}

/* 4 times the samples, a quarter of the variance: within a quarter of it. */
static bool shrinks_fourfold(double before, double after)
{
    return before / after > 3 && before / after < 5;
}

TEST(random_samples_lose_half_their_error_with_four_times_as_many)
{
    double before = variance_of(QL_SAMPLER_RANDOM, 4, 16, 1);

    for (uint32_t spp = 64; spp <= 1024; spp *= 4) {
        const double after = variance_of(QL_SAMPLER_RANDOM, 4, spp, 1);

        CHECK(shrinks_fourfold(before, after), "%lu spp: ratio %.2f",
                (unsigned long)spp, before / after);
        before = after;
    }
    NOTE("16 to 1024 spp; relative variance %.1e in the end", before);
}

TEST(sobol_samples_need_a_fifth_for_direct_light)
{
    const double random = variance_of(QL_SAMPLER_RANDOM, 0, 256, 1);
    const double sobol = variance_of(QL_SAMPLER_SOBOL, 0, 256, 1);

    CHECK(random / sobol > 5, "256 spp: ratio %.2f", random / sobol);
    NOTE("256 spp: variance %.1f times smaller", random / sobol);
}

TEST(sobol_samples_need_half_with_4_bounces)
{
    const double random = variance_of(QL_SAMPLER_RANDOM, 4, 256, 1);
    const double sobol = variance_of(QL_SAMPLER_SOBOL, 4, 256, 1);

    CHECK(random / sobol > 2, "256 spp: ratio %.2f", random / sobol);
    NOTE("256 spp: variance %.1f times smaller", random / sobol);
}

TEST(comparison_rejects_samples_that_repeat)
{
    const double before = variance_of(QL_SAMPLER_RANDOM, 4, 16, 1);
    const double after = variance_of(QL_SAMPLER_RANDOM, 4, 16, 4);

    CHECK(!shrinks_fourfold(before, after), "ratio %.2f", before / after);
}

int main(int argc, char **argv)
{
    size_t size;
    void *blob = picture_load(
            argc > 2 ? argv[2] : picture_built("cornell.qlb"), &size);

    TEST_BEGIN("stat/convergence", argc, argv);
    if (blob == NULL || ql_blob_open(&scene, blob, size) != QL_OK) {
        (void)fprintf(stderr, "stat_convergence: cannot open the scene\n");
        free(blob);
        return 2;
    }
    RUN(random_samples_lose_half_their_error_with_four_times_as_many);
    RUN(sobol_samples_need_a_fifth_for_direct_light);
    RUN(sobol_samples_need_half_with_4_bounces);
    RUN(comparison_rejects_samples_that_repeat);
    free(blob);
    return TEST_END();
}
