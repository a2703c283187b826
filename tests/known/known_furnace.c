/* known_furnace.c - closed rooms that shine everywhere: a geometric series */
/* SPDX-License-Identifier: MIT */

/* Inside a closed room whose walls all emit 1 and reflect a, radiance after K
 * reflections is (1 - a^(K+1)) / (1 - a) in every direction: emission seen
 * directly, and one term a^k of light sampled at each of K vertices.
 *
 * In a cube the area estimator has no variance: close to an edge 1/r^2 is
 * unbounded (the mean is finite), so the spread of samples says nothing of the
 * error. With MIS no vertex adds more than 2 a. In a ball of many triangles the
 * area estimator is nearly constant. Means are judged by the spread of
 * independent pictures. */

#include <math.h>

#include "support/picture/estimate.h"
#include "support/ql_test.h"
#include "qlux.h"
#include "math/vec/ql_vec_unit.h"
#include "render/ql_next_event.h"
#include "warp/ql_warp_hemisphere.h"
#include "trace/ql_bvh.h"
#include "trace/surface/ql_surface_at.h"

static mini_scene_t m;

/* ---- Rooms ------------------------------------------------------------- */

#define UNIT 0.5 /* emission; the pictures are divided by it */

static void look_around(double x, double y, double z)
{
    static const double right[3] = {0.25, 0, -0.125}, up[3] = {0, 0.25, 0};

    mini_eye(&m, x, y, z);
    mini_look(&m, 0.125, 0.0625, 0.25);
    mini_field(&m, right, up);
}

static void make_cube(double albedo)
{
    static const int32_t low[3] = {384, 384, 384},
                         high[3] = {32384, 32384, 32384};

    mini_begin(&m);
    mini_room(&m, low, high, mini_material(&m, albedo, UNIT));
    m.radiance_exp = 4; /* room for 1/r^2 */
    look_around(14000, 17000, 12000);
}

static void make_ball(double albedo)
{
    mini_begin(&m);
    mini_ball(&m, 12, mini_material(&m, albedo, UNIT));
    m.contact = true;
    look_around(15000, 17000, 14000);
}

/* ---- The series -------------------------------------------------------- */

static const uint8_t reflections[] = {0, 1, 2, 4, 8, 16, 64};
enum { KS = sizeof reflections };

static const double albedos[] = {0.5, 0.8, 0.9, 0.99, 1};
enum { ALBEDOS = sizeof albedos / sizeof *albedos };

/* K reflections are K vertices with light sampled: bounces + 1. */
static double series(double albedo, unsigned k)
{
    return albedo < 1 ? (1 - pow(albedo, k + 1)) / (1 - albedo) : k + 1;
}

/* The radiance of the whole picture after each number of reflections, as means
 * of independent pictures. The pictures of one seed share their paths. K = 0
 * has no light sampled at all. */
enum { PICTURES = 12 };

static void measure(
        stats_moments_t means[KS], ql_direct_t direct, uint32_t samples)
{
    for (int i = 0; i < KS; i++) {
        means[i].n = means[i].mean = means[i].m2 = 0;
    }
    for (uint32_t seed = 0; seed < PICTURES; seed++) {
        for (int i = 0; i < KS; i++) {
            const unsigned k = reflections[i];
            ql_settings_t s = estimate_settings(
                    QL_SAMPLER_SOBOL, (uint8_t)(k > 0 ? k - 1 : 0), 40 + seed);

            s.direct = (uint8_t)(k == 0 ? QL_DIRECT_NONE : direct);
            stats_add(means + i,
                    estimate_pixel(&m, &s, 0, 0, k > 8 ? samples / 8 : samples)
                                    .mean /
                            UNIT);
        }
    }
}

/* How many standard errors the means are off, and how large a part for sure: a
 * path next to an edge may put one picture off by more than all the others. */
static void compare(
        const stats_moments_t means[KS], double albedo, double *z, double *part)
{
    *z = *part = 0;
    for (int i = 0; i < KS; i++) {
        const double off = means[i].mean - series(albedo, reflections[i]);
        const double error = sqrt(stats_variance(means + i) / means[i].n);

        /* a part in 10^6 for the rounding of sums and albedos, which is all
         * there is at K = 0 */
        *z = fmax(*z, fabs(off) / (error + 1e-6 * means[i].mean));
        *part = fmax(*part, (fabs(off) - stats_t_limit(1, PICTURES) * error) /
                                    series(albedo, reflections[i]));
        if (isnan(off)) {
            *z = *part = HUGE_VAL;
        }
    }
}

/* What z may be: of every albedo, every number of reflections. */
static double z_max(void)
{
    return stats_t_limit(ALBEDOS * KS, PICTURES);
}

static void claim_series(void (*make)(double), ql_direct_t direct,
        uint32_t samples, double part_max)
{
    double worst_z = 0, worst_part = 0;

    for (int i = 0; i < ALBEDOS; i++) {
        stats_moments_t means[KS];
        double z, part;

        make(albedos[i]);
        measure(means, direct, samples);
        compare(means, albedos[i], &z, &part);
        CHECK(z < z_max() && part < part_max,
                "albedo %g: K=1 %.5f, K=64 %.5f want %.5f, z %.1f, off %.1e",
                albedos[i], means[1].mean, means[KS - 1].mean,
                series(albedos[i], 64), z, part);
        worst_z = fmax(worst_z, z);
        worst_part = fmax(worst_part, part);
    }
    NOTE("5 albedos, K = 0..64; worst z %.1f, worst part off %.0e", worst_z,
            worst_part);
}

/* The largest part that the ball may be off for sure. */
#define BALL_PART 1e-6

TEST(cube_gives_the_series_after_every_number_of_reflections)
{
    claim_series(make_cube, QL_DIRECT_MIS, 1u << 11, 0.02);
}

TEST(ball_gives_the_series_and_loses_nothing)
{
    claim_series(make_ball, QL_DIRECT_AREA, 1u << 9, BALL_PART);
}

TEST(ball_rejects_a_reflection_too_many)
{
    stats_moments_t means[KS];
    double z, part;

    make_ball(0.8);
    measure(means, QL_DIRECT_AREA, 1u << 9);
    for (int i = KS - 1; i > 0; i--) {
        means[i] = means[i - 1];
    }
    compare(means, 0.8, &z, &part);
    CHECK(z > z_max() && part > BALL_PART, "z %.1f, off %.1e", z, part);
}

TEST(ball_rejects_light_pdf_scaled_by_1_02)
{
    stats_moments_t means[KS];
    double z, part;

    make_ball(0.8);
    m.light_weight_scale = 1 / 1.02;
    measure(means, QL_DIRECT_AREA, 1u << 9);
    compare(means, 0.8, &z, &part);
    CHECK(z > z_max() && part > BALL_PART, "z %.1f, off %.1e", z, part);
    NOTE("z %.0f", z);
}

/* Emission counted again where a path hits it: 1 + 2a + .. instead. */
TEST(ball_rejects_emitters_counted_twice)
{
    stats_moments_t means[KS];
    double z, part;

    make_ball(0.5);
    measure(means, QL_DIRECT_AREA, 1u << 9);
    for (int i = 1; i < KS; i++) {
        means[i].mean = 2 * means[i].mean - 1;
    }
    compare(means, 0.5, &z, &part);
    CHECK(z > z_max() && part > BALL_PART, "z %.1f, off %.1e", z, part);
}

/* ---- Exact claims ------------------------------------------------------ */

TEST(emission_seen_by_the_camera_is_exact_and_counted_once)
{
    ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 64, 1);
    stats_moments_t got;

    make_cube(0.75);
    s.direct = QL_DIRECT_NONE;
    got = estimate_pixel(&m, &s, 0, 0, 1000);
    CHECK(got.mean == UNIT && got.m2 == 0,
            "64 bounces without light sampling: "
            "%.9f",
            got.mean);
    s.direct = QL_DIRECT_AREA;
    make_cube(0);
    got = estimate_pixel(&m, &s, 0, 0, 1000);
    CHECK(got.mean == UNIT && got.m2 == 0, "albedo 0: %.9f", got.mean);
}

/* The same path put together from the parts, its throughput a constant 1. */
static void trace_white(const ql_scene_t *scene, const ql_sampler_t *sampler,
        ql_ray_t ray, unsigned bounces, ql_sum_t *sum)
{
    static const ql_rgb_t one = {{QL_UQ31_ONE, QL_UQ31_ONE, QL_UQ31_ONE}, 0};
    const ql_settings_t settings = {
            .direct = QL_DIRECT_AREA, .light_samples = 1};
    ql_diag_t diag = {0};
    const ql_context_t context = {.scene = scene,
            .settings = &settings,
            .sampler = sampler,
            .sum = sum,
            .diag = &diag};
    ql_vertex_t vertex = {.throughput = &one, .reflected = one};

    for (unsigned bounce = 0; bounce <= bounces; bounce++) {
        const uint32_t dim = QL_DIM_BOUNCE(bounce);
        const ql_uniform2_t u = ql_sampler_2d(sampler, dim + QL_DIM_DIRECTION);
        ql_surface_t *const surface = &vertex.surface;
        ql_hit_t hit;
        ql_vec3_t n;

        if (!ql_bvh_closest_hit(scene, &ray, &hit)) {
            return;
        }
        ql_surface_at(scene, &ray, &hit, surface);
        ql_bsdf_begin(&vertex.bsdf, scene, surface,
                ql_scene_material(scene, scene->triangles + hit.tri_idx),
                hit.front, ray.direction);
        vertex.dim = dim;
        ql_next_event(&context, &vertex);
        n = ql_vec_unit_q29_of_inv_n(surface->n, surface->inv_n);
        ray.origin = surface->p;
        ray.direction = ql_vec_to_dir(ql_warp_hemisphere_cosine(n, u.u1, u.u2));
        if (ql_vec_dot_normal(ray.direction, surface->n) <= 0) {
            ray.direction = ql_vec_to_dir(n);
        }
    }
}

TEST(albedo_1_loses_nothing_in_64_bounces)
{
    ql_settings_t s = estimate_settings(QL_SAMPLER_SOBOL, 64, 7);
    ql_scene_t scene;
    ql_render_t render;

    make_cube(1);
    mini_open(&m, &scene);
    CHECK(ql_render_init(&render, &scene, &s) == QL_OK, "settings");
    for (uint32_t i = 0; i < 500; i++) {
        ql_sum_t got = {{0, 0, 0}}, want = {{0, 0, 0}};
        ql_camera_pixel_t pixel;
        ql_sampler_t sampler;
        ql_uniform2_t u;
        ql_ray_t ray;

        ql_render_pixel(&render, 0, 0, i, 1, &got);
        ql_camera_pixel(&pixel, &render.camera, 0, 0);
        ql_sampler_begin(&sampler, s.sampler, s.seed, 0, 0);
        ql_sampler_start(&sampler, i);
        u = ql_sampler_2d(&sampler, QL_DIM_PIXEL);
        CHECK(ql_camera_ray(&pixel, u, u, &ray), "no ray");
        trace_white(&scene, &sampler, ray, s.bounces, &want);
        for (int k = 0; k < 3; k++) {
            want.rgb[k] += (uint64_t)ldexp(UNIT, QL_SUM_BITS - m.radiance_exp);
            CHECK(got.rgb[k] == want.rgb[k], "path %lu: %lu, want %lu",
                    (unsigned long)i, (unsigned long)got.rgb[k],
                    (unsigned long)want.rgb[k]);
        }
    }
    NOTE("500 paths bit for bit");
}

/* Paths of 65 rays that end before, in a room without a hole. */
static uint32_t escaped(uint32_t paths)
{
    const ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 64, 8);
    ql_scene_t scene;
    ql_render_t render;
    uint32_t count = 0;

    mini_open(&m, &scene);
    CHECK(ql_render_init(&render, &scene, &s) == QL_OK, "settings");
    for (uint32_t i = 0; i < paths; i++) {
        ql_sum_t sum = {{0, 0, 0}};

        render.diag.closest_rays = 0;
        ql_render_pixel(&render, 0, 0, i, 1, &sum);
        count += render.diag.closest_rays != 65;
    }
    return count;
}

TEST(no_ray_leaves_a_cube)
{
    make_cube(1);
    CHECK(escaped(10000) == 0, "%lu paths left", (unsigned long)escaped(10000));
    NOTE("650000 rays");
}

/* Where planes meet at any angle a hit is rounded to the right side of its own
 * plane, and may be behind its neighbour within an ulp or two of the edge. */
TEST(no_ray_leaves_a_ball)
{
    make_ball(1);
    CHECK(escaped(4000) == 0, "%lu paths left", (unsigned long)escaped(4000));
    NOTE("260000 rays");
}

int main(int argc, char **argv)
{
    TEST_BEGIN("known/furnace", argc, argv);
    RUN(cube_gives_the_series_after_every_number_of_reflections);
    RUN(ball_gives_the_series_and_loses_nothing);
    RUN(ball_rejects_a_reflection_too_many);
    RUN(ball_rejects_light_pdf_scaled_by_1_02);
    RUN(ball_rejects_emitters_counted_twice);
    RUN(emission_seen_by_the_camera_is_exact_and_counted_once);
    RUN(albedo_1_loses_nothing_in_64_bounces);
    RUN(no_ray_leaves_a_cube);
    RUN(no_ray_leaves_a_ball);
    return TEST_END();
}
