/* ql_vec.c - unit vector from an exact one and its packed inverse length */
/* SPDX-License-Identifier: MIT */

#include "math/ql_vec.h"

/* x 2^(30 - e), or x / 2 if e = 31; then times m 2^-32 */
static ql_q29_t unit_part(int32_t x, unsigned e, uint32_t m)
{
    const int32_t shifted =
            e <= 30 ? ql_i32((uint32_t)x << (30 - e)) : ql_asr32(x, 1);

    return ql_mulhi_su32(shifted, m);
}

ql_vec3_t ql_vec_unit(ql_vec3_t n, uint32_t inverse)
{
    /* 1/|n| = m 2^-32 2^(1-e), so 2^(e-1) < |n| <= 2^e and n 2^(30-e) fits;
     * times m 2^-32 it is n/|n| 2^29. e = 31 only for |n| > 2^30. */
    const unsigned e = inverse & 31u;
    const uint32_t m = inverse & ~31u;
    const ql_vec3_t r = {
            unit_part(n.x, e, m), unit_part(n.y, e, m), unit_part(n.z, e, m)};

    return r;
}
