/* ql_tri.h - ray against triangle, exact, so watertight with no epsilon */
/* SPDX-License-Identifier: MIT */

/* With s = origin - v0, N = e1 x e2 and det = -d.N, Cramer's rule gives the
 * barycentrics u = U/det, v = V/det and the parameter t = T/det with
 *     U = (s x d).e2    V = -(s x d).e1    T = s.N
 * all of them integers. The ray hits iff U, V and det - U - V have det's sign
 * or are zero and T has it. No rounding takes place, so two triangles that
 * share an edge see exactly opposite signs along it: no ray passes between.
 *
 * Bounds, M = 32767, f = QL_POS_BITS: |s|, |w| <= M 2^f and |e| <= M in every
 * component; |d| <= 2^b. Positions and segment ends lie in the box.
 *     |N| <= M^2 < 2^30 a component
 *     |s x d| <= 2 M 2^f 2^b < 2^(16+f+b)            draft 2^31, fine 2^46
 *     segments in fine: |s x d| <= 2 (M 2^f)^2 < 2^47
 *     |U|, |V|: a ray: 4 M^2 2^(f+b) < 2^(32+f+b)    draft 2^47, fine 2^62
 *               a segment: 6 volumes of a tetrahedron in the box, 2 M^3 2^2f
 *               < 2^(46+2f)                          draft 2^46, fine 2^62
 *     |det| 2^f, |U + V| <= |det| 2^f: det is checked against each in turn
 *     |T| <= 2 M^3 2^f < 2^(46+f) */

#ifndef QL_TRI_H
#define QL_TRI_H

#include "scene/ql_ray.h"
#include "scene/ql_scene.h"

/* Edges and origin offset of one triangle as seen from a ray. */
typedef struct {
    ql_vec3_t s;  /* origin - v0, ql_pos_t */
    ql_edges_t t; /* grid units */
} ql_tri_frame_t;

QL_INLINE void ql_tri_frame(ql_tri_frame_t *f, const ql_scene_t *scene,
        const ql_blob_tri_t *tri, ql_vec3_t origin)
{
    f->t = ql_scene_edges(scene, tri);
    f->s.x = origin.x - f->t.v0.x * (1 << QL_POS_BITS);
    f->s.y = origin.y - f->t.v0.y * (1 << QL_POS_BITS);
    f->s.z = origin.z - f->t.v0.z * (1 << QL_POS_BITS);
}

#if QL_POS_BITS == 0 && !QL_PORT_WIDE_MUL && !QL_CFG_SMALL
/* Whether a.b and c.b certainly have the same sign, from the high halves of b:
 * they leave less than 3 2^31 out of the product, 3 2^15 of the sum here. Saves
 * two exact products for most misses where a product is put together. */
QL_INLINE bool same_sign_coarse(ql_vec3_t a, ql_vec3_t c, ql_vec3_t b)
{
    const int32_t hx = ql_asr32(b.x, 16);
    const int32_t hy = ql_asr32(b.y, 16);
    const int32_t hz = ql_asr32(b.z, 16);
    const int32_t first = ql_i32(
            (uint32_t)(a.x * hx) + (uint32_t)(a.y * hy) + (uint32_t)(a.z * hz));
    const int32_t second = ql_i32(
            (uint32_t)(c.x * hx) + (uint32_t)(c.y * hy) + (uint32_t)(c.z * hz));

    return (first > 98304 && second > 98304) ||
           (first < -98304 && second < -98304);
}
#endif

/* (s x d).e for both edges; false if they have the same sign for certain. */
QL_INLINE bool ql_tri_edges(
        const ql_tri_frame_t *f, ql_vec3_t d, int64_t *u, int64_t *minus_v)
{
#if QL_POS_BITS == 0
    ql_vec3_t q;

    ql_vec_cross_ptr(&q, &f->s, &d);
#if !QL_PORT_WIDE_MUL && !QL_CFG_SMALL
    if (same_sign_coarse(f->t.e1, f->t.e2, q)) {
        return false;
    }
#endif
    *u = ql_vec_dot_normal_ptr(&f->t.e2, &q);
    *minus_v = ql_vec_dot_normal_ptr(&f->t.e1, &q);
#else
    const int64_t qx = (int64_t)f->s.y * d.z - (int64_t)f->s.z * d.y;
    const int64_t qy = (int64_t)f->s.z * d.x - (int64_t)f->s.x * d.z;
    const int64_t qz = (int64_t)f->s.x * d.y - (int64_t)f->s.y * d.x;

    *u = qx * f->t.e2.x + qy * f->t.e2.y + qz * f->t.e2.z;
    *minus_v = qx * f->t.e1.x + qy * f->t.e1.y + qz * f->t.e1.z;
#endif
#if QL_CFG_SMALL
    return true; /* ql_tri_hit() asks again */
#else
    return (*u <= 0 || *minus_v <= 0) && (*u >= 0 || *minus_v >= 0);
#endif
}

/* Where the line of a ray crosses a triangle.
 *
 *   scene    -    open
 *   tri      -    one of its triangles
 *   ray      -    origin in the box
 *   det, t   -    out, if it does: t / det is the ray parameter; det > 0
 *   return   0 no hit, 1 from the front, -1 from the back
 *
 * Exact. Hits need t > 0; a ray in the triangle's plane never hits it. Points
 * on an edge or corner hit every triangle that shares it.
 */
QL_INLINE int ql_tri_hit(const ql_scene_t *scene, const ql_blob_tri_t *tri,
        const ql_ray_t *ray, uint64_t *det_out, uint64_t *t_out)
{
    ql_tri_frame_t f;
    ql_vec3_t n;
    int64_t u, minus_v, det, limit, t;

    ql_tri_frame(&f, scene, tri, ray->origin);
    if (!ql_tri_edges(&f, ray->direction, &u, &minus_v)) {
        return 0; /* u and v have opposite signs */
    }
    ql_vec_cross_ptr(&n, &f.t.e1, &f.t.e2);
    det = -ql_vec_dot_normal_ptr(&ray->direction, &n);
    if (det < 0) {
        u = -u;
        minus_v = -minus_v;
    }
    limit = (int64_t)(ql_abs64(det) << QL_POS_BITS);
    if (u < 0 || minus_v > 0 || u > limit || -minus_v > limit - u) {
        return 0;
    }
    t = ql_vec_dot_normal_ptr(&f.s, &n);
    if (det < 0) {
        t = -t;
    }
    if (t <= 0 || det == 0) {
        return 0;
    }
    *det_out = ql_abs64(det);
    *t_out = (uint64_t)t;
    return det > 0 ? 1 : -1;
}

#endif
