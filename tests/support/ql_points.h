/* ql_points.h - random positions in the box, from one seeded state */
/* SPDX-License-Identifier: MIT */

#ifndef QL_POINTS_H
#define QL_POINTS_H

#include "math/vec/ql_vec.h"
#include "support/ql_stats.h"
#include "scene/ql_blob.h"

/* A grid unit as positions have it. */
#define ONE (1 << QL_POS_BITS)

/* Of the random numbers; a claim sets it first. */
static uint64_t state;

static inline ql_vec3_t vec(int32_t x, int32_t y, int32_t z)
{
    const ql_vec3_t v = {x, y, z};

    return v;
}

static inline int32_t random_in(int32_t low, int32_t high)
{
    return low + (int32_t)stats_random_below(
                         &state, (uint64_t)((int64_t)high - low + 1));
}

static inline ql_vec3_t random_position(void)
{
    const int32_t max = QL_GRID_MAX * ONE;

    return vec(random_in(0, max), random_in(0, max), random_in(0, max));
}

#endif
