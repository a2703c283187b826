/* choice.c - which way of finding light a scene asks for, and how others did */
/* SPDX-License-Identifier: MIT */

#include "scene/choose/choice.h"

const choice_way_t choice_ways[CHOICE_WAYS] = {
#define CHOICE_WAY(direct, lights) {direct, lights},
        QL_BLOB_TRIALS(CHOICE_WAY)
#undef CHOICE_WAY
};

/* The least cost of those tried; 0 if none was. */
static soft_t least_of(const soft_t cost[CHOICE_WAYS])
{
    soft_t least = soft_int(0, 0);

    for (unsigned i = 0; i < CHOICE_WAYS; i++) {
        if (cost[i].m != 0 &&
                (least.m == 0 || soft_compare(cost[i], least) < 0)) {
            least = cost[i];
        }
    }
    return least;
}

/* 16 log2 of a ratio of 1 or more, to the nearest: its exponent, then five bits
 * more by squaring, the last one to round by. */
static uint8_t trial_of(soft_t ratio)
{
    uint64_t m = ratio.m; /* u1.63 */
    int64_t log = (int64_t)ratio.e + 63;

    for (int i = 0; i < 5; i++) {
        const uint64_t square = u128_mul(m, m).high; /* u2.62 */
        const bool above = square >> 63 != 0;

        log = 2 * log + above;
        m = above ? square : square << 1;
    }
    log = (log + 1) / 2; /* >= 0 */
    return (uint8_t)(log < QL_TRIAL_MOST ? log : QL_TRIAL_MOST);
}

void choice_set(model_t *model, unsigned way, const soft_t cost[CHOICE_WAYS])
{
    ql_blob_header_t *h = &model->header;
    const soft_t least = least_of(cost);

    h->auto_direct = (uint8_t)choice_ways[way].direct;
    h->auto_lights = (uint8_t)choice_ways[way].lights;
    for (unsigned i = 0; i < CHOICE_WAYS; i++) {
        h->trials[i] = cost[i].m == 0 ? QL_TRIAL_NONE
                                      : trial_of(soft_div(cost[i], least));
    }
}

void choice_make(model_t *model)
{
    const soft_t none[CHOICE_WAYS] = {{0}};

    choice_set(model, CHOICE_QL_DIRECT_AREA_QL_LIGHTS_POWER, none);
}
