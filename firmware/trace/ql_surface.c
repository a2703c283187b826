/* ql_surface.c - hit point, exact side correction, unit normal */
/* SPDX-License-Identifier: MIT */

#include "trace/ql_surface.h"

/* t d for t in u2.30, cut towards zero: below 2^(15+f) for hits in the box */
static int32_t advance(int32_t d, ql_uq30_t t)
{
    /* |d| <= 2^23 (2^15 in draft), so |d| << 8 fits; t |d| 2^8 >> 32 has
     * 2^6 of a unit to drop */
    const uint32_t step = ql_mulhi_u32(t, ql_abs32(d) << 8) >> 6;

    return d < 0 ? -(int32_t)step : (int32_t)step;
}

unsigned ql_surface_step(ql_vec3_t *p, ql_vec3_t on, ql_vec3_t n)
{
    uint32_t ax, ay, az;
    ql_vec3_t from_plane;
    int64_t side;
    unsigned steps = 0;

    from_plane.x = p->x - on.x * (1 << QL_POS_BITS);
    from_plane.y = p->y - on.y * (1 << QL_POS_BITS);
    from_plane.z = p->z - on.z * (1 << QL_POS_BITS);
    side = ql_vec_dot_n(from_plane, n);
    if (side > 0) {
        return 0; /* half of all points */
    }
    ax = ql_abs32(n.x);
    ay = ql_abs32(n.y);
    az = ql_abs32(n.z);
    while (side <= 0 && steps < QL_SIDE_STEPS_MAX) {
        if (ax >= ay && ax >= az) {
            p->x += n.x < 0 ? -1 : 1;
            side += ax;
        } else if (ay >= az) {
            p->y += n.y < 0 ? -1 : 1;
            side += ay;
        } else {
            p->z += n.z < 0 ? -1 : 1;
            side += az;
        }
        steps++;
    }
    return steps;
}

void ql_surface_at(const ql_scene_t *scene, const ql_ray_t *ray,
        const ql_hit_t *hit, ql_surface_t *surface)
{
    const ql_blob_tri_t *tri = scene->triangles + hit->tri_idx;
    const ql_vec3_t v0 = ql_scene_corner(scene, tri, 0);
    const ql_vec3_t e1 = ql_vec_sub(ql_scene_corner(scene, tri, 1), v0);
    const ql_vec3_t e2 = ql_vec_sub(ql_scene_corner(scene, tri, 2), v0);

    surface->n = hit->front ? ql_vec_cross(e1, e2) : ql_vec_cross(e2, e1);
    surface->inv_n = QL_LE32(tri->inv_n);
    surface->p.x = ray->origin.x + advance(ray->direction.x, hit->t);
    surface->p.y = ray->origin.y + advance(ray->direction.y, hit->t);
    surface->p.z = ray->origin.z + advance(ray->direction.z, hit->t);
    (void)ql_surface_step(&surface->p, v0, surface->n);
}
