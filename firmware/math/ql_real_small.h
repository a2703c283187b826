/* ql_real_small.h - the inline operations of real numbers by calls */
/* SPDX-License-Identifier: MIT */

/* For QL_CFG_SMALL; ql_real.h declares the operations and includes this. Each
 * is a function that takes and returns a real as two registers: its mantissa,
 * and its exponent 32 bits further up. */

#ifndef QL_REAL_SMALL_H
#define QL_REAL_SMALL_H

#include "math/ql_real_type.h"

QL_INLINE uint64_t ql_real_pack(uint32_t m, int16_t e)
{
    return (uint64_t)(uint16_t)e << 32 | m;
}

QL_INLINE ql_real_t ql_real_unpack(uint64_t words)
{
    ql_real_t r;

    r.m = (uint32_t)words;
    r.e = ql_i16((uint16_t)(words >> 32));
    return r;
}

QL_FAST_INLINE uint64_t ql_real_from_u64_packed(uint64_t n)
{
    int16_t e = 32;

    if (n == 0) {
        return 0;
    }
    for (; n <= UINT64_MAX / 2; n <<= 1) {
        e = (int16_t)(e - 1); /* >= 32 - 63 */
    }
    return ql_real_pack((uint32_t)(n >> 32), e);
}

QL_INLINE ql_real_t ql_real_from_u64(uint64_t n)
{
    return ql_real_unpack(ql_real_from_u64_packed(n));
}

QL_FAST_INLINE uint64_t ql_real_mul_packed(
        uint32_t am, int16_t ae, uint32_t bm, int16_t be)
{
    const uint32_t high = ql_mulhi_u32(am, bm); /* 0 or >= 2^30 */
    const int16_t e = ql_real_exponent((int32_t)ae + be + 32);

    return high < 0x80000000u ? ql_real_pack(high << 1, ql_real_exponent(e - 1))
                              : ql_real_pack(high, e);
}

QL_INLINE ql_real_t ql_real_mul(ql_real_t a, ql_real_t b)
{
    return ql_real_unpack(ql_real_mul_packed(a.m, a.e, b.m, b.e));
}

QL_FAST_INLINE uint64_t ql_real_recip_packed(uint32_t m, int16_t e)
{
    /* 2^63 / m */
    return m != 0 ? ql_real_pack(ql_recip_m(m), ql_real_exponent(-63 - e)) : 0;
}

QL_INLINE ql_real_t ql_real_recip(ql_real_t a)
{
    return ql_real_unpack(ql_real_recip_packed(a.m, a.e));
}

#endif
