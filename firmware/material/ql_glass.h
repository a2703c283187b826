/* ql_glass.h - a smooth dielectric: reflects or refracts, by Fresnel's law */
/* SPDX-License-Identifier: MIT */

#ifndef QL_GLASS_H
#define QL_GLASS_H

#include "material/ql_bsdf_parts.h"

/* Is the surface glass?
 *
 *   bsdf  -  from ql_bsdf_begin()
 */
QL_INLINE bool ql_glass_is(const ql_bsdf_t *bsdf)
{
    return QL_CFG_GLASS && ql_bsdf_kind(bsdf) == QL_GLOSS_GLASS;
}

#if QL_CFG_GLASS
/* Reflect or refract.
 *
 *   bsdf    -     glass
 *   pick    uq32  chooses: below Fresnel's reflectance R it reflects
 *   sample  -     out, if true is returned: wi and weight
 *   return  false if the light is refracted and Tf is zero
 *
 * R is the chance to reflect, weight 1; what is refracted has weight
 * Tf (n1/n2)^2, as radiance does.
 *
 * Error: R within 2^-20 (draft 2^-11), but where the cosine's own error, 5e-8
 *        (6e-5), moves it more, next to total reflection.
 * From:  the equations of Snell and Fresnel.
 */
bool ql_glass_sample(
        const ql_bsdf_t *bsdf, ql_uq32_t pick, ql_bsdf_sample_t *sample);
#else
QL_INLINE bool ql_glass_sample(
        const ql_bsdf_t *bsdf, ql_uq32_t pick, ql_bsdf_sample_t *sample)
{
    (void)bsdf, (void)pick, (void)sample;
    return false;
}
#endif

#endif
