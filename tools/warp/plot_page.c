/* plot_page.c - the page of a picture: ink, dots, grid, histogram */
/* SPDX-License-Identifier: MIT */

#include "warp/plot_page.h"

#include <math.h>
#include <string.h>

#define TWO_32 4294967296.0

const figure_style_t style_note = {
        .colour = 0x5b6472, .opacity = 1, .size = 12};
const figure_style_t style_tick = {
        .colour = 0x5b6472, .opacity = 1, .size = 11};
const figure_style_t style_frame = {
        .colour = 0x8b94a3, .opacity = 1, .size = 1};
const figure_style_t style_hidden = {
        .colour = 0x8b94a3, .opacity = 0.6, .size = 1, .dashed = true};
const figure_style_t style_body = {.colour = 0xeef1f6, .opacity = 1};
const figure_style_t style_lobe = {.colour = 0xc2410c, .opacity = 1, .size = 2};
const figure_style_t style_lobe_fill = {.colour = 0xc2410c, .opacity = 0.1};
const figure_style_t style_lobe_text = {
        .colour = 0xc2410c, .opacity = 1, .size = 12, .bold = true};
const figure_style_t style_even = {
        .colour = 0x1d4ed8, .opacity = 1, .size = 1.4, .dashed = true};
const figure_style_t style_even_text = {
        .colour = 0x1d4ed8, .opacity = 1, .size = 11};
const figure_style_t style_bar = {.colour = 0x9fb3d1, .opacity = 1};

double plot_unit(uint32_t u)
{
    return (u + 0.5) / TWO_32;
}

/* A colour of even lightness: Ottosson's Oklab (2020) to sRGB. */
static uint32_t oklch(double light, double chroma, double hue)
{
    const double a = chroma * cos(2 * PI * hue), b = chroma * sin(2 * PI * hue);
    const double l = pow(light + 0.3963377774 * a + 0.2158037573 * b, 3);
    const double m = pow(light - 0.1055613458 * a - 0.0638541728 * b, 3);
    const double s = pow(light - 0.0894841775 * a - 1.2914855480 * b, 3);
    const double rgb[3] = {
            4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
            -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
            -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
    uint32_t colour = 0;

    for (int k = 0; k < 3; k++) {
        const double v = rgb[k] < 0 ? 0 : rgb[k] > 1 ? 1 : rgb[k];
        const double c =
                v <= 0.0031308 ? 12.92 * v : 1.055 * pow(v, 1 / 2.4) - 0.055;

        colour = colour << 8 | (uint32_t)lround(255 * c);
    }
    return colour;
}

/* Entries have a hue each; other samples that of their part of the square. */
uint32_t plot_colour(const plot_t *p, unsigned group)
{
    if (p->warp->kind == WARP_ENTRY) {
        return oklch(group % 2 ? 0.5 : 0.66, 0.15,
                (double)group / p->n_groups + 0.05);
    }
    if (p->warp->numbers == 1) {
        return oklch(0.6, 0.15, 0.08 + 0.8 * group / CLASSES);
    }
    return oklch(0.78 - 0.36 * (group / CLASSES_2) / (CLASSES_1 - 1), 0.15,
            (group % CLASSES_2) / (double)CLASSES_2 + 0.06);
}

double plot_dot_size(const plot_t *p)
{
    /* a triangle of the sphere is small on the page */
    const double usual = p->warp->kind == WARP_DIRECTION ? 2.6 : 3.6;
    const double size = usual * sqrt(512.0 / p->n);

    return size < 1 ? 1 : size > 5 ? 5 : size;
}

void plot_dots(plot_t *p, plot_place_t *place, int pass, double opacity)
{
    for (unsigned group = 0; group < p->n_groups; group++) {
        const figure_style_t style = {.colour = plot_colour(p, group),
                .opacity = opacity,
                .size = plot_dot_size(p)};
        bool begun = false;

        for (uint32_t i = 0; i < p->n; i++) {
            double x, y;

            if (p->samples[i].group != group ||
                    !place(p, &p->samples[i].point, pass, &x, &y)) {
                continue;
            }
            if (!begun) {
                figure_add(&p->figure, FIGURE_DOTS, style);
                begun = true;
            }
            figure_point(&p->figure, x, y);
        }
    }
}

static uint32_t number(double u)
{
    return u >= 1 ? UINT32_MAX : (uint32_t)(u * TWO_32);
}

/* Numbers from 0 to the largest that crowd at the ends, where some warps bend
 * most. */
static uint32_t crowded(double t)
{
    const double end = pow(2 * (t < 0.5 ? t : 1 - t), 3) / 2;

    return number(t < 0.5 ? end : 1 - end);
}

/* A line of the square's grid as the warp bends it: u1 or u2 stays at a part
 * of 1, the other runs. Pieces that are not shown interrupt it. */
static void put_grid_line(plot_t *p, plot_place_t *place, int pass,
        figure_style_t style, int fixed, double at)
{
    bool on = false;

    for (int k = 0; k <= 2 * CURVE; k++) {
        const double part = k / (2.0 * CURVE);
        const uint32_t run = fixed == 1 ? crowded(part) : number(part);
        uint32_t u[WARP_NUMBERS] = {0};
        warp_point_t point;
        double x, y;

        u[fixed] = number(at);
        u[1 - fixed] = run;
        warp_draw(p->warp, p->setup, u, &point);
        if (!place(p, &point, pass, &x, &y)) {
            on = false;
            continue;
        }
        if (!on) {
            figure_add(&p->figure, FIGURE_PATH, style);
        }
        figure_point(&p->figure, x, y);
        on = true;
    }
}

void plot_grid(plot_t *p, plot_place_t *place, int pass, double opacity)
{
    const figure_style_t style = {
            .colour = 0x4b5563, .opacity = opacity, .size = 0.6};

    for (int k = 1; k < CLASSES_1; k++) {
        put_grid_line(p, place, pass, style, 0, (double)k / CLASSES_1);
    }
    for (int k = 0; k < CLASSES_2; k++) {
        put_grid_line(p, place, pass, style, 1, (double)k / CLASSES_2);
    }
}

double plot_square_x(double u)
{
    return SQUARE_X + SQUARE * u;
}

double plot_square_y(double u)
{
    return SQUARE_Y + SQUARE * (1 - u);
}

double plot_chart_y(const plot_chart_t *c, double density)
{
    const double part = density / c->top;

    return CHART_Y + CHART_H * (1 - (part > 1 ? 1 : part));
}

static void put_bars(plot_t *p, const plot_chart_t *c)
{
    const double width = (c->high - c->low) / c->bars;

    for (unsigned k = 0; k < c->bars; k++) {
        const double a = c->low + k * width;
        const double x = CHART_X + CHART_W * k / c->bars;
        uint32_t count = 0;

        for (uint32_t i = 0; i < p->n; i++) {
            const double at = c->where(p, p->samples[i].point.x);

            count += at >= a && at < a + width;
        }
        if (count > 0) {
            figure_box(&p->figure, FIGURE_AREA, style_bar, x + 0.5,
                    plot_chart_y(
                            c, count / (p->n * c->measure(p, a, a + width))),
                    x + CHART_W / c->bars - 0.5, CHART_Y + CHART_H);
        }
    }
}

void plot_curve(plot_t *p, const plot_chart_t *c, figure_style_t style,
        double (*density)(const plot_t *p, double at))
{
    bool on = false;

    for (int k = 0; k <= 4 * CURVE; k++) {
        const double part = (k + 1e-3) / (4 * CURVE + 2e-3);
        const double d = density(p, c->low + part * (c->high - c->low));

        if (d > c->top) {
            on = false;
            continue;
        }
        if (!on) {
            figure_add(&p->figure, FIGURE_PATH, style);
            on = true;
        }
        figure_point(&p->figure, CHART_X + part * CHART_W, plot_chart_y(c, d));
    }
}

void plot_chart(plot_t *p, const plot_chart_t *c)
{
    figure_t *f = &p->figure;
    const double bottom = CHART_Y + CHART_H, right = CHART_X + CHART_W;

    figure_text(f, style_note, FIGURE_MIDDLE, CHART_X + CHART_W / 2,
            CHART_Y - 14, "%s", c->title);
    put_bars(p, c);
    plot_curve(p, c, style_lobe, c->density);
    figure_line(f, style_frame, CHART_X, CHART_Y, CHART_X, bottom);
    figure_line(f, style_frame, CHART_X, bottom, right, bottom);
    figure_line(f, style_frame, CHART_X - 4, plot_chart_y(c, c->peak), CHART_X,
            plot_chart_y(c, c->peak));
    figure_text(f, style_tick, FIGURE_RIGHT, CHART_X - 7,
            plot_chart_y(c, c->peak) + 4, "%.3g", c->peak);
    figure_text(f, style_tick, FIGURE_RIGHT, CHART_X - 7, bottom + 4, "0");
    figure_text(f, style_tick, FIGURE_MIDDLE, CHART_X, bottom + 16, "%s",
            c->low_text);
    figure_text(f, style_tick, FIGURE_MIDDLE, right, bottom + 16, "%s",
            c->high_text);
    figure_text(f, style_note, FIGURE_MIDDLE, (CHART_X + right) / 2,
            bottom + 17, "%s", c->name);
}

double plot_even_density(const plot_t *p, double at)
{
    const double any[3] = {0.2, 0.2, 1};

    (void)at;
    return warp_density(p->warp, p->setup, any);
}

bool plot_is_naive(const plot_t *p)
{
    return strcmp(p->warp->name, "naive-hemisphere") == 0;
}
