/* ql_diffuse.h - Lambert's lobe, Kd/pi: every direction alike */
/* SPDX-License-Identifier: MIT */

#ifndef QL_DIFFUSE_H
#define QL_DIFFUSE_H

#include "material/ql_bsdf_parts.h"

/* Draw a direction proportional to the cosine: all that a flat diffuse surface
 * needs, as the weight is its albedo.
 *
 *   surface  -      flat
 *   u        uq32   chooses the direction
 *   return   dir_t  above the surface; the normal where the direction would be
 *                   below by rounding, or zero (rarer than 2^-18 in draft,
 *                   2^-26 in fine)
 *
 * pdf: cos/pi per solid angle, ql_diffuse_pdf().
 */
ql_vec3_t ql_diffuse_direction(const ql_surface_t *surface, ql_uniform2_t u);

/* Density of ql_diffuse_direction(), per solid angle.
 *
 *   cosine  real  cos(theta) to the shading normal
 *   return  cosine / pi
 *
 * Error: relative, 2^-30.
 */
QL_INLINE ql_real_t ql_diffuse_pdf(ql_real_t cosine)
{
    return ql_real_mul_call(cosine, QL_REAL_INV_PI);
}

/* Draw a unit direction proportional to the cosine to the shading normal.
 *
 *   surface  -      from ql_surface_at()
 *   u        uq32   chooses the direction
 *   return   s2.29  unit vector, below the surface perhaps; zero where the
 *                   warp's direction is
 *
 * pdf: cos/pi per solid angle, ql_diffuse_pdf().
 */
ql_vec3_t ql_diffuse_unit(const ql_surface_t *surface, ql_uniform2_t u);

/* 1 / ql_diffuse_pdf(): pi over the cosine, which is above 0. */
QL_INLINE ql_real_t ql_diffuse_inv_pdf(ql_real_t cosine)
{
    return ql_real_mul(QL_REAL_PI, ql_real_recip(cosine));
}

/* Draw a direction about the shading normal that knows of no lobe but this.
 *
 *   surface  -     from ql_surface_at()
 *   density  -     UNIFORM; any other is the cosine's
 *   u        uq32  chooses the direction
 *   sample   -     out: its wi
 *   ratio    real  out: cos/pi over the density of wi; 1 but for UNIFORM
 *   pdf      real  out, unless NULL, not for UNIFORM: density of wi
 *   return   false if wi is below the surface
 */
bool ql_diffuse_draw(const ql_surface_t *surface, ql_density_t density,
        ql_uniform2_t u, ql_bsdf_sample_t *sample, ql_real_t *ratio,
        ql_real_t *pdf);

/* Draw from the lobe.
 *
 *   bsdf                    -  from ql_bsdf_begin()
 *   density, u, pdf         -  as for ql_diffuse_draw()
 *   sample                  -  out: wi and weight, Kd times the ratio
 *   return  false if wi is below the surface or Kd is zero
 */
bool ql_diffuse_sample(const ql_bsdf_t *bsdf, ql_density_t density,
        ql_uniform2_t u, ql_bsdf_sample_t *sample, ql_real_t *pdf);

#endif
