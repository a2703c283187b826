/* extreme_geometry.c - triangles, boxes and hit points: cases 6 to 17, 21 */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <stdlib.h>

#include "base/ql_crc.h"
#include "support/built.h"
#include "support/picture/estimate.h"
#include "support/picture/lambert.h"
#include "support/ql_points.h"
#include "support/ql_test.h"
#include "support/ql_wide.h"
#include "qlux.h"
#include "math/vec/ql_vec_unit.h"
#include "scene/mesh/nodes.h"
#include "trace/ql_bvh.h"
#include "trace/surface/ql_surface_at.h"
#include "trace/ql_tri.h"

enum { LOW = QL_GRID_MARGIN, HIGH = QL_GRID_MAX - QL_GRID_MARGIN };

static mini_scene_t m;
static ql_scene_t scene;

/* ---- One triangle and its oracle --------------------------------------- */

static struct {
    ql_scene_t scene;
    ql_blob_vertex_t vertices[3];
    ql_blob_tri_t tri;
    ql_vec3_t corner[3];
} one;

static void set_triangle(ql_vec3_t a, ql_vec3_t b, ql_vec3_t c)
{
    const ql_vec3_t corner[3] = {a, b, c};

    memcpy(one.corner, corner, sizeof corner);
    for (uint16_t i = 0; i < 3; i++) {
        one.vertices[i].xyz[0] = QL_LE16((uint16_t)corner[i].x);
        one.vertices[i].xyz[1] = QL_LE16((uint16_t)corner[i].y);
        one.vertices[i].xyz[2] = QL_LE16((uint16_t)corner[i].z);
        one.tri.vertex[i] = QL_LE16(i);
    }
    one.scene.vertices = one.vertices;
    one.scene.triangles = &one.tri;
}

/* The determinant of three columns, in 128 bits. */
static wide_t volume(ql_vec3_t a, ql_vec3_t b, ql_vec3_t c)
{
    const int64_t x = (int64_t)b.y * c.z - (int64_t)b.z * c.y;
    const int64_t y = (int64_t)b.z * c.x - (int64_t)b.x * c.z;
    const int64_t z = (int64_t)b.x * c.y - (int64_t)b.y * c.x;

    return wide_add(
            wide_add(wide_mul(a.x, x), wide_mul(a.y, y)), wide_mul(a.z, z));
}

static ql_vec3_t grid_to_pos(ql_vec3_t v)
{
    return vec(v.x * ONE, v.y * ONE, v.z * ONE);
}

/* A line meets a triangle where it passes all three edges on one side: the
 * signs of three volumes of corners and direction. 0, 1 front, -1 back. */
static int oracle(const ql_ray_t *ray)
{
    ql_vec3_t s[3];
    int sign[3], side = 0;

    for (unsigned i = 0; i < 3; i++) {
        s[i] = ql_vec_sub(grid_to_pos(one.corner[i]), ray->origin);
    }
    for (unsigned i = 0; i < 3; i++) {
        sign[i] = wide_sign(volume(ray->direction, s[i], s[(i + 1) % 3]));
        side = sign[i] != 0 ? sign[i] : side;
    }
    for (unsigned i = 0; i < 3; i++) {
        if (sign[i] != 0 && sign[i] != side) {
            return 0;
        }
    }
    /* ahead: s0 on the same side of the plane as the direction leads to */
    if (side == 0 || wide_sign(volume(s[0], s[1], s[2])) != side) {
        return 0;
    }
    return -side;
}

static unsigned long rays, hits;

static int check_ray(const ql_ray_t *ray)
{
    const ql_vec3_t *c = one.corner;
    const int expected = oracle(ray);
    uint64_t det, t;
    const int got = ql_tri_hit(&one.scene, &one.tri, ray, &det, &t);

    rays++;
    hits += expected != 0;
    CHECK(got == expected,
            "(%ld %ld %ld) (%ld %ld %ld) (%ld %ld %ld), from (%ld %ld %ld) "
            "along (%ld %ld %ld): %d, not %d",
            (long)c[0].x, (long)c[0].y, (long)c[0].z, (long)c[1].x,
            (long)c[1].y, (long)c[1].z, (long)c[2].x, (long)c[2].y,
            (long)c[2].z, (long)ray->origin.x, (long)ray->origin.y,
            (long)ray->origin.z, (long)ray->direction.x, (long)ray->direction.y,
            (long)ray->direction.z, got, expected);
    return got;
}

static ql_ray_t segment(ql_vec3_t from, ql_vec3_t to)
{
    ql_ray_t ray;

    ray.origin = from;
    ray.direction = ql_vec_sub(to, from);
    return ray;
}

static bool is_zero(ql_vec3_t v)
{
    return (v.x | v.y | v.z) == 0;
}

/* As a segment, and as an unending ray the same way. */
static int check_to(ql_vec3_t from, ql_vec3_t to)
{
    ql_ray_t ray = segment(from, to);
    const int side = check_ray(&ray);

    ray.direction = ql_vec_to_dir(ray.direction);
    if (!is_zero(ray.direction)) {
        (void)check_ray(&ray);
    }
    return side;
}

static ql_vec3_t random_corner(void)
{
    return vec(
            random_in(LOW, HIGH), random_in(LOW, HIGH), random_in(LOW, HIGH));
}

/* ---- Triangles without area -------------------------------------------- */

/* Open the blob again after a change: the status. */
static ql_status_t reopen(void)
{
    ql_blob_header_t *const header = (ql_blob_header_t *)(void *)m.blob;

    header->crc32 =
            QL_LE32(ql_crc32(0, (const uint8_t *)m.blob + QL_BLOB_CRC_FROM,
                    m.size_bytes - QL_BLOB_CRC_FROM));
    return ql_blob_open(&scene, m.blob, m.size_bytes);
}

/* Move the corners of a triangle of an open scene. */
static void move_corners(unsigned triangle, const int32_t to[3][3])
{
    ql_blob_header_t *const header = (ql_blob_header_t *)(void *)m.blob;
    ql_blob_vertex_t *const vertices =
            (ql_blob_vertex_t *)(void *)((char *)m.blob +
                                         QL_LE32(header->vertices.offset));

    for (unsigned i = 0; i < 9; i++) {
        vertices[QL_LE16(scene.triangles[triangle].vertex[i / 3])].xyz[i % 3] =
                QL_LE16((uint16_t)to[i / 3][i % 3]);
    }
    CHECK(reopen() == QL_OK, "the core refuses a triangle without area");
}

/* A floor and a lamp that is about to lose its area. Returns the lamp. */
static unsigned make_flat_lamp(const int32_t to[3][3])
{
    static const int32_t floor[3][3] = {
            {8000, 8000, 8000}, {24000, 8000, 8000}, {8000, 24000, 8000}};
    static const int32_t lamp[3][3] = {
            {9000, 9000, 12000}, {9000, 15000, 12000}, {15000, 9000, 12000}};
    unsigned at = 0;

    mini_begin(&m);
    m.leaf_max = 4;
    mini_triangle(&m, floor[0], floor[1], floor[2], mini_material(&m, 1, 0));
    mini_triangle(&m, lamp[0], lamp[1], lamp[2], mini_material(&m, 0, 0.5));
    mini_eye(&m, 11000, 11000, 9000);
    mini_look(&m, 0, 0, -0.5);
    mini_open(&m, &scene);
    while (ql_scene_material(&scene, scene.triangles + at)->emission[0] == 0) {
        at++;
    }
    move_corners(at, to);
    return at;
}

/* The blob that qlux-scene writes has none: extreme_programs.sh. A blob that
 * has is opened, as nothing in it leads outside; then it must be harmless. */
TEST(case_06_triangles_without_area_are_never_hit_and_shine_nothing)
{
    static const int32_t flat[4][3][3] = {
            {{9000, 9000, 12000}, {9000, 9000, 12000}, {9000, 9000, 12000}},
            {{9000, 9000, 12000}, {9000, 9000, 12000}, {15000, 9000, 12000}},
            {{9000, 9000, 12000}, {12000, 10000, 12000}, {15000, 11000, 12000}},
            {{8, 8, 8}, {16383, 16383, 16383}, {32758, 32758, 32758}}};
    unsigned long shot = 0;

    state = 6;
    for (unsigned i = 0; i < 4; i++) {
        const unsigned lamp = make_flat_lamp(flat[i]);

        for (unsigned direct = QL_DIRECT_AREA; direct <= QL_DIRECT_MIS;
                direct++) {
            ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 2, 6);
            ql_sum_t sum = {{0, 0, 0}};
            ql_render_t render;

            s.direct = (uint8_t)direct;
            if (!BUILT_HAS_DIRECT(direct)) {
                continue;
            }
            CHECK(ql_render_init(&render, &scene, &s) == QL_OK, "settings");
            ql_render_pixel(&render, 0, 0, 0, 2000, &sum);
            CHECK(sum.rgb[0] == 0 && render.diag.saturated == 0,
                    "shape %u, direct %u: sum %llu", i, direct,
                    (unsigned long long)sum.rgb[0]);
        }
        for (unsigned k = 0; k < 20000; k++) {
            const ql_vec3_t at = vec(
                    flat[i][k % 3][0], flat[i][k % 3][1], flat[i][k % 3][2]);
            const ql_ray_t ray = segment(random_position(),
                    k & 4 ? random_position() : grid_to_pos(at));
            uint64_t det, t;

            CHECK(ql_tri_hit(&scene, scene.triangles + lamp, &ray, &det, &t) ==
                            0,
                    "shape %u is hit", i);
            shot++;
        }
    }
    NOTE("4 shapes, 5 strategies, %lu rays", shot);
}

/* ---- Slivers ----------------------------------------------------------- */

static double lambert_of(const double corner[3][3], const double n[3])
{
    lambert_polygon_t p;

    memcpy(p.corner, corner, 3 * sizeof corner[0]);
    p.count = 3;
    return lambert_form_factor(&p, n);
}

/* A lamp of 32751 by 1 units, 4000 above the receiver. */
static void check_sliver_lamp(double *z, double *f)
{
    static const int32_t lamp[3][3] = {
            {LOW, 16384, 12000}, {HIGH, 16385, 12000}, {HIGH, 16384, 12000}};
    static const int32_t ground[3][3] = {
            {16000, 16000, 8000}, {16800, 16000, 8000}, {16000, 16800, 8000}};
    const ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 0, 7);
    const double n[3] = {0, 0, 1};
    /* the receiver is an ulp up, the lamp an ulp down */
    const double height = 4000 - 2.0 / ONE;
    double corner[3][3];
    lambert_moments_t e;
    stats_moments_t got;

    mini_begin(&m);
    m.radiance_exp = 0;
    mini_triangle(&m, ground[0], ground[1], ground[2], mini_material(&m, 1, 0));
    mini_triangle(&m, lamp[0], lamp[1], lamp[2], mini_material(&m, 0, 0.5));
    mini_eye(&m, 16256, 16256, 9000);
    mini_look(&m, 0, 0, -0.5);
    for (unsigned i = 0; i < 3; i++) {
        corner[i][0] = lamp[i][0] - 16256;
        corner[i][1] = lamp[i][1] - 16256;
        corner[i][2] = height;
    }
    e = lambert_triangle_sampling((const double(*)[3])corner, n, 2000);
    *f = -lambert_of((const double(*)[3])corner, n); /* its front is below */
    got = estimate_pixel(&m, &s, 0, 0, 1u << 18);
    got.mean /= 0.5;
    got.m2 /= 0.25;
    *z = estimate_z(&got, *f, e.variance);
    CHECK(fabs(e.mean / *f - 1) < 1e-4, "Lambert %.6g, quadrature %.6g", *f,
            e.mean);
    CHECK(fabs(estimate_z(&got, *f * 1.02, e.variance)) > STATS_Z_MAX,
            "2 %% more is taken for it");
    CHECK(fabs(*z) < STATS_Z_MAX, "F %.6g, want %.6g, z %.1f", got.mean, *f,
            *z);
}

TEST(case_07_sliver_as_geometry_and_as_light_hits_as_the_oracle_says)
{
    double z, f;

    state = 7;
    rays = hits = 0;
    for (unsigned i = 0; i < 60000; i++) {
        const int32_t y = i % 3 == 0 ? random_in(LOW, HIGH - 1) : 16384;
        const int32_t high = i % 3 == 0 ? random_in(LOW, HIGH) : 16384;
        ql_vec3_t to;

        set_triangle(vec(LOW, y, high), vec(HIGH, y, 16384),
                vec(HIGH, y + 1, 16384));
        /* onto it, within a unit or so */
        to = vec(random_in(LOW * ONE, HIGH * ONE),
                y * ONE + random_in(-ONE / 2, ONE), 16384 * ONE);
        if (i % 3 == 0) {
            to.z = high * ONE + (int32_t)((double)(16384 - high) *
                                          (to.x - LOW * ONE) / (HIGH - LOW));
        }
        (void)check_to(random_position(), to);
    }
    CHECK(hits > rays / 100, "%lu of %lu rays", hits, rays);
    check_sliver_lamp(&z, &f);
    NOTE("%lu rays, %lu hits; as a lamp F %.3e, z %.1f", rays, hits, f, z);
}

/* Half a degree above the plane of a triangle 1 unit wide. */
TEST(case_08_rays_half_a_degree_off_a_sliver_miss_as_the_oracle_says)
{
    unsigned long beside = 0;

    state = 8;
    rays = hits = 0;
    set_triangle(vec(1000, 16384, 16384), vec(31000, 16384, 16384),
            vec(31000, 16385, 16384));
    for (unsigned i = 0; i < 60000; i++) {
        const int32_t run = random_in(1000, 14000) * ONE;
        const int32_t rise = (int32_t)(run * 0.0087266); /* tan 0.5 degrees */
        const int32_t x = random_in(1000 * ONE + run, 31000 * ONE - run);
        const bool along = i & 1;
        const ql_vec3_t on =
                vec(x, 16384 * ONE + random_in(-ONE, 2 * ONE), 16384 * ONE);
        const ql_vec3_t from = along ? vec(x - run, on.y, on.z + rise)
                                     : vec(x, on.y - run, on.z + rise);
        const ql_vec3_t to = along ? vec(x + run, on.y, on.z - rise)
                                   : vec(x, on.y + run, on.z - rise);
        const int side = check_to(from, to);

        /* a unit beside it: a miss for certain */
        if (along && (on.y < 16384 * ONE || on.y > 16385 * ONE)) {
            beside++;
            CHECK(side == 0, "a hit at y = %.3f", (double)on.y / ONE);
        }
    }
    CHECK(hits > 1000 && rays - hits > 1000, "%lu of %lu", hits, rays);
    NOTE("%lu rays, %lu hits, %lu rays beside it miss", rays, hits, beside);
}

TEST(case_09_rays_in_the_plane_of_a_triangle_miss)
{
    state = 9;
    rays = hits = 0;
    for (unsigned i = 0; i < 60000; i++) {
        ql_vec3_t a, e1, e2;
        ql_ray_t ray;
        int32_t k1, k2, k3, k4;

        /* corners a, a + 2 e1, a + 2 e2; the ray between lattice points */
        do {
            a = vec(random_in(9000, 23000), random_in(9000, 23000),
                    i % 3 ? random_in(9000, 23000) : 16384);
            e1 = vec(random_in(-1000, 1000), random_in(-1000, 1000),
                    i % 3 ? random_in(-1000, 1000) : 0);
            e2 = vec(random_in(-1000, 1000), random_in(-1000, 1000),
                    i % 3 ? random_in(-1000, 1000) : 0);
        } while (is_zero(ql_vec_cross(e1, e2)));
        k1 = random_in(-4, 4);
        k2 = random_in(-4, 4);
        k3 = random_in(-4, 4);
        k4 = random_in(-4, 4);
        set_triangle(a, vec(a.x + 2 * e1.x, a.y + 2 * e1.y, a.z + 2 * e1.z),
                vec(a.x + 2 * e2.x, a.y + 2 * e2.y, a.z + 2 * e2.z));
        ray = segment(grid_to_pos(vec(a.x + k1 * e1.x + k2 * e2.x,
                              a.y + k1 * e1.y + k2 * e2.y,
                              a.z + k1 * e1.z + k2 * e2.z)),
                grid_to_pos(vec(a.x + k3 * e1.x + k4 * e2.x,
                        a.y + k3 * e1.y + k4 * e2.y,
                        a.z + k3 * e1.z + k4 * e2.z)));
        (void)check_ray(&ray);
    }
    CHECK(hits == 0, "%lu hits", hits);
    NOTE("%lu rays, inside, along edges and through corners", rays);
}

/* ---- Closed meshes ----------------------------------------------------- */

static uint16_t point_on_ball(const double v[3])
{
    const double size = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);

    return mini_vertex(&m, 16384 + (int32_t)lround(16375 * v[0] / size),
            16384 + (int32_t)lround(16375 * v[1] / size),
            16384 + (int32_t)lround(16375 * v[2] / size));
}

/* An octahedron's face, cut and blown up; corners on its sides are there again
 * in the next face, with the same coordinates. */
static void blow_up(int octant, int parts, uint16_t material)
{
    const double x = octant & 1 ? -1 : 1, y = octant & 2 ? -1 : 1;
    const double z = octant & 4 ? -1 : 1;
    uint16_t line[2][16];

    for (int i = 0; i <= parts; i++) {
        for (int j = 0; j <= i; j++) {
            const double v[3] = {x * (parts - i), y * (i - j), z * j};

            line[i & 1][j] = point_on_ball(v);
        }
        for (int j = 0; i > 0 && j < i; j++) {
            const uint16_t *const up = line[(i - 1) & 1];
            const uint16_t *const low = line[i & 1];

            mini_face(&m, up[j], low[j + 1], low[j], material);
            if (j + 1 < i) {
                mini_face(&m, up[j], up[j + 1], low[j + 1], material);
            }
        }
    }
}

static void make_ball(unsigned node_bits)
{
    const uint16_t white = (mini_begin(&m), mini_material(&m, 0.5, 0));

    m.node_bits = node_bits;
    m.leaf_max = 2;
    for (int octant = 0; octant < 8; octant++) {
        blow_up(octant, 8, white);
    }
    mini_open(&m, &scene);
}

/* A ray exactly through a + (b - a) k/n: its direction, n times the distance,
 * is not rounded. False if it is not of a ray's size or begins outside. */
static bool exact_ray(
        ql_vec3_t a, ql_vec3_t b, int32_t k, int32_t n, ql_ray_t *ray)
{
    const int32_t most = (int32_t)1 << QL_DIR_BITS;
    const int32_t target[3] = {(a.x * (n - k) + b.x * k) * ONE,
            (a.y * (n - k) + b.y * k) * ONE, (a.z * (n - k) + b.z * k) * ONE};
    int32_t o[3], d[3], largest = 0;
    double apart = 0;

    for (unsigned i = 0; i < 3; i++) {
        int32_t size;

        o[i] = target[i] / n + random_in(-most / n, most / n);
        d[i] = target[i] - o[i] * n;
        size = d[i] < 0 ? -d[i] : d[i];
        largest = size > largest ? size : largest;
        apart += pow((double)o[i] / ONE - 16384, 2);
    }
    ray->origin = vec(o[0], o[1], o[2]);
    ray->direction = vec(d[0], d[1], d[2]);
    return largest <= most && largest >= most / 2 && apart < 15000.0 * 15000;
}

TEST(case_10_no_ray_leaves_through_a_corner_or_an_edge_of_a_closed_mesh)
{
    enum { RAYS = 120000 };
    unsigned long missed = 0, at_corners = 0;

    state = 10;
    for (unsigned bits = 8; bits <= 16; bits += 8) {
        make_ball(bits);
        for (unsigned i = 0; i < RAYS;) {
            const ql_blob_tri_t *tri =
                    scene.triangles + random_in(0, (int)m.triangle_count - 1);
            const unsigned c = (unsigned)random_in(0, 2);
            const int32_t n = random_in(1, 4), k = random_in(0, n);
            ql_ray_t ray;
            ql_hit_t hit;

            if (exact_ray(ql_scene_corner(&scene, tri, c),
                        ql_scene_corner(&scene, tri, (c + 1) % 3), k, n,
                        &ray)) {
                missed += !ql_bvh_closest_hit(&scene, &ray, &hit);
                at_corners += k == 0 || k == n;
                i++;
            }
        }
    }
    CHECK(missed == 0, "%lu rays", missed);
    NOTE("%d rays, %lu at corners, none misses", 2 * RAYS, at_corners);
}

/* ---- Shared edges ------------------------------------------------------ */

/* What the core says of one triangle alone. */
static ql_uq30_t parameter_of(uint16_t triangle, const ql_ray_t *ray)
{
    ql_scene_t leaf = scene;
    ql_hit_t hit;

    leaf.root_link = triangle;
    leaf.root_meta = 4;
    return ql_bvh_closest_hit(&leaf, ray, &hit) ? hit.t : 0;
}

/* Where two triangles meet, both are hit at T0/det0 = T1/det1, exactly. The
 * core compares quotients, which may be an ulp or two apart: the smaller wins,
 * of equals the lower index, whatever the order of the triangles. */
static uint32_t ties;

static void check_edge(bool swapped)
{
    const int32_t a[3] = {8000, 8000, 8000}, b[3] = {20000, 12000, 9000};
    const int32_t c[3] = {9000, 21000, 15000}, d[3] = {22000, 7000, 20000};
    const ql_vec3_t from = vec(a[0], a[1], a[2]), to = vec(b[0], b[1], b[2]);
    uint16_t white;

    mini_begin(&m);
    white = mini_material(&m, 0.5, 0);
    if (swapped) {
        mini_triangle(&m, b, a, d, white);
        mini_triangle(&m, a, b, c, white);
    } else {
        mini_triangle(&m, a, b, c, white);
        mini_triangle(&m, b, a, d, white);
    }
    mini_open(&m, &scene);
    for (unsigned i = 0; i < 20000;) {
        const int32_t n = random_in(1, 4);
        uint64_t det[2] = {1, 1}, t[2] = {0, 0};
        ql_uq30_t at[2];
        ql_ray_t ray;
        ql_hit_t hit;

        if (!exact_ray(from, to, random_in(0, n), n, &ray)) {
            continue;
        }
        i++;
        at[0] = parameter_of(0, &ray);
        at[1] = parameter_of(1, &ray);
        ties += at[0] == at[1];
        for (unsigned k = 0; k < 2; k++) {
            rays += ql_tri_hit(&scene, scene.triangles + k, &ray, det + k,
                            t + k) != 0;
        }
        /* T0/det0 = T1/det1: 6 volumes and determinants below 2^63 */
        CHECK(wide_sign(wide_sub(wide_mul((int64_t)t[0], (int64_t)det[1]),
                      wide_mul((int64_t)t[1], (int64_t)det[0]))) == 0,
                "two parameters at an edge");
        CHECK(fabs((double)at[0] - at[1]) <= 0x1p-28 * at[0] + 16,
                "parameters %08lx and %08lx", (unsigned long)at[0],
                (unsigned long)at[1]);
        CHECK(ql_bvh_closest_hit(&scene, &ray, &hit) &&
                        hit.tri_idx == (at[1] < at[0]),
                "triangle %u wins, at %08lx and %08lx", hit.tri_idx,
                (unsigned long)at[0], (unsigned long)at[1]);
    }
}

/* A room with a lamp of one triangle and two more, in reverse order if asked
 * to. */
static void make_room(bool reverse)
{
    static const double right[3] = {0.25, 0, 0}, up[3] = {0, 0.25, 0};
    static const int32_t low[3] = {300, 300, 300};
    static const int32_t high[3] = {31001, 30007, 30503};
    static const int32_t block[4][3] = {{9001, 301, 15003}, {16007, 305, 21011},
            {11003, 12007, 17001}, {21001, 307, 13007}};
    static const int32_t lamp[3][3] = {{12001, 29001, 12003},
            {20003, 29001, 12001}, {16001, 29001, 20011}};
    const uint16_t white = (mini_begin(&m), mini_material(&m, 0.75, 0));

    mini_room(&m, low, high, white);
    m.triangle_count -= 2; /* the wall behind: 13 are left, one leaf */
    mini_triangle(&m, block[0], block[1], block[2], white);
    mini_triangle(&m, block[1], block[3], block[2], white);
    mini_triangle(&m, lamp[0], lamp[1], lamp[2], mini_material(&m, 0, 0.5));
    m.width = m.height = 16;
    m.leaf_max = 13;
    m.node_bits = 16;
    mini_eye(&m, 16000.3, 15000.7, 1000.1);
    mini_look(&m, 0.01, -0.02, 0.25);
    mini_field(&m, right, up);
    for (unsigned i = 0; reverse && 2 * i + 1 < m.triangle_count; i++) {
        const unsigned j = m.triangle_count - 1 - i;
        const mini_triangle_t swap = m.triangles[i];

        m.triangles[i] = m.triangles[j];
        m.triangles[j] = swap;
    }
    mini_open(&m, &scene);
}

static void render(ql_sum_t sums[256])
{
    const ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 4, 11);
    ql_render_t r;

    memset(sums, 0, 256 * sizeof *sums);
    CHECK(ql_render_init(&r, &scene, &s) == QL_OK, "settings");
    for (uint16_t i = 0; i < 256; i++) {
        ql_render_pixel(&r, i % 16, i / 16, 0, 64, sums + i);
    }
}

TEST(case_11_both_sides_of_an_edge_are_hit_alike_and_order_changes_no_bit)
{
    static ql_sum_t forward[256], backward[256];
    unsigned differ = 0;
    uint16_t first;

    state = 11;
    rays = ties = 0;
    check_edge(false);
    check_edge(true);
    CHECK(rays == 80000, "%lu hits of 40000 rays", rays);
    make_room(false);
    first = QL_LE16(scene.lights[0].triangle);
    render(forward);
    make_room(true);
    CHECK(QL_LE16(scene.lights[0].triangle) != first, "the same order");
    render(backward);
    for (unsigned i = 0; i < 256; i++) {
        differ += memcmp(forward + i, backward + i, sizeof *forward) != 0;
    }
    CHECK(differ == 0, "%u of 256 px differ", differ);
    NOTE("40000 rays hit both, %.0f %% at the same t; 256 px the same reversed",
            ties / 400.0);
}

/* ---- Directions -------------------------------------------------------- */

TEST(case_12_directions_with_zero_components_equal_the_oracle)
{
    state = 12;
    rays = hits = 0;
    for (unsigned i = 0; i < 60000; i++) {
        const ql_vec3_t from = random_position();
        const ql_vec3_t far = random_position();
        const unsigned keep = 1 + i % 6; /* axes that move */
        const ql_vec3_t to = vec(keep & 1 ? far.x : from.x,
                keep & 2 ? far.y : from.y, keep & 4 ? far.z : from.z);

        do {
            set_triangle(random_corner(), random_corner(), random_corner());
            if (i & 1) { /* a corner on the ray's way */
                one.corner[0] = vec(to.x / ONE, to.y / ONE, to.z / ONE);
                set_triangle(vec(one.corner[0].x < LOW ? LOW : one.corner[0].x,
                                     one.corner[0].y, one.corner[0].z),
                        one.corner[1], one.corner[2]);
            }
        } while (is_zero(ql_vec_cross(ql_vec_sub(one.corner[1], one.corner[0]),
                ql_vec_sub(one.corner[2], one.corner[0]))));
        (void)check_to(from, to);
    }
    CHECK(hits > 1000, "%lu hits", hits);
    NOTE("%lu rays, %lu hits", rays, hits);
}

/* A component as the blob has it: an axis of one of the directions. */
static void set_direction(unsigned which, unsigned axis, uint32_t value)
{
    const ql_blob_header_t *const header =
            (const ql_blob_header_t *)(const void *)m.blob;
    ql_blob_camera_t *const camera =
            (ql_blob_camera_t *)(void *)((char *)m.blob +
                                         QL_LE32(header->camera.offset));

    camera->towards[which][axis] = QL_LE32(value);
}

static unsigned cast;

/* The rays through the corners of the picture are of a ray's size. */
static void check_size(ql_render_t *r, uint16_t x, uint16_t y)
{
    const uint32_t most = (uint32_t)1 << QL_DIR_BITS;

    for (unsigned k = 0; k < 4; k++) {
        const ql_uniform2_t u = {
                k & 1 ? 0xffffffffu : 0, k & 2 ? 0xffffffffu : 0};
        ql_camera_pixel_t pixel;
        ql_sum_t sum = {{0, 0, 0}};
        uint32_t largest;
        ql_ray_t ray;

        ql_camera_pixel(&pixel, &r->camera, x, y);
        (void)ql_camera_ray(&pixel, u, u, &ray);
        largest = ql_abs32(ray.direction.x) | ql_abs32(ray.direction.y) |
                  ql_abs32(ray.direction.z);
        CHECK(is_zero(ray.direction) ||
                        (largest >= most / 2 && largest <= 2 * most - 1),
                "pixel %u %u: %lx", x, y, (unsigned long)largest);
        ql_render_pixel(r, x, y, 0, 2, &sum);
        cast++;
    }
}

/* The blob's limit is 2^30 in size; beyond it is refused, up to it nothing
 * overflows, in the widest and the highest picture too. */
TEST(case_13_the_largest_direction_components_do_not_overflow)
{
    static const uint32_t refused[] = {
            0x80000000u, 0x7fffffffu, 0x40000001u, 0xbfffffffu};
    static const uint32_t taken[] = {
            0xc0000000u, 0x40000000u, 0x3fffffffu, 1, 0, 0xffffffffu};
    static const uint16_t sizes[3][2] = {{1, 1}, {16384, 1}, {1, 16384}};
    const ql_settings_t s = estimate_settings(QL_SAMPLER_RANDOM, 1, 13);

    CHECK(ql_abs32(INT32_MIN) == 0x80000000u &&
                    ql_abs64(INT64_MIN) == (uint64_t)1 << 63,
            "absolute values");
    for (unsigned i = 0; i < 9 * 4; i++) {
        make_room(false);
        set_direction(i % 3, i / 3 % 3, refused[i / 9]);
        CHECK(reopen() == QL_ERR_RANGE, "%lx is opened",
                (unsigned long)refused[i / 9]);
    }
    cast = 0;
    make_room(false);
    for (unsigned i = 0; i < 216 * 3; i++) {
        ql_settings_t sized = s;
        ql_render_t r;

        for (unsigned k = 0; k < 3; k++) {
            set_direction(0, k, taken[(i / 3 + k) % 6]);
            set_direction(1, k, taken[(i / 18 + 2 * k) % 6]);
            set_direction(2, k, taken[(i / 108 + 5 * k) % 6]);
        }
        sized.width = sizes[i % 3][0];
        sized.height = sizes[i % 3][1];
        CHECK(reopen() == QL_OK && ql_render_init(&r, &scene, &sized) == QL_OK,
                "camera %u is refused", i);
        check_size(&r, 0, 0);
        check_size(
                &r, (uint16_t)(sized.width - 1), (uint16_t)(sized.height - 1));
    }
    NOTE("36 refused; 648 cameras, %u rays, all of a ray's size", cast);
}

/* ---- Boxes ------------------------------------------------------------- */

/* The closest hit without boxes. */
static bool brute_hit(const ql_ray_t *ray)
{
    uint64_t det, t;

    for (unsigned i = 0; i < m.triangle_count; i++) {
        if (ql_tri_hit(&scene, scene.triangles + i, ray, &det, &t) != 0) {
            return true;
        }
    }
    return false;
}

/* Triangles whose boxes are flat, in planes of each axis, and slanted ones
 * that touch their boxes' faces, edges and corners: one a leaf. */
static void make_boxes(unsigned node_bits)
{
    const uint16_t white = (mini_begin(&m), mini_material(&m, 0.5, 0));

    m.node_bits = node_bits;
    m.leaf_max = 1;
    for (int32_t i = 0; i < 60; i++) {
        const int32_t x = 600 + 500 * i, y = 600 + 7919 * i % 30000;
        const int32_t z = 600 + 6007 * i % 30000;
        const int32_t a[3] = {x, y, z};
        const int32_t b[3] = {
                x + (i % 4 == 0 ? 0 : 400), y + (i % 4 == 1 ? 0 : 300), z};
        const int32_t c[3] = {
                x, y + (i % 4 == 1 ? 0 : 300), z + (i % 4 == 2 ? 0 : 200)};
        const int32_t d[3] = {x + 400, y, z};

        mini_triangle(&m, a, i % 4 == 2 ? d : b, i % 4 == 0 ? c : c, white);
    }
    mini_open(&m, &scene);
}

static unsigned long touching;

/* Rays along the axes and diagonals from and to corners: they run in faces of
 * boxes, along edges, through corners, and begin there. */
static void check_boxes(void)
{
    for (unsigned i = 0; i < m.triangle_count; i++) {
        for (unsigned k = 0; k < 3 * 26; k++) {
            const unsigned way = k / 3 < 13 ? k / 3 : k / 3 + 1; /* of 27 */
            const int32_t step[3] = {(int32_t)(way % 3) - 1,
                    (int32_t)(way / 3 % 3) - 1, (int32_t)(way / 9) - 1};
            const ql_vec3_t c =
                    ql_scene_corner(&scene, scene.triangles + i, k % 3);

            for (int32_t back = 0; back <= 500; back += 250) {
                ql_ray_t ray;
                ql_hit_t hit;
                bool expected;

                ray.origin = grid_to_pos(vec(c.x - back * step[0],
                        c.y - back * step[1], c.z - back * step[2]));
                ray.direction = vec(step[0] * (1l << QL_DIR_BITS) / 2,
                        step[1] * (1l << QL_DIR_BITS) / 2,
                        step[2] * (1l << QL_DIR_BITS) / 2);
                expected = brute_hit(&ray);
                CHECK(ql_bvh_closest_hit(&scene, &ray, &hit) == expected,
                        "triangle %u, corner %u, way %u, from %ld back: %d", i,
                        k % 3, way, (long)back, !expected);
                rays++;
                touching += expected;
            }
        }
    }
}

TEST(case_14_flat_boxes_and_rays_in_their_faces_are_inclusive)
{
    rays = touching = 0;
    make_boxes(16);
    check_boxes();
    make_boxes(8);
    check_boxes();
    CHECK(touching > 1000, "%lu hits", touching);
    NOTE("%lu rays through corners, %lu hits as without boxes", rays, touching);
}

TEST(case_15_boxes_behind_are_missed_origins_inside_hit_no_direction_misses)
{
    static const int32_t low[3] = {10000, 10000, 10000};
    static const int32_t high[3] = {20000, 20000, 20000};
    ql_hit_t hit;

    state = 15;
    for (unsigned bits = 8; bits <= 16; bits += 8) {
        mini_begin(&m);
        m.node_bits = bits;
        m.leaf_max = 1;
        mini_room(&m, low, high, mini_material(&m, 0.5, 0));
        mini_open(&m, &scene);
        for (unsigned i = 0; i < 20000; i++) {
            const ql_vec3_t d =
                    vec(random_in(1 << (QL_DIR_BITS - 1), 1 << QL_DIR_BITS),
                            random_in(-(1 << QL_DIR_BITS), 1 << QL_DIR_BITS),
                            random_in(-(1 << QL_DIR_BITS), 1 << QL_DIR_BITS));
            const ql_vec3_t back = vec(-d.x, d.y, d.z);
            ql_ray_t ray;

            ray.origin = vec(random_in(20000 * ONE, 32767 * ONE),
                    random_in(0, 32767 * ONE), random_in(0, 32767 * ONE));
            ray.direction = d;
            CHECK(!ql_bvh_closest_hit(&scene, &ray, &hit), "a box behind");
            ray.origin = vec(random_in(10000 * ONE + 1, 20000 * ONE - 1),
                    random_in(10000 * ONE + 1, 20000 * ONE - 1),
                    random_in(10000 * ONE + 1, 20000 * ONE - 1));
            ray.direction = i & 1 ? d : back;
            CHECK(ql_bvh_closest_hit(&scene, &ray, &hit) && hit.t > 0,
                    "no hit from inside");
            ray.direction = vec(0, 0, 0);
            CHECK(!ql_bvh_closest_hit(&scene, &ray, &hit) &&
                            !ql_bvh_occluded(&scene, &ray),
                    "a hit without a direction");
        }
    }
    NOTE("2 x 20000 rays of each, both node widths");
}

/* Every extent there is, along one axis, beside every other one's grid. */
TEST(case_16_quantised_boxes_contain_every_extent_exactly)
{
    static const int32_t beside[] = {0, 1, 254, 255, 256, 510, 511, 32751};
    unsigned long pairs = 0;
    int32_t most = 0;

    for (unsigned b = 0; b < sizeof beside / sizeof beside[0]; b++) {
        for (int32_t extent = 0; extent <= HIGH - LOW;
                extent += QL_TEST_SHARE | 1) {
            bvh_node_t pair[2];
            ql_blob_pair8_t out;

            memset(pair, 0, sizeof pair);
            for (int k = 0; k < 3; k++) {
                /* at the low end, at the high end, and in between */
                const int32_t at = k == 0   ? LOW
                                   : k == 1 ? HIGH - extent
                                            : LOW + (HIGH - LOW - extent) / 2;

                pair[0].low[k] = (uint16_t)at;
                pair[0].high[k] = (uint16_t)(at + extent);
                pair[1].low[k] = (uint16_t)(HIGH - beside[b]);
                pair[1].high[k] = HIGH;
            }
            nodes_encode8(&out, pair);
            for (int i = 0; i < 6; i++) {
                const bvh_node_t *const node = pair + i / 3;
                const int32_t c = (int32_t)out.base[i % 3] +
                                  (out.centre[i / 3][i % 3] << out.shift);
                const int32_t h = out.half[i / 3][i % 3] << out.shift;
                const int32_t surplus =
                        node->low[i % 3] - (c - h) + c + h - node->high[i % 3];

                CHECK(c - h <= node->low[i % 3] && c + h >= node->high[i % 3],
                        "extent %ld beside %ld: %u..%u became %ld +- %ld",
                        (long)extent, (long)beside[b], node->low[i % 3],
                        node->high[i % 3], (long)c, (long)h);
                most = surplus >> out.shift > most ? surplus >> out.shift
                                                   : most;
            }
            pairs++;
        }
    }
    CHECK(most <= 3, "a box is %ld grid steps too long", (long)most);
    NOTE("%lu pairs, all extents; at most %ld steps of 2^e too long", pairs,
            (long)most);
}

/* ---- The largest numbers ----------------------------------------------- */

static ql_vec3_t cube_corner(unsigned i, int32_t low, int32_t high)
{
    return vec(i & 1 ? high : low, i & 2 ? high : low, i & 4 ? high : low);
}

TEST(case_17_corners_of_the_legal_cube_equal_the_oracle)
{
    rays = hits = 0;
    for (unsigned i = 0; i < 512; i++) {
        set_triangle(cube_corner(i & 7, LOW, HIGH),
                cube_corner(i >> 3 & 7, LOW, HIGH),
                cube_corner(i >> 6, LOW, HIGH));
        for (unsigned k = 0; k < 64; k++) {
            const int32_t far = QL_GRID_MAX * ONE;

            (void)check_to(
                    cube_corner(k & 7, 0, far), cube_corner(k >> 3, 0, far));
            (void)check_to(cube_corner(k & 7, LOW * ONE, HIGH * ONE),
                    cube_corner(k >> 3, 0, far));
        }
    }
    NOTE("512 triangles, %lu rays, %lu hits", rays, hits);
}

/* ---- Leaving a hit ----------------------------------------------------- */

/* The point of a hit is strictly above its own plane, so no direction above
 * the plane meets it again; but inside a sphere each does, once. How many do
 * otherwise. */
static unsigned check_leaving(uint64_t *left)
{
    const ql_vec3_t from = random_position();
    ql_ray_t ray;
    ql_hit_t hit;
    ql_surface_t surface;
    unsigned again = 0;
    bool inside;

    ray.origin = from;
    ray.direction = ql_vec_to_dir(ql_vec_sub(
            vec(random_in(8000, 24000) * ONE, random_in(8000, 24000) * ONE,
                    random_in(8000, 24000) * ONE),
            from));
    if (is_zero(ray.direction) || !ql_bvh_closest_hit(&scene, &ray, &hit)) {
        return 0;
    }
    ql_surface_at(&scene, &ray, &hit, &surface);
    ray.origin = surface.p;
    inside = m.sphere_count > 0 && !hit.front;
    for (unsigned i = 0; i < 1000; i++) {
        const ql_vec3_t d = ql_vec_to_dir(vec(random_in(-(1l << 29), 1l << 29),
                random_in(-(1l << 29), 1l << 29),
                random_in(-(1l << 29), 1l << 29)));
        ql_hit_t other;

        ray.direction =
                ql_vec_dot(d, surface.n) < 0 ? vec(-d.x, -d.y, -d.z) : d;
        if (!is_zero(d) && ql_vec_dot(ray.direction, surface.n) > 0) {
            again += ql_bvh_closest_hit(&scene, &ray, &other) != inside;
            (*left)++;
        }
    }
    return again;
}

TEST(case_21_no_ray_meets_the_triangle_or_sphere_it_leaves)
{
    unsigned again = 0, spheres = 0, triangles = 0;
    uint64_t left = 0;

    state = 21;
    for (unsigned i = 0; i < 8000 && triangles < 1000; i++) {
        const int32_t reach = (int32_t)1 << (4 + i % 10);
        const int32_t at[3] = {random_in(10000, 22000), random_in(10000, 22000),
                random_in(10000, 22000)};
        int32_t v[3][3];
        const uint64_t before = left;
        const bool sphere = QL_CFG_SPHERES && i % 8 == 0;

        for (unsigned k = 0; k < 9; k++) {
            v[k / 3][k % 3] = at[k % 3] + random_in(-reach, reach);
        }
        if (is_zero(ql_vec_cross(vec(v[1][0] - v[0][0], v[1][1] - v[0][1],
                                         v[1][2] - v[0][2]),
                    vec(v[2][0] - v[0][0], v[2][1] - v[0][1],
                            v[2][2] - v[0][2])))) {
            continue;
        }
        mini_begin(&m);
        if (sphere) {
            const int32_t c[3] = {
                    at[0] * 256 + 77, at[1] * 256, at[2] * 256 + 128};

            (void)mini_sphere(&m, c, 256 * reach + 19, mini_material(&m, 1, 0));
        } else {
            mini_triangle(&m, v[0], v[1], v[2], mini_material(&m, 1, 0));
        }
        mini_open(&m, &scene);
        for (unsigned k = 0; k < 200 && left == before; k++) {
            again += check_leaving(&left);
        }
        triangles += !sphere && left > before;
        spheres += sphere && left > before;
    }
    CHECK(again == 0, "%u rays", again);
    CHECK(triangles == 1000, "%u triangles", triangles);
    NOTE("%u triangles, %u spheres, %lu rays, none meets it", triangles,
            spheres, (unsigned long)left);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("extreme/geometry", argc, argv);
    RUN(case_06_triangles_without_area_are_never_hit_and_shine_nothing);
    RUN(case_07_sliver_as_geometry_and_as_light_hits_as_the_oracle_says);
    RUN(case_08_rays_half_a_degree_off_a_sliver_miss_as_the_oracle_says);
    RUN(case_09_rays_in_the_plane_of_a_triangle_miss);
    RUN(case_10_no_ray_leaves_through_a_corner_or_an_edge_of_a_closed_mesh);
    RUN(case_11_both_sides_of_an_edge_are_hit_alike_and_order_changes_no_bit);
    RUN(case_12_directions_with_zero_components_equal_the_oracle);
    RUN(case_13_the_largest_direction_components_do_not_overflow);
    RUN(case_14_flat_boxes_and_rays_in_their_faces_are_inclusive);
    RUN(case_15_boxes_behind_are_missed_origins_inside_hit_no_direction_misses);
    RUN(case_16_quantised_boxes_contain_every_extent_exactly);
    RUN(case_17_corners_of_the_legal_cube_equal_the_oracle);
    RUN(case_21_no_ray_meets_the_triangle_or_sphere_it_leaves);
    return TEST_END();
}
