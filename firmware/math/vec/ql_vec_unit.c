/* ql_vec_unit.c - unit vectors by what is known of a length; directions */
/* SPDX-License-Identifier: MIT */

#include "math/vec/ql_vec_unit.h"

uint32_t ql_vec_unit_pack_inv_n(uint64_t square)
{
    const ql_real_t r = ql_real_recip(ql_real_sqrt(ql_real_from_u64(square)));

    /* m 2^e = m 2^-32 2^(1 - l): l is 0..31 for |n| in [1, 2^31) */
    return r.m == 0 ? 0 : (r.m & ~31u) | ((uint32_t)(-31 - r.e) & 31u);
}

ql_vec3_t ql_vec_unit_q29(ql_vec3_t v)
{
    const uint64_t square = (uint64_t)ql_vec_dot_call(v, v); /* below 2^62 */
    const unsigned zeros = ql_clz64(square) & ~1u;           /* 2 or more */
    const int32_t scale =
            zeros < 64 ? (int32_t)((uint32_t)1 << (zeros / 2 - 1)) : 0;
    uint32_t r;

    if (square == 0) {
        return v;
    }
    /* |v| = sqrt(m) 2^(16 - zeros/2) with m in [2^30, 2^32), so v scale is
     * below 2^31; r = 2^47 / sqrt(m), and v scale r 2^-32 is v / |v| 2^30 */
    r = ql_rsqrt_m((uint32_t)(square << zeros >> 32));
    v.x = ql_asr32(ql_mulhi_su32(v.x * scale, r) + 1, 1);
    v.y = ql_asr32(ql_mulhi_su32(v.y * scale, r) + 1, 1);
    v.z = ql_asr32(ql_mulhi_su32(v.z * scale, r) + 1, 1);
    return v;
}

ql_vec3_t ql_vec_unit_q29_of_wide(int64_t x, int64_t y, int64_t z)
{
    const unsigned zeros = ql_clz64(ql_abs64(x) | ql_abs64(y) | ql_abs64(z));
    ql_vec3_t v = {0, 0, 0};

    if (zeros < 64) {
        /* to 30 bits; shifted left only if short, as a multiplication */
        const unsigned right = zeros < 34 ? 34 - zeros : 0;
        const int64_t left = (int64_t)1 << (zeros > 34 ? zeros - 34 : 0);

        v.x = (int32_t)ql_asr64(x * left, right);
        v.y = (int32_t)ql_asr64(y * left, right);
        v.z = (int32_t)ql_asr64(z * left, right);
        v = ql_vec_unit_q29_of_inv_n(
                v, ql_vec_unit_pack_inv_n((uint64_t)ql_vec_dot(v, v)));
    }
    return v;
}

/* x 2^up, or x / 2^-up cut; the result fits. */
static int32_t shift_up(int32_t x, int up)
{
    return up >= 0 ? ql_i32((uint32_t)x << up) : ql_asr32(x, (unsigned)-up);
}

ql_vec3_t ql_vec_unit_q29_of_length(ql_vec3_t v, ql_real_t length)
{
    /* v 2^s has its largest component in [2^29, 2^30); with 1/|v| = m 2^e
     * a component of the unit vector is v m 2^(e + 29) = high word of
     * (v 2^s) m, times 2^(e + 61 - s), which is 2, 1 or 1/2 */
    const ql_real_t inverse = ql_real_recip(length);
    const uint32_t most = ql_abs32(v.x) | ql_abs32(v.y) | ql_abs32(v.z);
    const int s = (int)ql_clz32(most) - 2;
    const int up = inverse.e + 61 - s;

    v.x = shift_up(ql_mulhi_su32(shift_up(v.x, s), inverse.m), up);
    v.y = shift_up(ql_mulhi_su32(shift_up(v.y, s), inverse.m), up);
    v.z = shift_up(ql_mulhi_su32(shift_up(v.z, s), inverse.m), up);
    return v;
}

/* x 2^(30 - l), or x / 2 if l = 31; then times m 2^-32 */
static ql_q29_t unit_part(int32_t x, unsigned l, uint32_t m)
{
    const int32_t scaled =
            l <= 30 ? ql_i32((uint32_t)x << (30 - l)) : ql_asr32(x, 1);

    return ql_mulhi_su32(scaled, m);
}

ql_vec3_t ql_vec_unit_q29_of_inv_n(ql_vec3_t n, uint32_t inv_n)
{
    /* 1/|n| = m 2^-32 2^(1-l), so 2^(l-1) < |n| <= 2^l and n 2^(30-l) fits;
     * times m 2^-32 it is n/|n| 2^29. l = 31 only for |n| > 2^30. */
    const unsigned l = inv_n & 31u;
    const uint32_t m = inv_n & ~(uint32_t)31;
    const ql_vec3_t r = {
            unit_part(n.x, l, m), unit_part(n.y, l, m), unit_part(n.z, l, m)};

    return r;
}

ql_vec3_t ql_vec_to_dir(ql_vec3_t v)
{
    const uint32_t largest = ql_abs32(v.x) | ql_abs32(v.y) | ql_abs32(v.z);
    const unsigned zeros = ql_clz32(largest);
    const int32_t half = (int32_t)(1ul << (29 - QL_DIR_BITS));
    const int32_t scale =
            zeros > 2 && zeros < 32 ? (int32_t)(1ul << (zeros - 2)) : 1;

    /* scaled below 2^30 (or exactly 2^30), then rounded to b bits */
    v.x = ql_asr32(v.x * scale + half, 30 - QL_DIR_BITS);
    v.y = ql_asr32(v.y * scale + half, 30 - QL_DIR_BITS);
    v.z = ql_asr32(v.z * scale + half, 30 - QL_DIR_BITS);
    return v;
}
