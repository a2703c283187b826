/* dump_blob.h - all of a blob as text */
/* SPDX-License-Identifier: MIT */

#ifndef DUMP_BLOB_H
#define DUMP_BLOB_H

#include <stdio.h>

#include "scene/blob/model.h"

#define DUMP_FIRST_LINE "qlux-dump 1"

/* Write every number of a blob as text: parse_dump() reads it back. */
void dump_blob(FILE *file, const model_t *model);

#endif
