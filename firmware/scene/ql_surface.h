/* ql_surface.h - a point on a surface, and the normals there */
/* SPDX-License-Identifier: MIT */

#ifndef QL_SURFACE_H
#define QL_SURFACE_H

#include "math/ql_vec.h"

/* A point on a surface, moved to the side it was seen from. The normal n
 * decides sides, exactly: of a triangle e1 x e2, of a sphere the vector between
 * centre and p in 1/256 grid units; turned to the side it was seen from. */
typedef struct {
    ql_vec3_t p;    /* ql_pos_t: strictly on the side of n */
    ql_vec3_t n;    /* exact, |n| < 2^31 */
    uint32_t inv_n; /* 1/|n|, packed as in ql_blob_tri_t */
#if QL_CFG_SMOOTH
    bool smooth;     /* the shading normal is not n */
    ql_vec3_t shade; /* s2.29: unit shading normal if smooth; shade.n > 0 */
#endif
} ql_surface_t;

/* Does its shading normal differ from its plane's? */
QL_INLINE bool ql_surface_is_smooth(const ql_surface_t *surface)
{
#if QL_CFG_SMOOTH
    return surface->smooth;
#else
    (void)surface;
    return false;
#endif
}

#endif
