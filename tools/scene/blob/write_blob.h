/* write_blob.h - a model to the bytes of a blob */
/* SPDX-License-Identifier: MIT */

#ifndef WRITE_BLOB_H
#define WRITE_BLOB_H

#include "scene/blob/model.h"

/* Lay a blob out: header, camera, vertices, triangles, pairs, materials,
 * lights, each at the next multiple of 4, with CRC and sizes filled in.
 *
 *   model   -      complete
 *   size    bytes  out
 *   return  the blob, malloc'd, in the byte order of the format
 */
uint8_t *write_blob(const model_t *model, size_t *size);

#endif
