/* ql_rgb.h - three channels with one exponent: throughput, BRDF values */
/* SPDX-License-Identifier: MIT */

#ifndef QL_RGB_H
#define QL_RGB_H

#include "math/ql_real.h"

/* Channel i is c[i] 2^(e - 31), c[i] any 32-bit number. A colour of
 * reflectances has e = 0 and products of those keep it; scaling by a real
 * number keeps 31 bits of the largest channel. */
typedef struct {
    ql_uq31_t c[3];
    int16_t e;
} ql_rgb_t;

/* Products whose e is below this become zero: far below the least that a
 * picture can show, and the throughput of a long path never wraps e. */
#define QL_RGB_EXP_MIN (-8192)

/* The largest channel's c. */
QL_INLINE uint32_t ql_rgb_most(const ql_rgb_t *a)
{
    const uint32_t m = a->c[0] > a->c[1] ? a->c[0] : a->c[1];

    return m > a->c[2] ? m : a->c[2];
}

/* Take a colour of exponent 0.
 *
 *   a     -      out
 *   from  uq31   little-endian, each in [0, 1]
 *   return  false if it is black
 *
 * Exact.
 */
bool ql_rgb_load(ql_rgb_t *a, const uint32_t from[3]);

/* Multiply by a colour of exponent 0, given little-endian u1.31 in [0, 1]. Each
 * channel to nearest; 1 is exact. */
QL_INLINE void ql_rgb_filter(ql_rgb_t *a, const uint32_t by[3])
{
    for (unsigned i = 0; i < 3; i++) {
        a->c[i] = ql_mul_uq31(a->c[i], QL_LE32(by[i]));
    }
}

/* Multiply by a real number.
 *
 *   a   -  any; all zero if by is zero
 *   by  -  any
 *
 * Error: half an ulp of 2^-30 of the largest channel, in each; exact for powers
 *        of two if every c is below 2^31. Zero below 2^QL_RGB_EXP_MIN.
 */
void ql_rgb_scale(ql_rgb_t *a, ql_real_t by);

/* Multiply by b. Error: half an ulp of 2^-30 of the product of both largest
 * channels, in each; exact by a gray power of two if every c is below 2^31.
 * Zero below 2^QL_RGB_EXP_MIN. */
void ql_rgb_mul(ql_rgb_t *a, const ql_rgb_t *b);

/* Add b to a. Error: an ulp of 2^-30 of the larger one's largest channel, in
 * each; exact if either is zero. */
void ql_rgb_add(ql_rgb_t *a, const ql_rgb_t *b);

#endif
