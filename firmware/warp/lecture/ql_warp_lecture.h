/* ql_warp_lecture.h - warps that explain, and that the renderer does not use */
/* SPDX-License-Identifier: MIT */

/* Nothing in the core calls these, and no firmware holds a byte of them: they
 * are here for qlux-warp and the tests. One shows a mistake, one is the
 * textbook's form of ql_warp_hemisphere_cosine(), one a filter of pixels. */

#ifndef QL_WARP_LECTURE_H
#define QL_WARP_LECTURE_H

#include "math/vec/ql_vec.h"

/* NOT uniform: polar angle and azimuth drawn evenly, which crowds the pole.
 * For showing why that is wrong, or, divided by its density, that it is not.
 *
 *   u1, u2  uq32   uniform
 *   return  s2.29  unit vector: polar angle u1 pi/2, azimuth 2 pi u2; z >= 0
 *
 * Error: length within 4.5e-5 (draft) or 5e-9 (fine) of 1.
 * Cost:  two sines and cosines.
 */
ql_vec3_t ql_warp_lecture_naive(ql_uq32_t u1, ql_uq32_t u2);

/* Density of ql_warp_lecture_naive(), per solid angle.
 *
 *   w       s2.29  unit vector
 *   return  1 / (pi^2 sin(theta)); 0 at the pole, where it is infinite, and
 *           below the horizon
 *
 * Error: relative, 2^-15 (draft) or 2^-27 (fine); that x and y are themselves
 *        rounded comes on top.
 * Cost:  one reciprocal root, two multiplications to 64 bits, one more.
 */
ql_real_t ql_warp_lecture_naive_pdf(ql_vec3_t w);

/* Cosine-distributed about z; pdf cos(theta)/pi per solid angle.
 *
 *   u1, u2  uq32   uniform
 *   return  s2.29  unit vector: z = sqrt(1 - u1) > 0, azimuth 2 pi u2
 *
 * The direction of ql_warp_hemisphere_cosine() about (0, 0, 1), normalised.
 *
 * Error: length within 2.4e-5 (draft) or 5e-9 (fine) of 1.
 * Cost:  two square roots, one sine and cosine.
 * From:  GI (35) with 1 - u1 for its r2.
 */
ql_vec3_t ql_warp_lecture_cosine(ql_uq32_t u1, ql_uq32_t u2);

/* Density of ql_warp_lecture_cosine(), per solid angle.
 *
 *   z       s2.29  cosine to the axis, in [-1, 1]
 *   return  uq32   z / pi; 0 below the horizon
 *
 * Error: 2 ulp, downwards.
 */
ql_uq32_t ql_warp_lecture_cosine_pdf(ql_q29_t z);

/* One coordinate of the tent; pdf 1 - |x| per length. A tent over the plane
 * takes two of these, and four uniform numbers.
 *
 *   u1, u2  uq32   uniform; the top 31 bits of each count
 *   return  s0.31  u1 - u2 in (-1, 1)
 *
 * Exact: no rounding; each x of the lattice as often as the tent is high.
 * Cost:  a subtraction.
 */
QL_INLINE int32_t ql_warp_lecture_tent(ql_uq32_t u1, ql_uq32_t u2)
{
    return (int32_t)(u1 >> 1) - (int32_t)(u2 >> 1);
}

/* Density of ql_warp_lecture_tent(), per length.
 *
 *   x       s0.31  any
 *   return  uq31   1 - |x|
 *
 * Exact.
 */
QL_INLINE ql_uq31_t ql_warp_lecture_tent_pdf(int32_t x)
{
    return QL_UQ31_ONE - ql_abs32(x);
}

#endif
