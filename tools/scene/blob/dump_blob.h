/* dump_blob.h - all of a blob as text */
/* SPDX-License-Identifier: MIT */

#ifndef DUMP_BLOB_H
#define DUMP_BLOB_H

#include <stdio.h>

#include "scene/blob/model.h"

/* The first line is its name and its version, the last one says that all of it
 * is there. */
#define DUMP_NAME    "qlux-dump"
#define DUMP_VERSION "3"
#define DUMP_END     "end"

/* Write every number of a blob as text: parse_dump() reads it back. */
void dump_blob(FILE *file, const model_t *model);

#endif
