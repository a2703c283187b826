/* scene_info.c - a summary of a blob, line by line */
/* SPDX-License-Identifier: MIT */

#include "scene/scene_info.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>

#include "lib/math/soft.h"
#include "lib/render/render_options.h"
#include "scene/blob/write_blob.h"
#include "scene/choose/choice.h"

static void print_features(FILE *file, uint32_t features)
{
#define PRINT_FEATURE(name, bit, text)                                         \
    if ((features & (uint32_t)name) != 0) {                                    \
        fprintf(file, " %s", text);                                            \
    }
    QL_FEATURE_LIST(PRINT_FEATURE)
#undef PRINT_FEATURE
    fputc('\n', file);
}

/* Leaves of the tree: a binary tree has one more than inner nodes. */
static uint32_t count_leaves(const model_t *model)
{
    return model->triangles_count > 0 ? model_pair_count(model) + 1 : 0;
}

static void print_sizes(FILE *file, const model_t *model)
{
    size_t size;

    free(write_blob(model, &size));
    fprintf(file, "bytes: %zu\n", size);
    if (model->triangles_count > 0) {
        const unsigned long hundredths =
                (unsigned long)((size * 100 + model->triangles_count / 2) /
                                model->triangles_count);

        fprintf(file, "bytes-per-triangle: %lu.%02lu\n", hundredths / 100,
                hundredths % 100);
    }
}

static void print_gloss(FILE *file, const model_t *model)
{
    uint32_t count[QL_GLOSS_GLASS + 1] = {0};

    for (uint32_t i = 0; i < model->gloss_count; i++) {
        count[model->gloss[i].kind]++; /* checked when opened */
    }
    fprintf(file, "phong-materials: %" PRIu32 "\n", count[QL_GLOSS_PHONG]);
    fprintf(file, "mirror-materials: %" PRIu32 "\n", count[QL_GLOSS_MIRROR]);
    fprintf(file, "glass-materials: %" PRIu32 "\n", count[QL_GLOSS_GLASS]);
}

/* How often the sky is chosen among the lights, the last of which it is. */
static double sky_chance(const model_t *model)
{
    const uint32_t cum = model->lights[model->lights_count - 1].cum;

    return 1 - cum / 4294967296.0;
}

static void print_sky(FILE *file, const model_t *model)
{
    if (model->sky_count == 0) {
        fputs("sky: none\n", file);
    } else if (model->sky->width == 0) {
        fputs("sky: constant\n", file);
    } else {
        fprintf(file, "sky: %u %u\n", (unsigned)model->sky->width,
                (unsigned)model->sky->height);
    }
    if (model->sky_count > 0) {
        fprintf(file, "sky-chance: %.3g\n", sky_chance(model));
    }
    fprintf(file, "tables: %" PRIu32 "\n", model->tables_count);
    fprintf(file, "table-words: %" PRIu32 "\n", model->words_count);
    fprintf(file, "lens: %s\n", model->lens_count > 0 ? "yes" : "no");
}

/* Vertices that have a normal. */
static uint32_t count_smooth(const model_t *model)
{
    uint32_t count = 0;

    for (uint32_t i = 0; i < model->normals_count; i++) {
        const int16_t *n = model->normals[i].xyz;

        count += (n[0] | n[1] | n[2]) != 0;
    }
    return count;
}

static void print_lights(FILE *file, const model_t *model)
{
    uint32_t emissive = 0;

    for (uint32_t m = 0; m < model->materials_count; m++) {
        const uint32_t *e = model->materials[m].emission;

        emissive += (e[0] | e[1] | e[2]) != 0;
    }
    fprintf(file, "materials: %" PRIu32 "\n", model->materials_count);
    print_gloss(file, model);
    fprintf(file, "emissive-materials: %" PRIu32 "\n", emissive);
    fprintf(file, "lights: %" PRIu32 "\n", model->lights_count);
    fprintf(file, "radiance-unit: 2^%d\n", model->header.radiance_exp);
}

/* A way, in the words of the options: with DASH between them. */
static void print_way(
        FILE *file, unsigned direct, const char *dash, unsigned lights)
{
    fprintf(file, "%s%s%s", render_words_direct[direct], dash,
            render_words_lights[lights]); /* checked when opened */
}

static void print_trial(FILE *file, unsigned trial)
{
    fprintf(file, "%s%.3g", trial == QL_TRIAL_MOST ? ">=" : "",
            exp2(trial / 16.0));
}

/* What auto stands for, and how the ways that were tried compare. */
static void print_choice(FILE *file, const ql_blob_header_t *h)
{
    fputs("auto: ", file);
    print_way(file, h->auto_direct, " ", h->auto_lights);
    fputc('\n', file);
    for (unsigned i = 0; i < CHOICE_WAYS; i++) {
        if (h->trials[i] != QL_TRIAL_NONE) {
            fputs("trial-", file);
            print_way(file, choice_ways[i].direct, "-", choice_ways[i].lights);
            fputs(": ", file);
            print_trial(file, h->trials[i]);
            fputc('\n', file);
        }
    }
}

void print_choice_line(FILE *file, const model_t *model)
{
    const ql_blob_header_t *h = &model->header;
    const char *before = " (work for the same error: ";

    fputs("auto is ", file);
    print_way(file, h->auto_direct, " by ", h->auto_lights);
    for (unsigned i = 0; i < CHOICE_WAYS; i++) {
        if (h->trials[i] != QL_TRIAL_NONE) {
            fputs(before, file);
            print_way(
                    file, choice_ways[i].direct, " by ", choice_ways[i].lights);
            fputc(' ', file);
            print_trial(file, h->trials[i]);
            before = ", ";
        }
    }
    fputs(*before == ',' ? ")\n" : "\n", file);
}

void print_info(FILE *file, const model_t *model)
{
    const ql_blob_header_t *h = &model->header;
    const soft_t unit = soft_int(h->unit_m, h->unit_exp);
    const soft_t half = soft_int(h->unit_m, h->unit_exp - 1);

    fprintf(file, "version: %u\n", (unsigned)h->version);
    fprintf(file, "triangles: %" PRIu32 "\n",
            model->triangles_count - model->spheres_count);
    fprintf(file, "spheres: %" PRIu32 "\n", model->spheres_count);
    fprintf(file, "vertices: %" PRIu32 "\n", model->vertices_count);
    fprintf(file, "smooth-vertices: %" PRIu32 "\n", count_smooth(model));
    fprintf(file, "nodes: %" PRIu32 "\n", 2 * model_pair_count(model) + 1);
    fprintf(file, "leaves: %" PRIu32 "\n", count_leaves(model));
    fprintf(file, "depth: %u\n", (unsigned)h->depth);
    fprintf(file, "node-bits: %u\n", model_node_bits(model));
    print_lights(file, model);
    print_sky(file, model);
    print_choice(file, h);
    fputs("features:", file);
    print_features(file, h->features);
    fprintf(file, "image: %u %u\n", (unsigned)h->image_width,
            (unsigned)h->image_height);
    fprintf(file, "exposure: %.8g\n", h->exposure_q8 / 256.0);
    fprintf(file, "unit: %.9g\n", soft_double(unit));
    fprintf(file, "rounding: %.3g\n", soft_double(half));
    print_sizes(file, model);
    fprintf(file, "crc32: %08" PRIx32 "\n", h->crc32);
}
