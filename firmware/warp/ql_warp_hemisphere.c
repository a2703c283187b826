/* ql_warp_hemisphere.c - directions of the hemisphere: cosine, uniform */
/* SPDX-License-Identifier: MIT */

#include "warp/ql_warp_hemisphere.h"

#include "warp/ql_warp_sphere.h"

ql_vec3_t ql_warp_hemisphere_cosine(ql_vec3_t n, ql_uq32_t u1, ql_uq32_t u2)
{
    ql_vec3_t v = ql_warp_sphere(u1, u2);

    v.x += n.x; /* at most 2 in size: < 2^30 + 2^15 */
    v.y += n.y;
    v.z += n.z;
    return v;
}

ql_real_t ql_warp_hemisphere_cosine_pdf(int64_t product)
{
    const uint64_t twice = product > 0 ? (uint64_t)product : 1u; /* 2^-58 */

    return ql_real_mul_call(
            ql_real_sqrt(ql_real_from_uq_call(twice, 59)), QL_REAL_INV_PI);
}

ql_vec3_t ql_warp_hemisphere_uniform(ql_uq32_t u1, ql_uq32_t u2)
{
    return ql_warp_sphere_off_axis(
            ql_real_midpoint(~u1), u2); /* 1 - midpoint, exactly */
}
