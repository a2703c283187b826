/* ql_square.c - concentric map of the square to the disk */
/* SPDX-License-Identifier: MIT */

#include "warp/ql_square.h"

#include "math/ql_real.h"
#include "math/ql_trig.h"

/* a times the radius, u0.32, to nearest: s1.30 to s2.29, with a sign. */
static ql_q29_t times_radius(int32_t a, uint32_t radius, bool negative)
{
    const int32_t r = ql_asr32(ql_mulhi_su32(a, radius) + 1, 1);

    return negative ? -r : r;
}

void ql_warp_disk(ql_uq32_t u1, ql_uq32_t u2, ql_q29_t *x, ql_q29_t *y)
{
    /* 2 u - 1 at the midpoint of 31 bits: odd, so never 0, s0.31 */
    const int32_t a = ql_i32((u1 | 1u) ^ 0x80000000u);
    const int32_t b = ql_i32((u2 | 1u) ^ 0x80000000u);
    const uint32_t abs_a = ql_abs32(a), abs_b = ql_abs32(b);
    const bool by_a = abs_a > abs_b; /* the diagonals go to b */
    const uint32_t large = by_a ? abs_a : abs_b;
    const uint32_t small = by_a ? abs_b : abs_a;
    /* small / large, u1.31: both shifted, times 2^63 over the larger */
    const unsigned zeros = ql_clz32(large); /* 1..31 */
    const uint32_t ratio =
            ql_mulhi_u32(small << zeros, ql_recip_m(large << zeros));
    /* an eighth of a turn times the ratio */
    const ql_turn32_t angle = (ratio + 2) >> 2;
    int32_t sine, cosine;

    ql_sincos(angle, &sine, &cosine);
    /* the larger's axis takes the cosine; each keeps its own sign */
    *x = times_radius(by_a ? cosine : sine, large << 1, a < 0);
    *y = times_radius(by_a ? sine : cosine, large << 1, b < 0);
}
