/* diff_picture.c - the difference of two pictures in false colour */
/* SPDX-License-Identifier: MIT */

#include "diff/diff_picture.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "lib/image/font.h"
#include "lib/program/cli.h"

static const uint8_t ink[3] = {24, 24, 28}, gray[3] = {128, 128, 136};
enum { PAPER = 255 };

/* The pictures and what of their difference is shown. */
typedef struct {
    const image_t *a, *b;
    size_t pixels;
    bool relative;
    double epsilon;
} pair_t;

/* ---- Differences --------------------------------------------------------- */

double diff_value(const image_t *image, size_t i)
{
    return image->floats != NULL ? (double)image->floats[i]
                                 : (double)image->bytes[i];
}

size_t diff_value_count(const image_t *image)
{
    return 3 * (size_t)image->width * image->height;
}

double diff_epsilon(const image_t *b)
{
    const size_t n = diff_value_count(b);
    double sum = 0;

    for (size_t i = 0; i < n; i++) {
        sum += diff_value(b, i);
    }
    return 0.01 * (sum / (double)n) * (sum / (double)n);
}

/* Mean of the channels. */
static double difference(const pair_t *p, size_t pixel)
{
    double sum = 0;

    for (size_t i = 3 * pixel; i < 3 * pixel + 3; i++) {
        const double b = diff_value(p->b, i), d = diff_value(p->a, i) - b;

        if (d != 0) { /* 0/0 is no difference */
            sum += p->relative ? d / sqrt(b * b + p->epsilon) : d;
        }
    }
    return sum / 3;
}

/* ---- The scale ----------------------------------------------------------- */

/* The powers of ten, beyond all differences of floats. */
enum { POWER_MIN = -48, POWER_MAX = 48 };
enum { STEPS = 3 * (POWER_MAX - POWER_MIN + 1) };

/* 1e-48, 2e-48, 5e-48, 1e-47, ...: from a table of 1, 2, 5 and one rounding,
 * so that 0.2 is what "0.2" means. */
static double step(int i)
{
    static const double digit[3] = {1, 2, 5};
    const int power = POWER_MIN + i / 3;

    return power < 0 ? digit[i % 3] / pow(10, -power)
                     : digit[i % 3] * pow(10, power);
}

/* The smallest step that is d or more, the last one if none is. d > 0. */
static int step_above(double d)
{
    const double power = floor(log10(d));
    int i;

    if (power < POWER_MIN) {
        return 0;
    }
    if (power > POWER_MAX) {
        return STEPS - 1;
    }
    i = 3 * ((int)power - POWER_MIN);
    while (i < STEPS - 1 && step(i) < d) {
        i++;
    }
    return i;
}

static bool is_most(uint64_t part, uint64_t all)
{
    return 1000 * part >= 999 * all; /* at most 2^28 pixels */
}

static double choose_scale(const pair_t *p)
{
    uint64_t count[STEPS] = {0}, equal = 0, finite = 0, sum;
    int largest = -1, i;

    for (size_t pixel = 0; pixel < p->pixels; pixel++) {
        const double d = fabs(difference(p, pixel));

        if (d > 0 && d <= DBL_MAX) {
            i = step_above(d);
            count[i]++;
            largest = i > largest ? i : largest;
        }
        equal += d == 0;
        finite += d <= DBL_MAX;
    }
    if (largest < 0) {
        return 1;
    }
    if (is_most(equal, finite)) {
        return step(largest);
    }
    sum = equal;
    for (i = 0; !is_most(sum += count[i], finite);) {
        i++;
    }
    return step(i);
}

/* ---- Colours ------------------------------------------------------------- */

static uint8_t srgb(double linear)
{
    const double v = linear < 0 ? 0 : linear > 1 ? 1 : linear;
    const double curve =
            v <= 0.0031308 ? 12.92 * v : 1.055 * pow(v, 1 / 2.4) - 0.055;

    return (uint8_t)(255 * curve + 0.5);
}

/* A colour of Oklab: B. Ottosson, "A perceptual color space for image
 * processing", 2020. */
static void from_oklab(uint8_t rgb[3], double l, double a, double b)
{
    const double x = l + 0.3963377774 * a + 0.2158037573 * b;
    const double y = l - 0.1055613458 * a - 0.0638541728 * b;
    const double z = l - 0.0894841775 * a - 1.2914855480 * b;
    const double x3 = x * x * x, y3 = y * y * y, z3 = z * z * z;

    rgb[0] = srgb(4.0767416621 * x3 - 3.3077115913 * y3 + 0.2309699292 * z3);
    rgb[1] = srgb(-1.2684380046 * x3 + 2.6097574011 * y3 - 0.3413193965 * z3);
    rgb[2] = srgb(-0.0041960863 * x3 - 0.7034186147 * y3 + 1.7076147010 * z3);
}

/* -1 is blue, 0 white, 1 red; a NaN is black.
 *
 * Straight lines in Oklab from white to two colours of the same lightness and
 * chroma: equal steps look equal, and a difference as large as its opposite.
 * Blue and red (hues of 260 and 25 degrees, about the strongest that sRGB has
 * at this lightness) are told apart by the colour-blind too.
 */
static void false_colour(uint8_t rgb[3], double t)
{
    static const double lightness = 0.46, chroma = 0.185;
    static const double hue[2] = {260 / 57.29577951, 25 / 57.29577951};
    const double s = fabs(t) > 1 ? 1 : fabs(t);
    const double angle = hue[t > 0];

    if (!(t == t)) {
        memset(rgb, 0, 3);
        return;
    }
    from_oklab(rgb, 1 - (1 - lightness) * s, s * chroma * cos(angle),
            s * chroma * sin(angle));
}

/* ---- The page ------------------------------------------------------------ */

enum { LINES_MAX = 4, LINE_SIZE = 80 };

/* Places in pixels of the page; what is written below the bar. */
typedef struct {
    unsigned text; /* size of letters and all that goes with them */
    unsigned zoom;
    size_t margin; /* around everything */
    size_t line;   /* from one line of text to the next */
    size_t inside; /* width without margins */
    size_t bar, bar_height;
    size_t height;
    char end[2][32]; /* of the bar */
    char lines[LINES_MAX][LINE_SIZE];
    unsigned line_count;
} layout_t;

static size_t larger(size_t a, size_t b)
{
    return a > b ? a : b;
}

static void word(layout_t *l, const pair_t *p, const diff_shown_t *shown)
{
    const char *unit = p->relative ? "(A - B) / sqrt(B^2 + 0.01 mean(B)^2)"
                       : p->a->floats != NULL ? "A - B, linear radiance"
                                              : "A - B, 8-bit values";
    const char *counts = "%s: %lu of %lu pixels";

    snprintf(l->end[0], sizeof l->end[0], "-%g", shown->scale);
    snprintf(l->end[1], sizeof l->end[1], "+%g", shown->scale);
    snprintf(l->lines[0], LINE_SIZE, "%s", unit);
    snprintf(l->lines[1], LINE_SIZE, "mean of R, G and B");
    snprintf(l->lines[2], LINE_SIZE, counts, "beyond the scale",
            (unsigned long)shown->clipped, (unsigned long)p->pixels);
    snprintf(l->lines[3], LINE_SIZE, counts, "black, no number",
            (unsigned long)shown->undefined, (unsigned long)p->pixels);
    l->line_count = shown->undefined > 0 ? 4 : 3;
}

static const char darker[] = "A is darker", brighter[] = "A is brighter";

static void lay_out(layout_t *l, const image_t *a, unsigned zoom)
{
    const size_t width = (size_t)a->width * zoom;
    const size_t height = (size_t)a->height * zoom;

    l->zoom = zoom;
    l->text = 1 + (unsigned)(width / 512); /* fits below it, and is legible */
    l->margin = 8u * l->text;
    l->line = (FONT_HEIGHT + 3u) * l->text;
    l->inside = larger(width, font_text_width(darker, l->text) + l->margin +
                                      font_text_width(brighter, l->text));
    l->inside = larger(l->inside, font_text_width(l->end[0], l->text) +
                                          font_text_width(l->end[1], l->text) +
                                          4 * l->margin);
    for (unsigned i = 0; i < l->line_count; i++) {
        l->inside = larger(l->inside, font_text_width(l->lines[i], l->text));
    }
    l->bar = l->margin + height + l->margin;
    l->bar_height = 10u * l->text;
    l->height = l->bar + l->bar_height + 5u * l->text +
                (2 + l->line_count) * l->line + l->margin;
}

static size_t page_width(const layout_t *l)
{
    return l->margin + l->inside + l->margin;
}

static void fill(image_t *page, size_t left, size_t top, size_t width,
        size_t height, const uint8_t rgb[3])
{
    for (size_t y = top; y < top + height; y++) {
        for (size_t x = left; x < left + width; x++) {
            memcpy(page->bytes + 3 * (x + page->width * y), rgb, 3);
        }
    }
}

/* A line around what will be filled, because white is also the paper's. */
static void frame(
        image_t *page, size_t left, size_t top, size_t width, size_t height)
{
    fill(page, left - 1, top - 1, width + 2, height + 2, gray);
}

static void write_at(
        image_t *page, const layout_t *l, size_t x, size_t y, const char *text)
{
    font_draw(page->bytes, page->width, page->height, (long)x, (long)y, l->text,
            text, ink);
}

static void write_right(
        image_t *page, const layout_t *l, size_t y, const char *text)
{
    write_at(page, l, l->margin + l->inside - font_text_width(text, l->text), y,
            text);
}

static void draw_difference(
        image_t *page, const layout_t *l, const pair_t *p, double scale)
{
    const size_t width = p->a->width;

    frame(page, l->margin, l->margin, width * l->zoom,
            (size_t)p->a->height * l->zoom);
    for (size_t i = 0; i < p->pixels; i++) {
        uint8_t rgb[3];

        false_colour(rgb, difference(p, i) / scale);
        fill(page, l->margin + i % width * l->zoom,
                l->margin + i / width * l->zoom, l->zoom, l->zoom, rgb);
    }
}

static void draw_legend(image_t *page, const layout_t *l)
{
    const size_t middle = l->margin + l->inside / 2;
    size_t y = l->bar + l->bar_height;

    frame(page, l->margin, l->bar, l->inside, l->bar_height);
    for (size_t x = 0; x < l->inside; x++) {
        uint8_t rgb[3];

        false_colour(rgb, 2 * (double)x / ((double)l->inside - 1) - 1);
        fill(page, l->margin + x, l->bar, 1, l->bar_height, rgb);
    }
    for (size_t i = 0; i <= 4; i++) { /* marks of the quarters */
        fill(page, l->margin + i * (l->inside - l->text) / 4, y, l->text,
                3u * l->text, gray);
    }
    y += 5u * l->text;
    write_at(page, l, l->margin, y, l->end[0]);
    write_at(page, l, middle - font_text_width("0", l->text) / 2, y, "0");
    write_right(page, l, y, l->end[1]);
    y += l->line;
    write_at(page, l, l->margin, y, darker);
    write_right(page, l, y, brighter);
    for (unsigned i = 0; i < l->line_count; i++) {
        y += l->line;
        write_at(page, l, l->margin, y, l->lines[i]);
    }
}

diff_shown_t diff_picture(image_t *page, const image_t *a, const image_t *b,
        const diff_style_t *style)
{
    const pair_t p = {a, b, diff_value_count(a) / 3, style->relative,
            style->relative ? diff_epsilon(b) : 0};
    diff_shown_t shown = {style->scale, 0, 0};
    layout_t l;

    if (!(shown.scale > 0)) {
        shown.scale = choose_scale(&p);
    }
    for (size_t i = 0; i < p.pixels; i++) {
        const double d = difference(&p, i);

        shown.clipped += fabs(d) > shown.scale;
        shown.undefined += !(d == d);
    }
    memset(&l, 0, sizeof l);
    word(&l, &p, &shown);
    lay_out(&l, a, style->zoom);
    if (page_width(&l) > IMAGE_SIDE_MAX || l.height > IMAGE_SIDE_MAX ||
            page_width(&l) * l.height > IMAGE_PIXELS_MAX) {
        cli_fail(CLI_USAGE, "the difference would be %lux%lu pixels: too large",
                (unsigned long)page_width(&l), (unsigned long)l.height);
    }
    image_new_bytes(page, (uint32_t)page_width(&l), (uint32_t)l.height);
    memset(page->bytes, PAPER, diff_value_count(page));
    draw_difference(page, &l, &p, shown.scale);
    draw_legend(page, &l);
    return shown;
}
