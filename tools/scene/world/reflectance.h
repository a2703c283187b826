/* reflectance.h - how much a material reflects, and what keeps it to 1 */
/* SPDX-License-Identifier: MIT */

#ifndef REFLECTANCE_H
#define REFLECTANCE_H

#include "lib/math/soft.h"
#include "scene/world/world.h"

/* Does a material reflect more than it gets? A sum Kd + Ks that only rounding
 * takes above 1, as that of 0.1 and 0.9, does not count. */
bool reflectance_is_excess(const world_material_t *material);

/* What Kd and Ks are multiplied by so that it does not: 1, or less. */
soft_t reflectance_scale(const world_material_t *material);

#endif
