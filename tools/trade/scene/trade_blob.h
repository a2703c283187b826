/* trade_blob.h - a scene, compiled if it has to be */
/* SPDX-License-Identifier: MIT */

#ifndef TRADE_BLOB_H
#define TRADE_BLOB_H

#include <stdbool.h>

#include "scene/ql_scene.h"

/* Does the name end like one of a blob?  Of what qlux-scene compiles? */
bool trade_blob_is_one(const char *path);
bool trade_blob_is_source(const char *path);

/* Open a blob, or have qlux-scene compile a .scene or .obj and open that.
 *
 *   scene    -  out
 *   path     -  of the file
 *   program  -  argv[0]: qlux-scene is in the same folder, or found as this
 *               program was
 *   return   the blob, which the scene lies in: to be freed after it
 *
 * Fails: cli_fail() as open_blob(), or with the code of qlux-scene, which has
 * said why.
 */
void *trade_blob_open(ql_scene_t *scene, const char *path, const char *program);

#endif
