/* ql_base.h - status codes, assertions, byte order, helpers for shifts */
/* SPDX-License-Identifier: MIT */

#ifndef QL_BASE_H
#define QL_BASE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "ql_config.h"

/* Between these a C++ compiler sees C functions. */
#ifdef __cplusplus
#define QL_C_BEGIN extern "C" {
#define QL_C_END   }
#else
#define QL_C_BEGIN
#define QL_C_END
#endif

QL_C_BEGIN

/* Every status: name, number, text. Numbers are never reused. */
#define QL_STATUS_LIST(X)                                                      \
    X(QL_OK, 0, "done")                                                        \
    X(QL_ERR_ALIGN, -1, "the blob is not 4-byte aligned")                      \
    X(QL_ERR_MAGIC, -2, "not a qlux blob")                                     \
    X(QL_ERR_VERSION, -3,                                                      \
            "the blob's version is not the one this build reads")              \
    X(QL_ERR_TRUNCATED, -4, "the blob is longer than the bytes given")         \
    X(QL_ERR_CHECKSUM, -5, "the blob's CRC-32 does not match its contents")    \
    X(QL_ERR_RANGE, -6, "an offset, index, count or value is out of range")    \
    X(QL_ERR_CAPACITY, -7, "the BVH is deeper than this build's stack")        \
    X(QL_ERR_FEATURE, -8, "the scene needs a feature this build lacks")        \
    X(QL_ERR_SETTINGS, -9, "a render setting is out of range")                 \
    X(QL_ERR_DISPLAY, -10, "the display did not accept the pixels")            \
    X(QL_ERR_SERIAL, -11, "the serial port did not accept the bytes")          \
    X(QL_ERR_STOPPED, -12, "stopped by the user")

typedef enum {
#define QL_STATUS_ENUM(name, number, text) name = (number),
    QL_STATUS_LIST(QL_STATUS_ENUM)
#undef QL_STATUS_ENUM
} ql_status_t;

/* Name a status in words.
 *
 *   status  -  any value
 *   return  a constant string; "unknown status" for a number not in the list
 */
const char *ql_status_text(ql_status_t status);

#if defined(__GNUC__)
#define QL_MUST_CHECK __attribute__((warn_unused_result))
#define QL_INLINE     static inline __attribute__((always_inline))
#define QL_NOINLINE   __attribute__((noinline))
#define QL_LIKELY(x)  __builtin_expect(!!(x), 1)
#else
#define QL_MUST_CHECK
#define QL_INLINE static inline
#define QL_NOINLINE
#define QL_LIKELY(x) (x)
#endif

/* Inline for speed; a function of its own where QL_CFG_SMALL asks for that. */
#if QL_CFG_SMALL && defined(__GNUC__)
#define QL_FAST_INLINE static __attribute__((noinline, unused))
#elif QL_CFG_SMALL
#define QL_FAST_INLINE static inline
#else
#define QL_FAST_INLINE QL_INLINE
#endif

/* A claim about our own code. A debug build reports it and stops; a release
 * build compiles it away. Never used for bad input. */
#if QL_CFG_ASSERT
/* Report a broken claim and stop; the port provides it.
 *
 *   file, line  -  where
 *   claim       -  what was not true
 */
void ql_assert_fail(const char *file, int line, const char *claim);
#define QL_ASSERT(claim)                                                       \
    ((claim) ? (void)0 : ql_assert_fail(__FILE__, __LINE__, #claim))
#else
#define QL_ASSERT(claim) ((void)0)
#endif

/* A claim the compiler checks: a negative array size names the line. */
#define QL_STATIC_ASSERT(claim, name) typedef char name[(claim) ? 1 : -1]

QL_STATIC_ASSERT((-1 & 3) == 3, ql_needs_twos_complement);
QL_STATIC_ASSERT(sizeof(int32_t) == 4 && sizeof(int64_t) == 8, ql_needs_octets);

/* Blob fields are little-endian and read in place: QL_LE16/32 turn a field as
 * it lies in memory into a number. They cost nothing on little-endian CPUs. */
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
#define QL_BIG_ENDIAN 1
#define QL_LE16(v)    ((uint16_t)(((v) >> 8 & 0xffu) | ((v)&0xffu) << 8))
#define QL_LE32(v)    __builtin_bswap32(v)
#else
#define QL_BIG_ENDIAN 0
#define QL_LE16(v)    (v)
#define QL_LE32(v)    (v)
#endif

/* Reinterpret 16, 32 or 64 bits as two's complement. C leaves the plain cast
 * implementation-defined above the maximum; compilers fold this to nothing. */
QL_INLINE int32_t ql_i32(uint32_t bits)
{
    return bits <= 0x7fffffffu ? (int32_t)bits : -(int32_t)~bits - 1;
}

QL_INLINE int16_t ql_i16(uint16_t bits)
{
    return (int16_t)(bits <= 0x7fffu ? (int32_t)bits : (int32_t)bits - 65536);
}

QL_INLINE int64_t ql_i64(uint64_t bits)
{
    return bits <= UINT64_MAX / 2 ? (int64_t)bits : -(int64_t)~bits - 1;
}

/* Arithmetic shift right, rounding towards minus infinity. C leaves x >> n of a
 * negative x implementation-defined; compilers fold this to one instruction. */
QL_INLINE int32_t ql_asr32(int32_t x, unsigned n)
{
    return x < 0 ? ~(~x >> n) : x >> n;
}

QL_INLINE int64_t ql_asr64(int64_t x, unsigned n)
{
    return x < 0 ? ~(~x >> n) : x >> n;
}

/* |x| as unsigned: defined for INT32_MIN too. */
QL_INLINE uint32_t ql_abs32(int32_t x)
{
    return x < 0 ? 0u - (uint32_t)x : (uint32_t)x;
}

QL_INLINE uint64_t ql_abs64(int64_t x)
{
    return x < 0 ? 0u - (uint64_t)x : (uint64_t)x;
}

#if defined(__GNUC__) && !(QL_CFG_SMALL && defined(__ARM_ARCH_6M__))
#define QL_CLZ_BUILTIN 1
#define QL_CLZ_INLINE  QL_INLINE
#else
#define QL_CLZ_BUILTIN 0
#define QL_CLZ_INLINE  QL_FAST_INLINE
#endif

/* Leading zero bits; 32 (64) for 0. Where the CPU cannot count them the
 * compiler's own function is longer than a loop. */
#if QL_CLZ_BUILTIN
QL_CLZ_INLINE unsigned ql_clz32(uint32_t x)
{
    if (x == 0) {
        return 32;
    }
    return (unsigned)__builtin_clzl((unsigned long)x) -
           8u * (unsigned)(sizeof(unsigned long) - 4);
}
#else
QL_CLZ_INLINE unsigned ql_clz32(uint32_t x)
{
    unsigned n = 0;

    if (x == 0) {
        return 32;
    }
    for (; x < 0x80000000u; x <<= 1) {
        n++;
    }
    return n;
}
#endif

QL_INLINE unsigned ql_clz64(uint64_t x)
{
    const uint32_t high = (uint32_t)(x >> 32);
    return high != 0 ? ql_clz32(high) : 32u + ql_clz32((uint32_t)x);
}

QL_C_END

#endif
