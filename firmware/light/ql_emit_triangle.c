/* ql_emit_triangle.c - a point of its area, or uniform on it as seen */
/* SPDX-License-Identifier: MIT */

#include "light/ql_emit_triangle.h"

#include "base/ql_diag.h"
#include "light/ql_light.h"
#include "math/vec/ql_vec_unit.h"
#include "warp/ql_warp_plane.h"
#include "warp/ql_warp_spherical.h"

/* ---- A point of its area ----------------------------------------------- */

/* v + b1 e1 + b2 e2 along one axis, to nearest. The weights add up to less than
 * 1 and the edges are < 2^15, so the sum is < 2^31 (draft) or 2^47. */
#if QL_POS_BITS == 0
QL_FAST_INLINE ql_pos_t blend(
        int32_t v, int32_t e1, int32_t e2, uint32_t b1, uint32_t b2)
{
    /* b <= 65535: |b e| < 2^31; the sum lies between two box coordinates */
    const int32_t sum = ql_i32((uint32_t)e1 * b1 + (uint32_t)e2 * b2);

    return v + ql_asr32(ql_asr32(sum, QL_BARY_BITS - 1) + 1, 1);
}
#else
QL_FAST_INLINE ql_pos_t blend(
        int32_t v, int32_t e1, int32_t e2, uint32_t b1, uint32_t b2)
{
    const int64_t sum = (int64_t)e1 * b1 + (int64_t)e2 * b2;

    return v * (1 << QL_POS_BITS) +
           (int32_t)ql_asr64(
                   ql_asr64(sum, QL_BARY_BITS - QL_POS_BITS - 1) + 1, 1);
}
#endif

void ql_emit_triangle_point(const ql_scene_t *scene, uint16_t light,
        ql_uniform2_t u, ql_emit_point_t *point)
{
    const ql_blob_tri_t *tri = ql_light_triangle(scene, light);
    const ql_edges_t t = ql_scene_edges(scene, tri);
    uint32_t b1, b2;

    ql_warp_plane_triangle(u.u1, u.u2, &b1, &b2);
    point->q.x = blend(t.v0.x, t.e1.x, t.e2.x, b1, b2);
    point->q.y = blend(t.v0.y, t.e1.y, t.e2.y, b1, b2);
    point->q.z = blend(t.v0.z, t.e1.z, t.e2.z, b1, b2);
    point->corner = t.v0;
    ql_vec_cross_ptr(&point->n, &t.e1, &t.e2);
    point->material = ql_scene_material(scene, tri);
}

/* A cos' / r^2, of twice the area: 1 / pdf per solid angle.
 *
 *   facing  -  2 A cos' times a length
 *   below   -  r^2 times that length; lengths carry f bits
 */
static ql_real_t area_inv_pdf(uint64_t facing, ql_real_t below)
{
    return ql_real_scale(ql_real_mul_call(ql_real_from_uq_call(facing, 0),
                                 ql_real_recip_call(below)),
            2 * QL_POS_BITS - 1);
}

static bool sample_triangle(const ql_scene_t *scene, uint16_t light,
        const ql_surface_t *surface, ql_uniform2_t u, ql_emit_sample_t *sample)
{
    ql_emit_point_t point;
    ql_real_t square, length;
    ql_vec3_t w;
    const uint64_t facing =
            ql_emit_triangle_facing(scene, light, surface->p, u, &point, &w);

    if (facing == 0) {
        return false;
    }
    square = ql_vec_square(w);
    length = ql_real_sqrt(square);
    sample->wi = ql_vec_unit_q29_of_length(w, length);
    sample->cosine =
            ql_real_mul(ql_shading_cosine(surface, w), ql_real_recip(length));
    sample->inv_pdf = area_inv_pdf(facing, ql_real_mul(square, length));
    sample->to = point.q;
    return sample->cosine.m != 0;
}

ql_real_t ql_emit_triangle_inv_pdf(const ql_scene_t *scene, const ql_ray_t *ray,
        const ql_blob_tri_t *tri, ql_uq30_t t)
{
    const ql_edges_t e = ql_scene_edges(scene, tri);
    const int64_t facing =
            ql_vec_dot_normal(ray->direction, ql_vec_cross(e.e1, e.e2));
    const ql_real_t way = ql_real_from_uq_call(t, 30);
    const ql_real_t square = ql_vec_square(ray->direction);

    /* |N.d| / (2 t^2 |d|^3), as for a point at t d */
    return area_inv_pdf(ql_abs64(facing),
            ql_real_mul_call(ql_real_mul_call(way, way),
                    ql_real_mul_call(square, ql_real_sqrt(square))));
}

/* ---- Uniform on it as seen --------------------------------------------- */

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
    /* n.w < 2^31 2^29. Where w leads through the plane n.w is not 0; where w is
     * nearly along it, any point of the box will do */
    const ql_real_t ratio = ql_real_mul(ql_real_from_u64(height),
            ql_real_recip(ql_real_from_u64(ql_abs64(ql_vec_dot(n, w)) | 1u)));
    ql_vec3_t q;

    q.x = clamp_to(p.x + stretch(w.x, ratio), v[0].x, v[1].x, v[2].x);
    q.y = clamp_to(p.y + stretch(w.y, ratio), v[0].y, v[1].y, v[2].y);
    q.z = clamp_to(p.z + stretch(w.z, ratio), v[0].z, v[1].z, v[2].z);
    (void)ql_surface_step(&q, &v[0], &n);
    return q;
}

/* What came of a try to draw by solid angle. */
typedef enum {
    SEEN_DRAWN,
    SEEN_NOTHING, /* nothing comes from there */
    SEEN_BADLY    /* the triangle is too small or too large for that */
} seen_t;

static seen_t sample_solid_angle(const ql_scene_t *scene,
        const ql_blob_tri_t *tri, const ql_surface_t *surface, ql_uniform2_t u,
        ql_emit_sample_t *sample)
{
    ql_vec3_t v[3], n;
    ql_warp_spherical_t seen;
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
        return SEEN_NOTHING;
    }
    QL_COUNT(corners);
    if (!ql_warp_spherical_begin(&seen, corner_from(v[0], surface->p),
                corner_from(v[1], surface->p), corner_from(v[2], surface->p))) {
        return SEEN_BADLY;
    }
    QL_COUNT(spherical);
    if (!ql_emit_set_wi(
                sample, surface, ql_warp_spherical(&seen, u.u1, u.u2))) {
        return SEEN_NOTHING;
    }
    sample->inv_pdf = seen.solid_angle;
    sample->to = meet_plane(surface->p, sample->wi, v, n, (uint64_t)height);
    return SEEN_DRAWN;
}

/* ---- By either --------------------------------------------------------- */

bool ql_emit_triangle_sample(const ql_scene_t *scene, ql_direct_t direct,
        uint16_t light, const ql_surface_t *surface, ql_uniform2_t u,
        ql_emit_sample_t *sample)
{
    if (ql_direct_is(direct, QL_DIRECT_SOLID_ANGLE)) {
        const seen_t seen = sample_solid_angle(
                scene, ql_light_triangle(scene, light), surface, u, sample);

        if (seen != SEEN_BADLY) {
            return seen == SEEN_DRAWN;
        }
    }
    return sample_triangle(scene, light, surface, u, sample);
}
