/* ql_path.h - the integrator: one camera path, bounce by bounce */
/* SPDX-License-Identifier: MIT */

#ifndef QL_PATH_H
#define QL_PATH_H

#include "render/ql_context.h"

/* Follow one path and add the light it carries to a pixel.
 *
 *   context     -  scene, settings, sampler started for this sample, sum,
 *                  counters
 *   camera_ray  -  in the box
 *
 * Emitters count exactly once: where the camera ray meets them, and at every
 * vertex by the direct strategy.
 */
void ql_path_trace(const ql_context_t *context, const ql_ray_t *camera_ray);

/* Add what a camera ray sees that misses the scene's box: the sky.
 *
 *   context     -  as above
 *   camera_ray  -  only its direction is looked at
 */
#if QL_CFG_SKY
void ql_path_miss(const ql_context_t *context, const ql_ray_t *camera_ray);
#else
QL_INLINE void ql_path_miss(
        const ql_context_t *context, const ql_ray_t *camera_ray)
{
    (void)context;
    (void)camera_ray;
}
#endif

#endif
