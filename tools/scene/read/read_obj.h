/* read_obj.h - meshes from Wavefront OBJ files */
/* SPDX-License-Identifier: MIT */

#ifndef READ_OBJ_H
#define READ_OBJ_H

#include "scene/world/world.h"

/* Append a mesh and its materials to a world.
 *
 *   world  -  in, out
 *   path   -  of the OBJ file; material libraries are beside it
 *
 * Polygons are filled as fill_face() does it. Faces without a known material
 * are grey 0.5. Faces of fewer than three corners and those of a vertex that is
 * no point are dropped.
 * What is not modelled, and what is not as it should be, is reported on stderr,
 * see notes_report().
 *
 * Fails: exit 2 with file and line of what is wrong, as an index out of range,
 *        or if there are vertices and no face, or nothing at all; exit 3 if it
 *        cannot be read.
 */
void read_obj(world_t *world, const char *path);

#endif
