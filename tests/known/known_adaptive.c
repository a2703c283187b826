/* known_adaptive.c - pixels that end by themselves have no bias */
/* SPDX-License-Identifier: MIT */

/* All rays of a picture meet one point, so each of its pixels estimates the
 * same number with random numbers of its own: the mean of 2^16 of them is
 * judged against the truth. Stopping early biases where single samples differ
 * much: uniform directions, of which an eighth meets the lamp above a white
 * floor, or that count by twice their cosine inside a room that shines
 * everywhere. Rules that average the samples they decided by, and other wrong
 * ones, are put together from the core's parts and must be found out. */

#include <math.h>
#include <stdlib.h>

#include "support/picture/estimate.h"
#include "support/picture/lambert.h"
#include "support/ql_test.h"
#include "qlux.h"
#include "film/ql_adaptive.h"

#if QL_CFG_ADAPTIVE

#define ULP (1.0 / (1 << QL_POS_BITS)) /* grid units */

static mini_scene_t m;

/* ---- Scenes ------------------------------------------------------------ */

enum { SIDE = 256, PIXELS = SIDE * SIDE, UNIT = 8000, POINT = 16000 };
#define RADIANCE 0.5

/* A unit square above a white floor, a unit apart, seen from above. */
static double make_square(void)
{
    static const double up[3] = {0, 0, 1};
    const int32_t h = UNIT / 2, r = 100, z = 1000;
    const int32_t lamp[4][3] = {{POINT - h, POINT - h, z + UNIT},
            {POINT - h, POINT + h, z + UNIT}, {POINT + h, POINT + h, z + UNIT},
            {POINT + h, POINT - h, z + UNIT}};
    const int32_t floor[4][3] = {{POINT - r, POINT - r, z},
            {POINT + r, POINT - r, z}, {POINT + r, POINT + r, z},
            {POINT - r, POINT + r, z}};
    lambert_polygon_t p;

    mini_begin(&m);
    mini_quad(&m, lamp[0], lamp[1], lamp[2], lamp[3],
            mini_material(&m, 0, RADIANCE));
    mini_quad(&m, floor[0], floor[1], floor[2], floor[3],
            mini_material(&m, 1, 0));
    mini_eye(&m, POINT, POINT, z + 64);
    mini_look(&m, 0, 0, -0.5);
    m.width = m.height = SIDE;
    memset(&p, 0, sizeof p);
    p.count = 4;
    for (int i = 0; i < 4; i++) {
        p.corner[i][0] = lamp[3 - i][0] - POINT;
        p.corner[i][1] = lamp[3 - i][1] - POINT;
        p.corner[i][2] = UNIT - ULP; /* the point is lifted by one */
    }
    return lambert_form_factor(&p, up);
}

/* Inside a room whose walls emit and reflect half: 1 + 1/2 + 1/4. */
static double make_furnace(void)
{
    static const int32_t low[3] = {384, 384, 384},
                         high[3] = {32384, 32384, 32384};

    mini_begin(&m);
    mini_room(&m, low, high, mini_material(&m, 0.5, RADIANCE));
    mini_eye(&m, 14000, 17000, 12000);
    mini_look(&m, 0.125, 0.0625, 0.25);
    m.width = m.height = SIDE;
    return 1.75;
}

static const struct {
    const char *name;
    double (*make)(void);
    uint8_t bounces;
} scenes[] = {{"square", make_square, 0}, {"furnace", make_furnace, 1}};

/* ---- Rules ------------------------------------------------------------- */

typedef enum {
    RULE_CORE,       /* ql_render_adaptive() */
    RULE_OWN,        /* each half decides for itself */
    RULE_ALL_AS_ONE, /* the mean of all samples that were taken */
    RULE_LAST,       /* end where the last sample was bright */
    RULE_SPP,        /* divide by the most samples there may be */
    RULES
} rule_t;

/* The mean of a pixel by a wrong rule, made of the core's parts. */
static double wrong(ql_render_t render[2], uint16_t x, uint16_t y, rule_t rule)
{
    static const ql_half_t none;
    const ql_settings_t *s = &render->settings;
    ql_half_t half[2];
    ql_sum_t sum;
    bool last, done = false;
    uint32_t n;

    half[0] = half[1] = none;
    for (uint32_t count = QL_ADAPTIVE_MIN / 2; !done; count *= 2) {
        for (unsigned k = 0; k < 2; k++) {
            while (half[k].spread.count < count) {
                sum.rgb[0] = sum.rgb[1] = sum.rgb[2] = 0;
                ql_render_pixel(
                        render + k, x, y, half[k].spread.count, 1, &sum);
                ql_half_add(half + k, &sum);
            }
        }
        last = 2 * count == s->spp;
        if (rule == RULE_LAST) {
            done = last || sum.rgb[0] > 0;
            last = done;
        }
        if (rule == RULE_OWN) {
            done = true;
            for (unsigned k = 0; k < 2; k++) {
                if (half[k].used_count == 0 &&
                        (last || ql_spread_enough(
                                         &half[k].spread, s->error_q16))) {
                    half[k].used = half[k].sum;
                    half[k].used_count = count;
                }
                done = done && half[k].used_count != 0;
            }
        } else {
            done = ql_half_decide(
                    half, rule == RULE_LAST ? 0 : s->error_q16, last);
        }
    }
    if (rule == RULE_ALL_AS_ONE) {
        half[0].used = half[0].sum;
        half[1].used = half[1].sum;
        half[0].used_count = half[1].used_count = half[0].spread.count;
    }
    n = ql_half_join(half, &sum);
    return (double)sum.rgb[0] / (rule == RULE_SPP ? s->spp : n);
}

/* Every pixel of the picture, in the units of the lamp. */
static stats_moments_t measure(ql_sampler_kind_t sampler, uint8_t bounces,
        double error, rule_t rule, uint32_t pixels, double *samples)
{
    ql_settings_t s = estimate_settings(sampler, bounces, 77);
    const double unit = ldexp(RADIANCE, QL_SUM_BITS);
    stats_moments_t moments = {0, 0, 0};
    ql_scene_t scene;
    ql_render_t render[2];

    mini_open(&m, &scene);
    s.direct = QL_DIRECT_HEMISPHERE;
    s.indirect = QL_INDIRECT_UNIFORM;
    s.spp = 1024;
    s.error_q16 = (uint16_t)lround(error * 65536);
    for (unsigned k = 0; k < 2; k++) {
        CHECK(ql_render_init(render + k, &scene, &s) == QL_OK, "settings");
        s.seed ^= QL_ADAPTIVE_SEED;
    }
    *samples = 0;
    for (uint32_t i = 0; i < pixels; i++) {
        const uint16_t x = (uint16_t)(i % SIDE), y = (uint16_t)(i / SIDE);
        ql_sum_t sum;

        if (rule == RULE_CORE) {
            const uint32_t n = ql_render_adaptive(render, x, y, &sum);

            stats_add(&moments, (double)sum.rgb[0] / n / unit);
            *samples += n;
        } else {
            stats_add(&moments, wrong(render, x, y, rule) / unit);
        }
    }
    *samples /= pixels;
    return moments;
}

static double z_of(const stats_moments_t *got, double truth)
{
    return estimate_z(got, truth, stats_variance(got));
}

/* ---- Claims ------------------------------------------------------------ */

/* At errors at which pixels end after a few levels of counts; 0 ends them. */
static void claim(int scene, ql_sampler_kind_t sampler, const double errors[])
{
    const double truth = scenes[scene].make();
    char line[120] = "bias";
    double worst = 0;

    for (int i = 0; errors[i] > 0; i++) {
        const double e = errors[i];
        double samples;
        const stats_moments_t got = measure(
                sampler, scenes[scene].bounces, e, RULE_CORE, PIXELS, &samples);
        const double z = z_of(&got, truth);
        const size_t at = strlen(line);

        CHECK(fabs(z) < STATS_Z_MAX, "E %.2f: %.6f, want %.6f, z %.1f", e,
                got.mean, truth, z);
        CHECK(samples > QL_ADAPTIVE_MIN && samples < 1000, "E %.2f: %.1f", e,
                samples);
        (void)snprintf(line + at, sizeof line - at,
                " %+.4f (%.4f) E %.3f n %.0f", got.mean / truth - 1,
                sqrt(stats_variance(&got) / got.n) / truth, e, samples);
        worst = fmax(worst, fabs(z));
    }
    NOTE("%s", line);
}

TEST(square_has_its_form_factor_at_random)
{
    static const double errors[] = {0.6, 0.35, 0};

    claim(0, QL_SAMPLER_RANDOM, errors);
}

TEST(square_has_its_form_factor_by_sobol)
{
    static const double errors[] = {0.35, 0};

    claim(0, QL_SAMPLER_SOBOL, errors);
}

TEST(furnace_has_its_series_at_random)
{
    static const double errors[] = {0.05, 0};

    claim(1, QL_SAMPLER_RANDOM, errors);
}

TEST(furnace_has_its_series_by_sobol)
{
    static const double errors[] = {0.05, 0};

    claim(1, QL_SAMPLER_SOBOL, errors);
}

/* Every wrong rule, over fewer pixels if that will do. */
static void reject(rule_t rule, uint32_t pixels)
{
    const double truth = make_square();
    double samples;
    const stats_moments_t got =
            measure(QL_SAMPLER_RANDOM, 0, 0.4, rule, pixels, &samples);
    const double z = z_of(&got, truth);

    CHECK(fabs(z) > STATS_Z_MAX, "%.6f, right %.6f, z %.1f", got.mean, truth,
            z);
    NOTE("bias %+.4f, z %.1f", got.mean / truth - 1, z);
}

TEST(rejects_halves_that_decide_for_themselves)
{
    reject(RULE_OWN, PIXELS / 16);
}

TEST(rejects_the_mean_of_all_samples)
{
    reject(RULE_ALL_AS_ONE, PIXELS / 16);
}

TEST(rejects_ending_where_the_last_sample_was_bright)
{
    reject(RULE_LAST, PIXELS / 16);
}

TEST(rejects_dividing_by_the_most_samples)
{
    reject(RULE_SPP, PIXELS / 16);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("known/adaptive", argc, argv);
    RUN(square_has_its_form_factor_at_random);
    RUN(square_has_its_form_factor_by_sobol);
    RUN(furnace_has_its_series_at_random);
    RUN(furnace_has_its_series_by_sobol);
    RUN(rejects_halves_that_decide_for_themselves);
    RUN(rejects_the_mean_of_all_samples);
    RUN(rejects_ending_where_the_last_sample_was_bright);
    RUN(rejects_dividing_by_the_most_samples);
    return TEST_END();
}

#else

int main(void)
{
    return 0;
}

#endif
