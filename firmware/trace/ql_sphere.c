/* ql_sphere.c - ray against sphere: sides exact, the hit point from integers */
/* SPDX-License-Identifier: MIT */

/* Bounds. Positions lie in [0, 32767], centres in [8, 32759] grid units, so an
 * offset s has components below 2^23 in 1/256 grid units and s.s < 2^48. A
 * radius is at most half of the box: r < 2^22. Directions are taken to 1/256
 * grid units too: d < 2^23 for segments and for rays of draft, <= 2^22 for rays
 * of fine; d.d and |s.d| < 2^48.
 *
 * With B = s.d, C = s.s - r^2 and D = d.d the ray parameter solves
 * D t^2 + 2 B t + C = 0, and a quarter of the discriminant is
 * B^2 - D C = D r^2 - |s x d|^2. From outside the second form is used: its
 * error is a fraction of D r^2, however far the ray comes from, so the hit
 * point is off the sphere by that fraction of r even where a ray grazes it.
 * From inside the first form is a sum of two positive numbers. Neither root is
 * ever a difference. */

#include "trace/ql_sphere.h"

#include "math/ql_real.h"
#include "math/vec/ql_vec_unit.h"

#if QL_CFG_SPHERES

/* Grid units and positions to 1/256 grid units. */
#define TO_OFFSET (1 << (8 - QL_POS_BITS))

ql_vec3_t ql_sphere_offset(const ql_blob_sphere_t *sphere, ql_vec3_t p)
{
    /* each below 2^23, so the differences fit */
    ql_vec3_t s;

    s.x = p.x * TO_OFFSET - (int32_t)QL_LE32(sphere->centre[0]);
    s.y = p.y * TO_OFFSET - (int32_t)QL_LE32(sphere->centre[1]);
    s.z = p.z * TO_OFFSET - (int32_t)QL_LE32(sphere->centre[2]);
    return s;
}

/* r^2 < 2^44 */
static int64_t square_of_radius(const ql_blob_sphere_t *sphere)
{
    const int64_t r = (int64_t)QL_LE32(sphere->radius);

    return r * r;
}

int64_t ql_sphere_side(const ql_blob_sphere_t *sphere, ql_vec3_t offset)
{
    return ql_vec_dot(offset, offset) - square_of_radius(sphere);
}

/* u2.30, cut; below all of its bits set, which is no parameter of a hit. */
static ql_uq30_t to_parameter(ql_real_t t)
{
    const uint32_t last = 0xfffffffeu;

    if (t.m == 0 || t.e <= -62) {
        return 0;
    }
    return t.e > -30 || t.m >> (-30 - t.e) > last ? last : t.m >> (-30 - t.e);
}

/* D r^2 - |s x d|^2, from outside.
 *
 * Returns false unless it is above 0 for certain. The product is cut, by 2^-29
 * of it at most; the square is rounded up, by 2^-28 of it. So a ray that misses
 * is never said to hit, and one that hits is lost only within 2^-28 of r inside
 * the rim. */
static bool discriminant(const ql_blob_sphere_t *sphere, ql_vec3_t s,
        ql_vec3_t d, ql_real_t *difference)
{
    /* two products below 2^46: |x| < 2^47 */
    const uint64_t x = ql_abs64((int64_t)s.y * d.z - (int64_t)s.z * d.y);
    const uint64_t y = ql_abs64((int64_t)s.z * d.x - (int64_t)s.x * d.z);
    const uint64_t z = ql_abs64((int64_t)s.x * d.y - (int64_t)s.y * d.x);
    const unsigned zeros = ql_clz64(x | y | z);
    const unsigned shift = zeros < 33 ? 33 - zeros : 0; /* to 31 bits */
    const uint32_t up = shift > 0;
    const uint64_t cx = (x >> shift) + up, cy = (y >> shift) + up,
                   cz = (z >> shift) + up;
    uint64_t cross = cx * cx + cy * cy + cz * cz; /* <= 3 2^62 */
    const ql_real_t whole =
            ql_real_mul(ql_real_from_u64((uint64_t)ql_vec_dot(d, d)),
                    ql_real_from_u64((uint64_t)square_of_radius(sphere)));
    const unsigned left = ql_clz64(cross); /* 64 for a ray at the centre */
    /* whole is m 2^32 times 2^(e - 32); cross is too after shifts */
    const int32_t apart = whole.e - 32 - (int32_t)(2 * shift) + (int32_t)left;

    if (whole.m == 0 || (left < 64 && apart < 0)) {
        return false;
    }
    cross = left < 64 && apart < 64 ? cross << left >> apart : 0;
    if (cross >= (uint64_t)whole.m << 32) {
        return false;
    }
    /* one less for what was shifted out; 0 is not certain */
    *difference = ql_real_scale(
            ql_real_from_u64(((uint64_t)whole.m << 32) - cross - 1),
            whole.e - 32);
    return difference->m != 0;
}

static ql_vec3_t fine_direction(ql_vec3_t d)
{
    const ql_vec3_t r = {d.x * TO_OFFSET, d.y * TO_OFFSET, d.z * TO_OFFSET};

    return r;
}

QL_NOINLINE int ql_sphere_hit(
        const ql_blob_sphere_t *sphere, const ql_ray_t *ray, ql_uq30_t *t)
{
    const ql_vec3_t s = ql_sphere_offset(sphere, ray->origin);
    const ql_vec3_t d = fine_direction(ray->direction);
    const int64_t side = ql_sphere_side(sphere, s);
    const int64_t way = ql_vec_dot(s, d);
    const ql_real_t c = ql_real_from_u64(ql_abs64(side));
    const ql_real_t b = ql_real_from_u64(ql_abs64(way));
    ql_real_t root, inner;

    if (side >= 0 && way >= 0) {
        return 0; /* it leaves */
    }
    if (side > 0) {
        if (!discriminant(sphere, s, d, &root)) {
            return 0;
        }
        inner = ql_real_add(b, ql_real_sqrt(root));
        *t = to_parameter(ql_real_mul(c, ql_real_recip(inner)));
        return 1;
    }
    inner = ql_real_from_u64((uint64_t)ql_vec_dot(d, d));
    root = ql_real_sqrt(ql_real_add(ql_real_mul(b, b), ql_real_mul(c, inner)));
    if (way >= 0) {
        root = ql_real_mul(c, ql_real_recip(ql_real_add(b, root)));
    } else {
        root = ql_real_mul(ql_real_add(b, root), ql_real_recip(inner));
    }
    *t = to_parameter(root);
    return -1;
}

QL_NOINLINE bool ql_sphere_blocks(
        const ql_blob_sphere_t *sphere, const ql_ray_t *segment)
{
    const ql_vec3_t s = ql_sphere_offset(sphere, segment->origin);
    const ql_vec3_t d = fine_direction(segment->direction);
    const int64_t way = ql_vec_dot(s, d), size = ql_vec_dot(d, d);
    const int64_t begin = ql_sphere_side(sphere, s);
    const int64_t end = begin + 2 * way + size; /* |s + d|^2 - r^2 < 2^48 */
    ql_real_t unused;

    if (begin <= 0 && end <= 0) {
        return false; /* a chord */
    }
    if (begin < 0 || end < 0) {
        return begin > 0 || end > 0; /* one of both */
    }
    /* nearest to the centre somewhere between the ends */
    return way < 0 && way + size > 0 && discriminant(sphere, s, d, &unused);
}

ql_vec3_t ql_sphere_step(
        const ql_blob_sphere_t *sphere, ql_vec3_t *p, bool outside)
{
    ql_vec3_t s = ql_sphere_offset(sphere, *p);

    for (unsigned steps = 0; steps < QL_SIDE_STEPS_MAX; steps++) {
        const int64_t side = ql_sphere_side(sphere, s);
        const uint32_t ax = ql_abs32(s.x), ay = ql_abs32(s.y);
        const uint32_t az = ql_abs32(s.z);

        if (outside ? side > 0 : side < 0) {
            break;
        }
        if (ax >= ay && ax >= az) {
            p->x += (s.x < 0) == outside ? -1 : 1;
        } else if (ay >= az) {
            p->y += (s.y < 0) == outside ? -1 : 1;
        } else {
            p->z += (s.z < 0) == outside ? -1 : 1;
        }
        s = ql_sphere_offset(sphere, *p);
    }
    return s;
}

void ql_sphere_surface(
        const ql_blob_sphere_t *sphere, bool outside, ql_surface_t *surface)
{
    const ql_vec3_t s = ql_sphere_step(sphere, &surface->p, outside);

    surface->n = outside ? s : ql_vec_neg(s);
    surface->inv_n = ql_vec_unit_pack_inv_n((uint64_t)ql_vec_dot(s, s));
}

#endif
