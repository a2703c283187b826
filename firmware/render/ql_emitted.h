/* ql_emitted.h - light of the emitters that rays meet, added to the pixel */
/* SPDX-License-Identifier: MIT */

#ifndef QL_EMITTED_H
#define QL_EMITTED_H

#include "render/ql_context.h"

/* Add throughput Le scale to the pixel.
 *
 *   context     -      as every part of a path has it
 *   throughput  -      of the light, up to the camera
 *   emission    uq32   Le, radiance units
 *   scale       real   any
 *
 * Exact: the products for a throughput of 1, else each to nearest 2^-31. The
 *        sum is rounded as ql_film_add() does.
 */
void ql_emitted_add(const ql_context_t *context, const ql_rgb_t *throughput,
        const ql_uq32_t emission[3], ql_real_t scale);

/* Add the same of what a material emits. */
QL_FAST_INLINE void ql_emitted_by_material(const ql_context_t *context,
        const ql_rgb_t *throughput, const ql_blob_material_t *material,
        ql_real_t scale)
{
    ql_uq32_t emission[3];

    for (unsigned i = 0; i < 3; i++) {
        emission[i] = QL_LE32(material->emission[i]);
    }
    ql_emitted_add(context, throughput, emission, scale);
}

/* Add what a ray sees that met a surface: nothing unless it is an emitter's,
 * from the side that shines.
 *
 *   context  -  as above
 *   ray      -  its counts is not QL_COUNTS_NOTHING
 *   hit      -  what it met
 */
void ql_emitted_by_hit(const ql_context_t *context, const ql_path_ray_t *ray,
        const ql_hit_t *hit);

/* Add what a ray sees that leaves the scene: the sky.
 *
 *   context  -  as above
 *   ray      -  its counts is not QL_COUNTS_NOTHING; where it counts all, only
 *               direction and throughput are looked at
 */
#if QL_CFG_SKY
void ql_emitted_by_sky(const ql_context_t *context, const ql_path_ray_t *ray);
#else
QL_INLINE void ql_emitted_by_sky(
        const ql_context_t *context, const ql_path_ray_t *ray)
{
    (void)context;
    (void)ray;
}
#endif

#endif
