/* ql_warp_plane.c - concentric map to the disk, weights of a triangle */
/* SPDX-License-Identifier: MIT */

#include "warp/ql_warp_plane.h"

#include "math/ql_trig.h"

/* a times the radius, u0.32, to nearest: s1.30 to s2.29, with a sign. */
static ql_q29_t times_radius(int32_t a, uint32_t radius, bool negative)
{
    const int32_t r = ql_asr32(ql_mulhi_su32(a, radius) + 1, 1);

    return negative ? -r : r;
}

void ql_warp_plane_disk(ql_uq32_t u1, ql_uq32_t u2, ql_q29_t *x, ql_q29_t *y)
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

void ql_warp_plane_triangle(
        ql_uq32_t u1, ql_uq32_t u2, uint32_t *b1, uint32_t *b2)
{
    /* midpoints of QL_BARY_BITS - 2 bits, as odd numbers of one bit more */
    const uint32_t x = u1 >> (34 - QL_BARY_BITS) << 1 | 1u;
    const uint32_t y = u2 >> (34 - QL_BARY_BITS) << 1 | 1u;

    /* b0 = x, b1 = 2y - x or b1 = y, b0 = 2x - y; then b2 = 1 - b0 - b1.
     * Returned as the weights of vertices 1 and 2. */
    *b1 = x < y ? x : 2 * x - y;
    *b2 = x < y ? 2 * y - x : y;
}
