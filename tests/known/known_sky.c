/* known_sky.c - light from all around: constant, a map, hidden in part */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <stdlib.h>

#include "support/picture/estimate.h"
#include "support/picture/lambert.h"
#include "support/ql_double.h"
#include "support/ql_test.h"
#include "qlux.h"
#include "film/ql_film.h"

#define ULP (1.0 / (1 << QL_POS_BITS)) /* grid units */

/* Half of what the last bit of a sum is worth, radiance units. */
#define HALF_BIT ldexp(0.5, -QL_SUM_BITS)

static mini_scene_t m;

static stats_moments_t measure(int strategy, uint32_t samples)
{
    ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 0, 31);

    s.direct = strategies[strategy].direct;
    return estimate_pixel(&m, &s, 0, 0, samples);
}

/* Standard errors off, plus what rounding may make: half a bit of a sum, and a
 * direction's last bit, which shares of the balance heuristic depend on. */
static double off_by(const stats_moments_t *got, double want)
{
    const double rounding =
            ldexp(HALF_BIT, m.radiance_exp) + ldexp(want, -QL_DIR_BITS);

    return (got->mean - want) /
           (sqrt(stats_variance(got) / got->n) + rounding / STATS_Z_MAX);
}

/* ---- A white furnace: convex objects are as bright as their albedo ------- */

#define SKY 0.5

enum { OBJECT_PIXELS = 16 };

/* A box or a sphere, seen at a slant; every direction and distance of it. */
static void make_object(bool sphere, double albedo)
{
    static const int32_t low[3] = {12000, 12000, 12000};
    static const int32_t high[3] = {20000, 19000, 18000};
    static const int32_t centre[3] = {16000 * 256, 15500 * 256, 15000 * 256};
    static const double right[3] = {7000, 0, -3500}, up[3] = {0, 7000, 0};
    const uint16_t white = (mini_begin(&m), mini_material(&m, albedo, 0));

    if (sphere) {
        (void)mini_sphere(&m, centre, 4000 * 256, white);
    } else {
        mini_room(&m, low, high, white);
    }
    mini_sky(&m, SKY, SKY, SKY);
    m.width = m.height = OBJECT_PIXELS;
    mini_eye(&m, 16000 - 8000, 15500 + 4000, 15000 - 16000);
    mini_window(&m, right, up);
    mini_look(&m, 0.25, -0.125, 0.5);
}

/* Samples that saw the object, and of those the ones beyond rounding. */
typedef struct {
    stats_moments_t seen;
    unsigned wrong, sky;
} object_t;

static object_t look_at_object(int strategy, double want)
{
    enum { SAMPLES = 64 };
    ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 0, 32);
    object_t got = {{0, 0, 0}, 0, 0};
    ql_scene_t scene;
    ql_render_t render;

    s.direct = strategies[strategy].direct;
    mini_open(&m, &scene);
    CHECK(ql_render_init(&render, &scene, &s) == QL_OK, "settings");
    for (uint32_t i = 0; i < OBJECT_PIXELS * OBJECT_PIXELS * SAMPLES; i++) {
        ql_sum_t sum = {{0, 0, 0}};
        const uint32_t pixel = i / SAMPLES;
        double value;

        ql_render_pixel(&render, (uint16_t)(pixel % OBJECT_PIXELS),
                (uint16_t)(pixel / OBJECT_PIXELS), i % SAMPLES, 1, &sum);
        value = ldexp((double)sum.rgb[0], -QL_SUM_BITS);
        if (value == SKY) {
            got.sky++;
        } else {
            stats_add(&got.seen, value);
            got.wrong += fabs(value - want) > 4 * HALF_BIT;
        }
    }
    return got;
}

/* By cosine directions, and points of a constant sky are those, every sample is
 * albedo times sky, seen at whatever slant. */
TEST(convex_object_is_as_bright_as_its_albedo_at_every_slant)
{
    unsigned seen = 0;

    for (int i = 0; i < 2 * STRATEGIES; i++) {
        const double albedo = 0.75, want = albedo * SKY;
        const int k = i / 2;
        object_t got;
        double z;

        make_object(i % 2 != 0, albedo);
        got = look_at_object(k, want);
        z = off_by(&got.seen, want);
        seen += (unsigned)got.seen.n;
        CHECK(got.sky > 1000 && got.seen.n > 1000, "%s: %u sky, %g object",
                strategies[k].name, got.sky, got.seen.n);
        CHECK(fabs(z) < STATS_Z_MANY, "%s, object %d: %.8f, want %.8f, z %.1f",
                strategies[k].name, i % 2, got.seen.mean, want, z);
        CHECK(k == HEMISPHERE || k == MIS || got.wrong == 0,
                "%s, object %d: %u samples of %g are not %.8f",
                strategies[k].name, i % 2, got.wrong, got.seen.n, want);
        CHECK(fabs(off_by(&got.seen, want * 1.1)) > STATS_Z_MAX,
                "%s passes for 1.1 times as much", strategies[k].name);
    }
    NOTE("box and sphere, %u samples", seen);
}

/* ---- One point ----------------------------------------------------------- */

static const int32_t at[3] = {16000, 16000, 16000};

/* The receiver: a white square about the point, looked at along -n. One of the
 * normal's components is 0. */
static void begin_point(const int32_t n[3])
{
    enum { REACH = 20 };
    const bool flat = n[2] == 0; /* s = z, or else x */
    const int32_t s[3] = {flat ? 0 : REACH, 0, flat ? REACH : 0};
    const int32_t t[3] = {flat ? -n[1] * REACH : 0,
            flat ? n[0] * REACH : -n[2] * REACH, flat ? 0 : n[1] * REACH};
    int32_t c[4][3];

    mini_begin(&m);
    for (int k = 0; k < 3; k++) {
        c[0][k] = at[k] - s[k] - t[k];
        c[1][k] = at[k] - s[k] + t[k];
        c[2][k] = at[k] + s[k] + t[k];
        c[3][k] = at[k] + s[k] - t[k];
    }
    mini_quad(&m, c[0], c[1], c[2], c[3], mini_material(&m, 1, 0));
    mini_eye(&m, at[0] + 8.0 * n[0], at[1] + 8.0 * n[1], at[2] + 8.0 * n[2]);
    mini_look(&m, -n[0] / 8.0, -n[1] / 8.0, -n[2] / 8.0);
}

/* ---- Maps ---------------------------------------------------------------- */

enum { WIDTH = 16, HEIGHT = 8, SUN = 2 * WIDTH + 5 };

/* Of every brightness, a black texel among them, and a sun. */
static void add_map(double rotate)
{
    double rgb[WIDTH * HEIGHT][3];
    uint64_t random = 3;

    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const double value = i == SUN  ? 48
                             : i == 40 ? 0
                                       : stats_random_unit(&random);

        rgb[i][0] = rgb[i][1] = rgb[i][2] = value;
    }
    m.radiance_exp = 6;
    mini_sky_map(&m, WIDTH, HEIGHT, (const double(*)[3])rgb, rotate);
}

static void direction_of(double u, double v, double rotate, double w[3])
{
    const double theta = PI * v, phi = 2 * PI * (u + rotate);

    w[0] = sin(theta) * sin(phi);
    w[1] = cos(theta);
    w[2] = sin(theta) * cos(phi);
}

/* E / pi: the radiance of every texel as it is stored, times the integral of
 * the cosine over it. Every texel counts alike if weights are left out. */
static double map_irradiance(const int32_t n[3], double rotate, bool weigh)
{
    enum { CELLS = 48 };
    const double size = sqrt((double)(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]));
    double sum = 0;

    for (int i = 0; i < WIDTH * HEIGHT * CELLS * CELLS; i++) {
        const int texel = i / (CELLS * CELLS), cell = i % (CELLS * CELLS);
        const double u = (texel % WIDTH + (cell % CELLS + 0.5) / CELLS) / WIDTH;
        const double v =
                (texel / WIDTH + (cell / CELLS + 0.5) / CELLS) / HEIGHT;
        double w[3], cosine;

        direction_of(u, v, rotate, w);
        cosine = (w[0] * n[0] + w[1] * n[1] + w[2] * n[2]) / size;
        if (cosine > 0) {
            sum += m.texels[texel][0] * cosine * (weigh ? sin(PI * v) : 2 / PI);
        }
    }
    return sum * 2 * PI / (WIDTH * HEIGHT * CELLS * CELLS);
}

/* On a horizontal receiver, on tilted ones, and one that looks away from the
 * sun; u of the map begins at three azimuths. */
static const int32_t normals[][3] = {
        {0, 1, 0}, {0, 0, 1}, {3, 4, 0}, {0, 3, -4}, {-4, -3, 0}};
enum { NORMALS = sizeof normals / sizeof *normals };
static const double rotates[] = {0, 0.25, 0.3};

TEST(irradiance_from_a_map_is_the_sum_over_its_texels)
{
    double worst = 0;

    for (int i = 0; i < 3 * NORMALS; i++) {
        const int32_t *const n = normals[i / 3];

        for (int k = 0; k < STRATEGIES; k++) {
            stats_moments_t got;
            double want, z;

            begin_point(n);
            add_map(rotates[i % 3]);
            want = map_irradiance(n, rotates[i % 3], true);
            got = measure(k, 1u << 16);
            z = off_by(&got, want);
            CHECK(fabs(z) < STATS_Z_MANY,
                    "normal %d, rotate %g, %s: %.6f, want %.6f, z %.1f", i / 3,
                    rotates[i % 3], strategies[k].name, got.mean, want, z);
            worst = fmax(worst, fabs(z));
        }
    }
    NOTE("%d normals, 3 turns, worst z %.1f", NORMALS, worst);
}

TEST(irradiance_rejects_a_map_turned_by_a_texel_and_one_without_sines)
{
    for (int k = 0; k < STRATEGIES; k++) {
        stats_moments_t got;
        double turned, flat;

        begin_point(normals[2]);
        add_map(0.75);
        got = measure(k, 1u << 17);
        turned = off_by(
                &got, map_irradiance(normals[2], 0.75 + 1.0 / WIDTH, true));
        flat = off_by(&got, map_irradiance(normals[2], 0.75, false));
        CHECK(fabs(turned) > STATS_Z_MAX, "%s: turned passes, z %.1f",
                strategies[k].name, turned);
        CHECK(fabs(flat) > STATS_Z_MAX, "%s: without sines passes, z %.1f",
                strategies[k].name, flat);
    }
}

/* The map's own distribution is worth having: the sun is met every time. */
TEST(map_sampling_varies_less_than_directions_where_there_is_a_sun)
{
    stats_moments_t got[STRATEGIES];

    for (int k = 0; k < STRATEGIES; k++) {
        begin_point(normals[0]);
        add_map(0);
        got[k] = measure(k, 1u << 14);
    }
    for (int k = 0; k < STRATEGIES; k++) {
        if (k == HEMISPHERE || k == COSINE) {
            CHECK(stats_variance(got + k) > 10 * stats_variance(got + AREA) &&
                            stats_variance(got + k) >
                                    10 * stats_variance(got + MIS),
                    "%s: variance %.3g, of map %.3g, of mis %.3g",
                    strategies[k].name, stats_variance(got + k),
                    stats_variance(got + AREA), stats_variance(got + MIS));
        }
    }
    NOTE("cosine %.3g, map %.3g, mis %.3g", stats_variance(got + COSINE),
            stats_variance(got + AREA), stats_variance(got + MIS));
}

/* From inside the box and from outside, where a ray misses it. The film rounds
 * what is faint up or down by chance, anything else to nearest. */
TEST(camera_sees_every_texel_as_it_is_stored)
{
    for (int i = 0; i < 2 * 3 * WIDTH * HEIGHT; i++) {
        const int texel = i / 6;
        const double rotate = rotates[i / 2 % 3];
        stats_moments_t got;
        double w[3];
        bool faint;

        direction_of((texel % WIDTH + 0.5) / WIDTH,
                (texel / WIDTH + 0.5) / HEIGHT, rotate, w);
        begin_point(normals[0]);
        add_map(rotate);
        mini_eye(&m, 15000, 15000, i % 2 ? 15000 : -40000);
        mini_look(&m, w[0] / 2, w[1] / 2, i % 2 ? w[2] / 2 : -fabs(w[2]) / 2);
        if (i % 2 == 0 && w[2] > 0) {
            continue; /* towards the scene */
        }
        got = measure(AREA, 4);
        faint = m.texels[texel][0] <
                ldexp(QL_FAINT * 2 * HALF_BIT, m.radiance_exp);
        CHECK(faint ? fabs(got.mean - m.texels[texel][0]) <
                                2 * ldexp(HALF_BIT, m.radiance_exp)
                    : fabs(got.mean - m.texels[texel][0]) <=
                                        ldexp(HALF_BIT, m.radiance_exp) &&
                                got.m2 == 0,
                "texel %d, rotate %g: %.9f, stored %.9f", texel, rotate,
                got.mean, m.texels[texel][0]);
    }
    NOTE("%d texels, 3 turns, to half a bit of a sum", WIDTH * HEIGHT);
}

/* ---- Skies behind and beside other things -------------------------------- */

/* A square over the point, shining or black, under a sky: F and 1 - F. */
TEST(sky_and_a_lamp_before_it_share_the_hemisphere)
{
    static const int32_t up[3] = {0, 0, 1};
    static const double normal[3] = {0, 0, 1};
    static const double radiances[] = {0.75, 0};
    double worst = 0;

    for (int i = 0; i < 2 * STRATEGIES; i++) {
        const int k = i / 2;
        const double z = 8000, h = 4000, seen = z - ULP;
        const int32_t c[4][3] = {{12000, 12000, 24000}, {12000, 20000, 24000},
                {20000, 20000, 24000}, {20000, 12000, 24000}};
        const lambert_polygon_t square = {
                {{-h, -h, seen}, {h, -h, seen}, {h, h, seen}, {-h, h, seen}},
                4};
        const double f = lambert_form_factor(&square, normal);
        stats_moments_t got;
        double want, off;

        begin_point(up);
        mini_quad(&m, c[0], c[1], c[2], c[3],
                mini_material(&m, 0, radiances[i % 2]));
        mini_sky(&m, SKY, SKY, SKY);
        got = measure(k, 1u << 17);
        want = radiances[i % 2] * f + SKY * (1 - f);
        /* points on the lamp are an ulp lower */
        off = (got.mean - want) /
              (sqrt(stats_variance(&got) / got.n) + ULP / z / STATS_Z_MAX);
        CHECK(fabs(off) < STATS_Z_MANY, "%s: %.7f, want %.7f, z %.1f",
                strategies[k].name, got.mean, want, off);
        worst = fmax(worst, fabs(off));
        /* the lamp alone, the sky all over, both added up */
        CHECK(fabs(off_by(&got, SKY)) > STATS_Z_MAX &&
                        fabs(off_by(&got, radiances[i % 2] * f)) >
                                STATS_Z_MAX &&
                        fabs(off_by(&got, radiances[i % 2] * f + SKY)) >
                                STATS_Z_MAX,
                "%s: a wrong share passes", strategies[k].name);
    }
    NOTE("lamp or shadow, worst z %.1f", worst);
}

/* A wall two units away, 7500 times as high and wide. */
TEST(wall_close_by_hides_half_of_the_sky)
{
    static const int32_t up[3] = {0, 0, 1};
    static const double normal[3] = {0, 0, 1};
    double worst = 0;

    for (int k = 0; k < STRATEGIES; k++) {
        const double d = 2, r = 15000, low = -ULP;
        const int32_t c[4][3] = {{16002, 1000, 16000}, {16002, 31000, 16000},
                {16002, 31000, 31000}, {16002, 1000, 31000}};
        const lambert_polygon_t wall = {
                {{d, -r, low}, {d, -r, r}, {d, r, r}, {d, r, low}}, 4};
        const double f = fabs(lambert_form_factor(&wall, normal));
        stats_moments_t got;
        double off;

        begin_point(up);
        mini_quad(&m, c[0], c[1], c[2], c[3], mini_material(&m, 0, 0));
        mini_sky(&m, SKY, SKY, SKY);
        mini_eye(&m, 16000, 16000, 16001);
        got = measure(k, 1u << 17);
        off = off_by(&got, SKY * (1 - f));
        CHECK(fabs(f - 0.5) < 1e-3 && fabs(off) < STATS_Z_MAX,
                "%s: %.7f, want %.7f", strategies[k].name, got.mean,
                SKY * (1 - f));
        worst = fmax(worst, fabs(got.mean / SKY - 0.5));
    }
    NOTE("off a half by at most %.4f", worst);
}

/* Closed rooms know of no sky. */
TEST(sky_never_enters_a_closed_room)
{
    static const int32_t low[3] = {8000, 8000, 8000};
    static const int32_t high[3] = {24000, 24000, 24000};

    for (int k = 0; k < STRATEGIES; k++) {
        ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 8, 33);

        mini_begin(&m);
        mini_room(&m, low, high, mini_material(&m, 1, 0));
        mini_eye(&m, 14000, 15000, 16000);
        mini_look(&m, 0.25, 0.125, 0.5);
        add_map(0.1);
        s.direct = strategies[k].direct;
        s.indirect = (uint8_t)(k % 2 ? QL_INDIRECT_UNIFORM : QL_INDIRECT_BRDF);
        CHECK(estimate_brightest(&m, &s, 4000) == 0, "%s: light",
                strategies[k].name);
    }
    NOTE("9 reflections, exactly 0");
}

int main(int argc, char **argv)
{
    TEST_BEGIN("known/sky", argc, argv);
    RUN(convex_object_is_as_bright_as_its_albedo_at_every_slant);
    RUN(irradiance_from_a_map_is_the_sum_over_its_texels);
    RUN(irradiance_rejects_a_map_turned_by_a_texel_and_one_without_sines);
    RUN(map_sampling_varies_less_than_directions_where_there_is_a_sun);
    RUN(camera_sees_every_texel_as_it_is_stored);
    RUN(sky_and_a_lamp_before_it_share_the_hemisphere);
    RUN(wall_close_by_hides_half_of_the_sky);
    RUN(sky_never_enters_a_closed_room);
    return TEST_END();
}
