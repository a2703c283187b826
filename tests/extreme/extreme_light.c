/* extreme_light.c - emitters where light ends or explodes: cases 22 to 32 */
/* SPDX-License-Identifier: MIT */

#include <math.h>

#include "support/built.h"
#include "support/picture/estimate.h"
#include "support/picture/lambert.h"
#include "support/ql_points.h"
#include "support/ql_double.h"
#include "support/ql_test.h"
#include "qlux.h"
#include "light/ql_emit.h"
#include "light/ql_emit_triangle.h"
#include "light/ql_light.h"
#include "render/ql_next_event.h"
#include "trace/ql_sphere.h"

#define RADIANCE 0.5

static mini_scene_t m;
static ql_scene_t scene;

/* A square in a plane of constant z, its front up or down. */
static void add_square(
        int32_t low, int32_t high, int32_t z, bool up, uint16_t material)
{
    const int32_t a[3] = {low, low, z}, b[3] = {high, low, z};
    const int32_t c[3] = {high, high, z}, d[3] = {low, high, z};

    if (up) {
        mini_quad(&m, a, b, c, d, material);
    } else {
        mini_quad(&m, a, d, c, b, material);
    }
}

static void look_down(double x, double y, double z)
{
    mini_eye(&m, x, y, z);
    mini_look(&m, 0, 0, -0.5);
}

/* ---- Every strategy ---------------------------------------------------- */

static bool is_built(unsigned direct)
{
    return BUILT_HAS_DIRECT(direct);
}

static ql_settings_t settings_of(unsigned direct, uint8_t bounces)
{
    ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, bounces, 22);

    s.direct = (uint8_t)direct;
    return s;
}

/* The scene must be exactly black by every strategy. */
static void check_black(uint8_t bounces, uint32_t samples, const char *what)
{
    for (unsigned direct = QL_DIRECT_AREA; direct <= QL_DIRECT_MIS; direct++) {
        const ql_settings_t s = settings_of(direct, bounces);
        uint64_t sum;

        if (is_built(direct)) {
            sum = estimate_brightest(&m, &s, MANY(samples));
            CHECK(sum == 0, "%s, direct %u: %llu", what, direct,
                    (unsigned long long)sum);
        }
    }
}

static double worst_z;

/* The pixel must have this mean, judged by the samples' own spread. */
static void check_mean(
        unsigned direct, uint32_t samples, double want, const char *what)
{
    const ql_settings_t s = settings_of(direct, 0);
    stats_moments_t got;
    double z;

    if (!is_built(direct)) {
        return;
    }
    got = estimate_pixel(&m, &s, 0, 0, MANY(samples));
    z = estimate_z(&got, want * RADIANCE, stats_variance(&got));
    CHECK(fabs(z) < STATS_Z_MAX, "%s, direct %u: %.9f, want %.9f, z %.1f", what,
            direct, got.mean / RADIANCE, want, z);
    worst_z = fmax(worst_z, fabs(z));
}

/* The fault: every light weighs that much too much. How far that is off. */
static double reject(double want, double scale)
{
    const ql_settings_t s = settings_of(
            QL_SOLID_ANGLE ? QL_DIRECT_SOLID_ANGLE : QL_DIRECT_AREA, 0);
    stats_moments_t got;
    double z;

    m.light_weight_scale = scale;
    got = estimate_pixel(&m, &s, 0, 0, 1u << 16);
    z = estimate_z(&got, want * RADIANCE, stats_variance(&got));
    CHECK(z > STATS_Z_MAX, "%g times the light: z %.1f", scale, z);
    return z;
}

/* ---- Black ------------------------------------------------------------- */

static void make_gap(int32_t gap)
{
    static const double right[3] = {0.25, -0.5, 0}, up[3] = {0, 0, 0.5};
    const uint16_t white = (mini_begin(&m), mini_material(&m, 1, 0));

    add_square(200, 32000, 16000, true, white);
    add_square(200, 32000, 16000 + gap, true, white);
    add_square(10000, 22000, 20000, false, mini_material(&m, 0, RADIANCE));
    mini_eye(&m, 15000, 15000, 16000 + gap / 2.0);
    mini_look(&m, 0.5, 0.25, 0);
    mini_field(&m, right, up);
    m.width = m.height = 8;
}

/* In draft a point cannot lie between planes one unit apart: what is seen from
 * there is the upper one's upper side. */
TEST(case_22_no_light_comes_through_a_plane_one_or_two_units_above)
{
    for (int32_t gap = QL_POS_BITS > 0 ? 1 : 2; gap <= 3; gap++) {
        make_gap(gap);
        check_black(8, 32, "gap");
    }
    NOTE("gaps from %d to 3 units, 5 strategies, 8 bounces",
            QL_POS_BITS > 0 ? 1 : 2);
}

static void make_closed_room(unsigned node_bits, bool closed)
{
    static const double right[3] = {0.25, 0, 0}, up[3] = {0, 0.25, 0};
    const int32_t low[3] = {200, 200, 200}, high[3] = {32000, 32000, 32000};
    const int32_t in_low[3] = {14999, 14901, 15103};
    const int32_t in_high[3] = {17001, 16903, 17107};

    mini_begin(&m);
    m.node_bits = node_bits;
    mini_room(&m, low, high, mini_material(&m, 0.9, RADIANCE));
    mini_room(&m, in_low, in_high, mini_material(&m, 1, 0));
    m.triangle_count -= !closed; /* half of the wall behind */
    m.two_sided = true;
    look_down(16000, 15900, 16100);
    mini_field(&m, right, up);
    m.width = m.height = 8;
}

TEST(case_23_closed_box_under_light_is_black_after_64_bounces)
{
    const ql_settings_t s = settings_of(QL_DIRECT_AREA, 64);

    for (unsigned bits = 8; bits <= 16; bits += 8) {
        make_closed_room(bits, true);
        check_black(64, 16, "room");
    }
    make_closed_room(16, false);
    CHECK(estimate_brightest(&m, &s, 64) > 0, "no light through a hole");
    NOTE("64 px, 5 strategies, both node widths; open, it is not");
}

TEST(case_24_light_in_the_plane_of_the_receiver_gives_nothing)
{
    static const int32_t a[3] = {10000, 10000, 10000};
    static const int32_t b[3] = {14000, 10000, 13000};
    static const int32_t c[3] = {14000, 15000, 13000};
    static const int32_t d[3] = {10000, 15000, 10000};
    static const int32_t e[3] = {18000, 10000, 16000};
    static const int32_t f[3] = {18000, 15000, 16000};

    for (unsigned up = 0; up < 2; up++) {
        mini_begin(&m);
        add_square(8000, 16000, 16000, true, mini_material(&m, 1, 0));
        add_square(16000, 24000, 16000, up, mini_material(&m, 0, RADIANCE));
        m.two_sided = true;
        look_down(12000, 12000, 18000);
        check_black(0, 4096, "flat");
    }
    mini_begin(&m);
    mini_quad(&m, a, b, c, d, mini_material(&m, 1, 0));
    mini_quad(&m, b, e, f, c, mini_material(&m, 0, RADIANCE));
    look_down(12000, 12500, 15000);
    check_black(0, 4096, "tilted");
    NOTE("flat and tilted, 5 strategies");
}

TEST(case_25_light_behind_the_receiver_and_behind_the_light_is_nothing)
{
    const ql_settings_t s = settings_of(QL_DIRECT_AREA, 0);

    mini_begin(&m);
    add_square(8000, 24000, 16000, true, mini_material(&m, 1, 0));
    add_square(15000, 17000, 15000, true, mini_material(&m, 0, RADIANCE));
    m.two_sided = true;
    look_down(16000, 16000, 20000);
    check_black(0, 4096, "light below");
    mini_begin(&m);
    add_square(8000, 24000, 16000, true, mini_material(&m, 1, 0));
    add_square(15000, 17000, 25000, true, mini_material(&m, 0, RADIANCE));
    look_down(16000, 16000, 20000);
    check_black(0, 4096, "light turned away");
    m.two_sided = true;
    CHECK(estimate_brightest(&m, &s, 64) > 0, "two-sided, it is black too");
    NOTE("5 strategies; two-sided, it is not");
}

/* ---- Triangles --------------------------------------------------------- */

/* The triangle (2,0,-1)(0,2,1)(1,1,3) in units of 5000, and a receiver at the
 * origin: its lowest corner is below the horizon. */
TEST(case_26_light_that_crosses_the_horizon_has_the_known_form_factor)
{
    double z;
    static const int32_t a[3] = {22000, 12000, 7000};
    static const int32_t b[3] = {12000, 22000, 17000};
    static const int32_t c[3] = {17000, 17000, 27000};

    mini_begin(&m);
    m.two_sided = true;
    m.radiance_exp = 0;
    add_square(11990, 12010, 12000, true, mini_material(&m, 1, 0));
    mini_triangle(&m, a, b, c, mini_material(&m, 0, RADIANCE));
    look_down(12000, 12000, 12100);
    worst_z = 0;
    for (unsigned direct = QL_DIRECT_AREA; direct <= QL_DIRECT_MIS; direct++) {
        check_mean(direct, 1u << 16, 0.1163103269550030, "L5");
    }
    z = reject(0.1163103269550030, 1.02);
    NOTE("5 strategies of 2^16; worst z %.1f; 2 %% too much: %.0f", worst_z, z);
}

/* A wall 10000 wide and high, so many units from the receiver. */
static double make_wall(int32_t distance)
{
    const int32_t y = 8000 + distance;
    const int32_t a[3] = {11000, y, 8000}, b[3] = {21000, y, 8000};
    const int32_t c[3] = {21000, y, 18000}, d[3] = {11000, y, 18000};
    const double lift = 1e-4 / ONE; /* the receiver is an ulp up */
    const double e = distance * 1e-4, height = 1 - lift;
    const double far = sqrt(e * e + height * height);

    mini_begin(&m);
    m.radiance_exp = 0;
    add_square(15000, 17000, 8000, true, mini_material(&m, 1, 0));
    m.vertices[0][1] = m.vertices[1][1] = 7000; /* y of the floor */
    m.vertices[2][1] = m.vertices[3][1] = 8000;
    mini_quad(&m, a, b, c, d, mini_material(&m, 0, RADIANCE));
    /* onto the floor's edge from before the wall */
    mini_eye(&m, 16000, 7900, 8050);
    mini_look(&m, 0, 0.5, -0.25);
    return (atan(0.5 / e) - e / far * atan(0.5 / far)) / PI;
}

/* By area 1/r^2 is unbounded: as near as 1e-2 a sample's own spread is not yet
 * its true one, so there it must only be finite and uncut. */
TEST(case_27_light_standing_on_the_floor_is_finite_and_unbiased)
{
    static const int32_t distances[] = {10000, 1000, 100, 10, 1};
    static const double known[] = {0.07109343904694551, 0.4225448602390583,
            0.4921589521634546, 0.4992157975962600, 0.4999215796619845};

    worst_z = 0;
    for (unsigned i = 0; i < 5; i++) {
        const double f = make_wall(distances[i]);
        const ql_settings_t s = settings_of(QL_DIRECT_AREA, 0);
        stats_moments_t got;

        CHECK(fabs(f - known[i]) < 1e-3 / (QL_POS_BITS > 0 ? 256 : 1),
                "at %ld: %.9f, known %.9f", (long)distances[i], f, known[i]);
        got = estimate_pixel(&m, &s, 0, 0, 1u << 14);
        CHECK(got.mean >= 0 && got.mean < 10 && stats_variance(&got) >= 0,
                "by area at %ld: %g", (long)distances[i], got.mean);
        if (distances[i] >= 1000) {
            check_mean(QL_DIRECT_AREA, 1u << 16, f, "by area");
        }
        check_mean(QL_DIRECT_COSINE, 1u << 16, f, "by cosine");
        check_mean(QL_DIRECT_HEMISPHERE, 1u << 16, f, "by hemisphere");
        check_mean(QL_DIRECT_SOLID_ANGLE, 1u << 16, f, "by solid angle");
        check_mean(QL_DIRECT_MIS, 1u << 16, f, "by both");
    }
    NOTE("1 to 1e-4 of its height away; worst z %.1f; 5 %% too much: %.0f",
            worst_z, reject(make_wall(distances[3]), 1.05));
}

/* ---- 1/r^2 ------------------------------------------------------------- */

/* A lamp of 24000 by 8 units, as near to a floor as points between can tell:
 * 1/r^2 times its area is up to 6 10^4 at a unit's distance, beyond the largest
 * contribution of 2^15 radiance units if the lamp's own is nearly one. Sums of
 * single samples say which were cut. */
static uint64_t cut_samples(
        int radiance_exp, double radiance, uint32_t *counted, double *most)
{
    const int32_t z = 8000 + (QL_POS_BITS > 0 ? 1 : 3);
    const int32_t a[3] = {4000, 16000, z}, b[3] = {28000, 16000, z};
    const int32_t c[3] = {28000, 16008, z}, d[3] = {4000, 16008, z};
    const ql_settings_t s = settings_of(QL_DIRECT_AREA, 0);
    uint64_t cut = 0;
    ql_render_t r;

    mini_begin(&m);
    m.radiance_exp = radiance_exp;
    add_square(8000, 24000, 8000, true, mini_material(&m, 1, 0));
    mini_quad(&m, a, d, c, b, mini_material(&m, 0, radiance));
    mini_eye(&m, 16000, 16030, 8005);
    mini_look(&m, 0, -0.5, -0.1);
    mini_open(&m, &scene);
    CHECK(ql_render_init(&r, &scene, &s) == QL_OK, "settings");
    *most = 0;
    for (uint32_t i = 0; i < 1ul << 20; i++) {
        ql_sum_t sum = {{0, 0, 0}};

        ql_render_pixel(&r, 0, 0, i, 1, &sum);
        CHECK(sum.rgb[0] <= QL_CONTRIBUTION_MAX, "sample %lu: %llu",
                (unsigned long)i, (unsigned long long)sum.rgb[0]);
        for (unsigned k = 0; k < 3; k++) {
            cut += sum.rgb[k] == QL_CONTRIBUTION_MAX;
        }
        *most = fmax(*most, ldexp((double)sum.rgb[0], -QL_SUM_BITS));
    }
    *counted = r.diag.saturated;
    return cut;
}

TEST(case_28_samples_next_to_the_surface_are_cut_counted_and_never_wrap)
{
    uint32_t counted;
    double most, scaled;
    uint64_t cut = cut_samples(0, 0.999, &counted, &most);

    CHECK(cut > 0 && (!QL_CFG_DIAG || counted == cut), "%llu cut, %lu counted",
            (unsigned long long)cut, (unsigned long)counted);
    CHECK(cut_samples(8, 0.999, &counted, &scaled) == 0 && counted == 0,
            "with a unit 2^8 times as large %lu are counted",
            (unsigned long)counted);
    NOTE("%llu of 3 times %lu cut and counted; the largest is %.0f 2^8",
            (unsigned long long)cut, 1ul << 20, scaled);
}

/* ---- A surface of our own ---------------------------------------------- */

static ql_diag_t diag;

/* A floor of a unit's size at z = 16000, and what else has been added. */
static void add_patch(void)
{
    add_square(16000, 16008, 16000, true, mini_material(&m, 1, 0));
}

/* The surface of the patch, its point moved to p. */
static void patch_at(ql_vec3_t p, ql_surface_t *surface)
{
    unsigned i = 0;

    while (ql_scene_material(&scene, scene.triangles + i)->albedo[0] == 0 ||
            ql_scene_sphere(&scene, scene.triangles + i) != NULL) {
        i++;
    }
    memset(surface, 0, sizeof *surface);
    surface->n = ql_vec_cross(
            ql_vec_sub(ql_scene_corner(&scene, scene.triangles + i, 1),
                    ql_scene_corner(&scene, scene.triangles + i, 0)),
            ql_vec_sub(ql_scene_corner(&scene, scene.triangles + i, 2),
                    ql_scene_corner(&scene, scene.triangles + i, 0)));
    surface->inv_n = QL_LE32(scene.triangles[i].inv_n);
    surface->p = p;
}

static const ql_blob_material_t *white(void)
{
    const ql_blob_material_t *at = scene.materials;

    while (at->albedo[0] == 0) {
        at++;
    }
    return at;
}

/* The first vertex of a path, there, of throughput 1. */
static void begin_vertex(ql_vertex_t *vertex, const ql_surface_t *surface)
{
    static const ql_rgb_t one = {{QL_UQ31_ONE, QL_UQ31_ONE, QL_UQ31_ONE}, 0};
    static const ql_vec3_t down = {0, 0, -1};

    vertex->dim = QL_DIM_BOUNCE(0);
    vertex->surface = *surface;
    vertex->throughput = &one;
    vertex->reflected = one;
    ql_bsdf_begin(&vertex->bsdf, &scene, &vertex->surface, white(), true, down);
}

/* Light drawn towards the emitters from there, in units of theirs. */
static stats_moments_t light_at(
        unsigned direct, const ql_surface_t *surface, uint32_t samples)
{
    const ql_settings_t s = settings_of(direct, 0);
    stats_moments_t got = {0, 0, 0};
    ql_sampler_t sampler;
    ql_sum_t sum;
    const ql_context_t context = {.scene = &scene,
            .settings = &s,
            .sampler = &sampler,
            .sum = &sum,
            .diag = &diag};
    ql_vertex_t vertex;

    begin_vertex(&vertex, surface);
    ql_sampler_begin(&sampler, s.sampler, s.seed, 0, 0);
    memset(&diag, 0, sizeof diag);
    for (uint32_t i = 0; i < samples; i++) {
        memset(&sum, 0, sizeof sum);
        ql_sampler_start(&sampler, i);
        ql_next_event(&context, &vertex);
        stats_add(&got, ldexp((double)sum.rgb[0], -QL_SUM_BITS) / RADIANCE);
    }
    return got;
}

/* The point of the lamp that a sample draws, as the surface itself. */
static void check_same_point(unsigned direct, uint32_t index)
{
    const ql_settings_t s = settings_of(direct, 0);
    const ql_vec3_t below = vec(16004 * ONE, 16004 * ONE, 16001 * ONE);
    ql_sampler_t sampler;
    ql_sum_t sum = {{0, 0, 0}};
    const ql_context_t context = {.scene = &scene,
            .settings = &s,
            .sampler = &sampler,
            .sum = &sum,
            .diag = &diag};
    ql_emit_point_t point;
    ql_surface_t surface;
    ql_uniform2_t u;
    ql_vertex_t vertex;
    uint16_t light;
    ql_vec3_t w;

    ql_sampler_begin(&sampler, s.sampler, s.seed, 0, 0);
    ql_sampler_start(&sampler, index);
    u = ql_sampler_2d(&sampler, QL_DIM_BOUNCE(0) + QL_DIM_LIGHT_POINT);
    light = ql_light_choose(&scene, QL_LIGHTS_POWER,
            ql_sampler_1d(&sampler, QL_DIM_BOUNCE(0) + QL_DIM_LIGHT_PICK));
    CHECK(ql_emit_triangle_facing(&scene, light, below, u, &point, &w) > 0,
            "sample %lu is lit from below", (unsigned long)index);
    patch_at(point.q, &surface);
    (void)ql_emit_triangle_facing(&scene, light, surface.p, u, &point, &w);
    CHECK((w.x | w.y) == 0, "the point is not the surface");
    begin_vertex(&vertex, &surface);
    ql_next_event(&context, &vertex);
    CHECK(sum.rgb[0] == 0, "direct %u, sample %lu adds %llu", direct,
            (unsigned long)index, (unsigned long long)sum.rgb[0]);
}

TEST(case_29_a_point_of_the_light_that_is_the_surface_adds_nothing)
{
    for (unsigned two = 0; two < 2; two++) {
        mini_begin(&m);
        m.two_sided = two;
        add_patch();
        add_square(15000, 17000, 16500, false, mini_material(&m, 0, RADIANCE));
        mini_open(&m, &scene);
        for (uint32_t i = 0; i < 2000; i++) {
            check_same_point(QL_DIRECT_AREA, i);
            if (is_built(QL_DIRECT_MIS)) {
                check_same_point(QL_DIRECT_MIS, i);
            }
        }
    }
    CHECK(diag.saturated == 0, "%lu saturated", (unsigned long)diag.saturated);
    NOTE("2000 points, each its own surface, one- and two-sided");
}

/* ---- Spheres ----------------------------------------------------------- */

#if QL_CFG_SPHERES
/* A patch and a lamp; its centre from the patch's point, an ulp up, in 1/256
 * units. The surface at that point. */
static void make_ball(
        const int32_t from[3], int32_t radius, bool two_sided, ql_surface_t *at)
{
    const ql_vec3_t p = vec(16004 * ONE, 16004 * ONE, 16000 * ONE + 1);
    const int32_t to_q8 = 256 / ONE;
    const int32_t centre[3] = {p.x * to_q8 + from[0], p.y * to_q8 + from[1],
            p.z * to_q8 + from[2]};

    mini_begin(&m);
    m.two_sided = two_sided;
    add_patch();
    (void)mini_sphere(&m, centre, radius, mini_material(&m, 0, RADIANCE));
    mini_open(&m, &scene);
    patch_at(p, at);
}

/* By how much the mean is off, in what its own spread allows and the stated
 * errors of directions: a part in 2^14 (draft) or 2^24. */
static double off_of(const stats_moments_t *got, double want)
{
    const double error = sqrt(stats_variance(got) / got->n);

    return (got->mean - want) /
           (STATS_Z_MAX * error + want * (QL_POS_BITS > 0 ? 0x1p-24 : 0x1p-13) +
                   0x1p-25);
}

TEST(case_30_inside_a_sphere_light_is_1_on_it_counts_as_inside)
{
    static const int32_t radius = 1000 * 256;
    /* where the lowest point of the sphere is above the surface */
    const int32_t ulp = 256 / ONE;
    const int32_t gaps[] = {
            -radius, -radius / 2, -2 * ulp, -ulp, 0, ulp, 2 * ulp};
    double just_outside = 0;

    for (unsigned i = 0; i < sizeof gaps / sizeof gaps[0]; i++) {
        const int32_t from[3] = {0, 0, radius + gaps[i]};
        const double h = 1 + (double)gaps[i] / radius;

        for (unsigned two = 0; two < 2; two++) {
            ql_surface_t at;
            stats_moments_t cone, area;
            double want;

            make_ball(from, radius, two, &at);
            want = gaps[i] > 0 ? 1 / (h * h) : two;
            cone = light_at(QL_DIRECT_SOLID_ANGLE, &at, 1u << 14);
            CHECK(fabs(off_of(&cone, want)) < 1, "gap %ld: %.6f, want %.6f",
                    (long)gaps[i], cone.mean, want);
            CHECK(want > 0 || cone.m2 == 0, "gap %ld: not 0", (long)gaps[i]);
            area = light_at(QL_DIRECT_AREA, &at, 1u << 14);
            /* next to the sphere a point in 10^8 has all of the light */
            CHECK(gaps[i] > -radius / 2 || fabs(off_of(&area, want)) < 1,
                    "gap %ld by area: %.6f, want %.6f", (long)gaps[i],
                    area.mean, want);
            CHECK(area.mean >= 0 && area.mean < 40 && diag.saturated == 0,
                    "gap %ld by area: %g", (long)gaps[i], area.mean);
            just_outside = gaps[i] == ulp ? cone.mean : just_outside;
        }
    }
    NOTE("inside 1, on it 1 (one-sided 0), an ulp outside %.4f", just_outside);
}

/* The estimator before its sum is rounded: cos / (pi pdf), exact to 26 bits. */
static double aimed_at(const ql_surface_t *surface, uint32_t samples)
{
    ql_sampler_t sampler;
    double sum = 0;

    ql_sampler_begin(&sampler, QL_SAMPLER_SOBOL, 31, 0, 0);
    for (uint32_t i = 0; i < samples; i++) {
        ql_emit_sample_t sample;

        ql_sampler_start(&sampler, i);
        if (ql_emit_sample(&scene, QL_DIRECT_SOLID_ANGLE, 0, surface,
                    ql_sampler_2d(&sampler, 0), &sample)) {
            sum += ldexp(sample.cosine.m, sample.cosine.e) *
                   ldexp(sample.inv_pdf.m, sample.inv_pdf.e) / PI;
        }
    }
    return sum / samples;
}

/* Sums hold 24 bits of the brightest emitter's radiance, so of what a lamp of
 * R/d = 1e-3 adds, 1e-6 of it, 4 bits are left, and of 1e-4 none. */
TEST(case_31_far_sphere_light_has_its_form_factor_within_a_part_in_1000)
{
    double worst = 0, kept[4] = {0, 0, 0, 0};
    unsigned row = 0;

    for (int32_t radius = 1000 * 256; radius >= 256; radius /= 10, row++) {
        for (unsigned i = 0; i < 3; i++) {
            const double angle = i * PI / 6;
            const int32_t from[3] = {(int32_t)(2560000 * sin(angle)), 0,
                    (int32_t)(2560000 * cos(angle))};
            const double d2 = pow(from[0], 2) + pow(from[2], 2);
            const double want = pow(radius, 2) / d2 * from[2] / sqrt(d2);
            ql_surface_t at;
            stats_moments_t got;
            double f;

            make_ball(from, radius, false, &at);
            f = aimed_at(&at, 1u << 12);
            CHECK(fabs(f / want - 1) < 1e-3,
                    "R/d %g, %u degrees: %.9g, want %.9g", radius / 2.56e6,
                    i * 30, f, want);
            worst = fmax(worst, fabs(f / want - 1));
            got = light_at(QL_DIRECT_SOLID_ANGLE, &at, 1u << 14);
            /* half up from QL_FAINT units on, by chance below */
            CHECK(fabs(got.mean - want) <
                            STATS_Z_MAX * sqrt(stats_variance(&got) / got.n) +
                                    (want * RADIANCE > 0x1p-16 ? 0x1p-25 : 0) /
                                            RADIANCE,
                    "R/d %g, %u degrees, summed: %.9g, want %.9g",
                    radius / 2.56e6, i * 30, got.mean, want);
            kept[row] = fmax(kept[row], fabs(got.mean / want - 1));
        }
    }
    NOTE("worst %.0e; summed, by R/d: %.0e %.0e %.0e %.0e", worst, kept[0],
            kept[1], kept[2], kept[3]);
}

TEST(case_32_sphere_light_below_the_horizon_by_one_degree_or_none)
{
    static const int32_t radius = 4096 * 256;
    const double d = 2.0 * radius, known = 7.283674979095e-6;
    const int32_t tangent[3] = {(int32_t)(d * sqrt(0.75)), 0, -radius};
    const int32_t above[3] = {(int32_t)lrint(d * sin(119 * PI / 180)), 0,
            (int32_t)lrint(d * cos(119 * PI / 180))};
    ql_surface_t at;
    stats_moments_t cone, area;

    make_ball(above, radius, false, &at);
    cone = light_at(QL_DIRECT_SOLID_ANGLE, &at, 1u << 19);
    area = light_at(QL_DIRECT_AREA, &at, 1u << 19);
    CHECK(fabs(off_of(&cone, known)) < 1, "119 degrees: %.4g, want %.4g",
            cone.mean, known);
    CHECK(fabs(off_of(&area, known)) < 1,
            "119 degrees by area: %.4g, want %.4g", area.mean, known);
    make_ball(tangent, radius, false, &at);
    CHECK(light_at(QL_DIRECT_SOLID_ANGLE, &at, 1u << 18).mean == 0 &&
                    light_at(QL_DIRECT_AREA, &at, 1u << 18).mean == 0 &&
                    light_at(QL_DIRECT_MIS, &at, 1u << 18).mean == 0,
            "120 degrees: not black");
    NOTE("119 degrees %.3e +- %.0e, by area %.3e; 120 degrees 0", cone.mean,
            sqrt(stats_variance(&cone) / cone.n), area.mean);
}
#endif

int main(int argc, char **argv)
{
    TEST_BEGIN("extreme/light", argc, argv);
    state = 0;
    RUN(case_22_no_light_comes_through_a_plane_one_or_two_units_above);
    RUN(case_23_closed_box_under_light_is_black_after_64_bounces);
    RUN(case_24_light_in_the_plane_of_the_receiver_gives_nothing);
    RUN(case_25_light_behind_the_receiver_and_behind_the_light_is_nothing);
    RUN(case_26_light_that_crosses_the_horizon_has_the_known_form_factor);
    RUN(case_27_light_standing_on_the_floor_is_finite_and_unbiased);
    RUN(case_28_samples_next_to_the_surface_are_cut_counted_and_never_wrap);
    RUN(case_29_a_point_of_the_light_that_is_the_surface_adds_nothing);
#if QL_CFG_SPHERES
    RUN(case_30_inside_a_sphere_light_is_1_on_it_counts_as_inside);
    RUN(case_31_far_sphere_light_has_its_form_factor_within_a_part_in_1000);
    RUN(case_32_sphere_light_below_the_horizon_by_one_degree_or_none);
#endif
    return TEST_END();
}
