/* ql_warp_cone.c - uniform directions of a cone, the cone of a sphere */
/* SPDX-License-Identifier: MIT */

#include "warp/ql_warp_cone.h"

#include "warp/ql_warp_sphere.h"

ql_real_t ql_warp_cone_of_sphere(ql_real_t ratio2)
{
    ql_real_t root, sum;

    if (ratio2.m == 0 || ratio2.e > -32) {
        return ratio2.m == 0 ? QL_REAL_ZERO : QL_REAL_ONE;
    }
    /* (1 - r2) 2^32: exact where it is small, for there r2 has 32 bits */
    root = ql_real_from_u64(((uint64_t)1 << 32) - ql_real_to_uq32(ratio2));
    root = ql_real_sqrt(ql_real_scale(root, -32));
    sum = ql_real_add(QL_REAL_ONE, root);
    return ql_real_mul(ratio2, ql_real_recip(sum));
}

ql_vec3_t ql_warp_cone(ql_real_t s_max, ql_uq32_t u1, ql_uq32_t u2)
{
    return ql_warp_sphere_off_axis(
            ql_real_mul(s_max, ql_real_midpoint(u1)), u2);
}

ql_real_t ql_warp_cone_pdf(ql_real_t s_max)
{
    return ql_real_mul(ql_real_recip(s_max), QL_REAL_INV_2PI);
}
