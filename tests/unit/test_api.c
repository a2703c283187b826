/* test_api.c - the synopsis in qlux.h, and that no split changes a bit */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <stdlib.h>

#include "support/built.h"
#include "support/picture/estimate.h"
#include "support/picture/mini_scene.h"
#include "support/ql_stats.h"
#include "support/ql_test.h"
#include "qlux.h"
#include "sample/ql_roulette.h"
#include "warp/ql_warp_plane.h"

enum { WIDTH = 32, HEIGHT = 24, SPP = 8 };

static mini_scene_t mini;
static ql_scene_t scene;

static void build(unsigned node_bits)
{
    static const int32_t low[3] = {8, 8, 8}, high[3] = {32759, 32759, 32759};
    static const int32_t lamp[4][3] = {{12000, 32000, 12000},
            {20000, 32000, 12000}, {20000, 32000, 20000},
            {12000, 32000, 20000}};
    static const int32_t box_low[3] = {9000, 8, 20000};
    static const int32_t box_high[3] = {15000, 12000, 26000};
    static const double right[3] = {0.5, 0, 0}, up[3] = {0, 0.5, 0};
    uint16_t white, light;

    mini_begin(&mini);
    mini.node_bits = node_bits;
    white = mini_material(&mini, 0.7, 0);
    light = mini_material(&mini, 0, 0.9);
    mini_room(&mini, low, high, white);
    mini_room(&mini, box_low, box_high, white); /* seen from behind */
    mini_quad(&mini, lamp[0], lamp[1], lamp[2], lamp[3], light);
    mini_eye(&mini, 16384, 16384, 1000);
    mini_field(&mini, right, up);
    mini.width = WIDTH;
    mini.height = HEIGHT;
    mini_open(&mini, &scene);
}

static ql_render_t begin(const ql_settings_t *settings)
{
    ql_render_t render;

    if (ql_render_init(&render, &scene, settings) != QL_OK) {
        (void)fprintf(stderr, "test_api: settings refused\n");
        exit(2);
    }
    return render;
}

static ql_settings_t small(void)
{
    ql_settings_t settings = QL_SETTINGS_DEFAULT;

    settings.spp = SPP;
    settings.seed = 5;
    return settings;
}

/* ---- The synopsis ------------------------------------------------------ */

#if QL_CFG_FORMATS & 1

static unsigned sent;
static unsigned long bright;

static void send(const uint8_t *line)
{
    sent++;
    for (unsigned i = 0; i < 3 * 128; i++) {
        bright += line[i];
    }
}

TEST(the_synopsis_of_qlux_h_renders_a_picture)
{
    const void *blob;
    size_t blob_size;

    build(MINI_BITS_MAX);
    blob = mini.blob;
    blob_size = mini.size_bytes;
    {
        static uint8_t line[QL_LINE_BYTES(128, QL_FORMAT_RGB888)];
        ql_scene_t opened;
        ql_render_t render;
        ql_settings_t settings = QL_SETTINGS_DEFAULT;
        const ql_output_t output = {QL_FORMAT_RGB888, line};

        settings.width = 128;
        settings.height = 64;
        if (ql_blob_open(&opened, blob, blob_size) == QL_OK &&
                ql_render_init(&render, &opened, &settings) == QL_OK) {
            for (uint16_t y = 0; y < 64; y++) {
                ql_render_line(&render, y, &output, 1);
                send(line);
            }
        }
    }
    CHECK(sent == 64, "%u lines were sent", sent);
    CHECK(!QL_CFG_LIGHTS || bright > 64 * 128 * 3 * 8, "mean byte %.2f",
            (double)bright / (64 * 128 * 3));
    NOTE("mean byte %.1f", (double)bright / (64 * 128 * 3));
}
#endif

/* ---- Any order and any split ------------------------------------------- */

static uint8_t picture[HEIGHT][3 * WIDTH], other[HEIGHT][3 * WIDTH];

static void render_lines(const ql_settings_t *settings,
        uint8_t pixels[HEIGHT][3 * WIDTH], const uint16_t order[HEIGHT])
{
    ql_render_t render = begin(settings);

    for (unsigned i = 0; i < HEIGHT; i++) {
        const ql_output_t output = {BUILT_FORMAT, pixels[order[i]]};

        ql_render_line(&render, order[i], &output, 1);
    }
}

static void in_order(uint16_t order[HEIGHT])
{
    for (uint16_t y = 0; y < HEIGHT; y++) {
        order[y] = y;
    }
}

TEST(any_order_of_lines_gives_the_same_bits)
{
    const ql_settings_t settings = small();
    uint16_t order[HEIGHT];
    uint64_t state = 1;

    for (unsigned bits = MINI_BITS_MIN; bits <= MINI_BITS_MAX; bits += 8) {
        build(bits);
        in_order(order);
        render_lines(&settings, picture, order);
        for (unsigned i = 0; i < 4; i++) {
            for (unsigned k = HEIGHT - 1; k > 0; k--) {
                const unsigned j = stats_random_below(&state, k + 1);
                const uint16_t swap = order[k];

                order[k] = order[j];
                order[j] = swap;
            }
            render_lines(&settings, other, order);
            CHECK(memcmp(picture, other, sizeof picture) == 0,
                    "%u-bit nodes, order %u", bits, i);
        }
    }
}

#if QL_CFG_NODE8 && QL_CFG_NODE16
TEST(both_node_widths_give_the_same_bits)
{
    const ql_settings_t settings = small();
    uint16_t order[HEIGHT];

    in_order(order);
    build(8);
    render_lines(&settings, picture, order);
    build(16);
    render_lines(&settings, other, order);
    CHECK(memcmp(picture, other, sizeof picture) == 0, "the pictures differ");
}
#endif

TEST(any_split_of_the_samples_gives_the_same_bits)
{
    static const uint8_t samplers[] = {QL_SAMPLER_RANDOM, QL_SAMPLER_SOBOL};
    unsigned pixels = 0;

    build(MINI_BITS_MAX);
    for (unsigned s = 0; s < 2; s++) {
        ql_settings_t settings = small();
        ql_render_t render;

        if (!BUILT_HAS_SAMPLER(samplers[s])) {
            continue;
        }
        settings.sampler = samplers[s];
        render = begin(&settings);
        for (unsigned i = 0; i < WIDTH * HEIGHT; i++, pixels++) {
            const uint16_t x = (uint16_t)(i % WIDTH), y = (uint16_t)(i / WIDTH);
            ql_sum_t whole = {{0, 0, 0}}, parts = {{0, 0, 0}};

            ql_render_pixel(&render, x, y, 0, SPP, &whole);
            ql_render_pixel(&render, x, y, 5, SPP - 5, &parts);
            ql_render_pixel(&render, x, y, 0, 0, &parts);
            for (uint32_t k = 5; k-- > 0;) {
                ql_render_pixel(&render, x, y, k, 1, &parts);
            }
            CHECK(memcmp(&whole, &parts, sizeof whole) == 0,
                    "sampler %u at %u, %u", s, x, y);
        }
    }
    CHECK(pixels > 0, "there is no sampler");
    NOTE("%u pixels", pixels);
}

TEST(a_line_is_its_pixels_encoded)
{
    const ql_settings_t settings = small();
    ql_render_t render;
    uint8_t line[3 * WIDTH] = {0}, pixels[3 * WIDTH] = {0};
    const ql_output_t whole = {BUILT_FORMAT, line};
    const ql_output_t single = {BUILT_FORMAT, pixels};

    build(MINI_BITS_MAX);
    render = begin(&settings);
    ql_render_line(&render, 7, &whole, 1);
    for (uint16_t x = WIDTH; x-- > 0;) {
        ql_sum_t sum = {{0, 0, 0}};

        ql_render_pixel(&render, x, 7, 0, SPP, &sum);
        ql_render_encode(&render, x, 7, &sum, SPP, &single, 1);
    }
    CHECK(memcmp(line, pixels, sizeof line) == 0, "line 7 differs");
}

TEST(several_outputs_hold_what_each_would_alone)
{
    const ql_settings_t settings = small();
    ql_render_t render;
    uint8_t together[QL_FORMAT_COUNT][3 * WIDTH] = {{0}};
    uint8_t alone[QL_FORMAT_COUNT][3 * WIDTH] = {{0}};
    ql_output_t outputs[QL_FORMAT_COUNT];
    uint8_t count = 0;

    build(MINI_BITS_MAX);
    render = begin(&settings);
    for (unsigned i = 0; i < QL_FORMAT_COUNT; i++) {
        const ql_output_t output = {(ql_format_t)i, alone[i]};

        if (BUILT_HAS_FORMAT(i)) {
            outputs[count].format = (ql_format_t)i;
            outputs[count++].pixels = together[i];
            ql_render_line(&render, 9, &output, 1);
        }
    }
    ql_render_line(&render, 9, outputs, count);
    CHECK(memcmp(together, alone, sizeof together) == 0, "they differ");
    NOTE("%u formats at once", count);
}

#if QL_CFG_LIGHTS
TEST(seeds_and_samplers_give_different_pictures_of_one_mean)
{
    const unsigned last = QL_CFG_SAMPLERS == 3 ? 2 : 1;
    ql_settings_t settings = small();
    double mean[3] = {0, 0, 0};
    ql_sum_t sums[3][WIDTH * HEIGHT];
    unsigned same = 0;

    build(MINI_BITS_MAX);
    for (unsigned s = 0; s <= last; s++) {
        ql_render_t render;

        settings.seed = s == 1 ? 6 : 5;
        settings.sampler = s == 2 ? QL_SAMPLER_RANDOM : small().sampler;
        render = begin(&settings);
        memset(sums[s], 0, sizeof sums[s]);
        for (unsigned i = 0; i < WIDTH * HEIGHT; i++) {
            ql_render_pixel(&render, (uint16_t)(i % WIDTH),
                    (uint16_t)(i / WIDTH), 0, SPP, &sums[s][i]);
            mean[s] += (double)sums[s][i].rgb[1] / (WIDTH * HEIGHT);
            same += s > 0 && sums[s][i].rgb[1] == sums[0][i].rgb[1] &&
                    sums[s][i].rgb[1] != 0;
        }
    }
    /* the lamp itself is constant, so its pixels agree */
    CHECK(same < WIDTH * HEIGHT / 4, "%u pixels agree", same);
    CHECK(mean[1] > 0.9 * mean[0] && mean[1] < 1.1 * mean[0] &&
                    mean[last] > 0.9 * mean[0] && mean[last] < 1.1 * mean[0],
            "means %.0f %.0f %.0f", mean[0], mean[1], mean[2]);
}
#endif

TEST(lines_may_be_rendered_by_copies_of_a_render)
{
    const ql_settings_t settings = small();
    ql_render_t first, second;
    uint8_t line[3 * WIDTH] = {0}, copy[3 * WIDTH] = {0};
    const ql_output_t a = {BUILT_FORMAT, line};
    const ql_output_t b = {BUILT_FORMAT, copy};

    build(MINI_BITS_MAX);
    first = begin(&settings);
    ql_render_line(&first, 3, &a, 1);
    second = first;
    ql_render_line(&first, 4, &a, 1);
    ql_render_line(&second, 4, &b, 1);
    CHECK(memcmp(line, copy, sizeof line) == 0, "line 4 differs");
#if QL_CFG_DIAG
    CHECK(second.diag.paths == 2ul * WIDTH * SPP, "%lu paths",
            (unsigned long)second.diag.paths);
    CHECK(memcmp(&first.diag, &second.diag, sizeof first.diag) == 0,
            "the counters differ");
    CHECK(ql_render_init(&second, first.scene, &settings) == QL_OK &&
                    second.diag.paths == 0,
            "a second picture goes on with %lu paths",
            (unsigned long)second.diag.paths);
#endif
}

/* ---- Settings ---------------------------------------------------------- */

TEST(settings_outside_their_range_are_refused)
{
    enum { CASES = 10 };
    static const ql_render_t zero;
    unsigned refused = 0;

    build(MINI_BITS_MAX);
    for (unsigned i = 0; i < CASES; i++) {
        ql_settings_t s = small();
        ql_render_t render;
        ql_status_t status;

        switch (i) {
        case 0:
            s.spp = 0;
            break;
        case 1:
            s.spp = (uint32_t)QL_SPP_MAX + 1;
            break;
        case 2:
            s.width = QL_IMAGE_MAX + 1;
            break;
        case 3:
            s.height = QL_IMAGE_MAX + 1;
            break;
        case 4:
            s.bounces = QL_BOUNCES_MAX + 1;
            break;
        case 5:
            s.sampler = 200;
            break;
        case 6:
            s.direct = 200;
            break;
        case 7:
            s.indirect = 200;
            break;
        case 8:
            s.width = 0xffff;
            break;
        default:
            s.bounces = 0xff;
            break;
        }
        memset(&render, 0x5a, sizeof render);
        status = ql_render_init(&render, &scene, &s);
        CHECK(status == QL_ERR_SETTINGS, "case %u: status %d", i, status);
        CHECK(render.scene == zero.scene && render.settings.spp == 0 &&
                        render.exposure.m == 0,
                "case %u left a render", i);
        refused += status == QL_ERR_SETTINGS;
    }
    NOTE("%u cases", refused);
}

TEST(settings_at_their_limits_render)
{
    ql_settings_t s = small();
    ql_render_t render;
    ql_sum_t sum = {{0, 0, 0}};

    build(MINI_BITS_MAX);
    s.width = s.height = QL_IMAGE_MAX;
    s.spp = QL_SPP_MAX;
    s.bounces = BUILT_BOUNCES(QL_BOUNCES_MAX);
    s.seed = 0xffffffffu;
    render = begin(&s);
    ql_render_pixel(&render, QL_IMAGE_MAX - 1, QL_IMAGE_MAX - 1,
            (uint32_t)QL_SPP_MAX - 4, 4, &sum);
    ql_render_pixel(&render, 0, 0, 0, 4, &sum);
    CHECK((sum.rgb[0] > 0) == QL_CFG_LIGHTS, "%lu was gathered",
            (unsigned long)sum.rgb[0]);
}

TEST(a_size_of_zero_is_the_scenes_own)
{
    const ql_settings_t s = small();
    ql_render_t render;

    build(MINI_BITS_MAX);
    render = begin(&s);
    CHECK(render.settings.width == WIDTH && render.settings.height == HEIGHT,
            "%u x %u", render.settings.width, render.settings.height);
}

/* Emitters still shine at the camera when nothing is estimated. */
TEST(strategies_of_none_leave_only_what_is_seen)
{
    ql_settings_t s = small();
    ql_render_t render;
    ql_sum_t sum = {{0, 0, 0}};
    unsigned lit = 0, partly = 0;

    build(MINI_BITS_MAX);
    s.direct = QL_DIRECT_NONE;
    s.indirect = QL_INDIRECT_NONE;
    render = begin(&s);
    for (unsigned i = 0; i < WIDTH * HEIGHT; i++) {
        memset(&sum, 0, sizeof sum);
        ql_render_pixel(&render, (uint16_t)(i % WIDTH), (uint16_t)(i / WIDTH),
                0, 1, &sum);
        lit += sum.rgb[0] > 0;
        partly += sum.rgb[0] > 0 && sum.rgb[0] != 15099494;
    }
    /* 0.9 of 2^24 is 15099494.4 */
    CHECK(partly == 0, "%u pixels are neither black nor the lamp", partly);
    CHECK((lit > 0) == QL_CFG_LIGHTS, "%u pixels see the lamp", lit);
    NOTE("%u pixels see the lamp", lit);
}

/* ---- Each decision has numbers of its own ------------------------------- */

/* What each claim below needs. */
#define LENS_AND_PIXEL (QL_CFG_LENS && QL_CFG_LIGHTS)
#define MANY_SAMPLES                                                           \
    (QL_CFG_LIGHT_SAMPLES && QL_CFG_LIGHTS && (QL_CFG_SAMPLERS & 1) != 0)
#define ROULETTE                                                               \
    (QL_CFG_ROULETTE && QL_CFG_MIRROR && QL_CFG_SKY && QL_CFG_INDIRECT &&      \
            (QL_CFG_SAMPLERS & 1) != 0)
#define SHADOW_RAYS (QL_CFG_DIAG && QL_CFG_LIGHTS)

#if LENS_AND_PIXEL || MANY_SAMPLES || ROULETTE || SHADOW_RAYS || QL_CFG_DIAG
/* A square across the line of sight, 8000 ahead, from x to 4000 to the right of
 * the middle; it faces the eye. */
static void put_ahead(int32_t x, uint16_t material)
{
    const int32_t c[4][3] = {{16384 + x, 12384, 9000}, {16384 + x, 20384, 9000},
            {20384, 20384, 9000}, {20384, 12384, 9000}};

    mini_quad(&mini, c[0], c[1], c[2], c[3], material);
    mini_eye(&mini, 16384, 16384, 1000);
    mini_look(&mini, 0, 0, 0.5);
}
#endif

#if LENS_AND_PIXEL
enum { GRID = 1024 };

/* A ray meets the square at p + a radii to the right, p uniform in the pixel
 * and a the first coordinate on the lens: how often is that beyond an edge? */
static double share_beyond(double edge, bool tied)
{
    double sum = 0;

    for (uint32_t i = 0; i < GRID; i++) {
        const double u = (i + 0.5) / GRID;

        if (!tied) {
            const double a = edge - 1 + u * (2 - edge); /* to 1 */

            sum += (2 - edge) * (a + 1 - edge) / acos(-1) * sqrt(1 - a * a);
            continue;
        }
        for (uint32_t k = 0; k < GRID; k++) {
            ql_q29_t a, b;

            ql_warp_plane_disk((uint32_t)(u * 0x1p32),
                    (uint32_t)((k + 0.5) / GRID * 0x1p32), &a, &b);
            sum += (2 * u - 1 + ldexp(a, -29) > edge) / (double)GRID;
        }
    }
    return sum / GRID;
}

TEST(points_of_the_pixel_and_of_the_lens_are_unrelated)
{
    static const double p[2][3] = {{1000, 0, 0}, {0, 1000, 0}};
    static const double none[2][3] = {{0, 0, 0}, {0, 0, 0}};
    static const double right[3] = {0.0625, 0, 0}, up[3] = {0, 0.0625, 0};
    const double exact = share_beyond(1.2, false);
    const double tied = share_beyond(1.2, true);
    double worst = 0;

    mini_begin(&mini);
    put_ahead(1200, mini_material(&mini, 0, 0.5));
    mini_field(&mini, right, up);
    mini_lens(&mini, p, none);
    for (unsigned kind = 0; kind <= QL_SAMPLER_SOBOL; kind++) {
        const ql_settings_t s =
                estimate_settings((ql_sampler_kind_t)kind, 0, 3);
        const double variance = 0.25 * exact * (1 - exact);
        stats_moments_t m;
        double z;

        if (!BUILT_HAS_SAMPLER(kind)) {
            continue;
        }
        m = estimate_pixel(&mini, &s, 0, 0, 65536);
        z = estimate_z(&m, 0.5 * exact, variance);
        worst = fmax(worst, fabs(z));
        CHECK(fabs(z) < 4, "mean %.5f, not %.5f, z = %.1f", 2 * m.mean, exact,
                z);
        CHECK(estimate_z(&m, 0.5 * tied, variance) < -4,
                "one point for both would give %.5f too", tied);
    }
    NOTE("%.4f of the rays, z = %.1f; one point for both: %.4f", exact, worst,
            tied);
}
#endif

#if MANY_SAMPLES
/* The kurtosis of what one sample gives is below 5 here, so the variance of
 * SAMPLES is known to sqrt(4 / SAMPLES), or 1.6 percent, and the ratio of two
 * to a tenth in four standard errors. */
TEST(samples_of_a_light_vary_less_the_more_there_are)
{
    enum { SAMPLES = 16384, MORE = 16 };
    static const int32_t lamp[4][3] = {{15384, 15384, 8000},
            {18384, 15384, 8000}, {18384, 18384, 8000}, {15384, 18384, 8000}};
    double off = 0;

    mini_begin(&mini);
    put_ahead(-4000, mini_material(&mini, 0.8, 0));
    /* nearly above the point that is seen, and seen from behind itself */
    mini_quad(&mini, lamp[0], lamp[1], lamp[2], lamp[3],
            mini_material(&mini, 0, 0.5));
    mini_eye(&mini, 16384, 16384, 8500);
    for (int all = 0; all < 1 + BUILT_HAS_LIGHTS(QL_LIGHTS_ALL); all++) {
        ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 0, 8);
        stats_moments_t one, more;
        double ratio;

        s.lights = all ? QL_LIGHTS_ALL : QL_LIGHTS_POWER;
        one = estimate_pixel(&mini, &s, 0, 0, SAMPLES);
        s.light_samples = MORE;
        more = estimate_pixel(&mini, &s, 0, 0, SAMPLES);
        ratio = stats_variance(&one) / stats_variance(&more) / MORE;
        off = fmax(off, fabs(ratio - 1));
        CHECK(fabs(ratio - 1) < 0.1, "all %d: %.3f of %d", all, ratio, MORE);
    }
    NOTE("off by %.1f percent; samples all alike would be by 94", 100 * off);
}
#endif

#if ROULETTE
/* Red is reflected by the mirror only, which is drawn half of the time. */
TEST(roulette_does_not_depend_on_the_lobe_drawn)
{
    static const double albedo[3] = {0, 0.4, 0.4}, red[3] = {0.4, 0, 0};
    static const double black[3] = {0, 0, 0};
    ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 1, 9);
    stats_moments_t m;
    uint16_t material;
    double z;

    mini_begin(&mini);
    material = mini_rgb(&mini, albedo, black);
    mini_gloss_rgb(&mini, material, QL_GLOSS_MIRROR, red, 0);
    mini.materials[material].chance = 0.5;
    put_ahead(-4000, material);
    mini_sky(&mini, 0.5, 0.5, 0.5);
    s.roulette = 1;
    m = estimate_pixel(&mini, &s, 0, 0, 65536);
    /* 0.4 / 0.5 of the light half of the time, of which 0.8 survives: all of
     * the light or none; by the number of the lobe that were half of it */
    z = estimate_z(&m, 0.5 * 0.4, 0.25 * 0.4 * 0.6);
    CHECK(fabs(z) < 4, "mean %.5f, not 0.2, z = %.1f", m.mean, z);
    CHECK(estimate_z(&m, 0.5 * 0.5, 0.25 * 0.4 * 0.6) < -4,
            "the same number for both would give 0.25 too");
    NOTE("mean %.4f, z = %.1f", m.mean, z);
}

/* Whichever it is: as its chance, and as what survivors are divided by. */
TEST(roulette_looks_at_the_largest_channel)
{
    ql_sampler_t sampler;

    ql_sampler_begin(&sampler, QL_SAMPLER_RANDOM, 3, 0, 0);
    for (unsigned k = 0; k < 3; k++) {
        unsigned survivors = 0;

        for (uint32_t i = 0; i < 4096; i++) {
            ql_rgb_t rgb = {{0, 0, 0}, 0};

            rgb.c[k] = QL_UQ31_ONE / 4;
            rgb.c[(k + 1) % 3] = QL_UQ31_ONE / 16;
            ql_sampler_start(&sampler, i);
            if (ql_roulette_survives(&sampler, 2, &rgb)) {
                survivors++;
                CHECK(fabs(ldexp(rgb.c[k], rgb.e - 31) - 1) < 0x1p-28,
                        "channel %u: %.9f", k, ldexp(rgb.c[k], rgb.e - 31));
            }
        }
        CHECK(fabs(survivors - 1024.0) < 5 * 27.8, "channel %u: %u of 4096", k,
                survivors);
    }
}
#endif

#if QL_CFG_DIAG
/* A path that ends on a black surface is not one too faint to go on. */
TEST(black_surfaces_are_not_counted_as_faint)
{
    ql_settings_t s = small();
    ql_render_t render;
    ql_sum_t sum = {{0, 0, 0}};

    mini_begin(&mini);
    put_ahead(-4000, mini_material(&mini, 0, 0));
    mini_open(&mini, &scene);
    render = begin(&s);
    ql_render_pixel(&render, 0, 0, 0, 64, &sum);
    CHECK(render.diag.paths == 64 && render.diag.faint == 0, "%lu of %lu",
            (unsigned long)render.diag.faint, (unsigned long)render.diag.paths);
}
#endif

#if SHADOW_RAYS
/* No picture tells: the surface itself hides such a light, but at its edges. */
TEST(a_light_behind_a_surface_costs_no_shadow_ray)
{
    static const int32_t lamp[4][3] = {{15384, 15384, 10000},
            {17384, 15384, 10000}, {17384, 17384, 10000},
            {15384, 17384, 10000}};
    ql_settings_t s = small();

    for (int behind = 0; behind < 2; behind++) {
        const int32_t z = behind ? 0 : -3000;
        int32_t c[4][3];
        ql_render_t render;
        ql_sum_t sum = {{0, 0, 0}};

        for (int i = 0; i < 4; i++) {
            c[i][0] = lamp[behind ? 3 - i : i][0];
            c[i][1] = lamp[behind ? 3 - i : i][1] + 2000;
            c[i][2] = lamp[i][2] + z;
        }
        mini_begin(&mini);
        put_ahead(-4000, mini_material(&mini, 0.8, 0));
        mini_quad(&mini, c[0], c[1], c[2], c[3], mini_material(&mini, 0, 0.5));
        mini_open(&mini, &scene);
        s.bounces = 0;
        render = begin(&s);
        ql_render_pixel(&render, 0, 0, 0, 64, &sum);
        CHECK(render.diag.paths == 64 &&
                        render.diag.shadow_rays == (behind ? 0 : 64),
                "behind %d: %lu shadow rays", behind,
                (unsigned long)render.diag.shadow_rays);
    }
}
#endif

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_api", argc, argv);
#if QL_CFG_FORMATS & 1
    RUN(the_synopsis_of_qlux_h_renders_a_picture);
#endif
    RUN(any_order_of_lines_gives_the_same_bits);
#if QL_CFG_DIAG
    RUN(black_surfaces_are_not_counted_as_faint);
#endif
#if QL_CFG_NODE8 && QL_CFG_NODE16
    RUN(both_node_widths_give_the_same_bits);
#endif
    RUN(any_split_of_the_samples_gives_the_same_bits);
    RUN(a_line_is_its_pixels_encoded);
    RUN(several_outputs_hold_what_each_would_alone);
#if QL_CFG_LIGHTS
    RUN(seeds_and_samplers_give_different_pictures_of_one_mean);
#endif
    RUN(lines_may_be_rendered_by_copies_of_a_render);
    RUN(settings_outside_their_range_are_refused);
    RUN(settings_at_their_limits_render);
    RUN(a_size_of_zero_is_the_scenes_own);
    RUN_IF(BUILT_HAS_DIRECT(QL_DIRECT_NONE),
            strategies_of_none_leave_only_what_is_seen);
#if LENS_AND_PIXEL
    RUN(points_of_the_pixel_and_of_the_lens_are_unrelated);
#endif
#if MANY_SAMPLES
    RUN(samples_of_a_light_vary_less_the_more_there_are);
#endif
#if ROULETTE
    RUN(roulette_does_not_depend_on_the_lobe_drawn);
    RUN(roulette_looks_at_the_largest_channel);
#endif
#if SHADOW_RAYS
    RUN(a_light_behind_a_surface_costs_no_shadow_ray);
#endif
    return TEST_END();
}
