/* ql_warp_sphere.c - points of the unit sphere, uniform or by their angles */
/* SPDX-License-Identifier: MIT */

#include "warp/ql_warp_sphere.h"

ql_vec3_t ql_warp_sphere(ql_uq32_t u1, ql_uq32_t u2)
{
    /* rho = 2 sqrt(u (1 - u)); 4 u (1 - u) <= 2^32 - 4 in u0.32 */
    const ql_uq32_t rho = ql_sqrt_uq32(ql_mulhi_u32(u1, ~u1) << 2);
    int32_t sine, cosine;
    ql_vec3_t v;

    ql_sincos(u2, &sine, &cosine);
    /* s1.30 times u0.31, high word: s2.29 */
    v.x = ql_mulhi_su32(cosine, rho >> 1);
    v.y = ql_mulhi_su32(sine, rho >> 1);
    v.z = (int32_t)(1ul << 29) - (int32_t)(u1 >> 2); /* in [-1, 1] */
    return v;
}
