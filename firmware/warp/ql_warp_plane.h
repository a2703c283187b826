/* ql_warp_plane.h - points of the plane: concentric disk, triangle */
/* SPDX-License-Identifier: MIT */

/* Both keep neighbours of the unit square neighbours, so stratified numbers
 * stay stratified. */

#ifndef QL_WARP_PLANE_H
#define QL_WARP_PLANE_H

#include "math/ql_real.h"

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
void ql_warp_plane_disk(ql_uq32_t u1, ql_uq32_t u2, ql_q29_t *x, ql_q29_t *y);

/* Density of ql_warp_plane_disk(), per area.
 *
 *   return  uq32  1/pi
 */
QL_INLINE ql_uq32_t ql_warp_plane_disk_pdf(void)
{
    return 0x517cc1b7u;
}

/* Barycentric coordinates with QL_BARY_BITS fraction bits. */
#if QL_POS_BITS == 0
#define QL_BARY_BITS 16
#else
#define QL_BARY_BITS 32
#endif

/* Uniform on a triangle; pdf 1/area per area.
 *
 *   u1, u2  uq32  uniform; the top QL_BARY_BITS - 2 bits of each count
 *   b1, b2  u0.QL_BARY_BITS  out: weights of vertices 1 and 2, b1 + b2 < 1;
 *           vertex 0 has the rest
 *
 * Exact: no rounding; area-preserving on the lattice of midpoints.
 * From:  the same density as GI (18); the map is Heitz, "A Low-Distortion Map
 *        Between Triangle and Square", 2019.
 */
void ql_warp_plane_triangle(
        ql_uq32_t u1, ql_uq32_t u2, uint32_t *b1, uint32_t *b2);

/* Density of ql_warp_plane_triangle(), per area.
 *
 *   area    real  of the triangle, in any unit
 *   return  real  1 / area
 *
 * Error: relative, 2^-29.
 */
QL_INLINE ql_real_t ql_warp_plane_triangle_pdf(ql_real_t area)
{
    return ql_real_recip(area);
}

#endif
