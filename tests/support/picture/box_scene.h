/* box_scene.h - a small scene for tests: an open box with a lamp */
/* SPDX-License-Identifier: MIT */

#ifndef BOX_SCENE_H
#define BOX_SCENE_H

#include <stddef.h>

/* Build the blob: floor, back wall, side walls and a square lamp, 64 by 48 px.
 * Every build of the core can open it.
 *
 *   size    bytes  out: of the blob
 *   return  the blob, 4-byte aligned; the same memory and bytes every time
 */
void *box_scene(size_t *size);

#endif
