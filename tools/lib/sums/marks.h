/* marks.h - a set of small numbers that knows its neighbours */
/* SPDX-License-Identifier: MIT */

#ifndef MARKS_H
#define MARKS_H

#include <stdbool.h>
#include <stdint.h>

#define MARKS_NONE   UINT32_MAX
#define MARKS_LEVELS 6 /* of 64 each: more than 32 bits */

/* A bit for each number, and above them one for every 64 that are not all 0. */
typedef struct {
    uint64_t *words[MARKS_LEVELS];
    unsigned levels;
} marks_t;

/* The empty set of numbers below count, which is 1 or more; to be freed. */
void marks_new(marks_t *marks, uint32_t count);
void marks_free(marks_t *marks);

/* Put a number in, or take it out. Cost: one step a level. */
void marks_set(marks_t *marks, uint32_t number, bool is_in);

/* The largest number not above, the smallest not below; MARKS_NONE if there is
 * none. Cost: two steps a level. */
uint32_t marks_before(const marks_t *marks, uint32_t number);
uint32_t marks_after(const marks_t *marks, uint32_t number);

#endif
