/* ql_phong.h - the modified Phong lobe: cos^n about the mirror direction */
/* SPDX-License-Identifier: MIT */

/* f = Ks (n + 2)/(2 pi) cos^n(alpha) with alpha the angle between wi and the
 * mirror direction: Lafortune and Willems, "Using the Modified Phong
 * Reflectance Model for Physically Based Rendering", 1994. It is drawn by
 * (n + 1)/(2 pi) cos^n(alpha), which leaves Ks (n + 2)/(n + 1) cos(theta). */

#ifndef QL_PHONG_H
#define QL_PHONG_H

#include "material/ql_bsdf_parts.h"

/* Does the surface have this lobe?
 *
 *   bsdf  -  from ql_bsdf_begin()
 */
QL_INLINE bool ql_phong_is(const ql_bsdf_t *bsdf)
{
    return QL_CFG_PHONG && ql_bsdf_kind(bsdf) == QL_GLOSS_PHONG;
}

#if QL_CFG_PHONG
/* Draw from the lobe.
 *
 *   bsdf    -     it has this lobe
 *   u       uq32  chooses the direction
 *   sample  -     out, if true is returned: wi and weight
 *   pdf     real  out, unless NULL, if true is returned: density of wi
 *   return  false if wi is below the surface or the shading normal's plane, or
 *           Ks is zero
 */
bool ql_phong_sample(const ql_bsdf_t *bsdf, ql_uniform2_t u,
        ql_bsdf_sample_t *sample, ql_real_t *pdf);

/* Density of ql_phong_sample(), per solid angle.
 *
 *   bsdf    -      it has this lobe
 *   wi      s2.29  unit direction
 *   return  (n + 1)/(2 pi) cos^n(alpha); 0 a right angle or more off
 */
ql_real_t ql_phong_pdf(const ql_bsdf_t *bsdf, ql_vec3_t wi);

/* What a direction drawn by ql_phong_pdf() weighs, times a factor.
 *
 *   bsdf    -     it has this lobe
 *   factor  real  cos(theta), and whatever else scales the lobe
 *   weight  -     out: Ks (n + 2)/(n + 1) factor
 *   return  false if Ks is zero
 */
bool ql_phong_weight(const ql_bsdf_t *bsdf, ql_real_t factor, ql_rgb_t *weight);
#else
QL_INLINE bool ql_phong_sample(const ql_bsdf_t *bsdf, ql_uniform2_t u,
        ql_bsdf_sample_t *sample, ql_real_t *pdf)
{
    (void)bsdf, (void)u, (void)sample, (void)pdf;
    return false;
}

QL_INLINE ql_real_t ql_phong_pdf(const ql_bsdf_t *bsdf, ql_vec3_t wi)
{
    const ql_real_t none = {0, 0};

    (void)bsdf, (void)wi;
    return none;
}

QL_INLINE bool ql_phong_weight(
        const ql_bsdf_t *bsdf, ql_real_t factor, ql_rgb_t *weight)
{
    (void)bsdf, (void)factor, (void)weight;
    return false;
}
#endif

#endif
