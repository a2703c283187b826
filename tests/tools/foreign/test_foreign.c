/* test_foreign.c - pictures that other programs wrote, and odd headers */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/ql_crc.h"
#include "lib/image/image_file.h"
#include "lib/program/cli.h"
#include "lib/render/widen.h"
#include "support/ql_test.h"

#define FOLDER "tests/tools/foreign/"

/* ---- The picture of all files, as README.md has it ----------------------- */

static uint8_t gray_of(uint32_t x, uint32_t y)
{
    return (uint8_t)(x * x + 3 * y);
}

static uint8_t value_of(uint32_t x, uint32_t y, unsigned channel)
{
    return channel == 0   ? gray_of(x, y)
           : channel == 1 ? (uint8_t)((x * x + 3 * y * y) % 7 * 30)
                          : (uint8_t)(2000 - 70 * x + 13 * y * y);
}

/* Of a sample: is it as in the picture, where the file is gray or not? */
static bool is_right(const image_t *image, size_t i, bool gray)
{
    const uint32_t x = (uint32_t)(i / 3 % image->width);
    const uint32_t y = (uint32_t)(i / 3 / image->width);
    const uint8_t want =
            gray ? gray_of(x, y) : value_of(x, y, (unsigned)(i % 3));

    return image->floats != NULL
                   ? fabs((double)image->floats[i] - want / 255.0) < 1e-7
                   : image->bytes[i] == want;
}

static void check_picture(
        const image_t *image, uint32_t width, uint32_t height, const char *name)
{
    const bool gray = strncmp(name, "gray", 4) == 0;

    CHECK(image->width == width && image->height == height, "%s: %u x %u", name,
            (unsigned)image->width, (unsigned)image->height);
    for (size_t i = 0; i < 3 * (size_t)image->width * image->height; i++) {
        CHECK(is_right(image, i, gray), "%s: sample %zu", name, i);
    }
}

TEST(every_filter_and_kind_of_block_is_read)
{
    static const char *const names[] = {"rgb-sub.png", "rgb-up.png",
            "rgb-avg.png", "rgb-paeth.png", "rgb-stored.png", "rgb-mixed.png",
            "gray-sub.png", "gray-up.png", "gray-avg.png", "gray-paeth.png",
            "gray-stored.png", "comment.ppm"};

    for (unsigned i = 0; i < sizeof names / sizeof *names; i++) {
        char path[80];
        image_t image;

        snprintf(path, sizeof path, FOLDER "%s", names[i]);
        image_read(&image, path);
        check_picture(&image, 24, 12, names[i]);
        image_free(&image);
    }
}

TEST(floats_of_either_order_are_read_from_below)
{
    static const char *const names[] = {"big.pfm", "little.pfm", "gray.pfm"};

    for (unsigned i = 0; i < 3; i++) {
        char path[80];
        image_t image;

        snprintf(path, sizeof path, FOLDER "%s", names[i]);
        image_read(&image, path);
        CHECK(image.floats != NULL, "%s: no floats", names[i]);
        check_picture(&image, 8, 4, names[i]);
        image_free(&image);
    }
}

/* ---- PNG: what is not read, and any damage ------------------------------ */

/* The CRC of the chunk at this byte, of n bytes of data. */
static void repair(uint8_t *data, size_t at, size_t n)
{
    const uint32_t crc = ql_crc32(0, data + at + 4, n + 4);

    for (unsigned i = 0; i < 4; i++) {
        data[at + 8 + n + i] = (uint8_t)(crc >> (24 - 8 * i));
    }
}

/* IHDR: 8 bytes of sides, depth, colours, and three kinds of method. */
TEST(kinds_of_png_that_are_not_read_say_so)
{
    static const uint8_t depths[] = {1, 2, 4, 8, 16};
    static const uint8_t colours[] = {0, 2, 3, 4, 6};
    size_t size, where;
    uint8_t *data = cli_read(FOLDER "rgb-paeth.png", &size);
    uint8_t *head = data + 8 + 8;

    for (unsigned i = 0; i < 50; i++) {
        const bool read = depths[i % 5] == 8 && i / 5 % 5 < 2;
        const char *want = !read ? "expected 8 bits a channel, RGB or gray, no "
                                   "alpha or palette"
                           : i >= 25 ? "expected no interlacing"
                                     : NULL;
        image_t image;
        const char *error;

        head[8] = depths[i % 5];
        head[9] = colours[i / 5 % 5];
        head[12] = (uint8_t)(i / 25);
        repair(data, 8, 13);
        error = image_decode(&image, data, size, &where);
        image_free(&image);
        CHECK(want == NULL || (error != NULL && strcmp(error, want) == 0 &&
                                      where == 8),
                "depth %u, colours %u: %s", head[8], head[9], error);
    }
    free(data);
}

/* As it is, a PNG is refused with any bit of it turned. With the chunk's CRC
 * made right again it is refused, or is the same picture: of the stream's last
 * byte some bits say nothing. */
TEST(no_turned_bit_of_a_png_changes_the_picture)
{
    size_t size, where;
    uint8_t *data = cli_read(FOLDER "rgb-paeth.png", &size);
    unsigned kept = 0;

    for (size_t bit = 0; bit < 8 * size; bit++) {
        image_t image;

        data[bit / 8] ^= (uint8_t)(1u << bit % 8);
        CHECK(image_decode(&image, data, size, &where) != NULL, "bit %zu", bit);
        image_free(&image);
        data[bit / 8] ^= (uint8_t)(1u << bit % 8);
    }
    for (size_t at = 8; at < size;) {
        const size_t n = (size_t)data[at + 2] << 8 | data[at + 3];

        for (size_t bit = 8 * (at + 4); bit < 8 * (at + 8 + n); bit++) {
            image_t image;

            data[bit / 8] ^= (uint8_t)(1u << bit % 8);
            repair(data, at, n);
            if (image_decode(&image, data, size, &where) == NULL) {
                check_picture(&image, 24, 12, "rgb-paeth.png");
                kept++;
            }
            image_free(&image);
            data[bit / 8] ^= (uint8_t)(1u << bit % 8);
        }
        repair(data, at, n);
        at += n + 12;
    }
    NOTE("%u of %zu bits say nothing", kept, 8 * size);
    CHECK(kept == 7, "%u bits say nothing", kept);
    free(data);
}

/* ---- PPM and PFM: headers in all their forms ---------------------------- */

static const char *decode(image_t *image, const char *text, size_t size)
{
    size_t where;

    return image_decode(image, (const uint8_t *)text, size, &where);
}

TEST(white_space_and_comments_may_stand_anywhere_in_a_header)
{
    static const char *const heads[] = {"P6\n2 1\n255\n", "P6 2 1 255 ",
            "P6\t2\v1\f255\r", "P6\r\n2\r\n1\r\n255\n",
            "P6#one\n2#\n1 # three 9 9\n#\n255\n", "P6\n# a\r2 1\r# b\r255\r",
            "P6\n\n \t2 1\n\n255 ", "P6 002 01 0255\n"};

    for (unsigned i = 0; i < sizeof heads / sizeof *heads; i++) {
        char text[80];
        image_t image;
        const int n = snprintf(text, sizeof text, "%s#1 2\n3", heads[i]);
        const char *error = decode(&image, text, (size_t)n);

        CHECK(error == NULL && image.width == 2 && image.height == 1 &&
                        memcmp(image.bytes, "#1 2\n3", 6) == 0,
                "header %u: %s", i, error);
        image_free(&image);
    }
}

TEST(a_maximum_other_than_255_is_refused)
{
    static const char *const heads[] = {"P6 1 1 0\n", "P6 1 1 1\n",
            "P6 1 1 31\n", "P6 1 1 254\n", "P6 1 1 256\n", "P6 1 1 2550\n",
            "P6 1 1 65535\n", "P6 1 1 -255\n", "P6 1 1 x\n", "P6 1 1 # 255\n"};

    for (unsigned i = 0; i < sizeof heads / sizeof *heads; i++) {
        char text[80];
        image_t image;
        const int n = snprintf(text, sizeof text, "%sabc", heads[i]);
        const char *error = decode(&image, text, (size_t)n);

        CHECK(error != NULL && strcmp(error, "expected a maximum of 255") == 0,
                "header %u: %s", i, error);
        image_free(&image);
    }
}

/* The sign of the scale is the byte order; of a PFM nothing else counts. */
TEST(scales_of_pfm_are_read)
{
    static const char *const scales[] = {
            "-1", "-1.0", "-2.5e-3", "-.5", "1", "1.0", "+1.0", "4E+1"};

    for (unsigned i = 0; i < 8; i++) {
        char text[80];
        image_t image;
        const int n = snprintf(
                text, sizeof text, "Pf\n# one\n1 1 # two\n%s\n", scales[i]);
        const char *error;

        memcpy(text + n, i < 4 ? "\0\0\300\100" : "\100\300\0\0", 4);
        error = decode(&image, text, (size_t)n + 4);
        CHECK(error == NULL && image.floats[0] == 6 && image.floats[2] == 6,
                "%s: %s", scales[i], error);
        image_free(&image);
    }
}

/* ---- The display's pixels ------------------------------------------------ */

/* The high bits again below, as often as fits: 0 and all ones stay so. */
static unsigned repeat_bits(unsigned value, unsigned bits)
{
    const unsigned twice = value << bits | value;

    return twice >> (2 * bits - 8);
}

TEST(every_pixel_of_16_bits_is_widened)
{
    for (unsigned v = 0; v < 65536; v++) {
        const uint8_t little[2] = {(uint8_t)v, (uint8_t)(v >> 8)};
        const uint8_t big[2] = {(uint8_t)(v >> 8), (uint8_t)v};
        const uint8_t want[3] = {(uint8_t)repeat_bits(v / 2048, 5),
                (uint8_t)repeat_bits(v / 32 % 64, 6),
                (uint8_t)repeat_bits(v % 32, 5)};
        uint8_t a[3], b[3];

        widen_line(a, little, QL_FORMAT_RGB565_LE, 1);
        widen_line(b, big, QL_FORMAT_RGB565_BE, 1);
        CHECK(memcmp(a, want, 3) == 0 && memcmp(b, want, 3) == 0,
                "%04x: %02x%02x%02x", v, a[0], a[1], a[2]);
    }
}

TEST(every_gray_is_widened)
{
    for (unsigned v = 0; v < 256; v++) {
        const uint8_t pixel[2] = {(uint8_t)v, (uint8_t)~v};
        uint8_t eight[6], four[9];

        widen_line(eight, pixel, QL_FORMAT_GRAY8, 2);
        widen_line(four, pixel, QL_FORMAT_GRAY4, 3);
        for (unsigned c = 0; c < 3; c++) {
            CHECK(eight[c] == v && eight[3 + c] == 255 - v, "8 bits: %u", v);
            CHECK(four[c] == v / 16 * 17 && four[3 + c] == v % 16 * 17 &&
                            four[6 + c] == (255 - v) / 16 * 17,
                    "4 bits: %u", v);
        }
    }
}

int main(int argc, char **argv)
{
    cli_begin("test_foreign");
    TEST_BEGIN("tools/test_foreign", argc, argv);
    RUN(every_filter_and_kind_of_block_is_read);
    RUN(floats_of_either_order_are_read_from_below);
    RUN(kinds_of_png_that_are_not_read_say_so);
    RUN(no_turned_bit_of_a_png_changes_the_picture);
    RUN(white_space_and_comments_may_stand_anywhere_in_a_header);
    RUN(a_maximum_other_than_255_is_refused);
    RUN(scales_of_pfm_are_read);
    RUN(every_pixel_of_16_bits_is_widened);
    RUN(every_gray_is_widened);
    return TEST_END();
}
