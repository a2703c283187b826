/* ql_context.h - what the parts of a path share: context, ray, vertex */
/* SPDX-License-Identifier: MIT */

#ifndef QL_CONTEXT_H
#define QL_CONTEXT_H

#include "base/ql_diag.h"
#include "base/ql_settings.h"
#include "film/ql_clamp.h"
#include "film/ql_film.h"
#include "material/ql_bsdf.h"
#include "math/vec/ql_rgb.h"
#include "render/ql_plan.h"
#include "sample/ql_sampler.h"
#include "scene/ql_ray.h"
#include "scene/ql_scene.h"
#include "scene/ql_surface.h"

/* What one camera path is traced in, and what it adds to. */
typedef struct {
    const ql_scene_t *scene;
    const ql_settings_t *settings;
    const ql_sampler_t *sampler; /* started for this sample */
    ql_sum_t *sum;               /* of the pixel */
    ql_diag_t *diag;
    QL_IF_BUILT(QL_CFG_CLAMP, ql_clamp_t *clamp;) /* NULL: nothing is cut */
} ql_context_t;

#if QL_CFG_CLAMP
QL_INLINE ql_clamp_t *ql_context_clamp(const ql_context_t *context)
{
    return context->clamp;
}

/* The context of a path's first ray: what the camera sees itself is not cut.
 *
 *   copy    -  room for it
 *   return  context, or copy if this is ray 0
 */
QL_INLINE const ql_context_t *ql_context_of_ray(
        const ql_context_t *context, unsigned ray, ql_context_t *copy)
{
    if (ray > 0) {
        return context;
    }
    *copy = *context;
    copy->clamp = NULL;
    return copy;
}
#else
QL_INLINE ql_clamp_t *ql_context_clamp(const ql_context_t *context)
{
    return (void)context, NULL;
}

QL_INLINE const ql_context_t *ql_context_of_ray(
        const ql_context_t *context, unsigned ray, ql_context_t *copy)
{
    return (void)ray, (void)copy, context;
}
#endif

/* A ray of a path. */
typedef struct {
    ql_ray_t ray;
    ql_rgb_t throughput; /* what light that comes along it is multiplied by */
    ql_counts_t counts;  /* of an emitter that it meets */
    bool specular;       /* drawn from a specular lobe, or the camera's */
    /* where it is weighed by MIS: the density of its direction times the
     * chance of its lobe, and where it began */
    QL_IF_BUILT(QL_MIS, ql_real_t pdf;)
    QL_IF_BUILT(QL_MIS, const ql_surface_t *from;)
} ql_path_ray_t;

/* A vertex of a path: where a ray met a surface that reflects. */
typedef struct {
    uint32_t dim;     /* QL_DIM_BOUNCE(k): its numbers */
    uint16_t tri_idx; /* what was hit */
    ql_surface_t surface;
    ql_bsdf_t bsdf;
    const ql_rgb_t *throughput; /* of the ray that met it */
    ql_rgb_t reflected;         /* the same times the diffuse albedo */
} ql_vertex_t;

#endif
