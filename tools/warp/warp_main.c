/* warp_main.c - qlux-warp: list, draw and test the warps */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/image/image_file.h"
#include "warp/warps.h"

enum { SAMPLES_DEFAULT = 512, SAMPLES_MAX = 65536, POWER_MAX = 65535 };

static const char help[] =
        "qlux-warp: list, draw and test the warps of the core\n"
        "\n"
        "  qlux-warp list                       name, domain, density, source\n"
        "  qlux-warp plot WARP -o FILE [options]\n"
        "                   samples in the unit square and where they go, "
        "with\n"
        "                   the density; FILE is a .svg, .png or .ppm\n"
        "  qlux-warp test [WARP] [-m M]         samples against densities, "
        "and\n"
        "                   what tables cost; exit 2 if one does not fit.\n"
        "                   naive-hemisphere must fail as uniform\n"
        "\n"
        "  -m M             exponent of cosine-power, 0 to 65535 (plot: 8,\n"
        "                   test: several)\n"
        "  --samples N      in a plot: 1 to 65536 (512), of a Sobol set\n"
        "\n"
        "GI is Dutre's Global Illumination Compendium (2003), by equation; sr\n"
        "is the steradian, solid angle's unit.\n"
        "Exit: 0 done, 1 usage, 2 a warp does not fit its density, 3 cannot\n"
        "write\n"
        "\n"
        "Example:\n"
        "  qlux-warp plot cosine-power -m 16 -o lobe.svg\n";

typedef struct {
    const warp_t *warp;
    double power; /* below 0: not given */
    const char *output;
    uint32_t samples;
} options_t;

static double take_power(const char *text)
{
    char *end = NULL;
    double value;

    if (text == NULL) {
        cli_fail(CLI_USAGE, "'-m' needs a value");
    }
    value = strtod(text, &end);
    if (end == text || *end != '\0' || !(value >= 0 && value <= POWER_MAX)) {
        cli_fail(CLI_USAGE, "'-m %s': expected a number, 0 to %d", text,
                POWER_MAX);
    }
    return value;
}

static const warp_t *take_warp(const char *name)
{
    const warp_t *warp = warp_find(name);

    if (warp == NULL) {
        cli_fail(CLI_USAGE, "no warp '%s' (see qlux-warp list)", name);
    }
    return warp;
}

static void parse(options_t *o, int argc, char **argv)
{
    memset(o, 0, sizeof *o);
    o->power = -1;
    for (int i = 2; i < argc; i++) {
        const char *a = argv[i];

        if (strcmp(a, "-m") == 0) {
            o->power = take_power(argv[++i]);
        } else if (strcmp(a, "-o") == 0) {
            o->output = cli_text(a, argv[++i]);
        } else if (strcmp(a, "--samples") == 0) {
            o->samples = (uint32_t)cli_number(a, argv[++i], 1, SAMPLES_MAX);
        } else if (a[0] == '-') {
            cli_fail(CLI_USAGE, "unknown option '%s' (see --help)", a);
        } else if (o->warp == NULL) {
            o->warp = take_warp(a);
        } else {
            cli_fail(CLI_USAGE, "a second warp: '%s' (see --help)", a);
        }
    }
    if (o->power >= 0 && o->warp != NULL &&
            strcmp(o->warp->name, "cosine-power") != 0) {
        cli_fail(CLI_USAGE, "'-m' is for cosine-power, not %s", o->warp->name);
    }
}

static void list(const options_t *o)
{
    if (o->warp != NULL || o->power >= 0 || o->output != NULL ||
            o->samples > 0) {
        cli_fail(CLI_USAGE, "'list' takes nothing more (see --help)");
    }
    for (unsigned i = 0; warp_at(i) != NULL; i++) {
        const warp_t *w = warp_at(i);

        printf("%-19s %-23s %-40s %s\n", w->name, w->domain, w->density,
                w->source);
    }
}

static void plot(const options_t *o)
{
    const char *dot;

    if (o->warp == NULL || o->output == NULL) {
        cli_fail(CLI_USAGE, "'plot' needs %s (see --help)",
                o->warp == NULL ? "a warp" : "-o FILE");
    }
    dot = strrchr(o->output, '.');
    if ((dot == NULL || strcmp(dot, ".svg") != 0) &&
            image_kind("-o", o->output) == IMAGE_PFM) {
        cli_fail(CLI_USAGE, "'-o %s': a plot is a .svg, .png or .ppm",
                o->output);
    }
    warp_plot(o->warp,
            o->power >= 0 ? o->power
            : strcmp(o->warp->name, "cosine-power") == 0
                    ? WARP_POWER_DEFAULT
                    : o->warp->parameters[0],
            o->samples > 0 ? o->samples : SAMPLES_DEFAULT, o->output);
}

static int test(const options_t *o)
{
    if (o->output != NULL || o->samples > 0) {
        cli_fail(CLI_USAGE, "'%s' is for plot (see --help)",
                o->output != NULL ? "-o" : "--samples");
    }
    return warp_test(o->warp, o->power);
}

int main(int argc, char **argv)
{
    static const char *const commands[] = {"list", "plot", "test", NULL};
    options_t options;

    cli_begin("qlux-warp");
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0) {
            fputs(help, stdout);
            return CLI_DONE;
        }
    }
    if (argc < 2) {
        cli_fail(CLI_USAGE, "say list, plot or test (see --help)");
    }
    switch (cli_choice("qlux-warp", argv[1], commands)) {
    case 0:
        parse(&options, argc, argv);
        list(&options);
        return CLI_DONE;
    case 1:
        parse(&options, argc, argv);
        plot(&options);
        return CLI_DONE;
    default:
        parse(&options, argc, argv);
        return test(&options);
    }
}
