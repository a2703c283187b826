/* read_mtl.h - materials from MTL files */
/* SPDX-License-Identifier: MIT */

#ifndef READ_MTL_H
#define READ_MTL_H

#include "scene/read/text.h"
#include "scene/world/world.h"

/* Append the materials of an MTL file to a world. What they become:
 *
 *   illum 7              glass of Ni and Tf; Kd and Ks mean nothing
 *   illum 3 or 5, Ks     a mirror of Ks beside Kd
 *   illum 0 or 1         Kd only
 *   other or none, Ks    the Phong lobe of Ks and Ns beside Kd
 *
 * Ke makes any of them a light. Anything else that would change the picture is
 * reported with its line, its material and what is done instead; so is what is
 * out of range or no number, which leaves a property as it was. See
 * notes_report().
 *
 *   world  -  in, out
 *   path   -  of the MTL file
 *
 * Fails: exit 2 with file and line of what is wrong; exit 3 if it cannot be
 *        read.
 */
void read_mtl(world_t *world, const char *path);

/* Append the material that the rest of a line of a scene defines: its name, one
 * word, then properties as in an MTL file, each once. What that reports as no
 * number is an error here.
 *
 *   world  -  in, out; all materials are of lines like this
 *   text   -  in, out: of the .scene
 *
 * Fails: exit 2 with file and line of what is wrong.
 */
void read_material(world_t *world, text_t *text);

#endif
