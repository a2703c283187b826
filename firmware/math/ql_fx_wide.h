/* ql_fx_wide.h - products of CPUs that multiply 32 x 32 -> 64 bits */
/* SPDX-License-Identifier: MIT */

#ifndef QL_FX_WIDE_H
#define QL_FX_WIDE_H

#include "base/ql_base.h"

#define QL_FX_INLINE QL_INLINE

QL_INLINE uint32_t ql_mulhi_u32(uint32_t a, uint32_t b)
{
    return (uint32_t)((uint64_t)a * b >> 32);
}

QL_INLINE uint32_t ql_mulhi_u32_rounded(uint32_t a, uint32_t b)
{
    return (uint32_t)(((uint64_t)a * b + 0x80000000u) >> 32);
}

QL_INLINE int32_t ql_mulhi_su32(int32_t a, uint32_t b)
{
    return ql_i32((uint32_t)((uint64_t)((int64_t)a * (int64_t)b) >> 32));
}

QL_INLINE uint64_t ql_product_u32(uint32_t a, uint32_t b)
{
    return (uint64_t)a * b;
}

QL_INLINE uint32_t ql_mul_uq31(uint32_t a, uint32_t b)
{
    return (uint32_t)(((uint64_t)a * b + 0x40000000u) >> 31);
}

QL_INLINE int64_t ql_dot_s16_s32(
        int32_t ax, int32_t ay, int32_t az, int32_t bx, int32_t by, int32_t bz)
{
    return (int64_t)ax * bx + (int64_t)ay * by + (int64_t)az * bz;
}

#endif
