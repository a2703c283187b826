/* ql_vec.h - exact sums and products of integer 3-vectors */
/* SPDX-License-Identifier: MIT */

/* Names end in how arguments are taken, where there is a choice: _ptr by
 * pointers, so that a call need not copy them; _call by a call, for code that
 * is longer than it is hot. */

#ifndef QL_VEC_H
#define QL_VEC_H

#include "math/ql_real.h"

QL_C_BEGIN

/* A vector or point; the unit is its user's. */
typedef struct {
    int32_t x, y, z;
} ql_vec3_t;

/* a - b; the caller bounds it below 2^31. */
QL_INLINE ql_vec3_t ql_vec_sub(ql_vec3_t a, ql_vec3_t b)
{
    const ql_vec3_t r = {a.x - b.x, a.y - b.y, a.z - b.z};

    return r;
}

/* -v; no component is -2^31. */
QL_INLINE ql_vec3_t ql_vec_neg(ql_vec3_t v)
{
    const ql_vec3_t r = {-v.x, -v.y, -v.z};

    return r;
}

/* a x b; components up to 32768 and 32767: |result| <= 2 32767 32768 < 2^31. */
QL_FAST_INLINE void ql_vec_cross_ptr(
        ql_vec3_t *r, const ql_vec3_t *a, const ql_vec3_t *b)
{
    r->x = a->y * b->z - a->z * b->y;
    r->y = a->z * b->x - a->x * b->z;
    r->z = a->x * b->y - a->y * b->x;
}

QL_INLINE ql_vec3_t ql_vec_cross(ql_vec3_t a, ql_vec3_t b)
{
    ql_vec3_t r;

    ql_vec_cross_ptr(&r, &a, &b);
    return r;
}

/* a . b; the caller bounds it below 2^63. */
QL_INLINE int64_t ql_vec_dot(ql_vec3_t a, ql_vec3_t b)
{
    return (int64_t)a.x * b.x + (int64_t)a.y * b.y + (int64_t)a.z * b.z;
}

/* a . b, with the same bound, as a call. */
int64_t ql_vec_dot_call(ql_vec3_t a, ql_vec3_t b);

/* a . n for positions' differences a and an exact normal n (|n| < 2^31). In
 * draft a has 16 bits, so CPUs without wide multiplication take halves. */
QL_FAST_INLINE int64_t ql_vec_dot_normal_ptr(
        const ql_vec3_t *a, const ql_vec3_t *n)
{
    return QL_POS_BITS == 0 ? ql_dot_s16_s32(a->x, a->y, a->z, n->x, n->y, n->z)
                            : ql_vec_dot(*a, *n); /* 24 + 31 + 2 bits */
}

QL_INLINE int64_t ql_vec_dot_normal(ql_vec3_t a, ql_vec3_t n)
{
    return ql_vec_dot_normal_ptr(&a, &n);
}

/* |v|^2, cut to 32 bits; components below 2^30. */
ql_real_t ql_vec_square(ql_vec3_t v);

/* |v|^2 of positions' differences: components below 2^15 (draft), so 3 2^30
 * fits 32 bits, or 2^23 (fine). */
QL_INLINE ql_real_t ql_vec_square_pos(ql_vec3_t v)
{
    return ql_real_from_u64(QL_POS_BITS == 0 ? (uint32_t)(v.x * v.x) +
                                                       (uint32_t)(v.y * v.y) +
                                                       (uint32_t)(v.z * v.z)
                                             : (uint64_t)ql_vec_dot(v, v));
}

QL_C_END

#endif
