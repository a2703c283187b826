/* marks.c - a set of small numbers that knows its neighbours */
/* SPDX-License-Identifier: MIT */

#include "lib/sums/marks.h"

#include <stdlib.h>
#include <string.h>

#include "base/ql_base.h"
#include "lib/program/cli.h"

static const uint64_t all = UINT64_MAX;

void marks_new(marks_t *marks, uint32_t count)
{
    size_t n = count;

    memset(marks, 0, sizeof *marks);
    do { /* 2^32 numbers take six levels */
        n = (n + 63) / 64;
        marks->words[marks->levels++] = cli_alloc(n, sizeof **marks->words);
    } while (n > 1);
}

void marks_free(marks_t *marks)
{
    for (unsigned i = 0; i < marks->levels; i++) {
        free(marks->words[i]);
    }
}

void marks_set(marks_t *marks, uint32_t number, bool is_in)
{
    for (unsigned i = 0; i < marks->levels; i++, number /= 64) {
        uint64_t *word = marks->words[i] + number / 64;
        const uint64_t bit = (uint64_t)1 << number % 64;

        *word = is_in ? *word | bit : *word & ~bit;
        is_in = *word != 0;
    }
}

/* The last or first number below one of a level, whose word is not 0. */
static uint32_t last_of(const marks_t *marks, unsigned level, uint32_t at)
{
    for (; level > 0; level--) {
        at = 64 * at + 63 - ql_clz64(marks->words[level - 1][at]);
    }
    return at;
}

static uint32_t first_of(const marks_t *marks, unsigned level, uint32_t at)
{
    for (; level > 0; level--) {
        const uint64_t word = marks->words[level - 1][at];

        at = 64 * at + 63 - ql_clz64(word & (~word + 1));
    }
    return at;
}

uint32_t marks_before(const marks_t *marks, uint32_t number)
{
    uint64_t bits = all >> (63 - number % 64); /* this one and those below */

    for (unsigned i = 0; i < marks->levels; i++) {
        const uint64_t word = marks->words[i][number / 64] & bits;

        if (word != 0) {
            return last_of(marks, i, number / 64 * 64 + 63 - ql_clz64(word));
        }
        number /= 64;
        bits = ~(all << number % 64); /* those below */
    }
    return MARKS_NONE;
}

uint32_t marks_after(const marks_t *marks, uint32_t number)
{
    uint64_t bits = all << number % 64; /* this one and those above */

    for (unsigned i = 0; i < marks->levels; i++) {
        const uint64_t word = marks->words[i][number / 64] & bits;

        if (word != 0) {
            return first_of(marks, i,
                    number / 64 * 64 + 63 - ql_clz64(word & (~word + 1)));
        }
        number /= 64;
        bits = all << number % 64 << 1; /* those above */
    }
    return MARKS_NONE;
}
