/* ql_bsdf.h - how a surface scatters light: sample and value of its BSDF */
/* SPDX-License-Identifier: MIT */

/* A material has up to two lobes, and each lobe is an integral of its own:
 *
 *   diffuse   Kd/pi                                     ql_diffuse.h
 *   Phong     Ks (n + 2)/(2 pi) cos^n(alpha), alpha     ql_phong.h
 *             from the mirror direction
 *   mirror    all of Ks in the mirror direction         ql_mirror.h
 *   glass     reflected or refracted, by Fresnel        ql_glass.h
 *
 * Beside the diffuse lobe there is at most one other, which is drawn with a
 * fixed chance P; glass is alone. Weights and densities are those of the lobe
 * that was drawn, so the other lobe's cos^n is never needed. The lobes do not
 * know their chances: the functions here divide by them. A specular lobe, of a
 * mirror or glass, has a single direction. All directions lead away from the
 * surface: wo back along the ray that came, wi to where light comes from. */

#ifndef QL_BSDF_H
#define QL_BSDF_H

#include "material/ql_bsdf_parts.h"

/* Make a surface ready.
 *
 *   bsdf      -      out; keeps a pointer to surface
 *   scene     -      open
 *   surface   -      from ql_surface_at()
 *   material  -      of what was hit
 *   front     -      ql_hit_t's
 *   incoming  dir_t  direction of the ray that hit it, any length
 *
 * Cost: three pointers for a diffuse surface, else ql_mirror_begin().
 */
void ql_bsdf_begin(ql_bsdf_t *bsdf, const ql_scene_t *scene,
        const ql_surface_t *surface, const ql_blob_material_t *material,
        bool front, ql_vec3_t incoming);

/* Draw a direction.
 *
 *   bsdf     -     from ql_bsdf_begin()
 *   density  -     UNIFORM, COSINE or BRDF, of what is not specular; SPECULAR
 *                  draws the specular lobe alone, with all its weight. UNIFORM
 *                  needs QL_UNIFORM_DIRECTIONS.
 *   pick     uq32  chooses the lobe; of glass whether it reflects
 *   u        uq32  chooses the direction
 *   sample   -     out, if true is returned
 *   pdf      real  out, unless NULL, if true is returned: density of wi per
 *                  solid angle times the chance of its lobe; 0 of a specular
 *                  lobe. Only BRDF has one, and only QL_MIS asks.
 *   return   false if the light is lost: the direction is below the surface,
 *            the weight is zero, or there is no such lobe
 *
 * Mean of the weight times what comes from there: the reflected radiance.
 *     BRDF     Kd / (1 - P) with pdf (1 - P) cos/pi, or
 *              Ks (n + 2)/(n + 1) cos / P with pdf P (n + 1)/(2 pi) cos^n
 *     COSINE   Kd + Ks (n + 2)/2 cos^n
 *     UNIFORM  (Kd + Ks (n + 2)/2 cos^n) 2 cos
 * Here cos^n is of the angle to the mirror direction, and P is the chance of
 * the lobe that is not diffuse. A mirror's lobe is drawn with its chance
 * whatever the density; COSINE and UNIFORM divide what is left by 1 - P.
 *
 * Exact: a surface that is diffuse only has its albedo as weight, e = 0, unless
 *        the density is UNIFORM; a mirror that is nothing else has Ks.
 * Error: of weights relative, 2^-26; of draft's lobes 2^-14, from the lengths
 *        of unit vectors. For glass see ql_glass_sample().
 */
bool ql_bsdf_sample(const ql_bsdf_t *bsdf, ql_density_t density, ql_uq32_t pick,
        ql_uniform2_t u, ql_bsdf_sample_t *sample, ql_real_t *pdf);

/* Scatter light that comes from a known direction, by all but specular lobes.
 *
 *   bsdf     -      from ql_bsdf_begin()
 *   wi       s2.29  unit direction the light comes from, above surface->n;
 *                   only a Phong lobe looks at it
 *   cosine   real   cos(theta) between wi and the shading normal, above 0
 *   inv_pdf  real   1 / density of wi per solid angle (times the number of
 *                   samples drawn so); not 0
 *   mis      -      whether each lobe is weighed; BALANCE needs QL_MIS
 *   r        -      out: f cos inv_pdf; weighed, each lobe's part is divided
 *                   by 1 + inv_pdf times the lobe's pdf as ql_bsdf_sample() has
 *                   it
 */
void ql_bsdf_eval(const ql_bsdf_t *bsdf, ql_vec3_t wi, ql_real_t cosine,
        ql_real_t inv_pdf, ql_mis_t mis, ql_rgb_t *r);

#endif
