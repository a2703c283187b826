/* diff_main.c - qlux-diff: two pictures to a few numbers and a picture */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "image.h"

static const char help[] =
        "qlux-diff: two pictures to a few numbers and a picture\n"
        "\n"
        "  qlux-diff A B [options]        B is the reference\n"
        "\n"
        "  --max-relmse X   exit 1 if relmse is above X\n"
        "  --max-bias X     exit 1 if |bias| is above X\n"
        "  -o FILE          the difference, .ppm or .png: red where A is\n"
        "                   larger, blue where smaller, white where equal;\n"
        "                   its scale below it\n"
        "\n"
        "Reads PPM, PNG (display values 0 to 255) and PFM (linear radiance).\n"
        "Prints, each mean over all pixels and channels:\n"
        "  identical  yes or no: every value has the same bits\n"
        "  rmse       sqrt(mean((a - b)^2))\n"
        "  relmse     mean((a - b)^2 / (b^2 + 0.01 mean(b)^2)); the relative\n"
        "             MSE of Rousselle, Knaus and Zwicker (2011), its epsilon\n"
        "             of 0.01 for a picture of mean 1\n"
        "  bias       (mean(a) - mean(b)) / mean(b)\n"
        "  psnr       20 log10(peak / rmse) dB; the peak is 255, or the\n"
        "             largest b of a PFM\n"
        "  max        largest |a - b|\n"
        "Exit: 0 done, 1 usage or above a limit, 2 sizes differ or bad\n"
        "picture, 3 cannot read or write\n"
        "\n"
        "Example:\n"
        "  qlux-diff box.pfm box-ref.pfm --max-relmse 1e-6 -o diff.png\n";

typedef struct {
    const char *path[2];
    const char *picture;
    double relmse_max;
    double bias_max;
} options_t;

typedef struct {
    bool identical;
    double rmse;
    double relmse;
    double bias;
    double psnr;
    double max;
} numbers_t;

static double take_limit(const char *option, const char *text)
{
    char *end = NULL;
    double value;

    if (text == NULL) {
        cli_fail(CLI_USAGE, "'%s' needs a value", option);
    }
    value = strtod(text, &end);
    if (end == text || *end != '\0' || !(value >= 0)) {
        cli_fail(CLI_USAGE, "'%s %s': expected a number, 0 or more", option,
                text);
    }
    return value;
}

static void parse(options_t *o, int argc, char **argv)
{
    int paths = 0;

    memset(o, 0, sizeof *o);
    o->relmse_max = o->bias_max = HUGE_VAL;
    for (int i = 1; i < argc; i++) {
        const char *a = argv[i];
        if (strcmp(a, "--help") == 0 || strcmp(a, "-h") == 0) {
            fputs(help, stdout);
            exit(CLI_DONE);
        } else if (strcmp(a, "-o") == 0) {
            o->picture = cli_text(a, argv[++i]);
        } else if (strcmp(a, "--max-relmse") == 0) {
            o->relmse_max = take_limit(a, argv[++i]);
        } else if (strcmp(a, "--max-bias") == 0) {
            o->bias_max = take_limit(a, argv[++i]);
        } else if (a[0] == '-' && a[1] != '\0') {
            cli_fail(CLI_USAGE, "unknown option '%s' (see --help)", a);
        } else if (paths < 2) {
            o->path[paths++] = a;
        } else {
            cli_fail(CLI_USAGE, "a third picture: '%s' (see --help)", a);
        }
    }
    if (paths < 2) {
        cli_fail(CLI_USAGE, "name two pictures (see --help)");
    }
    if (o->picture != NULL && image_kind("-o", o->picture) == IMAGE_PFM) {
        cli_fail(CLI_USAGE, "'-o %s': the difference is a .ppm or .png",
                o->picture);
    }
}

static double value_at(const image_t *image, size_t i)
{
    return image->floats != NULL ? (double)image->floats[i]
                                 : (double)image->bytes[i];
}

static size_t value_count(const image_t *image)
{
    return 3 * (size_t)image->width * image->height;
}

/* By bits: -0 is not 0, and a NaN may equal another. */
static bool same_bits(const image_t *a, const image_t *b)
{
    const size_t n = value_count(a);

    return a->floats != NULL ? memcmp(a->floats, b->floats, 4 * n) == 0
                             : memcmp(a->bytes, b->bytes, n) == 0;
}

/* A NaN anywhere makes the numbers NaN, which are above every limit. */
static void compare(numbers_t *out, const image_t *a, const image_t *b)
{
    const size_t n = value_count(a);
    double sum_a = 0, sum_b = 0, squares = 0, relative = 0, peak = 0;
    double epsilon;

    memset(out, 0, sizeof *out);
    for (size_t i = 0; i < n; i++) {
        sum_a += value_at(a, i);
        sum_b += value_at(b, i);
    }
    epsilon = 0.01 * (sum_b / (double)n) * (sum_b / (double)n);
    for (size_t i = 0; i < n; i++) {
        const double vb = value_at(b, i), d = value_at(a, i) - vb;
        const double scale = vb * vb + epsilon;
        squares += d * d;
        relative += d != 0 ? d * d / scale : 0; /* 0/0 is no difference */
        out->max = fabs(d) > out->max ? fabs(d) : out->max;
        peak = vb > peak ? vb : peak;
    }
    out->identical = same_bits(a, b);
    out->rmse = sqrt(squares / (double)n);
    out->relmse = relative / (double)n;
    out->bias = sum_a == sum_b ? 0 : (sum_a - sum_b) / sum_b;
    peak = a->floats != NULL ? peak : 255;
    out->psnr = out->rmse > 0 ? 20 * log10(peak / out->rmse) : HUGE_VAL;
}

/* ---- The picture of the difference ------------------------------------- */

enum { GLYPH_WIDTH = 3, GLYPH_HEIGHT = 5, BAR_HEIGHT = 6, MARGIN = 2 };

/* What a label needs of an alphabet: rows of three pixels from the top, the
 * highest of 15 bits first. */
static unsigned glyph(char c)
{
    static const char letters[] = "0123456789.-+e";
    static const unsigned rows[] = {075557, 026227, 071747, 071717, 055711,
            074717, 074757, 071222, 075757, 075717, 000002, 000700, 002720,
            075746};
    const char *at = c != '\0' ? strchr(letters, c) : NULL;

    return at != NULL ? rows[at - letters] : 0;
}

static void set_pixel(image_t *image, size_t x, size_t y, const uint8_t rgb[3])
{
    if (x < image->width && y < image->height) {
        memcpy(image->bytes + 3 * (x + (size_t)image->width * y), rgb, 3);
    }
}

static void draw_text(image_t *image, size_t x, size_t y, const char *text)
{
    static const uint8_t ink[3] = {0, 0, 0};

    for (; *text != '\0'; text++, x += GLYPH_WIDTH + 1) {
        const unsigned rows = glyph(*text);
        for (unsigned i = 0; i < GLYPH_WIDTH * GLYPH_HEIGHT; i++) {
            if (rows >> (GLYPH_WIDTH * GLYPH_HEIGHT - 1 - i) & 1u) {
                set_pixel(image, x + i % GLYPH_WIDTH, y + i / GLYPH_WIDTH, ink);
            }
        }
    }
}

/* -1 is blue, 0 white, 1 red; anything that is no number is black. */
static void colour(uint8_t rgb[3], double t)
{
    const double clamped = t > 1 ? 1 : t < -1 ? -1 : t;
    const uint8_t pale = (uint8_t)(255 * (1 - fabs(clamped)) + 0.5);

    if (!(t == t)) {
        rgb[0] = rgb[1] = rgb[2] = 0;
        return;
    }
    rgb[0] = t >= 0 ? 255 : pale;
    rgb[1] = pale;
    rgb[2] = t <= 0 ? 255 : pale;
}

/* a - b, mean of the channels. */
static double pixel_difference(const image_t *a, const image_t *b, size_t i)
{
    double d = 0;

    for (size_t c = 3 * i; c < 3 * i + 3; c++) {
        d += (value_at(a, c) - value_at(b, c)) / 3;
    }
    return d;
}

/* The bar below the picture, with its ends and middle named. */
static void draw_scale(image_t *image, size_t top, double scale)
{
    char label[32];
    uint8_t rgb[3];

    for (size_t x = 0; x < image->width; x++) {
        colour(rgb, 2 * (double)x / (image->width - 1.0) - 1);
        for (size_t y = 0; y < BAR_HEIGHT; y++) {
            set_pixel(image, x, top + y, rgb);
        }
    }
    top += BAR_HEIGHT + MARGIN;
    snprintf(label, sizeof label, "%.3g", -scale);
    draw_text(image, 1, top, label);
    draw_text(image, image->width / 2 - 1, top, "0");
    snprintf(label, sizeof label, "+%.3g", scale);
    draw_text(image, image->width - (GLYPH_WIDTH + 1) * strlen(label), top,
            label);
}

static void write_picture(const image_t *a, const image_t *b, const char *path)
{
    const uint32_t width_min = 20 * (GLYPH_WIDTH + 1); /* all the labels */
    const uint32_t width = a->width > width_min ? a->width : width_min;
    const uint32_t foot = 3 * MARGIN + BAR_HEIGHT + GLYPH_HEIGHT;
    image_t image;
    cli_out_t out;
    double scale = 0;

    image_new(&image, width, a->height + foot, false);
    memset(image.bytes, 255, value_count(&image));
    for (size_t i = 0; i < value_count(a) / 3; i++) {
        const double d = fabs(pixel_difference(a, b, i));
        scale = d > scale ? d : scale;
    }
    for (size_t i = 0; i < value_count(a) / 3; i++) {
        uint8_t rgb[3];
        colour(rgb, pixel_difference(a, b, i) / (scale > 0 ? scale : 1));
        set_pixel(&image, i % a->width, i / a->width, rgb);
    }
    draw_scale(&image, a->height + MARGIN, scale);
    cli_out_open(&out, path);
    image_write(&image, image_kind("-o", path), &out);
    cli_out_commit(&out);
    image_free(&image);
}

int main(int argc, char **argv)
{
    options_t o;
    image_t a, b;
    numbers_t n;
    bool above;

    cli_begin("qlux-diff");
    parse(&o, argc, argv);
    image_read(&a, o.path[0]);
    image_read(&b, o.path[1]);
    if (a.width != b.width || a.height != b.height) {
        cli_fail(CLI_INPUT, "%s is %ux%u, but %s is %ux%u", o.path[0],
                (unsigned)a.width, (unsigned)a.height, o.path[1],
                (unsigned)b.width, (unsigned)b.height);
    }
    if ((a.floats != NULL) != (b.floats != NULL)) {
        cli_fail(CLI_INPUT, "%s and %s: one is linear, one for a display",
                o.path[0], o.path[1]);
    }
    compare(&n, &a, &b);
    printf("identical: %s\nrmse: %.9g\nrelmse: %.9g\nbias: %.9g\n"
           "psnr: %.9g\nmax: %.9g\n",
            n.identical ? "yes" : "no", n.rmse, n.relmse, n.bias, n.psnr,
            n.max);
    if (o.picture != NULL) {
        write_picture(&a, &b, o.picture);
    }
    image_free(&a);
    image_free(&b);
    /* A NaN is above every limit, but without a limit there is none. */
    above = (o.relmse_max < HUGE_VAL && !(n.relmse <= o.relmse_max)) ||
            (o.bias_max < HUGE_VAL && !(fabs(n.bias) <= o.bias_max));
    return above ? CLI_USAGE : CLI_DONE;
}
