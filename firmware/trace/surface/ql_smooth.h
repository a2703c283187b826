/* ql_smooth.h - shading normals, and points lifted to where they belong */
/* SPDX-License-Identifier: MIT */

#ifndef QL_SMOOTH_H
#define QL_SMOOTH_H

#include "scene/ql_ray.h"
#include "scene/ql_scene.h"
#include "scene/ql_surface.h"

#if QL_CFG_SMOOTH
/* A surface without a shading normal of its own. */
QL_INLINE void ql_smooth_none(ql_surface_t *surface)
{
    surface->smooth = false;
}

/* Interpolate the corner normals at a hit.
 *
 *   scene    -  has corner normals
 *   tri      -  the triangle that was hit
 *   ray      -  the ray
 *   front    -  ql_hit_t's
 *   surface  -  its p and n are set; smooth, shade and lift are changed, on the
 *               side it was seen from, unless a corner has no normal or the
 *               interpolated one is not above the surface
 *
 * Error: see ql_surface_at().
 */
void ql_smooth_at(const ql_scene_t *scene, const ql_blob_tri_t *tri,
        const ql_ray_t *ray, bool front, ql_surface_t *surface);

/* Lift a point of a smooth surface to where the surface that it stands for
 * would be, so that a facet that turns away from light before its normals do is
 * not black.
 *
 *   scene    -  open
 *   surface  -  from ql_surface_at(); a point that is lifted has the shading
 *               normal as its normal n, and is no longer smooth
 *
 * The lift is the sum of w_i ((v_i - p).n_i) n_i over the corners v_i, their
 * unit normals n_i and their weights w_i: the way from p to the tangent planes
 * of the corners. It is 0 on a plane, whatever the normal. A hollow surface is
 * left as it is: the lift would lead below it. So is a point whose lift, twice
 * as long, meets anything: p and the lifted point, in the middle of that
 * segment, are never on two sides of a surface.
 * Error: of the lift, 1 position unit a component (tests/unit/test_smooth.c);
 *        near the faces of the box it is cut so that twice of it stays inside.
 * Cost:  an occluded segment, which no diag counts.
 * From:  Hanika, Hacking the Shadow Terminator, Ray Tracing Gems II, 2021;
 *        the sum of projections is that of Boubekeur and Alexa, Phong
 *        Tessellation, 2008.
 */
void ql_smooth_lift(const ql_scene_t *scene, ql_surface_t *surface);
#else
QL_INLINE void ql_smooth_none(ql_surface_t *surface)
{
    (void)surface;
}

QL_INLINE void ql_smooth_at(const ql_scene_t *scene, const ql_blob_tri_t *tri,
        const ql_ray_t *ray, bool front, ql_surface_t *surface)
{
    (void)scene, (void)tri, (void)ray, (void)front, (void)surface;
}

QL_INLINE void ql_smooth_lift(const ql_scene_t *scene, ql_surface_t *surface)
{
    (void)scene, (void)surface;
}
#endif

#endif
