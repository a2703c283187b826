/* ql_warp.h - from the unit square to points and directions, with densities */
/* SPDX-License-Identifier: MIT */

/* "GI" is Dutre's Global Illumination Compendium (2003). Every warp maps
 * uniform u1, u2 to its domain with the density named beside it. */

#ifndef QL_WARP_H
#define QL_WARP_H

#include "math/ql_vec.h"

/* Uniform on the unit sphere; pdf 1/(4 pi) per solid angle.
 *
 *   u1, u2  uq32   uniform
 *   return  s2.29  unit vector: z = 1 - 2 u1, azimuth 2 pi u2
 *
 * Error: length within 2.3e-5 (draft) or 5e-8 (fine) of 1.
 * Cost:  one square root, one sine and cosine.
 * From:  GI (33).
 */
ql_vec3_t ql_warp_sphere(ql_uq32_t u1, ql_uq32_t u2);

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
ql_vec3_t ql_warp_cosine_hemisphere(ql_vec3_t n, ql_uq32_t u1, ql_uq32_t u2);

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
void ql_warp_triangle(ql_uq32_t u1, ql_uq32_t u2, uint32_t *b1, uint32_t *b2);

#endif
