/* plot_sphere.c - directions as points of the sphere, densities as lobes */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <string.h>

#include "warp/plot_domain.h"

#define ELEVATION (22 * DEGREE) /* of the eye */
#define DOME      118.0         /* radius of the hemisphere */
#define LOBE      0.8           /* highest density, of that radius */
#define LOBE_MAX  1.13          /* where one without a highest is cut */

/* Directions. The eye looks along y from above; x is to the right. */

static double radius(const plot_t *p)
{
    return p->sphere ? BALL : DOME;
}

static double centre_y(const plot_t *p)
{
    return p->sphere ? DOMAIN_Y : DOMAIN_Y + 40;
}

/* Pass 0 is what is behind, 1 what is in front. */
static bool place_direction(const plot_t *p, const warp_point_t *point,
        int pass, double *x, double *y)
{
    const double *w = point->x;
    const double depth = w[1] * cos(ELEVATION) - w[2] * sin(ELEVATION);

    *x = DOMAIN_X + radius(p) * w[0];
    *y = centre_y(p) -
         radius(p) * (w[2] * cos(ELEVATION) + w[1] * sin(ELEVATION));
    return depth > 0 ? pass == 0 : pass == 1;
}

/* Part of the horizon or of the outline, in degrees; both are ellipses. */
static void add_arc(plot_t *p, double height, int from, int to)
{
    for (int k = 0; k <= CURVE / 2; k++) {
        const double a = (from + (to - from) * k / (CURVE / 2.0)) * DEGREE;

        figure_point(&p->figure, DOMAIN_X + radius(p) * cos(a),
                centre_y(p) - height * radius(p) * sin(a));
    }
}

static void put_arc(
        plot_t *p, figure_style_t style, double height, int from, int to)
{
    figure_add(&p->figure, FIGURE_PATH, style);
    add_arc(p, height, from, to);
}

static void put_body(plot_t *p)
{
    figure_add(&p->figure, FIGURE_AREA, style_body);
    add_arc(p, 1, 0, p->sphere ? 360 : 180);
    if (!p->sphere) {
        add_arc(p, sin(ELEVATION), 180, 360);
    }
    put_arc(p, style_hidden, sin(ELEVATION), 0, 180);
}

static void put_outline(plot_t *p)
{
    put_arc(p, style_frame, 1, 0, p->sphere ? 360 : 180);
    put_arc(p, style_frame, sin(ELEVATION), 180, 360);
}

/* The density at an angle from the axis; 0 beyond the domain. */
static double axial_density(const plot_t *p, double angle)
{
    const double x[3] = {sin(angle), 0, cos(angle)};
    double c[2];

    if (!p->sphere && angle > PI / 2) {
        return 0;
    }
    warp_invert(p->warp, p->setup, x, c);
    return c[0] > 1 + 1e-9 ? 0 : warp_density(p->warp, p->setup, x);
}

/* The density that the lobe's length LOBE stands for; the naive one has no
 * highest. */
static double axial_peak(const plot_t *p)
{
    return plot_is_naive(p) ? 0.28 : axial_density(p, 1e-7);
}

/* Density as distance from the middle, about the axis: from one angle to
 * another, in degrees, as far as there is room. */
static void add_lobe(plot_t *p, double (*density)(const plot_t *p, double at),
        double from, double to)
{
    for (int k = 0; k <= 2 * CURVE; k++) {
        const double angle = (from + (to - from) * k / (2 * CURVE)) * DEGREE;
        const double d = density(p, fabs(angle)) / axial_peak(p) * LOBE;

        if (d <= LOBE_MAX) {
            figure_point(&p->figure, DOMAIN_X + radius(p) * d * sin(angle),
                    centre_y(p) - radius(p) * d * cos(angle) * cos(ELEVATION));
        }
    }
}

static double even_density(const plot_t *p, double angle)
{
    (void)p;
    return angle <= PI / 2 ? 1 / (2 * PI) : 0;
}

/* The one without a peak goes up on both sides and never comes together. */
static void put_lobe(plot_t *p)
{
    const double end = p->sphere ? 180 : 90;

    figure_add(&p->figure, FIGURE_PATH, style_lobe);
    add_lobe(p, axial_density, -end, plot_is_naive(p) ? 0 : end);
    if (plot_is_naive(p)) {
        figure_add(&p->figure, FIGURE_PATH, style_lobe);
        add_lobe(p, axial_density, 0, end);
        figure_add(&p->figure, FIGURE_PATH, style_even);
        add_lobe(p, even_density, -end, end);
    }
}

static double theta_of(const plot_t *p, const double *x)
{
    (void)p;
    return atan2(warp_sine(x), x[2]);
}

/* Solid angle between two cones. */
static double ring(const plot_t *p, double a, double b)
{
    (void)p;
    return 4 * PI * sin((a + b) / 2) * sin((b - a) / 2);
}

/* The smallest of a few angles that holds 999 of 1000 samples. */
static double chart_angle(const plot_t *p)
{
    static const double degrees[] = {
            0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 45, 90, 180};
    unsigned k = 0;

    for (; k + 1 < sizeof degrees / sizeof *degrees; k++) {
        const double a = degrees[k] * DEGREE;
        const double x[3] = {sin(a), 0, cos(a)};
        double c[2];

        warp_invert(p->warp, p->setup, x, c);
        if (c[0] >= 0.999) {
            break;
        }
    }
    return degrees[k];
}

static void put_axial_chart(plot_t *p)
{
    const double end = chart_angle(p), peak = axial_peak(p);
    char high[16];
    plot_chart_t c = {"pdf per sr, histogram", "\xce\xb8", "0\xc2\xb0", high, 0,
            end * DEGREE, 1.2 * peak, peak, BARS, theta_of, ring,
            axial_density};

    snprintf(high, sizeof high, "%g\xc2\xb0", end);
    if (plot_is_naive(p)) {
        c.top = 0.8;
        c.peak = 1 / (2 * PI);
    }
    plot_chart(p, &c);
    if (plot_is_naive(p)) {
        plot_curve(p, &c, style_even, even_density);
        figure_text(&p->figure, style_even_text, FIGURE_RIGHT,
                CHART_X + CHART_W, plot_chart_y(&c, c.peak) - 6, "uniform");
    }
}

void plot_axial(plot_t *p)
{
    const double top = centre_y(p) - radius(p) - 10;

    p->sphere = strcmp(p->warp->name, "uniform-sphere") == 0;
    put_body(p);
    plot_grid(p, place_direction, 0, 0.15);
    plot_dots(p, place_direction, 0, 0.3);
    figure_add(&p->figure, FIGURE_AREA, style_lobe_fill);
    add_lobe(p, axial_density, p->sphere ? -180 : -90, p->sphere ? 180 : 90);
    plot_grid(p, place_direction, 1, 0.4);
    plot_dots(p, place_direction, 1, 1);
    put_outline(p);
    put_lobe(p);
    if (plot_is_naive(p)) {
        figure_text(&p->figure, style_lobe_text, FIGURE_MIDDLE, DOMAIN_X,
                top - 8, "pdf \xe2\x88\x9e at the pole");
    } else {
        figure_text(&p->figure, style_lobe_text, FIGURE_MIDDLE, DOMAIN_X,
                centre_y(p) - radius(p) - 10, "peak %.4g per sr",
                axial_peak(p));
    }
    put_axial_chart(p);
}

/* The edges of a spherical triangle: great circles. */
static void put_edges(plot_t *p)
{
    for (int i = 0; i < 3; i++) {
        const double *a = p->setup->corners[i];
        const double *b = p->setup->corners[(i + 1) % 3];

        figure_add(&p->figure, FIGURE_PATH, style_lobe);
        for (int k = 0; k <= CURVE / 4; k++) {
            const double t = k / (CURVE / 4.0);
            warp_point_t point;
            double x, y, square = 0;

            for (int d = 0; d < 3; d++) {
                point.x[d] = (1 - t) * a[d] + t * b[d];
                square += point.x[d] * point.x[d];
            }
            for (int d = 0; d < 3; d++) {
                point.x[d] /= sqrt(square);
            }
            (void)place_direction(p, &point, 1, &x, &y);
            figure_point(&p->figure, x, y);
        }
    }
}

/* Of densities that are even: the first of the numbers invert() returns. */
static double share_of(const plot_t *p, const double *x)
{
    double c[3];

    warp_invert(p->warp, p->setup, x, c);
    return c[0];
}

static double share_measure(const plot_t *p, double a, double b)
{
    return (b - a) / plot_even_density(p, 0);
}

void plot_direction(plot_t *p)
{
    const double d = plot_even_density(p, 0);
    const plot_chart_t c = {"pdf per sr, histogram", "share of the area", "0",
            "1", 0, 1, 1.5 * d, d, 16, share_of, share_measure,
            plot_even_density};

    put_body(p);
    put_outline(p);
    plot_grid(p, place_direction, 0, 0.15);
    plot_dots(p, place_direction, 0, 0.3);
    plot_grid(p, place_direction, 1, 0.4);
    plot_dots(p, place_direction, 1, 1);
    put_edges(p);
    figure_text(&p->figure, style_lobe_text, FIGURE_MIDDLE, DOMAIN_X,
            centre_y(p) - radius(p) - 10, "pdf %.4g per sr", d);
    plot_chart(p, &c);
}
