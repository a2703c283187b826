/* build_table.h - tabulated distributions and alias tables from weights */
/* SPDX-License-Identifier: MIT */

#ifndef BUILD_TABLE_H
#define BUILD_TABLE_H

#include <stddef.h>
#include <stdint.h>

typedef enum {
    TABLE_OK,
    TABLE_ERR_ZERO,     /* no weight is above 0 */
    TABLE_ERR_NEGATIVE, /* a weight is below 0 */
    TABLE_ERR_NAN,      /* a weight is not a finite number */
    TABLE_ERR_RANGE,    /* a count or a total is out of range */
    TABLE_ERR_MEMORY
} table_error_t;

/* An error in words, for any value. */
const char *table_error_text(table_error_t error);

/* Share 2^bits among weights by largest remainder, 1 or more to each above 0.
 *
 *   shares   -     out: count numbers whose sum is exactly 2^bits
 *   weights  -     count of them, each 0 or above and finite
 *   count    -     1 to 65,535
 *   bits     bits  16 to 31
 *   return   TABLE_OK
 *
 * Exact for weights that span up to 46 bits; what is below 2^-46 of the largest
 * weight is cut off, but never to 0. Where an entry needs raising to 1 the rest
 * is shared among the others. Ties go to the lower index.
 */
table_error_t table_shares(
        uint32_t *shares, const double *weights, uint32_t count, unsigned bits);

/* Words that a table takes (ql_table.h); 0 if they are 2^32 or more, or if a
 * count is 0 or dims is not 1, 2 or 3. */
uint32_t table_words(unsigned dims, const uint16_t *count);

/* Build a table of one, two or three dimensions.
 *
 *   words    -      out: table_words() of them, little-endian
 *   weights  -      x varying fastest; each 0 or above and finite
 *   dims     -      1 to 3
 *   count    cells  dims numbers: nx, ny, nz
 *   return   TABLE_OK
 *
 * Rows without weight stay empty. Marginals are sums in double, in order: the
 * same on every host whose doubles are IEEE 754 without extra precision.
 */
table_error_t table_build(uint16_t *words, const double *weights, unsigned dims,
        const uint16_t *count);

/* Build an alias table (ql_alias.h) in exact integers.
 *
 *   words    -  out: 3 for each entry, little-endian
 *   weights  -  count of them; their sum is below 2^32
 *   count    -  1 to 65,535
 *   total    -  out: their sum
 *   return   TABLE_OK
 *
 * Cost:  count multiplications and at most count pairings.
 * From:  Vose, "A Linear Algorithm for Generating Random Numbers with a Given
 *        Distribution", 1991.
 */
table_error_t alias_build(uint32_t *words, const uint32_t *weights,
        uint32_t count, uint32_t *total);

/* The same from doubles: shares of 2^31, so that *total is 2^31. */
table_error_t alias_build_real(uint32_t *words, const double *weights,
        uint32_t count, uint32_t *total);

#endif
