/* ql_wide.h - 128-bit products and sums for oracles, on any host */
/* SPDX-License-Identifier: MIT */

#ifndef QL_WIDE_H
#define QL_WIDE_H

#include <stdint.h>

#if defined(__SIZEOF_INT128__)

__extension__ typedef __int128 wide_t;

static inline wide_t wide_mul(int64_t a, int64_t b)
{
    return (wide_t)a * b;
}

static inline wide_t wide_add(wide_t a, wide_t b)
{
    return a + b;
}

static inline wide_t wide_sub(wide_t a, wide_t b)
{
    return a - b;
}

static inline int wide_sign(wide_t a)
{
    return (a > 0) - (a < 0);
}

static inline uint64_t wide_low(wide_t a)
{
    return (uint64_t)a;
}

#else

/* Two's complement in two words. */
typedef struct {
    uint64_t low, high;
} wide_t;

static inline wide_t wide_add(wide_t a, wide_t b)
{
    wide_t r;

    r.low = a.low + b.low;
    r.high = a.high + b.high + (r.low < a.low);
    return r;
}

static inline wide_t wide_sub(wide_t a, wide_t b)
{
    wide_t r;

    r.low = a.low - b.low;
    r.high = a.high - b.high - (a.low < b.low);
    return r;
}

static inline wide_t wide_mul(int64_t a, int64_t b)
{
    const uint64_t x = (uint64_t)a, y = (uint64_t)b;
    const uint64_t xl = x & 0xffffffffu, xh = x >> 32;
    const uint64_t yl = y & 0xffffffffu, yh = y >> 32;
    const uint64_t mid = xh * yl + (xl * yl >> 32);
    const uint64_t low = xl * yh + (mid & 0xffffffffu);
    wide_t r;

    r.low = x * y;
    r.high = xh * yh + (mid >> 32) + (low >> 32);
    /* x stands for a + 2^64 where a is negative, y likewise */
    r.high -= (a < 0 ? y : 0) + (b < 0 ? x : 0);
    return r;
}

static inline int wide_sign(wide_t a)
{
    return a.high >> 63 ? -1 : (a.high | a.low) != 0;
}

static inline uint64_t wide_low(wide_t a)
{
    return a.low;
}

#endif

#endif
