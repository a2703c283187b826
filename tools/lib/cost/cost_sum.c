/* cost_sum.c - events of a rendering times what each takes on a core */
/* SPDX-License-Identifier: MIT */

#include "lib/cost/cost.h"

#include <string.h>

#include "lib/cost/cost_table.h"

const char *cost_core_name(cost_core_t core)
{
    static const char *const names[COST_CORES] = {
            "cortex-m0", "cortex-m3", "cortex-m4f", "rv32imac"};

    return names[core];
}

bool cost_core_find(cost_core_t *core, const char *name)
{
    for (unsigned i = 0; i < COST_CORES; i++) {
        if (strcmp(cost_core_name((cost_core_t)i), name) == 0) {
            *core = (cost_core_t)i;
            return true;
        }
    }
    return false;
}

uint64_t cost_instructions(
        const cost_events_t *events, cost_core_t core, unsigned precision)
{
    uint64_t tenths = 0; /* 21 x 2^38 x 2^21 < 2^64 */
    unsigned i = 0;

#define ADD(event, what)                                                       \
    tenths += events->event * cost_table[i++][core][precision];
    COST_EVENTS(ADD)
#undef ADD
    return (tenths + 5) / 10;
}
