/* test_surface.c - hit points end on the right side, in two steps at most */
/* SPDX-License-Identifier: MIT */

#include <math.h>

#include "support/picture/mini_scene.h"
#include "support/ql_stats.h"
#include "support/ql_points.h"
#include "support/ql_test.h"
#include "math/vec/ql_vec_unit.h"
#include "trace/ql_bvh.h"
#include "trace/surface/ql_surface_at.h"

enum {
    LOW = QL_GRID_MARGIN,
    HIGH = QL_GRID_MAX - QL_GRID_MARGIN,
    TRIANGLES = 100000,
    STEPS_MAX = 2
};

static int32_t clamp(int32_t v)
{
    return v < LOW ? LOW : v > HIGH ? HIGH : v;
}

static ql_vec3_t near(ql_vec3_t v, int32_t reach)
{
    return vec(clamp(v.x + random_in(-reach, reach)),
            clamp(v.y + random_in(-reach, reach)),
            clamp(v.z + random_in(-reach, reach)));
}

/* 1/|n| as the scene compiler packs it: 27 bits to nearest, then 1 - e. */
static uint32_t pack_inverse(ql_vec3_t n)
{
    const double size =
            sqrt((double)n.x * n.x + (double)n.y * n.y + (double)n.z * n.z);
    int e;
    double m = ldexp(frexp(1 / size, &e), 27);

    m = floor(m + 0.5);
    if (m >= 134217728.0) {
        m /= 2;
        e++;
    }
    return (uint32_t)m << 5 | (uint32_t)(1 - e);
}

/* ---- One triangle, in one leaf ----------------------------------------- */

static struct {
    ql_scene_t scene;
    ql_blob_vertex_t vertices[3];
    ql_blob_tri_t tri;
    ql_vec3_t corner[3];
    ql_vec3_t n;
} one;

static bool set_triangle(ql_vec3_t a, ql_vec3_t b, ql_vec3_t c)
{
    const ql_vec3_t corner[3] = {a, b, c};

    memcpy(one.corner, corner, sizeof corner);
    one.n = ql_vec_cross(ql_vec_sub(b, a), ql_vec_sub(c, a));
    if ((one.n.x | one.n.y | one.n.z) == 0) {
        return false;
    }
    for (uint16_t i = 0; i < 3; i++) {
        one.vertices[i].xyz[0] = QL_LE16((uint16_t)corner[i].x);
        one.vertices[i].xyz[1] = QL_LE16((uint16_t)corner[i].y);
        one.vertices[i].xyz[2] = QL_LE16((uint16_t)corner[i].z);
        one.tri.vertex[i] = QL_LE16(i);
    }
    one.tri.inv_n = QL_LE32(pack_inverse(one.n));
    one.scene.vertices = one.vertices;
    one.scene.triangles = &one.tri;
    one.scene.pairs = one.vertices; /* never read: the root is a leaf */
    one.scene.node_bits = 16;
    one.scene.root_meta = 4;
    return true;
}

/* Any size and shape, slivers of a few units' width included. */
static void random_triangle(void)
{
    ql_vec3_t a, b;

    do {
        a = vec(random_in(LOW, HIGH), random_in(LOW, HIGH),
                random_in(LOW, HIGH));
        b = near(a, 1 << random_in(0, 15));
    } while (!set_triangle(
            a, b, near(random_in(0, 1) ? a : b, 1 << random_in(0, 15))));
}

static ql_vec3_t aim(void)
{
    const double b1 = stats_random_unit(&state);
    const double b2 = stats_random_unit(&state) * (1 - b1);
    const ql_vec3_t *c = one.corner;

    return vec((int32_t)lrint((c[0].x + b1 * (c[1].x - c[0].x) +
                                      b2 * (c[2].x - c[0].x)) *
                              ONE),
            (int32_t)lrint(
                    (c[0].y + b1 * (c[1].y - c[0].y) + b2 * (c[2].y - c[0].y)) *
                    ONE),
            (int32_t)lrint(
                    (c[0].z + b1 * (c[1].z - c[0].z) + b2 * (c[2].z - c[0].z)) *
                    ONE));
}

/* n.(p - corner) in units of 2^-f */
static int64_t side_of(ql_vec3_t p, ql_vec3_t n)
{
    const ql_vec3_t c = one.corner[0];

    return ql_vec_dot(ql_vec_sub(p, vec(c.x * ONE, c.y * ONE, c.z * ONE)), n);
}

/* A ray that hits the triangle, made by aiming at it until one does. */
static void random_hit(ql_ray_t *ray, ql_hit_t *hit)
{
    do {
        random_triangle();
        for (unsigned tries = 0; tries < 20; tries++) {
            ray->origin = random_position();
            if (tries % 4 == 3) { /* close by, and grazing */
                const ql_vec3_t at = near(one.corner[0], 16);

                ray->origin = vec(at.x * ONE, at.y * ONE, at.z * ONE);
            }
            ray->direction = ql_vec_to_dir(ql_vec_sub(aim(), ray->origin));
            if ((ray->direction.x | ray->direction.y | ray->direction.z) != 0 &&
                    ql_bvh_closest_hit(&one.scene, ray, hit)) {
                return;
            }
        }
    } while (true);
}

/* ---- Sides ------------------------------------------------------------- */

static ql_vec3_t turned(bool front)
{
    return front ? one.n : vec(-one.n.x, -one.n.y, -one.n.z);
}

TEST(points_are_strictly_on_the_side_they_were_seen_from)
{
    unsigned long fronts = 0;

    state = 1;
    for (long i = 0; i < TRIANGLES; i++) {
        ql_surface_t surface;
        ql_ray_t ray;
        ql_hit_t hit;
        ql_vec3_t n;

        random_hit(&ray, &hit);
        n = turned(hit.front);
        fronts += hit.front;
        ql_surface_at(&one.scene, &ray, &hit, &surface);
        CHECK(surface.n.x == n.x && surface.n.y == n.y && surface.n.z == n.z,
                "triangle %ld: the normal does not face the ray", i);
        CHECK(side_of(ray.origin, n) > 0, "triangle %ld: the ray starts behind",
                i);
        CHECK(side_of(surface.p, n) > 0,
                "triangle %ld, n (%ld %ld %ld): p (%ld %ld %ld) is behind", i,
                (long)n.x, (long)n.y, (long)n.z, (long)surface.p.x,
                (long)surface.p.y, (long)surface.p.z);
    }
    NOTE("%d triangles, %lu seen from the front", TRIANGLES, fronts);
}

TEST(two_steps_are_always_enough)
{
    unsigned long count[QL_SIDE_STEPS_MAX + 1] = {0};

    state = 2;
    for (long i = 0; i < TRIANGLES; i++) {
        ql_surface_t surface;
        ql_ray_t ray;
        ql_hit_t hit;
        ql_vec3_t p, n;
        unsigned steps;

        random_hit(&ray, &hit);
        ql_surface_at(&one.scene, &ray, &hit, &surface);
        /* where the ray gets to, cut towards its origin */
        p.x = ray.origin.x +
              (int32_t)((int64_t)ray.direction.x * hit.t / (1l << 30));
        p.y = ray.origin.y +
              (int32_t)((int64_t)ray.direction.y * hit.t / (1l << 30));
        p.z = ray.origin.z +
              (int32_t)((int64_t)ray.direction.z * hit.t / (1l << 30));
        n = turned(hit.front);
        steps = ql_surface_step(&p, &one.corner[0], &n);
        count[steps]++;
        CHECK(p.x == surface.p.x && p.y == surface.p.y && p.z == surface.p.z,
                "triangle %ld: (%ld %ld %ld), not (%ld %ld %ld)", i,
                (long)surface.p.x, (long)surface.p.y, (long)surface.p.z,
                (long)p.x, (long)p.y, (long)p.z);
        CHECK(steps <= STEPS_MAX, "triangle %ld, n (%ld %ld %ld): %u steps", i,
                (long)one.n.x, (long)one.n.y, (long)one.n.z, steps);
    }
    NOTE("0: %lu, 1: %lu, 2: %lu, 3: %lu, 4: %lu", count[0], count[1], count[2],
            count[3], count[4]);
}

/* Light points are rounded to nearest: at most half a unit off the plane. */
TEST(a_point_rounded_to_nearest_needs_two_steps_at_most)
{
    unsigned long count[QL_SIDE_STEPS_MAX + 1] = {0};

    state = 3;
    for (long i = 0; i < TRIANGLES; i++) {
        ql_vec3_t p;
        unsigned steps;

        random_triangle();
        p = aim();
        steps = ql_surface_step(&p, &one.corner[0], &one.n);
        count[steps]++;
        CHECK(steps <= STEPS_MAX && side_of(p, one.n) > 0,
                "triangle %ld: %u steps", i, steps);
    }
    NOTE("0: %lu, 1: %lu, 2: %lu", count[0], count[1], count[2]);
}

/* The planted fault: without correction about half the points are not in
 * front, so a test that only looks must see it. */
TEST(points_without_correction_are_rejected)
{
    unsigned long behind = 0;

    state = 4;
    for (long i = 0; i < 1000; i++) {
        random_triangle();
        behind += side_of(aim(), one.n) <= 0;
    }
    CHECK(behind > 100, "%lu of 1000", behind);
    NOTE("%lu of 1000 are on the plane or behind it", behind);
}

TEST(steps_stop_at_their_limit_whatever_the_plane)
{
    const ql_vec3_t zero = vec(0, 0, 0), x = vec(1, 0, 0);
    const ql_vec3_t far = vec(32767, 0, 0);
    ql_vec3_t p = zero;

    CHECK(ql_surface_step(&p, &far, &x) == QL_SIDE_STEPS_MAX,
            "a plane far away");
    p = zero;
    CHECK(ql_surface_step(&p, &zero, &zero) == QL_SIDE_STEPS_MAX,
            "a normal of zero");
}

/* ---- Rooms ------------------------------------------------------------- */

/* Points stay inside: strictly off the wall that was hit, and never past the
 * others. */
TEST(points_stay_in_an_axis_aligned_room)
{
    static mini_scene_t mini;
    static const int32_t low[3] = {LOW, 1000, 12345};
    static const int32_t high[3] = {20001, HIGH, 23456};
    ql_scene_t scene;

    mini_begin(&mini);
    mini_room(&mini, low, high, mini_material(&mini, 0.5, 0));
    mini_open(&mini, &scene);
    state = 5;
    for (long i = 0; i < TRIANGLES; i++) {
        ql_surface_t surface;
        ql_ray_t ray;
        ql_hit_t hit;
        int32_t p[3];
        unsigned strict = 0;

        ray.origin = vec(random_in(low[0] * ONE + 1, high[0] * ONE - 1),
                random_in(low[1] * ONE + 1, high[1] * ONE - 1),
                random_in(low[2] * ONE + 1, high[2] * ONE - 1));
        ray.direction =
                ql_vec_to_dir(ql_vec_sub(random_position(), ray.origin));
        if ((ray.direction.x | ray.direction.y | ray.direction.z) == 0) {
            continue;
        }
        CHECK(ql_bvh_closest_hit(&scene, &ray, &hit), "ray %ld left the room",
                i);
        CHECK(hit.front, "ray %ld saw a wall from behind", i);
        ql_surface_at(&scene, &ray, &hit, &surface);
        p[0] = surface.p.x;
        p[1] = surface.p.y;
        p[2] = surface.p.z;
        for (unsigned k = 0; k < 3; k++) {
            CHECK(p[k] >= low[k] * ONE && p[k] <= high[k] * ONE,
                    "ray %ld: axis %u at %ld", i, k, (long)p[k]);
            strict += p[k] > low[k] * ONE && p[k] < high[k] * ONE;
        }
        CHECK(strict >= 1, "ray %ld ended in a corner", i);
    }
    NOTE("%d rays", TRIANGLES);
}

/* ---- Unit normals ------------------------------------------------------ */

static double unit_worst;

static void check_unit(ql_vec3_t n)
{
    const ql_vec3_t u = ql_vec_unit_q29_of_inv_n(n, pack_inverse(n));
    const double size =
            sqrt((double)n.x * n.x + (double)n.y * n.y + (double)n.z * n.z);
    const double x = ldexp(u.x, -29) - n.x / size;
    const double y = ldexp(u.y, -29) - n.y / size;
    const double z = ldexp(u.z, -29) - n.z / size;
    const double error = sqrt(x * x + y * y + z * z);

    unit_worst = fmax(unit_worst, error);
    CHECK(error <= 0x1p-26, "n (%ld %ld %ld): (%ld %ld %ld), off by %.3g",
            (long)n.x, (long)n.y, (long)n.z, (long)u.x, (long)u.y, (long)u.z,
            error);
}

TEST(unit_normals_are_within_their_bound)
{
    static const int32_t ends[] = {-1073676289, -32767, -1, 0, 1, 2, 255, 65535,
            1l << 29, (1l << 30) - 1, 1073676289};
    const size_t count = sizeof ends / sizeof ends[0];

    unit_worst = 0;
    state = 6;
    for (size_t i = 0; i < count * count * count; i++) {
        const ql_vec3_t n = vec(ends[i % count], ends[i / count % count],
                ends[i / count / count]);
        const double size =
                sqrt((double)n.x * n.x + (double)n.y * n.y + (double)n.z * n.z);

        /* twice the area of a triangle in the box: below sqrt(3) 2^30 */
        if (size > 0 && size < 1859e6) {
            check_unit(n);
        }
    }
    for (int32_t i = 1; i < MANY(200000); i++) {
        check_unit(vec(i, 0, 0));
        check_unit(vec(0, -i, i));
    }
    for (long i = 0; i < TRIANGLES; i++) {
        random_triangle();
        check_unit(one.n);
    }
    NOTE("worst %.2e, bound %.2e", unit_worst, 0x1p-26);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_surface", argc, argv);
    RUN(points_are_strictly_on_the_side_they_were_seen_from);
    RUN(two_steps_are_always_enough);
    RUN(a_point_rounded_to_nearest_needs_two_steps_at_most);
    RUN(points_without_correction_are_rejected);
    RUN(steps_stop_at_their_limit_whatever_the_plane);
    RUN(points_stay_in_an_axis_aligned_room);
    RUN(unit_normals_are_within_their_bound);
    return TEST_END();
}
