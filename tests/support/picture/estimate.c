/* estimate.c - what the core says of one pixel, sample by sample */
/* SPDX-License-Identifier: MIT */

#include "support/picture/estimate.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "qlux.h"

const struct strategy strategies[STRATEGIES] = {{"area", QL_DIRECT_AREA},
        {"hemisphere", QL_DIRECT_HEMISPHERE}, {"cosine", QL_DIRECT_COSINE},
        {"solid-angle", QL_DIRECT_SOLID_ANGLE}, {"mis", QL_DIRECT_MIS}};

ql_settings_t estimate_settings(
        ql_sampler_kind_t sampler, uint8_t bounces, uint32_t seed)
{
    ql_settings_t settings = QL_SETTINGS_DEFAULT;

    settings.sampler = (uint8_t)sampler;
    settings.bounces = bounces;
    settings.direct = QL_DIRECT_AREA;
    settings.lights = QL_LIGHTS_POWER;
    settings.seed = seed;
    settings.spp = 1;
    return settings;
}

static void begin(ql_render_t *render, ql_scene_t *scene, mini_scene_t *m,
        const ql_settings_t *settings)
{
    mini_open(m, scene);
    if (ql_render_init(render, scene, settings) != QL_OK) {
        (void)fprintf(stderr, "estimate: the core refuses the settings\n");
        exit(2);
    }
}

stats_moments_t estimate_pixel(mini_scene_t *m, const ql_settings_t *settings,
        uint16_t x, uint16_t y, uint32_t samples)
{
    stats_moments_t moments = {0, 0, 0};
    ql_scene_t scene;
    ql_render_t render;

    begin(&render, &scene, m, settings);
    for (uint32_t i = 0; i < samples; i++) {
        ql_sum_t sum = {{0, 0, 0}};

        ql_render_pixel(&render, x, y, i, 1, &sum);
        stats_add(&moments,
                ldexp((double)sum.rgb[0], m->radiance_exp - QL_SUM_BITS));
    }
    if (render.diag.saturated > 0) {
        moments.mean = NAN;
    }
    return moments;
}

uint64_t estimate_brightest(
        mini_scene_t *m, const ql_settings_t *settings, uint32_t samples)
{
    ql_scene_t scene;
    ql_render_t render;
    uint64_t brightest = 0;

    begin(&render, &scene, m, settings);
    for (uint32_t i = 0; i < (uint32_t)m->width * m->height; i++) {
        ql_sum_t sum = {{0, 0, 0}};

        ql_render_pixel(&render, (uint16_t)(i % m->width),
                (uint16_t)(i / m->width), 0, samples, &sum);
        for (int k = 0; k < 3; k++) {
            brightest = sum.rgb[k] > brightest ? sum.rgb[k] : brightest;
        }
    }
    return brightest;
}

double estimate_z(const stats_moments_t *moments, double mean, double variance)
{
    return (moments->mean - mean) / sqrt(variance / moments->n);
}
