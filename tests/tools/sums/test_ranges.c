/* test_ranges.c - ranges of rows and samples: joined, counted, any number */
/* SPDX-License-Identifier: MIT */

#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "lib/program/cli.h"
#include "lib/sums/marks.h"
#include "lib/sums/ranges.h"
#include "support/ql_test.h"

static uint32_t below(uint32_t n)
{
    static uint32_t state = 12345;

    state = state * 1664525u + 1013904223u;
    return (uint32_t)((uint64_t)state * n >> 32);
}

/* ---- Against every cell of a small picture ------------------------------- */

enum { SIDE = 7, MOST = SIDE * SIDE };

/* Which range holds a sample of a row, plus one; 0 is none. */
typedef struct {
    unsigned cell[SIDE][SIDE];
} grid_t;

/* Put a range in; the lowest number of those that hold a cell of it, or 0. */
static unsigned put(grid_t *grid, const sums_range_t *r, unsigned number)
{
    unsigned clash = 0;

    for (uint32_t y = r->row_first; y < r->row_end; y++) {
        for (uint32_t i = r->sample_first; i < r->sample_end; i++) {
            const unsigned old = grid->cell[y][i];

            clash = old != 0 && (clash == 0 || old < clash) ? old : clash;
            grid->cell[y][i] = number;
        }
    }
    return clash;
}

/* Where the run that begins at a sample of a row ends; 0 if none begins. */
static uint32_t run_end(const grid_t *grid, uint32_t y, uint32_t first)
{
    uint32_t end = first;

    if (first > 0 && grid->cell[y][first - 1] != 0) {
        return 0;
    }
    while (end < SIDE && grid->cell[y][end] != 0) {
        end++;
    }
    return end > first ? end : 0;
}

/* The definition of ranges.h, cell by cell. */
static void describe(const grid_t *grid, ranges_t *want)
{
    for (uint32_t y = 0; y < SIDE; y++) {
        for (uint32_t i = 0; i < SIDE; i++) {
            sums_range_t r = {y, y + 1, i, run_end(grid, y, i)};

            if (r.sample_end == 0 ||
                    (y > 0 && run_end(grid, y - 1, i) == r.sample_end)) {
                continue;
            }
            while (r.row_end < SIDE &&
                    run_end(grid, r.row_end, i) == r.sample_end) {
                r.row_end++;
            }
            ranges_add(want, &r);
        }
    }
}

static bool same(const ranges_t *a, const ranges_t *b)
{
    return a->count == b->count &&
           (a->count == 0 || memcmp(a->items, b->items,
                                     a->count * sizeof *a->items) == 0);
}

static void check_counts(const ranges_t *list, const grid_t *grid)
{
    uint32_t counts[SIDE] = {0};

    ranges_count(list, counts, SIDE);
    for (uint32_t y = 0; y < SIDE; y++) {
        uint32_t n = 0;

        for (uint32_t i = 0; i < SIDE; i++) {
            n += grid->cell[y][i] != 0;
        }
        CHECK(counts[y] == n, "row %u: %u samples, wanted %u", (unsigned)y,
                (unsigned)counts[y], (unsigned)n);
    }
}

/* So many ranges at random, none or all of which overlap no other. */
static sums_range_t random_range(void)
{
    const uint32_t y = below(SIDE), i = below(SIDE);
    const sums_range_t r = {
            y, y + 1 + below(SIDE - y), i, i + 1 + below(SIDE - i)};

    return r;
}

/* What the list lacks of a range is what is free in there, cell by cell. */
static void check_missing(const ranges_t *list, const grid_t *grid)
{
    const sums_range_t whole = random_range();
    grid_t rest = {{{0}}};
    ranges_t want = {0, NULL}, missing;
    uint64_t samples = 0;

    (void)put(&rest, &whole, 1);
    for (uint32_t k = 0; k < SIDE * SIDE; k++) {
        if (grid->cell[k / SIDE][k % SIDE] != 0) {
            rest.cell[k / SIDE][k % SIDE] = 0;
        }
    }
    describe(&rest, &want);
    ranges_missing(list, &whole, &missing);
    CHECK(same(&missing, &want), "%u missing ranges, wanted %u", missing.count,
            want.count);
    for (uint32_t i = 0; i < missing.count; i++) {
        samples += ranges_samples(missing.items + i);
    }
    for (uint32_t k = 0; k < SIDE * SIDE; k++) {
        samples -= rest.cell[k / SIDE][k % SIDE] != 0;
    }
    CHECK(samples == 0, "%lld samples too many", (long long)samples);
    ranges_free(&missing);
    ranges_free(&want);
}

static void try_disjoint(unsigned wanted)
{
    grid_t grid = {{{0}}};
    ranges_t list = {0, NULL}, want = {0, NULL};
    uint32_t clash[2];

    for (unsigned i = 0; i < 4 * wanted && list.count < wanted; i++) {
        const sums_range_t r = random_range();
        grid_t next = grid;

        if (put(&next, &r, 1) == 0) {
            grid = next;
            ranges_add(&list, &r);
        }
    }
    describe(&grid, &want);
    CHECK(ranges_join(&list, clash), "%u ranges overlap", list.count);
    CHECK(same(&list, &want), "%u joined ranges, wanted %u", list.count,
            want.count);
    check_counts(&list, &grid);
    check_missing(&list, &grid);
    CHECK(ranges_join(&list, clash) && same(&list, &want), "%s",
            "joined twice they differ");
    ranges_free(&list);
    ranges_free(&want);
}

TEST(joined_and_missing_ranges_are_those_of_every_cell)
{
    for (unsigned i = 0; i < MANY(20000); i++) {
        try_disjoint(i % 24);
    }
}

static void try_any(unsigned count)
{
    grid_t grid = {{{0}}};
    ranges_t list = {0, NULL};
    sums_range_t copy[4];
    uint32_t clash[2] = {9, 9};
    bool overlap = false;

    for (unsigned i = 0; i < count; i++) {
        copy[i] = random_range();
        overlap |= put(&grid, copy + i, 1) != 0;
        ranges_add(&list, copy + i);
    }
    CHECK(ranges_join(&list, clash) == !overlap, "%u ranges", count);
    if (overlap) {
        grid_t two = {{{0}}};

        CHECK(clash[0] < clash[1] && clash[1] < count, "%u and %u", clash[0],
                clash[1]);
        (void)put(&two, copy + clash[0], 1);
        CHECK(put(&two, copy + clash[1], 1) == 1, "%u and %u are apart",
                clash[0], clash[1]);
        CHECK(list.count == count &&
                        memcmp(list.items, copy, count * sizeof *copy) == 0,
                "%s", "the list has changed");
    }
    ranges_free(&list);
}

TEST(any_overlap_is_found_and_two_of_it_named)
{
    for (unsigned i = 0; i < MANY(20000); i++) {
        try_any(2 + i % 3);
    }
}

/* ---- Any number ---------------------------------------------------------- */

/* Long ones beside each other, with gaps, and far from them short ones, which
 * begin and end at every row. What compares each with each takes 1e10 steps. */
TEST(a_hundred_and_fifty_thousand_are_joined_in_seconds)
{
    enum { MANY_RANGES = 100000 };
    const clock_t begun = clock();
    ranges_t list = {0, NULL};
    uint32_t clash[2];
    double seconds;

    for (uint32_t i = 0; i < MANY_RANGES; i++) {
        const sums_range_t longer = {0, 16384, 2 * i, 2 * i + 1};
        const uint32_t y = i % 16383, k = 400000 + i / 16383;
        const sums_range_t shorter = {y, y + 1 + (i & 1), 2 * k, 2 * k + 1};

        ranges_add(&list, &longer);
        if ((i & 1) == 0) {
            ranges_add(&list, &shorter);
        }
    }
    CHECK(ranges_join(&list, clash), "%s", "they overlap");
    CHECK(list.count > MANY_RANGES, "%u ranges", list.count);
    seconds = (double)(clock() - begun) / CLOCKS_PER_SEC;
    CHECK(seconds < 20, "%.1f s", seconds);
    NOTE("%.2f s of %u", seconds, list.count);
    ranges_free(&list);
}

/* ---- Marks --------------------------------------------------------------- */

/* Against a list of all, one change at a time. */
static void try_marks(uint32_t count, unsigned steps)
{
    bool *is_in = cli_alloc(count, sizeof *is_in);
    marks_t marks;

    marks_new(&marks, count);
    for (unsigned i = 0; i < steps; i++) {
        const uint32_t at = below(count), from = below(count);
        uint32_t before = from, after = from;

        is_in[at] = !is_in[at];
        marks_set(&marks, at, is_in[at]);
        while (before != MARKS_NONE && !is_in[before]) {
            before--; /* below 0 there is MARKS_NONE */
        }
        while (after < count && !is_in[after]) {
            after++;
        }
        after = after < count ? after : MARKS_NONE;
        CHECK(marks_before(&marks, from) == before, "before %u of %u", from,
                count);
        CHECK(marks_after(&marks, from) == after, "after %u of %u", from,
                count);
    }
    marks_free(&marks);
    free(is_in);
}

TEST(neighbours_are_found_at_every_level)
{
    static const uint32_t counts[] = {1, 2, 63, 64, 65, 200, 4095, 4096, 4097};

    for (unsigned i = 0; i < 9; i++) {
        try_marks(counts[i], MANY(2000));
    }
    try_marks(300000, 60); /* few in many: up to the top and down */
}

int main(int argc, char **argv)
{
    cli_begin("test_ranges");
    TEST_BEGIN("tools/test_ranges", argc, argv);
    RUN(joined_and_missing_ranges_are_those_of_every_cell);
    RUN(any_overlap_is_found_and_two_of_it_named);
    RUN(a_hundred_and_fifty_thousand_are_joined_in_seconds);
    RUN(neighbours_are_found_at_every_level);
    return TEST_END();
}
