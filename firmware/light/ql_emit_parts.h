/* ql_emit_parts.h - a direction towards an emitter */
/* SPDX-License-Identifier: MIT */

/* The kinds of emitters, each in a file of its own, draw this; ql_emit.h asks
 * them. */

#ifndef QL_EMIT_PARTS_H
#define QL_EMIT_PARTS_H

#include "base/ql_settings.h"
#include "trace/surface/ql_shading.h"
#include "math/ql_real.h"
#include "sample/ql_sampler.h"
#include "scene/ql_ray.h"
#include "scene/ql_scene.h"
#include "scene/ql_surface.h"

/* A direction towards an emitter. */
typedef struct {
    ql_vec3_t wi;          /* s2.29: unit, above the surface */
    ql_real_t cosine;      /* to the shading normal, above 0 */
    ql_real_t inv_pdf;     /* 1 / pdf per solid angle */
    ql_vec3_t to;          /* ql_pos_t: where it ends; not of the sky */
    ql_uq32_t emission[3]; /* radiance units */
} ql_emit_sample_t;

/* Set a direction and its cosine.
 *
 *   sample   -      out: wi and cosine
 *   surface  -      to be lit
 *   wi       s2.29  unit
 *   return   false if wi is not above the surface and the shading normal
 */
QL_INLINE bool ql_emit_set_wi(
        ql_emit_sample_t *sample, const ql_surface_t *surface, ql_vec3_t wi)
{
    sample->wi = wi;
    sample->cosine = ql_real_scale(ql_shading_cosine(surface, wi), -29);
    return sample->cosine.m != 0;
}

#endif
