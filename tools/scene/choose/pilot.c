/* pilot.c - small pictures of a scene, one for each way of finding light */
/* SPDX-License-Identifier: MIT */

#include "scene/choose/pilot.h"

#include <stdlib.h>

#include "lib/cost/cost.h"
#include "lib/program/cli.h"

/* ---- Rendering --------------------------------------------------------- */

/* The largest size of PILOT_PIXELS at most that has about the scene's shape:
 * width^2 = PILOT_PIXELS * shape, to 1 or more each. */
static void fit(const ql_scene_t *scene, ql_settings_t *settings)
{
    const uint32_t w = QL_LE16(scene->header->image_width);
    const uint32_t h = QL_LE16(scene->header->image_height);
    const u128_t square = {0, (uint64_t)PILOT_PIXELS * w / h};
    uint64_t width = u128_sqrt(square); /* 0 to 6144 */

    width = width > PILOT_PIXELS ? PILOT_PIXELS : width < 1 ? 1 : width;
    settings->width = (uint16_t)width;
    settings->height = (uint16_t)(PILOT_PIXELS / width);
}

static void render_picture(const ql_scene_t *scene,
        const ql_settings_t *settings, ql_sum_t *sums, cost_events_t *events)
{
    ql_render_t render;

    if (ql_render_init(&render, scene, settings) != QL_OK) {
        cli_fail(CLI_INPUT, "the core of this program does not render pilots");
    }
    for (uint16_t y = 0; y < settings->height; y++) {
        for (uint16_t x = 0; x < settings->width; x++) {
            cost_render_pixel(events, &render, x, y, 0, settings->spp, sums++);
        }
    }
}

void pilot_render(
        pilot_t *pilot, const ql_scene_t *scene, const choice_way_t *way)
{
    ql_settings_t settings = QL_SETTINGS_DEFAULT;
    cost_events_t events = {0};

    fit(scene, &settings);
    settings.spp = PILOT_SPP;
    settings.direct = (uint8_t)way->direct;
    settings.lights = (uint8_t)way->lights;
    pilot->pixels = (uint32_t)settings.width * settings.height;
    for (unsigned i = 0; i < PILOT_PICTURES; i++) {
        pilot->sums[i] = cli_alloc(pilot->pixels, sizeof *pilot->sums[i]);
        settings.seed = i;
        render_picture(scene, &settings, pilot->sums[i], &events);
    }
    pilot->instructions = cost_instructions(&events, COST_M3, 0);
}

void pilot_free(pilot_t *pilot)
{
    for (unsigned i = 0; i < PILOT_PICTURES; i++) {
        free(pilot->sums[i]);
    }
}

/* ---- Comparing --------------------------------------------------------- */

/* What all pictures of a channel of a pixel add up to. A sum is PILOT_SPP
 * samples of a few contributions below 2^39 each, so below 2^48, and
 * 32 of them fit. */
static uint64_t add_all(
        const pilot_t *pilots, unsigned count, uint32_t pixel, unsigned channel)
{
    uint64_t sum = 0;

    for (unsigned i = 0; i < count; i++) {
        for (unsigned k = 0; k < PILOT_PICTURES; k++) {
            sum += pilots[i].sums[k][pixel].rgb[channel];
        }
    }
    return sum;
}

static soft_t square(soft_t x)
{
    return soft_mul(x, x);
}

/* M^2 / 100 of the mean M over pixels and channels of what add_all() says. */
static soft_t floor_of(const pilot_t *pilots, unsigned count)
{
    const uint32_t pixels = pilots->pixels;
    soft_t sum = soft_int(0, 0);

    for (uint32_t i = 0; i < 3 * pixels; i++) {
        const uint64_t all = add_all(pilots, count, i / 3, i % 3);

        sum = soft_add(sum, soft_int((int64_t)all, 0));
    }
    return soft_div(square(soft_div(sum, soft_int(3 * (int64_t)pixels, 0))),
            soft_int(100, 0));
}

void pilot_compare(soft_t *work, const pilot_t *pilots, unsigned count)
{
    const uint32_t pixels = pilots->pixels;
    const int64_t pictures = (int64_t)count * PILOT_PICTURES;
    const soft_t least = soft_int(3 * (int64_t)pixels, -20);
    const soft_t least_square = floor_of(pilots, count);

    for (unsigned i = 0; i < count; i++) {
        work[i] = soft_int(0, 0);
    }
    for (uint32_t j = 0; j < 3 * pixels && least_square.m != 0; j++) {
        const uint64_t all = add_all(pilots, count, j / 3, j % 3);
        const soft_t below =
                soft_add(square(soft_int((int64_t)all, 0)), least_square);

        for (unsigned i = 0; i < count; i++) {
            const int64_t a = (int64_t)pilots[i].sums[0][j / 3].rgb[j % 3];
            const int64_t b = (int64_t)pilots[i].sums[1][j / 3].rgb[j % 3];
            /* all is the sum of so many pictures, a and b are of one */
            const soft_t off =
                    soft_mul(soft_int(a - b, 0), soft_int(pictures, 0));

            work[i] = soft_add(work[i],
                    soft_div(soft_mul(square(off), soft_int(1, -1)), below));
        }
    }
    for (unsigned i = 0; i < count; i++) {
        work[i] = soft_compare(work[i], least) < 0 ? least : work[i];
        work[i] =
                soft_mul(work[i], soft_int((int64_t)pilots[i].instructions, 0));
    }
}
