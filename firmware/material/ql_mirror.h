/* ql_mirror.h - the mirror direction, and the lobe that is nothing else */
/* SPDX-License-Identifier: MIT */

#ifndef QL_MIRROR_H
#define QL_MIRROR_H

#include "material/ql_bsdf_parts.h"

/* A side of a surface. */
typedef enum {
    QL_SIDE_ABOVE = 1, /* where its normal points */
    QL_SIDE_BELOW = -1
} ql_side_t;

/* Is the surface a mirror, among other things?
 *
 *   bsdf  -  from ql_bsdf_begin()
 */
QL_INLINE bool ql_mirror_is(const ql_bsdf_t *bsdf)
{
    return QL_CFG_MIRROR && ql_bsdf_kind(bsdf) == QL_GLOSS_MIRROR;
}

#if QL_GLOSS
/* Work out the directions that the lobes are about.
 *
 *   bsdf      -      its surface is set; out: n, mirror, minus_wo, front
 *   front     -      ql_hit_t's
 *   incoming  dir_t  direction of the ray that came, any length
 *
 * The mirror direction is about the shading normal, or the flat one where the
 * ray comes from below the shading normal. It may lie below the surface: then
 * it is turned up across the surface's plane, so that no rim is black.
 *
 * Error: of the mirror direction 2^-24 rad, of its length that of ql_rsqrt_m().
 * Cost:  one reciprocal square root and about 25 multiplications, most of them
 *        to 64 bits.
 */
void ql_mirror_begin(ql_bsdf_t *bsdf, bool front, ql_vec3_t incoming);

/* The normal that reflects and refracts.
 *
 *   bsdf    -      from ql_bsdf_begin(); with gloss
 *   return  s2.29  the shading normal; the flat one if the viewer is below it
 */
ql_vec3_t ql_mirror_normal(const ql_bsdf_t *bsdf);

/* Turn a direction across the surface's plane if it is on the wrong side.
 *
 *   surface  -      from ql_surface_at()
 *   w        s2.29  of length 1 or less
 *   side     -      wanted
 *   return   s2.29  w, or its mirror image
 */
ql_vec3_t ql_mirror_turn(
        const ql_surface_t *surface, ql_vec3_t w, ql_side_t side);

/* Go on in the one direction of a specular lobe.
 *
 *   surface  -      from ql_surface_at()
 *   w        s2.29  after ql_mirror_turn()
 *   side     -      that w is on
 *   sample   -      out: all but its weight
 *   return   false if even the direction below is not on that side
 *
 * A direction that rounding puts onto the surface's plane is bent off by four
 * ulp, more than rounding moves it.
 */
bool ql_mirror_leave(const ql_surface_t *surface, ql_vec3_t w, ql_side_t side,
        ql_bsdf_sample_t *sample);
#else
QL_INLINE void ql_mirror_begin(ql_bsdf_t *bsdf, bool front, ql_vec3_t incoming)
{
    (void)bsdf, (void)front, (void)incoming;
}
#endif

#if QL_CFG_MIRROR
/* Take the mirror direction.
 *
 *   bsdf    -  a mirror
 *   sample  -  out, if true is returned: wi, of weight Ks
 *   return  false if Ks is zero
 */
bool ql_mirror_sample(const ql_bsdf_t *bsdf, ql_bsdf_sample_t *sample);
#else
QL_INLINE bool ql_mirror_sample(const ql_bsdf_t *bsdf, ql_bsdf_sample_t *sample)
{
    (void)bsdf, (void)sample;
    return false;
}
#endif

#endif
