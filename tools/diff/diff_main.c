/* diff_main.c - qlux-diff: two pictures to a few numbers and a picture */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "diff/diff_picture.h"
#include "lib/image/image_file.h"

static const char help[] =
        "qlux-diff: two pictures to a few numbers and a picture\n"
        "\n"
        "  qlux-diff A B [options]        B is the reference\n"
        "\n"
        "  --max-relmse X   exit 1 if relmse is above X\n"
        "  --max-bias X     exit 1 if |bias| is above X\n"
        "  -o FILE          the difference, .ppm or .png: red where A is\n"
        "                   larger, blue where smaller, white where equal,\n"
        "                   black where it is no number; a scale below it\n"
        "  --scale X        full colour for a difference of X; else such that\n"
        "                   99.9 % of the pixels fit, rounded up to 1, 2 or 5\n"
        "                   times a power of ten\n"
        "  --relative       draw (a - b) / sqrt(b^2 + 0.01 mean(b)^2)\n"
        "  --zoom N         draw a pixel as N x N, 1 to 16                1\n"
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
        "and with -o, of differences that are means of the three channels:\n"
        "  scale      the largest that is drawn\n"
        "  clipped    pixels beyond it, drawn in full colour\n"
        "  undefined  pixels whose difference is no number\n"
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
    diff_style_t style;
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

static double take_scale(const char *option, const char *text)
{
    const double value = take_limit(option, text);

    if (!(value > 0 && value < HUGE_VAL)) {
        cli_fail(CLI_USAGE, "'%s %s': expected a finite number above 0", option,
                text);
    }
    return value;
}

static void parse(options_t *o, int argc, char **argv)
{
    const char *drawing = NULL; /* an option for the picture */
    int paths = 0;

    memset(o, 0, sizeof *o);
    o->relmse_max = o->bias_max = HUGE_VAL;
    o->style.zoom = 1;
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
        } else if (strcmp(a, "--scale") == 0) {
            o->style.scale = take_scale(drawing = a, argv[++i]);
        } else if (strcmp(a, "--relative") == 0) {
            drawing = a;
            o->style.relative = true;
        } else if (strcmp(a, "--zoom") == 0) {
            drawing = a;
            o->style.zoom =
                    (unsigned)cli_number(a, argv[++i], 1, DIFF_ZOOM_MAX);
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
    if (o->picture == NULL && drawing != NULL) {
        cli_fail(CLI_USAGE, "'%s' needs -o (see --help)", drawing);
    }
}

/* By bits: -0 is not 0, and a NaN may equal another. */
static bool same_bits(const image_t *a, const image_t *b)
{
    const size_t n = diff_value_count(a);

    return a->floats != NULL ? memcmp(a->floats, b->floats, 4 * n) == 0
                             : memcmp(a->bytes, b->bytes, n) == 0;
}

/* A NaN anywhere makes the numbers NaN, which are above every limit. */
static void compare(numbers_t *out, const image_t *a, const image_t *b)
{
    const size_t n = diff_value_count(a);
    const double epsilon = diff_epsilon(b);
    double sum_a = 0, sum_b = 0, squares = 0, relative = 0, peak = 0;

    memset(out, 0, sizeof *out);
    for (size_t i = 0; i < n; i++) {
        sum_a += diff_value(a, i);
        sum_b += diff_value(b, i);
    }
    for (size_t i = 0; i < n; i++) {
        const double vb = diff_value(b, i), d = diff_value(a, i) - vb;
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
    out->psnr = out->rmse == 0 ? HUGE_VAL : 20 * log10(peak / out->rmse);
    out->max = out->rmse == out->rmse ? out->max : out->rmse;
}

static void write_picture(const image_t *page, const char *path)
{
    cli_out_t out;

    cli_out_open(&out, path);
    image_write(page, image_kind("-o", path), &out);
    cli_out_commit(&out);
}

int main(int argc, char **argv)
{
    options_t o;
    image_t a, b, page;
    numbers_t n;
    diff_shown_t shown;
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
    if (o.picture != NULL) { /* before it says anything: this may fail */
        shown = diff_picture(&page, &a, &b, &o.style);
    }
    printf("identical: %s\nrmse: %.9g\nrelmse: %.9g\nbias: %.9g\n"
           "psnr: %.9g\nmax: %.9g\n",
            n.identical ? "yes" : "no", n.rmse, n.relmse, n.bias, n.psnr,
            n.max);
    if (o.picture != NULL) {
        printf("scale: %.9g\nclipped: %lu\nundefined: %lu\n", shown.scale,
                (unsigned long)shown.clipped, (unsigned long)shown.undefined);
        write_picture(&page, o.picture);
        image_free(&page);
    }
    image_free(&a);
    image_free(&b);
    /* A NaN is above every limit, but without a limit there is none. */
    above = (o.relmse_max < HUGE_VAL && !(n.relmse <= o.relmse_max)) ||
            (o.bias_max < HUGE_VAL && !(fabs(n.bias) <= o.bias_max));
    return above ? CLI_USAGE : CLI_DONE;
}
