/* ql_shading.c - the cosine to the shading normal */
/* SPDX-License-Identifier: MIT */

#include "trace/surface/ql_shading.h"

ql_real_t ql_shading_cosine(const ql_surface_t *surface, ql_vec3_t w)
{
    /* three products of less than 2^30 2^31 */
    const int64_t above = ql_vec_dot_call(w, surface->n);

    if (above <= 0) {
        return QL_REAL_ZERO;
    }
    if (ql_surface_is_smooth(surface)) {
        const int64_t cosine = ql_vec_dot_call(w, ql_surface_shade(surface));

        return cosine > 0 ? ql_real_from_uq_call((uint64_t)cosine, 29)
                          : QL_REAL_ZERO;
    }
    return ql_real_mul_call(ql_real_from_u64((uint64_t)above),
            ql_vec_unit_unpack_inv_n(surface->inv_n));
}

ql_real_t ql_shading_cosine_of_dir(const ql_surface_t *surface, ql_vec3_t w)
{
    return ql_real_mul(ql_shading_cosine(surface, w),
            ql_real_recip(ql_real_sqrt(ql_vec_square(w))));
}
