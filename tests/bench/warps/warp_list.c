/* warp_list.c - every warp, called on a batch of numbers, by name */
/* SPDX-License-Identifier: MIT */

#include "bench/warps/warp_list.h"

#include "bench_tables.h"
#include "math/vec/ql_frame.h"
#include "sample/lecture/ql_alias.h"
#include "sample/ql_cdf.h"
#include "warp/lecture/ql_warp_lecture.h"
#include "warp/ql_warp_cone.h"
#include "warp/ql_warp_hemisphere.h"
#include "warp/ql_warp_lobe.h"
#include "warp/ql_warp_plane.h"
#include "warp/ql_warp_sphere.h"
#include "warp/ql_warp_spherical.h"
#include "sample/ql_table.h"

/* Make the compiler work a result out. */
#define KEEP(pointer) __asm__ volatile("" : : "r"(pointer) : "memory")

/* What warps take besides numbers. */
static ql_vec3_t normal = {0, 322122547, 429496730}; /* (0, 0.6, 0.8) s2.29 */
static ql_frame_t frame;
static ql_real_t power_inverse, cone_s;
static ql_warp_spherical_t triangle;
static ql_table_t table;
static const ql_alias_t alias = {bench_alias, BENCH_ALIAS_TOTAL, BENCH_ENTRIES};

/* A square of side 100 at a distance of 150: half of it. */
static const ql_vec3_t corners[3] = {
        {-50, -50, 150}, {50, -50, 150}, {50, 50, 150}};

/* The loop is the same for all; the rest is a statement about u1 and u2. */
#define WARP(name, ...)                                                        \
    void warp_batch_##name(const ql_uniform2_t *u, unsigned count);            \
    void warp_batch_##name(const ql_uniform2_t *u, unsigned count)             \
    {                                                                          \
        for (unsigned i = 0; i < count; i++) {                                 \
            const ql_uq32_t u1 = u[i].u1, u2 = u[i].u2;                        \
            __VA_ARGS__;                                                       \
        }                                                                      \
    }

#define WARP_OF(name, type, call)                                              \
    WARP(name, {                                                               \
        const type result_ = call;                                             \
                                                                               \
        KEEP(&result_);                                                        \
    })

#define DIRECTION(name, call) WARP_OF(name, ql_vec3_t, call)

WARP(empty, {
    (void)u1;
    (void)u2;
    KEEP(u + i);
})

DIRECTION(sphere, ql_warp_sphere(u1, u2))
DIRECTION(cosine_hemisphere, ql_warp_hemisphere_cosine(normal, u1, u2))
WARP(triangle, {
    uint32_t b[2];

    ql_warp_plane_triangle(u1, u2, b, b + 1);
    KEEP(b);
})

DIRECTION(uniform_hemisphere, ql_warp_hemisphere_uniform(u1, u2))
DIRECTION(naive_hemisphere, ql_warp_lecture_naive(u1, u2))
DIRECTION(cosine_lobe, ql_warp_lecture_cosine(u1, u2))
WARP(power_lobe, {
    ql_uq31_t s;
    const ql_vec3_t d = ql_warp_lobe(power_inverse, u1, u2, &s);

    KEEP(&d);
})
DIRECTION(cone, ql_warp_cone(cone_s, u1, u2))
WARP_OF(cone_of_sphere, ql_real_t,
        ql_warp_cone_of_sphere(ql_real_midpoint(u1 ^ u2)))
WARP(frame, {
    const ql_vec3_t n = {
            ql_asr32(ql_i32(u1), 4), ql_asr32(ql_i32(u2), 4), normal.z};
    ql_frame_t f;

    ql_frame_from_normal(&f, n);
    KEEP(&f);
})
WARP(to_world, {
    const ql_vec3_t v = {
            ql_asr32(ql_i32(u1), 3), ql_asr32(ql_i32(u2), 3), normal.z};
    const ql_vec3_t d = ql_frame_to_world(&frame, v);

    KEEP(&d);
})

WARP(disk, {
    ql_q29_t p[2];

    ql_warp_plane_disk(u1, u2, p, p + 1);
    KEEP(p);
})
WARP_OF(tent, int32_t, ql_warp_lecture_tent(u1, u2))

WARP(spherical_begin, {
    ql_vec3_t c = corners[2];
    ql_warp_spherical_t t;
    bool seen;

    c.x += (int32_t)(u1 >> 26); /* below 64 */
    c.y += (int32_t)(u2 >> 26);
    seen = ql_warp_spherical_begin(&t, corners[0], corners[1], c);
    KEEP(&seen);
    KEEP(&t);
})
DIRECTION(spherical_triangle, ql_warp_spherical(&triangle, u1, u2))

WARP(cdf, {
    const uint16_t entry = ql_cdf_sample(bench_cdf, 1, BENCH_ENTRIES, u1);

    (void)u2;
    KEEP(&entry);
})
WARP(alias, {
    uint32_t weight;
    const uint16_t entry = ql_alias_sample(&alias, u1, u2, &weight);

    KEEP(&entry);
    KEEP(&weight);
})
WARP(table, {
    const ql_uq32_t both[2] = {u1, u2};
    ql_table_point_t point;

    ql_table_sample(&table, both, &point);
    KEEP(&point);
})

#define ENTRY(name)                                                            \
    {                                                                          \
#name, warp_batch_##name                                               \
    }

const warp_t warp_list[] = {ENTRY(sphere), ENTRY(cosine_hemisphere),
        ENTRY(triangle), ENTRY(uniform_hemisphere), ENTRY(naive_hemisphere),
        ENTRY(cosine_lobe), ENTRY(power_lobe), ENTRY(cone),
        ENTRY(cone_of_sphere), ENTRY(frame), ENTRY(to_world), ENTRY(disk),
        ENTRY(tent), ENTRY(spherical_begin), ENTRY(spherical_triangle),
        ENTRY(cdf), ENTRY(alias), ENTRY(table), {NULL, NULL}};

bool warp_list_open(void)
{
    static const uint16_t count[2] = {BENCH_ENTRIES, BENCH_ENTRIES};

    power_inverse = ql_warp_lobe_inverse(20u << 16);
    cone_s = ql_real_from_u64(1); /* a hemisphere */
    ql_frame_from_normal(&frame, normal);
    return ql_table_open(&table, bench_table, BENCH_TABLE_WORDS, 2, count) ==
                   QL_OK &&
           ql_warp_spherical_begin(
                   &triangle, corners[0], corners[1], corners[2]);
}

void warp_numbers(ql_uniform2_t *u, uint32_t first, unsigned count)
{
    ql_sampler_t sampler;

    ql_sampler_begin(&sampler, QL_SAMPLER_SOBOL, 1, 0, 0);
    for (unsigned i = 0; i < count; i++) {
        ql_sampler_start(&sampler, first + i);
        u[i] = ql_sampler_2d(&sampler, QL_DIM_PIXEL);
    }
}
