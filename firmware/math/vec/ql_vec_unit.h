/* ql_vec_unit.h - vectors made unit vectors, or directions of few bits */
/* SPDX-License-Identifier: MIT */

/* All of one family: v / |v| in s2.29, by what is known of the length.
 *
 *   ql_vec_unit_q29()            v alone: components up to 2^30
 *   ql_vec_unit_q29_of_wide()    v alone: components below 2^48
 *   ql_vec_unit_q29_of_length()  v and |v| as a real number
 *   ql_vec_unit_q29_of_inv_n()   v exact and 1/|v| as the blob packs it
 *
 * 1/|n| of an exact normal is packed in 32 bits: the upper 27 are those of a
 * mantissa m, the lower 5 a number l, and 1/|n| = m 2^-32 2^(1 - l). */

#ifndef QL_VEC_UNIT_H
#define QL_VEC_UNIT_H

#include "math/vec/ql_vec.h"

/* 1/|n|, unpacked. Exact. */
QL_INLINE ql_real_t ql_vec_unit_unpack_inv_n(uint32_t inv_n)
{
    ql_real_t r;

    r.m = inv_n & ~(uint32_t)31;
    r.e = ql_real_exponent(-31 - (int32_t)(inv_n & 31u));
    return r;
}

/* Pack 1/|n|.
 *
 *   square  -  n . n, below 2^62
 *   return  -  1/|n|, packed; 0 for 0
 *
 * Error: relative, above by 2^-28 at most, below by 2^-28 and the five bits cut
 *        off the mantissa: 2^-26 + 2^-28; 1.002 2^-26 is the most ever found
 *        (tests/unit/test_sphere.c).
 * Cost:  one square root, one reciprocal.
 */
uint32_t ql_vec_unit_pack_inv_n(uint64_t square);

/* Unit vector of a direction.
 *
 *   v       -      components up to 2^30 in size
 *   return  s2.29  v / |v|; zero for zero
 *
 * Error: each component to nearest, and the length that of ql_rsqrt_m().
 * Cost:  one reciprocal root, six multiplications.
 */
ql_vec3_t ql_vec_unit_q29(ql_vec3_t v);

/* Unit vector of a long one.
 *
 *   x, y, z  -      components below 2^48 in size
 *   return   s2.29  v / |v|; zero for zero
 *
 * Error: relative, 2^-26 + 2^-28, from the packed mantissa.
 * Cost:  one square root, one reciprocal, nine multiplications.
 */
ql_vec3_t ql_vec_unit_q29_of_wide(int64_t x, int64_t y, int64_t z);

/* Unit vector of one whose length is known.
 *
 *   v       -      components below 2^30 in size, not all zero
 *   length  -      |v|, as ql_real_sqrt() has it
 *   return  s2.29  v / |v|
 *
 * Error: each component below 2^-29, downwards.
 * Cost:  one reciprocal, three multiplications.
 */
ql_vec3_t ql_vec_unit_q29_of_length(ql_vec3_t v, ql_real_t length);

/* Unit vector of an exact one.
 *
 *   n       -      |n| < 2^31
 *   inv_n   -      its 1/|n|, packed
 *   return  s2.29  n / |n|; for an inverse that is not n's, any vector
 *
 * Error: relative, that of inv_n; each component 2^-29 more, downwards.
 * Cost:  three multiplications.
 */
ql_vec3_t ql_vec_unit_q29_of_inv_n(ql_vec3_t n, uint32_t inv_n);

/* Round a direction of any length to QL_DIR_BITS.
 *
 *   v       any    components up to 2^30 in size
 *   return  s.b    the same direction, largest component 2^(b-1)..2^b in size;
 *           zero for zero
 *
 * Error: each component to nearest, so the angle within sqrt(3) 2^-b rad.
 */
ql_vec3_t ql_vec_to_dir(ql_vec3_t v);

#endif
