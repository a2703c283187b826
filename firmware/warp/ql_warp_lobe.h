/* ql_warp_lobe.h - directions distributed as a power of the cosine */
/* SPDX-License-Identifier: MIT */

#ifndef QL_WARP_LOBE_H
#define QL_WARP_LOBE_H

#include "math/vec/ql_vec.h"

/* What ql_warp_lobe() needs of its exponent, worked out once.
 *
 *   power   uq16  m, any: 0 is uniform, 1 the cosine, 65535 nearly a mirror
 *   return  1 / (m + 1)
 *
 * Error: relative, 2^-29.
 */
ql_real_t ql_warp_lobe_inverse(ql_uq16_t power);

/* Distributed as cos^m about z; pdf (m + 1)/(2 pi) cos^m(theta) per solid
 * angle.
 *
 *   inverse  -      ql_warp_lobe_inverse(m)
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
ql_vec3_t ql_warp_lobe(
        ql_real_t inverse, ql_uq32_t u1, ql_uq32_t u2, ql_uq31_t *s);

/* Density of ql_warp_lobe(), per solid angle.
 *
 *   power   uq16  m
 *   s       uq31  1 - cos(theta)
 *   return  (m + 1)/(2 pi) (1 - s)^m; 0 for s >= 1, and below 2^-4096
 *
 * Error: relative, 2^-26 + m 2^-32 + 2^-29 m |log2(1 - s)|; that s is itself
 *        rounded is another m 2^-32.
 * Cost:  as the logarithm and power of two of ql_warp_lobe().
 */
ql_real_t ql_warp_lobe_pdf(ql_uq16_t power, ql_uq31_t s);

#endif
