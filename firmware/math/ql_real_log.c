/* ql_real_log.c - logarithm by table and series, powers of 2 likewise */
/* SPDX-License-Identifier: MIT */

#include "math/ql_real_log.h"

#include "math/lut/ql_lut.h"

#define LN2_UQ32 0xb17217f8u /* ln 2 */
#define LOG2E    0xb8aa3b29u /* 1 / ln 2, u1.31 */
#define SIXTH    0x2aaaaaabu /* 1 / 6 */

/* Near 1 the series in w keeps all bits of a tiny result; elsewhere the table
 * and a series about its cell. */
ql_real_t ql_real_log_minus_log2(ql_real_t u, ql_real_t w)
{
    uint32_t r, da, d2, d3;
    int32_t d, ln;
    uint64_t sum;

    if (w.e < -39) { /* w < 2^-8 */
        const ql_uq32_t x = ql_real_to_uq32(w);
        const uint32_t x2 = ql_mulhi_u32(x, x);
        /* (1 + x/2 + x^2/3 + x^3/4) 2^31; the next term is below 2^-34 */
        const uint32_t sum31 = 0x80000000u + (x >> 2) +
                               ql_mulhi_u32(x2, SIXTH) +
                               (ql_mulhi_u32(x2, x) >> 3);

        return ql_real_mul(
                ql_real_mul(w, QL_REAL(sum31, -31)), QL_REAL(LOG2E, -31));
    }
    /* r = 1/m to 2^-8: d = m r - 1, times 2^38, |d| < 2^30.2 */
    r = (uint32_t)ql_lut_recip[(u.m >> 24) - QL_RECIP_CELLS] << 16;
    d = ql_i32(ql_mulhi_u32(u.m, r) << 7 | (u.m * r) >> 25);
    da = ql_abs32(d);
    d2 = ql_mulhi_u32(da, da); /* d^2 2^44 < 2^28.4 */
    d3 = ql_mulhi_u32(d2, da); /* |d|^3 2^50 < 2^26.6 */
    /* ln(1 + d) 2^38; the term left out, d^4/4, is below 2^-33 */
    ln = (int32_t)(ql_mulhi_u32(d3, SIXTH) >> 11);
    ln = d - (int32_t)(d2 >> 7) + (d < 0 ? -ln : ln);
    /* exponent, log2(r), less log2(1 + d) 2^37, all in 2^-32; above 2^-8 */
    sum = ((uint64_t)(uint16_t)(-32 - u.e) << 32) +
          ql_lut_log2[(u.m >> 24) - QL_RECIP_CELLS];
    sum -= (uint64_t)(int64_t)ql_asr32(ql_mulhi_su32(ln, LOG2E) + 16, 5);
    return ql_real_scale(ql_real_from_u64(sum), -32);
}

/* (1 - e^-x) / x for x < 2^-6, u0.32: 1 - x/2 + x^2/6 - x^3/24; the next term
 * is below 2^-36. */
static uint32_t decay_over_x(ql_uq32_t x)
{
    const uint32_t x2 = ql_mulhi_u32(x, x);

    return ~(x >> 1) + ql_mulhi_u32(x2, SIXTH) -
           (ql_mulhi_u32(ql_mulhi_u32(x2, x), SIXTH) >> 2);
}

/* 1 - 2^-f for f in [0, 1), u0.32: 1 - (1 - a)(1 - b) = a + (1 - a) b, where a
 * is the table's and b the rest's. */
static ql_uq32_t decay_of_fraction(ql_uq32_t f)
{
    const uint32_t a = ql_lut_exp2[f >> (32 - QL_EXP2_BITS)];
    const uint32_t x = ql_mulhi_u32(f << QL_EXP2_BITS, LN2_UQ32); /* 2^38 */
    const uint32_t b =
            ql_mulhi_u32(x, decay_over_x(x >> QL_EXP2_BITS)) >> QL_EXP2_BITS;

    return a + ql_mulhi_u32(~a, b); /* < 2^31 + 2 */
}

/* y in [2^-6, 2^21] as whole and fraction. */
static uint32_t split(ql_real_t y, ql_uq32_t *fraction)
{
    const uint64_t fixed = (uint64_t)y.m << (y.e + 38); /* y 2^38, < 2^60 */

    *fraction = (uint32_t)(fixed >> 6);
    return (uint32_t)(fixed >> 38);
}

ql_real_t ql_real_log_decay(ql_real_t y)
{
    ql_uq32_t f, s;
    uint32_t whole;

    if (y.e < -37) { /* y < 2^-6: keeps the bits of a tiny y */
        const ql_real_t x = ql_real_mul(y, QL_REAL(LN2_UQ32, -32));

        return ql_real_mul(x, QL_REAL(decay_over_x(ql_real_to_uq32(x)), -32));
    }
    whole = split(y, &f);
    s = whole < 32 ? ~(~decay_of_fraction(f) >> whole) : 0xffffffffu;
    return ql_real_scale(ql_real_from_u64(s), -32);
}

ql_real_t ql_real_log_half_to_the(ql_real_t y)
{
    ql_uq32_t f = 0, m;
    uint32_t whole = 0;

    if (y.m == 0) {
        return QL_REAL_ONE;
    }
    if (y.e >= -37) {
        whole = split(y, &f);
        if (whole >= QL_REAL_LOG_MAX) {
            return QL_REAL_ZERO;
        }
        m = ~decay_of_fraction(f);
    } else {
        m = ~ql_real_to_uq32(ql_real_log_decay(y));
    }
    return QL_REAL(m < 0x80000000u ? 0x80000000u : m,
            ql_real_exponent(-32 - (int32_t)whole));
}
