/* ql_vec.c - dot products of integer 3-vectors, as calls */
/* SPDX-License-Identifier: MIT */

#include "math/vec/ql_vec.h"

int64_t ql_vec_dot_call(ql_vec3_t a, ql_vec3_t b)
{
    return ql_vec_dot(a, b);
}

ql_real_t ql_vec_square(ql_vec3_t v)
{
    return ql_real_from_u64((uint64_t)ql_vec_dot(v, v));
}
