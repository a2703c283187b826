/* ql_sobol.h - Owen-scrambled Sobol points in two dimensions, integers only */
/* SPDX-License-Identifier: MIT */

/* Everything happens on bit-reversed words, where Owen's scrambling (a random
 * flip of each bit by a function of the bits above it) becomes a hash whose
 * bits depend only on the bits below. From: Burley, "Practical Hash-based Owen
 * Scrambling", JCGT 9(4), 2020; the hash is Vegdahl's 2021 improvement of
 * Laine and Karras', because in the original seeds that agree in their low 16
 * bits scramble alike. */

#ifndef QL_SOBOL_H
#define QL_SOBOL_H

#include "base/ql_base.h"

/* Swap the four bytes of a word. */
#if defined(__GNUC__)
QL_FAST_INLINE uint32_t ql_swap_bytes(uint32_t x)
{
    return __builtin_bswap32(x);
}
#else
QL_FAST_INLINE uint32_t ql_swap_bytes(uint32_t x)
{
    x = (x >> 8 & 0x00ff00ffu) | (x & 0x00ff00ffu) << 8;
    return x >> 16 | x << 16;
}
#endif

/* Reverse the 32 bits of x. */
#if defined(__thumb2__) && defined(__GNUC__)
QL_FAST_INLINE uint32_t ql_reverse32(uint32_t x)
{
    uint32_t r;

    __asm__("rbit %0, %1" : "=r"(r) : "r"(x));
    return r;
}
#elif QL_CFG_SMALL
QL_FAST_INLINE uint32_t ql_reverse32(uint32_t x)
{
    uint32_t mask = 0xffffffffu;

    /* swap halves, quarters, ..: 0x0000ffff, 0x00ff00ff, .., 0x55555555 */
    for (unsigned shift = 16; shift > 0; shift >>= 1) {
        mask ^= mask << shift;
        x = (x >> shift & mask) | (x & mask) << shift;
    }
    return x;
}
#else
QL_FAST_INLINE uint32_t ql_reverse32(uint32_t x)
{
    x = (x >> 1 & 0x55555555u) | (x & 0x55555555u) << 1;
    x = (x >> 2 & 0x33333333u) | (x & 0x33333333u) << 2;
    x = (x >> 4 & 0x0f0f0f0fu) | (x & 0x0f0f0f0fu) << 4;
    return ql_swap_bytes(x);
}
#endif

/* Scramble a bit-reversed word: a bijection; bit k of the result depends on
 * bits 0..k of x only. Cost: four multiplications. */
QL_FAST_INLINE uint32_t ql_owen_reversed(uint32_t x, uint32_t seed)
{
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= seed >> 16 | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

/* Sobol's second dimension: Pascal's triangle modulo 2 as a matrix, from an
 * index to a bit-reversed coordinate (the first dimension, bit-reversed, is the
 * index itself). Column k of the matrix is (1 + x)^k, so the
 * product doubles in five steps. */
#if QL_CFG_SMALL
QL_INLINE uint32_t ql_sobol_1_reversed(uint32_t x)
{
    uint32_t mask = 0xffffffffu;

    /* the same steps, which commute, last one first; ql_reverse32()'s masks */
    for (unsigned shift = 16; shift > 0; shift >>= 1) {
        mask ^= mask << shift;
        x ^= x >> shift & mask;
    }
    return x;
}
#else
QL_INLINE uint32_t ql_sobol_1_reversed(uint32_t x)
{
    x ^= (x & 0xaaaaaaaau) >> 1;
    x ^= (x & 0xccccccccu) >> 2;
    x ^= (x & 0xf0f0f0f0u) >> 4;
    x ^= (x & 0xff00ff00u) >> 8;
    return x ^ x >> 16;
}
#endif

#endif
