/* ql_path.h - the integrator: one camera path, bounce by bounce */
/* SPDX-License-Identifier: MIT */

#ifndef QL_PATH_H
#define QL_PATH_H

#include "render/ql_direct.h"

/* Follow one path and add the light it carries to a pixel.
 *
 *   path  -  scene, settings, sampler started for this sample, sum, counters
 *   ray   -  the camera ray, in the box
 *
 * Emitters count exactly once: where the camera ray hits them, and at every
 * vertex by the direct strategy.
 */
void ql_path_trace(const ql_path_t *path, const ql_ray_t *ray);

/* Add what is seen by a camera ray that misses the scene's box: the sky.
 *
 *   path  -  likewise
 *   ray   -  only its direction counts
 */
void ql_path_miss(const ql_path_t *path, const ql_ray_t *ray);

#endif
