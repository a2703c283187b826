/* ql_path.h - the integrator: one camera path, bounce by bounce */
/* SPDX-License-Identifier: MIT */

#ifndef QL_PATH_H
#define QL_PATH_H

#include "render/ql_film.h"
#include "sample/ql_sampler.h"
#include "scene/ql_ray.h"
#include "scene/ql_scene.h"
#include "base/ql_settings.h"

/* Follow one path and add the light it carries to a pixel.
 *
 *   scene     -  open
 *   settings  -  bounces, direct and indirect estimators
 *   sampler   -  started for this sample
 *   ray       -  the camera ray
 *   sum       -  added to
 *   diag      -  counts
 *
 * Emitters count exactly once: at the camera ray's own hit, and by the direct
 * estimator at every vertex; hits by indirect rays add nothing.
 */
void ql_path_trace(const ql_scene_t *scene, const ql_settings_t *settings,
        const ql_sampler_t *sampler, const ql_ray_t *ray, ql_sum_t *sum,
        ql_diag_t *diag);

#endif
