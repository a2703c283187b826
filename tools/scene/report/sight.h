/* sight.h - a camera that sees nothing, or is inside an object */
/* SPDX-License-Identifier: MIT */

#ifndef SIGHT_H
#define SIGHT_H

#include "scene/mesh/bvh.h"
#include "scene/mesh/grid.h"
#include "scene/ql_scene.h"
#include "scene/world/world.h"

/* Warn of a camera
 *
 *   - of whose picture no ray meets a surface, if there is no map of the sky to
 *     be seen: where the scene is;
 *   - that sees backs of faces wherever it looks, nearly all around, if what it
 *     sees is not as large as the scene: a room may have its fronts outside,
 *     an object that one wants to see has not the camera in it. Glass is not
 *     counted, for a camera may be in water.
 *
 *   scene  -  the blob, opened
 *   world  -  the scene
 *   grid   -  the same, on its grid
 *   bvh    -  gives the order of the triangles
 */
void sight_report(const ql_scene_t *scene, const world_t *world,
        const grid_t *grid, const bvh_t *bvh);

#endif
