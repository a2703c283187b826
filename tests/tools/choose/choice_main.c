/* choice_main.c - is what auto stands for as good as the best way there is? */
/* SPDX-License-Identifier: MIT */

/* usage: choice BLOB [SIZE PICTURES]
 *
 * Renders pictures of a blob in each way of finding light, of SIZE pixels each
 * way and 64 samples, what a PC takes unless told, with seeds that no pilot
 * has, and prints a line a way: its relMSE, from how pictures of different
 * seeds differ; its instructions a sample on a Cortex-M3; their product over
 * the least one. The last line is that of the way that auto stands for. Sums
 * are in double: nothing of this is shared with qlux-scene but the core and
 * the table of instructions. */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/cost/cost.h"
#include "lib/render/open_blob.h"
#include "lib/render/render_options.h"

enum { SPP = 64, ALL_MAX = 16, SEED = 1000, WAYS = 6 };

static const uint8_t directs[] = {
        QL_DIRECT_AREA, QL_DIRECT_SOLID_ANGLE, QL_DIRECT_MIS};

typedef struct {
    uint8_t direct, lights;
    double *sum, *square; /* of each value over the pictures */
    double instructions, error;
} way_t;

static void render(
        way_t *way, const ql_scene_t *scene, unsigned size, unsigned pictures)
{
    ql_settings_t settings = QL_SETTINGS_DEFAULT;
    cost_events_t events = {0};
    ql_render_t render;

    settings.width = settings.height = (uint16_t)size;
    settings.spp = SPP;
    settings.direct = way->direct;
    settings.lights = way->lights;
    for (unsigned k = 0; k < pictures; k++) {
        settings.seed = SEED + k;
        if (ql_render_init(&render, scene, &settings) != QL_OK) {
            exit(2);
        }
        for (unsigned i = 0; i < size * size; i++) {
            ql_sum_t sum = {{0, 0, 0}};

            cost_render_pixel(&events, &render, (uint16_t)(i % size),
                    (uint16_t)(i / size), 0, SPP, &sum);
            for (unsigned c = 0; c < 3; c++) {
                const double value = (double)sum.rgb[c];

                way->sum[3 * i + c] += value;
                way->square[3 * i + c] += value * value;
            }
        }
    }
    way->instructions = (double)cost_instructions(&events, COST_M3, 0) /
                        ((double)SPP * size * size * pictures);
}

/* The mean of variance / (mean^2 + 0.01 mean of means^2), the means being those
 * of all ways. */
static void compare(
        way_t *ways, unsigned count, unsigned values, unsigned pictures)
{
    double *mean = calloc(values, sizeof *mean), all = 0;

    for (unsigned i = 0; i < values; i++) {
        for (unsigned w = 0; w < count; w++) {
            mean[i] += ways[w].sum[i] / pictures / count;
        }
        all += mean[i] / values;
    }
    for (unsigned w = 0; w < count; w++) {
        for (unsigned i = 0; i < values; i++) {
            const double m = ways[w].sum[i] / pictures;
            const double variance =
                    (ways[w].square[i] - pictures * m * m) / (pictures - 1);

            ways[w].error +=
                    variance / (mean[i] * mean[i] + 0.01 * all * all) / values;
        }
    }
    free(mean);
}

int main(int argc, char **argv)
{
    const unsigned size = argc > 2 ? (unsigned)atoi(argv[2]) : 24;
    const unsigned pictures = argc > 3 ? (unsigned)atoi(argv[3]) : 3;
    const unsigned values = 3 * size * size;
    way_t ways[WAYS];
    unsigned count = 0;
    double least = 0;
    ql_scene_t scene;
    void *blob = open_blob(&scene, argv[1]);

    for (unsigned i = 0; i < WAYS; i++) {
        const uint8_t lights = i % 2 == 0 ? QL_LIGHTS_POWER : QL_LIGHTS_ALL;

        if (i % 2 == 0 ||
                (scene.light_count > 1 && scene.light_count <= ALL_MAX)) {
            way_t *way = ways + count++;

            memset(way, 0, sizeof *way);
            way->direct = directs[i / 2];
            way->lights = lights;
            way->sum = calloc(values, sizeof *way->sum);
            way->square = calloc(values, sizeof *way->square);
            render(way, &scene, size, pictures);
        }
    }
    compare(ways, count, values, pictures);
    for (unsigned w = 0; w < count; w++) {
        const double work = ways[w].error * ways[w].instructions;

        least = w == 0 || work < least ? work : least;
    }
    for (unsigned pass = 0; pass < 2; pass++) {
        for (unsigned w = 0; w < count; w++) {
            const bool is_auto = ways[w].direct == scene.header->auto_direct &&
                                 ways[w].lights == scene.header->auto_lights;

            if (pass == 0 || is_auto) {
                printf("%s %s %s %.5f %.0f %.2f\n", pass == 0 ? "way" : "auto",
                        render_words_direct[ways[w].direct],
                        render_words_lights[ways[w].lights], ways[w].error,
                        ways[w].instructions,
                        ways[w].error * ways[w].instructions / least);
            }
        }
    }
    free(blob);
    return 0;
}
