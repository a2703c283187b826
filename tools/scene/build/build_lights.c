/* build_lights.c - which surfaces shine, and how often each is chosen */
/* SPDX-License-Identifier: MIT */

#include "scene/build/build_lights.h"

#include <stdlib.h>

#include "lib/math/build_cdf.h"
#include "scene/build/build_sky.h"
#include "lib/program/cli.h"

/* Radiance units of all channels of an entry's material; < 2^34. */
static uint64_t sum_emission(const model_t *model, uint32_t tri)
{
    const ql_blob_material_t *material =
            model->materials + (model->triangles[tri].material & 0x3fffu);

    return (uint64_t)material->emission[0] + material->emission[1] +
           material->emission[2];
}

/* Twice the area with 32 fraction bits, below 2^63, times the emission. */
static u128_t weigh_triangle(
        const grid_t *grid, const grid_face_t *face, uint64_t emission)
{
    u128_t square = {0, 0};
    int64_t n[3];

    grid_normal(grid, face, n);
    square.high = (uint64_t)(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    return u128_mul(u128_sqrt(square), emission);
}

/* The same of a sphere: 8 pi R^2 2^32 of R in 1/256 units, below 2^65. */
static u128_t weigh_sphere(const ql_blob_sphere_t *sphere, uint64_t emission)
{
    const int64_t square = (int64_t)sphere->radius * sphere->radius;
    const soft_t area = soft_mul(soft_int(square, 3 - 16 + 32), soft_pi());

    return soft_floor(soft_mul(area, soft_int((int64_t)emission, 0)));
}

/* Of the sky: 8 pi Rs^2 2^32 = 2 pi D^2 2^32 of the diagonal D, below 2^67,
 * times its mean. */
static u128_t weigh_sky(const model_t *model, const grid_t *grid)
{
    int64_t square = 0;
    soft_t area;

    for (int k = 0; k < 3 && grid->face_count > 0; k++) {
        const int64_t side = grid->high[k] - grid->low[k];

        square += side * side;
    }
    square = square > 0 ? square : 1; /* nothing to shine on */
    area = soft_mul(soft_int(square, 1 + 32), soft_pi());
    return soft_floor(soft_mul(area, build_sky_mean(model)));
}

static u128_t weigh_face(const model_t *model, const grid_t *grid,
        const grid_face_t *face, uint64_t emission)
{
    return face->sphere != 0
                   ? weigh_sphere(model->spheres + face->sphere - 1, emission)
                   : weigh_triangle(grid, face, emission);
}

static void set_chances(model_t *model, const u128_t *power)
{
    uint64_t *shares = cli_alloc(model->lights_count, sizeof *shares);
    uint64_t sum = 0;

    if (model->lights_count > 0) {
        cdf_shares(shares, power, model->lights_count);
    }
    for (uint32_t i = 0; i < model->lights_count; i++) {
        ql_blob_light_t *light = model->lights + i;

        light->cum = (uint32_t)sum;
        sum += shares[i];
        cdf_weight(shares[i], &light->weight_m, &light->weight_exp);
    }
    free(shares);
}

void build_lights(
        model_t *model, const grid_t *grid, const bvh_t *bvh, const char *path)
{
    const size_t room = (size_t)model->triangles_count + 1;
    u128_t *power = cli_alloc(room, sizeof *power);

    model->lights = cli_alloc(room, sizeof *model->lights);
    for (uint32_t i = 0; i < model->triangles_count; i++) {
        const uint64_t emission = sum_emission(model, i);

        if (emission > 0) {
            power[model->lights_count] = weigh_face(
                    model, grid, grid->faces + bvh->order[i], emission);
            model->lights[model->lights_count++].triangle = (uint16_t)i;
        }
    }
    if (model->sky_count > 0) {
        power[model->lights_count] = weigh_sky(model, grid);
        model->lights[model->lights_count++].triangle = QL_LIGHT_SKY;
    }
    if (model->lights_count > QL_LIGHT_MAX) {
        cli_fail(CLI_INPUT,
                "%s: expected %lu lights at most, the sky included, found %lu",
                path, (unsigned long)QL_LIGHT_MAX,
                (unsigned long)model->lights_count);
    }
    set_chances(model, power);
    free(power);
}
