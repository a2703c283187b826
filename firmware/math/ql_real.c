/* ql_real.c - reciprocal, square roots, sums of real numbers */
/* SPDX-License-Identifier: MIT */

#include "math/ql_real.h"

/* Entry i of ql_lut_recip. */
#if QL_CFG_SMALL
static uint32_t recip_entry(uint32_t i)
{
    /* 2^25 / (2 i + 257), half up, as tools/lut/lut_main.c has it: 18 bits of a
     * division, of which the first 9 are 0 */
    const uint32_t m = (2 * i + 257u) << 17;
    uint32_t rest = (uint32_t)1 << 25, quotient = 0;

    for (unsigned k = 0; k < 18; k++) {
        quotient <<= 1;
        if (rest >= m) {
            rest -= m;
            quotient |= 1u;
        }
        rest <<= 1;
    }
    return (quotient + 1) >> 1;
}
#else
static uint32_t recip_entry(uint32_t i)
{
    return ql_lut_recip[i];
}
#endif

uint32_t ql_recip_m(uint32_t m)
{
    /* r = 2^63 / m in u0.32. Cell width 2^-8: relative error of the
     * table's value at the cell's middle <= 2^-8, squared by each step. */
    uint32_t r = recip_entry((m >> 24) - QL_RECIP_CELLS) << 16;
    uint32_t x;

    QL_ASSERT(m >= 0x80000000u);

    /* x = m r / 2^32, near 2^31. 2^32 - x is near 2^31 too, so
     * r' = r (2^32 - x) / 2^31 with one bit kept for the shift. */
    x = ql_mulhi_u32(m, r);
    r = ql_mulhi_u32(r, 0u - x) << 1;
    x = ql_mulhi_u32(m, r);
    r = ql_mulhi_u32(r, 0u - x);
    return r < 0x80000000u ? r << 1 : 0xffffffffu;
}

/* The table's entry and some steps of Newton's method. */
QL_INLINE uint32_t rsqrt(uint32_t m, unsigned steps)
{
    /* r = 2^47 / sqrt(m) in u0.32; the index is the top bits + 1 bits */
    uint32_t r = (uint32_t)ql_lut_rsqrt[(m >> (31 - QL_CFG_TABLE_BITS)) -
                                        QL_RSQRT_CELLS / 3]
                 << 16;

    QL_ASSERT(m >= 0x40000000u);
    for (unsigned i = 0; i < steps; i++) {
        /* y = m r^2 / 2^64 is near 2^30; r' = r (3 2^30 - y) / 2^31. */
        const uint32_t y = ql_mulhi_u32(ql_mulhi_u32(r, r), m);
        const uint32_t next = ql_mulhi_u32(r, 0xc0000000u - y);

        r = next < 0x80000000u ? next << 1 : 0xffffffffu;
    }
    return r;
}

uint32_t ql_rsqrt_m(uint32_t m)
{
    return rsqrt(m, 1 + QL_CFG_PRECISION + (QL_CFG_TABLE_BITS < 7));
}

#if !(QL_CFG_TABLE_LERP && QL_CFG_TABLE_BITS >= 7)
uint32_t ql_rsqrt_warp_m(uint32_t m)
{
    return rsqrt(m, QL_CFG_TABLE_LERP ? 1 + QL_CFG_PRECISION : 0);
}
#endif

ql_real_t ql_real_from_uq_call(uint64_t n, unsigned bits)
{
    return ql_real_scale(ql_real_from_u64(n), -(int32_t)bits);
}

ql_real_t ql_real_mul_call(ql_real_t a, ql_real_t b)
{
    return ql_real_mul(a, b);
}

ql_real_t ql_real_recip_call(ql_real_t a)
{
    return ql_real_recip(a);
}

ql_real_t ql_real_div(ql_real_t a, ql_real_t b)
{
    return ql_real_mul(a, ql_real_recip(b));
}

/* m 2^-shift, or 0. */
static uint32_t mantissa_down(ql_real_t a, int32_t shift)
{
    return shift < 32 ? a.m >> shift : 0;
}

ql_real_t ql_real_add(ql_real_t a, ql_real_t b)
{
    const ql_real_t most = a.m == 0 || (b.m != 0 && b.e > a.e) ? b : a;
    const ql_real_t least = a.m == 0 || (b.m != 0 && b.e > a.e) ? a : b;
    ql_real_t r = most;

    if (least.m != 0) {
        r.m += mantissa_down(least, (int32_t)most.e - least.e);
        if (r.m < most.m) { /* the sum is 2^32 more */
            r.m = 0x80000000u | r.m >> 1;
            r.e = ql_real_exponent(r.e + 1);
        }
    }
    return r;
}

ql_real_t ql_real_sub(ql_real_t a, ql_real_t b)
{
    ql_real_t r = {0, 0};
    uint32_t rest;
    unsigned zeros;

    if (b.m == 0) {
        return a;
    }
    if (a.m == 0 || a.e < b.e) {
        return r;
    }
    rest = mantissa_down(b, (int32_t)a.e - b.e);
    if (a.m > rest) {
        rest = a.m - rest;
        zeros = ql_clz32(rest);
        r.m = rest << zeros;
        r.e = ql_real_exponent(a.e - (int32_t)zeros);
    }
    return r;
}

ql_real_t ql_real_sqrt(ql_real_t a)
{
    ql_real_t root = {0, 0};
    uint32_t m, r, s, twice;
    int64_t rest;

    if (a.m == 0) {
        return root;
    }
    /* a = m 2^-32 2^k, k even; the bit that may be cut is 2^-31 of m */
    m = a.m >> (a.e & 1);
    root.e = ql_real_exponent((a.e + 32 + (a.e & 1)) / 2 - 32);
    r = ql_rsqrt_m(m);      /* 2^31 / sqrt(m 2^-32), 2^-15 or better */
    s = ql_mulhi_u32(m, r); /* sqrt(m 2^-32) 2^31 <= 2^31 + 2^16 */
    /* a - s^2 in 2^-62: below 2^48.1 in size, for 2^62 has an error of 2^-14;
     * 2^-20 of it times r 2^-32 is the correction times 2^11 */
    rest = ql_i64(((uint64_t)m << 30) - (uint64_t)s * s);
    twice = (s << 1) +
            (uint32_t)ql_asr32(
                    ql_mulhi_su32((int32_t)ql_asr64(rest, 20), r) + 512, 10);
    /* twice the root of [1/4, 1): in [2^31, 2^32], or just outside */
    root.m = twice >= 0x80000000u ? twice
             : s >= 0x60000000u   ? 0xffffffffu
                                  : 0x80000000u;
    return root;
}

ql_uq32_t ql_sqrt_uq32(ql_uq32_t x)
{
    const unsigned shift = ql_clz32(x) & ~1u;
    uint32_t m, root;

    if (x == 0) {
        return 0;
    }
    /* sqrt(m) = m / sqrt(m); m = x 2^shift in [1/4, 1) */
    m = x << shift;
    root = ql_mulhi_u32(m, ql_rsqrt_warp_m(m)); /* sqrt(m) / 2: < 2^31 */
    return root < 0x80000000u ? root << 1 >> (shift / 2)
                              : 0xffffffffu >> (shift / 2);
}
