/* plot_plane.c - disk, triangle, tent, bars of entries, tables */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/program/cli.h"
#include "warp/plot_domain.h"

/* Disk, triangle, tent. */

static bool place_disk(const plot_t *p, const warp_point_t *point, int pass,
        double *x, double *y)
{
    (void)p;
    (void)pass;
    *x = DOMAIN_X + BALL * point->x[0];
    *y = DOMAIN_Y - BALL * point->x[1];
    return true;
}

static double distance_of(const plot_t *p, const double *x)
{
    (void)p;
    return warp_sine(x);
}

static double annulus(const plot_t *p, double a, double b)
{
    (void)p;
    return PI * (b * b - a * a);
}

static void put_circle(plot_t *p, figure_as_t as, figure_style_t style)
{
    figure_add(&p->figure, as, style);
    for (int k = 0; k <= CURVE; k++) {
        const double a = 2 * PI * k / CURVE;

        figure_point(
                &p->figure, DOMAIN_X + BALL * cos(a), DOMAIN_Y + BALL * sin(a));
    }
}

void plot_disk(plot_t *p)
{
    const double d = plot_even_density(p, 0);
    const plot_chart_t c = {"pdf per area, histogram", "r", "0", "1", 0, 1,
            1.5 * d, d, 16, distance_of, annulus, plot_even_density};

    put_circle(p, FIGURE_AREA, style_body);
    plot_grid(p, place_disk, 0, 0.4);
    plot_dots(p, place_disk, 0, 1);
    put_circle(p, FIGURE_PATH, style_frame);
    plot_chart(p, &c);
}

static bool place_triangle(const plot_t *p, const warp_point_t *point, int pass,
        double *x, double *y)
{
    const double b1 = point->x[0], b2 = point->x[1];

    (void)p;
    (void)pass;
    *x = DOMAIN_X - 112 + 224 * b1 + 112 * b2;
    *y = DOMAIN_Y + 97 - 194 * b2;
    return true;
}

static double weight_of(const plot_t *p, const double *x)
{
    (void)p;
    return x[0];
}

static double strip(const plot_t *p, double a, double b)
{
    (void)p;
    return (b - a) * (1 - (a + b) / 2);
}

void plot_triangle(plot_t *p)
{
    static const double corners[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    static const double off[3][2] = {{-14, 4}, {14, 4}, {0, -7}};
    const plot_chart_t c = {"pdf where the area is 1/2", "weight of b", "0",
            "1", 0, 1, 3, 2, 10, weight_of, strip, plot_even_density};
    double x[3], y[3];

    for (int i = 0; i < 3; i++) {
        warp_point_t point;

        memcpy(point.x, corners[i], sizeof point.x);
        (void)place_triangle(p, &point, 0, &x[i], &y[i]);
        figure_text(&p->figure, style_note, FIGURE_MIDDLE, x[i] + off[i][0],
                y[i] + off[i][1], "%c", 'a' + i);
    }
    for (int as = 0; as < 2; as++) {
        figure_add(&p->figure, as == 0 ? FIGURE_AREA : FIGURE_PATH,
                as == 0 ? style_body : style_frame);
        for (int i = 0; i <= 3; i++) {
            figure_point(&p->figure, x[i % 3], y[i % 3]);
        }
        if (as == 0) {
            plot_grid(p, place_triangle, 0, 0.4);
            plot_dots(p, place_triangle, 0, 1);
        }
    }
    plot_chart(p, &c);
}

static double tent_density(const plot_t *p, double at)
{
    (void)p;
    return 1 - fabs(at);
}

static double length_measure(const plot_t *p, double a, double b)
{
    (void)p;
    return b - a;
}

void plot_tent(plot_t *p)
{
    const plot_chart_t c = {"pdf of x, histogram", "x",
            "\xe2\x88\x92"
            "1",
            "1", -1, 1, 1.2, 1, BARS, weight_of, length_measure, tent_density};
    const double x0 = DOMAIN_X - BALL, x1 = DOMAIN_X + BALL;
    const double y0 = DOMAIN_Y + BALL, y1 = DOMAIN_Y - BALL;

    figure_box(&p->figure, FIGURE_AREA, style_body, x0, y0, x1, y1);
    figure_line(&p->figure, style_hidden, DOMAIN_X, y0, DOMAIN_X, y1);
    figure_line(&p->figure, style_hidden, x0, DOMAIN_Y, x1, DOMAIN_Y);
    plot_dots(p, place_disk, 0, 1);
    figure_box(&p->figure, FIGURE_PATH, style_frame, x0, y0, x1, y1);
    figure_text(&p->figure, style_note, FIGURE_MIDDLE, DOMAIN_X, y0 + 17, "x");
    figure_text(
            &p->figure, style_note, FIGURE_RIGHT, x0 - 7, DOMAIN_Y + 4, "y");
    plot_chart(p, &c);
}

/* Bars of entries and of the cells of a line, over the width of the page. */

static void put_wide_axis(plot_t *p, double top, const char *title)
{
    figure_t *f = &p->figure;
    const double right = CHART_X + CHART_W;
    const figure_style_t *colours[2] = {&style_lobe_text, &style_note};
    const char *names[2] = {title, "samples"};

    figure_line(
            f, style_frame, WIDE_X, plot_square_y(0), right, plot_square_y(0));
    figure_line(
            f, style_frame, WIDE_X, plot_square_y(0), WIDE_X, plot_square_y(1));
    figure_text(
            f, style_tick, FIGURE_RIGHT, WIDE_X - 7, plot_square_y(0) + 4, "0");
    figure_text(f, style_tick, FIGURE_RIGHT, WIDE_X - 7, plot_square_y(1) + 4,
            "%.3g", top);
    for (int k = 0; k < 2; k++) {
        const double x = right - 130 + 70 * k;

        if (k == 0) {
            figure_line(f, style_lobe, x, SQUARE_Y - 15, x + 14, SQUARE_Y - 15);
        } else {
            figure_box(f, FIGURE_AREA, style_bar, x, SQUARE_Y - 19, x + 12,
                    SQUARE_Y - 11);
        }
        figure_text(f, *colours[k], FIGURE_LEFT, x + 19, SQUARE_Y - 11, "%s",
                names[k]);
    }
}

/* Cell k of n: what came to it as a bar, what should as a line across it. */
static void put_cell(plot_t *p, uint32_t k, double count, double wanted,
        uint32_t colour, double gap)
{
    const double width = (CHART_X + CHART_W - WIDE_X) / p->setup->cells.n;
    const double x = WIDE_X + k * width;
    const figure_style_t style = {.colour = colour, .opacity = 0.55};

    if (count > 0) {
        figure_box(&p->figure, FIGURE_AREA, style, x + gap,
                plot_square_y(0) - SQUARE * fmin(count, 1), x + width - gap,
                plot_square_y(0));
    }
    if (wanted > 0) {
        figure_line(&p->figure, style_lobe, x + gap,
                plot_square_y(0) - SQUARE * wanted, x + width - gap,
                plot_square_y(0) - SQUARE * wanted);
    }
}

void plot_cells(plot_t *p)
{
    const warp_cells_t *c = &p->setup->cells;
    const bool entries = p->warp->kind == WARP_ENTRY;
    double top = 0;
    double *counts = cli_alloc(c->n, sizeof *counts);

    for (uint32_t i = 0; i < p->n; i++) {
        const double x = p->samples[i].point.x[0];

        counts[(uint32_t)(entries ? x : x * c->n)] += 1.0 / p->n;
    }
    for (uint32_t i = 0; i < c->n; i++) {
        top = fmax(top, 1.1 * c->mass[i]);
    }
    for (uint32_t i = 0; i < c->n; i++) {
        put_cell(p, i, counts[i] / top, c->mass[i] / top,
                entries ? plot_colour(p, i) : style_bar.colour,
                entries ? 3 : 0.4);
        if (entries) {
            figure_text(&p->figure, style_tick, FIGURE_MIDDLE,
                    WIDE_X + (i + 0.5) * (CHART_X + CHART_W - WIDE_X) / c->n,
                    plot_square_y(0) + 16, "%lu", (unsigned long)i);
        }
    }
    free(counts);
    put_wide_axis(p, entries ? top : top * c->n, entries ? "pmf" : "pdf");
}

/* Points of a line, spread by a number they do not depend on. */
void plot_line_dots(plot_t *p)
{
    for (unsigned group = 0; group < p->n_groups; group++) {
        const figure_style_t style = {.colour = plot_colour(p, group),
                .opacity = 1,
                .size = plot_dot_size(p)};

        figure_add(&p->figure, FIGURE_DOTS, style);
        for (uint32_t i = 0; i < p->n; i++) {
            const plot_sample_t *s = &p->samples[i];

            if (s->group == group) {
                figure_point(&p->figure,
                        WIDE_X + (CHART_X + CHART_W - WIDE_X) * s->point.x[0],
                        plot_square_y(0) + 8 + 20 * plot_unit(s->u[1]));
            }
        }
    }
}

/* Planes of a table side by side: one of a plane, six of a space. */

static void plane_box(const plot_t *p, uint32_t z, double *x0, double *y0,
        double *width, double *height)
{
    const uint32_t planes = p->setup->cells.count[2];

    *width = planes == 1 ? 240 : 72;
    *height = planes == 1 ? 192 : 72;
    *x0 = planes == 1 ? DOMAIN_X - 120 : DOMAIN_X - 120 + 84 * (z % 3);
    *y0 = planes == 1 ? plot_square_y(0) : plot_square_y(0) - 100 * (1 - z / 3);
}

static bool place_table(const plot_t *p, const warp_point_t *point, int pass,
        double *x, double *y)
{
    const warp_cells_t *c = &p->setup->cells;
    const uint32_t z = c->dims == 3 ? (uint32_t)(point->x[2] * c->count[2]) : 0;
    double x0, y0, width, height;

    plane_box(p, z, &x0, &y0, &width, &height);
    *x = x0 + width * point->x[0];
    *y = y0 - height * point->x[1];
    return z == (uint32_t)pass;
}

static void put_plane(plot_t *p, uint32_t z, double largest)
{
    const warp_cells_t *c = &p->setup->cells;
    double x0, y0, width, height;

    plane_box(p, z, &x0, &y0, &width, &height);
    figure_box(&p->figure, FIGURE_AREA, style_body, x0, y0, x0 + width,
            y0 - height);
    for (uint32_t i = 0; i < (uint32_t)c->count[0] * c->count[1]; i++) {
        const double mass = c->mass[z * c->count[0] * c->count[1] + i];
        const double x = x0 + width * (i % c->count[0]) / c->count[0];
        const double y = y0 - height * (i / c->count[0]) / c->count[1];
        const figure_style_t style = {.colour = style_lobe.colour,
                .opacity = 0.06 + 0.5 * pow(mass / largest, 0.6)};

        if (mass > 0) {
            figure_box(&p->figure, FIGURE_AREA, style, x, y,
                    x + width / c->count[0], y - height / c->count[1]);
        }
    }
    plot_dots(p, place_table, (int)z, 1);
    figure_box(&p->figure, FIGURE_PATH, style_frame, x0, y0, x0 + width,
            y0 - height);
    if (c->dims == 3) {
        figure_text(&p->figure, style_tick, FIGURE_MIDDLE, x0 + width / 2,
                y0 - height - 6, "z %lu/6", (unsigned long)z);
    }
}

static double last_of(const plot_t *p, const double *x)
{
    return x[p->setup->cells.dims - 1];
}

/* Of the last coordinate: what all cells there have. */
static double last_density(const plot_t *p, double at)
{
    const warp_cells_t *c = &p->setup->cells;
    const uint32_t n = c->count[c->dims - 1], each = c->n / n;
    const uint32_t k = at >= 1 ? n - 1 : (uint32_t)(at * n);
    double sum = 0;

    for (uint32_t i = 0; i < each; i++) {
        sum += c->mass[k * each + i];
    }
    return sum * n;
}

void plot_table(plot_t *p)
{
    const warp_cells_t *c = &p->setup->cells;
    const uint16_t n = c->count[c->dims - 1];
    plot_chart_t chart = {
            c->dims == 2 ? "pdf of y, histogram" : "pdf of z, histogram",
            c->dims == 2 ? "y" : "z", "0", "1", 0, 1, 0, 0, n, last_of,
            length_measure, last_density};
    double largest = 0;

    for (uint32_t i = 0; i < c->n; i++) {
        largest = fmax(largest, c->mass[i]);
    }
    for (uint32_t z = 0; z < c->count[2]; z++) {
        put_plane(p, z, largest);
    }
    for (uint32_t k = 0; k < n; k++) {
        chart.peak = fmax(chart.peak, last_density(p, (k + 0.5) / n));
    }
    chart.top = 1.2 * chart.peak;
    plot_chart(p, &chart);
}
