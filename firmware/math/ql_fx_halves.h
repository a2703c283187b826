/* ql_fx_halves.h - the same products put together from 16-bit halves */
/* SPDX-License-Identifier: MIT */

#ifndef QL_FX_HALVES_H
#define QL_FX_HALVES_H

#include "base/ql_base.h"

#if QL_CFG_SMALL
#define QL_FX_INLINE QL_FAST_INLINE
#else
#define QL_FX_INLINE static inline
#endif

QL_FX_INLINE uint32_t ql_mulhi_u32(uint32_t a, uint32_t b)
{
    const uint32_t al = a & 0xffffu, ah = a >> 16;
    const uint32_t bl = b & 0xffffu, bh = b >> 16;
    const uint32_t mid = ah * bl + (al * bl >> 16); /* <= (2^16-1) 2^16 */
    const uint32_t low = al * bh + (mid & 0xffffu); /* <= (2^16-1) 2^16 */

    return ah * bh + (mid >> 16) + (low >> 16);
}

QL_FX_INLINE uint32_t ql_mulhi_u32_rounded(uint32_t a, uint32_t b)
{
    return ql_mulhi_u32(a, b) + (a * b >> 31); /* a b <= (2^32 - 1)^2 */
}

QL_INLINE int32_t ql_mulhi_su32(int32_t a, uint32_t b)
{
    const uint32_t high = ql_mulhi_u32((uint32_t)a, b);

    return ql_i32(a < 0 ? high - b : high); /* a + 2^32 was multiplied */
}

QL_INLINE uint64_t ql_product_u32(uint32_t a, uint32_t b)
{
    return (uint64_t)ql_mulhi_u32(a, b) << 32 | (uint32_t)(a * b);
}

QL_FX_INLINE uint32_t ql_mul_uq31(uint32_t a, uint32_t b)
{
    const uint32_t high = ql_mulhi_u32(a, b), low = a * b;

    /* a b + 2^30 = high 2^32 + low + 2^30; the sum's carry goes into high */
    return (high + (low > 0xbfffffffu)) << 1 | (low + 0x40000000u) >> 31;
}

QL_INLINE int64_t ql_dot_s16_s32(
        int32_t ax, int32_t ay, int32_t az, int32_t bx, int32_t by, int32_t bz)
{
    /* b = high 2^16 + low: a low < 2^31, a high <= 2^30. The sum of the high
     * products is taken modulo 2^32; with the low products' high halves added
     * it is floor(dot / 2^16), which fits when |dot| < 2^47. */
    const uint32_t lx = (uint32_t)(ax * (int32_t)((uint32_t)bx & 0xffffu));
    const uint32_t ly = (uint32_t)(ay * (int32_t)((uint32_t)by & 0xffffu));
    const uint32_t lz = (uint32_t)(az * (int32_t)((uint32_t)bz & 0xffffu));
    const uint32_t low = (lx & 0xffffu) + (ly & 0xffffu) + (lz & 0xffffu);
    const uint32_t high = (uint32_t)(ax * ql_asr32(bx, 16)) +
                          (uint32_t)(ay * ql_asr32(by, 16)) +
                          (uint32_t)(az * ql_asr32(bz, 16)) +
                          (uint32_t)ql_asr32(ql_i32(lx), 16) +
                          (uint32_t)ql_asr32(ql_i32(ly), 16) +
                          (uint32_t)ql_asr32(ql_i32(lz), 16) + (low >> 16);

    /* floor(dot / 2^16) is taken as signed and widened again */
    return ql_i64((uint64_t)(int64_t)ql_i32(high) << 16 | (low & 0xffffu));
}

#endif
