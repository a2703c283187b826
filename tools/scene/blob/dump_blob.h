/* dump_blob.h - a blob for people: a summary, or all of it as text */
/* SPDX-License-Identifier: MIT */

#ifndef DUMP_BLOB_H
#define DUMP_BLOB_H

#include <stdio.h>

#include "scene/blob/model.h"

#define DUMP_FIRST_LINE "qlux-dump 1"

/* Lines of "key: value". */
void print_info(FILE *file, const model_t *model);

/* Every number of the blob as text: parse_dump() reads it back. */
void dump_blob(FILE *file, const model_t *model);

#endif
