/* test_light.c - emitters chosen by their share, points exactly on them */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <stdlib.h>

#include "support/picture/mini_scene.h"
#include "support/ql_stats.h"
#include "support/ql_test.h"
#include "base/ql_settings.h"
#include "warp/ql_warp.h"
#include "light/ql_light.h"

#if QL_CFG_LIGHTS

#define ONE (1 << QL_POS_BITS)

static mini_scene_t mini;
static ql_scene_t scene;

/* Lamps of areas 1 : 2 : 4 : ..., the brightest 8 times the dimmest, among
 * triangles that emit nothing. */
static void build(unsigned lamps)
{
    uint16_t dark, light;

    mini_begin(&mini);
    dark = mini_material(&mini, 0.5, 0);
    light = mini_material(&mini, 0, 0.5);
    for (int32_t i = 0; i < (int32_t)lamps; i++) {
        const int32_t size = 100 << i / 2, high = size << i % 2;
        const int32_t at = 500 + 2100 * i;
        const int32_t a[3] = {at, 9000 + i, 8}, b[3] = {at + size, 9000, 32759};
        const int32_t c[3] = {at, 9000 + high, 8 + 2700 * i};

        mini_triangle(&mini, a, b, c, dark);
        mini_triangle(&mini, a, c, b, light);
    }
    mini_open(&mini, &scene);
}

/* ---- Choice ------------------------------------------------------------ */

static double mass_of(uint16_t light)
{
    const double low = QL_LE32(scene.lights[light].cum);
    const double high = light + 1 < scene.light_count
                                ? QL_LE32(scene.lights[light + 1].cum)
                                : 4294967296.0;

    return (high - low) / 4294967296.0;
}

static double value(ql_real_t r)
{
    return ldexp(r.m, r.e);
}

TEST(each_emitter_is_chosen_for_its_share_and_weighs_its_inverse)
{
    const double two_pi = 6.283185307179586;

    for (unsigned lamps = 1; lamps <= 12; lamps++) {
        build(lamps);
        CHECK(scene.light_count == lamps, "%u lights", scene.light_count);
        for (uint16_t i = 0; i < scene.light_count; i++) {
            const uint32_t first = QL_LE32(scene.lights[i].cum);
            const uint32_t last = i + 1 < scene.light_count
                                          ? QL_LE32(scene.lights[i + 1].cum) - 1
                                          : 0xffffffffu;
            const ql_blob_tri_t *tri =
                    scene.triangles + QL_LE16(scene.lights[i].triangle);
            const ql_vec3_t corner = ql_scene_corner(&scene, tri, 0);
            const double weight =
                    value(ql_light_weight(&scene, QL_LIGHTS_POWER, 1, i));
            ql_light_point_t p;

            CHECK(ql_light_choose(&scene, QL_LIGHTS_POWER, first) == i &&
                            ql_light_choose(&scene, QL_LIGHTS_POWER, last) == i,
                    "light %u of %u: another one was chosen", i, lamps);
            ql_light_point(&scene, i, 77, 99, &p);
            CHECK(p.corner.x == corner.x && p.corner.y == corner.y &&
                            p.corner.z == corner.z,
                    "light %u of %u: a point of another one", i, lamps);
            CHECK(fabs(weight * two_pi * mass_of(i) - 1) < 1e-8,
                    "light %u of %u weighs %.9f, its mass is %.9f", i, lamps,
                    weight, mass_of(i));
            CHECK(QL_LE32(p.material->emission[0]) > 0, "light %u is dark", i);
        }
    }
}

/* Sum over lights of weight times probability: 1 / (2 pi) each. */
TEST(weights_times_probabilities_count_every_emitter_once)
{
    double sum = 0;

    build(12);
    for (uint32_t k = 0; k < 65536; k++) {
        const uint16_t i =
                ql_light_choose(&scene, QL_LIGHTS_POWER, k << 16 | 0x8000u);

        sum += value(ql_light_weight(&scene, QL_LIGHTS_POWER, 1, i)) / 65536;
    }
    sum *= 6.283185307179586;
    /* 2^16 steps of u resolve each mass to 2^-16 */
    CHECK(fabs(sum - 12) < 12.0 * 12 / 65536 * 200, "%.4f, not 12", sum);
    NOTE("%.4f of 12", sum);
}

#if QL_CFG_STRATEGIES
/* The bounds of equal shares: the last u of each light and the next one. */
TEST(uniform_choice_has_the_probability_it_divides_by)
{
    const double two_pi = 6.283185307179586;

    for (unsigned lamps = 1; lamps <= 12; lamps++) {
        uint64_t begin = 0;

        build(lamps);
        for (uint16_t i = 0; i < lamps; i++) {
            /* light i has every u with floor(u lamps / 2^32) = i */
            const uint64_t end =
                    (((uint64_t)i + 1) * 4294967296u + lamps - 1) / lamps;
            const double mass = (double)(end - begin) / 4294967296.0;
            const double weight =
                    value(ql_light_weight(&scene, QL_LIGHTS_UNIFORM, 1, i));

            CHECK(ql_light_choose(&scene, QL_LIGHTS_UNIFORM, (uint32_t)begin) ==
                                    i &&
                            ql_light_choose(&scene, QL_LIGHTS_UNIFORM,
                                    (uint32_t)(end - 1)) == i,
                    "light %u of %u: another one was chosen", i, lamps);
            CHECK(fabs(weight * two_pi * mass - 1) < 4e-9,
                    "light %u of %u weighs %.10f, its mass is %.10f", i, lamps,
                    weight, mass);
            begin = end;
        }
        CHECK(begin == 4294967296u, "%u lights leave out numbers", lamps);
    }
}

TEST(samples_divide_the_weight_and_all_lights_weigh_1)
{
    build(5);
    for (unsigned n = 1; n <= 255; n++) {
        const double all = value(ql_light_weight(&scene, QL_LIGHTS_ALL, n, 3));
        const double one =
                value(ql_light_weight(&scene, QL_LIGHTS_POWER, 1, 3));
        const double part =
                value(ql_light_weight(&scene, QL_LIGHTS_POWER, n, 3));

        CHECK(fabs(all * n * 6.283185307179586 - 1) < 4e-9, "%u: %.10f", n,
                all);
        CHECK(fabs(part * n / one - 1) < 4e-9, "%u: %.10f", n, part * n / one);
    }
}

TEST(each_light_is_found_by_its_triangle_and_nothing_else_is)
{
    for (unsigned lamps = 1; lamps <= 12; lamps++) {
        unsigned found = 0;

        build(lamps);
        for (uint32_t t = 0; t <= 65535; t++) {
            uint16_t light;

            if (ql_light_find(&scene, (uint16_t)t, &light)) {
                CHECK(light < lamps &&
                                QL_LE16(scene.lights[light].triangle) == t,
                        "triangle %lu is not light %u", (unsigned long)t,
                        light);
                found++;
            }
        }
        CHECK(found == lamps, "%u of %u lights", found, lamps);
    }
}
#endif

/* ---- Points ------------------------------------------------------------ */

static double worst;

static void check_point(uint32_t pick, uint32_t u1, uint32_t u2)
{
    ql_light_point_t p;
    ql_vec3_t c[3], n;
    uint32_t b1, b2;
    int64_t q[3];
    double exact[3];
    unsigned light = 0;

    ql_light_point(
            &scene, ql_light_choose(&scene, QL_LIGHTS_POWER, pick), u1, u2, &p);
    while (light + 1u < scene.light_count &&
            QL_LE32(scene.lights[light + 1].cum) <= pick) {
        light++;
    }
    for (unsigned k = 0; k < 3; k++) {
        c[k] = ql_scene_corner(&scene,
                scene.triangles + QL_LE16(scene.lights[light].triangle), k);
    }
    n = ql_vec_cross(ql_vec_sub(c[1], c[0]), ql_vec_sub(c[2], c[0]));
    CHECK(p.n.x == n.x && p.n.y == n.y && p.n.z == n.z, "light %u's normal",
            light);
    ql_warp_triangle(u1, u2, &b1, &b2);
    exact[0] = c[0].x + ldexp((double)b1 * (c[1].x - c[0].x) +
                                        (double)b2 * (c[2].x - c[0].x),
                                -QL_BARY_BITS);
    exact[1] = c[0].y + ldexp((double)b1 * (c[1].y - c[0].y) +
                                        (double)b2 * (c[2].y - c[0].y),
                                -QL_BARY_BITS);
    exact[2] = c[0].z + ldexp((double)b1 * (c[1].z - c[0].z) +
                                        (double)b2 * (c[2].z - c[0].z),
                                -QL_BARY_BITS);
    q[0] = p.q.x;
    q[1] = p.q.y;
    q[2] = p.q.z;
    for (unsigned k = 0; k < 3; k++) {
        const double off = fabs((double)q[k] - exact[k] * ONE);

        worst = fmax(worst, off);
        CHECK(off <= 0.5 + 1e-6, "u %08lx %08lx %08lx, axis %u: off by %.4f",
                (unsigned long)pick, (unsigned long)u1, (unsigned long)u2, k,
                off);
    }
}

TEST(points_are_within_half_a_unit)
{
    static const uint32_t ends[] = {0, 1, 0x40000000u, 0x7fffffffu, 0x80000000u,
            0xc0000000u, 0xfffffffeu, 0xffffffffu};
    uint64_t state = 1;

    worst = 0;
    build(12);
    for (unsigned i = 0; i < 512; i++) {
        check_point(ends[i & 7], ends[i >> 3 & 7], ends[i >> 6]);
    }
    for (long i = 0; i < 500000; i++) {
        const uint64_t bits = stats_random(&state);

        check_point((uint32_t)stats_random(&state), (uint32_t)bits,
                (uint32_t)(bits >> 32));
    }
    NOTE("worst %.6f", worst);
}

/* Mean over a jittered lattice of u: the centre of gravity. */
TEST(points_average_to_the_centre_of_gravity)
{
    static const int32_t v[3][3] = {
            {8, 8, 8}, {32759, 100, 20000}, {300, 32759, 10000}};
    double mean[3] = {0, 0, 0};
    uint64_t state = 2;

    mini_begin(&mini);
    mini_triangle(&mini, v[0], v[1], v[2], mini_material(&mini, 0, 0.5));
    mini_open(&mini, &scene);
    for (uint32_t i = 0; i < 1024 * 1024; i++) {
        ql_light_point_t p;

        const uint32_t jitter = (uint32_t)stats_random(&state);

        ql_light_point(&scene, 0, i << 22 | jitter >> 10,
                i >> 10 << 22 | (jitter & 0x3fffffu), &p);
        mean[0] += ldexp(p.q.x, -20) / ONE;
        mean[1] += ldexp(p.q.y, -20) / ONE;
        mean[2] += ldexp(p.q.z, -20) / ONE;
    }
    for (unsigned k = 0; k < 3; k++) {
        const double centre = (v[0][k] + v[1][k] + v[2][k]) / 3.0;

        CHECK(fabs(mean[k] - centre) < 0.1, "axis %u: %.4f, not %.4f", k,
                mean[k], centre);
    }
    NOTE("off by %.4f %.4f %.4f", mean[0] - (v[0][0] + v[1][0] + v[2][0]) / 3.0,
            mean[1] - (v[0][1] + v[1][1] + v[2][1]) / 3.0,
            mean[2] - (v[0][2] + v[1][2] + v[2][2]) / 3.0);
}

#else

TEST(emitters_are_named_as_missing)
{
    ql_blob_header_t header = {0};

    header.features = QL_LE32(QL_FEATURE_LIGHTS);
    CHECK(strcmp(ql_blob_missing(&header), "lights") == 0, "%s",
            ql_blob_missing(&header));
}

#endif

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_light", argc, argv);
#if QL_CFG_LIGHTS
    RUN(each_emitter_is_chosen_for_its_share_and_weighs_its_inverse);
    RUN(weights_times_probabilities_count_every_emitter_once);
#if QL_CFG_STRATEGIES
    RUN(uniform_choice_has_the_probability_it_divides_by);
    RUN(samples_divide_the_weight_and_all_lights_weigh_1);
    RUN(each_light_is_found_by_its_triangle_and_nothing_else_is);
#endif
    RUN(points_are_within_half_a_unit);
    RUN(points_average_to_the_centre_of_gravity);
#else
    RUN(emitters_are_named_as_missing);
#endif
    return TEST_END();
}
