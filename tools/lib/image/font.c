/* font.c - a small bitmap font of printable ASCII */
/* SPDX-License-Identifier: MIT */

#include "lib/image/font.h"

#include <stdbool.h>
#include <string.h>

enum { FIRST = ' ', LAST = '~', A_STRIP = 12 /* characters */ };

/* The characters as they look, twelve to a strip; the last one is for all that
 * has no picture. */
/* clang-format off */
static const char strips[][A_STRIP * FONT_WIDTH] = {
    "        #    # #   # #    #   ##  #  ##     #      #   #               ",
    "        #    # #   # #   #### ##  # #  #    #     #     #     #     #  ",
    "        #    # #  ##### # #      #  #  #    #    #       #  # # #   #  ",
    "        #          # #   ###    #    ##          #       #   ###  #####",
    "        #         #####   # #  #    # # #        #       #  # # #   #  ",
    "                   # #  ####  #  ## #  #          #     #     #     #  ",
    "        #          # #    #   #  ##  ## #          #   #               ",
    "                                                                       ",
    "                                                                       ",
    "                      #  ###    #    ###   ###     #  #####   ##  #####",
    "                      # #   #  ##   #   # #   #   ##  #      #        #",
    "                     #  #  ## # #       #     #  # #  ####  #        # ",
    "       ###          #   # # #   #      #    ##  #  #      # ####     # ",
    "                   #    ##  #   #     #       # #####     # #   #   #  ",
    "  ##         ##   #     #   #   #    #    #   #    #  #   # #   #   #  ",
    "  ##         ##   #      ###  ##### #####  ###     #   ###   ###    #  ",
    "  #                                                                    ",
    " #                                                                     ",
    " ###   ###                                 ###   ###    #   ####   ### ",
    "#   # #   #                #         #    #   # #   #  # #  #   # #   #",
    "#   # #   #  ##     ##    #   #####   #       # # ###  # #  #   # #    ",
    " ###   ####  ##     ##   #             #     #  # # # #   # ####  #    ",
    "#   #     #               #   #####   #     #   # ##  ##### #   # #    ",
    "#   #    #   ##     ##     #         #          #     #   # #   # #   #",
    " ###   ##    ##     ##                      #    ###  #   # ####   ### ",
    "                    #                                                  ",
    "                   #                                                   ",
    "####  ##### #####  ###  #   #  ###    ### #   # #     #   # #   #  ### ",
    "#   # #     #     #   # #   #   #      #  #  #  #     ## ## ##  # #   #",
    "#   # #     #     #     #   #   #      #  # #   #     # # # ##  # #   #",
    "#   # ####  ####  # ### #####   #      #  ##    #     # # # # # # #   #",
    "#   # #     #     #   # #   #   #      #  # #   #     #   # #  ## #   #",
    "#   # #     #     #   # #   #   #   #  #  #  #  #     #   # #  ## #   #",
    "####  ##### #      #### #   #  ###   ##   #   # ##### #   # #   #  ### ",
    "                                                                       ",
    "                                                                       ",
    "####   ###  ####   ###  ##### #   # #   # #   # #   # #   # #####  ### ",
    "#   # #   # #   # #   #   #   #   # #   # #   # #   # #   #     #  #   ",
    "#   # #   # #   # #       #   #   # #   # #   #  # #   # #     #   #   ",
    "####  #   # ####   ###    #   #   #  # #  # # #   #     #     #    #   ",
    "#     # # # # #       #   #   #   #  # #  # # #  # #    #    #     #   ",
    "#     #  #  #  #  #   #   #   #   #  # #  ## ## #   #   #   #      #   ",
    "#      ## # #   #  ###    #    ###    #   #   # #   #   #   #####  ### ",
    "                                                                       ",
    "                                                                       ",
    "#      ###    #          #          #               #         ##       ",
    "#        #   # #          #         #               #        #         ",
    " #       #  #   #              ###  ####   ###   ####  ###   #     ####",
    "  #      #                        # #   # #   # #   # #   # ####  #   #",
    "   #     #                     #### #   # #     #   # #####  #    #   #",
    "    #    #                    #   # #   # #   # #   # #      #    #   #",
    "    #  ###                     #### ####   ###   ####  ###   #     ####",
    "                  #####                                               #",
    "                                                                   ### ",
    "#       #      #  #      ##                                            ",
    "#                 #       #                                            ",
    "####   ##     ##  #  #    #   ## #  ####   ###  ####   #### # ##   ####",
    "#   #   #      #  # #     #   # # # #   # #   # #   # #   # ##  # #    ",
    "#   #   #      #  ##      #   # # # #   # #   # #   # #   # #      ### ",
    "#   #   #      #  # #     #   # # # #   # #   # #   # #   # #         #",
    "#   #  ###     #  #  #   ###  # # # #   #  ###  ####   #### #     #### ",
    "               #                                #         #            ",
    "             ##                                 #         #            ",
    " #                                           #    #    #          #####",
    " #                                          #     #     #         #   #",
    "####  #   # #   # #   # #   # #   # #####   #     #     #    #  # #   #",
    " #    #   # #   # # # #  # #  #   #    #   #      #      #  # # # #   #",
    " #    #   #  # #  # # #   #   #   #   #     #     #     #   #  #  #   #",
    " #    #   #  # #  # # #  # #  #   #  #      #     #     #         #   #",
    "  ##   ####   #    # #  #   #  #### #####    #    #    #          #####",
    "                                  #                                    ",
    "                               ###                                     ",
};
/* clang-format on */

/* Is there ink in this column and row of a character? */
static bool has_ink(char c, unsigned column, unsigned row)
{
    const bool known = c >= FIRST && c <= LAST;
    const unsigned i = known ? (unsigned)(c - FIRST) : LAST - FIRST + 1;

    return strips[i / A_STRIP * FONT_HEIGHT + row]
                 [i % A_STRIP * FONT_WIDTH + column] == '#';
}

/* A square of side scale, cut off at the picture's edges. */
static void fill(uint8_t *bytes, size_t width, size_t height, long left,
        long top, unsigned scale, const uint8_t ink[3])
{
    for (long y = top; y < top + (long)scale; y++) {
        for (long x = left; x < left + (long)scale; x++) {
            if (x >= 0 && y >= 0 && (size_t)x < width && (size_t)y < height) {
                memcpy(bytes + 3 * ((size_t)x + width * (size_t)y), ink, 3);
            }
        }
    }
}

size_t font_text_width(const char *text, unsigned scale)
{
    const size_t n = strlen(text);

    return n == 0 ? 0 : (n * FONT_WIDTH - 1) * scale;
}

void font_draw(uint8_t *bytes, size_t width, size_t height, long x, long y,
        unsigned scale, const char *text, const uint8_t ink[3])
{
    const long size = (long)scale;

    for (; *text != '\0'; text++, x += FONT_WIDTH * size) {
        for (unsigned i = 0; i < FONT_WIDTH * FONT_HEIGHT; i++) {
            const unsigned column = i % FONT_WIDTH, row = i / FONT_WIDTH;

            if (has_ink(*text, column, row)) {
                fill(bytes, width, height, x + (long)column * size,
                        y + (long)row * size, scale, ink);
            }
        }
    }
}
