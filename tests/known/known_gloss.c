/* known_gloss.c - Phong, mirror, glass and smooth normals against their sums */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <stdlib.h>

#include "support/picture/estimate.h"
#include "support/ql_double.h"
#include "support/ql_test.h"
#include "qlux.h"

#define SKY 0.5 /* radiance of what shines */

/* What the last bit of a sum is worth, radiance units. */
#define BIT ldexp(1, -QL_SUM_BITS)

static mini_scene_t m;

static ql_settings_t settings_of(int strategy, uint8_t bounces)
{
    ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, bounces, 41);

    s.direct = strategies[strategy].direct;
    return s;
}

/* Standard errors off, plus rounding: the last bits of sums and directions. */
static double off_by(const stats_moments_t *got, double want)
{
    return (got->mean - want) /
           (sqrt(stats_variance(got) / got->n) +
                   (BIT + ldexp(1, -QL_DIR_BITS)) / STATS_Z_MAX);
}

/* ---- One point of a plane, seen at an angle ------------------------------ */

static const int32_t at[3] = {16384, 16384, 16384};

static void look_from(double degrees, double away)
{
    const double turn = degrees * PI / 180;

    mini_eye(&m, at[0] + away * sin(turn), at[1], at[2] + away * cos(turn));
    mini_look(&m, -sin(turn) / 2, 0, -cos(turn) / 2);
}

/* A small plane of the first material. */
static void begin_plane(double albedo, ql_gloss_kind_t kind, double specular,
        double parameter, double degrees)
{
    static const int32_t a[3] = {16134, 16134, 16384};
    static const int32_t b[3] = {16634, 16134, 16384};
    static const int32_t c[3] = {16634, 16634, 16384};
    static const int32_t d[3] = {16134, 16634, 16384};
    const uint16_t material = (mini_begin(&m), mini_material(&m, albedo, 0));

    mini_gloss(&m, material, kind, specular, parameter);
    mini_quad(&m, a, b, c, d, material);
    look_from(degrees, 64);
}

/* ---- Phong --------------------------------------------------------------- */

enum { ANGLES = 8, POWERS = 5 };
static const double angles[ANGLES] = {0, 30, 45, 60, 75, 80, 85, 89};

/* What the lobe reflects of Ks at each angle. */
static const struct {
    double power, albedo[ANGLES];
} lobes[POWERS] = {{1, {1, .8808427796, .7554091649, .6089977810, .4584415161,
                               .4099452536, .3630974852, .3270845671}},
        {5, {1, .8662535765, .7103933491, .5194068355, .3271321791, .2692908026,
                    .2165609213, .1786207365}},
        {20, {1, .8660254050, .7071102788, .5005094980, .2711785286,
                     .2003418687, .1382931375, .0970929429}},
        {100, {1, .8660254038, .7071067812, .5000000006, .2589453621,
                      .1752326235, .0976133604, .0491253640}},
        {1000, {1, .8660254038, .7071067812, .5, .2588190451, .1736481778,
                       .0871830044, .0232122927}}};

/* Of samples of a lobe of power n under the sky: the largest, and the mean of
 * their squares, which is at most the mean times n + 2 over n + 1 and
 *
 *   (n + 2) / 2    the largest by uniform directions, but for their cosine
 *   (n + 2) / 4    by cosine directions, which points of the sky are too
 *   2              by both a point and a ray of the lobe, MIS
 *
 * as cos^2n integrates to 2 pi / (2 n + 2). Large values are so rare that
 * samples need not have seen them. */
static double lobe_limit(int strategy, double n, double albedo, double samples)
{
    const double wide = (n + 2) / (n + 1);
    const double most = strategy == HEMISPHERE ? n + 2
                        : strategy == MIS      ? 2 * wide
                                               : (n + 2) / 2;
    const double square = strategy == HEMISPHERE ? wide * (n + 2) / 2
                          : strategy == MIS      ? 2 * wide
                                                 : wide * (n + 2) / 4;

    return SKY * stats_mean_limit(POWERS * ANGLES * (STRATEGIES - 1), samples,
                         albedo, most, square * albedo) +
           BIT + ldexp(1, -QL_DIR_BITS);
}

/* As many samples as the lobe is narrow, but no more by MIS. */
static uint32_t lobe_samples(int strategy, double n)
{
    return strategy == MIS || n < 50 ? 1u << 12 : n < 500 ? 1u << 15 : 1u << 17;
}

TEST(lobe_under_a_white_sky_reflects_its_albedo_at_every_angle)
{
    double worst = 0;
    int silent = 0;

    for (int i = 0; i < POWERS * ANGLES * STRATEGIES; i++) {
        const int k = i % STRATEGIES, angle = i / STRATEGIES % ANGLES;
        const int power = i / STRATEGIES / ANGLES;
        const double n = lobes[power].power,
                     albedo = lobes[power].albedo[angle];
        const uint32_t samples = lobe_samples(k, n);
        const double limit = lobe_limit(k, n, albedo, samples);
        const ql_settings_t s = settings_of(k, 0);
        stats_moments_t got;
        double off;

        if (k == SOLID_ANGLE) {
            continue; /* of a constant sky that is area */
        }
        if (limit >= albedo * SKY) {
            silent++; /* so few samples say nothing */
            continue;
        }
        begin_plane(0, QL_GLOSS_PHONG, 1, n, angles[angle]);
        mini_sky(&m, SKY, SKY, SKY);
        got = estimate_pixel(&m, &s, 0, 0, samples);
        off = fabs(got.mean - albedo * SKY) / limit;
        CHECK(off < 1, "n %g, %g degrees, %s: %.6f, want %.6f, limit %.6f", n,
                angles[angle], strategies[k].name, got.mean, albedo * SKY,
                limit);
        worst = fmax(worst, off);
    }
    CHECK(silent <= 16, "%d say nothing", silent);
    NOTE("%d powers, %d angles, 4 strategies, %d too rare; worst %.2f of limit",
            POWERS, ANGLES, silent, worst);
}

/* (n + 1) for (n + 2), and a plain diffuse 1: by twice the limit. */
TEST(lobe_rejects_a_wrong_normalisation_and_no_lobe_at_all)
{
    enum { SAMPLES = 1 << 17 };
    double nearest = INFINITY;

    for (int k = 0; k < STRATEGIES; k++) {
        const double n = 5, albedo = .5194068355;
        const double limit =
                lobe_limit(k == SOLID_ANGLE ? AREA : k, n, albedo, SAMPLES);
        const ql_settings_t s = settings_of(k, 0);
        stats_moments_t got;

        begin_plane(0, QL_GLOSS_PHONG, 1, n, 60);
        mini_sky(&m, SKY, SKY, SKY);
        got = estimate_pixel(&m, &s, 0, 0, SAMPLES);
        nearest = fmin(nearest,
                fabs(got.mean - albedo * SKY * (n + 1) / (n + 2)) / limit);
        nearest = fmin(nearest, fabs(got.mean - SKY) / limit);
    }
    CHECK(nearest > 2, "%.2f of the limit", nearest);
    NOTE("%.1f of the limit", nearest);
}

TEST(lobe_and_diffuse_part_add_up)
{
    double worst = 0;

    for (int i = 0; i < STRATEGIES * 3; i++) {
        const ql_settings_t s = settings_of(i % STRATEGIES, 0);
        const int angle = 2 * (i / STRATEGIES);
        const double want = (0.4 + 0.5 * lobes[2].albedo[angle]) * SKY;
        stats_moments_t got;
        double z;

        begin_plane(0.4, QL_GLOSS_PHONG, 0.5, 20, angles[angle]);
        mini_sky(&m, SKY, SKY, SKY);
        got = estimate_pixel(&m, &s, 0, 0, 1u << 16);
        z = off_by(&got, want);
        CHECK(fabs(z) < stats_z_limit(3 * STRATEGIES),
                "%g degrees, %s: %.6f, want %.6f, z %.1f", angles[angle],
                strategies[i % STRATEGIES].name, got.mean, want, z);
        worst = fmax(worst, fabs(z));
    }
    NOTE("worst z %.1f", worst);
}

/* Around the plane a sphere that shines 1 and reflects a half: after another
 * reflection it shines 1.5 everywhere but for what the small plane hides. */
TEST(lobe_reflects_indirect_light_alike_by_every_density)
{
    static const int powers[] = {0, 2, 3}, at_angles[] = {0, 2, 4};
    static const int32_t centre[3] = {16384 * 256, 16384 * 256, 16384 * 256};
    double worst = 0;

    for (int i = 0; i < 9 * STRATEGIES * 3; i++) {
        const int power = powers[i / (9 * STRATEGIES)];
        const int angle = at_angles[i / (3 * STRATEGIES) % 3];
        const double want = lobes[power].albedo[angle] * SKY * 1.5;
        ql_settings_t s = settings_of(i / 3 % STRATEGIES, 1);
        stats_moments_t got;
        double z;

        s.indirect = (uint8_t)(i % 3 + QL_INDIRECT_COSINE);
        begin_plane(0, QL_GLOSS_PHONG, 1, lobes[power].power, angles[angle]);
        (void)mini_sphere(&m, centre, 15000 * 256, mini_material(&m, 0.5, SKY));
        m.two_sided = true;
        got = estimate_pixel(&m, &s, 0, 0, 1u << 13);
        z = off_by(&got, want);
        CHECK(fabs(z) < stats_z_limit(9 * STRATEGIES * 3),
                "n %g, %g degrees, %s, indirect %d: %.6f, want %.6f, z %.1f",
                lobes[power].power, angles[angle],
                strategies[i / 3 % STRATEGIES].name, s.indirect, got.mean, want,
                z);
        worst = fmax(worst, fabs(z));
    }
    NOTE("3 powers, 3 angles, 15 ways, worst z %.1f", worst);
}

/* ---- Mirrors ------------------------------------------------------------- */

TEST(mirror_reflects_a_lamp_and_the_sky_exactly)
{
    static const int32_t lamp[4][3] = {{9000, 13000, 20000},
            {9000, 20000, 20000}, {15000, 20000, 20000}, {15000, 13000, 20000}};

    for (int i = 0; i < 2 * STRATEGIES; i++) {
        const ql_settings_t s = settings_of(i / 2, 0);
        const double radiance = i % 2 ? 0.75 : SKY;
        stats_moments_t got;

        begin_plane(0, QL_GLOSS_MIRROR, 0.625, 0, 45);
        mini_sky(&m, SKY, SKY, SKY);
        if (i % 2) {
            mini_quad(&m, lamp[0], lamp[1], lamp[2], lamp[3],
                    mini_material(&m, 0, radiance));
        }
        got = estimate_pixel(&m, &s, 0, 0, 100);
        CHECK(got.m2 == 0 && got.mean == 0.625 * radiance,
                "%s: %.9f, want %.9f", strategies[i / 2].name, got.mean,
                0.625 * radiance);
    }
}

/* Two mirrors 2000 apart, at 45 degrees: a reflection every 2000. */
static void make_corridor(double specular)
{
    static const int32_t low[4][3] = {{2000, 14000, 10000},
            {22000, 14000, 10000}, {22000, 18000, 10000}, {2000, 18000, 10000}};
    static const int32_t high[4][3] = {{2000, 14000, 12000},
            {2000, 18000, 12000}, {22000, 18000, 12000}, {22000, 14000, 12000}};
    static const int32_t lamp[4][3] = {{23000, 12000, 8000},
            {23000, 12000, 14000}, {23000, 20000, 14000}, {23000, 20000, 8000}};
    const uint16_t mirror = (mini_begin(&m), mini_material(&m, 0, 0));

    mini_gloss(&m, mirror, QL_GLOSS_MIRROR, specular, 0);
    mini_quad(&m, low[0], low[1], low[2], low[3], mirror);
    mini_quad(&m, high[0], high[1], high[2], high[3], mirror);
    mini_quad(
            &m, lamp[0], lamp[1], lamp[2], lamp[3], mini_material(&m, 0, SKY));
    /* meets the mirrors at x = 3000, 5000, ... 21000: ten times */
    mini_eye(&m, 2000, 16000, 11000);
    mini_look(&m, 0.5, 0, -0.5);
}

TEST(facing_mirrors_reflect_ten_times_and_every_one_needs_a_bounce)
{
    for (int k = 0; k < STRATEGIES; k++) {
        const ql_settings_t enough = settings_of(k, 9), few = settings_of(k, 8);
        stats_moments_t got;

        make_corridor(0.875);
        got = estimate_pixel(&m, &enough, 0, 0, 10);
        CHECK(got.m2 == 0 && fabs(got.mean - SKY * pow(0.875, 10)) < BIT,
                "%s: %.9f, want %.9f", strategies[k].name, got.mean,
                SKY * pow(0.875, 10));
        CHECK(fabs(got.mean - SKY * pow(0.875, 9)) > BIT, "nine pass");
        got = estimate_pixel(&m, &few, 0, 0, 10);
        CHECK(got.mean == 0, "%s: %.9f one bounce early", strategies[k].name,
                got.mean);
    }
}

TEST(mirror_with_a_diffuse_part_reflects_both_under_a_white_sky)
{
    double worst = 0;

    for (int i = 0; i < 3 * 3 * STRATEGIES; i++) {
        ql_settings_t s =
                settings_of(i % STRATEGIES, (uint8_t)(i / STRATEGIES % 3));
        stats_moments_t got;
        double z;

        s.indirect = (uint8_t)(i / (3 * STRATEGIES) + QL_INDIRECT_COSINE);
        begin_plane(0.3, QL_GLOSS_MIRROR, 0.5, 0, 60);
        mini_sky(&m, SKY, SKY, SKY);
        got = estimate_pixel(&m, &s, 0, 0, 1u << 14);
        z = off_by(&got, 0.8 * SKY);
        CHECK(fabs(z) < stats_z_limit(9 * STRATEGIES) &&
                        fabs(off_by(&got, 0.5 * SKY)) > 20 &&
                        fabs(off_by(&got, 1.1 * SKY)) > 20,
                "%s, indirect %d, %d bounces: %.6f, want %.6f, z %.1f",
                strategies[i % STRATEGIES].name, s.indirect, s.bounces,
                got.mean, 0.8 * SKY, z);
        worst = fmax(worst, fabs(z));
    }
    NOTE("worst z %.1f", worst);
}

/* ---- Glass --------------------------------------------------------------- */

/* Fresnel's reflectance, the mean of both polarisations. */
static double fresnel(double cosine, double index)
{
    const double sine = sqrt(1 - cosine * cosine) / index;
    const double inside = sqrt(1 - sine * sine);
    const double across = (cosine - index * inside) / (cosine + index * inside);
    const double along = (index * cosine - inside) / (index * cosine + inside);

    return (across * across + along * along) / 2;
}

/* A box whose upper face holds the point that is looked at; fronts outward. */
static void make_slab(double tint, double index, double degrees, double away)
{
    static const uint8_t faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5},
            {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    const uint16_t glass = (mini_begin(&m), mini_material(&m, 0, 0));
    uint16_t v[8];

    mini_gloss(&m, glass, QL_GLOSS_GLASS, tint, index);
    for (int i = 0; i < 8; i++) {
        v[i] = mini_vertex(&m, at[0] + (i & 1 ? 9000 : -9000),
                at[1] + (i & 2 ? 9000 : -9000), at[2] - (i & 4 ? 0 : 3000));
    }
    for (int f = 0; f < 6; f++) {
        mini_face(&m, v[faces[f][0]], v[faces[f][1]], v[faces[f][2]], glass);
        mini_face(&m, v[faces[f][0]], v[faces[f][2]], v[faces[f][3]], glass);
    }
    mini_sky(&m, SKY, SKY, SKY);
    look_from(degrees, away);
}

static void make_marble(double index)
{
    static const int32_t centre[3] = {16384 * 256, 16384 * 256, 16384 * 256};
    static const double right[3] = {5500, 0, 0}, up[3] = {0, 5500, 0};
    const uint16_t glass = (mini_begin(&m), mini_material(&m, 0, 0));

    mini_gloss(&m, glass, QL_GLOSS_GLASS, 1, index);
    (void)mini_sphere(&m, centre, 5000 * 256, glass);
    mini_sky(&m, SKY, SKY, SKY);
    mini_eye(&m, at[0], at[1], at[2] + 9000);
    mini_look(&m, 0, 0, -0.5);
    mini_window(&m, right, up);
}

/* Samples that are not the sky itself to two bits of a sum: weights into and
 * out of glass are reciprocal to 2^-30. */
static unsigned count_wrong(int strategy, uint32_t samples)
{
    const ql_settings_t s = settings_of(strategy, 64);
    ql_scene_t scene;
    ql_render_t render;
    unsigned wrong = 0;

    mini_open(&m, &scene);
    CHECK(ql_render_init(&render, &scene, &s) == QL_OK, "settings");
    for (uint32_t i = 0; i < samples; i++) {
        ql_sum_t sum = {{0, 0, 0}};

        ql_render_pixel(&render, 0, 0, i, 1, &sum);
        wrong += fabs(ldexp((double)sum.rgb[0], -QL_SUM_BITS) - SKY) > 2 * BIT;
    }
    return wrong;
}

/* Chances are exact, so every path of any length has the sky's radiance. */
TEST(clear_glass_under_a_white_sky_cannot_be_seen)
{
    static const double indices[] = {1.5, 1.33, 2.4, 1, 0.75};
    unsigned wrong = 0, paths = 0;

    for (int i = 0; i < 5 * STRATEGIES; i++) {
        const int k = i % STRATEGIES;
        const double index = indices[i / STRATEGIES];

        for (int degrees = 0; degrees <= 80; degrees += 20) {
            make_slab(1, index, degrees, 64);
            wrong += count_wrong(k, 500);
            paths += 500;
        }
        CHECK(wrong == 0, "slab of index %g, %s: %u of %u paths", index,
                strategies[k].name, wrong, paths);
        make_marble(index);
        wrong += count_wrong(k, 4000);
        paths += 4000;
        CHECK(wrong == 0, "ball of index %g, %s: %u of %u paths", index,
                strategies[k].name, wrong, paths);
    }
    NOTE("%u paths, %u off by more than two bits", paths, wrong);
}

TEST(tinted_slab_is_seen)
{
    make_slab(0.9, 1.5, 20, 64);
    CHECK(count_wrong(AREA, 500) > 300, "as if it were clear");
}

/* A ray that enters is not followed: what comes back is one reflection. */
TEST(glass_reflects_as_often_as_fresnel_says)
{
    static const double degrees[] = {0, 45, 60, 80};
    const uint32_t n = 1u << 18;
    double worst = 0;

    for (int i = 0; i < 4; i++) {
        const double cosine = cos(degrees[i] * PI / 180);
        const double want = fresnel(cosine, 1.5);
        const double schlick = 0.04 + 0.96 * pow(1 - cosine, 5);
        const ql_settings_t s = settings_of(i % STRATEGIES, 0);
        stats_moments_t got;
        double error, z;

        make_slab(1, 1.5, degrees[i], 64);
        got = estimate_pixel(&m, &s, 0, 0, n);
        got.mean /= SKY;
        /* a direction's last bit moves it by up to 3 times as much */
        error = sqrt(want * (1 - want) / n) + 3 * ldexp(1, -QL_DIR_BITS) / 5;
        z = (got.mean - want) / error;
        CHECK(fabs(z) < STATS_Z_MANY, "%g degrees: %.6f, want %.6f, z %.1f",
                degrees[i], got.mean, want, z);
        CHECK(i == 0 || fabs(got.mean - schlick) > STATS_Z_MAX * error,
                "%g degrees: Schlick's %.6f passes for %.6f", degrees[i],
                schlick, want);
        worst = fmax(worst, fabs(z));
    }
    NOTE("4 angles, 2^18 each, worst z %.1f; Schlick's formula is rejected",
            worst);
}

/* From within: all is reflected beyond 41.8 degrees; before, what leaves is
 * n^2 times as bright. */
TEST(glass_reflects_all_from_within_beyond_the_critical_angle)
{
    for (int degrees = 0; degrees <= 80; degrees += 10) {
        const double cosine = cos(degrees * PI / 180);
        const double sine_out = 1.5 * sin(degrees * PI / 180);
        const ql_settings_t s = settings_of(degrees / 10 % STRATEGIES, 0);
        double chance = 0;
        stats_moments_t got;

        make_slab(1, 1.5, 180 - degrees, 1000);
        m.radiance_exp = 2;
        got = estimate_pixel(&m, &s, 0, 0, 1u << 14);
        if (sine_out < 1) {
            chance = 1 - fresnel(sqrt(1 - sine_out * sine_out), 1.5);
        }
        CHECK(fabs(got.mean / (2.25 * SKY) - chance) <=
                        STATS_Z_MAX * sqrt(chance * (1 - chance) / got.n) +
                                (chance > 0) * 1e-4,
                "%d degrees (cosine %.4f): %.6f, want %.6f", degrees, cosine,
                got.mean / (2.25 * SKY), chance);
    }
    NOTE("9 angles; exactly 0 from 50 degrees on");
}

/* ---- Smooth normals ------------------------------------------------------ */

enum { RADIUS = 9000, PARTS = 6 };

static uint16_t point_on_ball(const double v[3], double side)
{
    const double size = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    const double n[3] = {
            side * v[0] / size, side * v[1] / size, side * v[2] / size};
    const uint16_t i =
            mini_vertex(&m, at[0] + (int32_t)lround(RADIUS * v[0] / size),
                    at[1] + (int32_t)lround(RADIUS * v[1] / size),
                    at[2] + (int32_t)lround(RADIUS * v[2] / size));

    mini_normal(&m, i, n);
    return i;
}

/* A face of an octahedron, blown up, fronts outward. */
static void blow_up(const double corner[3][3], uint16_t material)
{
    uint16_t row[2][PARTS + 1];

    for (int i = 0; i <= PARTS; i++) {
        for (int j = 0; j <= i; j++) {
            double v[3];

            for (int k = 0; k < 3; k++) {
                v[k] = corner[0][k] * (PARTS - i) + corner[1][k] * (i - j) +
                       corner[2][k] * j;
            }
            row[i & 1][j] = point_on_ball(v, 1);
        }
        for (int j = 0; i > 0 && j < i; j++) {
            const uint16_t *const above = row[(i - 1) & 1];
            const uint16_t *const below = row[i & 1];

            mini_face(&m, above[j], below[j], below[j + 1], material);
            if (j + 1 < i) {
                mini_face(&m, above[j], below[j + 1], above[j + 1], material);
            }
        }
    }
}

static void add_smooth_ball(uint16_t material)
{
    for (int octant = 0; octant < 8; octant++) {
        const double x = octant & 1 ? -1 : 1, y = octant & 2 ? -1 : 1;
        const double z = octant & 4 ? -1 : 1;
        const bool odd = x * y * z < 0;
        const double corner[3][3] = {{x, 0, 0}, {0, odd ? 0 : y, odd ? z : 0},
                {0, odd ? y : 0, odd ? 0 : z}};

        blow_up(corner, material);
    }
}

/* The darkest and the brightest pixel whose middle and corners see the ball. */
static void extremes_of_ball(int strategy, double *least, double *most)
{
    enum { PIXELS = 24, SAMPLES = 600 };
    const ql_settings_t s = settings_of(strategy, 0);
    ql_scene_t scene;
    ql_render_t render;

    m.width = m.height = PIXELS;
    *least = HUGE_VAL;
    *most = 0;
    mini_open(&m, &scene);
    CHECK(ql_render_init(&render, &scene, &s) == QL_OK, "settings");
    for (int i = 0; i < PIXELS * PIXELS; i++) {
        const double x = fabs(i % PIXELS - (PIXELS - 1) / 2.0) + 0.5;
        const double y = fabs(i / PIXELS - (PIXELS - 1) / 2.0) + 0.5;
        ql_sum_t sum = {{0, 0, 0}};
        double value;

        /* of a polyhedron in a sphere: a fortieth less */
        if (sqrt(x * x + y * y) * 2 / PIXELS * 10000 > RADIUS * 0.975) {
            continue;
        }
        ql_render_pixel(&render, (uint16_t)(i % PIXELS), (uint16_t)(i / PIXELS),
                0, SAMPLES, &sum);
        value = ldexp((double)sum.rgb[0], -QL_SUM_BITS) / SAMPLES;
        *least = fmin(*least, value);
        *most = fmax(*most, value);
    }
}

static void make_smooth_ball(double albedo, double specular, double power)
{
    static const double right[3] = {10000, 0, 0}, up[3] = {0, 10000, 0};
    const uint16_t material = (mini_begin(&m), mini_material(&m, albedo, 0));

    if (specular > 0) {
        mini_gloss(&m, material, power > 0 ? QL_GLOSS_PHONG : QL_GLOSS_MIRROR,
                specular, power);
    }
    add_smooth_ball(material);
    mini_sky(&m, SKY, SKY, SKY);
    mini_eye(&m, at[0], at[1], at[2] + 12000);
    mini_look(&m, 0, 0, -0.5);
    mini_window(&m, right, up);
}

/* A cosine lobe tilted by d against the plane loses 1 - (1 + cos d)/2 to what
 * is below it: 1 % at the 12 degrees that corners are off here. Four standard
 * errors of 600 samples: 1.6 % by cosine, 9.4 % by uniform directions. */
TEST(smooth_ball_under_a_white_sky_has_no_dark_rim)
{
    double darkest = 1;

    for (int k = 0; k < STRATEGIES; k++) {
        double least, most;

        make_smooth_ball(1, 0, 0);
        extremes_of_ball(k, &least, &most);
        CHECK(least > SKY * (k == HEMISPHERE || k == MIS ? 0.88 : 0.97) &&
                        most < SKY * (k == HEMISPHERE || k == MIS ? 1.1
                                                                  : 1.0001),
                "%s: pixels from %.4f to %.4f of the sky", strategies[k].name,
                least / SKY, most / SKY);
        darkest = fmin(darkest, least / SKY);
        /* a mirror's direction is turned up: nothing is lost */
        make_smooth_ball(0, 1, 0);
        extremes_of_ball(k, &least, &most);
        CHECK(least == SKY && most == SKY,
                "mirror, %s: pixels from %.4f to %.4f", strategies[k].name,
                least / SKY, most / SKY);
    }
    NOTE("darkest pixel %.3f of the sky", darkest);
}

/* All corners of the small plane turned alike: it reflects what a plane with
 * that normal would. A unit square at height 1 is seen by the one and the other
 * as the known two form factors; an ulp of height moves them by 2 of its parts
 * of the distance. */
TEST(turned_normals_reflect_as_a_turned_plane_would)
{
    static const int32_t lamp[4][3] = {{12384, 12384, 24384},
            {12384, 20384, 24384}, {20384, 20384, 24384},
            {20384, 12384, 24384}};
    static const double turned[3] = {0.6, 0, 0.8}, straight[3] = {0, 0, 0.5};
    static const double form_factors[] = {
            0.2394564704607735, 0.1915651763686188};
    double worst = 0;

    for (int i = 0; i < 2 * STRATEGIES; i++) {
        const ql_settings_t s = settings_of(i / 2, 0);
        const double want = form_factors[i % 2] * SKY;
        stats_moments_t got;
        double z;

        begin_plane(1, QL_GLOSS_PHONG, 0, 1, 0);
        m.materials[0].gloss = 0; /* diffuse */
        for (uint16_t v = 0; v < 4; v++) {
            mini_normal(&m, v, i % 2 ? turned : straight);
        }
        mini_quad(&m, lamp[0], lamp[1], lamp[2], lamp[3],
                mini_material(&m, 0, SKY));
        got = estimate_pixel(&m, &s, 0, 0, 1u << 17);
        z = (got.mean - want) /
            (sqrt(stats_variance(&got) / got.n) +
                    4.0 / (1 << QL_POS_BITS) / 8000 * want / STATS_Z_MAX);
        CHECK(fabs(z) < STATS_Z_MANY, "%s, turned %d: %.7f, want %.7f, z %.1f",
                strategies[i / 2].name, i % 2, got.mean, want, z);
        CHECK(fabs(off_by(&got, form_factors[1 - i % 2] * SKY)) > STATS_Z_MAX,
                "%s: the other normal passes", strategies[i / 2].name);
        worst = fmax(worst, fabs(z));
    }
    NOTE("worst z %.1f", worst);
}

static uint16_t white_material(bool gloss)
{
    const uint16_t white = mini_material(&m, 0.5, 0);

    if (gloss) {
        mini_gloss(&m, white, QL_GLOSS_PHONG, 0.5, 10);
    }
    return white;
}

static void light_outside(void)
{
    static const int32_t lamp[4][3] = {{2000, 2000, 30000},
            {2000, 30000, 30000}, {30000, 30000, 30000}, {30000, 2000, 30000}};

    mini_quad(
            &m, lamp[0], lamp[1], lamp[2], lamp[3], mini_material(&m, 0, SKY));
    mini_sky(&m, SKY, SKY, SKY);
    mini_eye(&m, at[0] + 1000, at[1] - 2000, at[2] + 500);
    mini_look(&m, 0.25, 0.125, 0.5);
}

/* Normals of a cube's corners, 55 degrees off every face: light that they would
 * let in from behind does not come. */
TEST(smooth_cube_lets_no_light_in)
{
    static const int32_t low[3] = {8384, 8384, 8384};
    static const int32_t high[3] = {24384, 24384, 24384};

    for (int i = 0; i < 2 * STRATEGIES; i++) {
        ql_settings_t s = settings_of(i / 2, 8);

        mini_begin(&m);
        mini_room(&m, low, high, white_material(i % 2 != 0));
        for (uint16_t v = 0; v < 8; v++) {
            const double n[3] = {
                    v & 1 ? -0.5 : 0.5, v & 2 ? -0.5 : 0.5, v & 4 ? -0.5 : 0.5};

            mini_normal(&m, v, n);
        }
        light_outside();
        s.indirect = (uint8_t)(i % 3 + QL_INDIRECT_COSINE);
        CHECK(estimate_brightest(&m, &s, 6000) == 0, "%s, gloss %d: light",
                strategies[i / 2].name, i % 2);
    }
    NOTE("9 reflections, exactly 0");
}

/* Where planes meet at any angle. */
TEST(smooth_ball_lets_no_light_in)
{
    for (int i = 0; i < 2 * STRATEGIES; i++) {
        ql_settings_t s = settings_of(i / 2, 8);

        mini_begin(&m);
        m.contact = true;
        add_smooth_ball(white_material(i % 2 != 0));
        light_outside();
        s.indirect = (uint8_t)(i % 3 + QL_INDIRECT_COSINE);
        CHECK(estimate_brightest(&m, &s, 6000) == 0, "%s, gloss %d: light",
                strategies[i / 2].name, i % 2);
    }
    NOTE("9 reflections, exactly 0");
}

int main(int argc, char **argv)
{
    TEST_BEGIN("known/gloss", argc, argv);
    RUN(lobe_under_a_white_sky_reflects_its_albedo_at_every_angle);
    RUN(lobe_rejects_a_wrong_normalisation_and_no_lobe_at_all);
    RUN(lobe_and_diffuse_part_add_up);
    RUN(lobe_reflects_indirect_light_alike_by_every_density);
    RUN(mirror_reflects_a_lamp_and_the_sky_exactly);
    RUN(facing_mirrors_reflect_ten_times_and_every_one_needs_a_bounce);
    RUN(mirror_with_a_diffuse_part_reflects_both_under_a_white_sky);
    RUN(clear_glass_under_a_white_sky_cannot_be_seen);
    RUN(tinted_slab_is_seen);
    RUN(glass_reflects_as_often_as_fresnel_says);
    RUN(glass_reflects_all_from_within_beyond_the_critical_angle);
    RUN(smooth_ball_under_a_white_sky_has_no_dark_rim);
    RUN(turned_normals_reflect_as_a_turned_plane_would);
    RUN(smooth_cube_lets_no_light_in);
    RUN(smooth_ball_lets_no_light_in);
    return TEST_END();
}
