/* test_vec.c - products of integer vectors against 64-bit arithmetic */
/* SPDX-License-Identifier: MIT */

#include "math/vec/ql_vec.h"
#include "support/ql_stats.h"
#include "support/ql_test.h"

static const int32_t ends[] = {-32767, -32766, -1, 0, 1, 2, 32766, 32767};

#define END_COUNT (sizeof ends / sizeof ends[0])
#define TRIPLES   (END_COUNT * END_COUNT * END_COUNT)

static ql_vec3_t triple(size_t i)
{
    const ql_vec3_t v = {ends[i % END_COUNT], ends[i / END_COUNT % END_COUNT],
            ends[i / END_COUNT / END_COUNT]};

    return v;
}

TEST(cross_products_of_grid_differences_are_exact)
{
    for (size_t i = 0; i < TRIPLES; i++) {
        for (size_t j = 0; j < TRIPLES; j++) {
            const ql_vec3_t a = triple(i), b = triple(j);
            const ql_vec3_t c = ql_vec_cross(a, b);
            const int64_t x = (int64_t)a.y * b.z - (int64_t)a.z * b.y;
            const int64_t y = (int64_t)a.z * b.x - (int64_t)a.x * b.z;
            const int64_t z = (int64_t)a.x * b.y - (int64_t)a.y * b.x;

            CHECK(c.x == x && c.y == y && c.z == z,
                    "(%ld %ld %ld) x (%ld %ld %ld)", (long)a.x, (long)a.y,
                    (long)a.z, (long)b.x, (long)b.y, (long)b.z);
        }
    }
    NOTE("%u pairs of extremes", (unsigned)(TRIPLES * TRIPLES));
}

TEST(cross_products_are_normal_to_both_factors)
{
    for (size_t i = 0; i < TRIPLES; i++) {
        for (size_t j = 0; j < TRIPLES; j++) {
            const ql_vec3_t a = triple(i), b = triple(j);
            const ql_vec3_t c = ql_vec_cross(a, b);

            CHECK(ql_vec_dot(a, c) == 0 && ql_vec_dot(b, c) == 0, "pair %u, %u",
                    (unsigned)i, (unsigned)j);
        }
    }
}

TEST(dot_products_with_a_normal_are_exact_at_the_ends_of_the_box)
{
    uint64_t state = 1;

    for (size_t i = 0; i < TRIPLES; i++) {
        for (size_t j = 0; j < TRIPLES; j++) {
            const ql_vec3_t n = ql_vec_cross(triple(i), triple(j));
            const size_t k = stats_random_below(&state, TRIPLES);
            ql_vec3_t a = triple(k);
            int64_t exact;

            a.x *= 1 << QL_POS_BITS;
            a.y *= 1 << QL_POS_BITS;
            a.z *= 1 << QL_POS_BITS;
            exact = (int64_t)a.x * n.x + (int64_t)a.y * n.y +
                    (int64_t)a.z * n.z;
            CHECK(ql_vec_dot_normal(a, n) == exact, "triples %u, %u, %u: %lld",
                    (unsigned)k, (unsigned)i, (unsigned)j,
                    (long long)ql_vec_dot_normal(a, n));
        }
    }
}

TEST(differences_are_taken_by_component)
{
    for (size_t i = 0; i < TRIPLES; i++) {
        const ql_vec3_t a = triple(i), b = triple(TRIPLES - 1 - i);
        const ql_vec3_t d = ql_vec_sub(a, b);

        CHECK(d.x == a.x - b.x && d.y == a.y - b.y && d.z == a.z - b.z,
                "triple %u", (unsigned)i);
    }
}

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_vec", argc, argv);
    RUN(cross_products_of_grid_differences_are_exact);
    RUN(cross_products_are_normal_to_both_factors);
    RUN(dot_products_with_a_normal_are_exact_at_the_ends_of_the_box);
    RUN(differences_are_taken_by_component);
    return TEST_END();
}
