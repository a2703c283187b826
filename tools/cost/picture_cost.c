/* picture_cost.c - qlux-cost: instructions of a picture, without an emulator */
/* SPDX-License-Identifier: MIT */

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "lib/cost/cost.h"
#include "lib/program/options.h"
#include "lib/render/open_blob.h"
#include "lib/render/render_options.h"

#define COUNTED     8192 /* samples, about, that are counted */
#define COUNTED_SPP 4    /* of them of a pixel */

typedef struct {
    render_options_t render;
    unsigned precision;
} options_t;

static const char *const precisions[] = {"draft", "fine", NULL};

static const option_t own[] = {
        {"--precision P", OPTION_WORD, OPTION_FIELD(options_t, precision),
                .words = precisions, .help = "of the firmware"},
        OPTION_END};

static const option_section_t sections[] = {{NULL, render_options_scene},
        {"Picture", render_options_settings}, {"Firmware", own}, {NULL, NULL}};

static const program_t program = {.name = "qlux-cost",
        .about = "instructions of a picture on each core, without an emulator",
        .usage = "SCENE.qlb [options]",
        .sections = sections,
        .notes = "Renders some pixels, counts what the work is made of, and "
                 "prints a line \"CORE: INSTRUCTIONS\" for each core: of the "
                 "whole picture, by a table that was fitted to counts in "
                 "emulators (make cost-table). Most scenes are within 10 %.",
        .example = "qlux-cost room.qlb --size 128x64 --spp 16"};

/* The smallest step for which every step-th pixel of every step-th row is not
 * more than `most` pixels. */
static uint32_t step_of(uint32_t width, uint32_t height, uint32_t most)
{
    uint32_t step = 1;

    while (((width + step - 1) / step) * ((height + step - 1) / step) > most) {
        step++;
    }
    return step;
}

/* Count some samples; returns how many. */
static uint64_t count(cost_events_t *events, ql_render_t *render)
{
    const ql_settings_t *s = &render->settings;
    const uint32_t spp = s->spp < COUNTED_SPP ? s->spp : COUNTED_SPP;
    const uint32_t step = step_of(s->width, s->height, COUNTED / spp);
    uint64_t samples = 0;

    /* From the middle of what is left over, so there is one pixel at least. */
    for (uint32_t y = (s->height - 1u) % step / 2; y < s->height; y += step) {
        for (uint32_t x = (s->width - 1u) % step / 2; x < s->width; x += step) {
            ql_sum_t sum = {{0, 0, 0}};

            cost_render_pixel(
                    events, render, (uint16_t)x, (uint16_t)y, 0, spp, &sum);
            samples += spp;
        }
    }
    return samples;
}

int main(int argc, char **argv)
{
    options_t o = {.precision = 0};
    cost_events_t events = {0};
    ql_scene_t scene;
    ql_render_t render;
    ql_status_t status;
    void *blob;
    double all, samples;

    render_options_parse(&program, argc, argv, &o);
    blob = open_blob(&scene, o.render.scene);
    status = ql_render_init(&render, &scene, &o.render.settings);
    if (status != QL_OK) {
        cli_fail(CLI_INPUT, "%s: %s", o.render.scene, ql_status_text(status));
    }
    samples = (double)count(&events, &render);
    all = (double)render.settings.width * render.settings.height *
          render.settings.spp;
    for (unsigned core = 0; core < COST_CORES; core++) {
        const uint64_t counted =
                cost_instructions(&events, (cost_core_t)core, o.precision);

        printf("%s: %.0f\n", cost_core_name((cost_core_t)core),
                (double)counted / samples * all);
    }
    free(blob);
    return CLI_DONE;
}
