/* ql_emit_triangle.h - directions towards a triangle: its area, or as seen */
/* SPDX-License-Identifier: MIT */

#ifndef QL_EMIT_TRIANGLE_H
#define QL_EMIT_TRIANGLE_H

#include "light/ql_emit_parts.h"
#include "trace/surface/ql_surface_at.h"

/* A point on an emitter. */
typedef struct {
    ql_vec3_t q;      /* ql_pos_t, on or within an ulp of the plane */
    ql_vec3_t corner; /* a corner of its triangle, grid units */
    ql_vec3_t n;      /* e1 x e2, exact: |n| is twice the area */
    const ql_blob_material_t *material;
} ql_emit_point_t;

/* Draw a uniform point on a light that is a triangle.
 *
 *   scene   -     has lights
 *   light   -     index of the light
 *   u       uq32  chooses the point
 *   point   -     out
 *
 * pdf: 1 / area per area. Error: the point within half an ulp in each
 * component.
 */
void ql_emit_triangle_point(const ql_scene_t *scene, uint16_t light,
        ql_uniform2_t u, ql_emit_point_t *point);

/* Draw a point of a triangle that may shine towards a surface.
 *
 *   scene   -     has lights
 *   light   -     index of one that is a triangle
 *   p       pos   of the surface
 *   u       uq32  chooses the point
 *   point   -     out: q stepped strictly in front, so that its own emitter
 *                 never hides it; n turned to the side of p
 *   w       pos   out: from p to point->q
 *   return  -     -n.w: the cosine at the emitter times |n| |w|; 0 if it faces
 *                 away
 */
QL_INLINE uint64_t ql_emit_triangle_facing(const ql_scene_t *scene,
        uint16_t light, ql_vec3_t p, ql_uniform2_t u, ql_emit_point_t *point,
        ql_vec3_t *w)
{
    int64_t facing;

    ql_emit_triangle_point(scene, light, u, point);
    *w = ql_vec_sub(point->q, p);
    if (ql_scene_two_sided(scene) && ql_vec_dot_normal(*w, point->n) > 0) {
        point->n = ql_vec_neg(point->n); /* |n| < 2^31 */
    }
    (void)ql_surface_step(&point->q, &point->corner, &point->n);
    *w = ql_vec_sub(point->q, p);
    facing = -ql_vec_dot_normal_ptr(w, &point->n);
    return facing > 0 ? (uint64_t)facing : 0;
}

/* Draw a direction towards a triangle.
 *
 *   scene    -     open
 *   direct   -     AREA or MIS: a uniform point; SOLID_ANGLE: uniform on the
 *                  triangle as seen, or a point where that is too small or
 *                  too large (ql_warp_spherical_begin())
 *   light    -     index of the light
 *   surface  -     to be lit
 *   u        uq32  chooses the direction
 *   sample   -     out, if true is returned: all but its emission
 *   return   false if nothing can come from there
 */
bool ql_emit_triangle_sample(const ql_scene_t *scene, ql_direct_t direct,
        uint16_t light, const ql_surface_t *surface, ql_uniform2_t u,
        ql_emit_sample_t *sample);

/* 1 / density that ql_emit_triangle_sample() with AREA or MIS has.
 *
 *   scene   -      open
 *   ray     -      from the surface
 *   tri     -      what it hit
 *   t       u2.30  where
 *   return  real   1 / pdf per solid angle
 */
ql_real_t ql_emit_triangle_inv_pdf(const ql_scene_t *scene, const ql_ray_t *ray,
        const ql_blob_tri_t *tri, ql_uq30_t t);

#endif
