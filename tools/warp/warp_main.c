/* warp_main.c - qlux-warp: list, draw and test the warps */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/program/options.h"
#include "warp/warps.h"

enum { SAMPLES_DEFAULT = 512, SAMPLES_MAX = 65536, POWER_MAX = 65535 };

typedef enum { LIST, PLOT, TEST } command_t;

typedef struct {
    command_t command;
    const char *name;
    const warp_t *warp; /* of this name */
    double power;       /* below 0: not given */
    const char *output;
    uint32_t samples;
} options_t;

#define AT(field) OPTION_FIELD(options_t, field)

static const char *const commands[] = {"list", "plot", "test", NULL};
static const char *const drawings[] = {".svg", ".png", ".ppm", NULL};

static const option_t options[] = {{"COMMAND", OPTION_WORD, AT(command),
                                           .words = commands, .required = true},
        {"WARP", OPTION_TEXT, AT(name), .help = "a name that list prints"},
        {"-o FILE", OPTION_FILE, AT(output), .words = drawings,
                .help = "of a plot: .svg, .png or .ppm"},
        {"-m M", OPTION_REAL, AT(power), .max = POWER_MAX,
                .preset = "8 in a plot, several in a test",
                .help = "exponent of cosine-power"},
        {"--samples N", OPTION_NUMBER, AT(samples), .min = 1,
                .max = SAMPLES_MAX, .help = "in a plot, of a Sobol set"},
        OPTION_END};

static const option_section_t sections[] = {{NULL, options}, {NULL, NULL}};

static const program_t program = {.name = "qlux-warp",
        .about = "list, draw and test the warps of the core",
        .usage = "list\tname, domain, density, source\n"
                 "plot WARP -o FILE [options]\tsamples in the unit square and "
                 "where they go, with the density\n"
                 "test [WARP] [-m M]\tsamples against densities, and what "
                 "tables cost",
        .sections = sections,
        .notes =
                "naive-hemisphere must fail its test as uniform. A warp of the "
                "lecture explains, and no renderer calls it. GI is "
                "Dutre's Global Illumination Compendium (2003), by equation; "
                "sr is the steradian, solid angle's unit.",
        .exits = "2 also if a warp does not fit its density",
        .example = "qlux-warp plot cosine-power -m 16 -o lobe.svg"};

static void check_warp(options_t *o)
{
    if (o->name == NULL) {
        return;
    }
    o->warp = warp_find(o->name);
    if (o->warp == NULL) {
        options_fail("'%s': expected a warp of qlux-warp list", o->name);
    }
    if (o->power >= 0 && strcmp(o->warp->name, "cosine-power") != 0) {
        options_fail("'-m' is for cosine-power, not %s", o->warp->name);
    }
}

/* Refuse an option that a command has no use for. */
static void check_unused(const options_t *o, const char *option)
{
    if (options_given(option)) {
        options_fail("'%s' goes without '%s'", commands[o->command], option);
    }
}

static void list(const options_t *o)
{
    check_unused(o, "-o");
    check_unused(o, "-m");
    check_unused(o, "--samples");
    if (o->warp != NULL) {
        options_fail("unexpected argument '%s'", o->name);
    }
    for (unsigned i = 0; warp_at(i) != NULL; i++) {
        const warp_t *w = warp_at(i);

        printf("%-19s %-23s %-40s %s%s\n", w->name, w->domain, w->density,
                w->source, w->lecture ? " (lecture)" : "");
    }
}

static void plot(const options_t *o)
{
    if (o->warp == NULL || o->output == NULL) {
        options_fail("missing %s", o->warp == NULL ? "WARP" : "-o FILE");
    }
    warp_plot(o->warp,
            o->power >= 0 ? o->power
            : strcmp(o->warp->name, "cosine-power") == 0
                    ? WARP_POWER_DEFAULT
                    : o->warp->parameters[0],
            o->samples, o->output);
}

static int test(const options_t *o)
{
    check_unused(o, "-o");
    check_unused(o, "--samples");
    return warp_test(o->warp, o->power);
}

int main(int argc, char **argv)
{
    options_t o = {.power = -1, .samples = SAMPLES_DEFAULT};

    options_parse(&program, argc, argv, &o);
    check_warp(&o);
    switch (o.command) {
    case LIST:
        list(&o);
        return CLI_DONE;
    case PLOT:
        plot(&o);
        return CLI_DONE;
    default:
        return test(&o);
    }
}
