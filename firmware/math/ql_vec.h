/* ql_vec.h - exact products of integer 3-vectors */
/* SPDX-License-Identifier: MIT */

#ifndef QL_VEC_H
#define QL_VEC_H

#include "math/ql_fx.h"

/* A vector or point; the unit is its user's. */
typedef struct {
    int32_t x, y, z;
} ql_vec3_t;

QL_INLINE ql_vec3_t ql_vec_sub(ql_vec3_t a, ql_vec3_t b)
{
    const ql_vec3_t r = {a.x - b.x, a.y - b.y, a.z - b.z};

    return r;
}

/* a x b; components up to 32768 and 32767: |result| <= 2 32767 32768 < 2^31.
 * The function takes its vectors where they lie, as calls want them. */
QL_FAST_INLINE void ql_vec_cross_to(
        ql_vec3_t *r, const ql_vec3_t *a, const ql_vec3_t *b)
{
    r->x = a->y * b->z - a->z * b->y;
    r->y = a->z * b->x - a->x * b->z;
    r->z = a->x * b->y - a->y * b->x;
}

QL_INLINE ql_vec3_t ql_vec_cross(ql_vec3_t a, ql_vec3_t b)
{
    ql_vec3_t r;

    ql_vec_cross_to(&r, &a, &b);
    return r;
}

/* a . b; the caller bounds it below 2^63. */
QL_INLINE int64_t ql_vec_dot(ql_vec3_t a, ql_vec3_t b)
{
    return (int64_t)a.x * b.x + (int64_t)a.y * b.y + (int64_t)a.z * b.z;
}

/* a . n for positions' differences a and an exact normal n (|n| < 2^31). In
 * draft a has 16 bits, so CPUs without wide multiplication take halves. */
QL_FAST_INLINE int64_t ql_vec_dot_n_of(const ql_vec3_t *a, const ql_vec3_t *n)
{
#if QL_POS_BITS == 0
    return ql_dot_s16_s32(a->x, a->y, a->z, n->x, n->y, n->z);
#else
    return ql_vec_dot(*a, *n); /* 24 + 31 + 2 bits */
#endif
}

QL_INLINE int64_t ql_vec_dot_n(ql_vec3_t a, ql_vec3_t n)
{
    return ql_vec_dot_n_of(&a, &n);
}

/* Unit vector of an exact one.
 *
 *   n        -      |n| < 2^31
 *   inverse  -      its 1/|n| as packed in ql_blob_tri_t
 *   return   s2.29  n / |n|; for an inverse that is not n's, any vector
 *
 * Error: 2^-26 relative, from the packed mantissa.
 * Cost:  three multiplications.
 */
ql_vec3_t ql_vec_unit(ql_vec3_t n, uint32_t inverse);

#endif
