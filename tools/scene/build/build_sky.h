/* build_sky.h - light from all around, in fixed point */
/* SPDX-License-Identifier: MIT */

#ifndef BUILD_SKY_H
#define BUILD_SKY_H

#include "lib/math/soft.h"
#include "scene/blob/model.h"
#include "scene/world/world.h"

/* The largest radiance of a sky that u0.32 radiance units must reach, a little
 * above that of a map, for whose rounding to nine bits; 0 without a sky. */
soft_t build_sky_most(const world_sky_t *sky);

/* Add the sky and what its map needs: texels and, as the last table, their
 * distribution over directions. Nothing for a black sky.
 *
 *   model  -  in, out: has radiance_exp and the tables of the scene
 *   world  -  the scene
 *
 * Error: half of the ninth bit of a texel's largest channel, half a radiance
 *        unit of a constant.
 * Fails: exit 2 if the map rounds to black beside brighter lights.
 */
void build_sky(model_t *model, const world_t *world);

/* Mean over directions of the sum of channels, radiance units; has a sky. */
soft_t build_sky_mean(const model_t *model);

#endif
