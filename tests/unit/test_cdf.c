/* test_cdf.c - discrete choice: counts equal masses exactly */
/* SPDX-License-Identifier: MIT */

#include "support/ql_stats.h"
#include "support/ql_test.h"
#include "sample/ql_cdf.h"

enum { COUNT_MAX = 65535, STRIDE = 3 };

static uint32_t table[COUNT_MAX * STRIDE];
static uint32_t scaled[COUNT_MAX + 1]; /* lower bounds of 2^16 values */
static uint32_t hits[COUNT_MAX];

/* Lay the bounds into a table of stride words, as little-endian fields. */
static void fill(unsigned stride, uint16_t count)
{
    memset(table, 0xa5, sizeof table);
    for (unsigned i = 0; i < count; i++) {
        table[i * stride] = QL_LE32(scaled[i] << 16);
    }
}

/* Cut 2^16 values at random places, the first being 0. */
static void random_bounds(uint64_t *state, uint16_t count)
{
    for (unsigned i = 0; i < count; i++) {
        uint32_t at = i;
        const uint32_t bound = i ? stats_random_below(state, 65536) : 0;

        for (; at > 0 && scaled[at - 1] > bound; at--) {
            scaled[at] = scaled[at - 1];
        }
        scaled[at] = bound;
    }
    scaled[count] = 65536;
}

/* Both ends of each of the 2^16 cells of u, so all of 2^32 where bounds are
 * multiples of 2^16. */
static void check_all(unsigned stride, uint16_t count)
{
    uint16_t before = 0;

    memset(hits, 0, sizeof hits);
    for (uint32_t k = 0; k < 65536; k++) {
        const uint32_t u = k << 16;
        const uint16_t first = ql_cdf_sample(table, stride, count, u);
        const uint16_t last = ql_cdf_sample(table, stride, count, u | 0xffffu);

        CHECK(first == last, "u = %08lx..: entries %u, %u", (unsigned long)u,
                first, last);
        CHECK(first >= before && first < count, "u = %08lx: %u after %u of %u",
                (unsigned long)u, first, before, count);
        before = first;
        hits[first]++;
    }
    for (unsigned i = 0; i < count; i++) {
        CHECK(ql_cdf_pmf(table, stride, count, (uint16_t)i) == (uint64_t)hits[i]
                                                                       << 16,
                "entry %u of %u: %lu of 65536 are not its pmf", i, count,
                (unsigned long)hits[i]);
        CHECK(hits[i] == scaled[i + 1] - scaled[i],
                "entry %u of %u: %lu of 65536, mass %lu", i, count,
                (unsigned long)hits[i],
                (unsigned long)(scaled[i + 1] - scaled[i]));
    }
}

TEST(entries_are_chosen_exactly_as_often_as_their_mass)
{
    static const uint16_t counts[] = {
            1, 2, 3, 4, 5, 7, 8, 9, 31, 32, 33, 100, 255, 256, 257, 1000};
    uint64_t state = 1;
    unsigned tables = 0;

    for (size_t k = 0; k < sizeof counts / sizeof counts[0]; k++) {
        for (unsigned stride = 1; stride <= STRIDE; stride++) {
            random_bounds(&state, counts[k]);
            fill(stride, counts[k]);
            check_all(stride, counts[k]);
            tables++;
        }
    }
    NOTE("%u tables, all of u", tables);
}

TEST(one_entry_is_always_chosen)
{
    scaled[0] = 0;
    scaled[1] = 65536;
    fill(1, 1);
    check_all(1, 1);
}

TEST(entries_of_zero_mass_are_never_chosen)
{
    /* none of entries 0, 2, 3 and 5 has mass; the last one must */
    static const uint32_t bounds[8] = {0, 0, 7, 7, 7, 500, 500, 65536};

    memcpy(scaled, bounds, sizeof bounds);
    fill(2, 7);
    check_all(2, 7);
    CHECK(hits[0] == 0 && hits[2] == 0 && hits[3] == 0 && hits[5] == 0,
            "%lu %lu %lu %lu hits", (unsigned long)hits[0],
            (unsigned long)hits[2], (unsigned long)hits[3],
            (unsigned long)hits[5]);
}

TEST(bounds_are_met_to_the_last_of_32_bits)
{
    static const uint32_t bounds[] = {0, 1, 2, 0x7fffffffu, 0x80000000u,
            0x80000001u, 0xfffffffeu, 0xffffffffu};
    const uint16_t count = sizeof bounds / sizeof bounds[0];

    for (unsigned i = 0; i < count; i++) {
        table[i] = QL_LE32(bounds[i]);
    }
    for (uint16_t i = 0; i < count; i++) {
        CHECK(ql_cdf_sample(table, 1, count, bounds[i]) == i, "at bound %u", i);
        if (i > 0) {
            CHECK(ql_cdf_sample(table, 1, count, bounds[i] - 1) == i - 1,
                    "below bound %u", i);
        }
    }
}

TEST(the_largest_table_is_searched_to_both_ends)
{
    for (uint32_t i = 0; i < COUNT_MAX; i++) {
        scaled[i] = i;
    }
    scaled[COUNT_MAX] = 65536;
    fill(STRIDE, COUNT_MAX);
    check_all(STRIDE, COUNT_MAX);
    NOTE("%d entries", COUNT_MAX);
}

/* The planted fault: "less than" where "at most" belongs. */
static uint16_t off_by_one(const uint32_t *cum, uint16_t count, uint32_t u)
{
    uint32_t low = 0, high = count;

    while (high - low > 1) {
        const uint32_t mid = (low + high) / 2;

        if (QL_LE32(cum[mid]) < u) {
            low = mid;
        } else {
            high = mid;
        }
    }
    return (uint16_t)low;
}

TEST(a_search_off_by_one_is_rejected)
{
    uint64_t state = 2;
    unsigned wrong = 0;

    random_bounds(&state, 8);
    fill(1, 8);
    for (uint32_t k = 0; k < 65536; k++) {
        wrong += off_by_one(table, 8, k << 16) !=
                 ql_cdf_sample(table, 1, 8, k << 16);
    }
    CHECK(wrong > 0, "%u differences", wrong);
    NOTE("%u of 65536 differ", wrong);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_cdf", argc, argv);
    RUN(entries_are_chosen_exactly_as_often_as_their_mass);
    RUN(one_entry_is_always_chosen);
    RUN(entries_of_zero_mass_are_never_chosen);
    RUN(bounds_are_met_to_the_last_of_32_bits);
    RUN(the_largest_table_is_searched_to_both_ends);
    RUN(a_search_off_by_one_is_rejected);
    return TEST_END();
}
