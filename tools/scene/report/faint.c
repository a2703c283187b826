/* faint.c - lights too dim beside the brightest one for 32 bits, by name */
/* SPDX-License-Identifier: MIT */

#include "scene/report/faint.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "lib/math/soft.h"
#include "lib/program/cli.h"
#include "scene/mesh/gain.h"
#include "scene/sky/texel.h"

#define OFF    0.01  /* a lamp that is off by more is told */
#define GRAINY 0.125 /* a texel, one of many */
#define MOST   10    /* materials to name */

/* A light as one sees it, and as written, sums of channels. */
typedef struct {
    double kept, written;
} light_t;

/* How far a light is off: its factor or one over it, 1 at least; 1 of none. */
static double find_factor(light_t light)
{
    const double factor = light.kept / light.written;

    return light.written == 0 ? 1 : fmax(factor, 1 / factor);
}

/* What one sees of an emission: a product with the throughput has 31 bits. */
static double find_seen(const model_t *model, uint32_t emission)
{
    const uint32_t seen = emission / 2 + emission % 2;

    return ldexp(seen, model->header.radiance_exp - 31);
}

/* ---- materials ---- */

/* What the triangle at a place of the tree emits. */
static light_t find_emission(const model_t *model, const world_t *world,
        const grid_face_t *face, uint32_t i)
{
    const ql_blob_material_t *material =
            model->materials + (model->triangles[i].material & 0x3fffu);
    const double gain = soft_double(gain_value(face->gain));
    light_t light = {0, 0};

    for (int k = 0; k < 3; k++) {
        light.kept += find_seen(model, material->emission[k]);
        light.written += world->materials[face->material].ke[k] * gain;
    }
    return light;
}

/* The light of each material: of its surface that is farthest off; free it. */
static light_t *find_materials(const model_t *model, const world_t *world,
        const grid_t *grid, const bvh_t *bvh)
{
    light_t *lights = cli_alloc(world->material_count, sizeof *lights);

    for (size_t m = 0; m < world->material_count; m++) {
        lights[m].kept = lights[m].written = 0;
    }
    for (uint32_t i = 0; i < model->triangles_count; i++) {
        const grid_face_t *face = grid->faces + bvh->order[i];
        const light_t light = find_emission(model, world, face, i);
        light_t *worst = lights + face->material;

        if (worst->written == 0 || find_factor(light) > find_factor(*worst)) {
            *worst = light;
        }
    }
    return lights;
}

/* ---- the sky ---- */

typedef struct {
    light_t worst;     /* of the constant, or of texels that are not black */
    double brightest;  /* sum of channels, as written */
    size_t off, black; /* texels; those that are black only in the blob */
    double black_most; /* the brightest of these */
} sky_t;

static void add_light(sky_t *sky, light_t light, double limit)
{
    sky->brightest = fmax(sky->brightest, light.written);
    if (light.written > 0 && light.kept == 0) {
        sky->black++;
        sky->black_most = fmax(sky->black_most, light.written);
    } else if (find_factor(light) > 1 + limit) {
        sky->off++;
        sky->worst = find_factor(light) > find_factor(sky->worst) ? light
                                                                  : sky->worst;
    }
}

/* What the blob has where a map has a texel, counted from its upper left. */
static light_t find_texel(
        const model_t *model, const world_sky_t *sky, size_t i)
{
    const size_t x = i % sky->width;
    uint32_t rgb[3];
    light_t light = {0, 0};

    /* azimuth grows to the left of a map that is seen from inside */
    texel_unpack(model->texels[i - x + sky->width - 1 - x], rgb);
    for (size_t k = 0; k < 3; k++) {
        light.kept += find_seen(model, rgb[k]);
        light.written += (double)sky->map[3 * i + k];
    }
    return light;
}

static sky_t find_sky(const model_t *model, const world_sky_t *sky)
{
    sky_t found = {{0, 0}, 0, 0, 0, 0};
    light_t light = {0, 0};

    if (sky->map != NULL) {
        for (size_t i = 0; i < model->texels_count; i++) {
            add_light(&found, find_texel(model, sky, i), GRAINY);
        }
        return found;
    }
    for (int k = 0; k < 3; k++) {
        light.kept += model->sky_count > 0
                              ? find_seen(model, model->sky->emission[k])
                              : 0;
        light.written += sky->colour[k];
    }
    add_light(&found, light, OFF);
    return found;
}

/* ---- what is said ---- */

static void warn(
        const char *path, const char *name, light_t light, double brightest)
{
    cli_warn("%s: %s shines %.3g times as bright as written, because it is "
             "%.2g times dimmer than the brightest light",
            path, name, light.kept / light.written, brightest / light.written);
}

static void report_sky(const world_t *world, const sky_t *sky, double brightest)
{
    char name[80];

    if (sky->off > 0) {
        (void)snprintf(name, sizeof name,
                world->sky.map != NULL ? "%zu texels of the sky are off, one"
                                       : "the sky",
                sky->off);
        warn(world->path, name, sky->worst, brightest);
    }
    if (sky->black > 0) {
        cli_warn("%s: %zu texels of the sky are black, because they are %.2g "
                 "times dimmer than the brightest light, or dimmer",
                world->path, sky->black, brightest / sky->black_most);
    }
}

void faint_report(const model_t *model, const world_t *world,
        const grid_t *grid, const bvh_t *bvh)
{
    light_t *lights = find_materials(model, world, grid, bvh);
    const sky_t sky = find_sky(model, &world->sky);
    double brightest = sky.brightest;
    size_t count = 0;

    for (size_t m = 0; m < world->material_count; m++) {
        brightest = fmax(brightest, lights[m].written);
    }
    for (size_t m = 0; m < world->material_count; m++) {
        char name[80];

        if (find_factor(lights[m]) > 1 + OFF && count++ < MOST) {
            (void)snprintf(name, sizeof name, "material '%s'",
                    world->materials[m].name);
            warn(world->path, name, lights[m], brightest);
        }
    }
    if (count > MOST) {
        cli_warn(
                "%s: %zu more materials are as dim", world->path, count - MOST);
    }
    report_sky(world, &sky, brightest);
    free(lights);
}
