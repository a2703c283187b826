/* font.h - a small bitmap font of printable ASCII */
/* SPDX-License-Identifier: MIT */

#ifndef FONT_H
#define FONT_H

#include <stddef.h>
#include <stdint.h>

/* A character's cell in font pixels: the ink is 5 wide, the sixth column is the
 * gap to the next one. Capitals fill the upper 7 rows, tails the 2 below. */
enum { FONT_WIDTH = 6, FONT_HEIGHT = 9, FONT_BASELINE = 7 };

/* Pixels from the left edge of a line of text to its right edge, without the
 * gap after the last character; 0 for no text. */
size_t font_text_width(const char *text, unsigned scale);

/* Draw one line of text into an RGB picture.
 *
 *   bytes   -   3 width height bytes, rows from the top
 *   width   px  of the picture
 *   height  px
 *   x, y    px  upper left corner of the text; any, what is outside is cut off
 *   scale   -   1 or more: a font pixel is a square of scale x scale
 *   text    -   what is not printable ASCII is shown as a box
 *   ink     -   red, green, blue; the ground is left as it is
 */
void font_draw(uint8_t *bytes, size_t width, size_t height, long x, long y,
        unsigned scale, const char *text, const uint8_t ink[3]);

#endif
