/* ql_roulette.h - Russian roulette: end faint paths, make up for it */
/* SPDX-License-Identifier: MIT */

#ifndef QL_ROULETTE_H
#define QL_ROULETTE_H

#include "math/vec/ql_rgb.h"
#include "sample/ql_sampler.h"

#if QL_CFG_ROULETTE
/* Let a path survive with the chance of its throughput's largest channel, if
 * that is below 1, and divide its throughput by the chance.
 *
 *   sampler     -  of the sample
 *   dim         -  QL_DIM_BOUNCE(k) of the vertex
 *   throughput  -  after the vertex; changed if the path survives
 *   return      false if the path ends
 *
 * The mean of the throughput does not change. The chance is at least 2^-31.
 * Exact: the chance is the integer that is compared with.
 * Error: of what divides, relative, 2^-28.
 */
bool ql_roulette_survives(
        const ql_sampler_t *sampler, uint32_t dim, ql_rgb_t *throughput);
#else
QL_INLINE bool ql_roulette_survives(
        const ql_sampler_t *sampler, uint32_t dim, ql_rgb_t *throughput)
{
    (void)sampler;
    (void)dim;
    (void)throughput;
    return true;
}
#endif

#endif
