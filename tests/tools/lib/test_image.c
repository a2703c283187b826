/* test_image.c - pictures and sum files: round trips, and any damage */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/ql_crc.h"
#include "lib/image/deflate.h"
#include "lib/render/develop.h"

static int failures;

static void check(bool ok, const char *claim)
{
    printf("%-20s %-52s %s\n", "tools/test_image", claim, ok ? "ok" : "FAIL");
    failures += !ok;
}

static uint32_t noise(void)
{
    static uint32_t state = 1;

    state = state * 1664525u + 1013904223u;
    return state >> 8;
}

/* ---- Files in memory --------------------------------------------------- */

typedef struct {
    uint8_t *data;
    size_t size;
} file_t;

static file_t slurp(FILE *file)
{
    file_t f;

    fflush(file);
    f.size = (size_t)ftell(file);
    f.data = cli_alloc(f.size, 1);
    rewind(file);
    f.size = fread(f.data, 1, f.size, file);
    fclose(file);
    return f;
}

static file_t encode_image(const image_t *image, image_kind_t kind)
{
    cli_out_t out = {tmpfile(), "", NULL, NULL};

    image_write(image, kind, &out);
    return slurp(out.file);
}

static file_t encode_sums(sums_t *sums)
{
    cli_out_t out = {tmpfile(), "", NULL, NULL};

    sums_write(sums, &out);
    return slurp(out.file);
}

/* ---- Round trips ------------------------------------------------------- */

static bool same_image(const image_t *a, const image_t *b)
{
    const size_t n = 3 * (size_t)a->width * a->height;

    return a->width == b->width && a->height == b->height &&
           (a->floats != NULL) == (b->floats != NULL) &&
           (a->floats != NULL ? memcmp(a->floats, b->floats, 4 * n) == 0
                              : memcmp(a->bytes, b->bytes, n) == 0);
}

/* Flat, smooth, repeating and noisy pictures: each way of packing. */
static uint8_t pattern(unsigned kind, unsigned x, unsigned y, unsigned c)
{
    switch (kind) {
    case 0:
        return 7;
    case 1:
        return (uint8_t)(x + 2 * y + 3 * c);
    case 2:
        return (uint8_t)(x % 5 * 50 + y % 3);
    default:
        return (uint8_t)noise();
    }
}

static bool returns(image_t *image, image_kind_t kind)
{
    const file_t file = encode_image(image, kind);
    image_t back;
    size_t where;
    const bool ok = image_decode(&back, file.data, file.size, &where) == NULL &&
                    same_image(image, &back);

    image_free(&back);
    free(file.data);
    return ok;
}

static void test_round_trips(void)
{
    static const uint16_t sizes[][2] = {
            {1, 1}, {1, 7}, {9, 1}, {5, 3}, {160, 144}, {257, 31}};
    bool ppm = true, png = true, pfm = true;

    for (unsigned s = 0; s < 6; s++) {
        for (unsigned kind = 0; kind < 4; kind++) {
            image_t i, f;
            image_new_bytes(&i, sizes[s][0], sizes[s][1]);
            image_new_floats(&f, sizes[s][0], sizes[s][1]);
            for (unsigned at = 0; at < 3u * i.width * i.height; at++) {
                i.bytes[at] = pattern(
                        kind, at / 3 % i.width, at / 3 / i.width, at % 3);
                f.floats[at] = ldexpf(i.bytes[at], (int)(noise() % 200) - 100);
            }
            ppm = ppm && returns(&i, IMAGE_PPM);
            png = png && returns(&i, IMAGE_PNG);
            pfm = pfm && returns(&f, IMAGE_PFM);
            image_free(&i);
            image_free(&f);
        }
    }
    check(ppm, "ppm_returns_every_byte");
    check(png, "png_returns_every_byte");
    check(pfm, "pfm_returns_every_bit");
}

/* Written by zlib: five row filters in turn, dynamic codes, two IDAT chunks. */
static const uint8_t foreign_png[] = {137, 80, 78, 71, 13, 10, 26, 10, 0, 0, 0,
        13, 73, 72, 68, 82, 0, 0, 0, 24, 0, 0, 0, 10, 8, 2, 0, 0, 0, 33, 11, 9,
        63, 0, 0, 0, 50, 73, 68, 65, 84, 120, 218, 149, 145, 193, 75, 20, 113,
        20, 199, 223, 111, 223, 174, 227, 236, 184, 59, 235, 174, 235, 38, 226,
        207, 196, 196, 68, 6, 138, 174, 239, 224, 161, 227, 66, 69, 116, 104,
        47, 22, 72, 48, 83, 116, 17, 226, 55, 7, 47, 94, 211, 226, 133, 150, 0,
        0, 1, 227, 73, 68, 65, 84, 252, 5, 29, 92, 138, 65, 8, 210, 139, 66, 94,
        36, 152, 67, 82, 116, 41, 194, 14, 117, 233, 47, 104, 232, 15, 104, 27,
        117, 156, 129, 153, 95, 182, 110, 145, 135, 130, 46, 143, 239, 251, 188,
        239, 233, 125, 0, 96, 143, 241, 183, 121, 241, 70, 167, 221, 10, 249,
        35, 98, 231, 28, 223, 190, 8, 155, 115, 124, 227, 154, 120, 186, 64,
        158, 75, 237, 85, 241, 232, 57, 95, 121, 7, 203, 95, 248, 18, 8, 49, 65,
        139, 151, 233, 190, 45, 236, 85, 190, 176, 11, 243, 95, 121, 107, 80,
        220, 96, 216, 250, 192, 120, 140, 50, 45, 120, 177, 6, 169, 238, 196,
        134, 72, 75, 65, 108, 242, 116, 80, 198, 53, 47, 173, 67, 220, 112, 210,
        17, 17, 143, 6, 233, 24, 143, 199, 101, 58, 225, 197, 147, 144, 78, 57,
        241, 180, 72, 103, 130, 120, 150, 167, 150, 140, 115, 72, 12, 73, 33,
        165, 232, 32, 58, 191, 50, 97, 143, 59, 93, 78, 167, 185, 211, 229, 116,
        154, 247, 217, 119, 114, 205, 228, 120, 207, 119, 178, 130, 169, 250,
        172, 68, 115, 85, 191, 157, 233, 77, 85, 164, 196, 232, 168, 1, 51, 43,
        89, 170, 236, 38, 166, 173, 42, 205, 172, 77, 170, 218, 73, 106, 166,
        26, 178, 178, 186, 171, 134, 237, 164, 209, 84, 107, 148, 229, 17, 24,
        3, 13, 33, 68, 64, 132, 67, 4, 133, 80, 64, 56, 234, 174, 255, 193, 193,
        244, 62, 86, 252, 247, 53, 122, 117, 6, 94, 143, 195, 139, 243, 180,
        125, 201, 223, 153, 243, 54, 174, 248, 155, 183, 232, 217, 34, 60, 150,
        240, 100, 157, 30, 190, 244, 151, 63, 123, 43, 223, 124, 97, 210, 210,
        5, 120, 112, 29, 238, 10, 186, 183, 238, 223, 222, 243, 90, 161, 63,
        127, 150, 174, 178, 106, 235, 19, 227, 17, 202, 176, 224, 105, 26, 132,
        186, 19, 25, 2, 75, 65, 100, 114, 28, 148, 81, 205, 11, 235, 160, 53,
        156, 112, 68, 68, 163, 1, 142, 241, 104, 92, 226, 132, 23, 77, 66, 56,
        229, 104, 211, 34, 156, 9, 162, 89, 142, 150, 140, 114, 184, 197, 112,
        75, 161, 232, 206, 227, 44, 84, 143, 252, 153, 127, 95, 255, 209, 44,
        183, 110, 230, 72, 71, 185, 159, 23, 81, 193, 42, 246, 185, 7, 154, 125,
        212, 207, 13, 157, 178, 162, 236, 24, 98, 96, 192, 82, 37, 247, 123,
        217, 46, 153, 28, 42, 20, 182, 229, 97, 85, 232, 53, 107, 127, 200, 141,
        234, 118, 113, 152, 31, 52, 232, 104, 77, 26, 249, 99, 133, 140, 171,
        158, 84, 56, 209, 201, 48, 80, 200, 79, 244, 179, 159, 239, 60, 209, 28,
        48, 252, 123, 243, 7, 212, 30, 1, 1, 80, 66, 12, 97, 0, 0, 0, 0, 73, 69,
        78, 68, 174, 66, 96, 130};

static void test_foreign_png(void)
{
    image_t image;
    size_t where;
    bool ok = image_decode(&image, foreign_png, sizeof foreign_png, &where) ==
                      NULL &&
              image.width == 24 && image.height == 10;

    for (unsigned y = 0; ok && y < 10; y++) {
        for (unsigned x = 0; x < 24; x++) {
            const uint8_t *p = image.bytes + 3 * (24 * y + x);
            ok = ok && p[0] == (uint8_t)(x * x + 3 * y) &&
                 p[1] == (x * x + 3 * y * y) % 7 * 30 &&
                 p[2] == (uint8_t)((200 - x * 5) ^ y);
        }
    }
    check(ok, "a_png_of_another_writer_is_read");
    image_free(&image);
}

/* ---- Headers that lie -------------------------------------------------- */

static bool refused(const char *text, size_t where_wanted)
{
    image_t image;
    size_t where;
    const char *error =
            image_decode(&image, (const uint8_t *)text, strlen(text), &where);

    image_free(&image);
    return error != NULL && where == where_wanted;
}

static void test_headers(void)
{
    check(refused("", 0) && refused("GIF89a", 0), "other_files_are_refused");
    check(refused("P6 0 5 255\n", 3) && refused("P6 -3 5 255\n", 3) &&
                    refused("P6 70000 5 255\n", 3) && refused("P6 5\n", 5) &&
                    refused("P6 99999999999999999999 5 255\n", 3) &&
                    refused("PF\n8 0\n-1.0\n", 5),
            "impossible_sizes_are_refused_where_they_stand");
    check(refused("P6 65535 65535 255\n", 14) && refused("P6 9 9 255\nabc", 11),
            "a_size_that_the_file_cannot_hold_is_refused");
    check(refused("P6 1 1 65535\nabcdef", 7) && refused("PF 1 1 x\n", 7) &&
                    refused("PF 1 1 -1.0", 7),
            "other_depths_and_scales_are_refused");
    check(refused("P6 1 1 255\nabcdef", 11), "bytes_after_the_pixels_are_too");
}

/* ---- Damage ------------------------------------------------------------ */

typedef const char *decode_t(const uint8_t *data, size_t size);

static const char *decode_image(const uint8_t *data, size_t size)
{
    image_t image;
    size_t where;
    const char *error = image_decode(&image, data, size, &where);

    image_free(&image);
    return where <= size ? error : "outside";
}

static const char *decode_sums(const uint8_t *data, size_t size)
{
    sums_t sums;
    size_t where;
    const char *error = sums_decode(&sums, data, size, &where);

    sums_free(&sums);
    return where <= size ? error : "outside";
}

/* Memory of exactly the right size, so that a sanitizer sees each overrun. */
static bool decodes(decode_t *decode, const uint8_t *data, size_t size)
{
    uint8_t *copy = cli_alloc(size, 1);
    bool ok;

    memcpy(copy, data, size);
    ok = decode(copy, size) == NULL;
    free(copy);
    return ok;
}

/* Checksums guard PNG and sum files; damage shall also reach what is behind
 * them. Recompute the CRC of each chunk, or of the sum file. */
static void repair(uint8_t *data, size_t size)
{
    uint32_t crc;

    if (size > 8 && memcmp(data, "QLS3", 4) == 0) {
        crc = ql_crc32(0, data, size - 4);
        for (unsigned i = 0; i < 4; i++) {
            data[size - 4 + i] = (uint8_t)(crc >> 8 * i);
        }
    }
    for (size_t at = 8; data[0] == 0x89 && size - at >= 12;) {
        const size_t n = (size_t)data[at + 2] << 8 | data[at + 3];
        if (n > size - at - 12) {
            break;
        }
        crc = ql_crc32(0, data + at + 4, n + 4);
        for (unsigned i = 0; i < 4; i++) {
            data[at + 8 + n + i] = (uint8_t)(crc >> (24 - 8 * i));
        }
        at += n + 12;
    }
}

/* True if the file is refused at every shorter length, and survived with every
 * byte changed in several ways. */
static bool survives_damage(decode_t *decode, const file_t *file)
{
    static const uint8_t flips[] = {0x01, 0x80, 0xff, 0x10};
    uint8_t *data = cli_alloc(file->size, 1);
    bool ok = decodes(decode, file->data, file->size);

    for (size_t n = 0; n < file->size; n++) {
        ok = ok && !decodes(decode, file->data, n);
    }
    for (size_t i = 0; i < 4 * file->size; i++) {
        memcpy(data, file->data, file->size);
        data[i / 4] ^= flips[i % 4];
        decodes(decode, data, file->size);
        repair(data, file->size);
        decodes(decode, data, file->size);
    }
    free(data);
    return ok;
}

static void fill_sums(sums_t *sums)
{
    static const sums_range_t ranges[] = {
            {0, 3, 0, 8}, {3, 5, 4, 6}, {3, 5, 8, 9}, {6, 7, 0, 1u << 24}};
    uint32_t clash[2];

    memset(sums, 0, sizeof *sums);
    sums->field[SUMS_WIDTH] = 4;
    sums->field[SUMS_HEIGHT] = 7;
    sums->field[SUMS_DIR_BITS] = 22;
    sums->field[SUMS_LIGHT_SAMPLES] = 1;
    sums->field[SUMS_TABLE_BITS] = 7;
    sums->field[SUMS_RADIANCE_EXP] = 0xfffffffdu;
    sums_new(sums, 0, 7);
    for (unsigned i = 0; i < 4; i++) {
        ranges_add(&sums->ranges, ranges + i);
    }
    (void)sums_settle(sums, clash);
    for (unsigned i = 0; i < 84; i++) {
        const bool empty = sums_row_count(sums, i / 12) == 0;
        sums->pixels[i / 3].rgb[i % 3] =
                empty ? 0 : (uint64_t)noise() << noise() % 40;
    }
}

static void test_damage(void)
{
    static const char *const claims[] = {"damaged_ppm_is_survived",
            "damaged_pfm_is_survived", "damaged_png_is_survived"};
    const file_t foreign = {(uint8_t *)(size_t)foreign_png, sizeof foreign_png};
    image_t image;
    sums_t sums;
    file_t file;

    for (unsigned kind = 0; kind < 3; kind++) {
        if (kind == IMAGE_PFM) {
            image_new_floats(&image, 6, 5);
        } else {
            image_new_bytes(&image, 6, 5);
        }
        for (unsigned i = 0; i < 90 && kind != IMAGE_PFM; i++) {
            image.bytes[i] = pattern(1, i, 0, 0);
        }
        file = encode_image(&image, (image_kind_t)kind);
        check(survives_damage(decode_image, &file), claims[kind]);
        free(file.data);
        image_free(&image);
    }
    check(survives_damage(decode_image, &foreign),
            "damaged_dynamic_codes_are_survived");
    fill_sums(&sums);
    file = encode_sums(&sums);
    check(survives_damage(decode_sums, &file), "damaged_sums_are_survived");
    free(file.data);
    sums_free(&sums);
}

/* ---- Sums -------------------------------------------------------------- */

static void test_sums(void)
{
    sums_t sums, back;
    size_t where;
    file_t file;
    bool ok;

    fill_sums(&sums);
    file = encode_sums(&sums);
    ok = sums_decode(&back, file.data, file.size, &where) == NULL &&
         sums_compare(&sums, &back) == SUMS_FIELD_COUNT &&
         sums_field_value(&back, SUMS_RADIANCE_EXP) == -3 &&
         memcmp(sums.pixels, back.pixels, 28 * sizeof(ql_sum_t)) == 0;
    check(ok, "sums_return_every_bit");
    free(file.data);
    sums_free(&sums);
    sums_free(&back);
}

/* The nearest float of a mean: neither neighbour is nearer. */
static bool nearest(float f, uint64_t sum, uint32_t count, int exponent)
{
    const long double want = ldexpl((long double)sum, exponent);
    const long double error = fabsl((long double)f * count - want);
    const float up = nextafterf(f, INFINITY), down = nextafterf(f, 0);

    return error <= fabsl((long double)up * count - want) &&
           error <= fabsl((long double)down * count - want);
}

/* sum / count in the units of Ke, with a radiance exponent of exponent. */
static float linear_of_unit(uint64_t sum, uint32_t count, int32_t exponent)
{
    const sums_range_t range = {0, 1, 0, count};
    image_t line;
    sums_t sums;
    const develop_t linear = {.kind = IMAGE_PFM};
    float value;

    memset(&sums, 0, sizeof sums);
    sums.field[SUMS_WIDTH] = sums.field[SUMS_HEIGHT] = 1;
    sums.field[SUMS_RADIANCE_EXP] = (uint32_t)exponent;
    sums_new(&sums, 0, 1);
    sums_settle_one(&sums, &range);
    sums.pixels[0].rgb[0] = sum;
    image_new_floats(&line, 1, 1);
    develop_row(&line, &sums, sums.pixels, 0, &linear);
    value = line.floats[0];
    image_free(&line);
    sums_free(&sums);
    return value;
}

/* The same where one unit of the sum is 1. */
static float linear_of(uint64_t sum, uint32_t count)
{
    return linear_of_unit(sum, count, QL_SUM_BITS);
}

static void test_linear(void)
{
    bool ok = true;

    for (unsigned i = 0; i < 20000 && ok; i++) {
        const uint32_t count =
                i % 2 == 0 ? 1u << i % 25 : 1 + noise() % (1u << 24);
        const int32_t exponent = (int32_t)(i % 129) - 64;
        uint64_t sum =
                (uint64_t)noise() << 40 ^ (uint64_t)noise() << 20 ^ noise();
        float value;
        sum >>= noise() % 64;
        value = linear_of_unit(sum, count, exponent);
        ok = sum == 0 ? value == 0
                      : nearest(value, sum, count, exponent - QL_SUM_BITS);
    }
    check(ok, "linear_values_are_the_nearest_floats");
    check(linear_of(16777217, 1) == 16777216.0f &&
                    linear_of(16777219, 1) == 16777220.0f &&
                    linear_of(33554434, 2) == 16777216.0f &&
                    linear_of(0xffffffffffffffffu, 1) ==
                            18446744073709551616.0f,
            "linear_ties_go_to_even");
}

int main(void)
{
    cli_begin("test_image");
    test_round_trips();
    test_foreign_png();
    test_headers();
    test_damage();
    test_sums();
    test_linear();
    return failures != 0;
}
