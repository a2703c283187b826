/* sky_share.c - how often the sky is chosen among the lights */
/* SPDX-License-Identifier: MIT */

#include "scene/choose/sky_share.h"

#include <stdlib.h>

#include "lib/math/build_cdf.h"
#include "lib/program/cli.h"

bool sky_share_matters(const model_t *model)
{
    return model->sky_count > 0 && model->lights_count > 1;
}

/* Where the values that choose a light end, of 2^32. */
static uint64_t end_of(const model_t *model, uint32_t light)
{
    return light + 1 < model->lights_count ? model->lights[light + 1].cum
                                           : (uint64_t)1 << 32;
}

void sky_share_set(model_t *model, unsigned n)
{
    const uint32_t count = model->lights_count, sky = count - 1;
    u128_t *weights = cli_alloc(count, sizeof *weights);
    uint64_t *shares = cli_alloc(count, sizeof *shares);
    uint64_t sum = 0;

    for (uint32_t i = 0; i < sky; i++) {
        weights[i] = u128_mul(end_of(model, i) - model->lights[i].cum, n - 1);
    }
    weights[sky] = u128_mul(model->lights[sky].cum, 1);
    cdf_shares(shares, weights, count);
    for (uint32_t i = 0; i < count; i++) {
        ql_blob_light_t *light = model->lights + i;

        light->cum = (uint32_t)sum;
        sum += shares[i];
        cdf_weight(shares[i], &light->weight_m, &light->weight_exp);
    }
    free(shares);
    free(weights);
}
