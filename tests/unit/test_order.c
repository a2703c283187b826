/* test_order.c - of surfaces in one place the same one is met by every ray */
/* SPDX-License-Identifier: MIT */

#include "support/picture/mini_scene.h"
#include "support/ql_points.h"
#include "support/ql_test.h"
#include "math/vec/ql_vec_unit.h"
#include "trace/ql_bvh.h"
#include "trace/ql_order.h"
#include "trace/ql_tri.h"

#if QL_CFG_ORDER
static mini_scene_t mini;
static ql_scene_t scene;

static ql_hit_t hit_at(uint64_t t, uint64_t det, uint16_t index, bool front)
{
    ql_hit_t hit;

    memset(&hit, 0, sizeof hit);
    hit.tri_idx = index;
    hit.front = front;
    ql_order_keep(&hit, t, det);
    return hit;
}

/* Sign of a b - c d, from bits of a long multiplication. */
static int compare_products(uint64_t a, uint64_t b, uint64_t c, uint64_t d)
{
    uint32_t x[4] = {0}, y[4] = {0};

    for (unsigned side = 0; side < 2; side++) {
        const uint64_t p = side ? c : a, q = side ? d : b;
        uint32_t *sum = side ? y : x;

        for (unsigned i = 0; i < 64; i++) { /* add p 2^i where q has the bit */
            uint64_t carry = 0;

            for (unsigned k = 0; k < 4 && (q >> i & 1); k++) {
                const int shift = (int)(32 * k) - (int)i;
                const uint32_t part = shift >= 64   ? 0
                                      : shift >= 0  ? (uint32_t)(p >> shift)
                                      : shift > -32 ? (uint32_t)(p << -shift)
                                                    : 0;

                carry += (uint64_t)sum[k] + part;
                sum[k] = (uint32_t)carry;
                carry >>= 32;
            }
        }
    }
    for (int k = 3; k >= 0; k--) {
        if (x[k] != y[k]) {
            return x[k] < y[k] ? -1 : 1;
        }
    }
    return 0;
}

TEST(fractions_compare_as_their_products)
{
    static const uint16_t ranks[2] = {0, 0};
    unsigned long equal = 0;

    memset(&scene, 0, sizeof scene);
    scene.ranks = ranks;
    state = 47;
    for (long i = 0; i < MANY(100000); i++) {
        const unsigned bits = (unsigned)random_in(1, 54);
        const uint64_t det =
                1 + stats_random_below(&state, (uint64_t)1 << bits);
        const uint64_t t = stats_random_below(&state, 4 * det);
        const uint64_t by = stats_random_below(&state, 7) + 1;
        /* the same, or next to it, or anything */
        const uint64_t t2 = i % 3 == 2 ? stats_random_below(&state, 4 * det)
                                       : t * by + (i % 3 == 1);
        const ql_hit_t a = hit_at(t, det, 0, true);
        const ql_hit_t b = hit_at(t2, det * by, 1, true);
        const int wanted = compare_products(t, det * by, t2, det);

        CHECK(ql_order_is_before_exactly(&scene, &a, &b) == (wanted <= 0) &&
                        ql_order_is_before_exactly(&scene, &b, &a) ==
                                (wanted > 0),
                "%llu / %llu and %llu / %llu", (unsigned long long)t,
                (unsigned long long)det, (unsigned long long)t2,
                (unsigned long long)(det * by));
        equal += wanted == 0;
    }
    NOTE("%lu of them equal", equal);
}

TEST(nothing_is_as_near_as_any_hit)
{
    static const uint16_t ranks[2] = {9, 3};
    ql_hit_t none = hit_at(1, 0, 0, false);

    memset(&scene, 0, sizeof scene);
    scene.ranks = ranks;
    none.t = 0xffffffffu;
    for (uint32_t t = 0; t < 200; t++) {
        ql_hit_t near = hit_at(t, 1u << 30, 1, true);

        near.t = t;
        CHECK((ql_order_is_close(&scene, &near, &none)
                              ? ql_order_is_before_exactly(
                                        &scene, &near, &none) &&
                                        !ql_order_is_before_exactly(
                                                &scene, &none, &near)
                              : ql_order_is_before_as_rounded(&near, &none)),
                "t %lu", (unsigned long)t);
    }
}

/* ---- Rays -------------------------------------------------------------- */

/* Triangles of one plane, each around the middle of the box. */
enum { SHEETS = 6 };

static void add_sheets(const unsigned order[SHEETS], bool turned)
{
    mini_begin(&mini);
    mini.order = true;
    (void)mini_material(&mini, 0.5, 0);
    for (unsigned i = 0; i < SHEETS; i++) {
        const int32_t by = 700 * (int32_t)order[i];
        const int32_t v[3][2] = {
                {9000 - by, 9000}, {25000, 9000 - by}, {16000, 25000}};
        int32_t p[3][3];

        /* z = 20000 - 3/8 x + 1/8 y, in whole units */
        for (unsigned k = 0; k < 3; k++) {
            p[k][0] = v[k][0] / 8 * 8;
            p[k][1] = v[k][1] / 8 * 8;
            p[k][2] = 20000 - p[k][0] / 8 * 3 + p[k][1] / 8;
        }
        mini_triangle(&mini, p[0], p[turned ? 2 : 1], p[turned ? 1 : 2], 0);
        mini.triangles[mini.triangle_count - 1].rank = (uint16_t)order[i];
    }
}

static void check_first(unsigned long *hits)
{
    state = 53;
    for (long i = 0; i < MANY(3000); i++) {
        ql_ray_t ray;
        ql_hit_t hit;
        uint16_t least = 0xffff;
        ql_vec3_t to;

        ray.origin = random_position();
        to = vec(random_in(12000, 20000), random_in(9000, 19000), 14000);
        ray.direction = ql_vec_to_dir(ql_vec_sub(
                vec(to.x * ONE, to.y * ONE, to.z * ONE), ray.origin));
        if ((ray.direction.x | ray.direction.y | ray.direction.z) == 0 ||
                !ql_bvh_closest_hit(&scene, &ray, &hit)) {
            continue;
        }
        (*hits)++;
        for (uint16_t k = 0; k < SHEETS; k++) { /* all that it meets */
            uint64_t det, t;

            if (ql_tri_hit(&scene, scene.triangles + k, &ray, &det, &t) != 0 &&
                    QL_LE16(scene.ranks[k]) < least) {
                least = QL_LE16(scene.ranks[k]);
            }
        }
        CHECK(QL_LE16(scene.ranks[hit.tri_idx]) == least,
                "ray %ld: rank %u, not %u", i,
                QL_LE16(scene.ranks[hit.tri_idx]), least);
    }
}

TEST(of_one_plane_the_lowest_rank_is_met)
{
    static const unsigned orders[3][SHEETS] = {
            {0, 1, 2, 3, 4, 5}, {5, 4, 3, 2, 1, 0}, {3, 0, 5, 1, 4, 2}};
    unsigned long hits = 0;

    for (unsigned bits = MINI_BITS_MIN; bits <= MINI_BITS_MAX; bits += 8) {
        for (unsigned i = 0; i < 6; i++) {
            add_sheets(orders[i / 2], i % 2 != 0);
            mini.node_bits = bits;
            mini.leaf_max = 1 + i % 4;
            mini_open(&mini, &scene);
            check_first(&hits);
        }
    }
    CHECK(hits > 100, "%lu hits", hits);
    NOTE("%lu hits", hits);
}

TEST(of_two_backs_the_front_is_met)
{
    static const int32_t v[3][3] = {
            {8000, 8000, 12003}, {24000, 9001, 16000}, {15000, 24000, 19007}};
    unsigned long hits = 0;

    for (unsigned i = 0; i < 2; i++) {
        mini_begin(&mini);
        mini.order = true;
        (void)mini_material(&mini, 0.5, 0);
        mini_triangle(&mini, v[0], v[1 + i], v[2 - i], 0);
        mini_triangle(&mini, v[0], v[2 - i], v[1 + i], 0);
        mini_open(&mini, &scene);
        state = 59;
        for (long k = 0; k < MANY(2000); k++) {
            ql_ray_t ray;
            ql_hit_t hit;

            ray.origin = random_position();
            ray.direction = ql_vec_to_dir(ql_vec_sub(
                    vec(15700 * ONE, 13600 * ONE, 15700 * ONE), ray.origin));
            if (ql_bvh_closest_hit(&scene, &ray, &hit)) {
                hits++;
                CHECK(hit.front, "ray %ld meets a back", k);
            }
        }
    }
    CHECK(hits > 100, "%lu hits", hits);
    NOTE("%lu hits", hits);
}
#else
TEST(without_an_order_the_rounded_parameter_decides)
{
    static const ql_scene_t scene;
    ql_hit_t a = {.tri_idx = 0}, b = {.tri_idx = 0};

    a.t = 5;
    b.t = 6;
    CHECK(ql_order_is_before_exactly(&scene, &a, &b), "5 before 6");
    b.t = 5;
    b.tri_idx = 1;
    CHECK(ql_order_is_before_exactly(&scene, &a, &b), "0 before 1");
    CHECK(!ql_order_is_before_exactly(&scene, &b, &a), "1 before 0");
}
#endif

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_order", argc, argv);
#if QL_CFG_ORDER
    RUN(fractions_compare_as_their_products);
    RUN(nothing_is_as_near_as_any_hit);
    RUN(of_one_plane_the_lowest_rank_is_met);
    RUN(of_two_backs_the_front_is_met);
#else
    RUN(without_an_order_the_rounded_parameter_decides);
#endif
    return TEST_END();
}
