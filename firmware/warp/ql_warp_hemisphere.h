/* ql_warp_hemisphere.h - directions of the hemisphere: cosine, uniform */
/* SPDX-License-Identifier: MIT */

#ifndef QL_WARP_HEMISPHERE_H
#define QL_WARP_HEMISPHERE_H

#include "math/vec/ql_vec.h"

/* Cosine-distributed about a normal; pdf cos(theta)/pi per solid angle.
 *
 *   n       s2.29  unit normal
 *   u1, u2  uq32   uniform
 *   return  s2.29  direction of length 2 cos(theta): n plus ql_warp_sphere()
 *
 * A point of the unit sphere that touches the surface is at polar angle
 * 2 theta seen from its centre; cos(theta) = sqrt(1 - u1) in the frame whose
 * axis is n, so this is GI (35) without a frame and without normalising. The
 * zero vector can come out: see ql_vec_to_dir().
 */
ql_vec3_t ql_warp_hemisphere_cosine(ql_vec3_t n, ql_uq32_t u1, ql_uq32_t u2);

/* Density of ql_warp_hemisphere_cosine(), per solid angle.
 *
 *   product  s.58  the vector it returned times the normal: 2 cos^2(theta),
 *                  which rounding may leave at 0 or less
 *   return   real  cos(theta) / pi, never 0
 *
 * Error: relative, 2^-28.
 * Cost:  one square root, one multiplication.
 */
ql_real_t ql_warp_hemisphere_cosine_pdf(int64_t product);

/* 1 / (2 pi), u0.32. */
#define QL_WARP_INV_2PI_UQ32 0x28be60dcu

/* Uniform on the hemisphere; pdf 1/(2 pi) per solid angle.
 *
 *   u1, u2  uq32   uniform
 *   return  s2.29  unit vector: z = u1 in [0, 1], azimuth 2 pi u2
 *
 * Error: z to nearest; length within 2.4e-5 (draft) or 5e-9 (fine) of 1.
 * Cost:  one square root, one sine and cosine, three multiplications.
 * From:  GI (34); 1 - z is exact, so sin^2 = (1 - z)(1 + z) does not cancel.
 */
ql_vec3_t ql_warp_hemisphere_uniform(ql_uq32_t u1, ql_uq32_t u2);

/* Density of ql_warp_hemisphere_uniform(), per solid angle.
 *
 *   return  uq32  1/(2 pi)
 */
QL_INLINE ql_uq32_t ql_warp_hemisphere_uniform_pdf(void)
{
    return QL_WARP_INV_2PI_UQ32;
}

#endif
