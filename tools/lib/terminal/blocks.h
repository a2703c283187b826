/* blocks.h - a picture in a terminal, two pixels a character */
/* SPDX-License-Identifier: MIT */

/* A character is about twice as high as wide, so that U+2580, the upper half
 * block, shows two square pixels: its colour the upper one, the background the
 * lower one. Colours are of 24 bits if COLORTERM is truecolor or 24bit, else
 * the 216 of a cube of 6 levels (ECMA-48 SGR 38 and 48, as xterm has them). */

#ifndef BLOCKS_H
#define BLOCKS_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

typedef struct {
    uint32_t width; /* px, of the picture */
    uint32_t height;
    uint32_t columns; /* pixels in the terminal, both at most the picture's */
    uint32_t rows;
    bool full_colour;
    bool drawn;     /* the next drawing goes over this one */
    uint64_t *sums; /* of columns * rows pixels: R, G, B, count */
} blocks_t;

/* Begin a picture that fits into the terminal that stderr is, or 80 columns of
 * 24 lines, with its sides in proportion. It is never made larger.
 *
 *   width, height  px  1 to 16384
 *
 * Memory: 32 bytes a pixel of the terminal, from cli_alloc(); blocks_free().
 */
void blocks_begin(blocks_t *blocks, uint32_t width, uint32_t height);

/* Take a row of the picture for the next drawing: the pixels of a place in the
 * terminal are averaged as they are.
 *
 *   y    px
 *   rgb  -   3 bytes a pixel
 */
void blocks_row(blocks_t *blocks, uint32_t y, const uint8_t *rgb);

/* Draw it, over the last drawing if the cursor is still below that; places
 * without a row are black. The rows are forgotten. */
void blocks_draw(blocks_t *blocks, FILE *to);

void blocks_free(blocks_t *blocks);

#endif
