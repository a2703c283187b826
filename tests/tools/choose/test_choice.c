/* test_choice.c - what a blob says of the way its light is found */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <string.h>

#include "scene/choose/choice.h"
#include "support/ql_test.h"

/* The trials of these costs, the way k chosen. */
static void set(model_t *model, unsigned k, const double cost[CHOICE_WAYS])
{
    soft_t soft[CHOICE_WAYS];

    for (unsigned i = 0; i < CHOICE_WAYS; i++) {
        soft[i] = soft_from(cost[i]);
    }
    memset(model, 0, sizeof *model);
    choice_set(model, k, soft);
}

TEST(each_way_is_said_in_the_numbers_of_the_core)
{
    static const double none[CHOICE_WAYS];
    static const uint8_t direct[CHOICE_WAYS] = {1, 1, 4, 4, 5, 5};
    model_t model;

    for (unsigned k = 0; k < CHOICE_WAYS; k++) {
        set(&model, k, none);
        CHECK(model.header.auto_direct == direct[k] &&
                        model.header.auto_lights == k % 2,
                "way %u: %u %u", k, model.header.auto_direct,
                model.header.auto_lights);
        for (unsigned i = 0; i < CHOICE_WAYS; i++) {
            CHECK(model.header.trials[i] == QL_TRIAL_NONE, "trial %u: %u", i,
                    model.header.trials[i]);
        }
    }
}

/* The best is 0 whatever is chosen; 2^(k / 16) of it is k, up to half a step
 * from there; no cost is not tried. */
TEST(a_trial_is_the_sixteenth_of_an_octave_that_is_nearest)
{
    for (int k = 0; k < 300; k++) {
        const double best = ldexp(1.7, 3 * k - 400);
        const int want = k < 254 ? k : 254;

        for (int side = -1; side <= 1; side++) {
            const double off = exp2((k + 0.49 * side) / 16);
            const double cost[CHOICE_WAYS] = {
                    best * off, 0, best, best * 1.5, 2 * best, 0};
            model_t model;

            if (k == 0 && side < 0) {
                continue;
            }
            set(&model, 0, cost);
            CHECK(model.header.trials[0] == want, "2^(%d/16): %u", k,
                    model.header.trials[0]);
            CHECK(model.header.trials[1] == QL_TRIAL_NONE &&
                            model.header.trials[2] == 0 &&
                            model.header.trials[3] == 9 &&
                            model.header.trials[4] == 16 &&
                            model.header.trials[5] == QL_TRIAL_NONE,
                    "beside 2^(%d/16)", k);
        }
    }
}

int main(int argc, char **argv)
{
    TEST_BEGIN("tools/choice", argc, argv);
    RUN(each_way_is_said_in_the_numbers_of_the_core);
    RUN(a_trial_is_the_sixteenth_of_an_octave_that_is_nearest);
    return TEST_END();
}
