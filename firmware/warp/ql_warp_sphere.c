/* ql_warp_sphere.c - points of the unit sphere, uniform or by their angles */
/* SPDX-License-Identifier: MIT */

#include "warp/ql_warp_sphere.h"

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

ql_vec3_t ql_warp_sphere_polar(ql_uq32_t rho, ql_turn32_t azimuth, ql_q29_t z)
{
    int32_t sine, cosine;
    ql_vec3_t v;

    ql_sincos(azimuth, &sine, &cosine);
    /* s1.30 times u0.32, high word: s1.30, below 2^30 + 2^15 */
    v.x = ql_asr32(ql_mulhi_su32(cosine, rho) + 1, 1);
    v.y = ql_asr32(ql_mulhi_su32(sine, rho) + 1, 1);
    v.z = z;
    return v;
}

ql_vec3_t ql_warp_sphere_off_axis(ql_real_t s, ql_turn32_t azimuth)
{
    const ql_uq32_t fixed = ql_real_to_uq32(s);
    /* (2 - s) 2^31 in [2^31, 2^32), rounded down so that the sine is <= 1 */
    const ql_real_t rest = QL_REAL(~(fixed >> 1), -31);
    const ql_q29_t z = QL_WARP_ONE_Q29 - (int32_t)(((fixed >> 2) + 1) >> 1);

    return ql_warp_sphere_polar(
            ql_sqrt_uq32_of_real(ql_real_mul(s, rest)), azimuth, z);
}
