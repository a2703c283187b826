/* figure_svg.c - drawings: how one is described, and written as SVG */
/* SPDX-License-Identifier: MIT */

#include "figure/figure.h"
#include "lib/program/cli.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#define STRAIGHT 0.08 /* how far a curve may be from its lines */

static void *grown(void *memory, size_t *room, size_t size)
{
    *room = *room > 0 ? 2 * *room : 16;
    memory = realloc(memory, *room * size);
    if (memory == NULL) {
        cli_fail(CLI_IO, "out of memory for a drawing");
    }
    return memory;
}

void figure_begin(figure_t *figure, double width, double height)
{
    memset(figure, 0, sizeof *figure);
    figure->width = width;
    figure->height = height;
}

void figure_free(figure_t *figure)
{
    for (size_t i = 0; i < figure->n; i++) {
        free(figure->items[i].xy);
    }
    free(figure->items);
    memset(figure, 0, sizeof *figure);
}

void figure_add(figure_t *figure, figure_as_t as, figure_style_t style)
{
    figure_item_t *item;

    if (figure->n == figure->room) {
        figure->items =
                grown(figure->items, &figure->room, sizeof *figure->items);
    }
    item = &figure->items[figure->n++];
    memset(item, 0, sizeof *item);
    item->as = as;
    item->style = style;
}

void figure_point(figure_t *figure, double x, double y)
{
    figure_item_t *item = &figure->items[figure->n - 1];

    if (item->n == item->room) {
        item->xy = grown(item->xy, &item->room, 2 * sizeof *item->xy);
    }
    item->xy[2 * item->n] = x;
    item->xy[2 * item->n + 1] = y;
    item->n++;
}

void figure_line(figure_t *figure, figure_style_t style, double x0, double y0,
        double x1, double y1)
{
    figure_add(figure, FIGURE_PATH, style);
    figure_point(figure, x0, y0);
    figure_point(figure, x1, y1);
}

void figure_box(figure_t *figure, figure_as_t as, figure_style_t style,
        double x0, double y0, double x1, double y1)
{
    figure_add(figure, as, style);
    figure_point(figure, x0, y0);
    figure_point(figure, x1, y0);
    figure_point(figure, x1, y1);
    figure_point(figure, x0, y1);
    figure_point(figure, x0, y0);
}

void figure_text(figure_t *figure, figure_style_t style, figure_anchor_t anchor,
        double x, double y, const char *format, ...)
{
    va_list arguments;
    figure_item_t *item;

    figure_add(figure, FIGURE_TEXT, style);
    figure_point(figure, x, y);
    item = &figure->items[figure->n - 1];
    item->anchor = anchor;
    va_start(arguments, format);
    vsnprintf(item->text, sizeof item->text, format, arguments);
    va_end(arguments);
}

/* A number of one decimal, as short as it can be written. */
static void put_number(FILE *file, double value)
{
    const long tenths = lround(value * 10);

    if (tenths % 10 == 0) {
        fprintf(file, "%ld", tenths / 10);
    } else {
        fprintf(file, "%.1f", (double)tenths / 10);
    }
}

static void put_point(FILE *file, char command, const double *xy)
{
    fputc(command, file);
    put_number(file, xy[0]);
    fputc(' ', file);
    put_number(file, xy[1]);
}

static void put_paint(FILE *file, const figure_item_t *item)
{
    const bool area = item->as == FIGURE_AREA;

    fprintf(file, " %s=\"#%06lx\"", area ? "fill" : "stroke",
            (unsigned long)item->style.colour);
    if (!area) {
        fprintf(file, " stroke-width=\"%.4g\"", item->style.size);
    }
    if (item->style.dashed) {
        fputs(" stroke-dasharray=\"4 3\"", file);
    }
    if (item->style.opacity < 1) {
        fprintf(file, " %s-opacity=\"%.3g\"", area ? "fill" : "stroke",
                item->style.opacity);
    }
}

/* Whether the points between two are close to the line that joins them. */
static bool straight(const double *xy, size_t from, size_t to)
{
    const double *a = xy + 2 * from, *b = xy + 2 * to;
    const double dx = b[0] - a[0], dy = b[1] - a[1], length = hypot(dx, dy);

    for (size_t i = from + 1; i < to; i++) {
        const double px = xy[2 * i] - a[0], py = xy[2 * i + 1] - a[1];
        const double along = px * dx + py * dy;

        if (along < 0 || along > length * length ||
                fabs(px * dy - py * dx) > STRAIGHT * length) {
            return false;
        }
    }
    return true;
}

/* The point that a path goes on to: the farthest for which the ones left out
 * do not matter, since a curve has more points than an eye needs. */
static size_t next_point(const figure_item_t *item, size_t i)
{
    size_t next = i + 1;

    while (item->as != FIGURE_DOTS && next + 1 < item->n &&
            straight(item->xy, i, next + 1)) {
        next++;
    }
    return next;
}

/* Dots are lines of no length with round ends: one path for all of a colour. */
static void put_path(FILE *file, const figure_item_t *item)
{
    fputs("<path", file);
    put_paint(file, item);
    fputs(" d=\"", file);
    for (size_t i = 0; i < item->n; i = next_point(item, i)) {
        const bool begins = i == 0 || item->as == FIGURE_DOTS;

        put_point(file, begins ? 'M' : 'L', item->xy + 2 * i);
        if (item->as == FIGURE_DOTS) {
            fputs("h0", file);
        }
    }
    fputs(item->as == FIGURE_AREA ? "Z\"/>\n" : "\"/>\n", file);
}

static void put_characters(FILE *file, const char *text, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        if (text[i] == '<' || text[i] == '>' || text[i] == '&') {
            fputs(text[i] == '<'     ? "&lt;"
                    : text[i] == '>' ? "&gt;"
                                     : "&amp;",
                    file);
        } else {
            fputc(text[i], file);
        }
    }
}

/* Text with what is raised as a span; the one after it comes down again. */
static void put_spans(FILE *file, const char *text, double size)
{
    while (*text != '\0') {
        const size_t plain = strcspn(text, "^");
        size_t n;

        put_characters(file, text, plain);
        text += plain;
        if (*text == '\0') {
            break;
        }
        text++;
        n = *text == '{' ? strcspn(++text, "}") : figure_letter_bytes(text);
        fprintf(file, "<tspan font-size=\"%.3g\" dy=\"%.3g\">", 0.72 * size,
                -0.36 * size);
        put_characters(file, text, n);
        text += n;
        text += *text == '}';
        fprintf(file, "</tspan><tspan dy=\"%.3g\">", 0.36 * size);
        n = strcspn(text, "^");
        put_characters(file, text, n);
        text += n;
        fputs("</tspan>", file);
    }
}

static void put_text(FILE *file, const figure_item_t *item)
{
    static const char *const anchors[] = {"start", "middle", "end"};

    fputs("<text x=\"", file);
    put_number(file, item->xy[0]);
    fputs("\" y=\"", file);
    put_number(file, item->xy[1]);
    fprintf(file, "\" font-size=\"%.3g\" fill=\"#%06lx\"", item->style.size,
            (unsigned long)item->style.colour);
    if (item->anchor != FIGURE_LEFT) {
        fprintf(file, " text-anchor=\"%s\"", anchors[item->anchor]);
    }
    if (item->style.bold) {
        fputs(" font-weight=\"bold\"", file);
    }
    fputs(">", file);
    put_spans(file, item->text, item->style.size);
    fputs("</text>\n", file);
}

void figure_write_svg(const figure_t *figure, FILE *file)
{
    fprintf(file,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" "
            "height=\"%.0f\" viewBox=\"0 0 %.0f %.0f\" "
            "font-family=\"Helvetica,Arial,sans-serif\" fill=\"none\" "
            "stroke-linecap=\"round\" stroke-linejoin=\"round\">\n"
            "<path fill=\"#fff\" d=\"M0 0H%.0fV%.0fH0Z\"/>\n",
            figure->width, figure->height, figure->width, figure->height,
            figure->width, figure->height);
    for (size_t i = 0; i < figure->n; i++) {
        if (figure->items[i].as == FIGURE_TEXT) {
            put_text(file, &figure->items[i]);
        } else if (figure->items[i].n > 0) {
            put_path(file, &figure->items[i]);
        }
    }
    fputs("</svg>\n", file);
}
