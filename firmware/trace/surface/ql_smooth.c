/* ql_smooth.c - shading normals, and points lifted to where they belong */
/* SPDX-License-Identifier: MIT */

#include "trace/surface/ql_smooth.h"

#include "math/ql_real.h"
#include "math/vec/ql_vec_unit.h"
#include "trace/ql_bvh.h"
#include "trace/ql_tri.h"

#if QL_CFG_SMOOTH

/* 1 / |n| of a unit vector in s2.29, packed. */
#define INV_N_OF_UNIT (0x80000000u | 29u)

/* The normal of corner i, s0.15; false if there is none. */
static bool corner_normal(const ql_scene_t *scene, const ql_blob_tri_t *tri,
        unsigned i, ql_vec3_t *n)
{
    const ql_blob_normal_t *at = scene->normals + QL_LE16(tri->vertex[i]);

    if (QL_CFG_PAGES) {
        at += (uint32_t)(QL_LE16(tri->material) >> 14) << 16;
    }
    n->x = ql_i16(QL_LE16((uint16_t)at->xyz[0]));
    n->y = ql_i16(QL_LE16((uint16_t)at->xyz[1]));
    n->z = ql_i16(QL_LE16((uint16_t)at->xyz[2]));
    return (n->x | n->y | n->z) != 0;
}

/* Add what a corner lifts p by, in position units with 21 more bits: the
 * corner's weight times the way from p to its tangent plane.
 *
 *   weight  u0.31  of the corner
 *   corner  grid   where it is
 *   n       s0.15  its normal, on the side that p was seen from */
static void add_lift(int64_t lift[3], uint32_t weight, ql_vec3_t corner,
        ql_vec3_t n, ql_vec3_t p)
{
    int64_t height, way;

    p.x -= corner.x * (1 << QL_POS_BITS);
    p.y -= corner.y * (1 << QL_POS_BITS);
    p.z -= corner.z * (1 << QL_POS_BITS);
    height = ql_vec_dot(p, n); /* 15 more bits; its size is below 3 2^38 */
    way = ql_mulhi_u32(weight, (uint32_t)(ql_abs64(height) >> 9) << 1);
    way = height < 0 ? way : -way; /* 6 more bits */
    lift[0] += way * n.x;
    lift[1] += way * n.y;
    lift[2] += way * n.z;
}

/* A component of the lift: twice of it does not leave the box. */
static int32_t cut_lift(int64_t lift, int32_t p)
{
    const int32_t room = ((int32_t)QL_GRID_MAX * (1 << QL_POS_BITS) - p) / 2;
    const int64_t rounded = ql_asr64(lift + (1l << 20), 21);

    return rounded > room     ? room
           : rounded < -p / 2 ? -(p / 2)
                              : (int32_t)rounded; /* |.| < 2^23 */
}

/* The lift of surface->p, from the corners' weights w, below 2^31. */
static void set_lift(ql_surface_t *surface, const ql_edges_t *t,
        const int64_t w[3], const ql_vec3_t n[3])
{
    const uint32_t sum = (uint32_t)(w[0] + w[1] + w[2]); /* <= det < 2^31 */
    const unsigned zeros = ql_clz32(sum);
    const uint32_t per = ql_recip_m(sum << zeros); /* 2^63 / that */
    const ql_vec3_t v[3] = {t->v0,
            {t->v0.x + t->e1.x, t->v0.y + t->e1.y, t->v0.z + t->e1.z},
            {t->v0.x + t->e2.x, t->v0.y + t->e2.y, t->v0.z + t->e2.z}};
    int64_t lift[3] = {0, 0, 0};

    for (unsigned i = 0; i < 3; i++) {
        add_lift(lift, ql_mulhi_u32((uint32_t)w[i] << zeros, per), v[i], n[i],
                surface->p);
    }
    surface->lift.x = cut_lift(lift[0], surface->p.x);
    surface->lift.y = cut_lift(lift[1], surface->p.y);
    surface->lift.z = cut_lift(lift[2], surface->p.z);
}

void ql_smooth_at(const ql_scene_t *scene, const ql_blob_tri_t *tri,
        const ql_ray_t *ray, bool front, ql_surface_t *surface)
{
    ql_tri_frame_t f;
    ql_vec3_t n[3];
    int64_t u, minus_v, w[3], det;
    unsigned zeros;

    ql_tri_frame(&f, scene, tri, ray->origin);
    for (unsigned i = 0; i < 3; i++) {
        if (!corner_normal(scene, tri, i, n + i)) {
            return;
        }
        if (!front) {
            n[i] = ql_vec_neg(n[i]);
        }
    }
    if (!ql_tri_edges(&f, ray->direction, &u, &minus_v)) {
        return;
    }
    /* U, V and det - U - V of ql_tri_hit(): all of them of one sign */
    w[1] = (int64_t)ql_abs64(u);
    w[2] = (int64_t)ql_abs64(minus_v);
    det = (int64_t)(ql_abs64(ql_vec_dot_normal(ray->direction, surface->n))
                    << QL_POS_BITS);
    w[0] = det - w[1] - w[2];
    /* the weights to 31 bits: their sums with 16 bits are below 2^49 */
    zeros = ql_clz64((uint64_t)det);
    if (zeros < 33) {
        w[0] = ql_asr64(w[0], 33 - zeros);
        w[1] >>= 33 - zeros;
        w[2] >>= 33 - zeros;
    }
    surface->shade = ql_vec_unit_q29_of_wide(
            w[0] * n[0].x + w[1] * n[1].x + w[2] * n[2].x,
            w[0] * n[0].y + w[1] * n[1].y + w[2] * n[2].y,
            w[0] * n[0].z + w[1] * n[1].z + w[2] * n[2].z);
    surface->smooth = ql_vec_dot(surface->shade, surface->n) > 0;
    if (surface->smooth) {
        set_lift(surface, &f.t, w, n);
    }
}

void ql_smooth_lift(const ql_scene_t *scene, ql_surface_t *surface)
{
    const ql_vec3_t lift = surface->lift;
    ql_ray_t twice;

    if (!surface->smooth || ql_vec_dot_normal(lift, surface->n) <= 0) {
        return;
    }
    twice.origin = surface->p;
    twice.direction.x = 2 * lift.x;
    twice.direction.y = 2 * lift.y;
    twice.direction.z = 2 * lift.z;
    if (ql_bvh_occluded(scene, &twice)) {
        return;
    }
    surface->p.x += lift.x;
    surface->p.y += lift.y;
    surface->p.z += lift.z;
    surface->n = surface->shade;
    surface->inv_n = INV_N_OF_UNIT;
    surface->smooth = false;
}

#endif
