/* figure.h - a drawing of paths, dots and text, to SVG or to pixels */
/* SPDX-License-Identifier: MIT */

/* One description, two back ends. Lengths are in units of a pixel of the SVG,
 * y downwards. Text is UTF-8; ^x or ^{xyz} raises. */

#ifndef FIGURE_H
#define FIGURE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "lib/image/image.h"

typedef enum { FIGURE_PATH, FIGURE_AREA, FIGURE_DOTS, FIGURE_TEXT } figure_as_t;
typedef enum { FIGURE_LEFT, FIGURE_MIDDLE, FIGURE_RIGHT } figure_anchor_t;

typedef struct {
    uint32_t colour; /* 0xrrggbb */
    double opacity;  /* 0..1 */
    double size;     /* width of a path, diameter of a dot, size of text */
    bool dashed;
    bool bold;
} figure_style_t;

typedef struct {
    figure_as_t as;
    figure_style_t style;
    figure_anchor_t anchor;
    double *xy; /* n points; of text the one where its baseline is anchored */
    size_t n, room;
    char text[160];
} figure_item_t;

typedef struct {
    double width, height;
    figure_item_t *items;
    size_t n, room;
} figure_t;

void figure_begin(figure_t *figure, double width, double height);
void figure_free(figure_t *figure);

/* Begin a path, an area or dots; the points follow. */
void figure_add(figure_t *figure, figure_as_t as, figure_style_t style);
void figure_point(figure_t *figure, double x, double y);

void figure_line(figure_t *figure, figure_style_t style, double x0, double y0,
        double x1, double y1);
void figure_box(figure_t *figure, figure_as_t as, figure_style_t style,
        double x0, double y0, double x1, double y1);

#if defined(__GNUC__)
__attribute__((format(printf, 6, 7)))
#endif
void figure_text(figure_t *figure, figure_style_t style,
        figure_anchor_t anchor, double x, double y, const char *format, ...);

/* The bytes of one character at text. */
unsigned figure_letter_bytes(const char *text);

void figure_write_svg(const figure_t *figure, FILE *file);

/* A new picture, scale pixels a unit, on white. */
void figure_draw(const figure_t *figure, image_t *image, double scale);

/* Lines of one character, for text in pixels.
 *
 *   text     -  where it begins
 *   emit     -  called for each straight line, in units of the text size
 *   context  -  handed on
 *   return   width in units of the text size; an unknown one is a box
 */
double figure_letter(const char *text,
        void (*emit)(void *context, double x0, double y0, double x1, double y1),
        void *context);

#endif
