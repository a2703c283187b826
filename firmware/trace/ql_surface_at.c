/* ql_surface_at.c - hit point, exact side correction, unit normal */
/* SPDX-License-Identifier: MIT */

#include "trace/ql_surface_at.h"

#include "math/vec/ql_vec_unit.h"
#include "trace/ql_sphere.h"
#include "trace/ql_tri.h"

/* t d for t in u2.30, cut towards zero: below 2^(15+f) for hits in the box */
QL_FAST_INLINE int32_t advance(int32_t d, ql_uq30_t t)
{
    /* |d| <= 2^23 (2^15 in draft), so |d| << 8 fits; t |d| 2^8 >> 32 has
     * 2^6 of a unit to drop */
    const uint32_t step = ql_mulhi_u32(t, ql_abs32(d) << 8) >> 6;

    return d < 0 ? -(int32_t)step : (int32_t)step;
}

unsigned ql_surface_step(ql_vec3_t *p, const ql_vec3_t *on, const ql_vec3_t *n)
{
    const uint32_t ax = ql_abs32(n->x), ay = ql_abs32(n->y);
    const uint32_t az = ql_abs32(n->z);
    ql_vec3_t from_plane;
    int64_t side;
    ql_pos_t *at = &p->z;
    int32_t size = n->z;
    unsigned steps = 0;

    from_plane.x = p->x - on->x * (1 << QL_POS_BITS);
    from_plane.y = p->y - on->y * (1 << QL_POS_BITS);
    from_plane.z = p->z - on->z * (1 << QL_POS_BITS);
    side = ql_vec_dot_normal_ptr(&from_plane, n);
    if (side > 0) {
        return 0; /* half of all points */
    }
    if (ax >= ay && ax >= az) {
        at = &p->x;
        size = n->x;
    } else if (ay >= az) {
        at = &p->y;
        size = n->y;
    }
    while (side <= 0 && steps < QL_SIDE_STEPS_MAX) {
        *at += size < 0 ? -1 : 1;
        side += ql_abs32(size);
        steps++;
    }
    return steps;
}

#if QL_CFG_SPHERES
/* Step p along the dominant axis of its offset until it is strictly outside, or
 * strictly inside. Returns the offset there. */
static ql_vec3_t sphere_step(
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

static void surface_at_sphere(
        const ql_blob_sphere_t *sphere, bool outside, ql_surface_t *surface)
{
    const ql_vec3_t s = sphere_step(sphere, &surface->p, outside);

    surface->n = outside ? s : ql_vec_neg(s);
    surface->inv_n = ql_vec_unit_pack_inv_n((uint64_t)ql_vec_dot(s, s));
}
#endif

#if QL_CFG_SMOOTH
/* The normal of corner i, s0.15; false if there is none. */
static bool corner_normal(const ql_scene_t *scene, const ql_blob_tri_t *tri,
        unsigned i, ql_vec3_t *n)
{
    const ql_blob_normal_t *at = scene->normals + QL_LE16(tri->vertex[i]);

#if QL_CFG_PAGES
    at += (uint32_t)(QL_LE16(tri->material) >> 14) << 16;
#endif
    n->x = ql_i16(QL_LE16((uint16_t)at->xyz[0]));
    n->y = ql_i16(QL_LE16((uint16_t)at->xyz[1]));
    n->z = ql_i16(QL_LE16((uint16_t)at->xyz[2]));
    return (n->x | n->y | n->z) != 0;
}

/* Interpolate the corner normals at a hit, on the side it was seen from. */
static void smooth_at(const ql_scene_t *scene, const ql_blob_tri_t *tri,
        const ql_ray_t *ray, bool front, ql_surface_t *surface)
{
    ql_tri_frame_t f;
    ql_vec3_t n0, n1, n2;
    int64_t u, minus_v, w0, w1, w2, det;
    unsigned zeros;

    ql_tri_frame(&f, scene, tri, ray->origin);
    if (!corner_normal(scene, tri, 0, &n0) ||
            !corner_normal(scene, tri, 1, &n1) ||
            !corner_normal(scene, tri, 2, &n2) ||
            !ql_tri_edges(&f, ray->direction, &u, &minus_v)) {
        return;
    }
    /* U, V and det - U - V of ql_tri_hit(): all of them of one sign */
    w1 = (int64_t)ql_abs64(u);
    w2 = (int64_t)ql_abs64(minus_v);
    det = (int64_t)(ql_abs64(ql_vec_dot_normal(ray->direction, surface->n))
                    << QL_POS_BITS);
    w0 = det - w1 - w2;
    /* the weights to 31 bits: their sums with 16 bits are below 2^49 */
    zeros = ql_clz64((uint64_t)det);
    if (zeros < 33) {
        w0 = ql_asr64(w0, 33 - zeros);
        w1 >>= 33 - zeros;
        w2 >>= 33 - zeros;
    }
    if (!front) {
        w0 = -w0;
        w1 = -w1;
        w2 = -w2;
    }
    surface->shade = ql_vec_unit_q29_of_wide(w0 * n0.x + w1 * n1.x + w2 * n2.x,
            w0 * n0.y + w1 * n1.y + w2 * n2.y,
            w0 * n0.z + w1 * n1.z + w2 * n2.z);
    surface->smooth = ql_vec_dot(surface->shade, surface->n) > 0;
}
#endif

/* Where the ray gets to. */
QL_INLINE void point_at(const ql_ray_t *ray, ql_uq30_t t, ql_vec3_t *p)
{
    p->x = ray->origin.x + advance(ray->direction.x, t);
    p->y = ray->origin.y + advance(ray->direction.y, t);
    p->z = ray->origin.z + advance(ray->direction.z, t);
}

void ql_surface_at(const ql_scene_t *scene, const ql_ray_t *ray,
        const ql_hit_t *hit, ql_surface_t *surface)
{
    const ql_blob_tri_t *tri = scene->triangles + hit->tri_idx;
    ql_edges_t t;

#if QL_CFG_SMOOTH
    surface->smooth = false;
#endif
#if QL_CFG_SPHERES
    if (ql_scene_sphere(scene, tri) != NULL) {
        point_at(ray, hit->t, &surface->p);
        surface_at_sphere(ql_scene_sphere(scene, tri), hit->front, surface);
        return;
    }
#endif
    t = ql_scene_edges(scene, tri);
    ql_vec_cross_ptr(&surface->n, hit->front ? &t.e1 : &t.e2,
            hit->front ? &t.e2 : &t.e1);
    surface->inv_n = QL_LE32(tri->inv_n);
    point_at(ray, hit->t, &surface->p);
    (void)ql_surface_step(&surface->p, &t.v0, &surface->n);
#if QL_CFG_SMOOTH
    if (scene->normals != NULL) {
        smooth_at(scene, tri, ray, hit->front, surface);
    }
#endif
}

#if QL_CFG_GLASS
void ql_surface_cross(const ql_scene_t *scene, uint16_t tri_idx,
        const ql_surface_t *surface, ql_vec3_t *p)
{
    const ql_blob_tri_t *tri = scene->triangles + tri_idx;
    const ql_vec3_t back = ql_vec_neg(surface->n);
    ql_vec3_t corner;

    *p = surface->p;
#if QL_CFG_SPHERES
    const ql_blob_sphere_t *const sphere = ql_scene_sphere(scene, tri);
    if (sphere != NULL) {
        (void)sphere_step(sphere, p,
                ql_sphere_side(sphere, ql_sphere_offset(sphere, *p)) < 0);
        return;
    }
#endif
    corner = ql_scene_corner(scene, tri, 0);
    (void)ql_surface_step(p, &corner, &back);
}
#endif
