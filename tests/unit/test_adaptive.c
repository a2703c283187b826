/* test_adaptive.c - the stopping rule, its extremes, the mean of two halves */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <stdlib.h>

#include "support/built.h"
#include "support/picture/mini_scene.h"
#include "support/ql_stats.h"
#include "support/ql_test.h"
#include "support/ql_wide.h"
#include "qlux.h"
#include "film/ql_adaptive.h"

/* ---- A scene ----------------------------------------------------------- */

static mini_scene_t mini;
static ql_scene_t scene;

enum { WIDTH = 16, HEIGHT = 12 };

/* A room with a lamp; a wall of it may shine instead. */
static void build(double emission)
{
    static const int32_t low[3] = {8, 8, 8}, high[3] = {32759, 32759, 32759};
    static const int32_t lamp[4][3] = {{12000, 32000, 12000},
            {20000, 32000, 12000}, {20000, 32000, 20000},
            {12000, 32000, 20000}};
    static const double right[3] = {0.5, 0, 0}, up[3] = {0, 0.5, 0};
    const double red[3] = {0.8, 0.4, 0.2}, none[3] = {0, 0, 0};

    mini_begin(&mini);
    mini_room(&mini, low, high,
            emission > 0 ? mini_material(&mini, 0, emission)
                         : mini_rgb(&mini, red, none));
    mini_quad(&mini, lamp[0], lamp[1], lamp[2], lamp[3],
            mini_material(&mini, 0, 0.9));
    mini_eye(&mini, 16384, 16384, 1000);
    mini_look(&mini, 0, 0.125, 0.5);
    mini_field(&mini, right, up);
    mini.width = WIDTH;
    mini.height = HEIGHT;
    mini_open(&mini, &scene);
}

static ql_render_t begin(const ql_settings_t *settings)
{
    ql_render_t render;

    if (ql_render_init(&render, &scene, settings) != QL_OK) {
        (void)fprintf(stderr, "test_adaptive: settings refused\n");
        exit(2);
    }
    return render;
}

static ql_settings_t settings_of(uint32_t spp, uint16_t error_q16)
{
    ql_settings_t settings = QL_SETTINGS_DEFAULT;

    settings.spp = spp;
    settings.seed = 11;
#if QL_CFG_ADAPTIVE
    settings.error_q16 = error_q16;
#else
    CHECK(error_q16 == 0, "this build knows no error");
#endif
    return settings;
}

static ql_sum_t gray(uint64_t level)
{
    ql_sum_t sum;

    sum.rgb[0] = sum.rgb[1] = sum.rgb[2] = level;
    return sum;
}

TEST(lines_take_all_samples_without_an_error)
{
    static uint8_t line[3 * WIDTH], want[3 * WIDTH];
    const ql_settings_t s = settings_of(100, 0);
    const ql_output_t out = {BUILT_FORMAT, line},
                      out_want = {BUILT_FORMAT, want};
    ql_render_t render;

    build(0);
    render = begin(&s);
    for (uint16_t y = 0; y < HEIGHT; y++) {
        ql_render_line(&render, y, &out, 1);
        for (uint16_t x = 0; x < WIDTH; x++) {
            ql_sum_t sum = gray(0);

            ql_render_pixel(&render, x, y, 0, s.spp, &sum);
            ql_render_encode(&render, x, y, &sum, s.spp, &out_want, 1);
        }
        CHECK(memcmp(line, want, sizeof line) == 0, "line %u", y);
    }
}

#if QL_CFG_ADAPTIVE

/* ---- The rule ---------------------------------------------------------- */

static ql_spread_t spread_of(const uint32_t *values, uint32_t count)
{
    ql_spread_t spread = {0, 0, 0, 0};

    for (uint32_t i = 0; i < count; i++) {
        ql_spread_add(&spread, values[i]);
    }
    return spread;
}

/* The part of the mean that the standard error of 2 count values is, from
 * distances to the mean: no square is ever subtracted. */
static double error_of(const uint32_t *values, uint32_t count)
{
    stats_moments_t moments = {0, 0, 0};

    for (uint32_t i = 0; i < count; i++) {
        stats_add(&moments, values[i]);
    }
    return sqrt(stats_variance(&moments) / (2.0 * count)) / moments.mean;
}

/* Values of some bits: constant, nearly so, spread, mostly dark. */
static uint32_t value_of(uint64_t *state, unsigned kind, unsigned bits)
{
    const uint32_t most = 0xffffffffu >> (32 - bits);
    const uint32_t any = (uint32_t)stats_random(state) & most;

    switch (kind) {
    case 0:
        return most;
    case 1:
        return most - any / 1024;
    case 2:
        return any;
    default:
        return stats_random_below(state, 10) == 0 ? any : any / 256;
    }
}

enum { VALUES = 2048 };
static uint32_t values[VALUES];

/* The rule's own bound is 2^-28 of E^2; Welford's is below that too. */
TEST(decisions_are_those_of_doubles_but_for_rounding)
{
    uint64_t state = 1;
    unsigned long decisions = 0, near = 0;

    for (int round = 0; round < 4000; round++) {
        const unsigned kind = (unsigned)round % 4;
        const unsigned bits = 1 + stats_random_below(&state, 32);
        const uint32_t count =
                2 + stats_random_below(&state, round % 8 < 7 ? 64 : VALUES - 1);
        double error;
        ql_spread_t spread;

        for (uint32_t i = 0; i < count; i++) {
            values[i] = value_of(&state, kind, bits);
        }
        spread = spread_of(values, count);
        if (spread.sum == 0) {
            continue;
        }
        error = error_of(values, count) * 65536;
        for (int i = -3; i <= 3; i++) {
            /* the two that enclose the error, and others */
            const double e = floor(error) + i + (i > 1 ? 300 * i : 0);
            const bool want = error <= e;

            if (!(e >= 0 && e <= 65535)) {
                continue;
            }
            if (error > 0 && fabs(error - e) <= error * ldexp(1, -28)) {
                near++;
                continue;
            }
            decisions++;
            CHECK(ql_spread_enough(&spread, (uint16_t)e) == want,
                    "round %d, %lu values of %u bits, error %.9g / 65536, "
                    "E %.0f",
                    round, (unsigned long)count, bits, error, e);
        }
    }
    CHECK(decisions > 10000 && near < 10, "%lu decisions, %lu too near",
            decisions, near);
    NOTE("%lu decisions, %lu within 2^-28", decisions, near);
}

/* The sums are exact: h S2 - S^2 of a wide integer, for any values. */
TEST(sums_of_squares_are_exact)
{
    uint64_t state = 2;

    for (int round = 0; round < 200; round++) {
        wide_t want = wide_mul(0, 0), got;
        ql_spread_t spread = {0, 0, 0, 0};
        uint64_t sum = 0;

        for (int i = 0; i < 300; i++) {
            const uint32_t v = (uint32_t)stats_random(&state) | 0xf0000000u;

            ql_spread_add(&spread, v);
            want = wide_add(want, wide_mul(v, v));
            sum += v;
        }
        /* 2^32 high twice over */
        got = wide_mul((int64_t)((uint64_t)spread.square_high << 32), 1 << 30);
        got = wide_add(wide_add(got, got), wide_add(got, got));
        got = wide_add(got, wide_mul((int64_t)(spread.square_low >> 1), 2));
        got = wide_add(got, wide_mul((int64_t)(spread.square_low & 1), 1));
        CHECK(wide_sign(wide_sub(want, got)) == 0 && spread.sum == sum &&
                        spread.count == 300,
                "round %d", round);
    }
}

/* Half of the values 0, half M: h S2 - S^2 = h^2 M^2 / 4, so E is reached when
 * 2 (h - 1) E^2 >= 1. */
TEST(largest_values_in_largest_number_decide_right)
{
    const uint32_t h = 1u << 23;
    ql_spread_t spread = {0, 0, 0, 0};

    for (uint32_t i = 0; i < h; i++) {
        ql_spread_add(&spread, i % 2 != 0 ? 0xffffffffu : 0);
    }
    CHECK(spread.square_high != 0, "no carry");
    CHECK(!ql_spread_enough(&spread, 16), "2 (2^23 - 1) 2^-24 < 1");
    CHECK(ql_spread_enough(&spread, 17), "E = 17 / 2^16");
    for (uint32_t i = 0; i < h; i++) { /* 2^24 values */
        ql_spread_add(&spread, 0xffffffffu);
    }
    CHECK(spread.count == 1u << 24 && spread.square_high < 1u << 24 &&
                    spread.sum < (uint64_t)1 << 56,
            "%lu values", (unsigned long)spread.count);
    /* a quarter is 0: n S2 / S^2 = 4 / 3, 2 (n - 1) E^2 >= 1 / 3 */
    CHECK(!ql_spread_enough(&spread, 6), "E = 6 / 2^16");
    CHECK(ql_spread_enough(&spread, 7), "E = 7 / 2^16");
}

TEST(one_value_or_none_is_never_enough)
{
    ql_spread_t spread = {0, 0, 0, 0};

    CHECK(!ql_spread_enough(&spread, 65535), "no value");
    ql_spread_add(&spread, 7);
    CHECK(!ql_spread_enough(&spread, 65535), "one");
    ql_spread_add(&spread, 7);
    CHECK(ql_spread_enough(&spread, 0), "two equal ones");
}

TEST(black_is_not_enough_until_a_stated_number)
{
    ql_spread_t spread = {0, 0, 0, 0};

    for (uint32_t n = 2; n < 2 * QL_ADAPTIVE_BLACK; n += 2) {
        ql_spread_add(&spread, 0);
        CHECK(ql_spread_enough(&spread, 65535) == (n >= QL_ADAPTIVE_BLACK),
                "%lu samples", (unsigned long)n);
    }
}

TEST(more_error_allowed_is_never_refused)
{
    uint64_t state = 3;

    for (int round = 0; round < 300; round++) {
        bool before = false;
        ql_spread_t spread;

        for (int i = 0; i < 32; i++) {
            values[i] = value_of(&state, 1 + (unsigned)round % 3, 24);
        }
        spread = spread_of(values, 32);
        for (uint32_t e = 0; e <= 65535; e += 1 + e / 64) {
            const bool now = ql_spread_enough(&spread, (uint16_t)e);

            CHECK(now || !before, "round %d: E %lu / 2^16", round,
                    (unsigned long)e);
            before = now;
        }
    }
}

/* ---- Halves ------------------------------------------------------------ */

/* Each half is given samples of its own level. */
static uint32_t join(uint64_t a, uint64_t b, uint32_t used_a, uint32_t used_b,
        uint32_t count, ql_sum_t *sum)
{
    ql_half_t half[2] = {
            {{0, 0, 0, 0}, {{0}}, {{0}}, 0}, {{0, 0, 0, 0}, {{0}}, {{0}}, 0}};

    half[0].used = gray(a);
    half[1].used = gray(b);
    half[0].used_count = used_a;
    half[1].used_count = used_b;
    half[0].spread.count = half[1].spread.count = count;
    return ql_half_join(half, sum);
}

TEST(means_of_unequal_halves_weigh_the_same)
{
    ql_sum_t sum;

    CHECK(join(16 * 5, 64 * 9, 16, 64, 64, &sum) == 128, "count");
    CHECK(sum.rgb[0] == 64 * (5 + 9), "%lu", (unsigned long)sum.rgb[0]);
    CHECK(join(64 * 9, 16 * 5, 64, 16, 64, &sum) == 128, "count");
    CHECK(sum.rgb[2] == 64 * (5 + 9), "%lu", (unsigned long)sum.rgb[2]);
    /* 7 / 16 of 50 is 21.875, 8 / 16 is 25, 23 / 32 is 35.9 */
    (void)join(7, 0, 16, 50, 50, &sum);
    CHECK(sum.rgb[0] == 22, "%lu", (unsigned long)sum.rgb[0]);
    (void)join(8, 100, 16, 50, 50, &sum);
    CHECK(sum.rgb[1] == 125, "%lu", (unsigned long)sum.rgb[1]);
    (void)join(23, 1, 32, 16, 50, &sum);
    CHECK(sum.rgb[1] == 36 + 3, "%lu", (unsigned long)sum.rgb[1]);
}

TEST(sums_at_the_edge_saturate_and_never_wrap)
{
    const uint64_t most = UINT64_MAX;
    ql_half_t half = {{0, 0, 0, 0}, {{0}}, {{0}}, 0};
    ql_sum_t sum, bright = gray(most);

    (void)join(most, 0, 16, 16, 16, &sum);
    CHECK(sum.rgb[0] == most, "%llx", (unsigned long long)sum.rgb[0]);
    (void)join(most, 1, 16, 16, 16, &sum);
    CHECK(sum.rgb[0] == most, "%llx", (unsigned long long)sum.rgb[0]);
    (void)join(most, most, 16, 16, 1u << 23, &sum);
    CHECK(sum.rgb[0] == most, "%llx", (unsigned long long)sum.rgb[0]);
    (void)join(most >> 19, 0, 16, 1u << 23, 1u << 23, &sum); /* 2^45 2^19 */
    CHECK(sum.rgb[0] == most - ((1u << 19) - 1), "%llx",
            (unsigned long long)sum.rgb[0]);
    (void)join((most >> 19) + 1, 0, 16, 1u << 23, 1u << 23, &sum);
    CHECK(sum.rgb[0] == most, "%llx", (unsigned long long)sum.rgb[0]);
    ql_half_add(&half, &bright);
    ql_half_add(&half, &bright);
    CHECK(half.sum.rgb[1] == most && half.spread.sum == 2 * 0xffffffffull,
            "%llx", (unsigned long long)half.sum.rgb[1]);
}

/* 64 radiance units are 2^30. */
TEST(a_sample_is_judged_by_its_luminance_up_to_64_units)
{
    static const struct {
        uint64_t rgb[3], value;
    } cases[] = {{{0, 0, 0}, 0}, {{1, 0, 0}, 1}, {{0, 1, 0}, 2}, {{0, 0, 1}, 1},
            {{0x3fffffff, 0x3fffffff, 0x3fffffff}, 0xfffffffc},
            {{0x40000000, 0, 0}, 0xffffffff}, {{0, 0x40000000, 0}, 0xffffffff},
            {{0, 0, UINT64_MAX}, 0xffffffff},
            {{QL_CONTRIBUTION_MAX, 0, 0}, 0xffffffff}};

    for (unsigned i = 0; i < sizeof cases / sizeof *cases; i++) {
        ql_half_t half = {{0, 0, 0, 0}, {{0}}, {{0}}, 0};
        ql_sum_t sum;

        memcpy(sum.rgb, cases[i].rgb, sizeof sum.rgb);
        ql_half_add(&half, &sum);
        CHECK(half.spread.sum == cases[i].value, "case %u: %llu", i,
                (unsigned long long)half.spread.sum);
    }
}

/* ---- Pixels ------------------------------------------------------------ */

/* The samples of both halves of a pixel: two seeds. */
enum { SPP_MAX = 4096 };
static ql_sum_t samples[2][SPP_MAX / 2];

static void take(const ql_settings_t *settings, uint16_t x, uint16_t y)
{
    for (int k = 0; k < 2; k++) {
        ql_settings_t s = *settings;
        ql_render_t render;

        s.seed = k == 0 ? s.seed : s.seed ^ 0x80000000u;
        render = begin(&s);
        for (uint32_t i = 0; i < s.spp / 2; i++) {
            samples[k][i] = gray(0);
            ql_render_pixel(&render, x, y, i, 1, &samples[k][i]);
        }
    }
}

/* At how many samples of its own a half is content, from scratch. */
static uint32_t content(int k, uint32_t last, double e)
{
    static uint32_t v[SPP_MAX / 2];

    for (uint32_t h = 16; h < last; h *= 2) {
        double sum = 0;

        for (uint32_t i = 0; i < h; i++) {
            const uint64_t *rgb = samples[k][i].rgb;

            v[i] = (uint32_t)(rgb[0] + 2 * rgb[1] + rgb[2]);
            sum += v[i];
        }
        if (sum > 0 ? error_of(v, h) <= e : h >= QL_ADAPTIVE_BLACK / 2) {
            return h;
        }
    }
    return last;
}

static double mean_of(int k, uint32_t h, int channel)
{
    double sum = 0;

    for (uint32_t i = 0; i < h; i++) {
        sum += (double)samples[k][i].rgb[channel];
    }
    return sum / h;
}

TEST(pixels_are_those_of_an_oracle)
{
    static const uint32_t spps[] = {32, 33, 50, 64, 97, 1000, 4096};
    static const uint16_t errors[] = {1, 2000, 6554, 20000, 65535};
    unsigned early = 0, pixels = 0, uneven = 0;

    build(0);
    for (unsigned i = 0; i < 70; i += QL_TEST_SHARE) {
        ql_settings_t s = settings_of(spps[i % 7], errors[i / 7 % 5]);
        const uint32_t last = s.spp / 2;
        ql_render_t render;

        if (QL_CFG_SAMPLERS == 3 && i < 35) {
            s.sampler = QL_SAMPLER_RANDOM;
        }
        render = begin(&s);
        for (unsigned p = i % 11; p < WIDTH * HEIGHT; p += 31) {
            const uint16_t x = (uint16_t)(p % WIDTH), y = (uint16_t)(p / WIDTH);
            ql_sum_t sum = gray(12345); /* what it held does not matter */
            uint32_t n, a, b;

            take(&s, x, y);
            a = content(0, last, s.error_q16 / 65536.0);
            b = content(1, last, s.error_q16 / 65536.0);
            n = ql_render_adaptive(&render, x, y, &sum);
            CHECK(render.settings.seed == s.seed, "another seed is left");
            CHECK(n == 2 * (a > b ? a : b), "spp %lu, E %u: %lu, want %lu, %lu",
                    (unsigned long)s.spp, s.error_q16, (unsigned long)n,
                    2ul * a, 2ul * b);
            for (int c = 0; c < 3; c++) {
                /* each half as long as the other one says */
                const double want =
                        n / 2.0 * (mean_of(0, b, c) + mean_of(1, a, c));

                CHECK(fabs((double)sum.rgb[c] - want) <= 1 + want * 1e-12,
                        "spp %lu, E %u: %.0f, want %.1f", (unsigned long)s.spp,
                        s.error_q16, (double)sum.rgb[c], want);
            }
            pixels++;
            early += n < last * 2;
            uneven += a != b;
        }
    }
    CHECK(!QL_CFG_LIGHTS ||
                    (early > MANY(20) && (QL_TEST_SHARE > 1 || uneven > 10)),
            "%u early, %u uneven", early, uneven);
    NOTE("%u pixels, %u end early, %u halves differ", pixels, early, uneven);
}

TEST(error_0_and_few_samples_take_all_as_ever)
{
    static const struct {
        uint32_t spp;
        uint16_t error_q16;
    } cases[] = {{1, 0}, {100, 0}, {1, 65535}, {31, 65535}, {257, 0}};

    build(0);
    for (unsigned i = 0; i < 5; i++) {
        const ql_settings_t s = settings_of(cases[i].spp, cases[i].error_q16);
        ql_render_t render = begin(&s);
        ql_sum_t got = gray(3), want = gray(0);

        CHECK(ql_render_adaptive(&render, 5, 5, &got) == s.spp, "case %u", i);
        ql_render_pixel(&render, 5, 5, 0, s.spp, &want);
        CHECK(memcmp(&got, &want, sizeof got) == 0, "case %u", i);
    }
}

#if QL_CFG_LIGHTS
TEST(constant_radiance_stops_at_the_minimum_exactly)
{
    const ql_settings_t s = settings_of(1000, 1);
    unsigned pixels = 0;
    ql_render_t render;

    build(0.5);
    render = begin(&s);
    for (unsigned p = 0; p < WIDTH * HEIGHT; p++) {
        ql_sum_t sum, want = gray(0);
        const uint16_t x = (uint16_t)(p % WIDTH), y = (uint16_t)(p / WIDTH);
        uint32_t n;

        ql_render_pixel(&render, x, y, 0, 1, &want);
        if (want.rgb[0] != 1u << 23) {
            continue; /* the lamp in the way */
        }
        n = ql_render_adaptive(&render, x, y, &sum);
        if (n == QL_ADAPTIVE_MIN) {
            CHECK(sum.rgb[0] == (uint64_t)QL_ADAPTIVE_MIN << 23, "%u: %llu", p,
                    (unsigned long long)sum.rgb[0]);
            pixels++;
        } else { /* its edge */
            CHECK(sum.rgb[0] != (uint64_t)n << 23, "%u: %lu samples", p,
                    (unsigned long)n);
        }
    }
    CHECK(pixels > WIDTH * HEIGHT / 2, "only %u pixels", pixels);
    NOTE("%u pixels", pixels);
}
#endif

TEST(black_pixels_take_the_stated_number)
{
    ql_settings_t s = settings_of(1u << 24, 6554);
    ql_render_t render;
    ql_sum_t sum;

    build(0);
    s.direct = QL_DIRECT_NONE;
    s.indirect = QL_INDIRECT_NONE;
    render = begin(&s);
    CHECK(ql_render_adaptive(&render, 0, HEIGHT - 1, &sum) == QL_ADAPTIVE_BLACK,
            "at E 0.1");
    CHECK(sum.rgb[0] == 0 && sum.rgb[1] == 0 && sum.rgb[2] == 0, "not black");
    s.spp = 100;
    render = begin(&s);
    CHECK(ql_render_adaptive(&render, 0, HEIGHT - 1, &sum) == 100, "spp 100");
}

TEST(more_error_allowed_never_takes_more_samples)
{
    build(0);
    for (unsigned p = 0; p < WIDTH * HEIGHT; p += 7) {
        uint32_t before = 1u << 24;

        for (uint32_t e = 1600; e <= 65535; e += e / 3) {
            const ql_settings_t s = settings_of(2048, (uint16_t)e);
            ql_render_t render = begin(&s);
            ql_sum_t sum;
            const uint32_t n = ql_render_adaptive(&render,
                    (uint16_t)(p % WIDTH), (uint16_t)(p / WIDTH), &sum);

            CHECK(n <= before, "pixel %u, E %lu / 2^16: %lu, before %lu", p,
                    (unsigned long)e, (unsigned long)n, (unsigned long)before);
            before = n;
        }
    }
}

TEST(lines_are_made_of_these_pixels_in_any_order)
{
    static uint8_t line[3 * WIDTH];
    static uint8_t want[sizeof line];
    const ql_settings_t s = settings_of(500, 6554);
    const ql_output_t out = {BUILT_FORMAT, line};
    const ql_output_t out_want = {BUILT_FORMAT, want};
    ql_render_t render, other;

    build(0);
    render = begin(&s);
    other = begin(&s);
    for (unsigned i = 0; i < HEIGHT; i++) {
        const uint16_t y = (uint16_t)(HEIGHT - 1 - i);

        ql_render_line(&render, y, &out, 1);
        for (unsigned k = 0; k < WIDTH; k++) {
            const uint16_t x = (uint16_t)(k * 5 % WIDTH);
            ql_sum_t sum;
            const uint32_t n = ql_render_adaptive(&other, x, y, &sum);

            ql_render_encode(&other, x, y, &sum, n, &out_want, 1);
        }
        CHECK(memcmp(line, want, sizeof line) == 0, "line %u", y);
    }
}

#endif

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_adaptive", argc, argv);
    RUN(lines_take_all_samples_without_an_error);
#if QL_CFG_ADAPTIVE
    RUN(decisions_are_those_of_doubles_but_for_rounding);
    RUN(sums_of_squares_are_exact);
    RUN(largest_values_in_largest_number_decide_right);
    RUN(one_value_or_none_is_never_enough);
    RUN(black_is_not_enough_until_a_stated_number);
    RUN(more_error_allowed_is_never_refused);
    RUN(means_of_unequal_halves_weigh_the_same);
    RUN(sums_at_the_edge_saturate_and_never_wrap);
    RUN(a_sample_is_judged_by_its_luminance_up_to_64_units);
    RUN(pixels_are_those_of_an_oracle);
    RUN(error_0_and_few_samples_take_all_as_ever);
#if QL_CFG_LIGHTS
    RUN(constant_radiance_stops_at_the_minimum_exactly);
#endif
    RUN_IF(BUILT_HAS_DIRECT(QL_DIRECT_NONE),
            black_pixels_take_the_stated_number);
    RUN(more_error_allowed_never_takes_more_samples);
    RUN(lines_are_made_of_these_pixels_in_any_order);
#endif
    return TEST_END();
}
