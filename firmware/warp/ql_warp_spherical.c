/* ql_warp_spherical.c - uniform directions towards a triangle */
/* SPDX-License-Identifier: MIT */

#include "warp/ql_warp_spherical.h"

#include "math/ql_trig.h"

#define SPLIT 26 /* bits of a normal's low half */

/* A normal before it is cut: components below 2^50. */
typedef struct {
    int64_t x, y, z;
} wide3_t;

static const ql_real_t least_area = {0x9d495183u, -43}; /* 3e-4 */
static const ql_real_t most_area = {0xc70a3d71u, -29};  /* 6.22 */

/* v * by, rounded to nearest. Every caller keeps |v| * by < 2^30. */
static QL_NOINLINE int32_t times_real(int32_t v, ql_real_t by)
{
    const int64_t product = (int64_t)v * by.m; /* below 2^63 */
    const unsigned shift = by.e > -2 ? 2u : by.e < -62 ? 62u : (unsigned)-by.e;
    const int64_t twice = ql_asr64(product, shift - 1);

    return ql_i32((uint32_t)ql_asr64(twice + 1, 1));
}

static QL_NOINLINE ql_vec3_t vector_times_real(ql_vec3_t v, ql_real_t by)
{
    const ql_vec3_t r = {
            times_real(v.x, by), times_real(v.y, by), times_real(v.z, by)};

    return r;
}

/* (x a + y b) 2^-32, to nearest, of s2.29 vectors; x and y below 2^32. */
static QL_NOINLINE int32_t combine(int32_t a, int64_t x, int32_t b, int64_t y)
{
    /* each product is below 2^62 */
    return (int32_t)ql_asr64(a * x + b * y + 0x80000000, 32);
}

static ql_real_t real(uint64_t n)
{
    return ql_real_from_uq_call(n, 0);
}

/* ---- The triangle ------------------------------------------------------- */

static QL_NOINLINE wide3_t cross(ql_vec3_t a, ql_vec3_t b)
{
    const wide3_t r = {(int64_t)a.y * b.z - (int64_t)a.z * b.y,
            (int64_t)a.z * b.x - (int64_t)a.x * b.z,
            (int64_t)a.x * b.y - (int64_t)a.y * b.x};

    return r;
}

/* x 2^-e, to nearest; e from block(). */
static QL_NOINLINE int32_t round_down_by(int64_t x, int16_t e)
{
    if (e <= 0) {
        return (int32_t)ql_i64((uint64_t)x << -e); /* below 2^30 */
    }
    return (int32_t)ql_asr64(ql_asr64(x, (unsigned)e - 1) + 1, 1);
}

/* The vector over 2^e, its largest component 2^29..2^30 in size. */
static QL_NOINLINE ql_vec3_t block(const wide3_t *n, int16_t *e)
{
    const uint64_t any = ql_abs64(n->x) | ql_abs64(n->y) | ql_abs64(n->z);
    ql_vec3_t r;

    *e = (int16_t)(34 - (int16_t)ql_clz64(any)); /* -30..34 */
    r.x = round_down_by(n->x, *e);
    r.y = round_down_by(n->y, *e);
    r.z = round_down_by(n->z, *e);
    return r;
}

/* |n . c|, relative error 2^-30: the sum is exact, in two halves. */
static ql_real_t volume(const wide3_t *n, ql_vec3_t c)
{
    const int64_t mask = ((int64_t)1 << SPLIT) - 1;
    /* below 2^26 2^24 3 */
    const int64_t low =
            (n->x & mask) * c.x + (n->y & mask) * c.y + (n->z & mask) * c.z;
    /* below 2^24 2^24 3, and the carry */
    int64_t high = ql_asr64(n->x, SPLIT) * c.x + ql_asr64(n->y, SPLIT) * c.y +
                   ql_asr64(n->z, SPLIT) * c.z + ql_asr64(low, SPLIT);
    int64_t rest = low & mask;

    if (high < 0) {
        high = ~high;
        rest = mask + 1 - rest;
    }
    return ql_real_add(
            ql_real_scale(real((uint64_t)high), SPLIT), real((uint64_t)rest));
}

/* Which corner is a: the first, or the one from which the corner before it is
 * the farthest, if that is beyond 120 degrees. */
static unsigned first_corner(const ql_vec3_t unit[3])
{
    int64_t least = -((int64_t)1 << 57); /* s.58: -1/2 */
    unsigned first = 0;
    int64_t cosine = ql_vec_dot_call(unit[2], unit[0]);

    least = cosine < least ? cosine : least;
    for (unsigned i = 1; i < 3; i++) {
        cosine = ql_vec_dot_call(unit[i - 1], unit[i]);
        if (cosine < least) {
            least = cosine;
            first = i;
        }
    }
    return first;
}

/* Half the solid angle, whose tangent is p / (cot_b +- q). */
static ql_real_t half_area(const ql_warp_spherical_t *t, ql_real_t cot_b)
{
    const ql_real_t below_0 = ql_real_sub(t->q, cot_b);
    const bool beyond = t->obtuse && below_0.m != 0;
    const ql_real_t rest = beyond      ? below_0
                           : t->obtuse ? ql_real_sub(cot_b, t->q)
                                       : ql_real_add(cot_b, t->q);
    const ql_real_t angle = rest.m == 0 ? QL_REAL_HALF_PI
                                        : ql_real_atan(ql_real_div(t->p, rest));

    return beyond ? ql_real_sub(QL_REAL_PI, angle) : angle;
}

/* |a||b| + |a . b| */
static QL_NOINLINE ql_real_t length_sum(ql_real_t a, ql_real_t b, int64_t both)
{
    return ql_real_add(ql_real_mul_call(a, b), real(ql_abs64(both)));
}

/* The angle at the corner a, and the edges that meet there. */
static bool measure(ql_warp_spherical_t *t, const ql_vec3_t corner[3],
        const ql_real_t length[3], unsigned ia)
{
    const unsigned ib = ia == 2 ? 0 : ia + 1, ic = ia == 0 ? 2 : ia - 1;
    const int64_t ab = ql_vec_dot_call(corner[ia], corner[ib]);
    const int64_t ac = ql_vec_dot_call(corner[ia], corner[ic]);
    wide3_t wide = cross(corner[ia], corner[ib]);
    const ql_real_t det = volume(&wide, corner[ic]);
    ql_vec3_t n_ab, n_ac;
    ql_real_t scale, inv_n_ac, cot_b;
    int16_t e_ab, e_ac;
    int64_t cosine;

    if (det.m == 0) {
        return false;
    }
    n_ab = block(&wide, &e_ab);
    wide = cross(corner[ia], corner[ic]);
    n_ac = block(&wide, &e_ac);
    inv_n_ac = ql_real_div(QL_REAL_ONE, ql_real_sqrt(ql_vec_square(n_ac)));
    t->towards_c = vector_times_real(n_ac, ql_real_scale(inv_n_ac, 29));
    inv_n_ac = ql_real_scale(inv_n_ac, -e_ac);

    /* tan(c/2) / |a x b| is 1 / (|a||b| + a.b) or (|a||b| - a.b) / |a x b|^2:
     * whichever does not cancel */
    scale = length_sum(length[ia], length[ib], ab);
    scale = ab >= 0 ? ql_real_div(QL_REAL_ONE, scale)
                    : ql_real_div(scale,
                              ql_real_scale(ql_vec_square(n_ab), 2 * e_ab));
    scale = ql_real_mul_call(scale, inv_n_ac);

    /* sin(alpha) = det |a| / (|a x b| |a x c|), the cosine likewise */
    t->p = ql_real_mul_call(ql_real_mul_call(scale, det), length[ia]);
    cosine = ql_vec_dot_call(n_ab, n_ac);
    t->obtuse = cosine < 0;
    t->q = ql_real_mul_call(
            scale, ql_real_scale(real(ql_abs64(cosine)), e_ab + e_ac));

    cot_b = ql_real_mul_call(length_sum(length[ia], length[ic], ac), inv_n_ac);
    t->solid_angle = ql_real_scale(
            half_area(t, ac >= 0 ? cot_b : ql_real_div(QL_REAL_ONE, cot_b)), 1);
    return true;
}

bool ql_warp_spherical_begin(
        ql_warp_spherical_t *t, ql_vec3_t a, ql_vec3_t b, ql_vec3_t c)
{
    const ql_vec3_t corner[3] = {a, b, c};
    ql_vec3_t unit[3];
    ql_real_t length[3];
    wide3_t wide;
    unsigned ia;

    for (unsigned i = 0; i < 3; i++) {
        length[i] = ql_real_sqrt(ql_vec_square(corner[i]));
        unit[i] = vector_times_real(corner[i],
                ql_real_scale(ql_real_div(QL_REAL_ONE, length[i]), 29));
    }
    ia = first_corner(unit);
    if (!measure(t, corner, length, ia) ||
            ql_real_less(t->solid_angle, least_area) ||
            ql_real_less(most_area, t->solid_angle)) {
        return false;
    }
    t->a = unit[ia];
    t->b = unit[ia == 2 ? 0 : ia + 1];
    wide = cross(t->towards_c, t->a); /* of a x c; s.58, below 2^60 */
    t->towards_c.x = round_down_by(wide.x, 29);
    t->towards_c.y = round_down_by(wide.y, 29);
    t->towards_c.z = round_down_by(wide.z, 29);
    return true;
}

/* ---- Directions --------------------------------------------------------- */

/* The point of the edge from a to c that cuts off the area 2 y. */
static ql_vec3_t along_edge(const ql_warp_spherical_t *t, ql_real_t y)
{
    const bool beyond = ql_real_less(QL_REAL_HALF_PI, y);
    const ql_real_t sine = ql_real_sin(y);
    const ql_real_t cosine =
            ql_real_sin(beyond ? ql_real_sub(y, QL_REAL_HALF_PI)
                               : ql_real_sub(QL_REAL_HALF_PI, y));
    const ql_real_t pc = ql_real_mul_call(t->p, cosine);
    const ql_real_t qs = ql_real_mul_call(t->q, sine);
    /* tan(x/2) = sine / rest, rest = +-pc -+qs */
    const ql_real_t rest =
            beyond      ? (t->obtuse ? ql_real_sub(qs, pc) : QL_REAL_ZERO)
            : t->obtuse ? ql_real_add(pc, qs)
                        : ql_real_sub(pc, qs);
    const bool far = ql_real_sub(sine, rest).m != 0; /* x > 90 degrees */
    const ql_real_t ratio =
            far ? ql_real_div(rest, sine) : ql_real_div(sine, rest);
    const ql_real_t ratio2 = ql_real_mul_call(ratio, ratio);
    const ql_real_t inverse =
            ql_real_div(QL_REAL_ONE, ql_real_add(QL_REAL_ONE, ratio2));
    /* u0.32: (1 - r^2) / (1 + r^2), 2 r / (1 + r^2) */
    const int64_t x = ql_real_to_uq32(
            ql_real_mul_call(ql_real_sub(QL_REAL_ONE, ratio2), inverse));
    const int64_t s =
            ql_real_to_uq32(ql_real_scale(ql_real_mul_call(ratio, inverse), 1));
    const ql_vec3_t r = {combine(t->a.x, far ? -x : x, t->towards_c.x, s),
            combine(t->a.y, far ? -x : x, t->towards_c.y, s),
            combine(t->a.z, far ? -x : x, t->towards_c.z, s)};

    return r;
}

/* The direction of v less what of it is along the unit vector b; components up
 * to 2^31. v is a chord of up to 90 degrees, so |v . b| <= |v| / sqrt(2). */
static ql_vec3_t rejected(ql_vec3_t v, ql_vec3_t b)
{
    const wide3_t wide = {v.x, v.y, v.z};
    int16_t e;
    const ql_vec3_t d = block(&wide, &e);
    /* of 2^e units: below 2^31, times 2^29 below 2^60 */
    const int64_t along = ql_asr64(ql_vec_dot_call(d, b), 29);
    const ql_vec3_t r = {d.x - round_down_by(along * b.x, 29),
            d.y - round_down_by(along * b.y, 29),
            d.z - round_down_by(along * b.z, 29)};

    return r;
}

/* A point of the arc from b to c, its 1 - cos a share u of the whole arc's. */
static ql_vec3_t along_arc(ql_vec3_t b, ql_vec3_t c, ql_uq32_t u)
{
    /* d is the arc's length; v is a chord, to c from b or, beyond 90 degrees,
     * from -b; k = |v|^2 / 4 is sin^2(d/2), or cos^2(d/2) */
    const bool far = ql_vec_dot_call(b, c) < 0;
    const int32_t sign = far ? -1 : 1;
    const ql_vec3_t v = {c.x - sign * b.x, c.y - sign * b.y, c.z - sign * b.z};
    const ql_real_t k = ql_real_scale(ql_vec_square(v), -60);
    const ql_real_t share = ql_real_midpoint(u);
    /* sin^2(theta/2) and cos^2(theta/2) of the point */
    const ql_real_t s2 =
            ql_real_mul_call(share, far ? ql_real_sub(QL_REAL_ONE, k) : k);
    const ql_real_t c2 =
            far ? ql_real_add(ql_real_midpoint(~u), ql_real_mul_call(share, k))
                : ql_real_sub(QL_REAL_ONE, s2);
    /* across b, of some length; to be sin(theta) in s2.29 */
    const ql_vec3_t across = rejected(v, b);
    const ql_real_t stretch = ql_real_sqrt(
            ql_real_div(ql_real_scale(ql_real_mul_call(s2, c2), 60),
                    ql_vec_square(across)));
    const ql_vec3_t aside = vector_times_real(across, stretch);
    /* cos(theta) = 1 - 2 s2 */
    const ql_vec3_t down = vector_times_real(b, ql_real_scale(s2, 1));
    const ql_vec3_t w = {b.x - down.x + aside.x, b.y - down.y + aside.y,
            b.z - down.z + aside.z};

    return w;
}

ql_vec3_t ql_warp_spherical(
        const ql_warp_spherical_t *t, ql_uq32_t u1, ql_uq32_t u2)
{
    const ql_real_t half = ql_real_mul_call(
            ql_real_midpoint(u1), ql_real_scale(t->solid_angle, -1));

    return along_arc(t->b, along_edge(t, half), u2);
}

ql_real_t ql_warp_spherical_pdf(const ql_warp_spherical_t *t)
{
    return ql_real_recip_call(t->solid_angle);
}
