/* test_emit_triangle.c - points of lamps, exactly on them and even */
/* SPDX-License-Identifier: MIT */

#include <math.h>

#include "light/ql_emit_triangle.h"
#include "light/ql_light.h"
#include "support/built.h"
#include "support/picture/lamps.h"
#include "support/ql_stats.h"
#include "support/ql_test.h"
#include "warp/ql_warp_plane.h"

TEST(a_way_of_finding_light_is_no_other_and_none_that_is_not_built)
{
    for (unsigned i = QL_DIRECT_NONE; i <= QL_DIRECT_MIS; i++) {
        for (unsigned k = QL_DIRECT_NONE; k <= QL_DIRECT_MIS; k++) {
            if (BUILT_HAS_DIRECT(i)) {
                CHECK(ql_direct_is(i, (ql_direct_t)k) == (i == k), "%u, %u", i,
                        k);
            } else {
                CHECK(!ql_direct_is(i, (ql_direct_t)i), "%u", i);
            }
        }
    }
    for (unsigned i = QL_LIGHTS_POWER; i <= QL_LIGHTS_UNIFORM; i++) {
        for (unsigned k = QL_LIGHTS_POWER; k <= QL_LIGHTS_UNIFORM; k++) {
            if (BUILT_HAS_LIGHTS(i)) {
                CHECK(ql_lights_is(i, (ql_light_choice_t)k) == (i == k),
                        "lights %u, %u", i, k);
            } else {
                CHECK(!ql_lights_is(i, (ql_light_choice_t)i), "lights %u", i);
            }
        }
    }
}

#if QL_CFG_LIGHTS

#define ONE (1 << QL_POS_BITS)

static double worst;

static void check_point(uint32_t pick, uint32_t u1, uint32_t u2)
{
    const ql_uniform2_t u = {u1, u2};
    ql_emit_point_t p;
    ql_vec3_t c[3], n;
    uint32_t b1, b2;
    int64_t q[3];
    double exact[3];
    unsigned light = 0;

    ql_emit_triangle_point(
            &scene, ql_light_choose(&scene, QL_LIGHTS_POWER, pick), u, &p);
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
    ql_warp_plane_triangle(u1, u2, &b1, &b2);
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
    build_lamps(12);
    for (unsigned i = 0; i < 512; i++) {
        check_point(ends[i & 7], ends[i >> 3 & 7], ends[i >> 6]);
    }
    for (long i = 0; i < MANY(500000); i++) {
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
        const uint32_t jitter = (uint32_t)stats_random(&state);
        const ql_uniform2_t u = {
                i << 22 | jitter >> 10, i >> 10 << 22 | (jitter & 0x3fffffu)};
        ql_emit_point_t p;

        ql_emit_triangle_point(&scene, 0, u, &p);
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

#endif

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_emit_triangle", argc, argv);
    RUN(a_way_of_finding_light_is_no_other_and_none_that_is_not_built);
#if QL_CFG_LIGHTS
    RUN(points_are_within_half_a_unit);
    RUN(points_average_to_the_centre_of_gravity);
#endif
    return TEST_END();
}
