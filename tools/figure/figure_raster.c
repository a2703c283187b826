/* figure_raster.c - drawings to pixels, smoothed */
/* SPDX-License-Identifier: MIT */

#include "figure/figure.h"
#include "lib/program/cli.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define DASH        4.0 /* lengths as in the SVG */
#define GAP         3.0
#define PEN         0.088 /* width of a stroke of text, of its size */
#define PEN_BOLD    0.125
#define WIDE        1.03
#define WIDE_BOLD   1.1
#define RAISED      0.72 /* size of raised text, and by how much it is raised */
#define RAISED_BY   0.36
#define SUBLINES    4 /* lines a pixel that areas are filled by */
#define CROSSES_MAX 64

/* How much of each pixel an item covers, and the part of it in use. */
typedef struct {
    image_t *image;
    float *cover;
    double scale;
    long x0, y0, x1, y1;
} canvas_t;

static long clamp(double value, long max)
{
    return value < 0 ? 0 : value > (double)max ? max : (long)value;
}

static void use(canvas_t *c, long x0, long y0, long x1, long y1)
{
    c->x0 = x0 < c->x0 ? x0 : c->x0;
    c->y0 = y0 < c->y0 ? y0 : c->y0;
    c->x1 = x1 > c->x1 ? x1 : c->x1;
    c->y1 = y1 > c->y1 ? y1 : c->y1;
}

/* A line with round ends, in pixels: what is within half a width of it, with
 * an edge one pixel wide. */
static void cover_line(
        canvas_t *c, double half, double ax, double ay, double bx, double by)
{
    const long w = (long)c->image->width, h = (long)c->image->height;
    const double reach = half + 1;
    const long x0 = clamp((ax < bx ? ax : bx) - reach, w);
    const long x1 = clamp((ax > bx ? ax : bx) + reach + 1, w);
    const long y0 = clamp((ay < by ? ay : by) - reach, h);
    const long y1 = clamp((ay > by ? ay : by) + reach + 1, h);
    const double dx = bx - ax, dy = by - ay, square = dx * dx + dy * dy;

    use(c, x0, y0, x1, y1);
    for (long y = y0; y < y1; y++) {
        for (long x = x0; x < x1; x++) {
            const double px = (double)x + 0.5 - ax, py = (double)y + 0.5 - ay;
            double t = square > 0 ? (px * dx + py * dy) / square : 0;
            double d;
            float *cover = &c->cover[y * w + x];

            t = t < 0 ? 0 : t > 1 ? 1 : t;
            d = half + 0.5 - hypot(px - t * dx, py - t * dy);
            /* thinner than a pixel: no darker than its width */
            d = d > 2 * half ? 2 * half : d;
            d = d > 1 ? 1 : d;
            *cover = d > *cover ? (float)d : *cover;
        }
    }
}

static void cover_dashes(canvas_t *c, const figure_item_t *item)
{
    const double half = item->style.size * c->scale / 2;
    double phase = 0; /* how far into a dash and its gap */

    for (size_t i = 0; i + 1 < item->n; i++) {
        const double *a = item->xy + 2 * i, *b = a + 2;
        const double length = hypot(b[0] - a[0], b[1] - a[1]);
        double at = 0;

        while (at < length) {
            const bool on = phase < DASH;
            const double rest = (on ? DASH : DASH + GAP) - phase;
            const double end = at + rest < length ? at + rest : length;

            if (on) {
                const double t = at / length, u = end / length;

                cover_line(c, half, (a[0] + t * (b[0] - a[0])) * c->scale,
                        (a[1] + t * (b[1] - a[1])) * c->scale,
                        (a[0] + u * (b[0] - a[0])) * c->scale,
                        (a[1] + u * (b[1] - a[1])) * c->scale);
            }
            phase = end < at + rest ? phase + (end - at) : on ? DASH : 0;
            at = end;
        }
    }
}

static void cover_path(canvas_t *c, const figure_item_t *item)
{
    const double half = item->style.size * c->scale / 2;
    const bool dots = item->as == FIGURE_DOTS;

    for (size_t i = 0; i + (dots ? 0 : 1) < item->n; i++) {
        const double *a = item->xy + 2 * i, *b = dots ? a : a + 2;

        cover_line(c, half, a[0] * c->scale, a[1] * c->scale, b[0] * c->scale,
                b[1] * c->scale);
    }
}

static int compare_doubles(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;

    return (x > y) - (x < y);
}

/* Where the outline of an area crosses a line of pixels, from left to right. */
static size_t cross(
        const figure_item_t *item, double scale, double y, double *crosses)
{
    size_t n = 0;

    for (size_t i = 0; i < item->n; i++) {
        const double *a = item->xy + 2 * i;
        const double *b = item->xy + 2 * ((i + 1) % item->n);
        const double ay = a[1] * scale, by = b[1] * scale;

        if ((ay <= y) != (by <= y) && n < CROSSES_MAX) {
            crosses[n++] =
                    scale * (a[0] + (y - ay) / (by - ay) * (b[0] - a[0]));
        }
    }
    qsort(crosses, n, sizeof *crosses, compare_doubles);
    return n;
}

static void cover_area(canvas_t *c, const figure_item_t *item)
{
    const long w = (long)c->image->width, h = (long)c->image->height;
    double crosses[CROSSES_MAX];

    for (long line = 0; line < h * SUBLINES; line++) {
        const double y = ((double)line + 0.5) / SUBLINES;
        const size_t n = cross(item, c->scale, y, crosses);

        for (size_t k = 0; k + 1 < n; k += 2) {
            const long x0 = clamp(crosses[k], w);
            const long x1 = clamp(crosses[k + 1] + 1, w);

            use(c, x0, line / SUBLINES, x1, line / SUBLINES + 1);
            for (long x = x0; x < x1; x++) {
                const double left = fmax(crosses[k], (double)x);
                const double right = fmin(crosses[k + 1], (double)(x + 1));

                c->cover[line / SUBLINES * w + x] +=
                        (float)((right - left) / SUBLINES);
            }
        }
    }
}

/* Where a character goes, or nowhere while text is only measured. */
typedef struct {
    canvas_t *canvas;
    double x, y, size, half;
    double wide; /* of a character, of what the font says */
} place_t;

static void place_line(
        void *context, double x0, double y0, double x1, double y1)
{
    const place_t *p = context;

    if (p->canvas != NULL) {
        cover_line(p->canvas, p->half, p->x + p->size * x0, p->y - p->size * y0,
                p->x + p->size * x1, p->y - p->size * y1);
    }
}

/* Set text from p on; return its width. */
static double set_text(place_t p, const char *text)
{
    const double begin = p.x, base = p.y, size = p.size;
    unsigned braces = 0;
    bool raised = false;

    while (*text != '\0') {
        if (*text == '^' && !raised) {
            raised = true;
            text++;
            braces = *text == '{';
            text += braces;
            continue;
        }
        if (*text == '}' && braces) {
            raised = false;
            braces = 0;
            text++;
            continue;
        }
        p.size = raised ? RAISED * size : size;
        p.y = raised ? base - RAISED_BY * size : base;
        p.x += p.size * p.wide * figure_letter(text, place_line, &p);
        raised = raised && braces;
        text += figure_letter_bytes(text);
    }
    return p.x - begin;
}

static void cover_text(canvas_t *c, const figure_item_t *item)
{
    const double size = item->style.size * c->scale;
    place_t p = {NULL, 0, 0, size, 0, item->style.bold ? WIDE_BOLD : WIDE};
    const double width = set_text(p, item->text);

    p.canvas = c;
    p.x = item->xy[0] * c->scale - width * (double)item->anchor / 2;
    p.y = item->xy[1] * c->scale;
    p.half = size * (item->style.bold ? PEN_BOLD : PEN) / 2;
    (void)set_text(p, item->text);
}

/* Lay the colour over what is covered, and forget that it was. */
static void blend(canvas_t *c, const figure_style_t *style)
{
    const long w = (long)c->image->width;

    for (long y = c->y0; y < c->y1; y++) {
        for (long x = c->x0; x < c->x1; x++) {
            float *cover = &c->cover[y * w + x];
            uint8_t *pixel = c->image->bytes + 3 * (y * w + x);
            const double a = fmin(*cover, 1) * style->opacity;

            for (int k = 0; k < 3 && a > 0; k++) {
                const double to =
                        (double)(style->colour >> (16 - 8 * k) & 0xffu);

                pixel[k] = (uint8_t)lround(pixel[k] + a * (to - pixel[k]));
            }
            *cover = 0;
        }
    }
}

void figure_draw(const figure_t *figure, image_t *image, double scale)
{
    canvas_t c = {.image = image, .scale = scale};

    image_new_bytes(image, (uint32_t)lround(figure->width * scale),
            (uint32_t)lround(figure->height * scale));
    memset(image->bytes, 0xff, 3 * (size_t)image->width * image->height);
    c.cover = cli_alloc((size_t)image->width * image->height, sizeof *c.cover);
    for (size_t i = 0; i < figure->n; i++) {
        const figure_item_t *item = &figure->items[i];

        c.x0 = c.y0 = IMAGE_SIDE_MAX;
        c.x1 = c.y1 = 0;
        if (item->as == FIGURE_TEXT) {
            cover_text(&c, item);
        } else if (item->as == FIGURE_AREA) {
            cover_area(&c, item);
        } else if (item->style.dashed) {
            cover_dashes(&c, item);
        } else {
            cover_path(&c, item);
        }
        blend(&c, &item->style);
    }
    free(c.cover);
}
