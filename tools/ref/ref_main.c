/* ref_main.c - qlux-ref: a scene in double precision, as the core renders it */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "film/ql_curve.h"
#include "qlux.h"
#include "ref/ref.h"
#include "lib/render/open_blob.h"
#include "lib/render/render_options.h"
#include "lib/render/rows.h"
#include "scene/ql_auto.h"

static const option_section_t sections[] = {{NULL, render_options_scene},
        {NULL, render_options_picture},
        {"The picture, as qlux-sim has it:", render_options_settings},
        {"A part of it:", render_options_part},
        {"At work:", render_options_run}, {NULL, NULL}};

static const program_t program = {.name = "qlux-ref",
        .about = "a scene in double precision, with the random numbers of "
                 "qlux-sim: what differs is the rounding of the core's "
                 "integers",
        .usage = "SCENE.qlb -o OUT.{pfm,ppm,png} [options]",
        .sections = sections,
        .notes = "Each pixel takes all its samples, so there is no --error; "
                 "sums of doubles are not exact, so there is no --save-sums.",
        .example = "qlux-sim cornell.qlb -o a.pfm --spp 64\n"
                   "qlux-ref cornell.qlb -o b.pfm --spp 64\n"
                   "qlux-diff a.pfm b.pfm"};

/* What the threads share. */
typedef struct {
    const ref_scene_t *scene;
    const render_options_t *options;
    double *rgb; /* sums in radiance units, of the rows asked for */
    ref_stats_t stats;
} job_t;

/* The sums of a row. */
static double *row_of(const job_t *job, uint32_t y)
{
    const render_options_t *o = job->options;

    return job->rgb + 3 * (size_t)o->settings.width * (y - o->rows.first);
}

static void draw(void *shared, void *own, uint16_t x, uint16_t y,
        uint32_t first, uint32_t count)
{
    const job_t *job = shared;

    ref_pixel(job->scene, &job->options->settings, x, y, first, count,
            row_of(job, y) + 3 * (size_t)x, own);
}

static void collect(void *shared, void *own)
{
    ref_stats_t *to = &((job_t *)shared)->stats, *from = own;

    to->paths += from->paths;
    to->closest_rays += from->closest_rays;
    to->shadow_rays += from->shadow_rays;
    memset(from, 0, sizeof *from);
}

static void render(job_t *job)
{
    const render_options_t *o = job->options;
    const ref_stats_t none = {0, 0, 0};
    const rows_t rows = {.label = "reference",
            .width = o->settings.width,
            .range = {o->rows.first, o->rows.end, o->samples.first,
                    o->samples.end},
            .step = ROWS_STEP,
            .threads = o->threads,
            .quiet = o->quiet,
            .job = job,
            .own = &none,
            .own_bytes = sizeof none,
            .draw = draw,
            .collect = collect};

    cli_hold_signals();
    if (!rows_render(&rows)) {
        cli_fail(CLI_IO, "interrupted; nothing was written");
    }
    (void)cli_release_signals();
}

/* Means as a picture of floats. */
static void write_linear(const job_t *job, cli_out_t *out)
{
    const render_options_t *o = job->options;
    const double scale = job->scene->unit / (o->samples.end - o->samples.first);
    image_writer_t writer;
    image_t line;

    image_new_floats(&line, o->settings.width, 1);
    image_begin(&writer, IMAGE_PFM, line.width, o->settings.height, out);
    for (uint32_t i = 0; i < o->settings.height; i++) {
        const uint32_t y = image_row_at(&writer, i);
        const bool is_there = o->rows.first <= y && y < o->rows.end;

        for (uint32_t k = 0; k < 3 * line.width; k++) {
            line.floats[k] = is_there ? (float)(row_of(job, y)[k] * scale) : 0;
        }
        image_row(&writer, &line);
    }
    image_end(&writer);
    image_free(&line);
}

/* A row of the core's sums. */
typedef struct {
    const job_t *job;
    ql_sum_t *row;
} rounded_t;

static const ql_sum_t *round_row(void *from, uint32_t y)
{
    const rounded_t *rounded = from;
    const double *rgb = row_of(rounded->job, y);

    for (uint32_t k = 0; k < 3u * rounded->job->options->settings.width; k++) {
        const double sum = ldexp(rgb[k], QL_SUM_BITS) + 0.5;

        rounded->row[k / 3].rgb[k % 3] =
                sum < ldexp(1, 63) ? (uint64_t)sum : UINT64_MAX;
    }
    return rounded->row;
}

/* As a display shows it, by way of the core's sums. */
static void write_display(const job_t *job, cli_out_t *out)
{
    const render_options_t *o = job->options;
    const ql_blob_header_t *h = job->scene->blob->header;
    const sums_range_t range = {
            o->rows.first, o->rows.end, o->samples.first, o->samples.end};
    rounded_t rounded = {job, cli_alloc(o->settings.width, sizeof(ql_sum_t))};
    const develop_t how = {.kind = o->kind,
            .format = o->format,
            .curve = ql_curve_of(&o->settings),
            .exposure_q8 = o->settings.exposure_q8,
            .row = round_row,
            .from = &rounded};
    sums_t sums;

    memset(&sums, 0, sizeof sums);
    sums.field[SUMS_WIDTH] = o->settings.width;
    sums.field[SUMS_HEIGHT] = o->settings.height;
    sums.field[SUMS_RADIANCE_EXP] =
            (uint32_t)(int32_t)ql_i16(QL_LE16((uint16_t)h->radiance_exp));
    sums.field[SUMS_EXPOSURE_Q8] =
            (uint32_t)(int32_t)ql_i16(QL_LE16((uint16_t)h->exposure_q8));
    sums_new(&sums, 0, 0);
    sums_settle_one(&sums, &range);
    develop_write(&sums, &how, out);
    sums_free(&sums);
    free(rounded.row);
}

static void print_stats(
        const ref_stats_t *s, const ql_settings_t *settings, double seconds)
{
    rows_print_stats(s->paths, s->closest_rays, s->shadow_rays);
    printf("seconds: %.3f\n", seconds);
    printf("precision: double\n");
    render_options_print(settings);
}

/* The core's exposure, so that pictures can be compared. */
static void meter(ql_settings_t *settings, const ql_scene_t *scene)
{
    ql_render_t render;

    if (ql_render_init(&render, scene, settings) == QL_OK) {
        settings->exposure_q8 = render.settings.exposure_q8;
    }
}

/* The picture as it will be; rows within it. */
static void resolve(render_options_t *o, const ql_scene_t *scene)
{
    ql_auto_resolve(&o->settings, scene->header);
    render_options_rows(o, o->settings.height);
}

int main(int argc, char **argv)
{
    const double begun = cli_seconds();
    render_options_t options;
    ref_scene_t scene;
    ql_scene_t blob;
    cli_out_t out;
    job_t job;
    void *bytes;

    render_options_parse(&program, argc, argv, &options);
    if (options.picture == NULL) {
        options_fail("missing -o FILE");
    }
    bytes = open_blob(&blob, options.scene);
    resolve(&options, &blob);
    ref_scene_init(&scene, &blob);
    memset(&job, 0, sizeof job);
    meter(&options.settings, &blob);
    job.scene = &scene;
    job.options = &options;
    job.rgb = cli_alloc((size_t)options.settings.width *
                                (options.rows.end - options.rows.first),
            3 * sizeof *job.rgb);
    cli_out_open(&out, options.picture);
    render(&job);
    if (options.kind == IMAGE_PFM) {
        write_linear(&job, &out);
    } else {
        write_display(&job, &out);
    }
    cli_out_commit(&out);
    if (options.stats) {
        print_stats(&job.stats, &options.settings, cli_seconds() - begun);
    }
    free(job.rgb);
    ref_scene_free(&scene);
    free(bytes);
    return CLI_DONE;
}
