/* test_bvh.c - traversal equals brute force; closed meshes are watertight */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <stdlib.h>

#include "support/picture/mini_scene.h"
#include "support/ql_stats.h"
#include "support/ql_points.h"
#include "support/ql_test.h"
#include "math/vec/ql_vec_unit.h"
#include "trace/ql_bvh.h"
#include "trace/ql_tri.h"

enum {
    LOW = QL_GRID_MARGIN,
    HIGH = QL_GRID_MAX - QL_GRID_MARGIN,
    BRUTE_RAYS = MANY(100000),
    WATERTIGHT_RAYS = MANY(200000),

    /* what a tree of as many levels as the core's stack can hold */
    SOUP = QL_CFG_BVH_STACK < 8 ? 150 : 500,
    CUTS = QL_CFG_BVH_STACK < 8 ? 2 : 3
};

static mini_scene_t mini;
static ql_scene_t scene;
static ql_vec3_t corner(unsigned triangle, unsigned i)
{
    return ql_scene_corner(&scene, scene.triangles + triangle, i);
}

/* ---- Scenes ------------------------------------------------------------ */

/* A room with a lamp and two turned boxes, as the Cornell box has. */
static void build_cornell(unsigned node_bits)
{
    static const int32_t low[3] = {100, 100, 100};
    static const int32_t high[3] = {32000, 32000, 32000};
    static const int32_t lamp[4][3] = {{13000, 31990, 13000},
            {19000, 31990, 13000}, {19000, 31990, 19000},
            {13000, 31990, 19000}};
    static const int32_t base[2][4][2] = {
            {{7500, 3800}, {4800, 13100}, {13900, 15900}, {16700, 6600}},
            {{24800, 14500}, {15500, 17300}, {18300, 26600}, {27600, 23800}}};
    static const int32_t top[2] = {9700, 19400};
    uint16_t white, light;

    mini_begin(&mini);
    mini.node_bits = node_bits;
    white = mini_material(&mini, 0.5, 0);
    light = mini_material(&mini, 0, 0.5);
    mini_room(&mini, low, high, white);
    mini_quad(&mini, lamp[0], lamp[1], lamp[2], lamp[3], light);
    for (unsigned i = 0; i < 2; i++) {
        int32_t at[8][3];

        for (unsigned k = 0; k < 8; k++) {
            at[k][0] = base[i][k % 4][0];
            at[k][1] = k < 4 ? 100 : top[i];
            at[k][2] = base[i][k % 4][1];
        }
        mini_quad(&mini, at[4], at[5], at[6], at[7], white);
        for (unsigned k = 0; k < 4; k++) {
            mini_quad(&mini, at[k], at[k + 4], at[(k + 1) % 4 + 4],
                    at[(k + 1) % 4], white);
        }
    }
    mini_open(&mini, &scene);
}

/* Triangles of every size and shape, crossing each other. */
static void build_soup(unsigned node_bits)
{
    uint16_t white;

    mini_begin(&mini);
    mini.node_bits = node_bits;
    mini.leaf_max = 3;
    white = mini_material(&mini, 0.5, 0);
    state = 17;
    while (mini.triangle_count < SOUP) {
        int32_t v[3][3];
        ql_vec3_t e[2], n;
        const int32_t reach = 1 << random_in(2, 15);

        for (unsigned i = 0; i < 9; i++) {
            const int32_t at = i < 3 ? random_in(LOW, HIGH)
                                     : v[0][i % 3] + random_in(-reach, reach);

            v[i / 3][i % 3] = at < LOW ? LOW : at > HIGH ? HIGH : at;
        }
        for (unsigned i = 0; i < 2; i++) {
            e[i] = vec(v[i + 1][0] - v[0][0], v[i + 1][1] - v[0][1],
                    v[i + 1][2] - v[0][2]);
        }
        n = ql_vec_cross(e[0], e[1]);
        if ((n.x | n.y | n.z) != 0) {
            mini_triangle(&mini, v[0], v[1], v[2], white);
        }
    }
    mini_open(&mini, &scene);
}

static void build_cube(unsigned node_bits)
{
    static const int32_t low[3] = {LOW, LOW, LOW};
    static const int32_t high[3] = {HIGH, HIGH, HIGH};

    mini_begin(&mini);
    mini.node_bits = node_bits;
    mini.leaf_max = 1;
    mini_room(&mini, low, high, mini_material(&mini, 0.5, 0));
    mini_open(&mini, &scene);
}

/* The middle of an edge, made once however many triangles share it. */
static uint16_t middle_of(uint16_t a, uint16_t b, double (*at)[3],
        unsigned *count, uint16_t (*known)[3], unsigned *known_count)
{
    double length = 0;

    for (unsigned i = 0; i < *known_count; i++) {
        if ((known[i][0] == a && known[i][1] == b) ||
                (known[i][0] == b && known[i][1] == a)) {
            return known[i][2];
        }
    }
    for (unsigned k = 0; k < 3; k++) {
        at[*count][k] = at[a][k] + at[b][k];
        length += at[*count][k] * at[*count][k];
    }
    for (unsigned k = 0; k < 3; k++) {
        at[*count][k] /= sqrt(length);
    }
    known[*known_count][0] = a;
    known[*known_count][1] = b;
    known[*known_count][2] = (uint16_t)*count;
    (*known_count)++;
    return (uint16_t)(*count)++;
}

/* An octahedron whose faces are cut in four, CUTS times, pushed out to a
 * sphere; then every vertex pulled in by up to the given part. */
static void build_sphere(unsigned node_bits, double displaced)
{
    static double at[600][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0},
            {0, 0, 1}, {0, 0, -1}};
    static uint16_t faces[2][512][3], known[1000][3];
    static const uint16_t octahedron[8][3] = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4},
            {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    unsigned count = 6, face_count = 8;
    uint16_t white;

    memcpy(faces[0], octahedron, sizeof octahedron);
    for (unsigned level = 0; level < CUTS; level++) {
        uint16_t(*from)[3] = faces[level % 2], (*to)[3] = faces[1 - level % 2];
        unsigned known_count = 0;

        for (unsigned i = 0; i < face_count; i++) {
            const uint16_t a = from[i][0], b = from[i][1], c = from[i][2];
            const uint16_t ab =
                    middle_of(a, b, at, &count, known, &known_count);
            const uint16_t bc =
                    middle_of(b, c, at, &count, known, &known_count);
            const uint16_t ca =
                    middle_of(c, a, at, &count, known, &known_count);
            const uint16_t four[4][3] = {
                    {a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}};

            memcpy(to[4 * i], four, sizeof four);
        }
        face_count *= 4;
    }
    mini_begin(&mini);
    mini.node_bits = node_bits;
    mini.leaf_max = 2;
    white = mini_material(&mini, 0.5, 0);
    state = 19;
    for (unsigned i = 0; i < count; i++) {
        const double r = 16375 * (1 - displaced * stats_random_unit(&state));

        (void)mini_vertex(&mini, (int32_t)lrint(16383 + r * at[i][0]),
                (int32_t)lrint(16383 + r * at[i][1]),
                (int32_t)lrint(16383 + r * at[i][2]));
    }
    for (unsigned i = 0; i < face_count; i++) {
        const uint16_t *const v = faces[CUTS % 2][i];

        mini_face(&mini, v[0], v[1], v[2], white);
    }
    mini_open(&mini, &scene);
}

/* ---- Brute force ------------------------------------------------------- */

/* All triangles by leaves of 13, without a single box. */
static bool brute_closest(const ql_ray_t *ray, ql_hit_t *hit)
{
    ql_scene_t leaf = scene;
    bool any = false;

    for (unsigned i = 0; i < mini.triangle_count; i += QL_LEAF_MAX) {
        const unsigned left = mini.triangle_count - i;
        ql_hit_t h;

        leaf.root_link = (uint16_t)i;
        leaf.root_meta =
                (uint8_t)(3 + (left < QL_LEAF_MAX ? left : QL_LEAF_MAX));
        if (ql_bvh_closest_hit(&leaf, ray, &h) && (!any || h.t < hit->t)) {
            *hit = h; /* of equals the lower index came first */
            any = true;
        }
    }
    return any;
}

static bool brute_occluded(const ql_ray_t *ray)
{
    for (unsigned i = 0; i < mini.triangle_count; i++) {
        uint64_t det, t;

        if (ql_tri_hit(&scene, scene.triangles + i, ray, &det, &t) != 0 &&
                t < det) {
            return true;
        }
    }
    return false;
}

/* Origin and aim: anywhere, on the grid, at a corner, along an axis. */
static ql_ray_t random_ray(long i, ql_vec3_t *to)
{
    ql_ray_t ray;
    const unsigned tri =
            (unsigned)random_in(0, (int32_t)mini.triangle_count - 1);
    const ql_vec3_t c = corner(tri, (unsigned)i % 3);

    ray.origin = random_position();
    *to = random_position();
    if (i % 4 == 1) {
        *to = vec(c.x * ONE, c.y * ONE, c.z * ONE);
    } else if (i % 4 == 2) {
        *to = ray.origin;
        *(i & 4         ? &to->x
                : i & 8 ? &to->y
                        : &to->z) = random_in(0, QL_GRID_MAX * ONE);
    } else if (i % 4 == 3) {
        ray.origin = vec(c.x * ONE, c.y * ONE, c.z * ONE);
    }
    ray.direction = ql_vec_to_dir(ql_vec_sub(*to, ray.origin));
    return ray;
}

static void check_closest(void)
{
    long hits = 0;

    state = 23;
    for (long i = 0; i < BRUTE_RAYS; i++) {
        ql_vec3_t to;
        const ql_ray_t ray = random_ray(i, &to);
        ql_hit_t hit, brute = {.tri_idx = 0};
        bool got, expected;

        if ((ray.direction.x | ray.direction.y | ray.direction.z) == 0) {
            continue;
        }
        got = ql_bvh_closest_hit(&scene, &ray, &hit);
        expected = brute_closest(&ray, &brute);
        hits += expected;
        CHECK(got == expected && (!got || (hit.tri_idx == brute.tri_idx &&
                                                  hit.t == brute.t &&
                                                  hit.front == brute.front)),
                "ray %ld from (%ld %ld %ld) along (%ld %ld %ld): %d triangle "
                "%u t %08lx, brute force %d triangle %u t %08lx",
                i, (long)ray.origin.x, (long)ray.origin.y, (long)ray.origin.z,
                (long)ray.direction.x, (long)ray.direction.y,
                (long)ray.direction.z, got, hit.tri_idx, (unsigned long)hit.t,
                expected, brute.tri_idx, (unsigned long)brute.t);
    }
    NOTE("%d rays, %ld hits, %u triangles", BRUTE_RAYS, hits,
            mini.triangle_count);
}

static void check_occluded(void)
{
    long blocked = 0;

    state = 29;
    for (long i = 0; i < BRUTE_RAYS; i++) {
        ql_vec3_t to;
        ql_ray_t ray = random_ray(i, &to);
        bool got, expected;

        if (i % 8 == 5) { /* short ones too */
            to.x = ray.origin.x + (to.x - ray.origin.x) / 1024;
            to.y = ray.origin.y + (to.y - ray.origin.y) / 1024;
            to.z = ray.origin.z + (to.z - ray.origin.z) / 1024;
        }
        ray.direction = ql_vec_sub(to, ray.origin);
        got = ql_bvh_occluded(&scene, &ray);
        expected = brute_occluded(&ray);
        blocked += expected;
        CHECK(got == expected,
                "segment %ld from (%ld %ld %ld) by (%ld %ld %ld): %d, not %d",
                i, (long)ray.origin.x, (long)ray.origin.y, (long)ray.origin.z,
                (long)ray.direction.x, (long)ray.direction.y,
                (long)ray.direction.z, got, expected);
    }
    NOTE("%d segments, %ld blocked, %u triangles", BRUTE_RAYS, blocked,
            mini.triangle_count);
}

#if QL_CFG_NODE16
TEST(closest_hit_equals_brute_force_on_cornell_16)
{
    build_cornell(16);
    check_closest();
}

TEST(closest_hit_equals_brute_force_on_a_soup_16)
{
    build_soup(16);
    check_closest();
}

TEST(occlusion_equals_brute_force_on_cornell_16)
{
    build_cornell(16);
    check_occluded();
}

TEST(occlusion_equals_brute_force_on_a_soup_16)
{
    build_soup(16);
    check_occluded();
}
#endif

#if QL_CFG_NODE8
TEST(closest_hit_equals_brute_force_on_cornell_8)
{
    build_cornell(8);
    check_closest();
}

TEST(closest_hit_equals_brute_force_on_a_soup_8)
{
    build_soup(8);
    check_closest();
}

TEST(occlusion_equals_brute_force_on_cornell_8)
{
    build_cornell(8);
    check_occluded();
}

TEST(occlusion_equals_brute_force_on_a_soup_8)
{
    build_soup(8);
    check_occluded();
}
#endif

/* ---- The ray parameter ------------------------------------------------- */

TEST(ray_parameters_are_within_their_bound)
{
    double worst = 0;
    unsigned long hits = 0;

    build_soup(MINI_BITS_MAX);
    state = 31;
    for (long i = 0; i < BRUTE_RAYS; i++) {
        ql_vec3_t to;
        const ql_ray_t ray = random_ray(i, &to);
        ql_hit_t hit;
        uint64_t det = 1, t = 0;
        double exact, off, bound;

        if ((ray.direction.x | ray.direction.y | ray.direction.z) == 0 ||
                !ql_bvh_closest_hit(&scene, &ray, &hit)) {
            continue;
        }
        CHECK(ql_tri_hit(&scene, scene.triangles + hit.tri_idx, &ray, &det,
                      &t) == (hit.front ? 1 : -1),
                "ray %ld: triangle %u is not hit from the side it says", i,
                hit.tri_idx);
        exact = (double)t / (double)det;
        off = fabs(ldexp(hit.t, -30) - exact);
        bound = ldexp(exact, -29) + ldexp(1, -27);
        worst = fmax(worst, off / bound);
        hits++;
        CHECK(off <= bound && exact < 4, "ray %ld: t %.12f, not %.12f", i,
                ldexp(hit.t, -30), exact);
    }
    NOTE("%lu hits, worst %.2f of the bound", hits, worst);
}

TEST(of_equal_triangles_the_lowest_index_wins)
{
    static const int32_t v[3][3] = {
            {100, 100, 1000}, {30000, 100, 2000}, {100, 30000, 3000}};
    uint16_t white;
    unsigned long hits = 0;

    for (unsigned bits = MINI_BITS_MIN; bits <= MINI_BITS_MAX; bits += 8) {
        mini_begin(&mini);
        mini.node_bits = bits;
        mini.leaf_max = 1;
        white = mini_material(&mini, 0.5, 0);
        for (unsigned i = 0; i < 40; i++) {
            mini_triangle(&mini, v[0], v[1], v[2], white);
        }
        mini_open(&mini, &scene);
        state = 37;
        for (long i = 0; i < MANY(20000); i++) {
            ql_vec3_t to;
            ql_ray_t ray = random_ray(0, &to);
            ql_hit_t hit;

            to = vec(8000 * ONE, 8000 * ONE, 2000 * ONE);
            ray.direction = ql_vec_to_dir(ql_vec_sub(to, ray.origin));
            if (ql_bvh_closest_hit(&scene, &ray, &hit)) {
                hits++;
                CHECK(hit.tri_idx == 0, "ray %ld: triangle %u", i, hit.tri_idx);
            }
        }
    }
    NOTE("%lu hits of 40 equal triangles", hits);
}

/* ---- Closed meshes ----------------------------------------------------- */

/* A position well inside the mesh: within 2^12 of the middle of the box. */
static ql_vec3_t inside(long i)
{
    const int32_t middle = 16383 * ONE, reach = 4096 * ONE;

    return i % 16 == 0 ? vec(middle, middle, middle)
                       : vec(middle + random_in(-reach, reach),
                                 middle + random_in(-reach, reach),
                                 middle + random_in(-reach, reach));
}

/* A corner of a triangle, or a point on one of its edges; exact if the edge's
 * length allows. */
static ql_vec3_t rim(long i)
{
    const unsigned tri =
            (unsigned)random_in(0, (int32_t)mini.triangle_count - 1);
    const ql_vec3_t a = corner(tri, (unsigned)i % 3);
    const ql_vec3_t b = corner(tri, (unsigned)(i + 1) % 3);
    const int32_t k = i % 2 ? 0 : random_in(0, 16);

    return vec(a.x * ONE + (b.x - a.x) * k * ONE / 16,
            a.y * ONE + (b.y - a.y) * k * ONE / 16,
            a.z * ONE + (b.z - a.z) * k * ONE / 16);
}

/* Misses of rays from inside to the rim, as rays and as segments twice as
 * long, which leave the mesh. */
static long misses(void)
{
    long missed = 0;

    state = 41;
    for (long i = 0; i < WATERTIGHT_RAYS; i++) {
        const ql_vec3_t to = rim(i);
        const int32_t max = QL_GRID_MAX * ONE;
        ql_vec3_t d;
        ql_ray_t ray;
        ql_hit_t hit;

        ray.origin = inside(i);
        d = ql_vec_sub(to, ray.origin);
        ray.direction = ql_vec_to_dir(d);
        missed += !ql_bvh_closest_hit(&scene, &ray, &hit);
        ray.direction = vec(2 * d.x, 2 * d.y, 2 * d.z);
        d = vec(ray.origin.x + 2 * d.x, ray.origin.y + 2 * d.y,
                ray.origin.z + 2 * d.z);
        if (d.x >= 0 && d.y >= 0 && d.z >= 0 && d.x <= max && d.y <= max &&
                d.z <= max) {
            missed += !ql_bvh_occluded(&scene, &ray);
        }
    }
    return missed;
}

TEST(no_ray_leaves_a_cube_by_its_edges)
{
    for (unsigned bits = MINI_BITS_MIN; bits <= MINI_BITS_MAX; bits += 8) {
        long missed;

        build_cube(bits);
        missed = misses();
        CHECK(missed == 0, "%u-bit nodes: %ld misses", bits, missed);
    }
    NOTE("%d rays, every node width", WATERTIGHT_RAYS);
}

TEST(no_ray_leaves_a_sphere_by_its_edges)
{
    for (unsigned bits = MINI_BITS_MIN; bits <= MINI_BITS_MAX; bits += 8) {
        long missed;

        build_sphere(bits, 0);
        missed = misses();
        CHECK(missed == 0, "%u-bit nodes: %ld misses", bits, missed);
    }
    NOTE("%d rays, %u triangles", WATERTIGHT_RAYS, mini.triangle_count);
}

TEST(no_ray_leaves_a_displaced_sphere_by_its_edges)
{
    for (unsigned bits = MINI_BITS_MIN; bits <= MINI_BITS_MAX; bits += 8) {
        long missed;

        build_sphere(bits, 0.3);
        missed = misses();
        CHECK(missed == 0, "%u-bit nodes: %ld misses", bits, missed);
    }
    NOTE("%d rays, %u triangles", WATERTIGHT_RAYS, mini.triangle_count);
}

#if QL_CFG_NODE16
/* The planted fault. Fine tests boxes with a margin of three units, so there
 * it takes one more to lose a hit. */
TEST(boxes_shrunk_by_a_unit_are_detected)
{
    const unsigned shrink = QL_POS_BITS == 0 ? 1 : 4;
    ql_blob_node16_t *nodes;
    long missed;

    build_sphere(MINI_BITS_MAX, 0.3);
    nodes = (ql_blob_node16_t *)(void *)((uint8_t *)mini.blob +
                                         ((const uint8_t *)scene.pairs -
                                                 (const uint8_t *)mini.blob));
    for (unsigned i = 0; i < 2 * QL_LE32(scene.header->pairs.count); i++) {
        for (unsigned k = 0; k < 3; k++) {
            const unsigned half = QL_LE16(nodes[i].half[k]);

            nodes[i].half[k] =
                    QL_LE16((uint16_t)(half > shrink ? half - shrink : 0));
        }
    }
    missed = misses();
    CHECK(missed > 0, "%ld misses", missed);
    NOTE("%ld misses of boxes shrunk by %u", missed, shrink);
}
#endif

/* ---- The margin of the box test ---------------------------------------- */

#if QL_POS_BITS > 0 && QL_CFG_NODE16

/* 2^16 in ql_bvh.c: what rounding a ray changes of its line test. */
#define MARGIN_PROVED 65536.0

/* x, y, z moved on by so many axes, and mirrored in the box if asked. */
static void turn(int32_t v[3], unsigned by, bool mirrored, int32_t max)
{
    const int32_t old[3] = {v[0], v[1], v[2]};

    for (unsigned k = 0; k < 3; k++) {
        v[(k + by) % 3] = mirrored ? max - old[k] : old[k];
    }
}

/* To the grid, and to 15 bits: as the box test has a ray. */
static double rounded_to(int32_t x, int32_t unit)
{
    return floor(((double)x + unit / 2) / unit);
}

/* How far off the rounded ray is from a point that the ray itself meets. */
static double margin_needed(const int32_t o[3], const int32_t d[3],
        const int32_t p[3], unsigned x, unsigned z)
{
    const int32_t up = d[z] < 0 ? -d[z] : d[z];
    const int32_t unit = up > 2097151 ? 128 : 64;
    const double side = d[z] < 0 ? -1 : 1;

    return side *
           ((p[x] - rounded_to(o[x], 256)) * rounded_to(d[z], unit) -
                   (p[z] - rounded_to(o[z], 256)) * rounded_to(d[x], unit));
}

/* A ray across the box to just inside a corner of a small triangle, which is
 * the corner of its box that the rounded ray is furthest from. Returns what
 * margin the ray needs, as a part of the one proved; 0 if it is less than 0.7
 * or the ray misses. */
static double try_margin(void)
{
    static const int32_t to[2][2][3] = {
            {{4, 3, -2}, {2, -3, -4}}, {{-4, 3, 2}, {-2, -3, 4}}};
    const unsigned by = (unsigned)random_in(0, 2);
    const bool mirrored = random_in(0, 1) != 0;
    const double stretch = random_in(2600, 4190) / 8192.0;
    int32_t o[3] = {random_in(0, 400) * 256 + 127 + random_in(0, 3),
            random_in(0, QL_GRID_MAX * 256),
            random_in(0, 400) * 256 + 127 + random_in(0, 3)};
    int32_t corner[3] = {random_in(31000, 32700), random_in(100, 32000),
            random_in(31000, 32700)};
    int32_t v[3][3], d[3];
    const unsigned x = by, z = (2 + by) % 3;
    double needed;
    ql_ray_t ray;
    ql_hit_t hit;
    uint64_t det, t;
    unsigned side;

    turn(o, by, mirrored, QL_GRID_MAX * 256);
    turn(corner, by, mirrored, QL_GRID_MAX);
    for (unsigned k = 0; k < 3; k++) {
        d[k] = (int32_t)lround((corner[k] * 256.0 - o[k]) * stretch);
    }
    if (labs(d[z]) < labs(d[x]) || labs(d[z]) < labs(d[(1 + by) % 3]) ||
            labs(d[z]) < 2097152) {
        return 0;
    }
    needed = margin_needed(o, d, corner, x, z) / MARGIN_PROVED;
    if (fabs(needed) < 0.75) {
        return 0;
    }
    /* at the low end of x where the point is too far along x; d_x d_z > 0 */
    side = needed > 0 ? 0 : 1;
    for (unsigned i = 0; i < 3; i++) {
        for (unsigned k = 0; k < 3; k++) {
            v[i][(k + by) % 3] =
                    corner[(k + by) % 3] + (i == 0 ? 0 : to[side][i - 1][k]);
        }
    }
    /* aim at 1/64 of the way to the middle */
    for (unsigned k = 0; k < 3; k++) {
        const double aim =
                corner[k] + (v[1][k] + v[2][k] - 2.0 * corner[k]) / 3 / 64;

        d[k] = (int32_t)lround((aim * 256 - o[k]) * stretch);
    }
    needed = margin_needed(o, d, corner, x, z) / MARGIN_PROVED;
    if (fabs(needed) < 0.7 || (needed > 0) != (side == 0)) {
        return 0;
    }

    mini_begin(&mini);
    mini.node_bits = 16;
    mini.leaf_max = 1;
    mini_triangle(&mini, v[0], v[1], v[2], mini_material(&mini, 0.5, 0));
    for (int32_t i = 0; i < 3; i++) {
        const int32_t a[3] = {9000 + 999 * i, 20000, 11000};
        const int32_t b[3] = {9100 + 999 * i, 20000, 11000};
        const int32_t c[3] = {9000 + 999 * i, 20100, 11000};

        mini_triangle(&mini, a, b, c, 0);
    }
    mini_open(&mini, &scene);
    ray.origin = vec(o[0], o[1], o[2]);
    ray.direction = vec(d[0], d[1], d[2]);
    for (unsigned i = 0; i < 4; i++) {
        if (ql_tri_hit(&scene, scene.triangles + i, &ray, &det, &t) != 0) {
            CHECK(ql_bvh_closest_hit(&scene, &ray, &hit) && hit.tri_idx == i,
                    "a ray that needs %.3f of the margin is lost", needed);
            return fabs(needed);
        }
    }
    return 0;
}

TEST(rays_that_need_most_of_the_margin_are_found)
{
    unsigned long found = 0;
    double most = 0;

    state = 31;
    for (long i = 0; i < MANY(400000); i++) {
        const double needed = try_margin();

        found += needed > 0;
        most = fmax(most, needed);
    }
    CHECK(found > 20 && most > 0.8, "%lu rays, at most %.3f", found, most);
    CHECK(most <= 1, "%.3f of the margin", most);
    NOTE("%lu rays need 0.7 to %.3f of it", found, most);
}

#endif

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_bvh", argc, argv);
#if QL_CFG_NODE16
    RUN(closest_hit_equals_brute_force_on_cornell_16);
    RUN(closest_hit_equals_brute_force_on_a_soup_16);
    RUN(occlusion_equals_brute_force_on_cornell_16);
    RUN(occlusion_equals_brute_force_on_a_soup_16);
#endif
#if QL_CFG_NODE8
    RUN(closest_hit_equals_brute_force_on_cornell_8);
    RUN(closest_hit_equals_brute_force_on_a_soup_8);
    RUN(occlusion_equals_brute_force_on_cornell_8);
    RUN(occlusion_equals_brute_force_on_a_soup_8);
#endif
    RUN(ray_parameters_are_within_their_bound);
    RUN(of_equal_triangles_the_lowest_index_wins);
    RUN(no_ray_leaves_a_cube_by_its_edges);
    RUN(no_ray_leaves_a_sphere_by_its_edges);
    RUN(no_ray_leaves_a_displaced_sphere_by_its_edges);
#if QL_CFG_NODE16
    RUN(boxes_shrunk_by_a_unit_are_detected);
#endif
#if QL_POS_BITS > 0 && QL_CFG_NODE16
    RUN(rays_that_need_most_of_the_margin_are_found);
#endif
    return TEST_END();
}
