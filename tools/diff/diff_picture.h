/* diff_picture.h - the difference of two pictures in false colour */
/* SPDX-License-Identifier: MIT */

#ifndef DIFF_PICTURE_H
#define DIFF_PICTURE_H

#include <stdbool.h>
#include <stddef.h>

#include "lib/image/image.h"

#define DIFF_ZOOM_MAX 16

typedef struct {
    double scale;  /* difference of the full colours, above 0; 0: choose it */
    unsigned zoom; /* a pixel becomes zoom x zoom, 1..DIFF_ZOOM_MAX */
    bool relative; /* each difference divided as in relmse */
} diff_style_t;

/* What a page shows. */
typedef struct {
    double scale;
    uint64_t clipped;   /* pixels with a difference beyond the scale */
    uint64_t undefined; /* pixels without one, drawn black: it is a NaN */
} diff_shown_t;

/* Value i of a picture: channel i % 3 of pixel i / 3. */
double diff_value(const image_t *image, size_t i);

/* Number of values: 3 width height. */
size_t diff_value_count(const image_t *image);

/* 0.01 mean(b)^2: what relmse adds to b^2 before it divides by it. */
double diff_epsilon(const image_t *b);

/* Draw a - b, the mean of the three channels: red where a is larger, blue
 * where smaller, white where equal; below it a bar of these colours with
 * numbers and what they count.
 *
 *   page    -  out: RGB bytes, for image_free()
 *   a, b    -  of the same size, both bytes or both floats
 *   style   -  see above
 *   return  -  the scale, and what does not fit it
 *
 * A scale that is to be chosen is 1, 2 or 5 times a power of ten: the smallest
 * that 99.9 % of the finite differences do not exceed, or that none exceeds if
 * fewer than 0.1 % are not 0. Ends in cli_fail(CLI_USAGE) if the page would be
 * too large for a picture.
 */
diff_shown_t diff_picture(image_t *page, const image_t *a, const image_t *b,
        const diff_style_t *style);

#endif
