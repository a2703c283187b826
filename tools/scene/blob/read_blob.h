/* read_blob.h - the bytes of a blob to a model */
/* SPDX-License-Identifier: MIT */

#ifndef READ_BLOB_H
#define READ_BLOB_H

#include "scene/blob/model.h"

/* Read and check a blob file.
 *
 *   model  -  out; model_free() it
 *   path   -  of the file
 *
 * Fails: exit 2 with the reason ql_blob_open() gives, or if the tables do not
 *        lie as write_blob() lays them out; exit 3 if it cannot be read.
 */
void read_blob(model_t *model, const char *path);

/* Fail with exit 2 unless the core would accept these bytes as a blob.
 *
 *   blob, size   -  the bytes, 4-byte aligned
 *   path         -  for the message
 */
void check_blob(const void *blob, size_t size, const char *path);

#endif
