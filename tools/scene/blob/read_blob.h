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
 * Fails: exit 2 with what open_blob() says, or if the tables do not lie as
 *        write_blob() lays them out; exit 3 if it cannot be read.
 */
void read_blob(model_t *model, const char *path);

#endif
