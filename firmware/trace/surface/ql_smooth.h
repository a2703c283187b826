/* ql_smooth.h - shading normals, interpolated between the corners */
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
 *   surface  -  its n is set; smooth and shade are changed, on the side it was
 *               seen from, unless a corner has no normal or the interpolated
 *               one is not above the surface
 *
 * Error: see ql_surface_at().
 */
void ql_smooth_at(const ql_scene_t *scene, const ql_blob_tri_t *tri,
        const ql_ray_t *ray, bool front, ql_surface_t *surface);
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
#endif

#endif
