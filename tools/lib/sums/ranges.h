/* ranges.h - which samples of which rows: disjoint, joined, counted */
/* SPDX-License-Identifier: MIT */

#ifndef RANGES_H
#define RANGES_H

#include <stdbool.h>
#include <stdint.h>

/* Rows times sample indices; the ends are one past the last. None is empty,
 * rows end at 2^30 or before. */
typedef struct {
    uint32_t row_first;
    uint32_t row_end;
    uint32_t sample_first;
    uint32_t sample_end;
} sums_range_t;

/* A list of them. */
typedef struct {
    uint32_t count;
    sums_range_t *items;
} ranges_t;

/* Append one; cli_fail(CLI_IO) if there is no memory. */
void ranges_add(ranges_t *list, const sums_range_t *range);

/* Describe the same samples in the one canonical way: within each row samples
 * are joined into runs as long as they can be, and a run goes on as long as the
 * rows below have the same one. Sorted by rows, then samples.
 *
 *   list    -  in, out: in any order; as it was if two overlap
 *   clash   -  out: the numbers of two that overlap, the smaller one first
 *   return  false if two overlap
 *
 * Cost: n log n for n ranges, in time; 68 bytes for each beside the list.
 */
bool ranges_join(ranges_t *list, uint32_t clash[2]);

/* Samples in each row of height; no two ranges overlap.
 *
 *   counts  -  out: height of them
 */
void ranges_count(const ranges_t *list, uint32_t *counts, uint32_t height);

/* Samples of one range, of all its rows. */
uint64_t ranges_samples(const sums_range_t *range);

/* Describe what a joined list lacks of a range.
 *
 *   list     -
 *   whole    -
 *   missing  -  out: joined; to be freed
 *
 * Cost: n^2 for n ranges at worst, in time.
 */
void ranges_missing(
        const ranges_t *list, const sums_range_t *whole, ranges_t *missing);

void ranges_free(ranges_t *list);

#endif
