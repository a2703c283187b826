/* scene_info.h - a summary of a blob, line by line */
/* SPDX-License-Identifier: MIT */

#ifndef SCENE_INFO_H
#define SCENE_INFO_H

#include <stdio.h>

#include "scene/blob/model.h"

/* Write lines of "key: value" about a model that read_blob() gave. */
void print_info(FILE *file, const model_t *model);

/* Write one line: what auto stands for, and how the ways that were tried
 * compare. */
void print_choice_line(FILE *file, const model_t *model);

#endif
