/* ql_hash.h - the hash behind every random number */
/* SPDX-License-Identifier: MIT */

#ifndef QL_HASH_H
#define QL_HASH_H

#include "base/ql_base.h"

/* Mix 32 bits: a bijection in which every input bit changes every output bit
 * with probability near 1/2.
 *
 *   x       any
 *   return  any; 0 for 0
 *
 * Cost: two multiplications.
 * From: the constants "lowbias32" of Wellons' search for hash functions (2018).
 */
QL_FAST_INLINE uint32_t ql_hash32(uint32_t x)
{
    x = (x ^ x >> 16) * 0x7feb352du;
    x = (x ^ x >> 15) * 0x846ca68bu;
    return x ^ x >> 16;
}

#endif
