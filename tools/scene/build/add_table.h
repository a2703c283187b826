/* add_table.h - append a distribution to the tables of a blob */
/* SPDX-License-Identifier: MIT */

#ifndef ADD_TABLE_H
#define ADD_TABLE_H

#include "scene/blob/model.h"
#include "scene/world/world.h"

/* Append a distribution to the tables of a model.
 *
 *   model  -  in, out
 *   table  -  weights, none below 0 and not all 0
 *   path   -  of the scene, for messages
 *
 * Fails: exit 2 if the words of all exceed 2^28, or tables 65,535.
 */
void add_table(model_t *model, const world_table_t *table, const char *path);

#endif
