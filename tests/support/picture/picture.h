/* picture.h - load blobs, write the pictures of a failed claim */
/* SPDX-License-Identifier: MIT */

#ifndef PICTURE_H
#define PICTURE_H

#include <stddef.h>
#include <stdint.h>

#include "scene/ql_scene.h"

/* Read a whole file into memory that free() takes; NULL if it cannot be read.
 * Aligned as a blob must be. */
void *picture_load(const char *path, size_t *size);

/* The path of a file that make builds: in the folder that the environment calls
 * BUILD, or in build. Valid until the next call. */
const char *picture_built(const char *name);

/* One radiance unit of a scene, in the units of its Ke. */
double picture_radiance_unit(const ql_scene_t *scene);

/* Leave <name>_actual.ppm and <name>_diff.ppm in build/fail: the picture with a
 * gamma of 2.2, and red where it is too bright, blue where too dark.
 *
 *   name           -   of the test
 *   actual, wanted -   radiance, 3 * width * height, rows from the top
 *   return         the path of the difference, or why it could not be written
 */
const char *picture_fail(const char *name, const double *actual,
        const double *wanted, unsigned width, unsigned height);

#endif
