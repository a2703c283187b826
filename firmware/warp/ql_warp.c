/* ql_warp.c - sphere, cosine hemisphere, triangle */
/* SPDX-License-Identifier: MIT */

#include "warp/ql_warp.h"

#include "math/ql_real.h"
#include "math/ql_trig.h"

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

ql_vec3_t ql_warp_cosine_hemisphere(ql_vec3_t n, ql_uq32_t u1, ql_uq32_t u2)
{
    ql_vec3_t v = ql_warp_sphere(u1, u2);

    v.x += n.x; /* at most 2 in size: < 2^30 + 2^15 */
    v.y += n.y;
    v.z += n.z;
    return v;
}

void ql_warp_triangle(ql_uq32_t u1, ql_uq32_t u2, uint32_t *b1, uint32_t *b2)
{
    /* midpoints of QL_BARY_BITS - 2 bits, as odd numbers of one bit more */
    const uint32_t x = u1 >> (34 - QL_BARY_BITS) << 1 | 1u;
    const uint32_t y = u2 >> (34 - QL_BARY_BITS) << 1 | 1u;

    /* b0 = x, b1 = 2y - x or b1 = y, b0 = 2x - y; then b2 = 1 - b0 - b1.
     * Returned as the weights of vertices 1 and 2. */
    *b1 = x < y ? x : 2 * x - y;
    *b2 = x < y ? 2 * y - x : y;
}
