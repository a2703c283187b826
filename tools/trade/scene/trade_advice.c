/* trade_advice.c - what to ask for, its cost, and how long on each board */
/* SPDX-License-Identifier: MIT */

#include "trade/scene/trade_advice.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "lib/program/cli.h"
#include "lib/render/render_options.h"
#include "trade/scene/trade_blob.h"

/* Call say() with each setting that is not the default: "--direct", "mis". */
static void list_settings(const ql_settings_t *s, void *to,
        void say(void *to, const char *option, const char *value))
{
    static const ql_settings_t preset = QL_SETTINGS_DEFAULT;
    char number[24];

    say(to, "direct", render_words_direct[s->direct]);
    if (s->bounces != preset.bounces) {
        snprintf(number, sizeof number, "%u", s->bounces);
        say(to, "bounces", number);
    }
    if (s->light_samples != preset.light_samples) {
        snprintf(number, sizeof number, "%u", s->light_samples);
        say(to, "light-samples", number);
    }
    if (s->lights != preset.lights) {
        say(to, "lights", render_words_lights[s->lights]);
    }
}

/* A line being put together. */
typedef struct {
    char *text;
    size_t room;
} line_t;

static void append(line_t *line, const char *text)
{
    snprintf(line->text + strlen(line->text), line->room - strlen(line->text),
            "%s", text);
}

/* " --light-samples 2" */
static void say_option(void *to, const char *option, const char *value)
{
    append(to, " --");
    append(to, option);
    append(to, " ");
    append(to, value);
}

void trade_options(char *text, size_t room, const ql_settings_t *settings)
{
    line_t line = {text, room};

    text[0] = '\0';
    list_settings(settings, &line, say_option);
}

/* " LIGHT_SAMPLES=2" */
static void say_variable(void *to, const char *option, const char *value)
{
    char name[40] = " ";

    for (size_t i = 0; option[i] != '\0' && i + 3 < sizeof name; i++) {
        name[i + 1] = option[i] == '-' ? '_' : (char)toupper(option[i]);
    }
    append(to, name);
    append(to, "=");
    append(to, value);
}

/* 12,345 of a whole number of digits */
static const char *grouped(double number)
{
    static char text[8][40];
    static unsigned turn;
    char digits[32], *to = text[turn++ % 8];
    const int length = snprintf(digits, sizeof digits, "%.0f", number);
    char *at = to;

    for (int i = 0; i < length; i++) {
        if (i > 0 && (length - i) % 3 == 0) {
            *at++ = ',';
        }
        *at++ = digits[i];
    }
    *at = '\0';
    return to;
}

/* The cheapest on a core that gets to an error; NULL if none does. */
static const trade_way_t *cheapest(const trade_measure_t *m, cost_core_t core,
        double error, unsigned *doublings)
{
    const trade_way_t *best = NULL;
    double least = 0;

    for (unsigned i = 0; i < m->count; i++) {
        const trade_way_t *way = m->ways + i;
        unsigned at;

        if (trade_curve_find(&way->curve, error, &at)) {
            const double cost = way->cost[core] * (double)((uint32_t)1 << at);

            if (best == NULL || cost < least) {
                best = way;
                least = cost;
                *doublings = at;
            }
        }
    }
    return best;
}

/* my.qlb of a/my.scene */
static void blob_name(char name[256], const char *path)
{
    const char *slash = strrchr(path, '/');
    const char *dot = strrchr(path, '.');

    snprintf(name, 256, "%.*s.qlb", (int)(dot - path), path);
    if (trade_blob_is_source(path) && slash != NULL) {
        snprintf(name, 256, "%.*s.qlb", (int)(dot - slash - 1), slash + 1);
    }
}

static void print_board(const trade_board_t *board, double instructions,
        uint32_t width, uint32_t height)
{
    const unsigned w = width != 0 ? width : board->width;
    const unsigned h = width != 0 ? height : board->height;
    const double seconds = instructions * w * h / board->hz;
    char size[24], brief[16];

    snprintf(size, sizeof size, "%ux%u", w, h);
    snprintf(brief, sizeof brief, "%.1f", seconds);
    printf("        %-12s %-10s %15s %10s %12s s at %g MHz\n", board->name,
            board->core, grouped(instructions), size,
            seconds < 9.95 ? brief : grouped(seconds), board->hz / 1e6);
}

static void print_way(const trade_way_t *way, unsigned doublings,
        const char *path, const trade_board_t *board, uint32_t width,
        uint32_t height)
{
    const double samples = (double)((uint32_t)1 << doublings);
    char text[512], name[256];
    line_t line = {text, sizeof text};
    char size[24];

    snprintf(size, sizeof size, "%ux%u", (unsigned)width, (unsigned)height);
    blob_name(name, path);
    trade_options(text, sizeof text, &way->settings);
    if (width != 0) {
        say_option(&line, "size", size);
    }
    printf("qlux-sim %s --spp %.0f%s\n", name, samples, text);
    if (trade_blob_is_source(path)) {
        text[0] = '\0';
        list_settings(&way->settings, &line, say_variable);
        if (width != 0) {
            say_variable(&line, "size", size);
        }
        printf("        make %s%s SCENE=%s SPP=%.0f%s\n",
                board != NULL ? "firmware BOARD=" : "run",
                board != NULL ? board->name : "", path, samples, text);
    }
    printf("        error %.2g %%%s\n",
            100 * trade_curve_error(&way->curve, doublings),
            doublings < way->curve.count ? "" : ", extrapolated");
    printf("        %-12s %-10s %15s %10s %12s\n", "board", "core",
            "instr. a pixel", "size", "at least");
    for (unsigned i = 0; i < trade_board_count; i++) {
        const trade_board_t *b = trade_boards + i;
        cost_core_t core;

        if (board != NULL && board != b) {
            continue;
        }
        if (cost_core_find(&core, b->core)) {
            print_board(b, way->cost[core] * samples, width, height);
        } else {
            printf("        %-12s %-10s %15s\n", b->name, b->core,
                    "not counted");
        }
    }
}

void trade_advise(const trade_measure_t *measure, const char *path,
        const trade_board_t *board, uint32_t width, uint32_t height)
{
    static const double targets[] = {0.10, 0.03, 0.01};
    cost_core_t core = COST_M3;

    if (board != NULL) {
        (void)cost_core_find(&core, board->core);
    }
    for (unsigned k = 0; k < sizeof targets / sizeof targets[0]; k++) {
        unsigned doublings;
        const trade_way_t *way =
                cheapest(measure, core, targets[k], &doublings);

        printf("%3.0f %%   ", 100 * targets[k]);
        if (way == NULL) {
            printf("by no way that was measured\n");
        } else {
            print_way(way, doublings, path, board, width, height);
        }
    }
    printf("\nMeasured at %ux%u in fine, counted in draft; errors are relative "
           "to a picture of\n%s samples. Seconds are of one instruction a "
           "cycle; a chip waits for its flash too.\n",
            measure->width, measure->height,
            grouped(measure->reference_samples));
}
