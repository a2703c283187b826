/* trade_plot.c - error against instructions, log-log, and what is best */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <string.h>

#include "trade/trade.h"

#define PANEL_WIDTH  560.0
#define PANEL_HEIGHT 330.0
#define LEFT         64.0
#define TOP          46.0
#define GAP          84.0
#define LEGEND       150.0

#define CORES_MAX 8u

/* Decades that are shown. */
#define COST_LOW  3.5
#define COST_HIGH 8.5
#define ERROR_LOW 0.004
#define ERROR_TOP 2.5

static const struct {
    const char *knob;
    const char *label;
    uint32_t colour;
} knobs[] = {
        {"base", "base: draft, area", 0x000000},
        {"precision", "precision", 0x7f7f7f},
        {"tables", "tables", 0xc49c94},
        {"bvh", "node bits, leaf", 0xc7c7c7},
        {"sampler", "sampler", 0x17becf},
        {"direct", "direct strategy", 0xd62728},
        {"lights", "choice of lights", 0xff7f0e},
        {"light-samples", "samples a light", 0xe0b000},
        {"indirect", "indirect density", 0x8c564b},
        {"bounces", "bounces", 0x2ca02c},
        {"roulette", "roulette", 0x9467bd},
        {"adaptive", "adaptive", 0xe377c2},
        {"combined", "combined", 0x1f77b4},
};
#define KNOBS (sizeof knobs / sizeof knobs[0])

typedef struct {
    double x0, y0; /* of the panel, top left */
} panel_t;

static figure_style_t style(uint32_t colour, double size)
{
    const figure_style_t s = {.colour = colour, .opacity = 1, .size = size};

    return s;
}

static double x_of(const panel_t *panel, double cost)
{
    return panel->x0 +
           PANEL_WIDTH * (log10(cost) - COST_LOW) / (COST_HIGH - COST_LOW);
}

static double y_of(const panel_t *panel, double error)
{
    return panel->y0 +
           PANEL_HEIGHT * log(ERROR_TOP / error) / log(ERROR_TOP / ERROR_LOW);
}

static bool shown(const trade_point_t *p)
{
    return p->error >= ERROR_LOW && p->error <= ERROR_TOP &&
           log10(p->cost) >= COST_LOW && log10(p->cost) <= COST_HIGH;
}

static void draw_axes(figure_t *figure, const panel_t *panel, const char *title)
{
    static const double errors[] = {2, 1, 0.3, 0.1, 0.03, 0.01, 0.005};
    static const char *const costs[] = {
            "10 k", "100 k", "1 M", "10 M", "100 M"};
    const double bottom = panel->y0 + PANEL_HEIGHT;
    figure_style_t heading = style(0x000000, 15);

    heading.bold = true;
    figure_text(figure, heading, FIGURE_LEFT, panel->x0, panel->y0 - 10, "%s",
            title);
    for (unsigned i = 0; i < sizeof errors / sizeof errors[0]; i++) {
        const double y = y_of(panel, errors[i]);

        figure_line(figure, style(0xe4e4e4, 1), panel->x0, y,
                panel->x0 + PANEL_WIDTH, y);
        figure_text(figure, style(0x333333, 12), FIGURE_RIGHT, panel->x0 - 6,
                y + 4, "%g %%", 100 * errors[i]);
    }
    for (unsigned i = 0; i < sizeof costs / sizeof costs[0]; i++) {
        const double x = x_of(panel, pow(10, 4 + (double)i));

        figure_line(figure, style(0xe4e4e4, 1), x, panel->y0, x, bottom);
        figure_text(figure, style(0x333333, 12), FIGURE_MIDDLE, x, bottom + 16,
                "%s", costs[i]);
    }
    figure_box(figure, FIGURE_PATH, style(0x888888, 1), panel->x0, panel->y0,
            panel->x0 + PANEL_WIDTH, bottom);
    figure_text(figure, style(0x333333, 12), FIGURE_MIDDLE,
            panel->x0 + PANEL_WIDTH / 2, bottom + 34, "instructions a pixel");
}

static unsigned knob_of(const trade_point_t *p)
{
    for (unsigned i = 0; i < KNOBS; i++) {
        if (strcmp(knobs[i].knob, p->knob) == 0) {
            return i;
        }
    }
    return KNOBS - 1;
}

/* A choice as its samples double; alone, a dot. */
static void draw_choice(figure_t *figure, const panel_t *panel,
        const trade_t *trade, size_t first)
{
    const trade_point_t *p = trade->points + first;
    const unsigned knob = knob_of(p);
    figure_style_t line = style(knobs[knob].colour, knob == 0 ? 2.2 : 1.2);
    figure_style_t dot = style(knobs[knob].colour, 5);
    unsigned count = 0;

    line.opacity = 0.75;
    for (size_t i = first; i < trade->count; i++) {
        const trade_point_t *q = trade->points + i;

        if (strcmp(p->scene, q->scene) == 0 && strcmp(p->core, q->core) == 0 &&
                strcmp(p->name, q->name) == 0 && shown(q)) {
            if (count++ == 0) {
                figure_add(figure, FIGURE_PATH, line);
            }
            figure_point(figure, x_of(panel, q->cost), y_of(panel, q->error));
            p = q;
        }
    }
    if (count == 1) {
        figure_add(figure, FIGURE_DOTS, dot);
        figure_point(figure, x_of(panel, p->cost), y_of(panel, p->error));
    }
}

/* What is best on a core; of the first one by name. */
static void draw_best(figure_t *figure, const panel_t *panel,
        const trade_t *trade, const trade_point_t *like, unsigned core)
{
    static const uint32_t colours[] = {0x000000, 0x555555, 0x999999};
    figure_style_t line = style(colours[core % 3], core == 0 ? 3 : 1.6);
    const trade_point_t *p, *labelled = NULL;

    line.dashed = core != 0;
    figure_add(figure, FIGURE_PATH, line);
    for (p = trade_next_best(trade, like, 0); p != NULL;
            p = trade_next_best(trade, like, p->cost)) {
        if (shown(p)) {
            figure_point(figure, x_of(panel, p->cost), y_of(panel, p->error));
        }
    }
    for (p = trade_next_best(trade, like, 0); p != NULL && core == 0;
            p = trade_next_best(trade, like, p->cost)) {
        const double x = x_of(panel, p->cost), y = y_of(panel, p->error);

        if (!shown(p)) {
            continue;
        }
        figure_add(figure, FIGURE_DOTS, style(0x000000, 6));
        figure_point(figure, x, y);
        if (labelled == NULL ||
                (strcmp(p->name, labelled->name) != 0 &&
                        y - y_of(panel, labelled->error) > 13)) {
            const bool crowded = x < panel->x0 + 70; /* the axis is there */

            figure_text(figure, style(0x000000, 11),
                    crowded ? FIGURE_LEFT : FIGURE_RIGHT,
                    crowded ? x + 8 : x - 7, crowded ? y - 5 : y + 9, "%s",
                    p->name);
            labelled = p;
        }
    }
}

static void draw_panel(figure_t *figure, const panel_t *panel,
        const trade_t *trade, size_t first)
{
    const trade_point_t *at = trade->points + first;
    const trade_point_t *cores[CORES_MAX];
    char title[TRADE_TEXT + 64];
    unsigned core = 0;

    snprintf(title, sizeof title, "%.40s: error of a picture on a %.40s",
            at->scene, at->core);
    draw_axes(figure, panel, title);
    for (size_t i = first; i < trade->count; i++) {
        const trade_point_t *p = trade->points + i;
        bool fresh = strcmp(p->scene, at->scene) == 0 &&
                     strcmp(p->core, at->core) == 0;

        for (size_t k = first; k < i && fresh; k++) {
            fresh = strcmp(trade->points[k].name, p->name) != 0 ||
                    strcmp(trade->points[k].core, p->core) != 0 ||
                    strcmp(trade->points[k].scene, p->scene) != 0;
        }
        if (fresh) {
            draw_choice(figure, panel, trade, i);
        }
    }
    /* the first core comes last, on top */
    for (size_t i = first; i < trade->count; i++) {
        if (strcmp(trade->points[i].scene, at->scene) == 0 &&
                trade_new_core(trade, i)) {
            cores[core++ % CORES_MAX] = trade->points + i;
        }
    }
    for (core = core < CORES_MAX ? core : CORES_MAX; core > 0; core--) {
        draw_best(figure, panel, trade, cores[core - 1], core - 1);
    }
}

static void draw_legend(figure_t *figure, const trade_t *trade, double x)
{
    const trade_point_t *first = trade->points;
    double y = TOP + 8;
    unsigned core = 0;

    for (unsigned i = 0; i < KNOBS; i++, y += 19) {
        figure_line(figure, style(knobs[i].colour, i == 0 ? 2.2 : 1.6), x, y,
                x + 22, y);
        figure_text(figure, style(0x333333, 12), FIGURE_LEFT, x + 28, y + 4,
                "%s", knobs[i].label);
    }
    y += 12;
    for (size_t i = 0; i < trade->count; i++) {
        const trade_point_t *p = trade->points + i;

        if (strcmp(p->scene, first->scene) == 0 && trade_new_core(trade, i)) {
            static const uint32_t colours[] = {0x000000, 0x555555, 0x999999};
            figure_style_t line = style(colours[core % 3], core ? 1.6 : 3);

            line.dashed = core++ != 0;
            figure_line(figure, line, x, y, x + 22, y);
            figure_text(figure, style(0x333333, 12), FIGURE_LEFT, x + 28, y + 4,
                    "best on %s", p->core);
            y += 19;
        }
    }
}

void trade_plot(figure_t *figure, const trade_t *trade)
{
    unsigned scenes = 0;

    for (size_t i = 0; i < trade->count; i++) {
        scenes += trade_new_scene(trade, i);
    }
    figure_begin(figure, LEFT + PANEL_WIDTH + 24 + LEGEND + 20,
            TOP + scenes * (PANEL_HEIGHT + GAP));
    scenes = 0;
    for (size_t i = 0; i < trade->count; i++) {
        if (trade_new_scene(trade, i)) {
            const panel_t panel = {LEFT, TOP + scenes++ * (PANEL_HEIGHT + GAP)};

            draw_panel(figure, &panel, trade, i);
        }
    }
    draw_legend(figure, trade, LEFT + PANEL_WIDTH + 24);
}
