/* test_sphere.c - sides exact, hits on the sphere, no ray meets what it left */
/* SPDX-License-Identifier: MIT */

#include <math.h>

#include "support/picture/mini_scene.h"
#include "support/ql_points.h"
#include "support/ql_stats.h"
#include "support/ql_table_error.h"
#include "support/ql_test.h"
#include "support/ql_wide.h"
#include "light/ql_emit_sphere.h"
#include "math/vec/ql_vec_unit.h"
#include "trace/ql_bvh.h"
#include "trace/surface/ql_smooth.h"
#include "trace/ql_sphere.h"
#include "trace/surface/ql_surface_at.h"

#if QL_CFG_SPHERES

enum {
    LOW = QL_GRID_MARGIN,
    HIGH = QL_GRID_MAX - QL_GRID_MARGIN,
    RAYS = MANY(200000),
    SPHERES = MANY(1000),
    DIRECTIONS = 1000,
    UNIT = 256 / ONE, /* of a position, in those of a sphere */
    STEPS_MAX = 2
};

/* What ql_sphere.h says of a hit point, and of rays too close to call. */
#define ROUND_BOUND   ldexp(1, -26)
#define RADIUS_BOUND  ldexp(1, -29)
#define RIM_LOG2      27 /* of the discriminant; half of it of the radius */
#define INVERSE_BOUND (ldexp(1, -26) + ldexp(1, -28))

/* ---- One sphere, in one leaf ------------------------------------------- */

static struct {
    ql_scene_t scene;
    ql_blob_sphere_t sphere;
    ql_blob_tri_t tri;
    int64_t c[3], r;
} one;

static void set_sphere(int64_t x, int64_t y, int64_t z, int64_t r)
{
    const int64_t c[3] = {x, y, z};

    for (int k = 0; k < 3; k++) {
        one.c[k] = c[k];
        one.sphere.centre[k] = QL_LE32((uint32_t)c[k]);
    }
    one.r = r;
    one.sphere.radius = QL_LE32((uint32_t)r);
    one.tri.inv_n = 0;
    one.scene.spheres = &one.sphere;
    one.scene.triangles = &one.tri;
    one.scene.pairs = &one.sphere; /* never read: the root is a leaf */
    one.scene.node_bits = 16;
    one.scene.root_meta = 4;
}

static double between(double low, double high)
{
    return low + (high - low) * stats_random_unit(&state);
}

/* Any size from one grid unit to the box, all octaves alike; anywhere. */
static void random_sphere(void)
{
    const int32_t low = LOW * 256, high = HIGH * 256;
    const int32_t r = (int32_t)fmin(
            ldexp(1, random_in(8, 21)) * between(1, 2), (high - low) / 2.0);

    set_sphere(random_in(low + r, high - r), random_in(low + r, high - r),
            random_in(low + r, high - r), r);
}

static int32_t into_box(double v)
{
    return (int32_t)fmin(fmax(floor(v / UNIT + 0.5), 0), QL_GRID_MAX * ONE);
}

/* The position nearest to centre + (x, y, z), cut to the box. */
static ql_vec3_t beside_centre(double x, double y, double z)
{
    return vec(into_box((double)one.c[0] + x), into_box((double)one.c[1] + y),
            into_box((double)one.c[2] + z));
}

static void random_unit(double v[3])
{
    const double z = between(-1, 1), turn = between(0, 6.283185307179586);

    v[0] = sqrt(1 - z * z) * cos(turn);
    v[1] = sqrt(1 - z * z) * sin(turn);
    v[2] = z;
}

static ql_vec3_t beside_surface(double distance)
{
    const double r = (double)one.r + distance;
    double u[3];

    random_unit(u);
    return beside_centre(r * u[0], r * u[1], r * u[2]);
}

static bool is_zero(ql_vec3_t v)
{
    return (v.x | v.y | v.z) == 0;
}

static ql_vec3_t random_direction(void)
{
    double u[3];

    random_unit(u);
    return ql_vec_to_dir(vec((int32_t)(u[0] * 536870912.0),
            (int32_t)(u[1] * 536870912.0), (int32_t)(u[2] * 536870912.0)));
}

/* ---- The same in 128 bits ---------------------------------------------- */

/* Of origin and direction as they are, so all of it is exact. */
typedef struct {
    int64_t side, way, size; /* C, B, D */
    wide_t rim;              /* D r^2 - |s x d|^2 */
    wide_t whole;            /* D r^2 */
} exact_t;

static exact_t exact_of(const ql_ray_t *ray, int64_t r)
{
    const int32_t o[3] = {ray->origin.x, ray->origin.y, ray->origin.z};
    const int32_t d32[3] = {
            ray->direction.x, ray->direction.y, ray->direction.z};
    int64_t s[3], d[3];
    exact_t e = {-r * r, 0, 0, wide_mul(0, 0), wide_mul(0, 0)};

    for (int k = 0; k < 3; k++) {
        s[k] = (int64_t)o[k] * UNIT - one.c[k];
        d[k] = (int64_t)d32[k] * UNIT;
        e.side += s[k] * s[k];
        e.way += s[k] * d[k];
        e.size += d[k] * d[k];
    }
    e.whole = wide_mul(e.size, r * r);
    e.rim = e.whole;
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const int64_t x = s[i] * d[j] - s[j] * d[i];

        e.rim = wide_sub(e.rim, wide_mul(x, x));
    }
    return e;
}

/* What ql_sphere_hit() must return. */
static int expected(const exact_t *e)
{
    if (e->side > 0) {
        return e->way < 0 && wide_sign(e->rim) > 0;
    }
    return e->side < 0 || e->way < 0 ? -1 : 0;
}

/* What ql_sphere_blocks() must: is there a root of the square strictly between
 * 0 and 1? */
static bool expected_block(const exact_t *e)
{
    const int64_t end = e->side + 2 * e->way + e->size;

    if (e->side < 0 || end < 0) {
        return e->side > 0 || end > 0;
    }
    return (e->side > 0 || end > 0) && e->way < 0 && e->way + e->size > 0 &&
           wide_sign(e->rim) > 0;
}

/* Does the ray pass so close to the rim that it may be lost? */
static bool is_close(const exact_t *e)
{
    wide_t more = e->rim;

    for (int i = 0; i < RIM_LOG2; i++) {
        more = wide_add(more, more); /* 2^94 times 2^27 at most */
    }
    return wide_sign(e->rim) > 0 && wide_sign(wide_sub(more, e->whole)) <= 0;
}

/* How far origin + t direction is off the sphere, 1/256 grid units. */
static double off_sphere(const exact_t *e, ql_uq30_t t)
{
    const long double at = ldexpl(t, -30);
    const long double square =
            ((long double)e->size * at + 2 * (long double)e->way) * at +
            (long double)e->side;
    const long double r = one.r;

    return (double)(square / (sqrtl(square + r * r) + r));
}

/* ---- Sides ------------------------------------------------------------- */

TEST(offsets_and_sides_are_exact)
{
    unsigned long on = 0;

    state = 1;
    for (long i = 0; i < RAYS; i++) {
        ql_ray_t ray = {{0, 0, 0}, {0, 0, 0}};
        ql_vec3_t s;
        exact_t e;

        random_sphere();
        ray.origin = i % 2 ? random_position() : beside_surface(0);
        if (i % 4 == 2) { /* exactly on it: the centre takes the rounding */
            const int32_t r = random_in(1, 16000) * UNIT * ONE / 4;

            set_sphere((int64_t)ray.origin.x * UNIT - 2 * r,
                    (int64_t)ray.origin.y * UNIT - r,
                    (int64_t)ray.origin.z * UNIT - 2 * r, 3 * r);
        }
        e = exact_of(&ray, one.r);
        s = ql_sphere_offset(&one.sphere, ray.origin);
        on += e.side == 0;
        if (one.c[0] < 0 || one.c[1] < 0 || one.c[2] < 0 ||
                one.r > 16375 * 256) {
            continue; /* not within the box */
        }
        CHECK(s.x == ray.origin.x * UNIT - one.c[0] &&
                        s.y == ray.origin.y * UNIT - one.c[1] &&
                        s.z == ray.origin.z * UNIT - one.c[2],
                "ray %ld: offset (%ld %ld %ld)", i, (long)s.x, (long)s.y,
                (long)s.z);
        CHECK(ql_sphere_side(&one.sphere, s) == e.side,
                "ray %ld: side %lld, not %lld", i,
                (long long)ql_sphere_side(&one.sphere, s), (long long)e.side);
    }
    CHECK(on >= RAYS / 4, "only %lu points lie on their sphere", on);
    NOTE("%d points, %lu on their sphere", RAYS, on);
}

/* ---- Hits -------------------------------------------------------------- */

/* Rays of every kind: from anywhere, inside, on the surface and a few units
 * beside it; aimed anywhere, at the sphere, at its rim, along an axis. */
static ql_ray_t random_ray(long i)
{
    const double far = ldexp(1, random_in(0, 22));
    ql_ray_t ray;

    switch (i % 4) {
    case 0:
        ray.origin = random_position();
        break;
    case 1:
        ray.origin = beside_surface(random_in(-3, 3) * UNIT);
        break;
    case 2:
        ray.origin = beside_surface(far);
        break;
    default:
        ray.origin = beside_surface(-(double)one.r * between(0, 1));
        break;
    }
    do {
        double u[3], v[3], along = 0;

        random_unit(u);
        ray.direction = random_direction();
        if (i / 4 % 4 == 1) { /* at the sphere */
            ray.direction = ql_vec_to_dir(
                    ql_vec_sub(beside_surface(-(double)one.r * between(0, 1)),
                            ray.origin));
        } else if (i / 4 % 4 == 2) { /* at the rim, or nearly */
            const int32_t o[3] = {ray.origin.x, ray.origin.y, ray.origin.z};
            double size = 0, scale;

            for (int k = 0; k < 3; k++) {
                v[k] = (double)one.c[k] - (double)o[k] * UNIT;
                size += v[k] * v[k];
                along += v[k] * u[k];
            }
            /* the tangent point of the plane through u: (1 - q) v + ... */
            scale = sqrt(fmax(size - (double)(one.r * one.r), 1));
            for (int k = 0; k < 3; k++) {
                u[k] -= along / fmax(size, 1) * v[k];
            }
            along = sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
            for (int k = 0; k < 3; k++) {
                v[k] += u[k] / along * sqrt(fmax(size, 1)) * (double)one.r /
                        scale *
                        (1 + between(-1, 1) * ldexp(1, -random_in(4, 30)));
            }
            size = fmax(fabs(v[0]), fmax(fabs(v[1]), fabs(v[2])));
            size = 536870912.0 / fmax(size, 1);
            ray.direction = ql_vec_to_dir(vec((int32_t)(v[0] * size),
                    (int32_t)(v[1] * size), (int32_t)(v[2] * size)));
        } else if (i / 4 % 4 == 3) { /* along an axis */
            ray.direction = vec(0, 0, 0);
            *(i & 16         ? &ray.direction.x
                    : i & 32 ? &ray.direction.y
                             : &ray.direction.z) =
                    (i & 64 ? 1 : -1) * (int32_t)(1l << QL_DIR_BITS);
        }
    } while (is_zero(ray.direction));
    return ray;
}

static bool ends_in_box(const ql_ray_t *ray, ql_uq30_t t)
{
    const double at = ldexp(t, -30), max = QL_GRID_MAX * ONE + 1;
    const int32_t o[3] = {ray->origin.x, ray->origin.y, ray->origin.z};
    const int32_t d[3] = {ray->direction.x, ray->direction.y, ray->direction.z};

    for (int k = 0; k < 3; k++) {
        const double p = o[k] + at * d[k];

        if (p < -1 || p > max) {
            return false;
        }
    }
    return true;
}

/* Compare with a sphere whose radius is wrong by so much; returns how many rays
 * disagree. */
static long disagreements(int64_t wrong)
{
    unsigned long hits = 0, inside = 0, close = 0, lost = 0;
    double worst = 0;
    long wrongly = 0;

    state = 2;
    for (long i = 0; i < RAYS; i++) {
        ql_uq30_t t = 0;
        ql_ray_t ray;
        exact_t e;
        int got, want;
        double off, bound, slope;

        random_sphere();
        ray = random_ray(i);
        e = exact_of(&ray, one.r + wrong);
        got = ql_sphere_hit(&one.sphere, &ray, &t);
        want = expected(&e);
        close += e.side > 0 && e.way < 0 && is_close(&e);
        if (got != want) {
            lost += got == 0 && want == 1 && is_close(&e);
            wrongly += !(got == 0 && want == 1 && is_close(&e));
            continue;
        }
        if (got == 0) {
            continue;
        }
        hits++;
        inside += got < 0;
        off = fabs(off_sphere(&e, t));
        bound = ldexp(t, -30) * sqrt((double)e.size) * ROUND_BOUND +
                ldexp(sqrt((double)e.size), -30) +
                (got > 0 ? (double)one.r * RADIUS_BOUND : 0);
        /* the first of two roots from outside, the second from inside */
        slope = (double)e.way + ldexp(t, -30) * (double)e.size;
        worst = fmax(worst, off / bound);
        wrongly += off > bound || !ends_in_box(&ray, t) ||
                   (double)got * slope >
                           sqrt((double)e.size) * (double)one.r / 4096;
    }
    NOTE("%lu hits, %lu inside, %lu close, %lu lost, %.2f of bound", hits,
            inside, close, lost, worst);
    return wrongly;
}

TEST(hits_are_on_the_sphere_and_misses_are_misses)
{
    const long wrongly = disagreements(0);

    CHECK(wrongly == 0, "%ld of %d rays disagree", wrongly, RAYS);
}

TEST(a_radius_wrong_by_a_256th_is_detected)
{
    const long larger = disagreements(1), smaller = disagreements(-1);

    CHECK(larger > 1000 && smaller > 1000, "only %ld and %ld rays disagree",
            larger, smaller);
    NOTE("%ld and %ld of %d rays disagree", larger, smaller, RAYS);
}

/* A ray that begins exactly on the sphere leaves it, or crosses it once. */
TEST(a_ray_from_the_sphere_itself_crosses_it_or_leaves)
{
    unsigned long crossed = 0;

    state = 3;
    for (long i = 0; i < RAYS; i++) {
        const int32_t r = random_in(1, 5000) * 256;
        ql_uq30_t t = 0;
        ql_ray_t ray;
        exact_t e;
        int got;

        ray.origin = vec(8192 * ONE, 16000 * ONE, 20000 * ONE);
        set_sphere(8192 * 256 + (i & 1 ? 2 * r / 3 * 3 : 2 * r),
                16000 * 256 - (i & 1 ? 0 : r),
                20000 * 256 + (i & 1 ? 0 : 2 * r),
                i & 1 ? 2 * r / 3 * 3 : 3 * r);
        if (one.c[0] + one.r > HIGH * 256 || one.c[1] - one.r < LOW * 256 ||
                one.c[1] + one.r > HIGH * 256 ||
                one.c[2] + one.r > HIGH * 256 || one.c[0] < one.r) {
            continue;
        }
        ray.direction = random_direction();
        e = exact_of(&ray, one.r);
        got = ql_sphere_hit(&one.sphere, &ray, &t);
        crossed += got != 0;
        CHECK(e.side == 0 && got == (e.way < 0 ? -1 : 0),
                "ray %ld, radius %ld: side %lld, B %lld: %d", i, (long)one.r,
                (long long)e.side, (long long)e.way, got);
        CHECK(got == 0 || fabs(off_sphere(&e, t)) <=
                                  sqrt((double)e.size) *
                                          (ldexp(1, -30) + ROUND_BOUND * 4),
                "ray %ld: off by %.3g", i, off_sphere(&e, t));
    }
    CHECK(crossed > 1000, "only %lu cross", crossed);
    NOTE("%lu cross", crossed);
}

/* ---- Surfaces ---------------------------------------------------------- */

/* A hit seen from the side wanted. */
static void random_hit(ql_ray_t *ray, ql_hit_t *hit, bool outside)
{
    do {
        random_sphere();
        for (int tries = 0; tries < 20; tries++) {
            *ray = random_ray((long)random_in(0, 1 << 20));
            if (ql_bvh_closest_hit(&one.scene, ray, hit) &&
                    hit->front == outside) {
                return;
            }
        }
    } while (true);
}

static int64_t side_of(ql_vec3_t p)
{
    return ql_sphere_side(&one.sphere, ql_sphere_offset(&one.sphere, p));
}

static int32_t steps_between(ql_vec3_t a, ql_vec3_t b)
{
    return (int32_t)(ql_abs32(a.x - b.x) + ql_abs32(a.y - b.y) +
                     ql_abs32(a.z - b.z));
}

/* Where the ray gets to, cut towards its origin. */
static ql_vec3_t cut_point(const ql_ray_t *ray, ql_uq30_t t)
{
    const int64_t one_t = (int64_t)1 << 30;

    return vec(ray->origin.x + (int32_t)((int64_t)ray->direction.x * t / one_t),
            ray->origin.y + (int32_t)((int64_t)ray->direction.y * t / one_t),
            ray->origin.z + (int32_t)((int64_t)ray->direction.z * t / one_t));
}

/* 1/|n| as it is packed, times |n|, less 1. */
static double inverse_error(uint64_t square, uint32_t packed)
{
    return ldexp(packed & ~31u, -31 - (int)(packed & 31u)) *
                   sqrt((double)square) -
           1;
}

/* All five bits are cut of a mantissa that is the least, just below a power of
 * two, with the errors of root and reciprocal. The worst of every square up to
 * 4,000,000, of every mantissa of 32 bits in the tenth below a power of four,
 * and of every sixteenth elsewhere, other bits set; in both precisions. */
TEST(packed_inverses_are_within_their_bound_at_worst)
{
    static const uint64_t worst[] = {
            1045683, 1224950958019051520u, 1163011258958479360u};
    double least = 0, most = 0;

    for (unsigned i = 0; i < 3; i++) {
        const double error =
                inverse_error(worst[i], ql_vec_unit_pack_inv_n(worst[i]));

        least = fmin(least, error);
        most = fmax(most, error);
    }
    CHECK(least >= -INVERSE_BOUND && most <= ldexp(1, -28), "%.4g, %.4g", least,
            most);
    CHECK(least < -ldexp(1, -26), "%.4g: a square worse than any is not",
            least);
    NOTE("%.4f 2^-26 to %.2f 2^-28", ldexp(least, 26), ldexp(most, 28));
}

TEST(points_are_strictly_on_the_side_they_were_seen_from)
{
    unsigned long steps[QL_SIDE_STEPS_MAX + 1] = {0}, wrong = 0;
    double worst = 0;

    state = 4;
    for (long i = 0; i < RAYS / 2; i++) {
        const bool outside = i % 2 == 0;
        ql_surface_t surface;
        ql_vec3_t s, cut;
        ql_ray_t ray;
        ql_hit_t hit;
        int32_t moved;
        double error;

        random_hit(&ray, &hit, outside);
        ql_surface_at(&one.scene, &ray, &hit, &surface);
        cut = cut_point(&ray, hit.t);
        s = ql_sphere_offset(&one.sphere, surface.p);
        moved = steps_between(cut, surface.p);
        wrong += outside ? side_of(cut) <= 0 : side_of(cut) >= 0;
        CHECK(outside ? side_of(surface.p) > 0 : side_of(surface.p) < 0,
                "hit %ld, radius %ld: side %lld", i, (long)one.r,
                (long long)side_of(surface.p));
        CHECK(moved <= STEPS_MAX, "hit %ld, radius %ld: %ld steps", i,
                (long)one.r, (long)moved);
        steps[moved <= QL_SIDE_STEPS_MAX ? moved : QL_SIDE_STEPS_MAX]++;
        CHECK(outside ? surface.n.x == s.x && surface.n.y == s.y &&
                                surface.n.z == s.z
                      : surface.n.x == -s.x && surface.n.y == -s.y &&
                                surface.n.z == -s.z,
                "hit %ld: the normal is not the offset", i);
        if (is_zero(surface.n)) {
            CHECK(surface.inv_n == 0, "of the centre: %08lx",
                    (unsigned long)surface.inv_n);
            continue;
        }
        error = inverse_error(
                (uint64_t)ql_vec_dot(surface.n, surface.n), surface.inv_n);
        worst = fmax(worst, fabs(error));
        CHECK(fabs(error) <= INVERSE_BOUND && error < ldexp(1, -28),
                "hit %ld: 1/|n| is off by %.3g", i, error);
#if QL_CFG_SMOOTH
        CHECK(!surface.smooth, "hit %ld: a sphere with corner normals", i);
#endif
    }
    CHECK(wrong > 100, "without steps only %lu are on the wrong side", wrong);
    NOTE("steps 0: %lu, 1: %lu, 2: %lu; 1/|n| within %.1e", steps[0], steps[1],
            steps[2], worst);
}

#if QL_CFG_GLASS
TEST(points_cross_to_the_other_side_strictly)
{
    unsigned long steps[2 * QL_SIDE_STEPS_MAX + 1] = {0};

    state = 5;
    for (long i = 0; i < RAYS / 2; i++) {
        const bool outside = i % 2 == 0;
        ql_surface_t surface;
        ql_vec3_t p;
        ql_ray_t ray;
        ql_hit_t hit;

        random_hit(&ray, &hit, outside);
        ql_surface_at(&one.scene, &ray, &hit, &surface);
        ql_surface_cross(&one.scene, hit.tri_idx, &surface, &p);
        CHECK(outside ? side_of(p) < 0 : side_of(p) > 0,
                "hit %ld, radius %ld: side %lld", i, (long)one.r,
                (long long)side_of(p));
        steps[steps_between(p, surface.p)]++;
    }
    NOTE("steps 1: %lu, 2: %lu, 3: %lu, 4: %lu", steps[1], steps[2], steps[3],
            steps[4]);
}
#endif

TEST(no_ray_meets_the_sphere_it_left)
{
    unsigned long again = 0, rays = 0;

    state = 6;
    for (long i = 0; i < SPHERES; i++) {
        ql_surface_t surface;
        ql_ray_t ray;
        ql_hit_t hit;

        random_hit(&ray, &hit, true);
        ql_surface_at(&one.scene, &ray, &hit, &surface);
        ray.origin = surface.p;
        for (long k = 0; k < DIRECTIONS; k++) {
            ray.direction = random_direction();
            if (ql_vec_dot(ray.direction, surface.n) > 0) {
                rays++;
                again += ql_bvh_closest_hit(&one.scene, &ray, &hit);
            }
        }
    }
    CHECK(again == 0, "%lu of %lu meet it again", again, rays);
    NOTE("%lu rays from %d spheres", rays, SPHERES);
}

TEST(every_ray_from_inside_meets_the_sphere_once)
{
    unsigned long lost = 0;

    state = 7;
    for (long i = 0; i < SPHERES; i++) {
        ql_surface_t surface;
        ql_ray_t ray;
        ql_hit_t hit;

        random_hit(&ray, &hit, false);
        ql_surface_at(&one.scene, &ray, &hit, &surface);
        ray.origin = surface.p;
        for (long k = 0; k < DIRECTIONS; k++) {
            ray.direction = random_direction();
            if (!ql_bvh_closest_hit(&one.scene, &ray, &hit) || hit.front) {
                lost++;
            }
        }
    }
    CHECK(lost == 0, "%lu of %d are lost", lost, SPHERES * DIRECTIONS);
    NOTE("%d rays from %d spheres", SPHERES * DIRECTIONS, SPHERES);
}

/* ---- Segments ---------------------------------------------------------- */

static ql_vec3_t segment_end(long i)
{
    switch (i % 4) {
    case 0:
        return random_position();
    case 1:
        return beside_surface(random_in(-2, 2) * UNIT);
    case 2:
        return beside_surface(-(double)one.r * between(0, 1));
    default:
        return beside_surface(ldexp(1, random_in(0, 20)));
    }
}

TEST(segments_are_blocked_exactly_where_they_cross)
{
    unsigned long blocked = 0, lost = 0;

    state = 8;
    for (long i = 0; i < RAYS; i++) {
        ql_ray_t segment;
        exact_t e;
        bool got, want;

        random_sphere();
        segment.origin = segment_end(i / 4);
        segment.direction = ql_vec_sub(segment_end(i), segment.origin);
        e = exact_of(&segment, one.r);
        got = ql_sphere_blocks(&one.sphere, &segment);
        want = expected_block(&e);
        blocked += got;
        lost += got != want;
        CHECK(got == want || (!got && e.side > 0 &&
                                     e.side + 2 * e.way + e.size > 0 &&
                                     is_close(&e)),
                "segment %ld, radius %ld: C %lld, B %lld, D %lld: %d", i,
                (long)one.r, (long long)e.side, (long long)e.way,
                (long long)e.size, got);
    }
    NOTE("%d segments, %lu blocked, %lu lost at the rim", RAYS, blocked, lost);
}

/* Its six points on the axes lie exactly on it. */
TEST(chords_between_points_of_a_sphere_are_free)
{
    const int32_t centre = 10000 * ONE, r = 700 * ONE;
    ql_vec3_t end[6];

    set_sphere(10000 * 256, 10000 * 256, 10000 * 256, 700 * 256);
    for (int i = 0; i < 6; i++) {
        const int32_t by = i % 2 ? -r : r;

        end[i] = vec(centre + (i / 2 == 0 ? by : 0),
                centre + (i / 2 == 1 ? by : 0), centre + (i / 2 == 2 ? by : 0));
    }
    for (int i = 0; i < 36; i++) {
        const ql_ray_t chord = {end[i / 6], ql_vec_sub(end[i % 6], end[i / 6])};

        CHECK(!ql_sphere_blocks(&one.sphere, &chord), "%d to %d", i / 6, i % 6);
    }
}

/* Where a direction towards a sphere ends: on it, at the side that is seen from
 * outside, ahead from inside. */
TEST(segments_towards_a_sphere_end_on_the_side_that_is_seen)
{
    double worst = 0;

    state = 12;
    one.scene.two_sided = true;
    for (long i = 0; i < 20000; i++) {
        ql_surface_t surface;
        ql_emit_sample_t sample;
        ql_uniform2_t u;
        double to[3], way = 0, facing = 0, square = 0;

        random_sphere();
        ql_smooth_none(&surface);
        surface.p = random_position();
        surface.n = vec(random_in(-9999, 9999), random_in(-9999, 9999),
                random_in(-9999, 9999));
        surface.inv_n = ql_vec_unit_pack_inv_n(
                (uint64_t)ql_vec_dot(surface.n, surface.n));
        u.u1 = (uint32_t)stats_random(&state);
        u.u2 = (uint32_t)stats_random(&state);
        if (surface.inv_n == 0 ||
                !ql_emit_sphere_sample(&one.scene, QL_DIRECT_SOLID_ANGLE,
                        &one.sphere, &surface, u, &sample)) {
            continue;
        }
        to[0] = sample.to.x;
        to[1] = sample.to.y;
        to[2] = sample.to.z;
        for (int k = 0; k < 3; k++) {
            const double c = (double)one.c[k] / UNIT;
            const double p = k == 0   ? surface.p.x
                             : k == 1 ? surface.p.y
                                      : surface.p.z;

            square += (to[k] - c) * (to[k] - c);
            facing += (to[k] - c) * (to[k] - p);
            way += (to[k] - p) * (to[k] - p);
        }
        /* a unit of rounding on each axis, and what a grazing ray loses */
        if (ql_sphere_side(&one.sphere,
                    ql_sphere_offset(&one.sphere, surface.p)) > 0) {
            CHECK(facing <= 4 * sqrt(way) + 2e-4 * way, "far side: %g of %g",
                    facing, way);
        } else {
            CHECK(facing >= -4 * sqrt(way), "near side from inside: %g",
                    facing);
        }
        square = sqrt(square) - (double)one.r / UNIT;
        worst = fmax(worst, fabs(square) / (4 + 1e-4 * sqrt(way)));
    }
    one.scene.two_sided = false;
    CHECK(worst < 1, "%.3g of what is allowed off the sphere", worst);
    NOTE("worst %.3g", worst);
}

/* A shadow segment to a point of a sphere that faces its origin: not blocked by
 * the sphere itself, whatever the rounding. */
TEST(segments_between_points_stepped_off_the_sphere_are_free)
{
    unsigned long facing = 0;

    state = 9;
    for (long i = 0; i < RAYS / 2; i++) {
        ql_surface_t surface;
        ql_ray_t ray, segment;
        ql_hit_t hit;

        random_hit(&ray, &hit, i % 2 == 0);
        ql_surface_at(&one.scene, &ray, &hit, &surface);
        if (i % 2 == 0) {
            segment.origin = random_position();
            segment.direction = ql_vec_sub(surface.p, segment.origin);
            if (side_of(segment.origin) <= 0 ||
                    ql_vec_dot(segment.direction, surface.n) >= 0) {
                continue; /* it arrives from behind */
            }
        } else {
            segment.origin = beside_surface(-(double)one.r * between(0, 1));
            segment.direction = ql_vec_sub(surface.p, segment.origin);
            if (side_of(segment.origin) >= 0) {
                continue;
            }
        }
        facing++;
        CHECK(!ql_bvh_occluded(&one.scene, &segment),
                "segment %ld, radius %ld: blocked", i, (long)one.r);
        segment.origin = surface.p;
        segment.direction = vec(-segment.direction.x, -segment.direction.y,
                -segment.direction.z);
        CHECK(!ql_bvh_occluded(&one.scene, &segment),
                "segment %ld, radius %ld: blocked on the way back", i,
                (long)one.r);
    }
    CHECK(facing > RAYS / 8, "only %lu", facing);
    NOTE("%lu segments, both ways", facing);
}

/* ---- The tree ---------------------------------------------------------- */

static mini_scene_t mini;

/* as many as a tree no deeper than the core's stack can hold */
enum { BALLS = QL_CFG_BVH_STACK < 8 ? 100 : 300 };

/* Spheres of all sizes, some of them touching, and triangles between them. */
static void build_balls(unsigned node_bits, ql_scene_t *scene)
{
    uint16_t white;

    mini_begin(&mini);
    mini.node_bits = node_bits;
    white = mini_material(&mini, 0.5, 0);
    state = 10;
    for (int i = 0; i < BALLS; i++) {
        int32_t c[3];

        random_sphere();
        while (one.r > 3000 * 256) {
            random_sphere();
        }
        for (int k = 0; k < 3; k++) {
            c[k] = (int32_t)one.c[k];
        }
        (void)mini_sphere(&mini, c, (int32_t)one.r, white);
        if (i % 2) {
            int32_t v[3][3];

            for (int k = 0; k < 9; k++) {
                v[k / 3][k % 3] = random_in(LOW, HIGH);
            }
            mini_triangle(&mini, v[0], v[1], v[2], white);
        }
    }
    mini_open(&mini, scene);
}

/* All entries by leaves of 13, without a single box. */
static bool brute_closest(
        const ql_scene_t *scene, const ql_ray_t *ray, ql_hit_t *hit)
{
    ql_scene_t leaf = *scene;
    bool any = false;

    for (unsigned i = 0; i < mini.triangle_count; i += QL_LEAF_MAX) {
        const unsigned left = mini.triangle_count - i;
        ql_hit_t h;

        leaf.root_link = (uint16_t)i;
        leaf.root_meta =
                (uint8_t)(3 + (left < QL_LEAF_MAX ? left : QL_LEAF_MAX));
        if (ql_bvh_closest_hit(&leaf, ray, &h) && (!any || h.t < hit->t)) {
            *hit = h;
            any = true;
        }
    }
    return any;
}

static bool brute_occluded(const ql_scene_t *scene, const ql_ray_t *ray)
{
    ql_scene_t leaf = *scene;

    for (unsigned i = 0; i < mini.triangle_count; i++) {
        leaf.root_link = (uint16_t)i;
        leaf.root_meta = 4;
        if (ql_bvh_occluded(&leaf, ray)) {
            return true;
        }
    }
    return false;
}

TEST(spheres_and_triangles_in_a_tree_equal_brute_force)
{
    unsigned long hits = 0, balls = 0, blocked = 0;

    for (unsigned bits = MINI_BITS_MIN; bits <= MINI_BITS_MAX; bits += 8) {
        ql_scene_t scene;

        build_balls(bits, &scene);
        for (long i = 0; i < MANY(20000); i++) {
            const unsigned s = (unsigned)random_in(0, BALLS - 1);
            ql_hit_t hit, brute = {.tri_idx = 0};
            ql_ray_t ray;
            bool got, want;

            set_sphere((int64_t)mini.spheres[s].centre[0],
                    (int64_t)mini.spheres[s].centre[1],
                    (int64_t)mini.spheres[s].centre[2],
                    (int64_t)mini.spheres[s].radius);
            ray = random_ray(i);
            got = ql_bvh_closest_hit(&scene, &ray, &hit);
            want = brute_closest(&scene, &ray, &brute);
            hits += got;
            balls += got && scene.triangles[hit.tri_idx].inv_n == 0;
            CHECK(got == want && (!got || (hit.tri_idx == brute.tri_idx &&
                                                  hit.t == brute.t &&
                                                  hit.front == brute.front)),
                    "%u bits, ray %ld: %d entry %u t %08lx, brute force %d "
                    "entry %u t %08lx",
                    bits, i, got, hit.tri_idx, (unsigned long)hit.t, want,
                    brute.tri_idx, (unsigned long)brute.t);
            ray.direction = ql_vec_sub(segment_end(i), ray.origin);
            got = ql_bvh_occluded(&scene, &ray);
            want = brute_occluded(&scene, &ray);
            blocked += got;
            CHECK(got == want, "%u bits, segment %ld: %d", bits, i, got);
        }
    }
    CHECK(balls > MANY(5000), "only %lu hits of spheres", balls);
    NOTE("%lu hits, %lu of spheres; %lu blocked", hits, balls, blocked);
}

#else

TEST(a_build_without_spheres_takes_no_entry_for_one)
{
    ql_scene_t scene;
    ql_blob_tri_t entry;

    memset(&scene, 0, sizeof scene);
    memset(&entry, 0, sizeof entry);
    CHECK(ql_scene_sphere(&scene, &entry) == NULL, "a sphere");
}

#endif

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_sphere", argc, argv);
#if QL_CFG_SPHERES
    RUN(offsets_and_sides_are_exact);
    RUN(hits_are_on_the_sphere_and_misses_are_misses);
    RUN(a_radius_wrong_by_a_256th_is_detected);
    RUN(a_ray_from_the_sphere_itself_crosses_it_or_leaves);
    RUN(packed_inverses_are_within_their_bound_at_worst);
    RUN(points_are_strictly_on_the_side_they_were_seen_from);
#if QL_CFG_GLASS
    RUN(points_cross_to_the_other_side_strictly);
#endif
    RUN(no_ray_meets_the_sphere_it_left);
    RUN(every_ray_from_inside_meets_the_sphere_once);
    RUN(segments_are_blocked_exactly_where_they_cross);
    RUN(chords_between_points_of_a_sphere_are_free);
    RUN_IF(TABLES_EXACT,
            segments_towards_a_sphere_end_on_the_side_that_is_seen);
    RUN(segments_between_points_stepped_off_the_sphere_are_free);
    RUN(spheres_and_triangles_in_a_tree_equal_brute_force);
#else
    RUN(a_build_without_spheres_takes_no_entry_for_one);
#endif
    return TEST_END();
}
