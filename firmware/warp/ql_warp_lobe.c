/* ql_warp_lobe.c - directions distributed as a power of the cosine */
/* SPDX-License-Identifier: MIT */

#include "warp/ql_warp_lobe.h"

#include "math/ql_real_log.h"
#include "warp/ql_warp_sphere.h"

/* m + 1 */
static ql_real_t one_more(ql_uq16_t power)
{
    return ql_real_scale(ql_real_from_u64((uint64_t)power + 65536u), -16);
}

ql_real_t ql_warp_lobe_inverse(ql_uq16_t power)
{
    return ql_real_recip(one_more(power));
}

ql_vec3_t ql_warp_lobe(
        ql_real_t inverse, ql_uq32_t u1, ql_uq32_t u2, ql_uq31_t *s)
{
    const ql_real_t log =
            ql_real_log_minus_log2(ql_real_midpoint(u1), ql_real_midpoint(~u1));
    const ql_real_t exact = ql_real_log_decay(ql_real_mul(log, inverse));
    const ql_uq32_t fixed = ql_real_to_uq32(exact);

    *s = (fixed >> 1) + (fixed & 1u); /* to nearest */
    return ql_warp_sphere_off_axis(exact, u2);
}

ql_real_t ql_warp_lobe_pdf(ql_uq16_t power, ql_uq31_t s)
{
    const ql_real_t scale = ql_real_mul(one_more(power), QL_REAL_INV_2PI);
    ql_real_t m, u, w;

    if (s >= QL_UQ31_ONE) {
        return QL_REAL_ZERO;
    }
    if (s == 0) {
        return scale;
    }
    m = ql_real_scale(ql_real_from_u64(power), -16);
    u = ql_real_scale(ql_real_from_u64(QL_UQ31_ONE - s), -31);
    w = ql_real_scale(ql_real_from_u64(s), -31);
    return ql_real_mul(scale, ql_real_log_half_to_the(ql_real_mul(
                                      m, ql_real_log_minus_log2(u, w))));
}
