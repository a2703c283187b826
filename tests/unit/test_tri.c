/* test_tri.c - ray against triangle equals an exact 128-bit oracle */
/* SPDX-License-Identifier: MIT */

#include <math.h>

#include "support/ql_stats.h"
#include "support/ql_test.h"
#include "support/ql_wide.h"
#include "math/vec/ql_vec_unit.h"
#include "trace/ql_tri.h"

enum { LOW = QL_GRID_MARGIN, HIGH = QL_GRID_MAX - QL_GRID_MARGIN };

#define ONE (1 << QL_POS_BITS) /* a grid unit as a position */

/* ---- One triangle ------------------------------------------------------ */

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

static ql_vec3_t vec(int32_t x, int32_t y, int32_t z)
{
    const ql_vec3_t v = {x, y, z};

    return v;
}

static ql_vec3_t add(ql_vec3_t a, ql_vec3_t b, int32_t by)
{
    return vec(a.x + b.x * by, a.y + b.y * by, a.z + b.z * by);
}

/* ---- The oracle -------------------------------------------------------- */

typedef struct {
    int64_t x, y, z;
} long3_t;

static long3_t long_cross(long3_t a, long3_t b)
{
    const long3_t r = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
            a.x * b.y - a.y * b.x};

    return r;
}

static wide_t long_dot(long3_t a, long3_t b)
{
    return wide_add(wide_add(wide_mul(a.x, b.x), wide_mul(a.y, b.y)),
            wide_mul(a.z, b.z));
}

typedef struct {
    int side; /* as ql_tri_hit() returns it */
    uint64_t det, t;
    bool overflow; /* det or t beyond 63 bits */
} answer_t;

/* Solve origin + t d = v0 + u e1 + v e2 by determinants of 128 bits. */
static answer_t oracle(const ql_ray_t *ray)
{
    const ql_vec3_t *c = one.corner;
    const long3_t e1 = {c[1].x - c[0].x, c[1].y - c[0].y, c[1].z - c[0].z};
    const long3_t e2 = {c[2].x - c[0].x, c[2].y - c[0].y, c[2].z - c[0].z};
    const long3_t d = {ray->direction.x, ray->direction.y, ray->direction.z};
    const long3_t s = {ray->origin.x - (int64_t)c[0].x * ONE,
            ray->origin.y - (int64_t)c[0].y * ONE,
            ray->origin.z - (int64_t)c[0].z * ONE};
    const long3_t n = long_cross(e1, e2), q = long_cross(s, d);
    const wide_t zero = wide_mul(0, 0);
    const wide_t minus_det = long_dot(d, n);
    const int sign = -wide_sign(minus_det);
    wide_t u = long_dot(q, e2), v = wide_sub(zero, long_dot(q, e1));
    wide_t t = long_dot(s, n), det = wide_sub(zero, minus_det), w;
    answer_t a = {0, 0, 0, false};

    if (sign < 0) {
        u = wide_sub(zero, u);
        v = wide_sub(zero, v);
        t = wide_sub(zero, t);
        det = minus_det;
    }
    /* u, v count 2^-f units: w = det 2^f - u - v */
    a.det = wide_low(det);
    a.t = wide_low(t);
    a.overflow = wide_sign(wide_sub(det, wide_mul((int64_t)a.det, 1))) != 0;
    w = wide_sub(wide_sub(wide_mul((int64_t)a.det, ONE), u), v);
    if (sign != 0 && wide_sign(u) >= 0 && wide_sign(v) >= 0 &&
            wide_sign(w) >= 0 && wide_sign(t) > 0) {
        a.side = sign;
    }
    return a;
}

static unsigned long rays, hits;

static int check_ray(const ql_ray_t *ray)
{
    const answer_t a = oracle(ray);
    const ql_vec3_t *c = one.corner;
    uint64_t det = 0, t = 0;
    const int side = ql_tri_hit(&one.scene, &one.tri, ray, &det, &t);

    rays++;
    hits += a.side != 0;
    CHECK(!a.overflow && side == a.side &&
                    (side == 0 || (det == a.det && t == a.t)),
            "(%ld %ld %ld) (%ld %ld %ld) (%ld %ld %ld), from (%ld %ld %ld) "
            "along (%ld %ld %ld): %d, not %d",
            (long)c[0].x, (long)c[0].y, (long)c[0].z, (long)c[1].x,
            (long)c[1].y, (long)c[1].z, (long)c[2].x, (long)c[2].y,
            (long)c[2].z, (long)ray->origin.x, (long)ray->origin.y,
            (long)ray->origin.z, (long)ray->direction.x, (long)ray->direction.y,
            (long)ray->direction.z, side, a.side);
    return side;
}

/* A segment, and the unending ray the same way. */
static int check_to(ql_vec3_t from, ql_vec3_t to)
{
    ql_ray_t ray;
    int side;

    ray.origin = from;
    ray.direction = ql_vec_sub(to, from);
    side = check_ray(&ray);
    ray.direction = ql_vec_to_dir(ray.direction);
    if ((ray.direction.x | ray.direction.y | ray.direction.z) != 0) {
        (void)check_ray(&ray);
    }
    return side;
}

/* ---- Random geometry --------------------------------------------------- */

static uint64_t state;

static int32_t random_in(int32_t low, int32_t high)
{
    return low + (int32_t)stats_random_below(
                         &state, (uint64_t)((int64_t)high - low + 1));
}

static ql_vec3_t random_corner(void)
{
    return vec(
            random_in(LOW, HIGH), random_in(LOW, HIGH), random_in(LOW, HIGH));
}

static int32_t clamp(int32_t v)
{
    return v < LOW ? LOW : v > HIGH ? HIGH : v;
}

/* Within reach of a corner. */
static ql_vec3_t near(ql_vec3_t v, int32_t reach)
{
    return vec(clamp(v.x + random_in(-reach, reach)),
            clamp(v.y + random_in(-reach, reach)),
            clamp(v.z + random_in(-reach, reach)));
}

static ql_vec3_t random_position(void)
{
    const int32_t max = QL_GRID_MAX * ONE;

    return vec(random_in(0, max), random_in(0, max), random_in(0, max));
}

/* Any size, slivers included. */
static void random_triangle(void)
{
    const ql_vec3_t a = random_corner();
    const ql_vec3_t b = near(a, 1 << random_in(0, 15));

    set_triangle(a, b, near(random_in(0, 1) ? a : b, 1 << random_in(0, 15)));
}

/* A position inside the triangle or a little beside it. */
static ql_vec3_t aim(void)
{
    const double b1 = stats_random_unit(&state) * 1.1 - 0.05;
    const double b2 = (stats_random_unit(&state) * 1.1 - 0.05) * (1 - b1);
    const ql_vec3_t *c = one.corner;
    const double max = QL_GRID_MAX;

    return vec((int32_t)(fmin(fmax(c[0].x + b1 * (c[1].x - c[0].x) +
                                              b2 * (c[2].x - c[0].x),
                                      0),
                                 max) *
                         ONE),
            (int32_t)(fmin(fmax(c[0].y + b1 * (c[1].y - c[0].y) +
                                           b2 * (c[2].y - c[0].y),
                                   0),
                              max) *
                      ONE),
            (int32_t)(fmin(fmax(c[0].z + b1 * (c[1].z - c[0].z) +
                                           b2 * (c[2].z - c[0].z),
                                   0),
                              max) *
                      ONE));
}

TEST(random_rays_equal_the_oracle)
{
    state = 1;
    rays = hits = 0;
    for (long i = 0; i < MANY(300000); i++) {
        random_triangle();
        (void)check_to(random_position(), random_position());
        (void)check_to(random_position(), aim());
    }
    NOTE("%lu rays, %lu hits", rays, hits);
}

/* Every triangle and segment between corners of the legal cube. */
TEST(corners_of_the_legal_cube_equal_the_oracle)
{
    rays = hits = 0;
    for (unsigned i = 0; i < 8 * 8 * 8; i++) {
        ql_vec3_t c[3];

        for (unsigned k = 0; k < 3; k++) {
            const unsigned bits = i >> 3 * k & 7u;

            c[k] = vec(bits & 1 ? HIGH : LOW, bits & 2 ? HIGH : LOW,
                    bits & 4 ? HIGH : LOW);
        }
        set_triangle(c[0], c[1], c[2]);
        for (unsigned j = 0; j < 27 * 27; j++) {
            const int32_t at[3] = {0, 16384 * ONE, QL_GRID_MAX * ONE};
            const unsigned f = j % 27, t = j / 27;

            (void)check_to(vec(at[f % 3], at[f / 3 % 3], at[f / 9]),
                    vec(at[t % 3], at[t / 3 % 3], at[t / 9]));
        }
        for (unsigned j = 0; j < 64; j++) {
            const int32_t at[2] = {LOW * ONE, HIGH * ONE};

            (void)check_to(vec(at[j & 1], at[j >> 1 & 1], at[j >> 2 & 1]),
                    vec(at[j >> 3 & 1], at[j >> 4 & 1], at[j >> 5 & 1]));
        }
    }
    NOTE("%lu rays, %lu hits", rays, hits);
}

TEST(directions_with_zero_components_equal_the_oracle)
{
    state = 2;
    rays = hits = 0;
    for (long i = 0; i < MANY(200000); i++) {
        ql_vec3_t to;
        ql_vec3_t from;

        random_triangle();
        to = aim();
        from = to;
        /* one or two axes left as they are */
        if (i % 3 != 0) {
            from.x = random_in(0, QL_GRID_MAX * ONE);
        }
        if (i % 3 != 1) {
            from.y = random_in(0, QL_GRID_MAX * ONE);
        }
        if (i % 6 == 5) {
            from.y = to.y;
            from.z = random_in(0, QL_GRID_MAX * ONE);
        }
        (void)check_to(from, to);
    }
    NOTE("%lu rays, %lu hits", rays, hits);
}

/* ---- Edges, corners, planes -------------------------------------------- */

/* A segment through a position at its middle, if it stays in the box. */
static bool through(ql_vec3_t from, ql_vec3_t at, ql_ray_t *ray)
{
    const ql_vec3_t half = ql_vec_sub(at, from);
    const ql_vec3_t end = add(at, half, 1);
    const int32_t max = QL_GRID_MAX * ONE;

    ray->origin = from;
    ray->direction = add(half, half, 1);
    return end.x >= 0 && end.x <= max && end.y >= 0 && end.y <= max &&
           end.z >= 0 && end.z <= max;
}

/* Whether the plane of the triangle does not contain a position. */
static bool off_plane(ql_vec3_t p)
{
    const ql_vec3_t *c = one.corner;
    const ql_vec3_t n =
            ql_vec_cross(ql_vec_sub(c[1], c[0]), ql_vec_sub(c[2], c[0]));

    return ql_vec_dot(
                   ql_vec_sub(p, vec(c[0].x * ONE, c[0].y * ONE, c[0].z * ONE)),
                   n) != 0;
}

TEST(rays_exactly_through_corners_and_edges_hit)
{
    state = 3;
    rays = hits = 0;
    for (long i = 0; i < MANY(200000); i++) {
        ql_vec3_t a, at, from;
        ql_ray_t ray;

        random_triangle();
        a = one.corner[i % 3];
        at = vec(a.x * ONE, a.y * ONE, a.z * ONE);
        if (i % 2 != 0) {
            /* a whole number of steps along the edge: exactly on it */
            const ql_vec3_t b = one.corner[(i + 1) % 3];
            const ql_vec3_t e = ql_vec_sub(b, a);
            const int32_t steps = 1 << random_in(0, 3);

            if (e.x % steps != 0 || e.y % steps != 0 || e.z % steps != 0) {
                continue;
            }
            at = add(at,
                    vec(e.x / steps * ONE, e.y / steps * ONE,
                            e.z / steps * ONE),
                    random_in(0, steps));
        }
        from = random_position();
        if (through(from, at, &ray) && off_plane(from)) {
            CHECK(check_ray(&ray) != 0, "missed at ray %ld", i);
        }
    }
    NOTE("%lu rays, %lu hits", rays, hits);
}

TEST(rays_in_the_plane_never_hit)
{
    state = 4;
    rays = hits = 0;
    for (long i = 0; i < MANY(200000); i++) {
        ql_vec3_t a, b, c, p, q;
        ql_ray_t ray;

        random_triangle();
        a = one.corner[0];
        b = one.corner[1];
        c = one.corner[2];
        /* between the corners, and on lines through them */
        p = i & 1 ? a : add(a, ql_vec_sub(b, a), -1);
        q = i & 2 ? add(b, ql_vec_sub(c, a), 1) : c;
        if (i % 4 == 3) {
            q = b;
        }
        if (p.x < 0 || p.y < 0 || p.z < 0 || p.x > QL_GRID_MAX ||
                p.y > QL_GRID_MAX || p.z > QL_GRID_MAX || q.x < 0 || q.y < 0 ||
                q.z < 0 || q.x > QL_GRID_MAX || q.y > QL_GRID_MAX ||
                q.z > QL_GRID_MAX) {
            continue;
        }
        ray.origin = vec(p.x * ONE, p.y * ONE, p.z * ONE);
        ray.direction =
                ql_vec_sub(vec(q.x * ONE, q.y * ONE, q.z * ONE), ray.origin);
        CHECK(check_ray(&ray) == 0, "hit at ray %ld", i);
    }
    NOTE("%lu rays", rays);
}

TEST(rays_that_start_on_the_triangle_or_beyond_it_miss)
{
    state = 5;
    rays = hits = 0;
    for (long i = 0; i < MANY(100000); i++) {
        ql_vec3_t a, at, from;
        ql_ray_t ray;

        random_triangle();
        a = one.corner[i % 3];
        at = vec(a.x * ONE, a.y * ONE, a.z * ONE);
        from = random_position();
        ray.origin = at;
        ray.direction = ql_vec_sub(from, at);
        CHECK(check_ray(&ray) == 0, "hit its own corner, ray %ld", i);
        ray.origin = from; /* and away from it */
        CHECK(check_ray(&ray) == 0, "hit backwards, ray %ld", i);
    }
    NOTE("%lu rays", rays);
}

TEST(triangles_without_area_are_never_hit)
{
    state = 6;
    rays = hits = 0;
    for (long i = 0; i < MANY(100000); i++) {
        const ql_vec3_t a = random_corner(),
                        step = vec(random_in(-99, 99), random_in(-99, 99),
                                random_in(-99, 99));
        const ql_vec3_t b = vec(clamp(a.x), clamp(a.y), clamp(a.z));
        const ql_vec3_t along = add(a, step, random_in(0, 9));
        ql_vec3_t from = random_position();

        /* three equal corners, two, or three on a line */
        set_triangle(
                a, i % 3 == 2 ? add(a, step, 1) : b, i % 3 == 0 ? a : along);
        if (one.corner[1].x < LOW || one.corner[1].x > HIGH ||
                one.corner[1].y < LOW || one.corner[1].y > HIGH ||
                one.corner[1].z < LOW || one.corner[1].z > HIGH ||
                along.x < LOW || along.x > HIGH || along.y < LOW ||
                along.y > HIGH || along.z < LOW || along.z > HIGH) {
            continue;
        }
        CHECK(check_to(from, vec(a.x * ONE, a.y * ONE, a.z * ONE)) == 0,
                "hit, triangle %ld", i);
    }
    NOTE("%lu rays", rays);
}

/* ---- Orientation ------------------------------------------------------- */

TEST(turning_the_corners_around_turns_the_side_and_nothing_else)
{
    unsigned long turned = 0;

    state = 7;
    for (long i = 0; i < MANY(200000); i++) {
        ql_vec3_t c[3];
        ql_ray_t ray;
        uint64_t det[6] = {0}, t[6] = {0};
        int side[6];

        random_triangle();
        memcpy(c, one.corner, sizeof c);
        ray.origin = random_position();
        ray.direction = ql_vec_to_dir(ql_vec_sub(aim(), ray.origin));
        for (unsigned k = 0; k < 6; k++) {
            const unsigned a = k % 3, step = k < 3 ? 1 : 2;

            set_triangle(c[a], c[(a + step) % 3], c[(a + 2 * step) % 3]);
            side[k] = ql_tri_hit(&one.scene, &one.tri, &ray, &det[k], &t[k]);
        }
        for (unsigned k = 1; k < 6; k++) {
            CHECK(side[k] == (k < 3 ? side[0] : -side[0]) &&
                            (side[0] == 0 ||
                                    (det[k] == det[0] && t[k] == t[0])),
                    "triangle %ld, order %u: side %d, not %d", i, k, side[k],
                    side[0]);
        }
        turned += side[0] != 0;
    }
    NOTE("%lu hits", turned);
}

TEST(counter_clockwise_is_the_front)
{
    ql_ray_t ray;
    uint64_t det, t;

    set_triangle(vec(100, 100, 100), vec(200, 100, 100), vec(100, 200, 100));
    ray.origin = vec(120 * ONE, 120 * ONE, 300 * ONE);
    ray.direction = vec(0, 0, -(1 << (QL_DIR_BITS - 1)));
    CHECK(ql_tri_hit(&one.scene, &one.tri, &ray, &det, &t) == 1, "from +z");
    ray.origin.z = 20 * ONE;
    ray.direction.z = -ray.direction.z;
    CHECK(ql_tri_hit(&one.scene, &one.tri, &ray, &det, &t) == -1, "from -z");
}

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_tri", argc, argv);
    RUN(random_rays_equal_the_oracle);
    RUN(corners_of_the_legal_cube_equal_the_oracle);
    RUN(directions_with_zero_components_equal_the_oracle);
    RUN(rays_exactly_through_corners_and_edges_hit);
    RUN(rays_in_the_plane_never_hit);
    RUN(rays_that_start_on_the_triangle_or_beyond_it_miss);
    RUN(triangles_without_area_are_never_hit);
    RUN(turning_the_corners_around_turns_the_side_and_nothing_else);
    RUN(counter_clockwise_is_the_front);
    return TEST_END();
}
