/* ql_surface.h - a point on a surface, and the normals there */
/* SPDX-License-Identifier: MIT */

#ifndef QL_SURFACE_H
#define QL_SURFACE_H

#include "math/vec/ql_vec.h"

/* Steps of a position that bring a point to its side, at most; see
 * ql_surface_at(). */
#define QL_SIDE_STEPS_MAX 4

/* A point on a surface, moved to the side it was seen from. The normal n
 * decides sides, exactly: of a triangle e1 x e2, of a sphere the vector between
 * centre and p in 1/256 grid units; turned to the side it was seen from. Of a
 * lifted point it is the shading normal in s2.29. */
typedef struct {
    ql_vec3_t p;    /* ql_pos_t: strictly on the side of n */
    ql_vec3_t n;    /* exact, |n| < 2^31 */
    uint32_t inv_n; /* 1/|n|, packed as in ql_blob_tri_t */
    /* is there a shading normal that is not n; if so, it, a unit vector in
     * s2.29 with shade.n > 0 */
    QL_IF_BUILT(QL_CFG_SMOOTH, bool smooth;)
    QL_IF_BUILT(QL_CFG_SMOOTH, ql_vec3_t shade;)
    /* pos: from p to the corners' tangent planes, see ql_smooth_lift(); only of
     * a smooth surface */
    QL_IF_BUILT(QL_CFG_SMOOTH, ql_vec3_t lift;)
} ql_surface_t;

/* ql_surface_is_smooth: does a surface have a shading normal of its own?
 * ql_surface_shade: that normal, s2.29; only of a smooth surface. */
#if QL_CFG_SMOOTH
QL_INLINE bool ql_surface_is_smooth(const ql_surface_t *surface)
{
    return surface->smooth;
}

QL_INLINE ql_vec3_t ql_surface_shade(const ql_surface_t *surface)
{
    return surface->shade;
}
#else
QL_INLINE bool ql_surface_is_smooth(const ql_surface_t *surface)
{
    (void)surface;
    return false;
}

QL_INLINE ql_vec3_t ql_surface_shade(const ql_surface_t *surface)
{
    return surface->n;
}
#endif

#endif
