/* ql_sampler.c - independent and Owen-scrambled Sobol numbers */
/* SPDX-License-Identifier: MIT */

#include "sample/ql_sampler.h"

#include "sample/ql_hash.h"
#include "sample/ql_sobol.h"

#define GOLDEN 0x9e3779b9u /* 2^32 / golden ratio: spreads small integers */

static bool is_sobol(const ql_sampler_t *sampler)
{
    return QL_CFG_SAMPLERS == 3 ? sampler->sobol : QL_CFG_SAMPLERS == 2;
}

void ql_sampler_begin(ql_sampler_t *sampler, uint8_t kind, uint32_t seed,
        uint16_t x, uint16_t y)
{
    uint32_t key = ql_hash32(seed + GOLDEN);

    key = ql_hash32(key + x);
    sampler->key = ql_hash32(key + y);
    sampler->sobol = kind == QL_SAMPLER_SOBOL;
    ql_sampler_start(sampler, 0);
}

void ql_sampler_start(ql_sampler_t *sampler, uint32_t index)
{
    sampler->index = is_sobol(sampler) ? ql_reverse32(index) : index * GOLDEN;
}

ql_uniform2_t ql_sampler_2d(const ql_sampler_t *sampler, uint32_t dim)
{
    const uint32_t key1 = ql_hash32(sampler->key + dim * GOLDEN);
    const uint32_t key2 = ql_hash32(key1 + GOLDEN);
    ql_uniform2_t u;

    if (is_sobol(sampler)) {
        const uint32_t key3 = ql_hash32(key2 + GOLDEN);
        const uint32_t index =
                ql_reverse32(ql_owen_reversed(sampler->index, key3));

        /* the shuffled index is its own first coordinate, bit-reversed */
        u.u1 = ql_reverse32(ql_owen_reversed(index, key1));
        u.u2 = ql_reverse32(ql_owen_reversed(ql_sobol_1_reversed(index), key2));
    } else {
        u.u1 = ql_hash32(key1 + sampler->index);
        u.u2 = ql_hash32(key2 + sampler->index);
    }
    return u;
}

#if QL_CFG_SMALL
ql_uq32_t ql_sampler_1d(const ql_sampler_t *sampler, uint32_t dim)
{
    return ql_sampler_2d(sampler, dim).u1;
}
#else
ql_uq32_t ql_sampler_1d(const ql_sampler_t *sampler, uint32_t dim)
{
    const uint32_t key1 = ql_hash32(sampler->key + dim * GOLDEN);

    if (is_sobol(sampler)) {
        const uint32_t key3 = ql_hash32(ql_hash32(key1 + GOLDEN) + GOLDEN);
        const uint32_t index =
                ql_reverse32(ql_owen_reversed(sampler->index, key3));

        return ql_reverse32(ql_owen_reversed(index, key1));
    }
    return ql_hash32(key1 + sampler->index);
}
#endif
