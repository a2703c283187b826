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

/* Put together, a product is 17 instructions: too many to insist on. */
#if QL_PORT_WIDE_MUL
#define QL_FX_INLINE QL_INLINE
#elif QL_CFG_SMALL
#define QL_FX_INLINE QL_FAST_INLINE
#else
#define QL_FX_INLINE static inline
#endif

/* High word of a product: floor(a b / 2^32). */
QL_FX_INLINE uint32_t ql_mulhi_u32(uint32_t a, uint32_t b)
{
#if QL_PORT_WIDE_MUL
    return (uint32_t)((uint64_t)a * b >> 32);
#else
    const uint32_t al = a & 0xffffu, ah = a >> 16;
    const uint32_t bl = b & 0xffffu, bh = b >> 16;
    const uint32_t mid = ah * bl + (al * bl >> 16); /* <= (2^16-1) 2^16 */
    const uint32_t low = al * bh + (mid & 0xffffu); /* likewise */

    return ah * bh + (mid >> 16) + (low >> 16);
#endif
}

/* floor(a b / 2^32) of a signed and an unsigned number. */
QL_INLINE int32_t ql_mulhi_su32(int32_t a, uint32_t b)
{
#if QL_PORT_WIDE_MUL
    return ql_i32((uint32_t)((uint64_t)((int64_t)a * (int64_t)b) >> 32));
#else
    const uint32_t high = ql_mulhi_u32((uint32_t)a, b);

    return ql_i32(a < 0 ? high - b : high); /* a + 2^32 was multiplied */
#endif
}

/* The whole product of two 32-bit numbers. */
QL_INLINE uint64_t ql_product_u32(uint32_t a, uint32_t b)
{
#if QL_PORT_WIDE_MUL
    return (uint64_t)a * b;
#else
    return (uint64_t)ql_mulhi_u32(a, b) << 32 | (uint32_t)(a * b);
#endif
}

/* Product of two numbers in [0, 1], rounded half up; exact for 0 and 1. */
QL_FX_INLINE ql_uq31_t ql_mul_uq31(ql_uq31_t a, ql_uq31_t b)
{
#if QL_PORT_WIDE_MUL
    return (uint32_t)(((uint64_t)a * b + 0x40000000u) >> 31);
#else
    const uint32_t high = ql_mulhi_u32(a, b), low = a * b;

    /* a b + 2^30 = high 2^32 + low + 2^30; the sum's carry goes into high */
    return (high + (low > 0xbfffffffu)) << 1 | (low + 0x40000000u) >> 31;
#endif
}

/* Exact dot product of a 16-bit and a 32-bit vector, if it is below 2^47. */
QL_INLINE int64_t ql_dot_s16_s32(
        int32_t ax, int32_t ay, int32_t az, int32_t bx, int32_t by, int32_t bz)
{
#if QL_PORT_WIDE_MUL
    return (int64_t)ax * bx + (int64_t)ay * by + (int64_t)az * bz;
#else
    /* b = high 2^16 + low: a low < 2^31, a high <= 2^30. The sum of the high
     * products is taken modulo 2^32; with the low products' high halves added
     * it is floor(dot / 2^16), which fits when |dot| < 2^47. */
    const uint32_t lx = (uint32_t)(ax * (int32_t)((uint32_t)bx & 0xffffu));
    const uint32_t ly = (uint32_t)(ay * (int32_t)((uint32_t)by & 0xffffu));
    const uint32_t lz = (uint32_t)(az * (int32_t)((uint32_t)bz & 0xffffu));
    const uint32_t low = (lx & 0xffffu) + (ly & 0xffffu) + (lz & 0xffffu);
    const uint32_t high = (uint32_t)(ax * ql_asr32(bx, 16)) +
                          (uint32_t)(ay * ql_asr32(by, 16)) +
                          (uint32_t)(az * ql_asr32(bz, 16)) +
                          (uint32_t)ql_asr32(ql_i32(lx), 16) +
                          (uint32_t)ql_asr32(ql_i32(ly), 16) +
                          (uint32_t)ql_asr32(ql_i32(lz), 16) + (low >> 16);

    /* floor(dot / 2^16) is taken as signed and widened again */
    return ql_i64((uint64_t)(int64_t)ql_i32(high) << 16 | (low & 0xffffu));
#endif
}

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

#endif
