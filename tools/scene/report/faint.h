/* faint.h - lights too dim beside the brightest one for 32 bits, by name */
/* SPDX-License-Identifier: MIT */

#ifndef FAINT_H
#define FAINT_H

#include "scene/blob/model.h"
#include "scene/mesh/bvh.h"
#include "scene/mesh/grid.h"
#include "scene/world/world.h"

/* Warn of materials and of a constant sky whose light is off by more than 1 %
 * in the blob, and of texels that are off by an eighth or black there, because
 * 32 bits of radiance are too few: by what factor, and how much dimmer they are
 * than the brightest light. Ten materials are named, the rest counted.
 *
 *   model  -  of the scene, complete
 *   world  -  the scene
 *   grid   -  the same, on its grid, with gains
 *   bvh    -  gives the order of the triangles
 */
void faint_report(const model_t *model, const world_t *world,
        const grid_t *grid, const bvh_t *bvh);

#endif
