/* test_figure.c - dashes of a drawing in pixels, as its SVG has them */
/* SPDX-License-Identifier: MIT */

#include <string.h>

#include "figure/figure.h"
#include "support/ql_test.h"

/* A dash of 4 and a gap of 3, again and again from the path's first point. Two
 * units wide, a path along a border of pixels covers one on each side. Round
 * ends reach one unit into a gap, so its middle stays white. */
static const figure_style_t pen = {
        .colour = 0x204060, .opacity = 1, .size = 2, .dashed = true};

/* Is a pixel in the middle of a dash (1), of a gap (0) or neither (-1), so many
 * units along the path? */
static int wanted(double along)
{
    double phase = along;

    while (phase >= 7) {
        phase -= 7;
    }
    return phase > 0.4 && phase < 3.6 ? 1 : phase > 5.4 && phase < 5.6 ? 0 : -1;
}

static void check_pixel(
        const image_t *image, unsigned x, unsigned y, double along)
{
    static const uint8_t ink[3] = {0x20, 0x40, 0x60};
    static const uint8_t paper[3] = {0xff, 0xff, 0xff};
    const uint8_t *pixel = image->bytes + 3 * (x + (size_t)image->width * y);
    const int want = wanted(along);

    CHECK(want < 0 || memcmp(pixel, want > 0 ? ink : paper, 3) == 0,
            "%u %u, %.1f along: %02x%02x%02x", x, y, along, pixel[0], pixel[1],
            pixel[2]);
}

TEST(a_line_is_dashed_from_its_beginning)
{
    for (unsigned scale = 1; scale <= 2; scale++) {
        figure_t figure;
        image_t image;

        figure_begin(&figure, 60, 20);
        figure_line(&figure, pen, 2, 10, 56, 10);
        figure_draw(&figure, &image, scale);
        CHECK(image.width == 60 * scale && image.height == 20 * scale,
                "%u x %u", (unsigned)image.width, (unsigned)image.height);
        for (unsigned x = 2 * scale; x < 56 * scale; x++) {
            const double along = (x + 0.5) / scale - 2;

            if (scale == 1 || wanted(along) > 0) {
                check_pixel(&image, x, 10 * scale, along);
                check_pixel(&image, x, 10 * scale - 1, along);
            }
        }
        image_free(&image);
        figure_free(&figure);
    }
}

/* From 2 5 to the right, then down; the corner lies in a dash, in a gap, at the
 * end of a dash, and at the end of a gap. */
TEST(dashes_go_on_around_corners)
{
    static const unsigned corners[] = {2, 6, 4, 7, 9};

    for (unsigned i = 0; i < 5; i++) {
        const unsigned right = corners[i];
        figure_t figure;
        image_t image;

        figure_begin(&figure, 30, 60);
        figure_add(&figure, FIGURE_PATH, pen);
        figure_point(&figure, 2, 5);
        figure_point(&figure, 2 + right, 5);
        figure_point(&figure, 2 + right, 50);
        figure_draw(&figure, &image, 1);
        for (unsigned y = 7; y < 50; y++) {
            check_pixel(&image, 2 + right, y, right + y + 0.5 - 5);
            check_pixel(&image, 1 + right, y, right + y + 0.5 - 5);
        }
        image_free(&image);
        figure_free(&figure);
    }
}

TEST(a_path_without_dashes_has_no_gap)
{
    figure_style_t solid = pen;
    figure_t figure;
    image_t image;

    solid.dashed = false;
    figure_begin(&figure, 60, 20);
    figure_line(&figure, solid, 2, 10, 56, 10);
    figure_draw(&figure, &image, 1);
    for (unsigned x = 2; x < 56; x++) {
        check_pixel(&image, x, 10, 1);
    }
    check_pixel(&image, 58, 10, 5.5);
    check_pixel(&image, 30, 12, 5.5);
    image_free(&image);
    figure_free(&figure);
}

/* The SVG says the same numbers. */
TEST(the_svg_has_the_same_dashes)
{
    static char text[4096];
    figure_t figure;
    FILE *file = tmpfile();
    size_t size;

    figure_begin(&figure, 60, 20);
    figure_line(&figure, pen, 2, 10, 56, 10);
    figure_write_svg(&figure, file);
    rewind(file);
    size = fread(text, 1, sizeof text - 1, file);
    text[size] = '\0';
    CHECK(strstr(text, "stroke-dasharray=\"4 3\"") != NULL, "%s", text);
    fclose(file);
    figure_free(&figure);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("tools/test_figure", argc, argv);
    RUN(a_line_is_dashed_from_its_beginning);
    RUN(dashes_go_on_around_corners);
    RUN(a_path_without_dashes_has_no_gap);
    RUN(the_svg_has_the_same_dashes);
    return TEST_END();
}
