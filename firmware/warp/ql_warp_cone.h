/* ql_warp_cone.h - uniform directions of a cone, the cone of a sphere */
/* SPDX-License-Identifier: MIT */

#ifndef QL_WARP_CONE_H
#define QL_WARP_CONE_H

#include "math/vec/ql_vec.h"

/* How wide a sphere looks: the s_max of the cone that touches it.
 *
 *   ratio2  real  R^2 / d^2 of its radius and its centre's distance
 *   return  real  1 - cos(theta_max) = 1 - sqrt(1 - R^2 / d^2) in [0, 1]; 1, a
 *           hemisphere, for ratio2 >= 1: on the sphere or inside
 *
 * Error: relative, 2^-27, for however small or wide a sphere; none that comes
 *        from cancelling.
 * Cost:  one square root, one reciprocal.
 * From:  1 - sqrt(1 - x) = x / (1 + sqrt(1 - x)).
 */
ql_real_t ql_warp_cone_of_sphere(ql_real_t ratio2);

/* Uniform on the cone about z; pdf 1/(2 pi s_max) per solid angle.
 *
 *   s_max   real   1 - cos(theta_max) in (0, 1]; 0 gives the axis, above
 *                  1 directions end at the horizon
 *   u1, u2  uq32   uniform
 *   return  s2.29  unit vector: 1 - z = u1 s_max, azimuth 2 pi u2; z >= 0
 *
 * Error: z to nearest; x, y to nearest and the errors of square root and sine,
 *        so length within 2.4e-5 (draft) or 5e-9 (fine) of 1. In a narrow cone
 *        x and y have an absolute error of 2^-30.
 * Cost:  one square root, one sine and cosine, four multiplications.
 * From:  GI (34), its r2 stretched from the axis: 1 - u s_max.
 */
ql_vec3_t ql_warp_cone(ql_real_t s_max, ql_uq32_t u1, ql_uq32_t u2);

/* Density of ql_warp_cone() inside the cone, per solid angle.
 *
 *   s_max   real  1 - cos(theta_max)
 *   return  1 / (2 pi s_max); 0 for 0, where it is infinite
 *
 * Error: relative, 2^-28.
 * Cost:  one reciprocal.
 */
ql_real_t ql_warp_cone_pdf(ql_real_t s_max);

#endif
