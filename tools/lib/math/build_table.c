/* build_table.c - tabulated distributions and alias tables from weights */
/* SPDX-License-Identifier: MIT */

#include "lib/math/build_table.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "base/ql_base.h"
#include "lib/math/remainder.h"
#include "sample/lecture/ql_alias.h"
#include "sample/ql_table.h"

enum { COUNT_MAX = 65535, WEIGHT_BITS = 46, BITS_MIN = 16, BITS_MAX = 31 };

const char *table_error_text(table_error_t error)
{
    switch (error) {
    case TABLE_OK:
        return "done";
    case TABLE_ERR_ZERO:
        return "no weight is above 0";
    case TABLE_ERR_NEGATIVE:
        return "a weight is below 0";
    case TABLE_ERR_NAN:
        return "a weight is not a finite number";
    case TABLE_ERR_RANGE:
        return "a count or a total is out of range";
    case TABLE_ERR_MEMORY:
        return "out of memory";
    }
    return "unknown error";
}

/* Find the largest weight; fails unless all are sound and one is above 0. */
static table_error_t check_weights(
        const double *weights, size_t count, double *largest)
{
    *largest = 0;
    for (size_t i = 0; i < count; i++) {
        if (!isfinite(weights[i])) {
            return TABLE_ERR_NAN;
        }
        if (weights[i] < 0) {
            return TABLE_ERR_NEGATIVE;
        }
        *largest = weights[i] > *largest ? weights[i] : *largest;
    }
    return *largest > 0 ? TABLE_OK : TABLE_ERR_ZERO;
}

typedef struct {
    remainder_t left; /* of the division by the total */
    uint64_t weight;  /* < 2^46 */
    uint32_t share;
} part_t;

/* floor(part->weight left / total) for weight <= total < 2^62, and what is
 * left over: long division, one bit of left at a time. */
static void divide(part_t *part, uint32_t left, uint64_t total)
{
    uint64_t rest = 0;
    uint32_t share = 0;

    for (unsigned bit = 32; bit-- > 0;) {
        rest *= 2;
        share *= 2;
        rest += left >> bit & 1 ? part->weight : 0; /* < 3 total */
        for (; rest >= total; rest -= total) {
            share++;
        }
    }
    part->left.rest = rest;
    part->share = share;
}

/* Share left among n parts. Those due less than 1 get 1 and drop out; as long
 * as left >= n the others are due 1 or more on average, so some remain. */
static void share_out(
        uint32_t *shares, part_t *parts, uint32_t n, uint32_t left)
{
    for (bool again = true; again;) {
        const uint32_t due = left;
        uint64_t total = 0;
        uint32_t kept = 0;

        again = false;
        for (uint32_t i = 0; i < n; i++) {
            total += parts[i].weight;
        }
        for (uint32_t i = 0; i < n; i++) {
            divide(&parts[i], due, total);
            if (parts[i].share == 0) {
                shares[parts[i].left.index] = 1;
                left--;
                again = true;
            } else {
                parts[kept++] = parts[i];
            }
        }
        n = kept;
    }
    for (uint32_t i = 0; i < n; i++) {
        shares[parts[i].left.index] = parts[i].share;
        left -= parts[i].share;
    }
    /* each lost less than 1, so fewer than n are left */
    qsort(parts, n, sizeof *parts, remainder_compare);
    for (uint32_t i = 0; i < left; i++) {
        shares[parts[i].left.index]++;
    }
}

table_error_t table_shares(
        uint32_t *shares, const double *weights, uint32_t count, unsigned bits)
{
    table_error_t error;
    double largest;
    part_t *parts;
    uint32_t n = 0;
    int e;

    if (count < 1 || count > COUNT_MAX || bits < BITS_MIN || bits > BITS_MAX) {
        return TABLE_ERR_RANGE;
    }
    error = check_weights(weights, count, &largest);
    if (error != TABLE_OK) {
        return error;
    }
    parts = malloc(count * sizeof *parts);
    if (parts == NULL) {
        return TABLE_ERR_MEMORY;
    }
    (void)frexp(largest, &e); /* largest < 2^e */
    for (uint32_t i = 0; i < count; i++) {
        shares[i] = 0;
        if (weights[i] > 0) {
            /* may be 0: share_out() raises it */
            parts[n].weight = (uint64_t)ldexp(weights[i], WEIGHT_BITS - e);
            parts[n].left.index = i;
            n++;
        }
    }
    share_out(shares, parts, n, (uint32_t)1 << bits);
    free(parts);
    return TABLE_OK;
}

uint32_t table_words(unsigned dims, const uint16_t *count)
{
    uint64_t rows = 1, words = 0;

    if (dims < 1 || dims > QL_TABLE_DIMS_MAX) {
        return 0;
    }
    for (unsigned d = dims; d-- > 0;) {
        rows *= count[d];
        words += rows;
        if (count[d] == 0) {
            return 0;
        }
    }
    return words <= UINT32_MAX ? (uint32_t)words : 0;
}

/* One row of words; an empty one if nothing weighs anything. */
static table_error_t build_row(
        uint16_t *row, uint32_t *shares, const double *weights, uint16_t count)
{
    const table_error_t error = table_shares(shares, weights, count, 16);
    uint32_t bound = 0;
    uint16_t used = 0;

    memset(row, 0, count * sizeof *row);
    if (error != TABLE_OK) {
        return error == TABLE_ERR_ZERO ? TABLE_OK : error;
    }
    for (uint16_t i = 0; i < count && bound < QL_TABLE_WHOLE; i++) {
        row[i] = QL_LE16((uint16_t)bound);
        bound += shares[i];
        used = (uint16_t)(i + 1);
    }
    row[0] = QL_LE16(used);
    return TABLE_OK;
}

/* Weights as fractions of a power of two above all of them, so that no sum
 * overflows; none above 0 becomes 0. */
static void scale_weights(
        double *scaled, const double *weights, size_t count, double largest)
{
    int e;

    (void)frexp(largest, &e);
    for (size_t i = 0; i < count; i++) {
        scaled[i] = ldexp(weights[i], -e);
        if (weights[i] > 0 && scaled[i] < DBL_MIN) {
            scaled[i] = DBL_MIN;
        }
    }
}

/* Rows of the fastest dimension lie last, so build from the end and add up
 * each row in place for the dimension above. */
static table_error_t build_rows(uint16_t *end, double *sums, uint32_t *shares,
        unsigned dims, const uint16_t *count, size_t cells)
{
    for (unsigned d = 0; d < dims; d++) {
        const size_t n_rows = cells / count[d];

        end -= cells;
        for (size_t r = 0; r < n_rows; r++) {
            const double *weights = sums + r * count[d];
            const table_error_t error =
                    build_row(end + r * count[d], shares, weights, count[d]);
            double sum = 0;

            if (error != TABLE_OK) {
                return error;
            }
            for (uint32_t i = 0; i < count[d]; i++) {
                sum += weights[i];
            }
            sums[r] = sum; /* r <= r count: read already */
        }
        cells = n_rows;
    }
    return TABLE_OK;
}

table_error_t table_build(uint16_t *words, const double *weights, unsigned dims,
        const uint16_t *count)
{
    const uint32_t n_words = table_words(dims, count);
    table_error_t error;
    double largest, *sums;
    uint32_t *shares;
    size_t cells = 1;

    if (n_words == 0) {
        return TABLE_ERR_RANGE;
    }
    for (unsigned d = 0; d < dims; d++) {
        cells *= count[d];
    }
    error = check_weights(weights, cells, &largest);
    if (error != TABLE_OK) {
        return error;
    }
    sums = malloc(cells * sizeof *sums);
    shares = malloc(COUNT_MAX * sizeof *shares);
    if (sums == NULL || shares == NULL) {
        error = TABLE_ERR_MEMORY;
    } else {
        scale_weights(sums, weights, cells, largest);
        error = build_rows(words + n_words, sums, shares, dims, count, cells);
    }
    free(shares);
    free(sums);
    return error;
}

static void put_column(
        uint32_t *words, uint32_t i, uint64_t threshold, uint32_t other)
{
    uint32_t *column = words + (size_t)i * QL_ALIAS_WORDS;

    column[QL_ALIAS_THRESHOLD] = QL_LE32((uint32_t)threshold);
    column[QL_ALIAS_OTHER] = QL_LE32(other);
}

/* Fill columns: what is missing in a small one comes from a large one. The
 * small are stacked up from the start of order, the large down from its end. */
static void pair(uint32_t *words, uint64_t *amounts, uint32_t *order,
        uint32_t count, uint32_t total)
{
    uint32_t n_small = 0, large = count; /* order[large..] are the large */

    for (uint32_t i = 0; i < count; i++) {
        if (amounts[i] < total) {
            order[n_small++] = i;
        } else {
            order[--large] = i;
        }
    }
    while (n_small > 0) {
        /* the amounts left sum to the columns left times total, so that as
         * long as one is below total another is above it */
        const uint32_t s = order[--n_small], l = order[large];

        put_column(words, s, amounts[s], l);
        amounts[l] -= total - amounts[s];
        if (amounts[l] < total) {
            large++;
            order[n_small++] = l;
        }
    }
    for (; large < count; large++) {
        put_column(words, order[large], total, order[large]);
    }
}

table_error_t alias_build(uint32_t *words, const uint32_t *weights,
        uint32_t count, uint32_t *total)
{
    uint64_t sum = 0, *amounts;
    uint32_t *order;
    table_error_t error = TABLE_OK;

    if (count < 1 || count > COUNT_MAX) {
        return TABLE_ERR_RANGE;
    }
    for (uint32_t i = 0; i < count; i++) {
        sum += weights[i];
    }
    if (sum == 0 || sum > UINT32_MAX) {
        return sum == 0 ? TABLE_ERR_ZERO : TABLE_ERR_RANGE;
    }
    amounts = malloc(count * sizeof *amounts);
    order = malloc(count * sizeof *order);
    if (amounts == NULL || order == NULL) {
        error = TABLE_ERR_MEMORY;
    } else {
        *total = (uint32_t)sum;
        for (uint32_t i = 0; i < count; i++) {
            amounts[i] = (uint64_t)weights[i] * count; /* < 2^48 */
            words[(size_t)i * QL_ALIAS_WORDS + QL_ALIAS_WEIGHT] =
                    QL_LE32(weights[i]);
        }
        pair(words, amounts, order, count, (uint32_t)sum);
    }
    free(order);
    free(amounts);
    return error;
}

table_error_t alias_build_real(
        uint32_t *words, const double *weights, uint32_t count, uint32_t *total)
{
    uint32_t *shares;
    table_error_t error;

    if (count < 1 || count > COUNT_MAX) {
        return TABLE_ERR_RANGE;
    }
    shares = malloc(count * sizeof *shares);
    if (shares == NULL) {
        return TABLE_ERR_MEMORY;
    }
    error = table_shares(shares, weights, count, 31);
    if (error == TABLE_OK) {
        error = alias_build(words, shares, count, total);
    }
    free(shares);
    return error;
}
