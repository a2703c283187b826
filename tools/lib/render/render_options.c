/* render_options.c - the command line of qlux-sim */
/* SPDX-License-Identifier: MIT */

#include "lib/render/render_options.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "qlux.h"

#define THREADS_MAX 1024

static const char help[] =
        "qlux-sim: render a scene on this PC, the bits that a board renders\n"
        "\n"
        "  qlux-sim SCENE.qlb -o OUT.{ppm,pfm,png} [options]\n"
        "\n"
        "  -o FILE            .ppm and .png as a display shows it, .pfm "
        "linear\n"
        "                     radiance in the units of Ke\n"
        "  --size WxH         pixels, 1 to 16384 a side    the scene's own\n"
        "  --spp N            samples a pixel, 1 to 2^24                16\n"
        "  --seed N           of the random numbers, 0 to 2^32-1         0\n"
        "  --sampler S        random or sobol                        sobol\n"
        "  --direct D         light from emitters: hemisphere, cosine, area,\n"
        "                     solid-angle, mis or none                area\n"
        "  --indirect I       light from surfaces, by directions: uniform,\n"
        "                     cosine, brdf or none                    brdf\n"
        "  --bounces N        indirect reflections, 0 to 64              4\n"
        "  --lights L         emitters asked: all, or one, uniform or by\n"
        "                     power                                  power\n"
        "  --light-samples N  of each emitter asked, 1 to 255            1\n"
        "  --roulette         end paths at random, by their throughput\n"
        "  --error E          end a pixel at this standard error, a part of\n"
        "                     its mean below 1, after 32 to --spp samples; of\n"
        "                     independent samples: sobol errs less    0 (off)\n"
        "  --format F         display: rgb888, rgb565le, rgb565be, gray8 or\n"
        "                     gray4, widened to 8-bit RGB           rgb888\n"
        "  --rows A:B         only rows A to B-1, the rest black\n"
        "  --samples A:B      only samples A to B-1 of each pixel\n"
        "  --save-sums FILE   exact sums, for qlux-merge (.qls)\n"
        "  --samples-map FILE how many samples each pixel took (.pfm)\n"
        "  --threads N        1 to 1024                    one a processor\n"
        "  --stats            print counts of paths, rays and what lost "
        "precision\n"
        "  --quiet            no progress bar\n"
        "  --version          print the version\n"
        "\n"
        "Neither threads nor rows nor samples change a bit of what is summed.\n"
        "Exit: 0 done, 1 usage, 2 bad scene, 3 cannot read or write, stopped\n"
        "\n"
        "Example:\n"
        "  qlux-sim cornell.qlb -o cornell.png --size 256x256 --spp 64\n";

/* The words of the language, in the order of the core's enums. */
static const char *const samplers[] = {"random", "sobol", NULL};
static const char *const directs[] = {
        "none", "area", "hemisphere", "cosine", "solid-angle", "mis", NULL};
static const char *const indirects[] = {
        "none", "cosine", "uniform", "brdf", NULL};
static const char *const lights[] = {"power", "all", "uniform", NULL};

/* A part of 1, to the nearest 2^-16. */
static uint16_t take_part(const char *option, const char *text)
{
    const char *value = cli_text(option, text);
    char *end;
    const double part = strtod(value, &end);

    if (end == value || *end != '\0' || !(part >= 0 && part < 1) ||
            (part > 0 && part * 65536 < 0.5) || part * 65536 >= 65535.5) {
        cli_fail(CLI_USAGE,
                "'%s %s': expected 0, or a part from 0.00001 to 0.9999", option,
                value);
    }
    return QL_ERROR_Q16(part); /* at most 65535 */
}

static void take_size(ql_settings_t *s, const char *option, const char *text)
{
    int64_t width, height;

    cli_pair(option, text, 'x', 1, QL_IMAGE_MAX, &width, &height);
    s->width = (uint16_t)width;
    s->height = (uint16_t)height;
}

static sim_range_t take_range(
        const char *option, const char *text, int64_t end_max)
{
    sim_range_t range;
    int64_t first, end;

    cli_pair(option, text, ':', 0, end_max, &first, &end);
    if (first >= end) {
        cli_fail(CLI_USAGE, "'%s %s': A:B means A to B-1, so A must be below B",
                option, text);
    }
    range.first = (uint32_t)first;
    range.end = (uint32_t)end;
    return range;
}

/* Options that choose the picture. text is what follows the option, which may
 * be NULL. False if it is none of them. */
static bool take_setting(
        render_options_t *o, const char *option, const char *text)
{
    ql_settings_t *s = &o->settings;

    if (strcmp(option, "--size") == 0) {
        take_size(s, option, text);
    } else if (strcmp(option, "--spp") == 0) {
        s->spp = (uint32_t)cli_number(option, text, 1, QL_SPP_MAX);
    } else if (strcmp(option, "--seed") == 0) {
        s->seed = (uint32_t)cli_number(option, text, 0, UINT32_MAX);
    } else if (strcmp(option, "--bounces") == 0) {
        s->bounces = (uint8_t)cli_number(option, text, 0, QL_BOUNCES_MAX);
    } else if (strcmp(option, "--sampler") == 0) {
        s->sampler = (uint8_t)cli_choice(option, text, samplers);
    } else if (strcmp(option, "--direct") == 0) {
        s->direct = (uint8_t)cli_choice(option, text, directs);
    } else if (strcmp(option, "--indirect") == 0) {
        s->indirect = (uint8_t)cli_choice(option, text, indirects);
    } else if (strcmp(option, "--lights") == 0) {
        s->lights = (uint8_t)cli_choice(option, text, lights);
    } else if (strcmp(option, "--light-samples") == 0) {
        s->light_samples = (uint8_t)cli_number(option, text, 1, 255);
#if QL_CFG_ADAPTIVE
    } else if (strcmp(option, "--error") == 0) {
        s->error_q16 = take_part(option, text);
#endif
    } else {
        return false;
    }
    return true;
}

/* Options that say what to do with it; likewise. */
static bool take_task(render_options_t *o, const char *option, const char *text)
{
    if (strcmp(option, "-o") == 0) {
        o->picture = cli_text(option, text);
        o->kind = image_kind(option, text);
    } else if (strcmp(option, "--save-sums") == 0) {
        o->save = cli_text(option, text);
    } else if (strcmp(option, "--samples-map") == 0) {
        o->map = cli_text(option, text);
        if (image_kind(option, text) != IMAGE_PFM) {
            cli_fail(CLI_USAGE, "'%s %s': expected a .pfm name", option, text);
        }
    } else if (strcmp(option, "--format") == 0) {
        o->format = (ql_format_t)cli_choice(option, text, develop_formats);
    } else if (strcmp(option, "--rows") == 0) {
        o->rows = take_range(option, text, QL_IMAGE_MAX);
    } else if (strcmp(option, "--samples") == 0) {
        o->samples = take_range(option, text, QL_SPP_MAX);
    } else if (strcmp(option, "--threads") == 0) {
        o->threads = (unsigned)cli_number(option, text, 1, THREADS_MAX);
    } else {
        return false;
    }
    return true;
}

/* Options without a value; likewise. */
static bool take_flag(render_options_t *o, const char *option)
{
    if (strcmp(option, "--roulette") == 0) {
        o->settings.roulette = 1;
    } else if (strcmp(option, "--stats") == 0) {
        o->stats = true;
    } else if (strcmp(option, "--quiet") == 0) {
        o->quiet = true;
    } else if (strcmp(option, "--help") == 0 || strcmp(option, "-h") == 0) {
        fputs(help, stdout);
        exit(CLI_DONE);
    } else if (strcmp(option, "--version") == 0) {
        puts("qlux-sim " QLUX_VERSION);
        exit(CLI_DONE);
    } else {
        return false;
    }
    return true;
}

static unsigned processors(void)
{
    long n = 1;

#ifdef _SC_NPROCESSORS_ONLN
    n = sysconf(_SC_NPROCESSORS_ONLN);
#endif
    return n < 1 ? 1 : n > THREADS_MAX ? THREADS_MAX : (unsigned)n;
}

/* A pixel that ends by itself holds no range of samples. */
static void check_error(const render_options_t *o)
{
#if QL_CFG_ADAPTIVE
    if (o->settings.error_q16 != 0 &&
            (o->save != NULL || o->samples.end != 0)) {
        cli_fail(CLI_USAGE, "'--error' goes with neither '--samples' nor "
                            "'--save-sums': pixels end at samples of their "
                            "own");
    }
#else
    (void)o;
#endif
}

/* What one option alone cannot tell. */
static void check_together(render_options_t *o, bool has_spp, bool has_format)
{
    if (o->scene == NULL) {
        cli_fail(CLI_USAGE, "name a scene, a .qlb file (see --help)");
    }
    if (o->picture == NULL && o->save == NULL) {
        cli_fail(CLI_USAGE, "give -o, --save-sums, or both (see --help)");
    }
    if (has_format && (o->picture == NULL || o->kind == IMAGE_PFM)) {
        cli_fail(CLI_USAGE, "'--format' needs '-o' with a .ppm or .png name");
    }
    check_error(o);
    if (o->samples.end == 0) {
        o->samples.end = o->settings.spp;
    } else if (!has_spp) {
        o->settings.spp = o->samples.end;
    } else if (o->samples.end > o->settings.spp) {
        cli_fail(CLI_USAGE, "'--samples %u:%u': '--spp %u' ends before that",
                (unsigned)o->samples.first, (unsigned)o->samples.end,
                (unsigned)o->settings.spp);
    }
}

void render_options_parse(render_options_t *options, int argc, char **argv)
{
    static const render_options_t start = {.settings = QL_SETTINGS_DEFAULT};
    bool has_spp = false, has_format = false;

    *options = start;
    options->threads = processors();
    for (int i = 1; i < argc; i++) {
        const char *a = argv[i];
        if (a[0] != '-' || a[1] == '\0') {
            if (options->scene != NULL) {
                cli_fail(CLI_USAGE, "a second scene: '%s' (see --help)", a);
            }
            options->scene = a;
        } else if (!take_flag(options, a)) {
            if (!take_setting(options, a, argv[i + 1]) &&
                    !take_task(options, a, argv[i + 1])) {
                cli_fail(CLI_USAGE, "unknown option '%s' (see --help)", a);
            }
            has_spp = has_spp || strcmp(a, "--spp") == 0;
            has_format = has_format || strcmp(a, "--format") == 0;
            i++;
        }
    }
    check_together(options, has_spp, has_format);
}

void render_options_rows(render_options_t *options, uint32_t height)
{
    if (options->rows.end == 0) {
        options->rows.end = height;
    }
    if (options->rows.end > height) {
        cli_fail(CLI_USAGE, "'--rows %u:%u': expected rows from 0 to %u",
                (unsigned)options->rows.first, (unsigned)options->rows.end,
                (unsigned)height);
    }
}
