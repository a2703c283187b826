/* ql_smooth.c - shading normals, interpolated between the corners */
/* SPDX-License-Identifier: MIT */

#include "trace/surface/ql_smooth.h"

#include "math/vec/ql_vec_unit.h"
#include "trace/ql_tri.h"

#if QL_CFG_SMOOTH

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

void ql_smooth_at(const ql_scene_t *scene, const ql_blob_tri_t *tri,
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
