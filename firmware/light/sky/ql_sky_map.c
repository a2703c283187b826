/* ql_sky_map.c - a map of the sky: look a direction up, draw one */
/* SPDX-License-Identifier: MIT */

#include "light/sky/ql_sky_map.h"

#if QL_CFG_SKY_MAP

#include "math/ql_trig.h"
#include "sample/ql_table.h"

#define TWO_PI2 QL_REAL(0x9de9e64du, -27) /* 2 pi^2 */

static ql_table_t map_table(const ql_scene_t *scene)
{
    const ql_blob_distribution_t *from =
            scene->tables + QL_LE16(scene->sky->table);
    ql_table_t table;

    table.words = scene->words + QL_LE32(from->first);
    for (unsigned i = 0; i < QL_TABLE_DIMS_MAX; i++) {
        table.count[i] = QL_LE16(from->count[i]);
    }
    table.dims = 2; /* pre: OK, as every map's */
    return table;
}

static void texel_emission(const ql_scene_t *scene, const ql_table_t *table,
        const uint16_t cell[2], ql_uq32_t emission[3])
{
    const uint32_t texel =
            QL_LE32(scene->texels[(uint32_t)cell[1] * table->count[0] + cell[0]]
                            .rgb9e5);

    for (unsigned i = 0; i < 3; i++) {
        /* 9 bits, and up to 23 more */
        emission[i] = (texel >> 9 * i & 0x1ffu) << (texel >> 27);
    }
}

/* 2 pi^2 sin(theta) / density; 0 for a density of 0. */
static ql_real_t inv_pdf_of(
        const ql_table_t *table, uint64_t mass, ql_real_t sine)
{
    return ql_real_div(
            ql_real_mul_call(TWO_PI2, sine), ql_table_density(table, mass));
}

/* A direction as the map has it. */
typedef struct {
    ql_uq32_t uv[2];
    ql_real_t flat, length; /* |(x, z)| and |d|, of any unit, never 0 */
} place_t;

static int32_t scale_up(int32_t x, unsigned shift)
{
    return ql_i32((uint32_t)x << shift);
}

static place_t place_of(ql_vec3_t d, ql_turn32_t rotate)
{
    const unsigned zeros =
            ql_clz32(ql_abs32(d.x) | ql_abs32(d.y) | ql_abs32(d.z));
    /* the largest component has 30 bits, or is what it is */
    const unsigned shift = zeros < 2 || zeros == 32 ? 0 : zeros - 2;
    const ql_vec3_t e = {
            scale_up(d.x, shift), scale_up(d.y, shift), scale_up(d.z, shift)};
    /* below 2^63, whatever d is */
    const uint64_t flat2 =
            ql_abs64((int64_t)e.x * e.x) + ql_abs64((int64_t)e.z * e.z);
    const uint64_t all2 = flat2 + ql_abs64((int64_t)e.y * e.y);
    /* at the pole itself, where the density is infinite, one unit off it */
    const ql_real_t flat = ql_real_sqrt(ql_real_from_u64(flat2 | 1u));
    /* flat in [1, 2^31.5): e in -31..0 */
    const uint32_t rounded = flat2 == 0 ? 0 : flat.m >> -flat.e;
    place_t place;
    ql_turn32_t theta;

    place.uv[0] = ql_atan2(e.x, e.z) - rotate;
    theta = ql_atan2(rounded < 0x7fffffffu ? (int32_t)rounded : INT32_MAX, e.y);
    /* 0..2^31, which would be row 0 again */
    place.uv[1] = theta < 0x80000000u ? theta << 1 : 0xffffffffu;
    place.flat = flat;
    place.length = ql_real_sqrt(ql_real_from_u64(all2 | 1u));
    return place;
}

void ql_sky_map_radiance(const ql_scene_t *scene, ql_vec3_t d,
        ql_uq32_t emission[3], ql_real_t *inv_pdf)
{
    const place_t place = place_of(d, QL_LE32(scene->sky->rotate));
    const ql_table_t table = map_table(scene);
    uint16_t cell[2];

    for (unsigned i = 0; i < 2; i++) {
        cell[i] = (uint16_t)ql_mulhi_u32(place.uv[i], table.count[i]);
    }
    texel_emission(scene, &table, cell, emission);
    if (inv_pdf != NULL) {
        *inv_pdf = inv_pdf_of(&table, ql_table_mass(&table, cell),
                ql_real_div(place.flat, place.length));
    }
}

/* Product of two s1.30, s2.29 to nearest; below 2^61. */
static ql_q29_t times_q29(int32_t a, int32_t b)
{
    return (ql_q29_t)ql_asr64(ql_asr64((int64_t)a * b, 30) + 1, 1);
}

ql_real_t ql_sky_map_sample(const ql_scene_t *scene, ql_uq32_t u1, ql_uq32_t u2,
        ql_vec3_t *w, ql_uq32_t emission[3])
{
    const ql_table_t table = map_table(scene);
    const ql_uq32_t u[2] = {u1, u2};
    ql_table_point_t point;
    ql_uq32_t v;
    int32_t sin_theta, cos_theta, sine, cosine;

    ql_table_sample(&table, u, &point);
    texel_emission(scene, &table, point.cell, emission);

    v = point.x[1];
    ql_sincos(v >> 1, &sin_theta, &cos_theta);
    ql_sincos(point.x[0] + QL_LE32(scene->sky->rotate), &sine, &cosine);
    w->x = times_q29(sin_theta, sine);
    w->y = ql_asr32(cos_theta + 1, 1);
    w->z = times_q29(sin_theta, cosine);

    /* the sine of ql_sincos() is not good enough near the poles: from the
     * nearer one, at the midpoint of v, so never 0 */
    v = v < 0x80000000u ? v : ~v;
    return inv_pdf_of(&table, point.mass,
            ql_real_sin(ql_real_mul_call(QL_REAL_PI, ql_real_midpoint(v))));
}

#endif
