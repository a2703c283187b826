/* open_blob.h - read a scene blob and open it, or say what is wrong with it */
/* SPDX-License-Identifier: MIT */

#ifndef OPEN_BLOB_H
#define OPEN_BLOB_H

#include "scene/ql_scene.h"

/* Read a file and open the blob in it.
 *
 *   scene   -  out: as ql_blob_open() makes it
 *   path    -  of the file; "-" is stdin
 *   return  the blob, which the scene lies in: to be freed after it
 *
 * Fails by cli_fail(): CLI_IO if the file cannot be read, CLI_INPUT with the
 * byte and what was expected there if it is no blob for this core. */
void *open_blob(ql_scene_t *scene, const char *path);

/* Open a blob in memory, or cli_fail(CLI_INPUT) in the same words.
 *
 *   scene  -      out
 *   blob   -      4-byte aligned
 *   size   bytes  of it
 *   name   -      begins the message
 */
void open_blob_bytes(
        ql_scene_t *scene, const void *blob, size_t size, const char *name);

#endif
