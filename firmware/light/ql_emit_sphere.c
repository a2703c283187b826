/* ql_emit_sphere.c - a point of its area, a cone from outside, the inside */
/* SPDX-License-Identifier: MIT */

#include "light/ql_emit_sphere.h"

#if QL_CFG_SPHERES

#include "material/ql_diffuse.h"
#include "math/vec/ql_frame.h"
#include "math/vec/ql_vec_unit.h"
#include "trace/ql_sphere.h"
#include "warp/ql_warp_cone.h"
#include "warp/ql_warp_sphere.h"

/* 1/256 grid units to a position, to nearest. */
static ql_pos_t pos_from_q8(int64_t x)
{
    const int64_t half = (1 << (8 - QL_POS_BITS)) >> 1;

    return (ql_pos_t)ql_asr64(x + half, 8 - QL_POS_BITS); /* in the box */
}

/* p + t w, t in 1/256 grid units below 2^26. */
static ql_vec3_t point_along(ql_vec3_t p, ql_vec3_t w, int64_t t)
{
    const ql_vec3_t r = {p.x + pos_from_q8(ql_asr64(t * w.x, 29)),
            p.y + pos_from_q8(ql_asr64(t * w.y, 29)),
            p.z + pos_from_q8(ql_asr64(t * w.z, 29))};

    return r;
}

/* A real below 2^32 as an integer, cut. */
static uint32_t to_integer(ql_real_t a)
{
    return a.e > 0 ? 0xffffffffu : a.e <= -32 ? 0 : a.m >> -a.e;
}

static ql_real_t radius_squared(const ql_blob_sphere_t *sphere)
{
    const uint64_t r = QL_LE32(sphere->radius); /* < 2^23 */

    return ql_real_from_u64(r * r);
}

/* pi a 2^shift */
static ql_real_t pi_times(ql_real_t a, int32_t shift)
{
    return ql_real_scale(ql_real_mul(QL_REAL_PI, a), shift);
}

/* ---- A point of its area ----------------------------------------------- */

static bool sample_sphere(const ql_blob_sphere_t *sphere, ql_vec3_t offset,
        int64_t side, const ql_surface_t *surface, ql_uniform2_t u,
        ql_emit_sample_t *sample)
{
    const ql_vec3_t n = ql_warp_sphere(u.u1, u.u2);
    const int64_t r = (int64_t)QL_LE32(sphere->radius);
    ql_vec3_t w;
    ql_real_t square, length;
    int64_t facing;

    /* from the surface to the point, 1/256 grid units, below 2^24 */
    w.x = (int32_t)ql_asr64(r * n.x, 29) - offset.x;
    w.y = (int32_t)ql_asr64(r * n.y, 29) - offset.y;
    w.z = (int32_t)ql_asr64(r * n.z, 29) - offset.z;
    facing = ql_vec_dot(n, w);
    if (side > 0 ? facing >= 0 : facing <= 0) {
        return false; /* hidden by the sphere itself */
    }
    square = ql_vec_square(w);
    length = ql_real_sqrt(square);
    if (!ql_emit_set_wi(
                sample, surface, ql_vec_unit_q29_of_length(w, length))) {
        return false;
    }
    /* 4 pi R^2 cos' / r^2, n s2.29 */
    sample->inv_pdf = ql_real_mul(pi_times(radius_squared(sphere), 2),
            ql_real_mul(ql_real_scale(ql_real_from_u64(ql_abs64(facing)), -29),
                    ql_real_recip(ql_real_mul(square, length))));
    sample->to.x = surface->p.x + pos_from_q8(w.x);
    sample->to.y = surface->p.y + pos_from_q8(w.y);
    sample->to.z = surface->p.z + pos_from_q8(w.z);
    return true;
}

/* ---- The cone it fills ------------------------------------------------- */

/* 1 - cos of the cone that a sphere fills, from outside. */
static ql_real_t cone_of(
        const ql_blob_sphere_t *sphere, ql_real_t distance_squared)
{
    return ql_warp_cone_of_sphere(ql_real_mul(
            radius_squared(sphere), ql_real_recip(distance_squared)));
}

static bool sample_cone(const ql_blob_sphere_t *sphere, ql_vec3_t offset,
        const ql_surface_t *surface, ql_uniform2_t u, ql_emit_sample_t *sample)
{
    const ql_real_t square = ql_vec_square(offset);
    const ql_real_t distance = ql_real_sqrt(square);
    const ql_real_t s_max = cone_of(sphere, square);
    const ql_vec3_t local = ql_warp_cone(s_max, u.u1, u.u2);
    ql_frame_t frame;
    uint32_t sine2, ratio2, root;
    int64_t near;

    ql_frame_from_normal(
            &frame, ql_vec_unit_q29_of_length(ql_vec_neg(offset), distance));
    if (!ql_emit_set_wi(sample, surface, ql_frame_to_world(&frame, local))) {
        return false;
    }
    sample->inv_pdf = pi_times(s_max, 1);

    /* the near side is at distance (cos - sqrt(R^2/d^2 - sin^2)) */
    sine2 = (uint32_t)(((uint64_t)((int64_t)local.x * local.x) +
                               (uint64_t)((int64_t)local.y * local.y)) >>
                       26); /* < 2^32: at most 1, less its rounding */
    ratio2 = ql_real_to_uq32(
            ql_real_mul(radius_squared(sphere), ql_real_recip(square)));
    root = ratio2 > sine2 ? ql_sqrt_uq32(ratio2 - sine2) >> 3 : 0;
    near = local.z > (int32_t)root ? local.z - (int32_t)root : 0;
    sample->to = point_along(surface->p, sample->wi,
            ql_asr64((int64_t)to_integer(distance) * near, 29));
    return true;
}

/* ---- From inside or on it ---------------------------------------------- */

/* How far a direction leads to the sphere from a point inside. */
static int64_t way_out(ql_vec3_t offset, int64_t side, ql_vec3_t w)
{
    /* -b + sqrt(b^2 - side), |b| < 2^25 */
    const int64_t b = ql_asr64(ql_vec_dot(offset, w), 29);
    const ql_real_t root =
            ql_real_sqrt(ql_real_from_u64((uint64_t)(b * b - side)));

    return (int64_t)to_integer(root) - b;
}

/* From a point on the sphere, half of the directions leave it. */
static bool sample_inside(ql_vec3_t offset, int64_t side,
        const ql_surface_t *surface, ql_uniform2_t u, ql_emit_sample_t *sample)
{
    if (!ql_emit_set_wi(sample, surface, ql_diffuse_unit(surface, u)) ||
            (side == 0 && ql_vec_dot(offset, sample->wi) >= 0)) {
        return false;
    }
    sample->inv_pdf = ql_diffuse_inv_pdf(sample->cosine);
    sample->to = point_along(
            surface->p, sample->wi, way_out(offset, side, sample->wi));
    return true;
}

/* ---- Whichever it is --------------------------------------------------- */

bool ql_emit_sphere_sample(const ql_scene_t *scene, ql_direct_t direct,
        const ql_blob_sphere_t *sphere, const ql_surface_t *surface,
        ql_uniform2_t u, ql_emit_sample_t *sample)
{
    const ql_vec3_t offset = ql_sphere_offset(sphere, surface->p);
    const int64_t side = ql_sphere_side(sphere, offset);

    if (side <= 0 && !ql_scene_two_sided(scene)) {
        return false;
    }
    if (side != 0 && ql_direct_is(direct, QL_DIRECT_AREA)) {
        return sample_sphere(sphere, offset, side, surface, u, sample);
    }
    if (side > 0) {
        return sample_cone(sphere, offset, surface, u, sample);
    }
    return sample_inside(offset, side, surface, u, sample);
}

ql_real_t ql_emit_sphere_inv_pdf(const ql_blob_sphere_t *sphere,
        const ql_surface_t *surface, const ql_ray_t *ray)
{
    const ql_vec3_t offset = ql_sphere_offset(sphere, ray->origin);

    return ql_sphere_side(sphere, offset) > 0
                   ? pi_times(cone_of(sphere, ql_vec_square(offset)), 1)
                   : ql_diffuse_inv_pdf(
                             ql_shading_cosine_of_dir(surface, ray->direction));
}

#endif
