/* test_render.c - the simulator's pictures are those of ql_render_line() */
/* SPDX-License-Identifier: MIT */

/* qlux-sim adds up sums on threads and develops
 * them afterwards; a board renders line by line. Every format must agree. */

#include <string.h>

#include "support/picture/box_scene.h"
#include "lib/render/develop.h"
#include "lib/render/rows.h"
#include "qlux.h"
#include "sim/sim_render.h"

enum { WIDTH = 33, HEIGHT = 21, BYTES_MAX = 3 * WIDTH };

static int failures;

static void check(bool ok, const char *claim, const char *format)
{
    printf("%-20s %s_%-*s %s\n", "tools/test_render", claim,
            51 - (int)strlen(claim), format, ok ? "ok" : "FAIL");
    failures += !ok;
}

/* Back from 8-bit RGB to what the display gets: the highest bits of each. */
static void narrow(uint8_t *line, ql_format_t format, const uint8_t *rgb)
{
    for (size_t x = 0; x < WIDTH; x++, rgb += 3) {
        const uint8_t high = (uint8_t)((rgb[0] & 0xf8) | rgb[1] >> 5);
        const uint8_t low = (uint8_t)((rgb[1] << 3 & 0xe0) | rgb[2] >> 3);
        switch (format) {
        case QL_FORMAT_RGB888:
            memcpy(line + 3 * x, rgb, 3);
            break;
        case QL_FORMAT_RGB565_LE:
        case QL_FORMAT_RGB565_BE:
            line[2 * x] = format == QL_FORMAT_RGB565_LE ? low : high;
            line[2 * x + 1] = format == QL_FORMAT_RGB565_LE ? high : low;
            break;
        case QL_FORMAT_GRAY8:
            line[x] = rgb[0];
            break;
        case QL_FORMAT_GRAY4:
            line[x / 2] =
                    (uint8_t)(x % 2 == 0 ? rgb[0] & 0xf0
                                         : (line[x / 2] & 0xf0) | rgb[0] >> 4);
            break;
        }
    }
}

static bool lines_agree(
        ql_render_t *render, const sums_t *sums, ql_format_t format)
{
    uint8_t wanted[BYTES_MAX] = {0}, got[BYTES_MAX] = {0};
    const ql_output_t output = {format, wanted};
    const develop_t how = {.format = format,
            .curve = ql_curve_of(&render->settings),
            .exposure_q8 = render->settings.exposure_q8};
    image_t line;
    bool ok = true;

    image_new_bytes(&line, WIDTH, 1);
    for (uint16_t y = 0; y < HEIGHT; y++) {
        ql_render_line(render, y, &output, 1);
        develop_row(&line, sums, sums_pixels(sums, y), y, &how);
        narrow(got, format, line.bytes);
        ok = ok && memcmp(got, wanted, QL_LINE_BYTES(WIDTH, format)) == 0;
    }
    image_free(&line);
    return ok;
}

/* Sums, as the simulator makes them. Returns the paths it counted. */
static uint64_t fill_sums(
        sums_t *sums, const ql_render_t *render, const char *finishes)
{
    sums_range_t all = {0, HEIGHT, 0, 0};
    const ql_blob_header_t *h = render->scene->header;
    const sim_how_t how = {.threads = 3, .quiet = true};
    sim_stats_t stats;

    memset(sums, 0, sizeof *sums);
    sums->field[SUMS_WIDTH] = WIDTH;
    sums->field[SUMS_HEIGHT] = HEIGHT;
    sums->field[SUMS_RADIANCE_EXP] =
            (uint32_t)(int32_t)ql_i16(QL_LE16((uint16_t)h->radiance_exp));
    sums->field[SUMS_EXPOSURE_Q8] =
            (uint32_t)(int32_t)ql_i16(QL_LE16((uint16_t)h->exposure_q8));
    sums_new(sums, 0, HEIGHT);
    all.sample_end = render->settings.spp;
    check(sim_render(sums, render, &all, &how, &stats), "the_simulator",
            finishes);
    return stats.paths;
}

/* With all samples, or as many as each pixel needs. */
static void compare(const ql_scene_t *scene, uint32_t spp, uint16_t error_q16,
        ql_curve_t curve)
{
    ql_settings_t settings = QL_SETTINGS_DEFAULT;
    const char *claim = error_q16 != 0 ? "sim_and_line_end_alike_in"
                                       : "sim_and_line_agree_on";
    ql_render_t render;
    sums_t sums;
    uint64_t paths;

    settings.width = WIDTH;
    settings.height = HEIGHT;
    settings.spp = spp;
    settings.exposure_q8 = -333;
    settings.curve = curve;
#if QL_CFG_ADAPTIVE
    settings.error_q16 = error_q16;
#endif
    if (ql_render_init(&render, scene, &settings) != QL_OK) {
        cli_fail(CLI_INPUT, "the settings are refused");
    }
    paths = fill_sums(&sums, &render,
            error_q16 != 0 ? "finishes_pixels_early" : "finishes");
    for (int f = 0; f < QL_FORMAT_COUNT; f++) {
        render.diag.paths = 0;
        check(lines_agree(&render, &sums, (ql_format_t)f), claim,
                develop_formats[f]);
    }
    check(render.diag.paths == paths && paths > 0 &&
                    (error_q16 == 0) ==
                            (sums.counts == NULL &&
                                    paths == (uint64_t)spp * WIDTH * HEIGHT),
            claim, "the_number_of_paths");
    sums_free(&sums);
}

/* More samples than the simulator takes in a step: one call of the core has
 * the same sums, of as many paths, wherever the range begins and ends. */
static void compare_steps(const ql_scene_t *scene)
{
    static const struct {
        uint32_t first, end;
        const char *name;
    } ranges[] = {{0, ROWS_STEP, "a_step"}, {0, ROWS_STEP + 1, "one_more"},
            {0, 5000, "5000_samples"}, {3, 3 * ROWS_STEP + 5, "four_steps"},
            {70000, 75000, "70000_to_75000"}};
    ql_settings_t settings = QL_SETTINGS_DEFAULT;
    ql_render_t render;

    settings.width = 2;
    settings.height = 1;
    settings.spp = 80000;
    if (ql_render_init(&render, scene, &settings) != QL_OK) {
        cli_fail(CLI_INPUT, "the settings are refused");
    }
    for (size_t i = 0; i < sizeof ranges / sizeof ranges[0]; i++) {
        const uint32_t count = ranges[i].end - ranges[i].first;
        const sums_range_t range = {0, 1, ranges[i].first, ranges[i].end};
        const sim_how_t how = {.threads = 1, .quiet = true};
        sim_stats_t stats;
        sums_t sums;
        bool same = true;

        render.diag.paths = 0; /* which the simulator goes on counting */
        memset(&sums, 0, sizeof sums);
        sums.field[SUMS_WIDTH] = 2;
        sums.field[SUMS_HEIGHT] = 1;
        sums_new(&sums, 0, 1);
        same = sim_render(&sums, &render, &range, &how, &stats) &&
               stats.paths == 2 * (uint64_t)count;
        for (uint16_t x = 0; x < 2; x++) {
            ql_sum_t sum = {{0, 0, 0}};

            ql_render_pixel(&render, x, 0, ranges[i].first, count, &sum);
            same = same && memcmp(&sum, sums.pixels + x, sizeof sum) == 0 &&
                   sum.rgb[0] != 0;
        }
        check(same, "steps_add_up_to_one_call_of", ranges[i].name);
        sums_free(&sums);
    }
}

/* Means of 25 bits, half way between two floats: to the even one. */
static void compare_ties(void)
{
    const sums_range_t one = {0, 1, 0, 1};
    const develop_t linear = {.kind = IMAGE_PFM};
    image_t line;
    sums_t sums;

    memset(&sums, 0, sizeof sums);
    sums.field[SUMS_WIDTH] = sums.field[SUMS_HEIGHT] = 1;
    sums_new(&sums, 0, 1);
    sums_settle_one(&sums, &one);
    sums.pixels[0].rgb[0] = (1u << 24) + 1;
    sums.pixels[0].rgb[1] = (1u << 24) + 3;
    sums.pixels[0].rgb[2] = (1ull << 32) + (1u << 8) + 1;
    image_new_floats(&line, 1, 1);
    develop_row(&line, &sums, sums.pixels, 0, &linear);
    check(line.floats[0] == 1 && line.floats[1] == 1 + 0x1p-22f &&
                    line.floats[2] == 256 + 0x1p-15f,
            "means_are_rounded_to_the_nearest_float", "ties_to_even");
    image_free(&line);
    sums_free(&sums);
}

int main(void)
{
    ql_scene_t scene;
    size_t size;
    void *blob;

    cli_begin("test_render");
    blob = box_scene(&size);
    if (ql_blob_open(&scene, blob, size) != QL_OK) {
        cli_fail(CLI_INPUT, "the scene does not open");
    }
    compare(&scene, 5, 0, QL_CURVE_SRGB);
    compare(&scene, 3, 0, QL_CURVE_FILMIC);
    compare_steps(&scene);
    compare_ties();
#if QL_CFG_ADAPTIVE
    compare(&scene, 200, 0x4000, QL_CURVE_REINHARD);
#endif
    return failures != 0;
}
