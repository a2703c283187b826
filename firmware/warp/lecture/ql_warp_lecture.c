/* ql_warp_lecture.c - warps that explain, and that the renderer does not use */
/* SPDX-License-Identifier: MIT */

#include "warp/lecture/ql_warp_lecture.h"

#include "math/ql_trig.h"
#include "warp/ql_warp_sphere.h"

#define INV_PI2 0xcf817b11u /* 1 / pi^2 2^35 */

ql_vec3_t ql_warp_lecture_naive(ql_uq32_t u1, ql_uq32_t u2)
{
    int32_t sine, cosine;

    /* a quarter turn; at its ends the sine errs beyond [0, 1] */
    ql_sincos(u1 >> 2, &sine, &cosine);
    sine = sine < 0 ? 0 : sine;
    cosine = cosine < 0 ? 0 : cosine;
    return ql_warp_sphere_polar(
            sine >= (int32_t)1 << 30 ? 0xffffffffu : (ql_uq32_t)sine << 2, u2,
            (cosine + 1) >> 1);
}

ql_real_t ql_warp_lecture_naive_pdf(ql_vec3_t w)
{
    /* sin^2 2^58 = square.m 2^square.e, and m 2^-32 2^t = sin^2, t even */
    const ql_real_t square = ql_real_from_u64(
            (uint64_t)((int64_t)w.x * w.x) + (uint64_t)((int64_t)w.y * w.y));
    const int32_t t = square.e + 32 - 58 + (square.e & 1);
    uint32_t r;

    if (square.m == 0 || w.z < 0) {
        return QL_REAL_ZERO;
    }
    r = ql_rsqrt_m(square.m >> (square.e & 1)); /* 2^31 2^(t/2) / sin */
    return ql_real_mul(QL_REAL(r < 0x80000000u ? 0x80000000u : r,
                               ql_real_exponent(-31 - t / 2)),
            QL_REAL(INV_PI2, -35));
}

ql_vec3_t ql_warp_lecture_cosine(ql_uq32_t u1, ql_uq32_t u2)
{
    /* at least 2^-16.5, so z > 0; u0.32 to s2.29, to nearest */
    const ql_uq32_t z = ql_sqrt_uq32_of_real(ql_real_midpoint(~u1));

    return ql_warp_sphere_polar(ql_sqrt_uq32_of_real(ql_real_midpoint(u1)), u2,
            (int32_t)(((z >> 2) + 1) >> 1));
}

ql_uq32_t ql_warp_lecture_cosine_pdf(ql_q29_t z)
{
    /* z 2^31 times 2^34 / (2 pi): the high word is 2^32 z / pi */
    return z <= 0 ? 0
                  : ql_mulhi_u32(z >= QL_WARP_ONE_Q29 ? 0x80000000u
                                                      : (uint32_t)z << 2,
                            QL_INV_PI_M);
}
