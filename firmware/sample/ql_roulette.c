/* ql_roulette.c - Russian roulette: end faint paths, make up for it */
/* SPDX-License-Identifier: MIT */

#include "sample/ql_roulette.h"

#if QL_CFG_ROULETTE

/* The largest channel as a chance, at least 2^-31 and at most 1. */
static ql_uq31_t chance_of(const ql_rgb_t *throughput)
{
    const uint32_t most = ql_rgb_most(throughput);
    const int down = -throughput->e;
    ql_uq31_t chance = QL_UQ31_ONE;

    if (down > 0) {
        chance = down > 30 ? 1 : most >> down;
    } else if (most >> (31 + down > 0 ? 31 + down : 0) == 0) {
        chance = most << -down; /* below 1 */
    }
    return chance == 0 ? 1 : chance;
}

QL_NOINLINE bool ql_roulette_survives(
        const ql_sampler_t *sampler, uint32_t dim, ql_rgb_t *throughput)
{
    const ql_uniform2_t u = ql_sampler_2d(sampler, dim + QL_DIM_CHOICE);
    const ql_uq31_t chance = chance_of(throughput);
    ql_real_t inv_chance;

    if (chance >= QL_UQ31_ONE) {
        return true;
    }
    if (u.u2 >> 1 >= chance) {
        return false;
    }
    inv_chance = ql_real_recip(ql_real_from_u64(chance));
    ql_rgb_scale(throughput, ql_real_scale(inv_chance, 31));
    return true;
}

#endif
