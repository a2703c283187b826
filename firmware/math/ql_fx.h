/* ql_fx.h - fixed-point formats and exact products */
/* SPDX-License-Identifier: MIT */

/* The number formats, all of them. N in a type's name is its fraction bits.
 *
 *   type        container  written  range       for
 *   ql_pos_t    int32      s15.f    the box     positions; f = QL_POS_BITS
 *   ql_dir_t    int32      s.b      +-2^b       directions; b = QL_DIR_BITS
 *   ql_q29_t    int32      s2.29    [-4, 4)     unit vectors; holds +-1
 *   ql_uq30_t   uint32     u2.30    [0, 4)      ray parameters
 *   ql_uq31_t   uint32     u1.31    [0, 2)      albedo, throughput
 *   ql_uq32_t   uint32     u0.32    [0, 1)      random numbers, emission
 *   ql_uq16_t   uint32     u16.16   [0, 65536)  display-linear colour
 *   ql_turn32_t uint32     u0.32    wraps       angles: one turn
 *   ql_sum_t    uint64 x3  u40.24   -           sums of samples (ql_film.h)
 *   ql_real_t   m, e       m 2^e    -           see ql_real.h
 *
 * A random number u stands for the midpoint (2u + 1) / 2^33 of its interval. */

#ifndef QL_FX_H
#define QL_FX_H

#include "base/ql_base.h"

typedef int32_t ql_pos_t;
typedef int32_t ql_dir_t;
typedef int32_t ql_q29_t;
typedef uint32_t ql_uq30_t;
typedef uint32_t ql_uq31_t;
typedef uint32_t ql_uq32_t;
typedef uint32_t ql_uq16_t;
typedef uint32_t ql_turn32_t;

#define QL_UQ31_ONE 0x80000000u

/* QL_PORT_WIDE_MUL: 1 if the CPU multiplies 32 x 32 -> 64 bits in hardware.
 * Without it the products below are put together from 16-bit halves; the
 * results are the same numbers. */
#ifndef QL_PORT_WIDE_MUL
#if defined(__ARM_ARCH_6M__) || defined(__ARM_ARCH_8M_BASE__) ||               \
        defined(__AVR__)
#define QL_PORT_WIDE_MUL 0
#else
#define QL_PORT_WIDE_MUL 1
#endif
#endif

/* Products, by either file. Put together from halves, a product is 17
 * instructions: too many to insist on inlining.
 *
 *   ql_mulhi_u32          high word of a product: floor(a b / 2^32)
 *   ql_mulhi_u32_rounded  the same product to nearest: round(a b / 2^32)
 *   ql_mulhi_su32         floor(a b / 2^32) of a signed a and an unsigned b
 *   ql_product_u32        the whole product of two 32-bit numbers
 *   ql_mul_uq31           product of two numbers in [0, 1], rounded half up;
 *                         exact for 0 and 1
 *   ql_dot_s16_s32        exact dot product of a 16-bit and a 32-bit vector, if
 *                         it is below 2^47
 */
#if QL_PORT_WIDE_MUL
#include "math/ql_fx_wide.h"
#else
#include "math/ql_fx_halves.h"
#endif

QL_C_BEGIN

/* Multiply a 64-bit number by a 16-bit one.
 *
 *   a       -  any
 *   b       -  0..65535
 *   return  a b modulo 2^64, as two's complement
 *
 * Exact. Cost: with QL_CFG_SMALL up to 16 steps of a loop, and not the
 * compiler's own function.
 */
#if QL_CFG_SMALL
int64_t ql_mul_s64_u16(int64_t a, uint16_t b);
#else
QL_INLINE int64_t ql_mul_s64_u16(int64_t a, uint16_t b)
{
    return ql_i64((uint64_t)a * b);
}
#endif

/* Divide a 64-bit number by a 16-bit one, without a 64-bit division.
 *
 *   a       -  any
 *   b       -  1..65535
 *   return  a / b, rounded towards zero
 *
 * Exact. Cost: 64 steps of a loop; for setting up, not for rays.
 */
int64_t ql_div_s64_u16(int64_t a, uint16_t b);

QL_C_END

#endif
