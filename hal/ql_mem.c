/* ql_mem.c - the memcpy and memset that compilers call without being asked */
/* SPDX-License-Identifier: MIT */

#include <stddef.h>
#include <stdint.h>

/* Without this gcc turns the loops below into calls of themselves. */
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC optimize("no-tree-loop-distribute-patterns")
#endif

void *memcpy(void *restrict to, const void *restrict from, size_t size);
void *memset(void *to, int value, size_t size);

void *memcpy(void *restrict to, const void *restrict from, size_t size)
{
    uint8_t *d = to;
    const uint8_t *s = from;

    while (size-- > 0) {
        *d++ = *s++;
    }
    return to;
}

void *memset(void *to, int value, size_t size)
{
    uint8_t *d = to;

    while (size-- > 0) {
        *d++ = (uint8_t)value;
    }
    return to;
}
