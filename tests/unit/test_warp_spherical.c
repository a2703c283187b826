/* test_warp_spherical.c - spherical triangles: area, directions, uniformity */
/* SPDX-License-Identifier: MIT */

#include <math.h>

#include "support/ql_stats.h"
#include "support/ql_test.h"
#include "warp/ql_warp_plane.h"
#include "warp/ql_warp_spherical.h"

#define AREA_ERROR 1e-8 /* relative */
#define SIDE_ERROR 1e-8 /* of a component, and of the length */
#define U1_ERROR   0x1p-27L

enum {
    ROWS = 16,
    COLUMNS = 32,
    BINS = ROWS * COLUMNS,
    SAMPLES = MANY(1 << 18),
    COMPONENT_MAX = (1 << 24) - 1
};

static const long double pi = 3.14159265358979323846264338327950288L;

/* ---- Vectors, and the triangle without integers ------------------------- */

typedef struct {
    long double x, y, z;
} point_t;

typedef struct {
    point_t a, b, c; /* unit */
    long double area;
} triangle_t;

typedef struct {
    ql_vec3_t a, b, c;
} corners_t;

static uint64_t state;

static ql_vec3_t vec(int32_t x, int32_t y, int32_t z)
{
    const ql_vec3_t v = {x, y, z};

    return v;
}

static corners_t corners(ql_vec3_t a, ql_vec3_t b, ql_vec3_t c)
{
    const corners_t r = {a, b, c};

    return r;
}

static point_t point(long double x, long double y, long double z)
{
    const point_t p = {x, y, z};

    return p;
}

static point_t sum(point_t a, long double s, point_t b, long double t)
{
    return point(s * a.x + t * b.x, s * a.y + t * b.y, s * a.z + t * b.z);
}

static long double dot(point_t a, point_t b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static point_t cross(point_t a, point_t b)
{
    return point(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
            a.x * b.y - a.y * b.x);
}

static point_t unit(point_t a)
{
    return sum(a, 1 / sqrtl(dot(a, a)), a, 0);
}

/* The largest component's. */
static long double distance(point_t a, point_t b)
{
    return fmaxl(fmaxl(fabsl(a.x - b.x), fabsl(a.y - b.y)), fabsl(a.z - b.z));
}

static long double arc(point_t a, point_t b)
{
    const point_t n = cross(a, b);

    return atan2l(sqrtl(dot(n, n)), dot(a, b));
}

static point_t from_int(ql_vec3_t v)
{
    return point(v.x, v.y, v.z);
}

static point_t from_q29(ql_vec3_t v)
{
    return point(ldexpl(v.x, -29), ldexpl(v.y, -29), ldexpl(v.z, -29));
}

/* Van Oosterom and Strackee, as written. */
static long double area_of(point_t a, point_t b, point_t c)
{
    return 2 * atan2l(fabsl(dot(a, cross(b, c))),
                       1 + dot(a, b) + dot(b, c) + dot(c, a));
}

/* The exact triple product first: unit vectors are rounded. */
static long double area_of_corners(corners_t k)
{
    const point_t a = from_int(k.a), b = from_int(k.b), c = from_int(k.c);
    const long double la = sqrtl(dot(a, a)), lb = sqrtl(dot(b, b)),
                      lc = sqrtl(dot(c, c));
    const long double det = dot(a, cross(sum(b, 1, a, -1), sum(c, 1, a, -1)));

    return 2 * atan2l(fabsl(det), la * lb * lc + dot(a, b) * lc +
                                          dot(b, c) * la + dot(c, a) * lb);
}

/* The end of the arc from b that cuts off the share u1 of the area: Arvo's
 * algorithm in his own terms, which cancel where little is cut off. */
static point_t arvo_end(const triangle_t *t, long double u1)
{
    const point_t n_ab = unit(cross(t->a, t->b));
    const point_t n_ac = unit(cross(t->a, t->c));
    const point_t n = cross(n_ab, n_ac);
    const long double cos_alpha = dot(n_ab, n_ac);
    const long double sin_alpha = sqrtl(dot(n, n));
    const long double alpha = atan2l(sin_alpha, cos_alpha);
    const long double s = sinl(u1 * t->area - alpha);
    const long double c = cosl(u1 * t->area - alpha);
    const long double u = c - cos_alpha;
    const long double v = s + sin_alpha * dot(t->a, t->b);
    long double q =
            ((v * c - u * s) * cos_alpha - v) / ((v * s + u * c) * sin_alpha);

    q = fminl(fmaxl(q, -1), 1);
    return sum(t->a, q, unit(sum(t->c, 1, t->a, -dot(t->a, t->c))),
            sqrtl(1 - q * q));
}

/* The same by half angles. */
static point_t half_angle_end(const triangle_t *t, long double u1)
{
    const point_t n_ab = cross(t->a, t->b), n_ac = cross(t->a, t->c);
    const point_t n = cross(n_ab, n_ac);
    const long double alpha = atan2l(sqrtl(dot(n, n)), dot(n_ab, n_ac));
    const long double y = u1 * t->area / 2;
    const long double x =
            2 * atan2l(sinl(y), tanl(arc(t->a, t->b) / 2) * sinl(alpha - y));
    const point_t across = cross(n_ac, t->a);

    return sum(t->a, cosl(x), unit(across), sinl(x));
}

/* From b towards the end, 1 - cos a share u2 of the whole. */
static point_t along(const triangle_t *t, point_t end, long double u2)
{
    const point_t chord = sum(end, 1, t->b, -1), n = cross(t->b, end);
    const long double s2 = u2 * dot(chord, chord) / 4;

    return sum(
            t->b, 1 - 2 * s2, unit(cross(n, t->b)), 2 * sqrtl(s2 * (1 - s2)));
}

/* What u1 and u2 a direction comes from. */
static void inverse(
        const triangle_t *t, point_t w, long double *u1, long double *u2)
{
    const point_t side = cross(t->c, t->a);
    point_t end = unit(cross(cross(t->b, w), side));

    if (dot(end, sum(t->a, 1, t->c, 1)) < 0) {
        end = sum(end, -1, end, 0);
    }
    *u1 = area_of(t->a, t->b, end) / t->area;
    *u2 = (1 - dot(w, t->b)) / (1 - dot(end, t->b));
}

/* How far beyond the plane of an edge a direction is. */
static long double outside_by(const triangle_t *t, point_t w)
{
    const long double sign = dot(t->a, cross(t->b, t->c)) < 0 ? -1 : 1;
    long double inside = dot(w, unit(cross(t->a, t->b))) * sign;

    inside = fminl(inside, dot(w, unit(cross(t->b, t->c))) * sign);
    return -fminl(inside, dot(w, unit(cross(t->c, t->a))) * sign);
}

/* ---- Triangles to try ---------------------------------------------------- */

static int32_t random_in(int32_t most)
{
    return (int32_t)stats_random_below(&state, 2 * (uint64_t)most + 1) - most;
}

static ql_vec3_t random_vec(int32_t most)
{
    return vec(random_in(most), random_in(most), random_in(most));
}

static ql_vec3_t plus(ql_vec3_t a, ql_vec3_t b)
{
    return vec(a.x + b.x, a.y + b.y, a.z + b.z);
}

/* Of a size from the whole box down to a few units. */
static int32_t random_size(int least)
{
    return COMPONENT_MAX >> stats_random_below(&state, (uint64_t)least);
}

enum { GENERIC, SMALL, SLIVER, ABOVE, AT_EDGE, DISTANT, KINDS };

static corners_t random_corners(int kind)
{
    const int32_t size = random_size(18);
    corners_t k = corners(random_vec(size), random_vec(size), random_vec(size));
    const ql_vec3_t far = random_vec(COMPONENT_MAX / 2);
    const int32_t tiny = random_size(24);

    switch (kind) {
    case SMALL: /* one or two degrees */
        k.a = far;
        k.b = plus(far, random_vec(COMPONENT_MAX / 30));
        k.c = plus(far, random_vec(COMPONENT_MAX / 30));
        break;
    case SLIVER: /* c beside the line through a and b */
        k.c = plus(vec(k.a.x / 3 + k.b.x / 3 * 2, k.a.y / 3 + k.b.y / 3 * 2,
                           k.a.z / 3 + k.b.z / 3 * 2),
                random_vec(size / 200 + 1));
        break;
    case ABOVE: /* under a roof: up to 2 pi */
        k = corners(vec(random_in(size), random_in(size), tiny),
                vec(random_in(size), random_in(size), tiny),
                vec(random_in(size), random_in(size), tiny));
        break;
    case AT_EDGE: /* a and b nearly opposite each other */
        k.b = vec(-(k.a.x - k.a.x / 8), -(k.a.y - k.a.y / 8),
                -(k.a.z - k.a.z / 8));
        k.b = plus(k.b, random_vec(tiny / 8 + 1));
        break;
    case DISTANT:
        k.c = plus(far, random_vec(COMPONENT_MAX / 2));
        break;
    default:
        break;
    }
    return k;
}

/* The corners as ql_warp_spherical_begin() has named them. */
static triangle_t named(const ql_warp_spherical_t *t, corners_t k)
{
    const point_t p[3] = {
            unit(from_int(k.a)), unit(from_int(k.b)), unit(from_int(k.c))};
    triangle_t r = {p[0], p[1], p[2], area_of_corners(k)};

    for (int i = 0; i < 3; i++) {
        const point_t a = from_q29(t->a), b = from_q29(t->b);

        if (dot(p[i], a) + dot(p[(i + 1) % 3], b) > dot(r.a, a) + dot(r.b, b)) {
            r.a = p[i];
            r.b = p[(i + 1) % 3];
            r.c = p[(i + 2) % 3];
        }
    }
    return r;
}

#define SHOW_CORNERS "(%ld %ld %ld) (%ld %ld %ld) (%ld %ld %ld)"
#define SHOWN(k)                                                               \
    (long)(k).a.x, (long)(k).a.y, (long)(k).a.z, (long)(k).b.x, (long)(k).b.y, \
            (long)(k).b.z, (long)(k).c.x, (long)(k).c.y, (long)(k).c.z

static long double solid_angle(const ql_warp_spherical_t *t)
{
    return ldexpl(t->solid_angle.m, t->solid_angle.e);
}

/* ---- The solid angle ----------------------------------------------------- */

TEST(solid_angles_are_within_their_error_between_the_thresholds)
{
    long double worst = 0;
    unsigned long taken[KINDS] = {0};

    state = 1;
    for (long i = 0; i < MANY(200000); i++) {
        const int kind = (int)(i % KINDS);
        const corners_t k = random_corners(kind);
        const long double exact = area_of_corners(k);
        ql_warp_spherical_t t;
        const bool ok = ql_warp_spherical_begin(&t, k.a, k.b, k.c);

        if (ok) {
            const long double error = fabsl(solid_angle(&t) / exact - 1);

            worst = fmaxl(worst, error);
            CHECK(error <= AREA_ERROR, SHOW_CORNERS ": %.12Lg, not %.12Lg",
                    SHOWN(k), solid_angle(&t), exact);
            taken[kind]++;
        }
        CHECK(ok == (exact >= 3e-4L && exact <= 6.22L) ||
                        fabsl(exact / 3e-4L - 1) < AREA_ERROR ||
                        fabsl(exact / 6.22L - 1) < AREA_ERROR,
                SHOW_CORNERS ": %.12Lg %s", SHOWN(k), exact,
                ok ? "taken" : "refused");
    }
    for (int i = 0; i < KINDS; i++) {
        CHECK(taken[i] > 1000, "kind %d: %lu", i, taken[i]);
    }
    NOTE("worst %.2Le relative, bound %.0e", worst, AREA_ERROR);
}

/* The unit square above the origin at three heights, as two triangles. */
TEST(squares_have_the_solid_angles_of_their_closed_form)
{
    static const struct {
        int32_t z;
        double sr;
    } squares[] = {{10000, 0.8054316831613232}, {1000, 5.170198016240398},
            {100000, 0.009975072683099255}};

    for (int i = 0; i < 3; i++) {
        const int32_t h = 5000, z = squares[i].z;
        const ql_vec3_t k[4] = {
                vec(-h, -h, z), vec(h, -h, z), vec(h, h, z), vec(-h, h, z)};
        ql_warp_spherical_t s, t;
        double got;

        CHECK(ql_warp_spherical_begin(&s, k[0], k[1], k[2]) &&
                        ql_warp_spherical_begin(&t, k[0], k[2], k[3]),
                "z = %ld refused", (long)z);
        got = (double)(solid_angle(&s) + solid_angle(&t));
        CHECK(fabs(got / squares[i].sr - 1) < AREA_ERROR, "z = %ld: %.12g",
                (long)z, got);
    }
}

/* Heights of one triangle at which it crosses a threshold. */
static void check_threshold(int32_t side, long double limit)
{
    int32_t near = 1, far = COMPONENT_MAX;

    while (far - near > 1) {
        const int32_t z = near + (far - near) / 2;
        const corners_t k = corners(
                vec(side, 0, z), vec(-side, side, z), vec(-side, -side, z));

        if (area_of_corners(k) > limit) {
            near = z;
        } else {
            far = z;
        }
    }
    for (int32_t z = near - 2; z <= far + 2; z++) {
        const corners_t k = corners(
                vec(side, 0, z), vec(-side, side, z), vec(-side, -side, z));
        const long double exact = area_of_corners(k);
        ql_warp_spherical_t t;

        CHECK(ql_warp_spherical_begin(&t, k.a, k.b, k.c) ==
                        (exact >= 3e-4L && exact <= 6.22L),
                "side %ld, height %ld: %.12Lg", (long)side, (long)z, exact);
    }
}

TEST(both_sides_of_both_thresholds_are_told_apart)
{
    check_threshold(3000, 3e-4L);
    check_threshold(30000, 3e-4L);
    check_threshold(30000, 6.22L);
    check_threshold(300000, 6.22L);
}

TEST(triangles_that_are_seen_edge_on_are_refused)
{
    ql_warp_spherical_t t;

    state = 2;
    for (long i = 0; i < MANY(20000); i++) {
        const ql_vec3_t a = random_vec(2000), b = random_vec(2000);
        const int32_t s = random_in(2000), r = random_in(2000);
        const ql_vec3_t c = vec(s * a.x + r * b.x, s * a.y + r * b.y,
                s * a.z + r * b.z); /* through the origin */

        CHECK(!ql_warp_spherical_begin(&t, a, b, c) &&
                        !ql_warp_spherical_begin(&t, c, a, b) &&
                        !ql_warp_spherical_begin(&t, a, a, b) &&
                        !ql_warp_spherical_begin(&t, a, vec(0, 0, 0), b),
                SHOW_CORNERS, SHOWN(corners(a, b, c)));
    }
    CHECK(!ql_warp_spherical_begin(
                  &t, vec(0, 0, 0), vec(0, 0, 0), vec(0, 0, 0)),
            "nothing");
}

/* ---- Directions ---------------------------------------------------------- */

/* An octant by closed form, with sixteen-bit u: 1/4 and 1/2. */
TEST(an_octant_maps_as_its_closed_form)
{
    const int32_t r = 12345;
    ql_warp_spherical_t t;
    point_t w;
    long double worst = 0;

    CHECK(ql_warp_spherical_begin(&t, vec(r, 0, 0), vec(0, r, 0), vec(0, 0, r)),
            "refused");
    w = from_q29(ql_warp_spherical(&t, 0x3fffffffu, 0x7fffffffu));
    CHECK(fabsl(w.x - 0.80010315L) < SIDE_ERROR &&
                    fabsl(w.y - 0.5L) < SIDE_ERROR &&
                    fabsl(w.z - 0.33141357L) < SIDE_ERROR,
            "%.9Lf %.9Lf %.9Lf", w.x, w.y, w.z);
    state = 3;
    for (long i = 0; i < MANY(100000); i++) {
        const uint64_t bits = stats_random(&state);
        const uint32_t u1 = (uint32_t)bits, u2 = (uint32_t)(bits >> 32);
        const long double phi = ldexpl(u1 + 0.5L, -33) * pi / 2 * 2;
        const long double y = 1 - ldexpl(u2 + 0.5L, -32);
        const long double rho = sqrtl(1 - y * y);

        w = from_q29(ql_warp_spherical(&t, u1, u2));
        worst = fmaxl(worst, fabsl(w.x - rho * cosl(phi)));
        worst = fmaxl(
                worst, fmaxl(fabsl(w.y - y), fabsl(w.z - rho * sinl(phi))));
    }
    CHECK(worst <= SIDE_ERROR, "%.3Lg", worst);
    NOTE("worst %.2Le", worst);
}

static const uint32_t ends[] = {0, 1, 0x00010000u, 0x3fffffffu, 0x7fffffffu,
        0x80000000u, 0xc0000000u, 0xfffeffffu, 0xfffffffeu, 0xffffffffu};

enum { ENDS = sizeof ends / sizeof ends[0] };

static long double worst_share, worst_side, worst_length, worst_outside;

/* One direction: unit, inside, and where it should be. */
static void check_direction(const ql_warp_spherical_t *t,
        const triangle_t *exact, corners_t k, uint32_t u1, uint32_t u2)
{
    const ql_vec3_t v = ql_warp_spherical(t, u1, u2);
    const point_t w = from_q29(v);
    const long double u1_exact = ldexpl(u1 + 0.5L, -32);
    const long double u2_exact = ldexpl(u2 + 0.5L, -32);
    const long double moved =
            u1_exact + (u1_exact < 0.5L ? U1_ERROR : -U1_ERROR);
    const point_t end = half_angle_end(exact, u1_exact);
    const point_t should = along(exact, end, u2_exact);
    const long double error = distance(w, should);
    const long double length = fabsl(sqrtl(dot(w, w)) - 1);
    /* where the arc from b ends near -b, what is left of it guides the rest;
     * and a little of u1 may be a long way along a thin triangle */
    const long double bound =
            SIDE_ERROR /
                    (dot(exact->b, end) < 0 ? sinl(arc(exact->b, end)) : 1) +
            distance(should,
                    along(exact, half_angle_end(exact, moved), u2_exact));
    const long double outside = outside_by(exact, w);

    worst_side = fmaxl(worst_side, error);
    worst_share = fmaxl(worst_share, error / bound);
    worst_length = fmaxl(worst_length, length);
    worst_outside = fmaxl(worst_outside, outside);
    CHECK(error <= bound,
            SHOW_CORNERS " %.4Lg sr, u = %08lx %08lx: off by %.3Lg", SHOWN(k),
            exact->area, (unsigned long)u1, (unsigned long)u2, error);
    CHECK(length <= SIDE_ERROR && outside <= bound,
            SHOW_CORNERS ", u = %08lx %08lx: length off by %.3Lg, outside "
                         "by %.3Lg",
            SHOWN(k), (unsigned long)u1, (unsigned long)u2, length, outside);
}

TEST(directions_are_unit_inside_and_where_arvo_has_them)
{
    unsigned long taken = 0;

    state = 4;
    worst_share = worst_side = worst_length = worst_outside = 0;
    for (long i = 0; i < MANY(40000); i++) {
        const corners_t k = random_corners((int)(i % KINDS));
        ql_warp_spherical_t t;
        triangle_t exact;

        if (!ql_warp_spherical_begin(&t, k.a, k.b, k.c)) {
            continue;
        }
        exact = named(&t, k);
        for (int n = 0; n < 4; n++) {
            const uint64_t bits = stats_random(&state);

            check_direction(
                    &t, &exact, k, (uint32_t)bits, (uint32_t)(bits >> 32));
        }
        taken++;
    }
    NOTE("%lu: %.2Lf of bound, side %.1Le, length %.1Le, outside %.1Le", taken,
            worst_share, worst_side, worst_length, worst_outside);
}

TEST(corners_of_the_square_stay_inside_too)
{
    unsigned long taken = 0;

    state = 5;
    worst_share = worst_side = worst_length = worst_outside = 0;
    for (long i = 0; i < MANY(2000); i++) {
        const corners_t k = random_corners((int)(i % KINDS));
        ql_warp_spherical_t t;
        triangle_t exact;

        if (!ql_warp_spherical_begin(&t, k.a, k.b, k.c)) {
            continue;
        }
        exact = named(&t, k);
        for (int n = 0; n < ENDS * ENDS; n++) {
            check_direction(&t, &exact, k, ends[n % ENDS], ends[n / ENDS]);
        }
        taken++;
    }
    NOTE("%lu: %.2Lf of bound, side %.1Le, length %.1Le, outside %.1Le", taken,
            worst_share, worst_side, worst_length, worst_outside);
}

/* Half angles are an identity: the same point as Arvo's, where his formula has
 * digits left. */
TEST(half_angles_are_arvos_map)
{
    long double worst = 0, worst_area = 0;

    state = 6;
    for (long i = 0; i < 10000; i++) {
        const corners_t k = random_corners(i & 1 ? GENERIC : SMALL);
        const long double u1 = 0.02L + 0.96L * stats_random_unit(&state);
        ql_warp_spherical_t t;
        triangle_t exact;
        point_t end;

        if (ql_warp_spherical_begin(&t, k.a, k.b, k.c)) {
            exact = named(&t, k);
            end = half_angle_end(&exact, u1);
            worst = fmaxl(worst, distance(end, arvo_end(&exact, u1)));
            worst_area = fmaxl(worst_area,
                    fabsl(area_of(exact.a, exact.b, end) / exact.area - u1));
        }
    }
    CHECK(worst < 1e-8L && worst_area < 1e-10L, "%.3Lg, %.3Lg", worst,
            worst_area);
    NOTE("worst %.1Le, area %.1Le", worst, worst_area);
}

/* Names change only where an edge spans more than 120 degrees. */
TEST(corners_keep_their_names_unless_an_edge_is_longer_than_120_degrees)
{
    unsigned long kept = 0, moved = 0;

    state = 7;
    for (long i = 0; i < MANY(60000); i++) {
        const corners_t k = random_corners((int)(i % KINDS));
        const point_t a = unit(from_int(k.a)), b = unit(from_int(k.b)),
                      c = unit(from_int(k.c));
        const long double ab = dot(a, b), bc = dot(b, c), ca = dot(c, a);
        const long double least = fminl(ab, fminl(bc, ca));
        ql_warp_spherical_t t;
        point_t want;

        if (!ql_warp_spherical_begin(&t, k.a, k.b, k.c) ||
                fabsl(least + 0.5L) < 1e-7L ||
                (ab < least + 1e-7L) + (bc < least + 1e-7L) +
                                (ca < least + 1e-7L) >
                        1) { /* too close to call */
            continue;
        }
        want = least > -0.5L || ca == least ? a : ab == least ? b : c;
        CHECK(distance(want, from_q29(t.a)) < SIDE_ERROR, SHOW_CORNERS,
                SHOWN(k));
        *(least > -0.5L ? &kept : &moved) += 1;
    }
    CHECK(kept > 1000 && moved > 1000, "%lu, %lu", kept, moved);
    NOTE("%lu kept, %lu moved", kept, moved);
}

/* ---- The density --------------------------------------------------------- */

static const corners_t shapes[] = {
        {{9000, 0, 1000}, {-3000, 7000, 2000}, {-4000, -5000, 8000}},
        {{1000, 0, 50000}, {-300, 900, 51000}, {-900, -800, 49000}},
        {{700000, 100, 9000}, {-650000, 1000, 8000}, {1000, 90000, 10000}},
        {{50000, 0, 400}, {-25000, 43000, 500}, {-25000, -43000, 300}},
        {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

enum { SHAPES = sizeof shapes / sizeof shapes[0] };

typedef point_t (*map_t)(const ql_warp_spherical_t *t, const triangle_t *exact,
        corners_t k, uint32_t u1, uint32_t u2);

static point_t warp(const ql_warp_spherical_t *t, const triangle_t *exact,
        corners_t k, uint32_t u1, uint32_t u2)
{
    (void)exact;
    (void)k;
    return from_q29(ql_warp_spherical(t, u1, u2));
}

/* The fault: points uniform on the plane. */
static point_t plane(const ql_warp_spherical_t *t, const triangle_t *exact,
        corners_t k, uint32_t u1, uint32_t u2)
{
    uint32_t b1, b2;
    double v1, v2;

    (void)t;
    (void)exact;
    ql_warp_plane_triangle(u1, u2, &b1, &b2);
    v1 = ldexp(b1, -QL_BARY_BITS);
    v2 = ldexp(b2, -QL_BARY_BITS);
    return unit(sum(sum(from_int(k.a), 1 - v1 - v2, from_int(k.b), v1), 1,
            from_int(k.c), v2));
}

/* The fault: u1 a share of the edge instead of the area. */
static point_t even_edge(const ql_warp_spherical_t *t, const triangle_t *exact,
        corners_t k, uint32_t u1, uint32_t u2)
{
    const long double x = ldexpl(u1 + 0.5L, -32) * arc(exact->a, exact->c);
    const point_t across = unit(cross(cross(exact->a, exact->c), exact->a));

    (void)t;
    (void)k;
    return along(exact, sum(exact->a, cosl(x), across, sinl(x)),
            ldexpl(u2 + 0.5L, -32));
}

/* The fault: u2 a share of the arc's length. */
static point_t even_arc(const ql_warp_spherical_t *t, const triangle_t *exact,
        corners_t k, uint32_t u1, uint32_t u2)
{
    const point_t end = half_angle_end(exact, ldexpl(u1 + 0.5L, -32));
    const long double d = arc(exact->b, end) * ldexpl(u2 + 0.5L, -32);
    const long double s = sinl(d / 2), l = sinl(arc(exact->b, end) / 2);

    (void)t;
    (void)k;
    return along(exact, end, s * s / (l * l));
}

/* p-value of equal-probability bins; a direction outside is never right. By how
 * much it may be is a direction's error and that of u1 along an edge of up to
 * pi, as a length: next to a corner u1 and u2 may be off by any amount. */
static double chi2_p(map_t map, corners_t k)
{
    const long double limit = sqrtl(3) * (SIDE_ERROR + pi * U1_ERROR);
    static uint32_t counts[BINS];
    ql_warp_spherical_t t;
    triangle_t exact;

    CHECK(ql_warp_spherical_begin(&t, k.a, k.b, k.c), SHOW_CORNERS, SHOWN(k));
    exact = named(&t, k);
    memset(counts, 0, sizeof counts);
    state = 41;
    for (long i = 0; i < SAMPLES; i++) {
        const uint64_t bits = stats_random(&state);
        const point_t w =
                map(&t, &exact, k, (uint32_t)bits, (uint32_t)(bits >> 32));
        long double u1, u2;

        if (!(outside_by(&exact, w) <= limit)) {
            return 0;
        }
        inverse(&exact, w, &u1, &u2);
        counts[(int)fminl(fmaxl(u1 * ROWS, 0), ROWS - 1) * COLUMNS +
                (int)fminl(fmaxl(u2 * COLUMNS, 0), COLUMNS - 1)]++;
    }
    return stats_chi2_p(
            stats_chi2_equal(counts, BINS, (double)SAMPLES / BINS), BINS - 1);
}

TEST(directions_are_uniform_in_solid_angle)
{
    double least = 1;

    for (int i = 0; i < SHAPES; i++) {
        const double p = chi2_p(warp, shapes[i]);

        least = fmin(least, p);
        CHECK(p > STATS_P_MIN, "shape %d: p = %.3g", i, p);
    }
    NOTE("least p = %.3f of %d, %d bins", least, SHAPES, BINS);
}

TEST(points_uniform_on_the_plane_are_rejected)
{
    const double p = chi2_p(plane, shapes[0]);

    CHECK(p <= STATS_P_MIN, "p = %.3g", p);
    NOTE("p = %.1e", p);
}

TEST(an_edge_or_an_arc_divided_evenly_is_rejected)
{
    const double p = chi2_p(even_edge, shapes[0]);
    const double q = chi2_p(even_arc, shapes[0]);

    CHECK(p <= STATS_P_MIN && q <= STATS_P_MIN, "p = %.3g, %.3g", p, q);
    NOTE("p = %.1e, %.1e", p, q);
}

/* The integral of w: half the sum over the edges of their lengths times their
 * normals. */
static point_t exact_mean(const triangle_t *t)
{
    const point_t k[3] = {t->a, t->b, t->c};
    const long double sign = dot(t->a, cross(t->b, t->c)) < 0 ? -1 : 1;
    point_t mean = point(0, 0, 0);

    for (int i = 0; i < 3; i++) {
        const point_t from = k[i], to = k[(i + 1) % 3];

        mean = sum(mean, 1, unit(cross(from, to)),
                sign * arc(from, to) / (2 * t->area));
    }
    return mean;
}

enum { GRID = 256 };

/* The map without rounding. */
static point_t unrounded(const ql_warp_spherical_t *t, const triangle_t *exact,
        corners_t k, uint32_t u1, uint32_t u2)
{
    (void)t;
    (void)k;
    return along(exact, half_angle_end(exact, ldexpl(u1 + 0.5L, -32)),
            ldexpl(u2 + 0.5L, -32));
}

/* The mean over a grid's midpoints. */
static point_t grid_mean(map_t map, corners_t k, triangle_t *exact)
{
    ql_warp_spherical_t t;
    point_t mean = point(0, 0, 0);

    CHECK(ql_warp_spherical_begin(&t, k.a, k.b, k.c), SHOW_CORNERS, SHOWN(k));
    *exact = named(&t, k);
    for (uint32_t i = 0; i < GRID * GRID; i++) {
        const point_t w = map(&t, exact, k, i / GRID << 24 | 0x7fffffu,
                i % GRID << 24 | 0x7fffffu);

        mean = sum(mean, 1, w, 1.0L / (GRID * GRID));
    }
    return mean;
}

/* A grid has the error of its midpoint rule, in which the root of u2 counts
 * most: that of the map without rounding. Rounding moves it by no more than a
 * direction's error and that of u1 along an edge of up to pi. */
TEST(the_mean_direction_is_the_one_the_edges_give)
{
    const long double limit = 1e-4L;
    long double worst = 0, worst_rounding = 0;
    triangle_t exact;

    for (int i = 0; i < SHAPES; i++) {
        const point_t mean = grid_mean(warp, shapes[i], &exact);
        const point_t ideal = grid_mean(unrounded, shapes[i], &exact);
        const long double error = distance(mean, exact_mean(&exact));
        const long double rounding = distance(mean, ideal);

        worst = fmaxl(worst, error);
        worst_rounding = fmaxl(worst_rounding, rounding);
        CHECK(error < limit && rounding < SIDE_ERROR + pi * U1_ERROR,
                "shape %d: %.3Lg, %.3Lg", i, error, rounding);
    }
    CHECK(distance(grid_mean(plane, shapes[0], &exact), exact_mean(&exact)) >
                            10 * limit &&
                    distance(grid_mean(even_edge, shapes[0], &exact),
                            exact_mean(&exact)) > 10 * limit,
            "a fault passed");
    NOTE("within %.1Le, rounding %.1Le of it", worst, worst_rounding);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_warp_spherical", argc, argv);
    RUN(solid_angles_are_within_their_error_between_the_thresholds);
    RUN(squares_have_the_solid_angles_of_their_closed_form);
    RUN(both_sides_of_both_thresholds_are_told_apart);
    RUN(triangles_that_are_seen_edge_on_are_refused);
    RUN(an_octant_maps_as_its_closed_form);
    RUN(directions_are_unit_inside_and_where_arvo_has_them);
    RUN(corners_of_the_square_stay_inside_too);
    RUN(half_angles_are_arvos_map);
    RUN(corners_keep_their_names_unless_an_edge_is_longer_than_120_degrees);
    RUN(directions_are_uniform_in_solid_angle);
    RUN(points_uniform_on_the_plane_are_rejected);
    RUN(an_edge_or_an_arc_divided_evenly_is_rejected);
    RUN(the_mean_direction_is_the_one_the_edges_give);
    return TEST_END();
}
