/* remainder.h - what a division left over, for shares by largest remainder */
/* SPDX-License-Identifier: MIT */

#ifndef REMAINDER_H
#define REMAINDER_H

#include <stdint.h>

typedef struct {
    uint64_t rest;
    uint32_t index; /* of the entry whose share it is */
} remainder_t;

/* For qsort() of remainders, or of structs that begin with one: the largest
 * first, equal ones in the order of their entries. */
static inline int remainder_compare(const void *a, const void *b)
{
    const remainder_t *x = a, *y = b;

    if (x->rest != y->rest) {
        return x->rest > y->rest ? -1 : 1;
    }
    return x->index < y->index ? -1 : 1;
}

#endif
