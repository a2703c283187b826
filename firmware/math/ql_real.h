/* ql_real.h - positive real numbers: a 32-bit mantissa and an exponent */
/* SPDX-License-Identifier: MIT */

/* The geometry term of a light sample spans a hundred powers of two, so it is
 * worked out as m 2^e with m in [2^31, 2^32), or m = 0 for zero. Not a float:
 * no signs, no infinities, no rounding modes; a handful of operations, each
 * with its bound. Errors are relative; one ulp is 2^-31. */

#ifndef QL_REAL_H
#define QL_REAL_H

#include "math/lut/ql_lut.h"
#include "math/ql_real_type.h"

QL_C_BEGIN

/* The number n, cut to its 32 highest bits: relative error in (-2^-31, 0]. */
QL_INLINE ql_real_t ql_real_from_u64(uint64_t n);

/* a b, relative error in (-2^-30, 0]. */
QL_INLINE ql_real_t ql_real_mul(ql_real_t a, ql_real_t b);

/* 1 / a; 0 for 0. Error: relative, 2^-29. */
QL_INLINE ql_real_t ql_real_recip(ql_real_t a);

/* Reciprocal square root of a mantissa m in [2^30, 2^32).
 *
 *   m       -  m / 2^32 in [1/4, 1)
 *   return  2^47 / sqrt(m) in [2^31, 2^32]: half of 1/sqrt(m / 2^32), u0.32;
 *           2^32 itself is cut to 2^32 - 1, and the error may reach below 2^31
 *
 * Error: at most 2.3e-5 (draft) or 1.2e-9 (fine), relative.
 * Cost:  one look-up, four multiplications (draft) or seven (fine); three more
 *        if QL_CFG_TABLE_BITS is below 7.
 * From:  Newton's method, r' = r (3 - m r r) / 2, once or twice.
 */
uint32_t ql_rsqrt_m(uint32_t m);

/* Reciprocal square root for warps, by the user's choice of tables.
 *
 *   m       -  as for ql_rsqrt_m()
 *   return  as of ql_rsqrt_m()
 *
 * Error: with h = 2^-(QL_CFG_TABLE_BITS + 1), 1.5 h^2 (draft), 3.4 h^4 (fine),
 *        or that of ql_rsqrt_m() if it is more; h without QL_CFG_TABLE_LERP.
 * Cost:  one look-up, four multiplications (draft), seven (fine), or none.
 */
#if QL_CFG_TABLE_LERP && QL_CFG_TABLE_BITS >= 7
#define ql_rsqrt_warp_m(m) ql_rsqrt_m(m)
#else
uint32_t ql_rsqrt_warp_m(uint32_t m);
#endif

#if QL_CFG_SMALL
#include "math/ql_real_small.h"
#else
QL_INLINE ql_real_t ql_real_from_u64(uint64_t n)
{
    const unsigned shift = ql_clz64(n);

    ql_real_t r = {0, 0};

    if (shift < 64) {
        r.m = (uint32_t)(n << shift >> 32);
        r.e = ql_real_exponent(32 - (int32_t)shift);
    }
    return r;
}

QL_INLINE ql_real_t ql_real_mul(ql_real_t a, ql_real_t b)
{
    const uint32_t high = ql_mulhi_u32(a.m, b.m); /* 0 or >= 2^30 */
    ql_real_t r;

    r.m = high;
    r.e = ql_real_exponent((int32_t)a.e + b.e + 32);
    if (high < 0x80000000u) {
        r.m = high << 1;
        r.e = ql_real_exponent(r.e - 1);
    }
    return r;
}

QL_INLINE ql_real_t ql_real_recip(ql_real_t a)
{
    ql_real_t r = {0, 0};

    if (a.m != 0) {
        r.m = ql_recip_m(a.m); /* 2^63 / m */
        r.e = ql_real_exponent(-63 - a.e);
    }
    return r;
}
#endif

/* The midpoint (2u + 1) / 2^33 of u's interval; exact for u below 2^31, cut to
 * u / 2^32 above. */
QL_INLINE ql_real_t ql_real_midpoint(ql_uq32_t u)
{
    const unsigned zeros = ql_clz32(u);
    ql_real_t r = {u, -32};

    if (zeros > 0) {
        r.m = (u << 1 | 1u) << (zeros - 1);
        r.e = ql_real_exponent(-32 - (int32_t)zeros);
    }
    return r;
}

/* a as u0.32, rounded down; cut below 1. */
QL_INLINE ql_uq32_t ql_real_to_uq32(ql_real_t a)
{
    const int32_t shift = -32 - (int32_t)a.e;

    if (shift < 0) {
        return a.m == 0 ? 0 : 0xffffffffu;
    }
    return shift < 32 ? a.m >> shift : 0;
}

/* The same three by calls, for code that is longer than it is hot. */

/* n 2^-bits, cut to the 32 highest bits of n. */
ql_real_t ql_real_from_uq_call(uint64_t n, unsigned bits);

/* a b as ql_real_mul() has it. */
ql_real_t ql_real_mul_call(ql_real_t a, ql_real_t b);

/* 1 / a as ql_real_recip() has it. */
ql_real_t ql_real_recip_call(ql_real_t a);

/* a / b; 0 for b = 0. Error: relative, 2^-28. */
ql_real_t ql_real_div(ql_real_t a, ql_real_t b);

/* a + b. Error: relative, 2^-30, downwards. */
ql_real_t ql_real_add(ql_real_t a, ql_real_t b);

/* a - b; 0 where b >= a. Error: an ulp of 2^-31 of a. */
ql_real_t ql_real_sub(ql_real_t a, ql_real_t b);

/* Square root; 0 of 0.
 *
 * Error: relative, 1.3e-9 (draft) or 4.7e-10 (fine; tests/unit/test_real.c).
 * Cost:  ql_rsqrt_m(), two multiplications, one more to 64 bits.
 * From:  Heron's rule, s + (a - s^2) / (2 s), without dividing.
 */
ql_real_t ql_real_sqrt(ql_real_t a);

/* Square root of a fraction.
 *
 *   x       u0.32
 *   return  u0.32, cut below 1
 *
 * Error: relative, that of ql_rsqrt_warp_m() and 2 ulp; exact for 0.
 */
ql_uq32_t ql_sqrt_uq32(ql_uq32_t x);

/* Square root of a real number below 1.
 *
 *   a       real  in [0, 1)
 *   return  u0.32, cut below 1
 *
 * Error: relative, that of ql_rsqrt_warp_m() and 3 ulp; exact for 0.
 */
static inline ql_uq32_t ql_sqrt_uq32_of_real(ql_real_t a)
{
    const unsigned shift = (unsigned)(-32 - a.e); /* a = m 2^-32 2^-shift */
    const uint32_t m = a.m >> (shift & 1u);       /* >= 2^30, even shift */
    uint32_t half;

    if (a.m == 0 || shift > 62) {
        return 0;
    }
    half = ql_mulhi_u32(m, ql_rsqrt_warp_m(m)); /* sqrt(m 2^-32) 2^31 */
    half = half < 0x80000000u ? half << 1 : 0xffffffffu;
    return half >> (shift / 2);
}

QL_C_END

#endif
