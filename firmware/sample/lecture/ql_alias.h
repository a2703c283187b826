/* ql_alias.h - discrete choice in constant time, exact in integers */
/* SPDX-License-Identifier: MIT */

/* An alias table cuts a bar of n W units into n columns of height W. Column j
 * holds entry j below its threshold and one other entry above it:
 *
 *     P(i) = (t_i + sum of W - t_j over the j whose alias is i) / (n W)
 *          = w_i / W, with no rounding: W and all of t and w are integers.
 *
 * Twelve bytes an entry where prefix sums take two or four, and no order: a
 * larger u need not give a larger index, so stratified u stay stratified only
 * within a column. Worth it where one distribution serves many samples.
 *
 * Nothing in the core calls this, and no firmware holds a byte of it: it is
 * here for qlux-warp and the tests, which compare it with ql_cdf.h. */

#ifndef QL_ALIAS_H
#define QL_ALIAS_H

#include "math/ql_fx.h"

/* Words of one column, little-endian. */
enum {
    QL_ALIAS_THRESHOLD, /* t, 0..W; W only if the alias is the entry itself */
    QL_ALIAS_OTHER,     /* index of the entry above the threshold */
    QL_ALIAS_WEIGHT,    /* w of the entry with this index, 0..W */
    QL_ALIAS_WORDS
};

typedef struct {
    const uint32_t *words; /* QL_ALIAS_WORDS for each entry */
    uint32_t total;        /* W, 1 or more: the sum of the weights */
    uint16_t count;        /* n, 1 or more */
} ql_alias_t;

/* Look up the entry at a height of a column; P(i) = w_i / W over all of them.
 *
 *   alias   -         from a builder that checked it
 *   column  0..n-1    uniform
 *   height  0..W-1    uniform
 *   return  index in [0, n)
 *
 * Exact: entry i is at n w_i of the n W places. One of weight 0 is at none.
 * Cost:  one comparison, two loads at most.
 */
QL_INLINE uint16_t ql_alias_at(
        const ql_alias_t *alias, uint16_t column, uint32_t height)
{
    const uint32_t *entry = alias->words + (uint32_t)column * QL_ALIAS_WORDS;

    return height < QL_LE32(entry[QL_ALIAS_THRESHOLD])
                   ? column
                   : (uint16_t)QL_LE32(entry[QL_ALIAS_OTHER]);
}

/* Probability of one entry.
 *
 *   alias   -       from a builder that checked it
 *   entry   0..n-1
 *   return  0..W    w of the entry: its probability is w / W
 */
QL_INLINE uint32_t ql_alias_pmf(const ql_alias_t *alias, uint16_t entry)
{
    return QL_LE32(
            alias->words[(uint32_t)entry * QL_ALIAS_WORDS + QL_ALIAS_WEIGHT]);
}

/* Pick one entry of a discrete distribution in constant time.
 *
 *   alias   -           from a builder that checked it
 *   u1      uq32 [0,1)  uniform: the column, floor(u1 n)
 *   u2      uq32 [0,1)  uniform: the height, floor(u2 W); u1 * n modulo 2^32
 *                       will do, with log2(n) bits fewer
 *   weight  1..W        out: w of the entry, so its probability is w / W
 *   return  index in [0, n); never one of weight 0
 *
 * Error: none if n and W are powers of two. Otherwise a column has a share
 *        within 2^-32 of 1/n (relative error below n 2^-32, so 2^-16 at most)
 *        and a threshold lies within 2^-32 of t / W. Builders make W 2^31.
 * Cost:  two multiplications, one comparison, three loads; the same for all n.
 * From:  Walker 1977; Vose 1991.
 */
QL_FX_INLINE uint16_t ql_alias_sample(
        const ql_alias_t *alias, ql_uq32_t u1, ql_uq32_t u2, uint32_t *weight)
{
    const uint16_t column = (uint16_t)ql_mulhi_u32(u1, alias->count);
    const uint16_t i =
            ql_alias_at(alias, column, ql_mulhi_u32(u2, alias->total));

    QL_ASSERT(alias->count > 0 && alias->total > 0);
    *weight = ql_alias_pmf(alias, i);
    return i;
}

#endif
