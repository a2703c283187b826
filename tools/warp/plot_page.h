/* plot_page.h - the page of a picture: ink, dots, grid, histogram */
/* SPDX-License-Identifier: MIT */

#ifndef PLOT_PAGE_H
#define PLOT_PAGE_H

#include "figure/figure.h"
#include "warp/warps.h"

#define PI     3.14159265358979323846
#define DEGREE (PI / 180)

/* The page. */
#define WIDTH    800.0
#define HEIGHT   370.0
#define SQUARE_X 48.0
#define SQUARE_Y 92.0
#define SQUARE   200.0
#define DOMAIN_X 432.0 /* its middle */
#define DOMAIN_Y 192.0
#define CHART_X  616.0 /* the histogram on the right */
#define CHART_Y  112.0
#define CHART_W  156.0
#define CHART_H  150.0
#define WIDE_X   340.0 /* where bars take its place too */
#define BALL     100.0 /* radius of a disk and of the sphere */

enum {
    CURVE = 96, /* points of a curve */
    BARS = 18   /* of a histogram */
};

/* Samples of the square are coloured by the part of it that they are in. */
enum {
    CLASSES_1 = 4, /* of u1, by lightness */
    CLASSES_2 = 8, /* of u2, by hue */
    CLASSES = CLASSES_1 * CLASSES_2
};

extern const figure_style_t style_note;
extern const figure_style_t style_tick;
extern const figure_style_t style_frame;
extern const figure_style_t style_hidden;
extern const figure_style_t style_body;
extern const figure_style_t style_lobe;
extern const figure_style_t style_lobe_fill;
extern const figure_style_t style_lobe_text;
extern const figure_style_t style_even;
extern const figure_style_t style_even_text;
extern const figure_style_t style_bar;

/* One sample: what it was drawn from, where it went. */
typedef struct {
    uint32_t u[WARP_NUMBERS];
    warp_point_t point;
    unsigned group; /* what colour it has */
} plot_sample_t;

typedef struct {
    figure_t figure;
    const warp_t *warp;
    const warp_setup_t *setup;
    plot_sample_t *samples;
    uint32_t n;
    unsigned n_groups;
    bool sphere; /* not only its upper half */
} plot_t;

/* Where a point is on the page; false if it is not shown in this pass. */
typedef bool plot_place_t(const plot_t *p, const warp_point_t *point, int pass,
        double *x, double *y);

/* A small chart: how often samples fell on each piece of a line, divided by
 * its measure, and the density they should have there. */
typedef struct {
    const char *title;
    const char *name;                 /* of the line */
    const char *low_text, *high_text; /* of its ends */
    double low, high;                 /* ends */
    double top;                       /* highest density shown */
    double peak;                      /* density written at the axis */
    unsigned bars;
    double (*where)(const plot_t *p, const double *x);
    double (*measure)(const plot_t *p, double a, double b);
    double (*density)(const plot_t *p, double at);
} plot_chart_t;

/* A number in [0, 1). */
double plot_unit(uint32_t u);

/* Where a number of the unit square is on the page. */
double plot_square_x(double u);
double plot_square_y(double u);

/* Colour and diameter of the dots of a group. */
uint32_t plot_colour(const plot_t *p, unsigned group);
double plot_dot_size(const plot_t *p);

/* All dots of a pass, a path for each colour. */
void plot_dots(plot_t *p, plot_place_t *place, int pass, double opacity);

/* The grid of the square as the warp bends it. */
void plot_grid(plot_t *p, plot_place_t *place, int pass, double opacity);

/* The histogram on the right; another curve over it, where a density is. */
void plot_chart(plot_t *p, const plot_chart_t *c);
void plot_curve(plot_t *p, const plot_chart_t *c, figure_style_t style,
        double (*density)(const plot_t *p, double at));
double plot_chart_y(const plot_chart_t *c, double density);

/* The warp that is compared with uniform too. */
bool plot_is_naive(const plot_t *p);

/* The density of a warp that has the same everywhere. */
double plot_even_density(const plot_t *p, double at);

#endif
