/* trade_error.c - the error of a picture as its samples double */
/* SPDX-License-Identifier: MIT */

/* Linked with a core of each choice of precision and tables. With two
 * references a and b of independent random numbers (x - a)(x - b) has the mean
 * (x - truth)^2, whatever their own noise, so they need not be converged far
 * below the errors that are measured. */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/image/image_file.h"
#include "qlux.h"
#include "lib/render/open_blob.h"
#include "lib/render/render_options.h"

typedef struct {
    render_options_t render; /* first: render_options_parse() */
    const char *a, *b;
    double enough;
} options_t;

#define AT(field) OPTION_FIELD(options_t, field)

static const option_t arguments[] = {
        {"A.pfm", OPTION_TEXT, AT(a), .required = true},
        {"B.pfm", OPTION_TEXT, AT(b), .required = true},
        {"ENOUGH", OPTION_REAL, AT(enough), .max = HUGE_VAL, .required = true},
        OPTION_END};

static const option_section_t sections[] = {{NULL, arguments},
        {NULL, render_options_scene}, {NULL, render_options_settings},
        {NULL, render_options_error}, {NULL, NULL}};

static const program_t program = {.name = "trade-error",
        .about = "the error of a picture as its samples double",
        .usage = "A.pfm B.pfm ENOUGH SCENE.qlb [options]",
        .sections = sections,
        .notes = "A and B are references with different seeds. Prints a line "
                 "for 1, 2, 4, .. samples a pixel up to --spp, or until the "
                 "error is below ENOUGH, or the bias above it after 1024: "
                 "\"samples error bias\". The error is the root of relMSE (see "
                 "qlux-diff) against what both references estimate, the bias "
                 "the relative difference of the means. With --error pixels "
                 "end by themselves: one line, with their mean number of "
                 "samples.",
        .example = "trade-error a.pfm b.pfm 0.01 cornell.qlb --size 36x36 "
                   "--spp 1024"};

#define BIAS_IS_KNOWN 1024 /* samples a pixel */

typedef struct {
    image_t a, b;     /* references */
    ql_sum_t *sums;   /* of a pixel: its samples so far */
    uint32_t *counts; /* how many */
    double unit;      /* of a sum, in the units of Ke */
    size_t pixels;
} measure_t;

typedef struct {
    double samples; /* a pixel, mean */
    double error;
    double bias;
} figures_t;

/* Mean of a reference's values. */
static double mean_of(const image_t *image, size_t count)
{
    double sum = 0;

    for (size_t i = 0; i < count; i++) {
        sum += image->floats[i];
    }
    return sum / (double)count;
}

static figures_t figures_of(const measure_t *m)
{
    const size_t n = 3 * m->pixels;
    const double mean = (mean_of(&m->a, n) + mean_of(&m->b, n)) / 2;
    double got = 0, square = 0, samples = 0;
    figures_t f;

    for (size_t i = 0; i < n; i++) {
        const double a = m->a.floats[i], b = m->b.floats[i];
        const double x =
                (double)m->sums[i / 3].rgb[i % 3] * m->unit / m->counts[i / 3];

        got += x;
        square += (x - a) * (x - b) /
                  ((a + b) * (a + b) / 4 + 0.01 * mean * mean);
    }
    for (size_t i = 0; i < m->pixels; i++) {
        samples += m->counts[i];
    }
    f.samples = samples / (double)m->pixels;
    f.error = sqrt(fmax(square / (double)n, 0));
    f.bias = got / (double)n / mean - 1;
    printf("%.6g %.6g %.6g\n", f.samples, f.error, f.bias);
    fflush(stdout);
    return f;
}

/* Every pixel up to so many samples; or as many as its error needs. */
static void render_to(measure_t *m, ql_render_t *render, uint32_t end)
{
    const ql_settings_t *s = &render->settings;

    for (size_t i = 0; i < m->pixels; i++) {
        const uint16_t x = (uint16_t)(i % s->width);
        const uint16_t y = (uint16_t)(i / s->width);

        if (s->error_q16 != 0) {
            m->counts[i] = ql_render_adaptive(render, x, y, m->sums + i);
        } else {
            ql_render_pixel(render, x, y, m->counts[i], end - m->counts[i],
                    m->sums + i);
            m->counts[i] = end;
        }
    }
}

/* Whether more samples may bring the error below what is enough: they bring no
 * bias down, which after so many is known. */
static bool may_help(const figures_t *f, double enough)
{
    return f->error > enough &&
           (f->samples < BIAS_IS_KNOWN || fabs(f->bias) < enough);
}

static void measure(measure_t *m, ql_render_t *render, double enough)
{
    const ql_settings_t *s = &render->settings;
    uint32_t samples = s->error_q16 != 0 ? s->spp : 1;
    figures_t f;

    do {
        render_to(m, render, samples);
        f = figures_of(m);
        samples *= 2; /* at most 2^25 */
    } while (may_help(&f, enough) && samples <= s->spp);
}

static void read_reference(
        image_t *image, const char *path, const ql_settings_t *s)
{
    image_read(image, path);
    if (image->floats == NULL || image->width != s->width ||
            image->height != s->height) {
        cli_fail(CLI_INPUT, "%s: expected a PFM of %ux%u", path, s->width,
                s->height);
    }
}

int main(int argc, char **argv)
{
    options_t options;
    measure_t m;
    ql_render_t render;
    ql_scene_t scene;
    void *blob;

    render_options_parse(&program, argc, argv, &options);
    blob = open_blob(&scene, options.render.scene);
    if (ql_render_init(&render, &scene, &options.render.settings) != QL_OK) {
        options_fail("a setting is not built into this core");
    }
    read_reference(&m.a, options.a, &render.settings);
    read_reference(&m.b, options.b, &render.settings);
    m.pixels = (size_t)render.settings.width * render.settings.height;
    m.sums = cli_alloc(m.pixels, sizeof *m.sums);
    m.counts = cli_alloc(m.pixels, sizeof *m.counts);
    m.unit = ldexp(1, ql_i16(QL_LE16((uint16_t)scene.header->radiance_exp)) -
                              QL_SUM_BITS);
    measure(&m, &render, options.enough);
    image_free(&m.a);
    image_free(&m.b);
    free(m.sums);
    free(m.counts);
    free(blob);
    return CLI_DONE;
}
