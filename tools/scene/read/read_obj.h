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
 * Polygons become fans. Faces without a known material are grey 0.5. What is
 * not modelled is reported once by name on stderr.
 *
 * Fails: exit 2 with file and line of what is wrong; exit 3 if it cannot be
 *        read.
 */
void read_obj(world_t *world, const char *path);

#endif
