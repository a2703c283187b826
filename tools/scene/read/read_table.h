/* read_table.h - tabulated distributions from text files */
/* SPDX-License-Identifier: MIT */

#ifndef READ_TABLE_H
#define READ_TABLE_H

#include "scene/world/world.h"

/* Append the distribution of a text file to a world: "dims D  cells NX [NY
 * [NZ]]", then as many weights, x fastest, lines as they please.
 *
 *   world  -  in, out
 *   path   -  of the file
 *
 * Fails: exit 2 with file and line of what is wrong, for a weight below 0 and
 *        if all are 0 too; exit 3 if it cannot be read.
 */
void read_table(world_t *world, const char *path);

#endif
