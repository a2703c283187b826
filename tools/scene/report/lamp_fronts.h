/* lamp_fronts.h - lamps that shine away from everything */
/* SPDX-License-Identifier: MIT */

#ifndef LAMP_FRONTS_H
#define LAMP_FRONTS_H

#include "scene/mesh/grid.h"
#include "scene/ql_scene.h"
#include "scene/world/world.h"

/* Warn of emitting triangles from whose fronts nothing is seen, or only what is
 * nearer than 1/256 of the scene, but from whose backs there is more:
 * all triangles of a material in one mesh are one lamp. Not said if lights are
 * two-sided, or if the camera is in front, which may see it shine.
 *
 *   scene  -  the blob, opened
 *   world  -  the scene
 *   grid   -  the same, on its grid
 */
void lamp_fronts_report(
        const ql_scene_t *scene, const world_t *world, const grid_t *grid);

#endif
