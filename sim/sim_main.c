/* sim_main.c - qlux-sim: render a scene on a PC to a picture and exact sums */
/* SPDX-License-Identifier: MIT */

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "film/ql_curve.h"
#include "qlux.h"
#include "lib/render/open_blob.h"
#include "lib/render/render_options.h"
#include "lib/render/rows.h"
#include "sim/sim_files.h"
#include "sim/sim_judge.h"
#include "sim/sim_render.h"

#if QL_CFG_PRECISION == 0
#define PROGRAM   "qlux-sim-draft"
#define PRECISION "draft"
#else
#define PROGRAM   "qlux-sim"
#define PRECISION "fine"
#endif

static const option_section_t sections[] = {{NULL, render_options_scene},
        {NULL, render_options_picture},
        {"The picture, the same on a board:", render_options_settings},
        {NULL, render_options_error},
        {"Parts of it, to be added up:", render_options_part},
        {NULL, render_options_sums}, {"At work:", render_options_run},
        {NULL, NULL}};

static const program_t program = {.name = PROGRAM,
        .about = "render a scene on this PC, the bits that a board renders "
                 "in " PRECISION " precision",
        .usage = "SCENE.qlb -o OUT.{ppm,pfm,png} [options]",
        .sections = sections,
        .notes = "Neither threads nor rows nor samples change a bit of what is "
                 "summed.",
        .example =
                PROGRAM " cornell.qlb -o cornell.png --size 256x256 --spp 64"};

/* The exposure that --exposure auto has, whatever this run asks for. */
static int16_t metered(const ql_render_t *render)
{
    ql_render_t copy = *render;

    return ql_render_meter(&copy);
}

/* What parts must have in common with this one. */
static void describe(sums_t *sums, const ql_render_t *render)
{
    const ql_settings_t *s = &render->settings;
    const ql_blob_header_t *h = render->scene->header;
    uint32_t *f = sums->field;

    f[SUMS_WIDTH] = s->width;
    f[SUMS_HEIGHT] = s->height;
    f[SUMS_BLOB_CRC] = QL_LE32(h->crc32);
    f[SUMS_SEED] = s->seed;
    f[SUMS_RADIANCE_EXP] =
            (uint32_t)(int32_t)ql_i16(QL_LE16((uint16_t)h->radiance_exp));
    f[SUMS_EXPOSURE_Q8] =
            (uint32_t)(int32_t)ql_i16(QL_LE16((uint16_t)h->exposure_q8));
    f[SUMS_POS_BITS] = QL_POS_BITS;
    f[SUMS_DIR_BITS] = QL_DIR_BITS;
    f[SUMS_BOUNCES] = s->bounces;
    f[SUMS_SAMPLER] = s->sampler;
    f[SUMS_DIRECT] = s->direct;
    f[SUMS_INDIRECT] = s->indirect;
    f[SUMS_LIGHTS] = s->lights;
    f[SUMS_LIGHT_SAMPLES] = s->light_samples;
    f[SUMS_ROULETTE] = s->roulette;
    f[SUMS_TABLE_BITS] = QL_CFG_TABLE_BITS;
    f[SUMS_TABLE_LERP] = QL_CFG_TABLE_LERP;
    f[SUMS_METERED_Q8] = (uint32_t)(int32_t)metered(render);
#if QL_CFG_CLAMP
    f[SUMS_CLAMP_Q16] = s->clamp_q16;
#endif
}

static void print_stats(const sim_stats_t *s, const ql_settings_t *settings)
{
    rows_print_stats(s->paths, s->closest_rays, s->shadow_rays);
    printf("saturated: %" PRIu64 "\n", s->saturated);
    printf("faint: %" PRIu64 "\n", s->faint);
    printf("seconds: %.3f\n", s->seconds);
    printf("precision: " PRECISION "\n");
    render_options_print(settings);
}

/* A sum of all pixels and channels. */
static double total(const sums_t *sums)
{
    double sum = 0;

    for (uint32_t y = sums->row_first; y < sums->row_end; y++) {
        for (uint32_t i = 0; i < 3 * sums->field[SUMS_WIDTH]; i++) {
            sum += (double)sums_pixels(sums, y)[i / 3].rgb[i % 3];
        }
    }
    return sum;
}

/* What was metered; what was cut off, a part of the mean without a cut. */
static void print_film(const render_options_t *o, const sums_t *sums)
{
    const uint64_t *rgb = sums->cut.rgb;
    const double cut = (double)rgb[0] + (double)rgb[1] + (double)rgb[2];

    if (o->settings.meter) {
        printf("exposure: %.8g\n", o->settings.exposure_q8 / 256.0);
    }
    if (sums->field[SUMS_CLAMP_Q16] != 0) {
        printf("clamp-bias: %.6g\n", cut > 0 ? -cut / (total(sums) + cut) : 0);
    }
}

/* Everything after the options. A second signal ends the program at once. */
static void run(render_options_t *o, const ql_render_t *render)
{
    const sums_range_t whole = {
            o->rows.first, o->rows.end, o->samples.first, o->samples.end};
    sim_how_t how = {.threads = o->threads, .quiet = o->quiet || o->show};
    sim_files_t files;
    sim_stats_t stats;
    sums_t sums;

    memset(&sums, 0, sizeof sums);
    describe(&sums, render);
    sums_new(&sums, o->rows.first, o->rows.end);
    if (o->resume != NULL) {
        sim_files_resume(&sums, o->resume, &whole);
    }
    sim_files_open(&files, o);
    if (o->progressive || o->show) {
        how.passed = sim_files_renew;
        how.to = &files;
    }
    cli_hold_signals();
    if (!sim_render(&sums, render, &whole, &how, &stats)) {
        sim_files_write_part(&files, &sums);
    }
    sim_files_write(&files, &sums);
    (void)cli_release_signals();
    if (o->picture != NULL && o->kind != IMAGE_PFM) {
        sim_judge(&sums, o->settings.exposure_q8, ql_curve_of(&o->settings));
    }
    if (stats.saturated > 0 && !o->stats) {
        cli_warn("%" PRIu64 " contributions were cut at their limit",
                stats.saturated);
    }
    if (o->stats) {
        print_stats(&stats, &render->settings);
        print_film(o, &sums);
        if (sums.counts != NULL) {
            printf("samples-per-pixel: %.3f\n", sim_files_mean_count(&sums));
        }
    }
    sums_free(&sums);
}

int main(int argc, char **argv)
{
    render_options_t options;
    ql_render_t render;
    ql_scene_t scene;
    ql_status_t status;
    void *blob;

    render_options_parse(&program, argc, argv, &options);
    if (options.picture == NULL && options.save == NULL) {
        options_fail("missing -o FILE or --save-sums FILE");
    }
    blob = open_blob(&scene, options.scene);
    status = ql_render_init(&render, &scene, &options.settings);
    options.settings.exposure_q8 = render.settings.exposure_q8;
    if (status != QL_OK) {
        options_fail("%s", ql_status_text(status));
    }
    render_options_rows(&options, render.settings.height);
    run(&options, &render);
    free(blob);
    return CLI_DONE;
}
