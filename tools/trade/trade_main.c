/* trade_main.c - qlux-trade: draw what choices cost, recommend some */
/* SPDX-License-Identifier: MIT */

#include <stdlib.h>
#include <string.h>

#include "lib/image/image_file.h"
#include "lib/program/options.h"
#include "trade/trade.h"

typedef struct {
    const char *table;
    const char *picture;
    bool best, quiet;
} options_t;

#define AT(field) OPTION_FIELD(options_t, field)

static const char *const drawings[] = {".svg", ".png", ".ppm", NULL};

static const option_t options[] = {
        {"TRADE.csv", OPTION_TEXT, AT(table), .required = true},
        {"-o FILE", OPTION_FILE, AT(picture), .words = drawings,
                .help = "the drawing, .svg, .png or .ppm"},
        {"--best", OPTION_FLAG, AT(best),
                .help = "print what nothing cheaper is better than, as a "
                        "table"},
        {"--quiet", OPTION_FLAG, AT(quiet), .help = "print nothing"},
        OPTION_END};

static const option_section_t sections[] = {{NULL, options}, {NULL, NULL}};

static const program_t program = {.name = "qlux-trade",
        .about = "error against instructions of measured choices",
        .usage = "TRADE.csv [options]",
        .sections = sections,
        .notes = "TRADE.csv is what make trade writes. Draws every choice, a "
                 "line a choice, as its samples double, and what is best on "
                 "each core; prints, for each scene and core, the cheapest "
                 "choice that reaches an error of 10 %, 3 % and 1 %, its "
                 "instructions a pixel, and what to ask for.",
        .example = "qlux-trade build/trade.csv -o build/trade.svg"};

static void recommend(const trade_t *trade)
{
    static const double targets[] = {0.10, 0.03, 0.01};

    for (size_t i = 0; i < trade->count; i++) {
        const trade_point_t *at = trade->points + i;

        if (!trade_new_core(trade, i)) {
            continue;
        }
        printf("%s on %s\n", at->scene, at->core);
        for (unsigned k = 0; k < sizeof targets / sizeof targets[0]; k++) {
            const trade_point_t *p =
                    trade_cheapest(trade, at->scene, at->core, targets[k]);

            if (p == NULL) {
                printf("  %3.0f %%  by no choice that was measured\n",
                        100 * targets[k]);
                continue;
            }
            printf("  %3.0f %%  %-14s %5.0f samples %9.3f M instructions a "
                   "pixel, error %.2f %%, bias %+.2f %%: %s%s%s\n",
                    100 * targets[k], p->name, p->samples, p->cost / 1e6,
                    100 * p->error, 100 * p->bias, p->build,
                    p->options[0] != '\0' ? ", " : "", p->options);
        }
    }
}

static void print_best(const trade_t *trade)
{
    printf("scene,core,name,samples,error,bias,instructions_per_pixel,build,"
           "options\n");
    for (size_t i = 0; i < trade->count; i++) {
        const trade_point_t *p = trade->points + i;

        if (!trade_new_core(trade, i)) {
            continue;
        }
        for (p = trade_next_best(trade, p, 0); p != NULL;
                p = trade_next_best(trade, p, p->cost)) {
            printf("%s,%s,%s,%.6g,%.4g,%.4g,%.0f,\"%s\",%s\n", p->scene,
                    p->core, p->name, p->samples, p->error, p->bias, p->cost,
                    p->build, p->options);
        }
    }
}

static void write_figure(const trade_t *trade, const char *path)
{
    const char *dot = strrchr(path, '.');
    const bool svg = dot != NULL && strcmp(dot, ".svg") == 0;
    const image_kind_t kind = svg ? IMAGE_PNG : image_kind(path);
    figure_t figure;
    image_t image;
    cli_out_t out;

    trade_plot(&figure, trade);
    cli_out_open(&out, path);
    if (svg) {
        figure_write_svg(&figure, out.file);
    } else {
        figure_draw(&figure, &image, 2);
        image_write(&image, kind, &out);
        image_free(&image);
    }
    cli_out_commit(&out);
    figure_free(&figure);
}

int main(int argc, char **argv)
{
    options_t o = {.quiet = false};
    trade_t trade;

    options_parse(&program, argc, argv, &o);
    trade_read(&trade, o.table);
    if (o.picture != NULL) {
        write_figure(&trade, o.picture);
    }
    if (o.best) {
        print_best(&trade);
    } else if (!o.quiet) {
        recommend(&trade);
    }
    trade_free(&trade);
    return CLI_DONE;
}
