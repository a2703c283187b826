/* build_lights.h - which surfaces shine, and how often each is chosen */
/* SPDX-License-Identifier: MIT */

#ifndef BUILD_LIGHTS_H
#define BUILD_LIGHTS_H

#include "scene/blob/model.h"
#include "scene/mesh/bvh.h"
#include "scene/mesh/grid.h"

/* Make every triangle and sphere that emits a light, and the sky the last one.
 * Weights, in one unit: of a triangle twice its area, of a sphere 8 pi R^2,
 * both times its emission; of the sky 8 pi Rs^2 times the mean of its
 * radiance, Rs half the diagonal of the scene's box.
 *
 *   model  -  in, out: complete but for lights, nodes and header
 *   grid   -  the scene on its grid
 *   bvh    -  gives the order of the triangles
 *   path   -  of the scene, for messages
 *
 * Fails: exit 2 for more than 65,535 lights, the sky included.
 */
void build_lights(
        model_t *model, const grid_t *grid, const bvh_t *bvh, const char *path);

#endif
