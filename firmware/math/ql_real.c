/* ql_real.c - reciprocal, reciprocal square root, square root */
/* SPDX-License-Identifier: MIT */

#include "math/ql_real.h"

uint32_t ql_recip_m(uint32_t m)
{
    /* r = 2^63 / m in u0.32. Cell width 2^-8: relative error of the
     * table's value at the cell's middle <= 2^-8, squared by each step. */
    uint32_t r = (uint32_t)ql_lut_recip[(m >> 24) - QL_RECIP_CELLS] << 16;
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

uint32_t ql_rsqrt_m(uint32_t m)
{
    /* r = 2^47 / sqrt(m) in u0.32; the table's index is the top 8 bits. */
    uint32_t r = (uint32_t)ql_lut_rsqrt[(m >> 24) - QL_RSQRT_CELLS / 3] << 16;

    QL_ASSERT(m >= 0x40000000u);
    for (unsigned i = 0; i <= QL_CFG_PRECISION; i++) {
        /* y = m r^2 / 2^64 is near 2^30; r' = r (3 2^30 - y) / 2^31. */
        const uint32_t y = ql_mulhi_u32(ql_mulhi_u32(r, r), m);
        const uint32_t next = ql_mulhi_u32(r, 0xc0000000u - y);

        r = next < 0x80000000u ? next << 1 : 0xffffffffu;
    }
    return r;
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
    root = ql_mulhi_u32(m, ql_rsqrt_m(m)); /* half of sqrt(m): < 2^31 */
    return root < 0x80000000u ? root << 1 >> (shift / 2)
                              : 0xffffffffu >> (shift / 2);
}
