/* build_gloss.h - what materials are beyond diffuse, in fixed point */
/* SPDX-License-Identifier: MIT */

#ifndef BUILD_GLOSS_H
#define BUILD_GLOSS_H

#include "scene/ql_blob.h"
#include "lib/math/soft.h"
#include "scene/world.h"

/* Does a material reflect more than it gets? Sums of Kd + Ks that only rounding
 * takes above 1, as that of 0.1 and 0.9, do not count. */
bool gloss_excess(const world_material_t *material);

/* What Kd and Ks are multiplied by so that none does: 1, or less. */
soft_t gloss_scale(const world_material_t *material);

/* Round what a material reflects.
 *
 *   albedo    u1.31  out: Kd, of glass 0
 *   gloss     -      out: what is beyond; all zero if nothing is
 *   material  -      of the world
 *   return    true if anything is beyond diffuse, after rounding
 *
 * Exact: Kd + Ks is 2^31 at most in each channel.
 */
bool gloss_round(uint32_t albedo[3], ql_blob_gloss_t *gloss,
        const world_material_t *material);

#endif
