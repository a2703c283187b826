/* build_sky.c - light from all around, in fixed point */
/* SPDX-License-Identifier: MIT */

#include "scene/build/build_sky.h"

#include <math.h>
#include <stdlib.h>

#include "scene/build/add_table.h"
#include "lib/program/cli.h"
#include "scene/sky/texel.h"

enum { ROW_BITS = 40 };

soft_t build_sky_most(const world_sky_t *sky)
{
    const size_t n =
            sky->map != NULL ? 3 * (size_t)sky->width * sky->height : 0;
    double most = 0;

    for (size_t i = 0; i < n; i++) {
        most = sky->map[i] > most ? (double)sky->map[i] : most;
    }
    if (n > 0) {
        /* 2^32 units stand for what a texel reaches, 511 2^23 = 1022/1024 */
        return soft_div(soft_from(most), soft_int(1022, -10));
    }
    for (int k = 0; k < 3; k++) {
        most = sky->colour[k] > most ? sky->colour[k] : most;
    }
    return soft_from(most);
}

/* ---- a map ---- */

/* sin(theta) at the middle of a row: the solid angle of a texel is that times
 * 4 pi sin(pi / 2h) / w. An integer, so that every host has the same. */
static int64_t find_sine(uint32_t row, uint32_t height)
{
    const soft_t x =
            soft_div(soft_int(2 * (int64_t)row + 1, -1), soft_int(height, 0));

    return soft_round(soft_sin_pi(x), ROW_BITS);
}

/* What a texel sends: the sum of its channels times the sine of its row. The
 * sum is 11 bits times a power of two, the sine 41: no double rounds it. */
static double weigh_texel(ql_blob_texel_t texel, int64_t sine)
{
    uint32_t sum = 0;

    for (unsigned k = 0; k < 3; k++) {
        sum += texel.rgb9e5 >> TEXEL_BITS * k & TEXEL_MOST;
    }
    return ldexp((double)((int64_t)sum * sine), (int)(texel.rgb9e5 >> 27));
}

static void build_map(model_t *model, const world_t *world)
{
    const world_sky_t *sky = &world->sky;
    const uint32_t n = sky->width * sky->height; /* <= 2^24 */
    double *weights = cli_alloc(n, sizeof *weights);
    world_table_t table = {2, {0, 0, 1}, NULL};
    bool black = true;

    model->texels = cli_alloc(n, sizeof *model->texels);
    model->texels_count = n;
    /* A file is what one sees from inside, where the azimuth of a blob, from
     * +z to +x, runs to the left. */
    for (uint32_t y = 0; y < sky->height; y++) {
        const int64_t sine = find_sine(y, sky->height);
        const size_t row = (size_t)y * sky->width;

        for (uint32_t x = 0; x < sky->width; x++) {
            const float *rgb = sky->map + 3 * (row + sky->width - 1 - x);

            model->texels[row + x] =
                    texel_round(rgb, model->header.radiance_exp);
            weights[row + x] = weigh_texel(model->texels[row + x], sine);
            black = black && weights[row + x] == 0;
        }
    }
    if (black) {
        cli_fail(CLI_INPUT,
                "%s: expected a sky less than 2^32 times as dim as "
                "the brightest light",
                world->path);
    }
    table.count[0] = (uint16_t)sky->width; /* <= 4096 */
    table.count[1] = (uint16_t)sky->height;
    table.weights = weights;
    model->sky->width = table.count[0];
    model->sky->height = table.count[1];
    model->sky->table = (uint16_t)model->tables_count;
    model->sky->rotate = (uint32_t)(uint64_t)soft_round(
            soft_div(soft_from(sky->rotate), soft_int(360, 0)), 32);
    add_table(model, &table, world->path);
    free(weights);
}

/* ---- the whole ---- */

void build_sky(model_t *model, const world_t *world)
{
    const int bits = 32 - model->header.radiance_exp;

    if (build_sky_most(&world->sky).m == 0) {
        return;
    }
    model->sky = cli_alloc(1, sizeof *model->sky);
    model->sky_count = 1;
    if (world->sky.map != NULL) {
        build_map(model, world);
        return;
    }
    for (int k = 0; k < 3; k++) {
        const soft_t x = soft_from(world->sky.colour[k]);
        const uint32_t rounded = (uint32_t)soft_round(x, bits);

        /* what shines must not stop shining; 2^32 cannot be reached */
        model->sky->emission[k] = rounded == 0 && x.m != 0 ? 1 : rounded;
    }
}

static soft_t sum_channels(const uint32_t channels[3])
{
    return soft_int(
            (int64_t)((uint64_t)channels[0] + channels[1] + channels[2]), 0);
}

soft_t build_sky_mean(const model_t *model)
{
    const uint32_t width = model->sky->width, height = model->sky->height;
    soft_t sum = soft_int(0, 0), angle = soft_int(0, 0);

    if (width == 0) {
        return sum_channels(model->sky->emission);
    }
    for (uint32_t y = 0; y < height; y++) {
        const soft_t sine = soft_int(find_sine(y, height), 0);
        soft_t row = soft_int(0, 0);

        for (uint32_t i = y * width; i < (y + 1) * width; i++) {
            uint32_t channels[3];

            texel_unpack(model->texels[i], channels);
            row = soft_add(row, sum_channels(channels));
        }
        sum = soft_add(sum, soft_mul(row, sine));
        angle = soft_add(angle, sine);
    }
    return soft_div(sum, soft_mul(angle, soft_int(width, 0)));
}
