/* ql_real_log.h - logarithm and power to the base of 2 of real numbers */
/* SPDX-License-Identifier: MIT */

/* A real number has no sign, so logarithms are taken of numbers below 1 and
 * powers are below 1; both are kept without their minus. Both keep their bits
 * where they are tiny. They are inline, for the one file of the core that asks
 * for them (ql_warp_lobe.c). */

#ifndef QL_REAL_LOG_H
#define QL_REAL_LOG_H

#include "math/lut/ql_lut.h"
#include "math/ql_real.h"

#define QL_REAL_LOG_LN2   0xb17217f8u /* ln 2, u0.32 */
#define QL_REAL_LOG_LOG2E 0xb8aa3b29u /* 1 / ln 2, u1.31 */
#define QL_REAL_LOG_SIXTH 0x2aaaaaabu /* 1 / 6, u0.32 */

/* No power is below 2^-this: it is zero. */
#define QL_REAL_LOG_MAX 4096u

/* Logarithm of a number below 1.
 *
 *   u       real  in (0, 1), 2^-4096 or more
 *   w       real  1 - u, as exactly as it is known
 *   return  real  -log2(u)
 *
 * Error: relative, 2^-26.
 * Cost:  nine multiplications and one look-up; near 1 seven multiplications.
 */
static inline ql_real_t ql_real_log_minus_log2(ql_real_t u, ql_real_t w)
{
    /* Near 1 the series in w keeps all bits of a tiny result; elsewhere the
     * table and a series about its cell. */
    uint32_t r, da, d2, d3;
    int32_t d, ln;
    uint64_t sum;

    if (w.e < -39) { /* w < 2^-8 */
        const ql_uq32_t x = ql_real_to_uq32(w);
        const uint32_t x2 = ql_mulhi_u32(x, x);
        /* (1 + x/2 + x^2/3 + x^3/4) 2^31; the next term is below 2^-34 */
        const uint32_t sum31 = 0x80000000u + (x >> 2) +
                               ql_mulhi_u32(x2, QL_REAL_LOG_SIXTH) +
                               (ql_mulhi_u32(x2, x) >> 3);

        return ql_real_mul(ql_real_mul(w, QL_REAL(sum31, -31)),
                QL_REAL(QL_REAL_LOG_LOG2E, -31));
    }
    /* r = 1/m to 2^-8: d = m r - 1, times 2^38, |d| < 2^30.2 */
    r = (uint32_t)ql_lut_recip[(u.m >> 24) - QL_RECIP_CELLS] << 16;
    d = ql_i32(ql_mulhi_u32(u.m, r) << 7 | (u.m * r) >> 25);
    da = ql_abs32(d);
    d2 = ql_mulhi_u32(da, da); /* d^2 2^44 < 2^28.4 */
    d3 = ql_mulhi_u32(d2, da); /* |d|^3 2^50 < 2^26.6 */
    /* ln(1 + d) 2^38; the term left out, d^4/4, is below 2^-33 */
    ln = (int32_t)(ql_mulhi_u32(d3, QL_REAL_LOG_SIXTH) >> 11);
    ln = d - (int32_t)(d2 >> 7) + (d < 0 ? -ln : ln);
    /* exponent, log2(r), less log2(1 + d) 2^37, all in 2^-32; above 2^-8 */
    sum = ((uint64_t)(uint16_t)(-32 - u.e) << 32) +
          ql_lut_log2[(u.m >> 24) - QL_RECIP_CELLS];
    sum -= (uint64_t)(int64_t)ql_asr32(
            ql_mulhi_su32(ln, QL_REAL_LOG_LOG2E) + 16, 5);
    return ql_real_scale(ql_real_from_u64(sum), -32);
}

/* (1 - e^-x) / x for x < 2^-6, u0.32: 1 - x/2 + x^2/6 - x^3/24; the next term
 * is below 2^-36. */
static inline uint32_t ql_real_log_decay_over_x(ql_uq32_t x)
{
    const uint32_t x2 = ql_mulhi_u32(x, x);

    return ~(x >> 1) + ql_mulhi_u32(x2, QL_REAL_LOG_SIXTH) -
           (ql_mulhi_u32(ql_mulhi_u32(x2, x), QL_REAL_LOG_SIXTH) >> 2);
}

/* 1 - 2^-f for f in [0, 1), u0.32: 1 - (1 - a)(1 - b) = a + (1 - a) b, where a
 * is the table's and b the rest's. */
static inline ql_uq32_t ql_real_log_decay_of_fraction(ql_uq32_t f)
{
    const uint32_t a = ql_lut_exp2[f >> (32 - QL_EXP2_BITS)];
    const uint32_t x =
            ql_mulhi_u32(f << QL_EXP2_BITS, QL_REAL_LOG_LN2); /* 2^38 */
    const uint32_t b =
            ql_mulhi_u32(x, ql_real_log_decay_over_x(x >> QL_EXP2_BITS)) >>
            QL_EXP2_BITS;

    return a + ql_mulhi_u32(~a, b); /* < 2^31 + 2 */
}

/* What a power of 1/2 is below 1.
 *
 *   y       real  in [0, 2^21]
 *   return  real  1 - 2^-y, below 1
 *
 * Error: relative, 2^-26.
 * Cost:  about six multiplications and one look-up.
 */
static inline ql_real_t ql_real_log_decay(ql_real_t y)
{
    uint64_t fixed;
    uint32_t whole;
    ql_uq32_t s;

    if (y.e < -37) { /* y < 2^-6: keeps the bits of a tiny y */
        const ql_real_t x = ql_real_mul(y, QL_REAL(QL_REAL_LOG_LN2, -32));

        return ql_real_mul(
                x, QL_REAL(ql_real_log_decay_over_x(ql_real_to_uq32(x)), -32));
    }
    fixed = (uint64_t)y.m << (y.e + 38); /* y 2^38, < 2^60 */
    whole = (uint32_t)(fixed >> 38);
    s = whole < 32 ? ~(~ql_real_log_decay_of_fraction((uint32_t)(fixed >> 6)) >>
                             whole)
                   : 0xffffffffu;
    return ql_real_scale(ql_real_from_u64(s), -32);
}

/* A power of 1/2.
 *
 *   y       real  in [0, 2^21]
 *   return  real  2^-y; 0 below 2^-QL_REAL_LOG_MAX
 *
 * Error: relative, 2^-29.
 * Cost:  as ql_real_log_decay().
 */
static inline ql_real_t ql_real_log_half_to_the(ql_real_t y)
{
    uint32_t whole = 0;
    ql_uq32_t m;

    if (y.m == 0) {
        return QL_REAL_ONE;
    }
    if (y.e >= -37) {
        /* y 2^38, < 2^60 */
        const uint64_t fixed = (uint64_t)y.m << (y.e + 38);

        whole = (uint32_t)(fixed >> 38);
        if (whole >= QL_REAL_LOG_MAX) {
            return QL_REAL_ZERO;
        }
        m = ~ql_real_log_decay_of_fraction((uint32_t)(fixed >> 6));
    } else {
        m = ~ql_real_to_uq32(ql_real_log_decay(y));
    }
    return QL_REAL(m < 0x80000000u ? 0x80000000u : m,
            ql_real_exponent(-32 - (int32_t)whole));
}

#endif
