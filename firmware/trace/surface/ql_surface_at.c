/* ql_surface_at.c - hit point, exact side correction, normal */
/* SPDX-License-Identifier: MIT */

#include "trace/surface/ql_surface_at.h"

#include "base/ql_diag.h"
#include "math/vec/ql_vec_unit.h"
#include "trace/surface/ql_smooth.h"
#include "trace/ql_sphere.h"
#include "trace/surface/ql_contact.h"

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

/* Where the ray gets to. */
QL_INLINE void point_at(const ql_ray_t *ray, ql_uq30_t t, ql_vec3_t *p)
{
    p->x = ray->origin.x + advance(ray->direction.x, t);
    p->y = ray->origin.y + advance(ray->direction.y, t);
    p->z = ray->origin.z + advance(ray->direction.z, t);
}

/* Set the point of a surface, its normal and 1/|n|, at hit->t; the point moves
 * to the side it was seen from. Returns true if nothing can be near it. */
static bool place(const ql_scene_t *scene, const ql_ray_t *ray,
        const ql_hit_t *hit, ql_surface_t *surface)
{
    const ql_blob_tri_t *tri = scene->triangles + hit->tri_idx;
    const ql_blob_sphere_t *sphere = ql_scene_sphere(scene, tri);
    ql_edges_t t;

    point_at(ray, hit->t, &surface->p);
    if (sphere != NULL) {
        ql_sphere_surface(sphere, hit->front, surface);
        return ql_contact_has_none(scene, hit->tri_idx);
    }
    t = ql_scene_edges(scene, tri);
    ql_vec_cross_ptr(&surface->n, hit->front ? &t.e1 : &t.e2,
            hit->front ? &t.e2 : &t.e1);
    surface->inv_n = QL_LE32(tri->inv_n);
    (void)ql_surface_step(&surface->p, &t.v0, &surface->n);
    return ql_contact_is_clear(
            scene, hit->tri_idx, &t, &surface->n, &surface->p);
}

/* Draw a point back along the ray, as far as it takes for nothing to be between
 * the ray's origin and it. */
static QL_NOINLINE void draw_back(const ql_scene_t *scene, const ql_ray_t *ray,
        const ql_hit_t *hit, ql_surface_t *surface)
{
    ql_hit_t at = *hit;
    uint32_t back = (uint32_t)1 << (31 - QL_DIR_BITS); /* one unit or two */

    while (at.t > 0 && !ql_contact_is_free(scene, &ray->origin, &surface->p,
                               (uint16_t)QL_TRI_MAX)) {
        at.t = back - 1 < at.t ? at.t - back : 0; /* back may get to 0 */
        back *= 2;
        (void)place(scene, ray, &at, surface);
    }
}

void ql_surface_at(const ql_scene_t *scene, const ql_ray_t *ray,
        const ql_hit_t *hit, ql_surface_t *surface)
{
    const ql_blob_tri_t *tri = scene->triangles + hit->tri_idx;

    if (!place(scene, ray, hit, surface)) {
        draw_back(scene, ray, hit, surface);
    }
    ql_smooth_none(surface);
    if (ql_scene_normals(scene) != NULL &&
            ql_scene_sphere(scene, tri) == NULL) {
        QL_COUNT(smooth);
        ql_smooth_at(scene, tri, ray, hit->front, surface);
    }
}

#if QL_CFG_GLASS
bool ql_surface_cross(const ql_scene_t *scene, uint16_t tri_idx,
        const ql_surface_t *surface, ql_vec3_t *p)
{
    const ql_blob_tri_t *tri = scene->triangles + tri_idx;
    const ql_blob_sphere_t *sphere = ql_scene_sphere(scene, tri);
    const ql_vec3_t back = ql_vec_neg(surface->n);
    ql_edges_t t;
    bool clear;

    *p = surface->p;
    if (sphere != NULL) {
        (void)ql_sphere_step(sphere, p,
                ql_sphere_side(sphere, ql_sphere_offset(sphere, *p)) < 0);
        clear = ql_contact_has_none(scene, tri_idx);
    } else {
        t = ql_scene_edges(scene, tri);
        (void)ql_surface_step(p, &t.v0, &back);
        clear = ql_contact_is_clear(scene, tri_idx, &t, &back, &surface->p);
    }
    return clear || ql_contact_is_free(scene, &surface->p, p, tri_idx);
}
#endif
