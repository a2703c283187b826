/* read_scene.h - the .scene text and the meshes it names */
/* SPDX-License-Identifier: MIT */

#ifndef READ_SCENE_H
#define READ_SCENE_H

#include "scene/read/text.h"
#include "scene/world/world.h"

/* Read a scene and all the files it names.
 *
 *   world  -  out: the scene; world_free() it
 *   text   -  the .scene, open and at its start
 *
 * Fails: exit 2 with file and line of what is wrong; exit 3 for a mesh that
 *        cannot be read.
 */
void read_scene(world_t *world, text_t *text);

#endif
