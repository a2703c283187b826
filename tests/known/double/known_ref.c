/* known_ref.c - the core's pictures are those of double precision */
/* SPDX-License-Identifier: MIT */

/* The core and tools/ref take the same random numbers for the same decisions,
 * so a picture has no noise of its own against the other: what differs is
 * rounding, and the few rays that pass an edge on another side because of it.
 * What rounding does is tens of times below the limits, what chance does to the
 * few rays is counted. */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "support/picture/mini_scene.h"
#include "support/ql_stats.h"
#include "support/ql_test.h"
#include "qlux.h"
#include "ref/ref.h"

enum { SIZE = 40, SPP = 64, VALUES = 3 * SIZE * SIZE };

/* Pixels left out of the error are those that differ most: a single path past
 * an edge may make one as wrong as can be. In fine about 5 hold one, in draft
 * 170: what is left out is more than that by five standard deviations. */
#if QL_POS_BITS == 0
#define RELMSE_MAX 1e-6
#define BIAS_MAX   1e-3
#define LEFT_OUT   260
#else
#define RELMSE_MAX 1e-8
#define BIAS_MAX   1e-4
#define LEFT_OUT   35
#endif

static mini_scene_t m;
static ql_settings_t settings;
static double core[VALUES], reference[VALUES];

/* ---- Scenes: a room, and what is in it ----------------------------------- */

enum { LOW = 1000, HIGH = 31000, MIDDLE = 16000 };

static void begin(void)
{
    static const ql_settings_t start = QL_SETTINGS_DEFAULT;
    static const double right[3] = {0.5, 0, 0}, up[3] = {0, 0.5, 0};

    settings = start;
    settings.direct = QL_DIRECT_AREA;
    settings.lights = QL_LIGHTS_POWER;
    settings.spp = SPP;
    mini_begin(&m);
    m.width = m.height = SIZE;
    m.radiance_exp = 4;
    mini_eye(&m, MIDDLE, 15000, 1500);
    mini_look(&m, 0.01, -0.02, 0.6);
    mini_field(&m, right, up);
}

static uint16_t coloured(double r, double g, double b)
{
    const double albedo[3] = {r, g, b}, black[3] = {0, 0, 0};

    return mini_rgb(&m, albedo, black);
}

static void add_room(uint16_t material)
{
    static const int32_t low[3] = {LOW, LOW, LOW}, high[3] = {HIGH, HIGH, HIGH};

    mini_room(&m, low, high, material);
}

/* A lamp below the ceiling, facing down. */
static void add_lamp(int32_t x, int32_t z, int32_t reach, double emission)
{
    const int32_t y = HIGH - 100;
    const int32_t a[3] = {x - reach, y, z - reach};
    const int32_t b[3] = {x + reach, y, z - reach};
    const int32_t c[3] = {x + reach, y, z + reach};
    const int32_t d[3] = {x - reach, y, z + reach};

    mini_quad(&m, a, b, c, d, mini_material(&m, 0.5, emission));
}

/* A tilted roof of two faces in the middle. */
static void add_roof(uint16_t material, bool smooth)
{
    static const double left[3] = {-0.5, 0.7, -0.5},
                        right[3] = {0.6, 0.6, -0.5};
    static const double ridge[3] = {0, 0.8, -0.6};
    const uint16_t a = mini_vertex(&m, 8001, 5003, 14007);
    const uint16_t b = mini_vertex(&m, 14513, 12011, 13001);
    const uint16_t c = mini_vertex(&m, 16003, 11017, 22501);
    const uint16_t d = mini_vertex(&m, 22507, 4001, 15013);

    mini_face(&m, a, c, b, material);
    mini_face(&m, b, c, d, material);
    if (smooth) {
        mini_normal(&m, a, left);
        mini_normal(&m, b, ridge);
        mini_normal(&m, c, ridge);
        mini_normal(&m, d, right);
    }
}

static void add_ball(
        int32_t x, int32_t y, int32_t z, int32_t radius, uint16_t material)
{
    const int32_t centre[3] = {256 * x + 11, 256 * y + 37, 256 * z + 101};

    (void)mini_sphere(&m, centre, 256 * radius + 17, material);
}

static void diffuse_room(void)
{
    begin();
    add_room(coloured(0.8, 0.7, 0.6));
    add_lamp(14000, 17000, 4000, 12);
    add_roof(coloured(0.3, 0.5, 0.9), false);
}

static void smooth_room(void)
{
    begin();
    add_room(coloured(0.8, 0.7, 0.6));
    add_lamp(14000, 17000, 4000, 12);
    add_roof(coloured(0.3, 0.5, 0.9), true);
    settings.direct = QL_DIRECT_SOLID_ANGLE;
}

/* Phong walls, a mirror, glass, a smooth roof that shines and a round lamp. */
static void glossy_room(void)
{
    uint16_t material;

    begin();
    material = coloured(0.4, 0.4, 0.5);
    mini_gloss(&m, material, QL_GLOSS_PHONG, 0.3, 20);
    add_room(material);
    material = coloured(0.1, 0.1, 0.1);
    mini_gloss(&m, material, QL_GLOSS_MIRROR, 0.8, 0);
    add_ball(9000, 6000, 20000, 4000, material);
    material = coloured(0, 0, 0);
    mini_gloss(&m, material, QL_GLOSS_GLASS, 0.9, 1.5);
    add_ball(22000, 14000, 12000, 4000, material);
    material = coloured(0.5, 0.1, 0.1);
    mini_gloss(&m, material, QL_GLOSS_PHONG, 0.4, 5);
    add_roof(material, true);
    add_ball(16000, 25000, 17000, 2500, mini_material(&m, 0.5, 12));
    settings.direct = QL_DIRECT_MIS;
}

/* A lens, a wide ground and spheres. */
static void open_air(void)
{
    static const double p[2][3] = {{400, 0, 0}, {0, 400, 0}};
    static const double d[2][3] = {{-0.02, 0, 0}, {0, -0.02, 0}};
    static const int32_t ground[4][3] = {{8, 2000, 8}, {8, 2000, 32000},
            {32000, 2000, 32000}, {32000, 2000, 8}};

    begin();
    mini_lens(&m, p, d);
    mini_quad(&m, ground[0], ground[1], ground[2], ground[3],
            coloured(0.6, 0.6, 0.4));
    add_ball(11000, 6000, 14000, 4000, coloured(0.8, 0.3, 0.2));
    add_ball(21000, 5000, 22000, 3000, coloured(0.2, 0.4, 0.8));
}

static void under_a_plain_sky(void)
{
    open_air();
    mini_sky(&m, 0.5, 0.7, 1);
}

static void under_a_map(void)
{
    static double rgb[8 * 16][3];

    open_air();
    for (unsigned i = 0; i < 8 * 16; i++) {
        rgb[i][0] = 0.2 + 0.1 * (i % 5);
        rgb[i][1] = 0.3 + 0.05 * (i % 7);
        rgb[i][2] = 1.2 - 0.1 * (i / 16);
    }
    rgb[16 * 2 + 5][0] = rgb[16 * 2 + 5][1] = 9; /* a large sun */
    mini_sky_map(&m, 16, 8, (const double(*)[3])rgb, 0.13);
    settings.direct = QL_DIRECT_MIS;
}

/* ---- Both pictures ------------------------------------------------------- */

static bool render_core(const ql_scene_t *blob)
{
    ql_render_t render;

    if (ql_render_init(&render, blob, &settings) != QL_OK) {
        return false;
    }
    for (unsigned i = 0; i < VALUES / 3; i++) {
        ql_sum_t sum = {{0, 0, 0}};

        ql_render_pixel(&render, (uint16_t)(i % SIZE), (uint16_t)(i / SIZE), 0,
                SPP, &sum);
        for (unsigned k = 0; k < 3; k++) {
            core[3 * i + k] = ldexp((double)sum.rgb[k], -QL_SUM_BITS) / SPP;
        }
    }
    return render.diag.saturated == 0;
}

static void render_reference(const ref_scene_t *scene)
{
    ref_stats_t stats = {0, 0, 0};
    ql_settings_t s = settings;

    s.width = s.height = SIZE;
    for (unsigned i = 0; i < VALUES / 3; i++) {
        double rgb[3] = {0, 0, 0};

        ref_pixel(scene, &s, (uint16_t)(i % SIZE), (uint16_t)(i / SIZE), 0, SPP,
                rgb, &stats);
        for (unsigned k = 0; k < 3; k++) {
            reference[3 * i + k] = rgb[k] / SPP;
        }
    }
}

/* The bias, and what chance may make of it: a path that passes an edge on
 * another side is as likely to be brighter for it, and alone in its pixel. */
typedef struct {
    double relmse, bias, by_chance;
} difference_t;

enum { COMPARISONS = 8 }; /* pictures that have to be near */

static int by_size(const void *x, const void *y)
{
    const double p = *(const double *)x, q = *(const double *)y;

    return (p > q) - (p < q);
}

/* As qlux-diff has it, of the pixels that are not left out. */
static difference_t compare(void)
{
    enum { PIXELS = SIZE * SIZE };
    double mean_core = 0, mean = 0, squares = 0, error[PIXELS];
    difference_t d = {0, 0, 0};

    for (unsigned i = 0; i < VALUES; i++) {
        mean_core += core[i] / VALUES;
        mean += reference[i] / VALUES;
    }
    for (unsigned i = 0; i < PIXELS; i++) {
        double sum = 0;

        error[i] = 0;
        for (unsigned k = 3 * i; k < 3 * i + 3; k++) {
            const double apart = core[k] - reference[k];

            error[i] += apart * apart /
                        (reference[k] * reference[k] + 0.01 * mean * mean) /
                        VALUES;
            sum += apart;
        }
        squares += sum * sum;
    }
    qsort(error, PIXELS, sizeof *error, by_size);
    for (unsigned i = 0; i < PIXELS - LEFT_OUT; i++) {
        d.relmse += error[i];
    }
    d.bias = mean_core / mean - 1;
    d.by_chance =
            stats_sign_limit(COMPARISONS) * sqrt(squares) / (mean * VALUES);
    return d;
}

static bool is_near(difference_t d)
{
    return d.relmse <= RELMSE_MAX && fabs(d.bias) <= BIAS_MAX + d.by_chance;
}

static void check(void)
{
    ref_scene_t scene;
    ql_scene_t blob;
    difference_t d;

    mini_open(&m, &blob);
    CHECK(render_core(&blob), "the core did not render, or saturated");
    ref_scene_init(&scene, &blob);
    render_reference(&scene);
    ref_scene_free(&scene);
    d = compare();
    CHECK(is_near(d), "relMSE %.3g, limit %.3g; bias %.3g, limit %.3g",
            d.relmse, RELMSE_MAX, d.bias, BIAS_MAX + d.by_chance);
    NOTE("relMSE %.2g, limit %.2g; bias %.2g, limit %.2g", d.relmse, RELMSE_MAX,
            d.bias, BIAS_MAX + d.by_chance);
}

TEST(diffuse_room_is_that_of_double)
{
    diffuse_room();
    check();
}

TEST(spherical_triangles_and_smooth_faces_are_those_of_double)
{
    smooth_room();
    check();
}

/* Next to rays by the cosine each vertex has one by its lobes, for emitters
 * alone, with numbers of its own. */
TEST(phong_mirror_glass_and_a_round_lamp_are_those_of_double)
{
    glossy_room();
    settings.indirect = QL_INDIRECT_COSINE;
    check();
}

TEST(roulette_and_uniform_directions_are_those_of_double)
{
    diffuse_room();
    settings.roulette = 1;
    settings.indirect = QL_INDIRECT_UNIFORM;
    settings.sampler = QL_SAMPLER_RANDOM;
    settings.bounces = 8;
    check();
}

TEST(every_light_asked_twice_is_that_of_double)
{
    glossy_room();
    settings.lights = QL_LIGHTS_ALL;
    settings.light_samples = 2;
    settings.direct = QL_DIRECT_AREA;
    check();
}

TEST(a_lens_under_a_plain_sky_is_that_of_double)
{
    under_a_plain_sky();
    settings.direct = QL_DIRECT_COSINE;
    check();
}

TEST(a_map_of_the_sky_is_that_of_double)
{
    under_a_map();
    check();
}

/* ---- Single samples ------------------------------------------------------ */

/* A sample that is off by more than this passed an edge on the other side. */
#if QL_POS_BITS == 0
#define FLIP_FROM 0.02
#define FLIPS_MAX 5e-3
#else
#define FLIP_FROM 0.001
#define FLIPS_MAX 2e-4
#endif

typedef struct {
    double light;        /* of the reference */
    double sum, squares; /* of what flips add */
    double rest;         /* what the others add */
    unsigned flips;
} flips_t;

static void count_sample(
        flips_t *f, const ql_sum_t *sum, const double reference_rgb[3])
{
    double apart[3], all = 0, light = 0, most = 0;

    for (unsigned k = 0; k < 3; k++) {
        apart[k] = ldexp((double)sum->rgb[k], -QL_SUM_BITS) - reference_rgb[k];
        all += apart[k];
        light += reference_rgb[k];
        most = fmax(most, fabs(apart[k]));
    }
    f->light += light;
    /* sums round some contributions of a path by 2^-25 each */
    if (most > FLIP_FROM * (light + 1e-4) + ldexp(5, -25)) {
        f->flips++;
        f->sum += all;
        f->squares += all * all;
    } else {
        f->rest += all;
    }
}

static flips_t count_flips(const ref_scene_t *scene, ql_render_t *render)
{
    flips_t f = {0, 0, 0, 0, 0};
    ref_stats_t stats = {0, 0, 0};

    for (uint32_t i = 0; i < (uint32_t)SIZE * SIZE * SPP; i++) {
        const uint16_t x = (uint16_t)(i / SPP % SIZE);
        const uint16_t y = (uint16_t)(i / SPP / SIZE);
        ql_sum_t sum = {{0, 0, 0}};
        double rgb[3] = {0, 0, 0};

        ql_render_pixel(render, x, y, i % SPP, 1, &sum);
        ref_pixel(scene, &render->settings, x, y, i % SPP, 1, rgb, &stats);
        count_sample(&f, &sum, rgb);
    }
    return f;
}

TEST(samples_past_an_edge_are_few_and_add_no_light)
{
    ql_render_t render;
    ref_scene_t scene;
    ql_scene_t blob;
    double share, z;
    flips_t f;

    glossy_room();
    settings.sampler = QL_SAMPLER_RANDOM;
    mini_open(&m, &blob);
    CHECK(ql_render_init(&render, &blob, &settings) == QL_OK, "settings");
    ref_scene_init(&scene, &blob);
    f = count_flips(&scene, &render);
    ref_scene_free(&scene);
    share = (double)f.flips / (SIZE * SIZE * SPP);
    z = f.flips > 0 ? f.sum / sqrt(f.squares) : 0;
    CHECK(share < FLIPS_MAX, "%.3g of all samples", share);
    CHECK(fabs(z) < stats_sign_limit(1), "%u samples, z %.2f", f.flips, z);
    CHECK(fabs(f.rest / f.light) < BIAS_MAX, "the others: bias %.3g",
            f.rest / f.light);
    NOTE("%.2g of all, limit %.2g; z %.1f; the others: bias %.2g", share,
            FLIPS_MAX, z, f.rest / f.light);
}

/* ---- Faults -------------------------------------------------------------- */

/* Plant a fault in the reference of the diffuse room and compare. */
static void reject(void (*plant)(ref_scene_t *scene))
{
    ref_scene_t scene;
    ql_scene_t blob;
    difference_t d;

    diffuse_room();
    mini_open(&m, &blob);
    CHECK(render_core(&blob), "the core did not render, or saturated");
    ref_scene_init(&scene, &blob);
    plant(&scene);
    render_reference(&scene);
    ref_scene_free(&scene);
    d = compare();
    CHECK(!is_near(d), "accepted: relMSE %.3g, bias %.3g", d.relmse, d.bias);
    NOTE("relMSE %.2g, bias %.2g", d.relmse, d.bias);
}

static void other_albedo(ref_scene_t *scene)
{
    for (unsigned i = 0; i < m.material_count; i++) {
        for (unsigned k = 0; k < 3; k++) {
            scene->materials[i].albedo[k] *= 1.001;
        }
    }
}

static void other_numbers(ref_scene_t *scene)
{
    (void)scene;
    settings.seed++;
}

static void other_camera(ref_scene_t *scene)
{
    scene->d.x += 0.0025; /* of 0.025 a pixel */
}

static void other_lamp(ref_scene_t *scene)
{
    for (unsigned i = 0; i < m.triangle_count; i++) {
        if (scene->shapes[i].light >= 0) {
            scene->shapes[i].n = ref_scale(scene->shapes[i].n, 1.003);
        }
    }
}

TEST(comparison_rejects_albedo_off_by_a_thousandth)
{
    reject(other_albedo);
}

TEST(comparison_rejects_other_random_numbers)
{
    reject(other_numbers);
}

TEST(comparison_rejects_a_camera_off_by_a_tenth_of_a_pixel)
{
    reject(other_camera);
}

TEST(comparison_rejects_a_lamp_of_other_size)
{
    reject(other_lamp);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("known/ref", argc, argv);
    RUN(diffuse_room_is_that_of_double);
    RUN(spherical_triangles_and_smooth_faces_are_those_of_double);
    RUN(phong_mirror_glass_and_a_round_lamp_are_those_of_double);
    RUN(roulette_and_uniform_directions_are_those_of_double);
    RUN(every_light_asked_twice_is_that_of_double);
    RUN(a_lens_under_a_plain_sky_is_that_of_double);
    RUN(a_map_of_the_sky_is_that_of_double);
    RUN(samples_past_an_edge_are_few_and_add_no_light);
    RUN(comparison_rejects_albedo_off_by_a_thousandth);
    RUN(comparison_rejects_other_random_numbers);
    RUN(comparison_rejects_a_camera_off_by_a_tenth_of_a_pixel);
    RUN(comparison_rejects_a_lamp_of_other_size);
    return TEST_END();
}
