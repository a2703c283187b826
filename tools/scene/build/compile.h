/* compile.h - a scene to everything its blob says, step by step */
/* SPDX-License-Identifier: MIT */

#ifndef COMPILE_H
#define COMPILE_H

#include "scene/blob/model.h"
#include "scene/mesh/bvh.h"
#include "scene/mesh/grid.h"
#include "scene/touch/hull.h"
#include "scene/world/world.h"

#define COMPILE_LEAF8_MAX 12 /* 3 + n must fit the nibble of an 8-bit node */

typedef struct {
    unsigned node_bits; /* 8 or 16 */
    unsigned leaf_max;  /* triangles: 1..13, with 8-bit nodes 1..12 */
    bool quiet;         /* no progress bar */
} compile_options_t;

/* Compile a scene: split edges at joints, round it to its grid, find smooth
 * corners, build the tree, then compile_model(). Reports on stderr the faces
 * that were cut and those that the grid lost.
 *
 *   model    -  out; model_free() it
 *   world    -  the scene; faces are split
 *   options  -  how
 *
 * Fails: exit 2 as compile_model(), or for too many triangles.
 */
void compile_scene(
        model_t *model, world_t *world, const compile_options_t *options);

/* The last step: all that the blob says of a scene whose tree is built.
 *
 *   model      -        out; model_free() it
 *   world      -        the scene
 *   grid       -        the same, on its grid, its corners smooth
 *   bvh        -        tree over the grid
 *   hull       -        what it has apart; NULL for nothing
 *   node_bits  8 or 16
 *
 * Fails: exit 2 for a camera too far away, a lens too wide, too many materials,
 *        lights or table words, or a sky too dim beside its lights.
 */
void compile_model(model_t *model, const world_t *world, const grid_t *grid,
        const bvh_t *bvh, const hull_t *hull, unsigned node_bits);

#endif
