/* trade_main.c - qlux-trade: draw what choices cost, recommend some */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "lib/image/image_file.h"
#include "lib/program/options.h"
#include "trade/scene/trade_advice.h"
#include "trade/scene/trade_blob.h"
#include "trade/trade.h"
#include "trade/trade_points.h"

#define PIXELS 1296 /* of a picture that is measured, about */

typedef struct {
    const char *input; /* a table or a scene */
    const char *picture;
    bool best, quiet;

    /* of a scene */
    unsigned board; /* which of trade_boards; trade_board_count: all */
    option_size_t size;
    unsigned threads;
    bool quick;
} options_t;

#define AT(field) OPTION_FIELD(options_t, field)

static const char *const drawings[] = {".svg", ".png", ".ppm", NULL};

static const option_t options[] = {
        {"TRADE.csv|SCENE", OPTION_TEXT, AT(input), .required = true},
        {"-o FILE", OPTION_FILE, AT(picture), .words = drawings,
                .help = "the drawing, .svg, .png or .ppm"},
        {"--best", OPTION_FLAG, AT(best),
                .help = "print what nothing cheaper is better than, as a "
                        "table"},
        {"--quiet", OPTION_FLAG, AT(quiet), .help = "print nothing"},
        OPTION_END};

static const option_t scene_options[] = {
        {"--board BOARD", OPTION_WORD, AT(board), .words = trade_board_names,
                .help = "the board that counts", .preset = "all of them"},
        {"--size WxH", OPTION_SIZE, AT(size), .min = 1, .max = QL_IMAGE_MAX,
                .help = "pixels of the picture", .preset = "each board's own"},
        {"--threads N", OPTION_NUMBER, AT(threads), .min = 1, .max = 64,
                .help = "on this PC", .preset = "one for each processor"},
        {"--quick", OPTION_FLAG, AT(quick),
                .help = "fewer samples of fewer pixels: seconds, less exact"},
        OPTION_END};

static const option_section_t sections[] = {
        {NULL, options}, {"For a scene", scene_options}, {NULL, NULL}};

static const program_t program = {.name = "qlux-trade",
        .about = "error against instructions, what to choose",
        .usage = "TRADE.csv [options]\nSCENE.scene|.obj|.qlb [options]",
        .sections = sections,
        .notes = "Of a scene it renders small pictures in several ways, in "
                 "about a minute, as their samples double, and prints, for an "
                 "error of 10 %, 3 % and 1 %, the way with the fewest "
                 "instructions on the board, or on a Cortex-M3, and how long "
                 "each board takes at least. The error is the root of relMSE "
                 "(see qlux-diff): noise, by two pictures of other seeds, and "
                 "what is missing after the last bounce. Instructions are "
                 "those of draft precision, by a table that was fitted to "
                 "counts in emulators; most scenes are within 10 %. Of more "
                 "samples than it renders the error is extrapolated, which it "
                 "says.\n"
                 "TRADE.csv is what make trade writes. Draws every choice, a "
                 "line a choice, as its samples double, and what is best on "
                 "each core; prints, for each scene and core, the cheapest "
                 "choice that reaches an error of 10 %, 3 % and 1 %, its "
                 "instructions a pixel, and what to ask for.",
        .example = "qlux-trade room.scene --board microbit\n"
                   "qlux-trade build/trade.csv -o build/trade.svg"};

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

/* What is neither a table nor a scene, or an option that a table has no use
 * for. */
static void refuse_options_of_scenes(const char *input)
{
    static const char *const given[] = {
            "--board", "--size", "--threads", "--quick"};
    const size_t length = strlen(input);

    for (unsigned i = 0; i < sizeof given / sizeof given[0]; i++) {
        if (options_given(given[i])) {
            options_fail("'%s' is of a scene, not of a table", given[i]);
        }
    }
    if (strcmp(input, "-") != 0 &&
            (length < 4 || strcmp(input + length - 4, ".csv") != 0)) {
        options_fail("'%s': expected .csv, .scene, .obj or .qlb", input);
    }
}

/* Pixels of about as many, as wide and high as the picture will be. */
static void choose_size(trade_measure_t *m, const ql_scene_t *scene,
        option_size_t size, bool quick)
{
    const double width =
            size.width != 0 ? size.width : QL_LE16(scene->header->image_width);
    const double height = size.width != 0
                                  ? size.height
                                  : QL_LE16(scene->header->image_height);
    const double pixels = quick ? PIXELS / 4 : PIXELS;
    const double high = fmin(fmax(sqrt(pixels * height / width), 1), pixels);

    m->height = (uint16_t)(high + 0.5);
    m->width = (uint16_t)(pixels / m->height + 0.5);
}

static void measure_scene(
        trade_measure_t *m, const options_t *o, const char *program_name)
{
    ql_scene_t scene;
    void *blob = trade_blob_open(&scene, o->input, program_name);

    m->scene = &scene;
    m->threads = o->threads;
    m->quick = o->quick;
    m->quiet = o->quiet;
    choose_size(m, &scene, o->size, o->quick);
    trade_measure(m, o->input);
    free(blob);
}

int main(int argc, char **argv)
{
    static trade_measure_t measure;
    options_t o = {.board = trade_board_count};
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    trade_t trade;
    bool is_scene;

    o.threads = processors < 1    ? 1
                : processors > 64 ? 64
                                  : (unsigned)processors;
    options_parse(&program, argc, argv, &o);
    is_scene = trade_blob_is_source(o.input) || trade_blob_is_one(o.input);
    if (is_scene) {
        measure_scene(&measure, &o, argv[0]);
        trade_points(&trade, &measure, o.input);
    } else {
        refuse_options_of_scenes(o.input);
        trade_read(&trade, o.input);
    }
    if (o.picture != NULL) {
        write_figure(&trade, o.picture);
    }
    if (o.best) {
        print_best(&trade);
    } else if (is_scene && !o.quiet) {
        trade_advise(&measure, o.input,
                o.board < trade_board_count ? trade_boards + o.board : NULL,
                o.size.width, o.size.height);
    } else if (!o.quiet) {
        recommend(&trade);
    }
    trade_free(&trade);
    return CLI_DONE;
}
