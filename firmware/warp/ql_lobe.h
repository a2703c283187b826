/* ql_lobe.h - directions about an axis: hemisphere, cos^m, cone; densities */
/* SPDX-License-Identifier: MIT */

/* "GI" is Dutre's Global Illumination Compendium (2003). Directions come in a
 * local frame whose z is the axis; ql_frame_to_world() turns them. How far one
 * is from the axis is kept as s = 1 - cos(theta), never as the cosine, because
 * near the axis the cosine has no bits left; sin^2(theta) = s (2 - s). A
 * uniform number stands for the midpoint of its interval, so every warp keeps
 * off the horizon and off the axis as far as its formats allow. */

#ifndef QL_LOBE_H
#define QL_LOBE_H

#include "math/ql_real.h"
#include "math/ql_vec.h"

/* 1 / (2 pi), u0.32. */
#define QL_INV_2PI_UQ32 0x28be60dcu

/* Uniform on the hemisphere; pdf 1/(2 pi) per solid angle.
 *
 *   u1, u2  uq32   uniform
 *   return  s2.29  unit vector: z = u1 in [0, 1], azimuth 2 pi u2
 *
 * Error: z to nearest; length within 2.4e-5 (draft) or 5e-9 (fine) of 1.
 * Cost:  one square root, one sine and cosine, three multiplications.
 * From:  GI (34); 1 - z is exact, so sin^2 = (1 - z)(1 + z) does not cancel.
 */
ql_vec3_t ql_warp_uniform_hemisphere(ql_uq32_t u1, ql_uq32_t u2);

/* Density of ql_warp_uniform_hemisphere(), per solid angle.
 *
 *   return  uq32  1/(2 pi)
 */
QL_INLINE ql_uq32_t ql_warp_uniform_hemisphere_pdf(void)
{
    return QL_INV_2PI_UQ32;
}

/* NOT uniform: polar angle and azimuth drawn evenly, which crowds the pole.
 * For showing why that is wrong, or, divided by its density, that it is not.
 *
 *   u1, u2  uq32   uniform
 *   return  s2.29  unit vector: polar angle u1 pi/2, azimuth 2 pi u2; z >= 0
 *
 * Error: length within 4.5e-5 (draft) or 5e-9 (fine) of 1.
 * Cost:  two sines and cosines.
 */
ql_vec3_t ql_warp_naive_hemisphere(ql_uq32_t u1, ql_uq32_t u2);

/* Density of ql_warp_naive_hemisphere(), per solid angle.
 *
 *   w       s2.29  unit vector
 *   return  1 / (pi^2 sin(theta)); 0 at the pole, where it is infinite, and
 *           below the horizon
 *
 * Error: relative, 2^-15 (draft) or 2^-27 (fine); that x and y are themselves
 *        rounded comes on top.
 * Cost:  one reciprocal root, two multiplications to 64 bits, one more.
 */
ql_real_t ql_warp_naive_hemisphere_pdf(ql_vec3_t w);

/* Cosine-distributed about z; pdf cos(theta)/pi per solid angle.
 *
 *   u1, u2  uq32   uniform
 *   return  s2.29  unit vector: z = sqrt(1 - u1) > 0, azimuth 2 pi u2
 *
 * The direction of ql_warp_cosine_hemisphere() about (0, 0, 1), normalised.
 *
 * Error: length within 2.4e-5 (draft) or 5e-9 (fine) of 1.
 * Cost:  two square roots, one sine and cosine.
 * From:  GI (35) with 1 - u1 for its r2.
 */
ql_vec3_t ql_warp_cosine_lobe(ql_uq32_t u1, ql_uq32_t u2);

/* Density of ql_warp_cosine_lobe(), per solid angle.
 *
 *   z       s2.29  cosine to the axis, in [-1, 1]
 *   return  uq32   z / pi; 0 below the horizon
 *
 * Error: 2 ulp, downwards.
 */
ql_uq32_t ql_warp_cosine_lobe_pdf(ql_q29_t z);

/* What ql_warp_power_lobe() needs of its exponent, worked out once.
 *
 *   power   uq16  m, any: 0 is uniform, 1 the cosine, 65535 nearly a mirror
 *   return  1 / (m + 1)
 *
 * Error: relative, 2^-29.
 */
ql_real_t ql_lobe_inverse(ql_uq16_t power);

/* Distributed as cos^m about z; pdf (m + 1)/(2 pi) cos^m(theta) per solid
 * angle.
 *
 *   inverse  -      ql_lobe_inverse(m)
 *   u1, u2   uq32   uniform
 *   s        uq31   out: 1 - cos(theta) in [0, 1]; not NULL
 *   return   s2.29  unit vector: z = u1^(1/(m + 1)) >= 0, azimuth 2 pi u2
 *
 * Error: s relative, 2^-24, then to nearest; length within 2.4e-5 (draft) or
 *        5.1e-8 (fine) of 1. The x and y of the vector are worked out from
 *        the s before rounding.
 * Cost:  a logarithm, a power of two, a square root, a sine and cosine: about
 *        25 multiplications, three look-ups more than those of the last two.
 * From:  GI (36) as 1 - cos(theta) = 1 - 2^(log2(u1) / (m + 1)).
 */
ql_vec3_t ql_warp_power_lobe(
        ql_real_t inverse, ql_uq32_t u1, ql_uq32_t u2, ql_uq31_t *s);

/* Density of ql_warp_power_lobe(), per solid angle.
 *
 *   power   uq16  m
 *   s       uq31  1 - cos(theta)
 *   return  (m + 1)/(2 pi) (1 - s)^m; 0 for s >= 1, and below 2^-4096
 *
 * Error: relative, 2^-26 + m 2^-32 + 2^-29 m |log2(1 - s)|; that s is itself
 *        rounded is another m 2^-32.
 * Cost:  as the logarithm and power of two of ql_warp_power_lobe().
 */
ql_real_t ql_warp_power_lobe_pdf(ql_uq16_t power, ql_uq31_t s);

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
ql_real_t ql_cone_of_sphere(ql_real_t ratio2);

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
