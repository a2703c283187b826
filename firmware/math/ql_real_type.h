/* ql_real_type.h - what a real number is; its exponent's range */
/* SPDX-License-Identifier: MIT */

/* ql_real.h, which has the operations, includes this. */

#ifndef QL_REAL_TYPE_H
#define QL_REAL_TYPE_H

#include "math/ql_fx.h"

QL_C_BEGIN

typedef struct {
    uint32_t m;
    int16_t e;
} ql_real_t;

/* The range of e. Exponents are added in 32 bits, and every sum is within
 * QL_REAL_EXP_MAX of 0, so that it fits in 16 bits again. Where they come from:
 *
 *   numbers   integers of up to 128 bits, the blob's fields and constants have
 *             |e| <= 128; with the powers of two that their formats ask for,
 *             |e| <= 160
 *   products  no value of the renderer is a product of more than 16 of those
 *             and of two densities of a cos^m lobe, which end at 2^-4096
 *             (ql_warp_lobe_pdf()): |e| < 16 160 + 2 4256 < 11100
 *   colours   a path multiplies its throughput up by less than 2^64 at each of
 *             its 64 bounces, so by 2^4096 in all; ql_rgb.c makes one below
 *             2^QL_RGB_EXP_MIN zero. A colour times a value of the renderer is
 *             within 8192 + 11100 = 19292 until it is made zero
 *
 * A build with QL_CFG_ASSERT checks every exponent. */
#define QL_REAL_EXP_MAX 20000

/* A real as an expression; m is normalised. */
#define QL_REAL(m, e) ((ql_real_t){(m), (e)})

#define QL_PI_M     0xc90fdaa2u /* pi 2^30 */
#define QL_INV_PI_M 0xa2f9836eu /* 2^33 / pi */

#define QL_REAL_ZERO    QL_REAL(0, 0)
#define QL_REAL_ONE     QL_REAL(0x80000000u, -31)
#define QL_REAL_HALF_PI QL_REAL(QL_PI_M, -31)
#define QL_REAL_PI      QL_REAL(QL_PI_M, -30)
#define QL_REAL_TWO_PI  QL_REAL(QL_PI_M, -29)
#define QL_REAL_INV_PI  QL_REAL(QL_INV_PI_M, -33)
#define QL_REAL_INV_2PI QL_REAL(QL_INV_PI_M, -34)

/* A sum of exponents as an exponent; the range above says that it fits. A
 * macro, because compilers add in 16 bits only where they see the cast. */
#if QL_CFG_ASSERT
QL_INLINE int16_t ql_real_exponent(int32_t e)
{
    QL_ASSERT(e >= -QL_REAL_EXP_MAX && e <= QL_REAL_EXP_MAX);
    return (int16_t)e;
}
#else
#define ql_real_exponent(e) ((int16_t)(e))
#endif

/* a 2^n, exactly. */
QL_INLINE ql_real_t ql_real_scale(ql_real_t a, int32_t n)
{
    a.e = ql_real_exponent(a.e + n);
    return a;
}

/* Is a below b? */
QL_INLINE bool ql_real_less(ql_real_t a, ql_real_t b)
{
    return b.m != 0 && (a.m == 0 || a.e < b.e || (a.e == b.e && a.m < b.m));
}

/* Reciprocal of a mantissa m in [2^31, 2^32).
 *
 *   m       -  m / 2^32 in [1/2, 1)
 *   return  2^63 / m in (2^31, 2^32): half the reciprocal of m / 2^32, u0.32
 *
 * Error: at most 4 ulp of 2^-32 (tests/unit/test_real.c).
 * Cost:  one look-up, five multiplications.
 * From:  Newton's method, r' = r (2 - m r), twice from 7.9 bits.
 */
uint32_t ql_recip_m(uint32_t m);

QL_C_END

#endif
