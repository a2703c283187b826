/* build_materials.h - what surfaces reflect and emit, in fixed point */
/* SPDX-License-Identifier: MIT */

#ifndef BUILD_MATERIALS_H
#define BUILD_MATERIALS_H

#include "scene/blob/model.h"
#include "scene/mesh/bvh.h"
#include "scene/world/world.h"

/* Round what a material reflects.
 *
 *   albedo    u1.31  out: Kd, of glass 0
 *   gloss     -      out: what is beyond; all zero if nothing is
 *   material  -      of the world
 *   return    true if anything is beyond diffuse, after rounding
 *
 * Exact: Kd + Ks is 2^31 at most in each channel.
 */
bool build_materials_round(uint32_t albedo[3], ql_blob_gloss_t *gloss,
        const world_material_t *material);

/* Add the materials that a face uses, those with gloss first; choose the unit
 * of radiance, and tell triangles and spheres which material is theirs.
 *
 *   model  -  in, out: has its triangles
 *   world  -  the scene
 *   grid   -  the same, on its grid
 *   bvh    -  gives the order of the triangles
 *
 * Fails: exit 2 for more than 16,384 materials.
 */
void build_materials(model_t *model, const world_t *world, const grid_t *grid,
        const bvh_t *bvh);

#endif
