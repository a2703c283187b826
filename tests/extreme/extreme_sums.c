/* extreme_sums.c - sums, throughput, roulette: cases 40 to 44, 53, 54 */
/* SPDX-License-Identifier: MIT */

#include <math.h>

#include "support/picture/estimate.h"
#include "support/ql_test.h"
#include "qlux.h"
#include "support/picture/film_add.h"

static mini_scene_t m;
static ql_scene_t scene;

static const ql_real_t one = {0x80000000u, -31};

/* ---- Constant radiance ------------------------------------------------- */

/* A wall that shines this much, all that is seen. */
static void make_wall(double radiance)
{
    static const int32_t a[3] = {8000, 8000, 24000},
                         b[3] = {24000, 8000, 24000};
    static const int32_t c[3] = {24000, 24000, 24000};
    static const int32_t d[3] = {8000, 24000, 24000};

    mini_begin(&m);
    mini_quad(&m, a, d, c, b, mini_material(&m, 0, radiance));
    mini_open(&m, &scene);
}

/* n samples of one radiance are n times one sample, to the last bit, and their
 * mean is the radiance as one sample shows it. */
static void check_constant(double radiance, uint32_t spp)
{
    const ql_settings_t s = estimate_settings(QL_SAMPLER_SOBOL, 4, 40);
    ql_sum_t single = {{0, 0, 0}}, all = {{0, 0, 0}};
    ql_uq16_t from_single[3], from_all[3];
    ql_render_t r;

    make_wall(radiance);
    CHECK(ql_render_init(&r, &scene, &s) == QL_OK, "settings");
    ql_render_pixel(&r, 0, 0, 0, 1, &single);
    ql_render_pixel(&r, 0, 0, 0, spp, &all);
    CHECK(all.rgb[0] == single.rgb[0] * spp &&
                    fabs(ldexp((double)single.rgb[0], -24) - radiance) <=
                            0x1p-25 + 0x1p-32,
            "%lu samples of %g: %llu", (unsigned long)spp, radiance,
            (unsigned long long)all.rgb[0]);
    ql_film_display(&single, 1, r.exposure, from_single);
    ql_film_display(&all, spp, r.exposure, from_all);
    CHECK(from_single[0] == from_all[0], "%lu samples of %g: %lu, one: %lu",
            (unsigned long)spp, radiance, (unsigned long)from_all[0],
            (unsigned long)from_single[0]);
}

TEST(case_40_1_to_2_to_24_samples_of_a_constant_are_the_constant)
{
    static const double radiances[] = {
            0.5, 0.25, 0x1p-24, 0.3, 1.0 / 3, 0.999999, 1 - 0x1p-32};
    const unsigned n = sizeof radiances / sizeof radiances[0];
    ql_diag_t diag = {0};
    ql_uq16_t linear[3];
    ql_sum_t sum = {{0, 0, 0}};

    for (unsigned i = 0; i < n; i++) {
        check_constant(radiances[i], 1);
        check_constant(radiances[i], 1u << 16);
    }
    /* 2^24 through the film: a third, a half, the least there is */
    for (uint32_t i = 0; i < QL_SPP_MAX; i++) {
        film_add(&sum.rgb[0], 0x55555555u >> 1, one, 0, &diag);
        film_add(&sum.rgb[1], QL_UQ31_ONE / 2, one, 0, &diag);
        film_add(&sum.rgb[2], 1u << 7, one, 0, &diag);
    }
    CHECK(sum.rgb[0] == (uint64_t)0x555555 << 24 && sum.rgb[1] == 1ull << 47 &&
                    sum.rgb[2] == 1ull << 24 && diag.saturated == 0,
            "2^24 samples: %llx %llx %llx", (unsigned long long)sum.rgb[0],
            (unsigned long long)sum.rgb[1], (unsigned long long)sum.rgb[2]);
    ql_film_display(&sum, QL_SPP_MAX, one, linear);
    CHECK(linear[0] == 21845 && linear[1] == 32768 && linear[2] == 0,
            "means %lu %lu %lu of 65536", (unsigned long)linear[0],
            (unsigned long)linear[1], (unsigned long)linear[2]);
    NOTE("%u radiances of 1 and 2^16 samples, 3 of 2^24", n);
}

/* ---- Edges of containers ----------------------------------------------- */

/* Add value 2^e to a sum, and count. */
static uint32_t add(uint64_t *sum, ql_uq31_t value, int e)
{
    const ql_real_t scale = {0x80000000u, (int16_t)(e - 31)};
    ql_diag_t diag = {0};

    film_add(sum, value, scale, 0, &diag);
    return diag.saturated;
}

TEST(case_41_sums_saturate_at_their_ends_are_counted_and_never_wrap)
{
    const ql_real_t least = {0x80000000u, -32768}, most = {0xffffffffu, 32767};
    ql_diag_t diag = {0};
    unsigned long edges = 0;
    ql_uq16_t linear[3];
    ql_sum_t sum;
    uint64_t x;

    /* across every power of two, the word's boundary among them: a carry */
    for (unsigned bit = 1; bit < 64; bit++) {
        x = ((uint64_t)1 << bit) - 1;
        CHECK(add(&x, QL_UQ31_ONE, -24) == 0 && x == (uint64_t)1 << bit,
                "2^%u - 1 + 1: %llx", bit, (unsigned long long)x);
        edges++;
    }
    /* the largest contribution: 2^15 itself fits, an ulp more is cut */
    for (unsigned e = 0; e <= 15; e++) {
        x = 0;
        CHECK(add(&x, QL_UQ31_ONE, (int)e) == 0 && x == (uint64_t)1 << (24 + e),
                "2^%u: %llx", e, (unsigned long long)x);
        edges++;
    }
    x = 0;
    CHECK(add(&x, QL_UQ31_ONE + 1, 15) == QL_CFG_DIAG &&
                    x == QL_CONTRIBUTION_MAX,
            "2^15 and an ulp: %llx", (unsigned long long)x);
    x = 0;
    CHECK(add(&x, QL_UQ31_ONE - 1, 15) == 0 && x == QL_CONTRIBUTION_MAX - 256,
            "2^15 less an ulp: %llx", (unsigned long long)x);
    /* the last 2^39 of a sum: full or not, to the ulp */
    for (uint64_t left = 0; left < 4; left++) {
        x = UINT64_MAX - left;
        CHECK(add(&x, QL_UQ31_ONE, -23) == (left < 2 ? QL_CFG_DIAG : 0) &&
                        x == (left < 2 ? UINT64_MAX : UINT64_MAX - left + 2),
                "%llu left, 2 added: %llx", (unsigned long long)left,
                (unsigned long long)x);
        edges++;
    }
    /* scales of every size */
    x = 5;
    film_add(&x, 0xffffffffu, least, 0, &diag);
    CHECK(x == 5 && diag.saturated == 0, "the least scale: %llx",
            (unsigned long long)x);
    film_add(&x, 1, most, 0, &diag);
    CHECK(x == 5 + QL_CONTRIBUTION_MAX && diag.saturated == QL_CFG_DIAG,
            "the largest scale: %llx", (unsigned long long)x);
    /* most samples of the most light: 2^63, in one sum */
    x = 0;
    memset(&diag, 0, sizeof diag);
    for (uint32_t i = 0; i < QL_SPP_MAX; i++) {
        film_add(&x, QL_UQ31_ONE, most, 0, &diag);
    }
    CHECK(x == (uint64_t)1 << 63 && diag.saturated == QL_CFG_DIAG * QL_SPP_MAX,
            "2^24 of 2^15: %llx, %lu counted", (unsigned long long)x,
            (unsigned long)diag.saturated);
    /* the display's own end: 65536 times white */
    sum.rgb[0] = UINT64_MAX;
    sum.rgb[1] = (uint64_t)1 << 39;
    sum.rgb[2] = ((uint64_t)1 << 40) - 1;
    ql_film_display(&sum, 1, one, linear);
    CHECK(linear[0] == 0xffffffffu && linear[1] >= 0x7ffffff8u &&
                    linear[1] <= 0x80000000u && linear[2] >= 0xfffffff0u,
            "shown: %lx %lx %lx", (unsigned long)linear[0],
            (unsigned long)linear[1], (unsigned long)linear[2]);
    NOTE("%lu edges, 2^24 samples of 2^15", edges);
}

/* ---- Furnace ----------------------------------------------------------- */

#define UNIT 0.5

static void make_furnace(const double albedo[3], const double emission[3])
{
    static const int32_t low[3] = {384, 384, 384};
    static const int32_t high[3] = {32384, 32384, 32384};
    static const double right[3] = {0.25, 0, -0.125}, up[3] = {0, 0.25, 0};

    mini_begin(&m);
    mini_room(&m, low, high, mini_rgb(&m, albedo, emission));
    mini_eye(&m, 14000, 17000, 12000);
    mini_look(&m, 0.125, 0.0625, 0.25);
    mini_field(&m, right, up);
    mini_open(&m, &scene);
}

static void make_gray_furnace(double albedo)
{
    const double gray[3] = {albedo, albedo, albedo},
                 unit[3] = {UNIT, UNIT, UNIT};

    make_furnace(gray, unit);
}

#if QL_CFG_DIRECT & 8 && QL_CFG_ROULETTE
/* By cosine no sample differs from another, so one is enough. Bounds: a
 * throughput is off by half an ulp of 2^-31 at each of K reflections, and each
 * of K + 1 contributions by half of 2^-24; the albedo by half of 2^-31. */
TEST(case_42_furnace_of_64_bounces_is_the_series_and_1_stays_1)
{
    static const double albedos[] = {0, 0.5, 0.8, 0.9, 0.99, 0.999, 1};
    enum { K = 65 }; /* reflections */
    double worst = 0, at_1 = 0;

    for (unsigned i = 0; i < 7; i++) {
        const double a = albedos[i];
        const double want = a < 1 ? (1 - pow(a, K + 1)) / (1 - a) : K + 1;
        double slack = 0, throughput = 1, error = 0;
        ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 64, 42);
        ql_sum_t sum = {{0, 0, 0}};
        ql_render_t r;
        double got;

        for (unsigned k = 0; k <= K; k++) {
            slack += error * UNIT + 0x1p-25;
            error = error * a + throughput * 0x1p-32 + 0x1p-32;
            throughput *= a;
        }
        s.direct = QL_DIRECT_COSINE;
        make_gray_furnace(a);
        CHECK(ql_render_init(&r, &scene, &s) == QL_OK, "settings");
        ql_render_pixel(&r, 0, 0, 0, 100, &sum);
        got = ldexp((double)sum.rgb[0], -24) / 100;
        CHECK(fabs(got - want * UNIT) <= slack,
                "albedo %g: %.9f, want %.9f within %.1e", a, got / UNIT, want,
                slack / UNIT);
        worst = fmax(worst, fabs(got / UNIT - want) / want);
        at_1 = a < 1 ? at_1 : got / UNIT;
    }
    CHECK(at_1 == K + 1, "albedo 1: %.12f", at_1);
    NOTE("7 albedos; worst %.0e of the series; albedo 1: %.0f exactly", worst,
            at_1);
}

/* ---- Roulette ---------------------------------------------------------- */

/* A room lit by a lamp, of this colour. */
static void make_room(const double albedo[3], const double emission[3])
{
    static const int32_t low[3] = {384, 384, 384};
    static const int32_t high[3] = {32384, 32384, 32384};
    static const int32_t a[3] = {12000, 30000, 12000},
                         b[3] = {20000, 30000, 12000};
    static const int32_t c[3] = {20000, 30000, 20000},
                         d[3] = {12000, 30000, 20000};
    static const double black[3] = {0, 0, 0};

    mini_begin(&m);
    mini_room(&m, low, high, mini_rgb(&m, albedo, black));
    mini_quad(&m, a, b, c, d, mini_rgb(&m, albedo, emission));
    mini_eye(&m, 14000, 17000, 2000);
    mini_look(&m, 0.125, -0.25, 0.25);
    m.radiance_exp = 6;
    mini_open(&m, &scene);
}

/* Moments of each channel of the pixel, by samples. */
static uint32_t measure(const ql_settings_t *s, uint32_t samples,
        stats_moments_t moments[3], ql_sum_t *total)
{
    ql_render_t r;

    memset(moments, 0, 3 * sizeof *moments);
    memset(total, 0, sizeof *total);
    CHECK(ql_render_init(&r, &scene, s) == QL_OK, "settings");
    for (uint32_t i = 0; i < samples; i++) {
        ql_sum_t sum = {{0, 0, 0}};

        ql_render_pixel(&r, 0, 0, i, 1, &sum);
        for (unsigned k = 0; k < 3; k++) {
            stats_add(moments + k, ldexp((double)sum.rgb[k], -24));
            total->rgb[k] += sum.rgb[k];
        }
    }
    CHECK(r.diag.saturated == 0, "%lu saturated",
            (unsigned long)r.diag.saturated);
    return r.diag.closest_rays;
}

static double apart(const stats_moments_t *a, const stats_moments_t *b)
{
    const double variance = stats_variance(a) / a->n + stats_variance(b) / b->n;

    return variance > 0 ? (a->mean - b->mean) / sqrt(variance)
                        : a->mean - b->mean;
}

TEST(case_43_roulette_changes_no_mean_and_no_path_of_albedo_1_dies)
{
    static const double albedos[][3] = {{0.75, 0.75, 0.75}, {1, 0.25, 0},
            {0.1, 0.1, 0.1}, {0x1p-20, 0x1p-20, 0}, {0x1p-31, 0, 0}};
    static const double unit[3] = {1, 1, 1}, white[3] = {1, 1, 1};
    const uint32_t n = MANY(1u << 14);
    double worst = 0;
    uint32_t rays;

    for (unsigned i = 0; i < 5; i++) {
        ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 16, 43);
        stats_moments_t without[3], with[3];
        ql_sum_t total;

        make_room(albedos[i], unit);
        (void)measure(&s, n, without, &total);
        s.roulette = 1;
        s.seed++;
        (void)measure(&s, n, with, &total);
        for (unsigned k = 0; k < 3; k++) {
            const double z = apart(with + k, without + k);

            CHECK(fabs(z) < STATS_Z_MAX, "albedo %g, channel %u: %g and %g",
                    albedos[i][k], k, with[k].mean, without[k].mean);
            worst = fmax(worst, fabs(z));
        }
    }
    /* of another albedo the mean is told apart */
    {
        static const double other[3] = {0.7, 0.7, 0.7};
        const ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 16, 43);
        stats_moments_t a[3], b[3];
        ql_sum_t total;

        make_room(albedos[0], unit);
        (void)measure(&s, n, a, &total);
        make_room(other, unit);
        (void)measure(&s, n, b, &total);
        CHECK(apart(a, b) > STATS_Z_MAX, "0.75 is taken for 0.7: z %.1f",
                apart(a, b));
    }
    /* a chance of 1 is 1: 65 closest-hit rays a path, none fewer, and the same
     * bits as without */
    {
        ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 64, 43);
        stats_moments_t moments[3];
        ql_sum_t with, without;

        make_room(white, unit);
        (void)measure(&s, 512, moments, &without);
        s.roulette = 1;
        rays = measure(&s, 512, moments, &with);
        CHECK(!QL_CFG_DIAG || rays == 65u * 512, "%lu rays of 512 paths",
                (unsigned long)rays);
        CHECK(memcmp(&with, &without, sizeof with) == 0, "other bits");
    }
    NOTE("5 albedos down to 2^-31; worst z %.1f; albedo 1 keeps its bits",
            worst);
}
#endif

/* ---- Less than an ulp -------------------------------------------------- */

/* Sums are 64 bits with 24 fraction bits; what is faint is rounded by chance,
 * so its mean is right however far below an ulp it is. */
TEST(case_44_contributions_below_an_ulp_keep_their_mean)
{
    const ql_uq31_t ulp = 1u << 7; /* 2^-24 as u1.31 */
    static const double rows[] = {0.001, 0.3, 0.49, 0.5, 0.51, 1, 1.49, 1.5};
    const double n = 1e6;
    double third = 0;

    for (unsigned i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const ql_uq31_t value = (ql_uq31_t)(ulp * rows[i] * 65536);
        const double exact = value / (65536.0 * ulp);
        const double fraction = exact - floor(exact);
        const ql_real_t scale = {0x80000000u, -31 - 16};
        ql_diag_t diag = {0};
        uint64_t sum = 0;
        double off;

        for (uint32_t k = 0; k < 1000000; k++) {
            film_add(&sum, value, scale, 0x9e3779b9u * k, &diag);
        }
        off = (double)sum / n - exact;
        CHECK(fabs(off) <= STATS_Z_MAX * sqrt(fraction * (1 - fraction) / n) &&
                        diag.faint == (fraction > 0 ? 1000000 : 0),
                "%g ulp: off by %g, %lu counted", rows[i], off,
                (unsigned long)diag.faint);
        third = i == 1 ? (double)sum / n : third;
    }
    CHECK(fabs(third - 0.3) < 0.0014, "0.3 ulp: %.6f", third);
    NOTE("0.3 ulp 10^6 times is %.4f", third);
}

/* What that means for a picture: the light of a lamp is not lost, however much
 * brighter another one is. Measured against one of the unit. */
TEST(case_44_lamps_2_to_24_dimmer_than_the_brightest_keep_their_light)
{
    static const double up[3] = {0.6, 0.6, 0.6};
    static const int32_t a[3] = {8000, 8000, 8000}, b[3] = {24000, 8000, 8000};
    static const int32_t c[3] = {24000, 24000, 8000},
                         d[3] = {8000, 24000, 8000};
    static const int32_t e[3] = {8000, 8000, 20000},
                         f[3] = {24000, 8000, 20000};
    static const int32_t g[3] = {24000, 24000, 20000};
    static const int32_t h[3] = {8000, 24000, 20000};
    static const int dim[] = {0, 8, 16, 20, 24};
    const ql_settings_t s = estimate_settings(QL_SAMPLER_SOBOL, 0, 44);
    double bright = 0, lost[5] = {0, 0, 0, 0, 0};

    for (unsigned i = 0; i < 5; i++) {
        const double radiance = ldexp(0.7, -dim[i]);
        const double emission[3] = {radiance, radiance, radiance};
        const double black[3] = {0, 0, 0};
        stats_moments_t got;

        mini_begin(&m);
        mini_quad(&m, a, b, c, d, mini_rgb(&m, up, black));
        mini_quad(&m, e, h, g, f, mini_rgb(&m, black, emission));
        mini_eye(&m, 16003, 16001, 9000);
        mini_look(&m, 0, 0, -0.5);
        got = estimate_pixel(&m, &s, 0, 0, 1u << 12);
        bright = i == 0 ? got.mean : bright;
        lost[i] = 1 - got.mean / ldexp(bright, -dim[i]);
        /* an ulp of 2^-31 of the product before the sum, times a geometry term
         * below 1; then half an ulp of 2^-24 by chance, 2^12 times */
        CHECK(fabs(lost[i]) * ldexp(bright, -dim[i]) <=
                        0x1p-31 + STATS_Z_MAX * 0x1p-25 / 64,
                "2^-%d: %.4f lost", dim[i], lost[i]);
    }
    NOTE("of 2^-8 %.0e, 2^-16 %.0e, 2^-20 %.0e, 2^-24 %.3f of it", lost[1],
            lost[2], lost[3], lost[4]);
}

/* ---- Channels ---------------------------------------------------------- */

/* Each channel is the picture of a gray scene of that channel, bit for bit:
 * nothing of one leaks into another, whatever the others are. */
TEST(case_53_channels_of_0_and_of_the_most_are_independent)
{
    static const double albedo[3] = {0, 0.5, 1};
    static const double emission[3] = {0.999, 0, 0.25};
    const ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 6, 53);
    ql_sum_t colour = {{0, 0, 0}};
    ql_render_t r;

    /* walls that all shine in one channel at least, so all are lights */
    make_furnace(albedo, emission);
    m.radiance_exp = 0;
    CHECK(ql_render_init(&r, &scene, &s) == QL_OK, "settings");
    ql_render_pixel(&r, 0, 0, 0, 2000, &colour);
    CHECK(colour.rgb[1] == 0, "a channel without emission: %llu",
            (unsigned long long)colour.rgb[1]);
    for (unsigned k = 0; k < 3; k += 2) {
        const double gray[3] = {albedo[k], albedo[k], albedo[k]};
        const double light[3] = {emission[k], emission[k], emission[k]};
        ql_sum_t alone = {{0, 0, 0}};

        make_furnace(gray, light);
        CHECK(ql_render_init(&r, &scene, &s) == QL_OK, "settings");
        ql_render_pixel(&r, 0, 0, 0, 2000, &alone);
        CHECK(alone.rgb[0] == colour.rgb[k] && alone.rgb[1] == alone.rgb[0] &&
                        alone.rgb[2] == alone.rgb[0],
                "channel %u: %llu, alone %llu", k,
                (unsigned long long)colour.rgb[k],
                (unsigned long long)alone.rgb[0]);
    }
#if QL_CFG_ROULETTE
    /* roulette goes by the largest channel: each one's mean stays */
    {
        ql_settings_t with = s;
        stats_moments_t a[3], b[3];
        const double mixed[3] = {0, 0.3, 0.9}, light[3] = {0.9, 0.9, 0.01};
        ql_sum_t total;

        make_room(mixed, light);
        (void)measure(&s, 1u << 14, a, &total);
        with.roulette = 1;
        with.seed++;
        (void)measure(&with, 1u << 14, b, &total);
        for (unsigned k = 0; k < 3; k++) {
            CHECK(fabs(apart(a + k, b + k)) < STATS_Z_MAX,
                    "channel %u: %g, by roulette %g", k, a[k].mean, b[k].mean);
        }
    }
#endif
    NOTE("3 channels bit for bit as alone; equal means by roulette");
}

/* ---- Running means ----------------------------------------------------- */

/* A mean that is updated in place freezes or drifts; a sum has every sample. */
TEST(case_54_200000_samples_of_chance_a_quarter_are_all_in_the_mean)
{
    static const uint32_t looks[] = {1000, 10000, 100000, 200000};
    ql_diag_t diag = {0};
    ql_sum_t sum = {{0, 0, 0}};
    uint64_t state = 54;
    uint32_t count = 0, look = 0;
    double worst = 0;

    for (uint32_t i = 1; i <= 200000; i++) {
        const bool hit = stats_random_below(&state, 4) == 0;

        count += hit;
        film_add(&sum.rgb[0], hit ? QL_UQ31_ONE : 0, one, 0, &diag);
        if (i == looks[look]) {
            ql_uq16_t linear[3];
            double mean, z;

            ql_film_display(&sum, i, one, linear);
            mean = linear[0] / 65536.0;
            z = (mean - 0.25) / sqrt(0.1875 / i);
            CHECK(fabs(mean - (double)count / i) <= 0x1p-17 + 1e-8,
                    "%lu samples: mean %.6f of %lu hits", (unsigned long)i,
                    mean, (unsigned long)count);
            CHECK(fabs(z) < 5, "%lu samples: %.5f, z %.1f", (unsigned long)i,
                    mean, z);
            worst = fmax(worst, fabs(z));
            look++;
        }
    }
    CHECK(sum.rgb[0] == (uint64_t)count << QL_SUM_BITS, "%llu of %lu hits",
            (unsigned long long)sum.rgb[0], (unsigned long)count);
    NOTE("10^3 to 2 10^5 samples; worst z %.1f; the sum is the count", worst);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("extreme/sums", argc, argv);
    RUN(case_40_1_to_2_to_24_samples_of_a_constant_are_the_constant);
    RUN(case_41_sums_saturate_at_their_ends_are_counted_and_never_wrap);
#if QL_CFG_DIRECT & 8 && QL_CFG_ROULETTE
    RUN(case_42_furnace_of_64_bounces_is_the_series_and_1_stays_1);
    RUN(case_43_roulette_changes_no_mean_and_no_path_of_albedo_1_dies);
#endif
    RUN(case_44_contributions_below_an_ulp_keep_their_mean);
    RUN(case_44_lamps_2_to_24_dimmer_than_the_brightest_keep_their_light);
    RUN(case_53_channels_of_0_and_of_the_most_are_independent);
    RUN(case_54_200000_samples_of_chance_a_quarter_are_all_in_the_mean);
    return TEST_END();
}
