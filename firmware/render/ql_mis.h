/* ql_mis.h - multiple importance sampling: weights by the balance heuristic */
/* SPDX-License-Identifier: MIT */

/* With the strategy MIS an emitter's light is estimated twice: by a direction
 * drawn towards the emitter, of density q (a point's, per solid angle, times
 * the chance of the emitter and its number of samples), and by a ray drawn from
 * a lobe, of density p (times the chance of the lobe). The balance heuristic
 * weighs each by its density's part of p + q. With h = p / q the weight of the
 * ray is h / (1 + h), and that of what is drawn towards the emitter
 * 1 / (1 + h).
 * From: Veach, "Robust Monte Carlo Methods for Light Transport Simulation",
 *       1997, 9.2. */

#ifndef QL_MIS_H
#define QL_MIS_H

#include "render/ql_context.h"

#if QL_MIS
/* The weight of a ratio of densities.
 *
 *   h       real  p / q
 *   return  real  h / (1 + h)
 *
 * Error: relative, 2^-28.
 */
ql_real_t ql_mis_weight(ql_real_t h);

/* The weight of a ray that met an emitter; 1 if nothing else could have drawn
 * its direction.
 *
 *   context  -      as every part of a path has it
 *   ray      -      the ray
 *   tri      -      what it met; NULL for the sky
 *   t        u2.30  where
 *   return   real   its weight
 */
ql_real_t ql_mis_weight_of_ray(const ql_context_t *context,
        const ql_path_ray_t *ray, const ql_blob_tri_t *tri, ql_uq30_t t);

/* Keep what weighs a ray that was drawn from a surface. */
QL_INLINE void ql_mis_begin(
        ql_path_ray_t *ray, ql_real_t pdf, const ql_surface_t *from)
{
    ray->pdf = pdf;
    ray->from = from;
}

/* Weigh a point of an emitter, seen from a diffuse surface: g is what it adds
 * for radiance and throughput of 1, cos / (pi q). A ray has p = cos / pi, so
 * h = g, and g / (1 + h) is that weight as well. */
QL_INLINE ql_real_t ql_mis_weigh_point(const ql_context_t *context, ql_real_t g)
{
    return ql_direct_is(context->settings->direct, QL_DIRECT_MIS)
                   ? ql_mis_weight(g)
                   : g;
}
#else
QL_INLINE ql_real_t ql_mis_weight_of_ray(const ql_context_t *context,
        const ql_path_ray_t *ray, const ql_blob_tri_t *tri, ql_uq30_t t)
{
    (void)context;
    (void)ray;
    (void)tri;
    (void)t;
    return QL_REAL_ONE;
}

QL_INLINE void ql_mis_begin(
        ql_path_ray_t *ray, ql_real_t pdf, const ql_surface_t *from)
{
    (void)ray;
    (void)pdf;
    (void)from;
}

QL_INLINE ql_real_t ql_mis_weigh_point(const ql_context_t *context, ql_real_t g)
{
    (void)context;
    return g;
}
#endif

#endif
