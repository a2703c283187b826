/* test_meter.c - the geometric mean becomes grey, whatever few cells show */
/* SPDX-License-Identifier: MIT */

#include <math.h>

#include "film/ql_meter.h"
#include "support/ql_stats.h"
#include "support/ql_test.h"

#if QL_CFG_METER
enum { CELLS = QL_METER_SIDE * QL_METER_SIDE };

/* A cell whose samples have a mean of so many radiance units. */
static void add_grey(ql_meter_t *meter, double radiance)
{
    const uint64_t sum =
            (uint64_t)(ldexp(radiance, QL_SUM_BITS) * QL_METER_CELL + 0.5);
    const ql_sum_t grey = {{sum, sum, sum}};

    ql_meter_add(meter, &grey);
}

static double stops_of(const ql_meter_t *meter)
{
    return ql_meter_stops(meter) / 256.0;
}

TEST(one_radiance_becomes_a_middle_grey)
{
    double worst = 0;

    for (double radiance = 0x1p-18; radiance < 0x1p28; radiance *= 1.01) {
        ql_meter_t meter = {0};
        double off;

        add_grey(&meter, radiance);
        off = stops_of(&meter) - log2(0.18 / radiance);
        CHECK(fabs(off) < 0.02, "%g: off by %.4f stops", radiance, off);
        worst = fmax(worst, fabs(off));
    }
    NOTE("worst %.4f stops", worst);
}

TEST(luminance_is_that_of_rec_709)
{
    static const double weight[3] = {0.2126, 0.7152, 0.0722};

    for (unsigned i = 0; i < 3; i++) {
        ql_meter_t meter = {0};
        ql_sum_t sum = {{0, 0, 0}};

        sum.rgb[i] = (uint64_t)QL_METER_CELL << QL_SUM_BITS;
        ql_meter_add(&meter, &sum);
        CHECK(fabs(stops_of(&meter) - log2(0.18 / weight[i])) < 0.06,
                "channel %u: %.3f stops", i, stops_of(&meter));
    }
}

/* A room of some stops; what is added to it must move it little. */
static ql_meter_t room(unsigned cells)
{
    ql_meter_t meter = {0};

    for (unsigned i = 0; i < cells; i++) {
        add_grey(&meter, exp2((double)(i * 37 % cells) / cells * 3 - 1.5));
    }
    return meter;
}

TEST(the_geometric_mean_counts_in_any_order)
{
    ql_meter_t up = {0}, down = {0};

    for (unsigned i = 0; i < CELLS; i++) {
        add_grey(&up, exp2(i / 32.0));
        add_grey(&down, exp2((CELLS - 1 - i) / 32.0));
    }
    CHECK(memcmp(&up, &down, sizeof up) == 0, "order counts");
    CHECK(fabs(stops_of(&up) - (log2(0.18) - 63 / 64.0)) < 0.02, "%.3f",
            stops_of(&up));
}

TEST(black_cells_a_lamp_and_a_firefly_hardly_move_it)
{
    const ql_meter_t plain = room(40);
    ql_meter_t dark = plain, lamp = plain, firefly = plain;

    for (unsigned i = 40; i < CELLS; i++) {
        add_grey(&dark, 0);
    }
    CHECK(memcmp(&dark, &plain, sizeof dark) == 0, "black counts");
    for (unsigned i = 0; i < 2; i++) { /* 5 % of the picture, five stops up */
        add_grey(&lamp, 32);
    }
    CHECK(fabs(stops_of(&lamp) - stops_of(&plain)) < 0.3, "a lamp: %.3f",
            stops_of(&lamp) - stops_of(&plain));
    add_grey(&firefly, 1024);
    CHECK(fabs(stops_of(&firefly) - stops_of(&plain)) < 0.3, "%.3f",
            stops_of(&firefly) - stops_of(&plain));
}

TEST(no_more_than_a_tenth_is_above_white)
{
    ql_meter_t meter = {0};
    double stops;

    for (unsigned i = 0; i < CELLS; i++) {
        add_grey(&meter, i % 3 == 0 ? 8 : 1.0 / 64);
    }
    stops = stops_of(&meter);
    CHECK(fabs(stops + 3) < 0.02, "a bright third: %.3f", stops);
}

TEST(nothing_and_everything_have_an_exposure)
{
    static const ql_sum_t most = {{UINT64_MAX, UINT64_MAX, UINT64_MAX}};
    static const ql_sum_t least = {{0, 0, 1}};
    ql_meter_t meter = {0};

    CHECK(ql_meter_stops(&meter) == 0, "%d", ql_meter_stops(&meter));
    ql_meter_add(&meter, &most);
    CHECK(fabs(stops_of(&meter) - (log2(0.18) - 29)) < 0.02, "%.3f",
            stops_of(&meter));
    meter.count = 0;
    ql_meter_add(&meter, &least);
    CHECK(fabs(stops_of(&meter) - (log2(0.18 * 256 / 19) + 27)) < 0.02, "%.3f",
            stops_of(&meter));
}

/* Planted: what an arithmetic mean would do. */
TEST(an_arithmetic_mean_is_rejected_by_a_firefly)
{
    double mean = 1024;

    for (unsigned i = 0; i < 40; i++) {
        mean += exp2((double)(i * 37 % 40) / 40 * 3 - 1.5);
    }
    CHECK(fabs(log2(mean / 41)) > 1, "%.3f stops", log2(mean / 41));
}
#else
TEST(without_the_gate_nothing_is_metered)
{
    const ql_settings_t settings = QL_SETTINGS_DEFAULT;

    CHECK(!ql_meter_wanted(&settings), "it is");
}
#endif

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_meter", argc, argv);
#if QL_CFG_METER
    RUN(one_radiance_becomes_a_middle_grey);
    RUN(luminance_is_that_of_rec_709);
    RUN(the_geometric_mean_counts_in_any_order);
    RUN(black_cells_a_lamp_and_a_firefly_hardly_move_it);
    RUN(no_more_than_a_tenth_is_above_white);
    RUN(nothing_and_everything_have_an_exposure);
    RUN(an_arithmetic_mean_is_rejected_by_a_firefly);
#else
    RUN(without_the_gate_nothing_is_metered);
#endif
    return TEST_END();
}
