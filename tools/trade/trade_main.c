/* trade_main.c - qlux-trade: draw what choices cost, recommend some */
/* SPDX-License-Identifier: MIT */

#include <stdlib.h>
#include <string.h>

#include "lib/image/image_file.h"
#include "trade/trade.h"

static const char help[] =
        "qlux-trade: error against instructions of measured choices\n"
        "\n"
        "  qlux-trade TRADE.csv [-o FILE.{svg,png,ppm}] [--best] [--quiet]\n"
        "\n"
        "TRADE.csv is what make trade writes. Draws every choice, a line a\n"
        "choice, as its samples double, and what is best on each core; "
        "prints,\n"
        "for each scene and core, the cheapest choice that reaches an error "
        "of\n"
        "10 %, 3 % and 1 %, its instructions a pixel, and what to ask for.\n"
        "\n"
        "  -o FILE   the drawing\n"
        "  --best    print what nothing cheaper is better than, as a table\n"
        "  --quiet   print nothing\n"
        "\n"
        "Exit: 0 done, 1 usage, 2 bad table, 3 cannot read or write\n"
        "\n"
        "Example: qlux-trade build/trade.csv -o build/trade.svg\n";

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
    const image_kind_t kind = svg ? IMAGE_PNG : image_kind("-o", path);
    figure_t figure;
    image_t image;
    cli_out_t out;

    if (!svg && kind == IMAGE_PFM) {
        cli_fail(CLI_USAGE, "'-o %s': expected .svg, .png or .ppm", path);
    }
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
    const char *table = NULL, *picture = NULL;
    bool quiet = false, best = false;
    trade_t trade;

    cli_begin("qlux-trade");
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0) {
            fputs(help, stdout);
            return CLI_DONE;
        }
        if (strcmp(argv[i], "-o") == 0) {
            picture = cli_text("-o", argv[++i]);
        } else if (strcmp(argv[i], "--quiet") == 0) {
            quiet = true;
        } else if (strcmp(argv[i], "--best") == 0) {
            best = true;
        } else if (argv[i][0] == '-' || table != NULL) {
            cli_fail(CLI_USAGE, "'%s': expected one table (see --help)",
                    argv[i]);
        } else {
            table = argv[i];
        }
    }
    if (table == NULL) {
        cli_fail(CLI_USAGE, "name a table (see --help)");
    }
    trade_read(&trade, table);
    if (picture != NULL) {
        write_figure(&trade, picture);
    }
    if (best) {
        print_best(&trade);
    } else if (!quiet) {
        recommend(&trade);
    }
    trade_free(&trade);
    return CLI_DONE;
}
