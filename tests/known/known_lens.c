/* known_lens.c - depth of field: sharp at the focus, else a known disk */
/* SPDX-License-Identifier: MIT */

/* A lens of radius R at focus f images a point at depth z as a disk of radius
 * R |1/z - 1/f|, measured where the picture is 1 deep. A small square that
 * shines is looked at, so what pixels hold is that disk, widened by the square
 * and by the pixels. */

#include <math.h>
#include <stdlib.h>

#include "support/picture/estimate.h"
#include "support/ql_test.h"
#include "qlux.h"

#define RADIANCE 0.5

enum { PIXELS = 32, SAMPLES = 4096, DEPTH = 8000 };

static mini_scene_t m;

/* The picture spans so much at depth 1; its pixels, grid units at DEPTH. */
#define SPAN  0.25
#define PIXEL (SPAN * DEPTH / PIXELS)

static const double eye[3] = {16384, 16384, 1024};

/* Looking along +z, x to the right, y up; one unit of direction is 1/2 deep. */
static void begin_picture(void)
{
    static const double right[3] = {SPAN / 4, 0, 0}, up[3] = {0, SPAN / 4, 0};

    mini_begin(&m);
    mini_eye(&m, eye[0], eye[1], eye[2]);
    mini_look(&m, 0, 0, 0.5);
    mini_field(&m, right, up);
    m.width = m.height = PIXELS;
}

/* A lens, radius in grid units; the picture is sharp at a distance focus. */
static void add_lens(double radius, double focus)
{
    const double p[2][3] = {{radius, 0, 0}, {0, radius, 0}};
    const double d[2][3] = {
            {-radius / focus / 2, 0, 0}, {0, -radius / focus / 2, 0}};

    mini_lens(&m, p, d);
}

/* A square at DEPTH in the middle of a pixel, so many pixels wide. */
static void add_square(int x, int y, double width)
{
    const double middle[2] = {eye[0] + (x + 0.5 - PIXELS / 2) * PIXEL,
            eye[1] - (y + 0.5 - PIXELS / 2) * PIXEL};
    const double half = width * PIXEL / 2;
    const int32_t z = (int32_t)eye[2] + DEPTH;
    int32_t c[4][3];

    for (int i = 0; i < 4; i++) {
        c[i][0] =
                (int32_t)lround(middle[0] + (i == 1 || i == 2 ? half : -half));
        c[i][1] = (int32_t)lround(middle[1] + (i >= 2 ? half : -half));
        c[i][2] = z;
    }
    /* the front towards -z */
    mini_quad(&m, c[0], c[3], c[2], c[1], mini_material(&m, 0, RADIANCE));
}

/* ---- Pictures ------------------------------------------------------------ */

/* Means of all pixels; sums too, for equality. */
typedef struct {
    double value[PIXELS][PIXELS];
    ql_sum_t sum[PIXELS][PIXELS];
} picture_t;

static void take(picture_t *picture, uint32_t samples)
{
    const ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 1, 51);
    static const ql_sum_t zero;
    ql_scene_t scene;
    ql_render_t render;

    mini_open(&m, &scene);
    CHECK(ql_render_init(&render, &scene, &s) == QL_OK, "settings");
    for (int i = 0; i < PIXELS * PIXELS; i++) {
        const int x = i % PIXELS, y = i / PIXELS;

        picture->sum[y][x] = zero;
        ql_render_pixel(&render, (uint16_t)x, (uint16_t)y, 0, samples,
                &picture->sum[y][x]);
        picture->value[y][x] =
                ldexp((double)picture->sum[y][x].rgb[0], -QL_SUM_BITS) /
                samples;
    }
}

/* Of the light in a picture: all of it in pixels that shine RADIANCE, where its
 * middle is, its mean square distance from a point, pixels. */
typedef struct {
    double total, x, y, square, farthest;
    double hits; /* samples */
} spread_t;

static spread_t spread_of(const picture_t *picture, int x, int y)
{
    spread_t s = {0, 0, 0, 0, 0, 0};

    for (int i = 0; i < PIXELS * PIXELS; i++) {
        const double dx = i % PIXELS - x, dy = i / PIXELS - y;
        const double part = picture->value[i / PIXELS][i % PIXELS] / RADIANCE;

        s.total += part;
        s.x += part * dx;
        s.y += part * dy;
        s.square += part * (dx * dx + dy * dy);
        if (part > 0) {
            s.farthest = fmax(s.farthest, sqrt(dx * dx + dy * dy));
        }
    }
    s.hits = s.total * SAMPLES;
    s.x /= s.total;
    s.y /= s.total;
    s.square /= s.total;
    return s;
}

/* ---- In focus ------------------------------------------------------------ */

enum { LENS = 500 };

TEST(square_in_focus_stays_within_its_pixel)
{
    static const int at[][2] = {{16, 16}, {3, 5}, {28, 20}, {10, 30}};
    static picture_t picture;

    for (int i = 0; i < 4; i++) {
        spread_t s;

        begin_picture();
        add_square(at[i][0], at[i][1], 0.75);
        add_lens(LENS, DEPTH);
        take(&picture, SAMPLES / 8);
        s = spread_of(&picture, at[i][0], at[i][1]);
        CHECK(s.farthest == 0 && s.total > 0.4,
                "pixel %d %d: light up to %.1f pixels away, %.3f in all",
                at[i][0], at[i][1], s.farthest, s.total);
    }
    NOTE("4 pixels, a lens %d wide at a depth of %d", 2 * LENS, DEPTH);
}

/* ---- Out of focus -------------------------------------------------------- */

static const struct {
    double radius, focus;
} lenses[] = {
        {500, DEPTH * 2}, {300, DEPTH / 2}, {1000, DEPTH * 1.4}, {350, 1e9}};
enum { LENSES = sizeof lenses / sizeof *lenses };

/* Radius of the disk, pixels. */
static double blur_of(int i)
{
    return lenses[i].radius * fabs(1.0 / DEPTH - 1 / lenses[i].focus) * DEPTH /
           PIXEL;
}

/* A uniform disk has half of its square radius as mean square, a unit square a
 * sixth: once of the emitter, once of the pixels. Over the disk a square's
 * fourth moment is a third of r^4, its standard deviation r^2 / sqrt(12). */
static double blur_off(const spread_t *s, double blur, double width)
{
    const double want = blur * blur / 2 + (width * width + 1) / 6;

    return (s->square - want) / (blur * blur / sqrt(12 * s->hits));
}

TEST(square_out_of_focus_spreads_to_the_circle_of_confusion)
{
    static picture_t picture;
    double worst = 0;

    for (int i = 0; i < LENSES; i++) {
        const double blur = blur_of(i), width = 1;
        spread_t s;
        double z;

        begin_picture();
        add_square(16, 16, width);
        add_lens(lenses[i].radius, lenses[i].focus);
        take(&picture, SAMPLES);
        s = spread_of(&picture, 16, 16);
        z = blur_off(&s, blur, width);
        CHECK(blur > 2.5 && blur < 14, "lens %d: blur of %.1f tells little", i,
                blur);
        CHECK(fabs(z) < STATS_Z_MANY,
                "lens %d: mean square %.3f, disk of %.3f, z %.1f", i, s.square,
                blur, z);
        CHECK(hypot(s.x, s.y) < STATS_Z_MAX * blur / sqrt(2 * s.hits),
                "lens %d: the middle is off by %.3f %.3f", i, s.x, s.y);
        /* the corner of the square, of a pixel */
        CHECK(s.farthest > blur * 0.8 && s.farthest < blur + sqrt(2.0),
                "lens %d: light up to %.2f pixels, disk of %.2f", i, s.farthest,
                blur);
        /* a disk a tenth larger or smaller, none at all */
        CHECK(fabs(blur_off(&s, 1.1 * blur, width)) > STATS_Z_MAX &&
                        fabs(blur_off(&s, 0.9 * blur, width)) > STATS_Z_MAX &&
                        fabs(blur_off(&s, 0.01, width)) > STATS_Z_MAX,
                "lens %d: another disk passes", i);
        worst = fmax(worst, fabs(z));
    }
    NOTE("%d lenses, worst z %.1f", LENSES, worst);
}

/* Of light in a ring of the disk there is as much as the ring has area. */
TEST(circle_of_confusion_is_evenly_lit)
{
    static picture_t picture;
    const double blur = blur_of(2);
    double inner = 0, all = 0, pixels = 0, z;

    begin_picture();
    add_square(16, 16, 1);
    add_lens(lenses[2].radius, lenses[2].focus);
    take(&picture, SAMPLES);
    for (int i = 0; i < PIXELS * PIXELS; i++) {
        const double dx = i % PIXELS - 16, dy = i / PIXELS - 16;
        const double part = picture.value[i / PIXELS][i % PIXELS] / RADIANCE;

        all += part;
        if (sqrt(dx * dx + dy * dy) < blur / 2) {
            inner += part;
            pixels++;
        }
    }
    z = (inner - all * pixels / (3.14159265358979 * blur * blur)) * SAMPLES /
        sqrt(inner * SAMPLES);
    CHECK(fabs(z) < STATS_Z_MAX && pixels > 9, "inner part %.4f, area %.4f",
            inner / all, pixels / (3.14159265358979 * blur * blur));
    NOTE("inner quarter holds %.4f, z %.1f", inner / all, z);
}

/* The square covers as much of the picture as its own pixels, in and out of
 * focus: hits are a binomial of that share of all samples. */
TEST(lens_conserves_the_light_of_the_picture)
{
    static picture_t picture;
    double worst = 0;

    for (int i = -1; i < LENSES; i++) {
        const double side = (double)lround(PIXEL * 0.5) * 2 / PIXEL;
        spread_t s;
        double z;

        begin_picture();
        add_square(16, 16, side);
        add_lens(i < 0 ? LENS : lenses[i].radius,
                i < 0 ? DEPTH : lenses[i].focus);
        take(&picture, SAMPLES);
        s = spread_of(&picture, 16, 16);
        /* corners are rounded to the grid: each side by half a unit */
        z = (s.total - side * side) /
            (sqrt(side * side / SAMPLES) + 1 / PIXEL / STATS_Z_MAX);
        CHECK(fabs(z) < STATS_Z_MANY, "lens %d: %.4f pixels, want %.4f, z %.1f",
                i, s.total, side * side, z);
        worst = fmax(worst, fabs(z));
    }
    NOTE("worst z %.1f", worst);
}

/* ---- No lens ------------------------------------------------------------- */

static void add_room(void)
{
    static const int32_t low[3] = {9000, 9000, 500};
    static const int32_t high[3] = {23000, 23000, 14000};

    mini_room(&m, low, high, mini_material(&m, 0.7, 0));
    add_square(12, 9, 5);
    add_square(25, 27, 3);
}

TEST(lens_of_radius_zero_is_a_pinhole_bit_for_bit)
{
    static picture_t pinhole, lens, wide;

    begin_picture();
    add_room();
    take(&pinhole, 16);
    add_lens(0, 3000);
    take(&lens, 16);
    CHECK(memcmp(pinhole.sum, lens.sum, sizeof lens.sum) == 0,
            "pictures differ");
    add_lens(50, 3000);
    take(&wide, 16);
    CHECK(memcmp(pinhole.sum, wide.sum, sizeof wide.sum) != 0,
            "a lens of radius 50 changes nothing");
    NOTE("%d pixels, 16 samples each", PIXELS * PIXELS);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("known/lens", argc, argv);
    RUN(square_in_focus_stays_within_its_pixel);
    RUN(square_out_of_focus_spreads_to_the_circle_of_confusion);
    RUN(circle_of_confusion_is_evenly_lit);
    RUN(lens_conserves_the_light_of_the_picture);
    RUN(lens_of_radius_zero_is_a_pinhole_bit_for_bit);
    return TEST_END();
}
