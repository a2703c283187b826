/* diff_main.c - qlux-diff: two pictures to a few numbers and a picture */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "diff/diff_picture.h"
#include "lib/image/image_file.h"
#include "lib/program/options.h"

typedef struct {
    const char *path[2];
    const char *picture;
    double relmse_max;
    double bias_max;
    diff_style_t style;
} options_t;

#define AT(field) OPTION_FIELD(options_t, field)

static const char *const pictures[] = {".ppm", ".png", NULL};

static const option_t comparing[] = {
        {"A", OPTION_TEXT, AT(path[0]), .required = true},
        {"B", OPTION_TEXT, AT(path[1]), .required = true},
        {"--max-relmse X", OPTION_REAL, AT(relmse_max), .max = HUGE_VAL,
                .help = "exit 4 if relmse is above X"},
        {"--max-bias X", OPTION_REAL, AT(bias_max), .max = HUGE_VAL,
                .help = "exit 4 if |bias| is above X"},
        OPTION_END};

static const option_t drawing[] = {
        {"-o FILE", OPTION_FILE, AT(picture), .words = pictures,
                .help = "the difference, .ppm or .png: red where A is larger, "
                        "blue where smaller, white where equal, black where it "
                        "is no number; a scale below it"},
        {"--scale X", OPTION_POSITIVE, AT(style.scale),
                .help = "full colour for a difference of X; else such that "
                        "99.9 % of the pixels fit, rounded up to 1, 2 or 5 "
                        "times a power of ten"},
        {"--relative", OPTION_FLAG, AT(style.relative),
                .help = "draw (a - b) / sqrt(b^2 + 0.01 mean(b)^2)"},
        {"--zoom N", OPTION_NUMBER, AT(style.zoom), .min = 1,
                .max = DIFF_ZOOM_MAX, .help = "draw a pixel as N x N"},
        OPTION_END};

static const option_section_t sections[] = {
        {NULL, comparing}, {"The picture:", drawing}, {NULL, NULL}};

static const program_t program = {.name = "qlux-diff",
        .about = "two pictures to a few numbers and a picture",
        .usage = "A B [options]\tB is the reference",
        .sections = sections,
        .notes = "Reads PPM, PNG (display values 0 to 255) and PFM (linear "
                 "radiance). Prints, each mean over all pixels and channels:\n"
                 "identical\tyes or no: every value has the same bits\n"
                 "rmse\tsqrt(mean((a - b)^2))\n"
                 "relmse\tmean((a - b)^2 / (b^2 + 0.01 mean(b)^2)); the "
                 "relative MSE of Rousselle, Knaus and Zwicker (2011), its "
                 "epsilon of 0.01 for a picture of mean 1\n"
                 "bias\t(mean(a) - mean(b)) / mean(b)\n"
                 "psnr\t20 log10(peak / rmse) dB; the peak is 255, or the "
                 "largest b of a PFM\n"
                 "max\tlargest |a - b|\n"
                 "and with -o, of differences that are means of the three "
                 "channels:\n"
                 "scale\tthe largest that is drawn\n"
                 "clipped\tpixels beyond it, drawn in full colour\n"
                 "undefined\tpixels whose difference is no number",
        .exits = "4 above a limit",
        .example = "qlux-diff box.pfm box-ref.pfm --max-relmse 1e-6 "
                   "-o diff.png"};

typedef struct {
    bool identical;
    double rmse;
    double relmse;
    double bias;
    double psnr;
    double max;
} numbers_t;

/* An option for the picture needs one. */
static void check_options(const options_t *o)
{
    static const char *const names[] = {"--scale", "--relative", "--zoom"};

    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        if (o->picture == NULL && options_given(names[i])) {
            options_fail("'%s' needs '-o'", names[i]);
        }
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

int main(int argc, char **argv)
{
    options_t o = {
            .relmse_max = HUGE_VAL, .bias_max = HUGE_VAL, .style = {.zoom = 1}};
    image_t a, b, page;
    numbers_t n;
    diff_shown_t shown;
    cli_out_t out;
    bool above;

    options_parse(&program, argc, argv, &o);
    check_options(&o);
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
        cli_out_open(&out, o.picture);
        shown = diff_picture(&page, &a, &b, &o.style);
    }
    printf("identical: %s\nrmse: %.9g\nrelmse: %.9g\nbias: %.9g\n"
           "psnr: %.9g\nmax: %.9g\n",
            n.identical ? "yes" : "no", n.rmse, n.relmse, n.bias, n.psnr,
            n.max);
    if (o.picture != NULL) {
        printf("scale: %.9g\nclipped: %lu\nundefined: %lu\n", shown.scale,
                (unsigned long)shown.clipped, (unsigned long)shown.undefined);
        image_write(&page, image_kind(o.picture), &out);
        cli_out_commit(&out);
        image_free(&page);
    }
    image_free(&a);
    image_free(&b);
    /* A NaN is above every limit, but without a limit there is none. */
    above = (o.relmse_max < HUGE_VAL && !(n.relmse <= o.relmse_max)) ||
            (o.bias_max < HUGE_VAL && !(fabs(n.bias) <= o.bias_max));
    return above ? CLI_ABOVE : CLI_DONE;
}
