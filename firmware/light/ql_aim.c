/* ql_aim.c - area, spherical triangle, cone, cosine, sky: towards an emitter */
/* SPDX-License-Identifier: MIT */

#include "light/ql_aim.h"

#include "math/ql_frame.h"
#include "math/ql_vec_unit.h"
#include "warp/ql_lobe.h"
#include "warp/ql_spherical.h"
#include "warp/ql_warp.h"
#include "material/ql_bsdf.h"
#include "light/ql_light.h"
#include "light/ql_sky.h"
#include "trace/ql_sphere.h"
#include "trace/ql_surface_at.h"

/* Is there more than points of triangles? */
#define DIRECTIONS (QL_CFG_SPHERES || QL_CFG_SKY || QL_CFG_STRATEGIES)

#if DIRECTIONS
/* pi a 2^shift */
static ql_real_t pi_times(ql_real_t a, int shift)
{
    return ql_real_scale(ql_real_mul(QL_REAL_PI, a), shift);
}
#endif

#if DIRECTIONS
/* Set the cosine of a unit direction; false if it is not above the surface. */
static bool set_direction(
        ql_aim_t *aim, const ql_surface_t *surface, ql_vec3_t w)
{
    aim->w = w;
    aim->cosine = ql_real_scale(ql_bsdf_cosine(surface, w), -29);
    return aim->cosine.m != 0;
}
#endif

#if QL_CFG_SPHERES || QL_CFG_SKY
/* Directions proportional to the cosine. */
static bool aim_cosine(
        const ql_surface_t *surface, ql_uniform2_t u, ql_aim_t *aim)
{
    const ql_vec3_t n = ql_bsdf_normal(surface);
    const ql_vec3_t v = ql_warp_cosine_hemisphere(n, u.u1, u.u2);
    const ql_real_t square = ql_vec_square(v);

    if (square.m == 0 ||
            !set_direction(aim, surface,
                    ql_vec_unit_q29_of_length(v, ql_real_sqrt(square)))) {
        return false;
    }
    aim->inverse = pi_times(ql_real_recip(aim->cosine), 0);
    return true;
}
#endif

/* ---- triangles ---- */

static bool aim_point(const ql_scene_t *scene, uint16_t light,
        const ql_surface_t *surface, ql_uniform2_t u, ql_aim_t *aim)
{
    ql_light_point_t point;
    ql_real_t square, length;
    ql_vec3_t w;
    const uint64_t cos_light =
            ql_aim_at_point(scene, light, surface->p, u, &point, &w);

    if (cos_light == 0) {
        return false;
    }
    square = ql_vec_square(w);
    length = ql_real_sqrt(square);
    aim->w = ql_vec_unit_q29_of_length(w, length);
    aim->cosine =
            ql_real_mul(ql_bsdf_cosine(surface, w), ql_real_recip(length));
    /* A cos' / r^2 with A cos' = -N.w / (2 |w|); lengths carry f bits */
    aim->inverse =
            ql_real_scale(ql_real_mul(ql_real_from_u64(cos_light),
                                  ql_real_recip(ql_real_mul(square, length))),
                    2 * QL_POS_BITS - 1);
    aim->to = point.q;
    return aim->cosine.m != 0;
}

#if QL_CFG_STRATEGIES
/* Lowest and highest of three coordinates, as positions. */
static ql_pos_t clamp_to(ql_pos_t x, int32_t a, int32_t b, int32_t c)
{
    const int32_t low = a < b ? (a < c ? a : c) : (b < c ? b : c);
    const int32_t high = a > b ? (a > c ? a : c) : (b > c ? b : c);

    if (x < low * (1 << QL_POS_BITS)) {
        return low * (1 << QL_POS_BITS);
    }
    return x > high * (1 << QL_POS_BITS) ? high * (1 << QL_POS_BITS) : x;
}

/* x times a ratio; saturates. */
static int32_t stretch(int32_t x, ql_real_t ratio)
{
    const int down = -32 - ratio.e;
    const int32_t high = ql_mulhi_su32(x, ratio.m);

    if (down <= 0) {
        return x < 0 ? -(1l << 24) : 1l << 24; /* past any corner */
    }
    return down > 31 ? 0 : ql_asr32(high, (unsigned)down);
}

/* From p to a corner. */
static ql_vec3_t corner_from(ql_vec3_t corner, ql_vec3_t p)
{
    const ql_vec3_t r = {corner.x * (1 << QL_POS_BITS) - p.x,
            corner.y * (1 << QL_POS_BITS) - p.y,
            corner.z * (1 << QL_POS_BITS) - p.z};

    return r;
}

/* Where a unit direction w from p meets the plane through v[0], cut to the box
 * of the triangle and put in front of it. */
static ql_vec3_t meet_plane(ql_vec3_t p, ql_vec3_t w, const ql_vec3_t v[3],
        ql_vec3_t n, uint64_t height)
{
    /* n.w < 2^31 2^29: w leads through the plane, so it is not 0, or nearly
     * along it: then anything in the box will do */
    const ql_real_t ratio = ql_real_mul(ql_real_from_u64(height),
            ql_real_recip(ql_real_from_u64(ql_abs64(ql_vec_dot(n, w)) | 1u)));
    ql_vec3_t q;

    q.x = clamp_to(p.x + stretch(w.x, ratio), v[0].x, v[1].x, v[2].x);
    q.y = clamp_to(p.y + stretch(w.y, ratio), v[0].y, v[1].y, v[2].y);
    q.z = clamp_to(p.z + stretch(w.z, ratio), v[0].z, v[1].z, v[2].z);
    (void)ql_surface_step(&q, &v[0], &n);
    return q;
}

/* Directions uniform on the triangle as seen; 0 if nothing comes from there, 1
 * if done, -1 if the triangle is too small or too large for that. */
static int aim_spherical(const ql_scene_t *scene, const ql_blob_tri_t *tri,
        const ql_surface_t *surface, ql_uniform2_t u, ql_aim_t *aim)
{
    ql_vec3_t v[3], n;
    ql_spherical_t seen;
    int64_t height;

    for (unsigned i = 0; i < 3; i++) {
        v[i] = ql_scene_corner(scene, tri, i);
    }
    n = ql_vec_cross(ql_vec_sub(v[1], v[0]), ql_vec_sub(v[2], v[0]));
    height = -ql_vec_dot_normal(corner_from(v[0], surface->p), n);
    if (height < 0 && ql_scene_two_sided(scene)) {
        n = ql_vec_neg(n); /* |n| < 2^31 */
        height = -height;
    }
    if (height <= 0) {
        return 0;
    }
    if (!ql_spherical_begin(&seen, corner_from(v[0], surface->p),
                corner_from(v[1], surface->p), corner_from(v[2], surface->p))) {
        return -1;
    }
    if (!set_direction(
                aim, surface, ql_warp_spherical_triangle(&seen, u.u1, u.u2))) {
        return 0;
    }
    aim->inverse = seen.solid_angle;
    aim->to = meet_plane(surface->p, aim->w, v, n, (uint64_t)height);
    return 1;
}
#endif

/* ---- spheres ---- */

#if QL_CFG_SPHERES
/* 1/256 grid units to a position, to nearest. */
static ql_pos_t from_q8(int64_t x)
{
    const int64_t half = (1 << (8 - QL_POS_BITS)) >> 1;

    return (ql_pos_t)ql_asr64(x + half, 8 - QL_POS_BITS); /* in the box */
}

/* p + t w, t in 1/256 grid units below 2^26. */
static ql_vec3_t point_along(ql_vec3_t p, ql_vec3_t w, int64_t t)
{
    const ql_vec3_t r = {p.x + from_q8(ql_asr64(t * w.x, 29)),
            p.y + from_q8(ql_asr64(t * w.y, 29)),
            p.z + from_q8(ql_asr64(t * w.z, 29))};

    return r;
}

/* A real below 2^32 as an integer, cut. */
static uint32_t whole(ql_real_t a)
{
    return a.e > 0 ? 0xffffffffu : a.e <= -32 ? 0 : a.m >> -a.e;
}

static ql_real_t radius_squared(const ql_blob_sphere_t *sphere)
{
    const uint64_t r = QL_LE32(sphere->radius); /* < 2^23 */

    return ql_real_from_u64(r * r);
}

/* A way that leads out of a sphere from a point inside. */
static int64_t way_out(ql_vec3_t offset, int64_t side, ql_vec3_t w)
{
    /* -b + sqrt(b^2 - side), |b| < 2^25 */
    const int64_t b = ql_asr64(ql_vec_dot(offset, w), 29);
    const ql_real_t root =
            ql_real_sqrt(ql_real_from_u64((uint64_t)(b * b - side)));

    return (int64_t)whole(root) - b;
}

#if QL_CFG_STRATEGIES
/* 1 - cos of the cone that a sphere fills, from outside. */
static ql_real_t cone_of(
        const ql_blob_sphere_t *sphere, ql_real_t distance_squared)
{
    return ql_cone_of_sphere(ql_real_mul(
            radius_squared(sphere), ql_real_recip(distance_squared)));
}

static bool aim_cone(const ql_blob_sphere_t *sphere, ql_vec3_t offset,
        const ql_surface_t *surface, ql_uniform2_t u, ql_aim_t *aim)
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
    if (!set_direction(aim, surface, ql_frame_to_world(&frame, local))) {
        return false;
    }
    aim->inverse = pi_times(s_max, 1);

    /* the near side is at distance (cos - sqrt(R^2/d^2 - sin^2)) */
    sine2 = (uint32_t)(((uint64_t)((int64_t)local.x * local.x) +
                               (uint64_t)((int64_t)local.y * local.y)) >>
                       26); /* < 2^32: at most 1, less its rounding */
    ratio2 = ql_real_to_uq32(
            ql_real_mul(radius_squared(sphere), ql_real_recip(square)));
    root = ratio2 > sine2 ? ql_sqrt_uq32(ratio2 - sine2) >> 3 : 0;
    near = local.z > (int32_t)root ? local.z - (int32_t)root : 0;
    aim->to = point_along(
            surface->p, aim->w, ql_asr64((int64_t)whole(distance) * near, 29));
    return true;
}
#endif

static bool aim_ball_area(const ql_blob_sphere_t *sphere, ql_vec3_t offset,
        int64_t side, const ql_surface_t *surface, ql_uniform2_t u,
        ql_aim_t *aim)
{
    const ql_vec3_t v = ql_warp_sphere(u.u1, u.u2);
    const int64_t r = (int64_t)QL_LE32(sphere->radius);
    ql_vec3_t w;
    ql_real_t square, length;
    int64_t facing;

    /* from the surface to the point, 1/256 grid units, below 2^24 */
    w.x = (int32_t)ql_asr64(r * v.x, 29) - offset.x;
    w.y = (int32_t)ql_asr64(r * v.y, 29) - offset.y;
    w.z = (int32_t)ql_asr64(r * v.z, 29) - offset.z;
    facing = ql_vec_dot(v, w);
    if (side > 0 ? facing >= 0 : facing <= 0) {
        return false; /* hidden by the sphere itself */
    }
    square = ql_vec_square(w);
    length = ql_real_sqrt(square);
    if (!set_direction(aim, surface, ql_vec_unit_q29_of_length(w, length))) {
        return false;
    }
    /* 4 pi R^2 cos' / r^2, v s2.29 */
    aim->inverse = ql_real_mul(pi_times(radius_squared(sphere), 2),
            ql_real_mul(ql_real_scale(ql_real_from_u64(ql_abs64(facing)), -29),
                    ql_real_recip(ql_real_mul(square, length))));
    aim->to.x = surface->p.x + from_q8(w.x);
    aim->to.y = surface->p.y + from_q8(w.y);
    aim->to.z = surface->p.z + from_q8(w.z);
    return true;
}

/* direct is AREA without QL_CFG_STRATEGIES */
static bool aim_ball(const ql_scene_t *scene, unsigned direct,
        const ql_blob_sphere_t *sphere, const ql_surface_t *surface,
        ql_uniform2_t u, ql_aim_t *aim)
{
    const ql_vec3_t offset = ql_sphere_offset(sphere, surface->p);
    const int64_t side = ql_sphere_side(sphere, offset);

    if (side <= 0 && !ql_scene_two_sided(scene)) {
        return false;
    }
    if (side != 0 && (!QL_CFG_STRATEGIES || direct == QL_DIRECT_AREA)) {
        return aim_ball_area(sphere, offset, side, surface, u, aim);
    }
#if QL_CFG_STRATEGIES
    if (side > 0) {
        return aim_cone(sphere, offset, surface, u, aim);
    }
#endif
    if (!aim_cosine(surface, u, aim) ||
            (side == 0 && ql_vec_dot(offset, aim->w) >= 0)) {
        return false; /* from a point on it, half of the directions leave */
    }
    aim->to = point_along(surface->p, aim->w, way_out(offset, side, aim->w));
    return true;
}
#endif

/* ---- the sky ---- */

#if QL_CFG_SKY
static bool aim_sky(const ql_scene_t *scene, const ql_surface_t *surface,
        ql_uniform2_t u, ql_aim_t *aim)
{
#if QL_CFG_SKY_MAP
    if (scene->texels != NULL) {
        ql_vec3_t w;

        aim->inverse = ql_sky_sample(scene, u.u1, u.u2, &w, aim->emission);
        return set_direction(aim, surface, w);
    }
#endif
    for (unsigned i = 0; i < 3; i++) {
        aim->emission[i] = QL_LE32(scene->sky->emission[i]);
    }
    return aim_cosine(surface, u, aim);
}
#endif

/* ---- any ---- */

bool ql_aim_sample(const ql_scene_t *scene, unsigned direct, uint16_t light,
        const ql_surface_t *surface, ql_uniform2_t u, ql_aim_t *aim)
{
    const uint16_t index = QL_LE16(scene->lights[light].triangle);
    const ql_blob_tri_t *tri = scene->triangles + index;

#if QL_CFG_SKY
    if (index == QL_LIGHT_SKY) {
        return aim_sky(scene, surface, u, aim);
    }
#endif
    for (unsigned i = 0; i < 3; i++) {
        aim->emission[i] = QL_LE32(ql_scene_material(scene, tri)->emission[i]);
    }
#if QL_CFG_SPHERES
    if (ql_scene_sphere(scene, tri) != NULL) {
        return aim_ball(
                scene, direct, ql_scene_sphere(scene, tri), surface, u, aim);
    }
#endif
#if QL_CFG_STRATEGIES
    if (direct == QL_DIRECT_SOLID_ANGLE) {
        const int done = aim_spherical(scene, tri, surface, u, aim);

        if (done >= 0) {
            return done != 0;
        }
    }
#else
    (void)direct;
#endif
    return aim_point(scene, light, surface, u, aim);
}

#if QL_CFG_STRATEGIES
static ql_real_t triangle_inverse(const ql_scene_t *scene, const ql_ray_t *ray,
        const ql_blob_tri_t *tri, ql_uq30_t t)
{
    const ql_vec3_t v0 = ql_scene_corner(scene, tri, 0);
    const ql_vec3_t e1 = ql_vec_sub(ql_scene_corner(scene, tri, 1), v0);
    const ql_vec3_t e2 = ql_vec_sub(ql_scene_corner(scene, tri, 2), v0);
    const int64_t facing =
            ql_vec_dot_normal(ray->direction, ql_vec_cross(e1, e2));
    const ql_real_t way = ql_real_scale(ql_real_from_u64(t), -30);
    const ql_real_t square = ql_vec_square(ray->direction);
    const ql_real_t below = ql_real_mul(
            ql_real_mul(way, way), ql_real_mul(square, ql_real_sqrt(square)));

    /* |N.d| / (2 t^2 |d|^3), as for a point at t d */
    return ql_real_scale(ql_real_mul(ql_real_from_u64(ql_abs64(facing)),
                                 ql_real_recip(below)),
            2 * QL_POS_BITS - 1);
}

/* Of a direction proportional to the cosine. */
static ql_real_t cosine_inverse(
        const ql_surface_t *surface, ql_vec3_t direction)
{
    const ql_real_t cosine = ql_real_mul(ql_bsdf_cosine(surface, direction),
            ql_real_recip(ql_real_sqrt(ql_vec_square(direction))));

    return pi_times(ql_real_recip(cosine), 0);
}

ql_real_t ql_aim_inverse(const ql_scene_t *scene, const ql_surface_t *surface,
        const ql_ray_t *ray, const ql_blob_tri_t *tri, ql_uq30_t t)
{
    if (tri == NULL) {
#if QL_CFG_SKY_MAP
        if (scene->texels != NULL) {
            ql_uq32_t emission[3];
            ql_real_t inverse;

            ql_sky_radiance(scene, ray->direction, emission, &inverse);
            return inverse;
        }
#endif
        return cosine_inverse(surface, ray->direction);
    }
#if QL_CFG_SPHERES
    if (ql_scene_sphere(scene, tri) != NULL) {
        const ql_blob_sphere_t *sphere = ql_scene_sphere(scene, tri);
        const ql_vec3_t offset = ql_sphere_offset(sphere, ray->origin);

        return ql_sphere_side(sphere, offset) > 0
                       ? pi_times(cone_of(sphere, ql_vec_square(offset)), 1)
                       : cosine_inverse(surface, ray->direction);
    }
#endif
    return triangle_inverse(scene, ray, tri, t);
}
#endif
