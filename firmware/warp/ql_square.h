/* ql_square.h - points of the plane: concentric disk, tent; densities */
/* SPDX-License-Identifier: MIT */

/* For lenses and pixel filters. Both keep neighbours of the unit square
 * neighbours, so stratified numbers stay stratified. */

#ifndef QL_SQUARE_H
#define QL_SQUARE_H

#include "math/ql_fx.h"

/* Uniform on the unit disk; pdf 1/pi per area.
 *
 *   u1, u2  uq32   uniform; the top 31 bits of each count
 *   x, y    s2.29  out: a point of the disk, not NULL
 *
 * Concentric squares become concentric circles: with a = 2 u1 - 1 and
 * b = 2 u2 - 1 the radius is the larger, the angle pi/4 times their ratio.
 *
 * Error: radius within 2.1e-5 (draft) or 5.1e-8 (fine) of max(|a|, |b|),
 *        relative, and half an ulp of x and y; it can be above 1 by as much.
 * Cost:  one reciprocal, one sine and cosine, three multiplications.
 * From:  Shirley and Chiu, "A Low Distortion Map Between Disk and Square",
 *        1997.
 */
void ql_warp_disk(ql_uq32_t u1, ql_uq32_t u2, ql_q29_t *x, ql_q29_t *y);

/* Density of ql_warp_disk(), per area.
 *
 *   return  uq32  1/pi
 */
QL_INLINE ql_uq32_t ql_warp_disk_pdf(void)
{
    return 0x517cc1b7u;
}

/* One coordinate of the tent; pdf 1 - |x| per length. A tent over the plane
 * takes two of these, and four uniform numbers.
 *
 *   u1, u2  uq32   uniform; the top 31 bits of each count
 *   return  s0.31  u1 - u2 in (-1, 1)
 *
 * Exact: no rounding; each x of the lattice as often as the tent is high.
 * Cost:  a subtraction.
 */
QL_INLINE int32_t ql_warp_tent(ql_uq32_t u1, ql_uq32_t u2)
{
    return (int32_t)(u1 >> 1) - (int32_t)(u2 >> 1);
}

/* Density of ql_warp_tent(), per length.
 *
 *   x       s0.31  any
 *   return  uq31   1 - |x|
 *
 * Exact.
 */
QL_INLINE ql_uq31_t ql_warp_tent_pdf(int32_t x)
{
    return QL_UQ31_ONE - ql_abs32(x);
}

#endif
