/* ql_shading.h - which way a surface faces: its unit normals, the cosine */
/* SPDX-License-Identifier: MIT */

/* A surface has two normals. The flat one, of its plane or sphere, decides
 * sides. The shading normal decides how much light arrives: it is interpolated
 * where the surface is smooth, and the flat one elsewhere. */

#ifndef QL_SHADING_H
#define QL_SHADING_H

#include "math/vec/ql_vec_unit.h"
#include "scene/ql_surface.h"

/* Unit flat normal.
 *
 *   surface  -      from ql_surface_at()
 *   return   s2.29  n / |n|
 */
QL_INLINE ql_vec3_t ql_shading_flat_normal(const ql_surface_t *surface)
{
    return ql_vec_unit_q29_of_inv_n(surface->n, surface->inv_n);
}

/* Is a rounded direction strictly above the surface? Exact.
 *
 *   surface  -      from ql_surface_at()
 *   w        dir_t  away from the surface
 */
QL_INLINE bool ql_shading_is_above(const ql_surface_t *surface, ql_vec3_t w)
{
    return ql_vec_dot_normal(w, surface->n) > 0;
}

/* Unit shading normal.
 *
 *   surface  -      from ql_surface_at()
 *   return   s2.29  its shade if it is smooth, else n / |n|
 */
QL_INLINE ql_vec3_t ql_shading_normal(const ql_surface_t *surface)
{
    return ql_surface_is_smooth(surface) ? ql_surface_shade(surface)
                                         : ql_shading_flat_normal(surface);
}

/* Cosine between a direction and the shading normal.
 *
 *   surface  -      from ql_surface_at()
 *   w        -      any integer vector, |w| < 2^30
 *   return   real   n.w of the unit shading normal n, in the units of w; 0 if
 *                   that is not above 0, or if w is not above surface->n
 *
 * Error: relative, 2^-26 of a flat surface, 2^-28 more of a sphere; of a smooth
 *        one 2^-28 |w|.
 */
ql_real_t ql_shading_cosine(const ql_surface_t *surface, ql_vec3_t w);

/* Cosine of the angle between a direction of any length and the shading normal.
 *
 *   surface  -      from ql_surface_at()
 *   w        dir_t  not zero
 *   return   real   in [0, 1]; 0 as for ql_shading_cosine()
 */
ql_real_t ql_shading_cosine_of_dir(const ql_surface_t *surface, ql_vec3_t w);

#endif
