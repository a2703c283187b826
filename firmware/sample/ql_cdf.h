/* ql_cdf.h - exact sampling of discrete distributions by prefix sums */
/* SPDX-License-Identifier: MIT */

#ifndef QL_CDF_H
#define QL_CDF_H

#include "math/ql_fx.h"

/* Pick one entry of a discrete distribution, with probability its mass.
 *
 *   cum     uq32        little-endian lower bounds of the entries, the first 0,
 *                       none decreasing; the last entry ends at 2^32
 *   stride  words       32-bit words from one bound to the next
 *   count   -           1 or more
 *   u       uq32 [0,1)  uniform; a larger u never gives a smaller index
 *   return  largest index with cum <= u
 *
 * Exact: entry i is chosen by exactly cum[i+1] - cum[i] of the 2^32 values of
 * u, so dividing by that mass adds no bias. Entries of zero mass are never
 * chosen (the one after them has the same bound), except the last ones, which
 * a builder leaves out.
 * Cost:  ceil(log2(count)) compares; no multiplication of more than the index.
 */
QL_INLINE uint16_t ql_cdf_sample(
        const uint32_t *cum, unsigned stride, uint16_t count, ql_uq32_t u)
{
    uint32_t low = 0, high = count;

    QL_ASSERT(count > 0);

    /* Invariant: cum[low] <= u < cum[high], taking cum[count] as 2^32. */
    while (high - low > 1) {
        const uint32_t mid = (low + high) / 2;

        if (QL_LE32(cum[mid * stride]) <= u) {
            low = mid;
        } else {
            high = mid;
        }
    }
    return (uint16_t)low; /* < count */
}

/* Probability of one entry.
 *
 *   cum     uq32      as for ql_cdf_sample()
 *   stride  words     as for ql_cdf_sample()
 *   count   -         as for ql_cdf_sample()
 *   entry   0..count-1
 *   return  2^-32     0..2^32: the mass that ql_cdf_sample() chooses it with
 *
 * Exact: over all entries the masses sum to 2^32.
 */
QL_INLINE uint64_t ql_cdf_pmf(
        const uint32_t *cum, unsigned stride, uint16_t count, uint16_t entry)
{
    const uint32_t next = (uint32_t)entry + 1;
    const uint64_t end =
            next < count ? QL_LE32(cum[next * stride]) : (uint64_t)1 << 32;

    QL_ASSERT(entry < count);
    return end - QL_LE32(cum[(uint32_t)entry * stride]);
}

#endif
