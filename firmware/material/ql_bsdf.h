/* ql_bsdf.h - how a surface reflects: sample, density, value of a material */
/* SPDX-License-Identifier: MIT */

/* f = Kd/pi + Ks (n + 2)/(2 pi) cos^n(alpha), alpha from the mirror direction
 * (Lafortune and Willems 1994), or with all of Ks exactly there (mirror), or
 * glass. One of the two lobes is drawn with a fixed chance; each is an integral
 * of its own, so weights and densities are those of the lobe drawn, and
 * cos^n is needed only where a direction came from elsewhere. Directions point
 * away from the surface. */

#ifndef QL_BSDF_H
#define QL_BSDF_H

#include "base/ql_density.h"
#include "math/ql_rgb.h"
#include "sample/ql_sampler.h"
#include "scene/ql_ray.h"
#include "scene/ql_scene.h"
#include "scene/ql_surface.h"

/* A surface ready to be asked. */
typedef struct {
    const ql_surface_t *surface;
    const ql_blob_material_t *material;
    const ql_blob_gloss_t *gloss; /* NULL: diffuse only */
#if QL_GLOSS
    ql_vec3_t n;    /* s2.29: unit shading normal; if gloss */
    ql_vec3_t axis; /* s2.29: unit mirror direction, above the surface */
    ql_vec3_t in;   /* s2.29: unit direction of the ray that came */
    bool front;     /* of glass: it came from outside */
#endif
} ql_bsdf_t;

/* A direction to go on in. */
typedef struct {
    ql_vec3_t direction; /* ql_dir_t, not zero */
    ql_rgb_t weight;     /* f cos / (chance of the lobe times its pdf) */
    ql_real_t pdf;       /* per solid angle, times the chance; 0: delta */
    bool delta;          /* mirror or glass */
    bool through;        /* glass: it leads behind the surface */
} ql_bsdf_sample_t;

/* Make a surface ready.
 *
 *   bsdf      -      out; keeps a pointer to surface
 *   scene     -      open
 *   surface   -      from ql_surface_at()
 *   material  -      of what was hit
 *   front     -      ql_hit_t's
 *   incoming  dir_t  direction of the ray that hit it, any length
 *
 * The mirror direction is about the shading normal, or the flat one where the
 * ray comes from below the shading normal. It may lie below the surface: then
 * it is turned up across its plane, so that no rim is black.
 *
 * Error: of the mirror direction 2^-24 rad, of its length that of ql_rsqrt_m().
 * Cost:  nothing for diffuse surfaces; else one reciprocal square root and
 *        about 25 multiplications, most to 64 bits.
 */
void ql_bsdf_begin(ql_bsdf_t *bsdf, const ql_scene_t *scene,
        const ql_surface_t *surface, const ql_blob_material_t *material,
        bool front, ql_vec3_t incoming);

/* Does it have a lobe of one direction only (mirror, glass)? */
QL_INLINE bool ql_bsdf_has_delta(const ql_bsdf_t *bsdf)
{
#if QL_CFG_MIRROR || QL_CFG_GLASS
    return bsdf->gloss != NULL && QL_LE16(bsdf->gloss->kind) != QL_GLOSS_PHONG;
#else
    (void)bsdf;
    return false;
#endif
}

/* Does it have any other lobe? */
QL_INLINE bool ql_bsdf_has_spread(const ql_bsdf_t *bsdf)
{
#if QL_CFG_MIRROR || QL_CFG_GLASS
    return !ql_bsdf_has_delta(bsdf) ||
           (bsdf->material->albedo[0] | bsdf->material->albedo[1] |
                   bsdf->material->albedo[2]) != 0;
#else
    (void)bsdf;
    return true;
#endif
}

/* Is it diffuse and flat? */
QL_INLINE bool ql_bsdf_is_plain(const ql_bsdf_t *bsdf)
{
#if QL_GLOSS
    return bsdf->gloss == NULL && !ql_surface_is_smooth(bsdf->surface);
#else
    return !ql_surface_is_smooth(bsdf->surface);
#endif
}

/* Draw a direction proportional to the cosine: all that a plain surface needs,
 * as the weight is its albedo.
 *
 *   surface  -  flat
 *   u        -  chooses the direction
 *   return   direction, ql_dir_t, above the surface; the normal where it would
 *            be below by rounding, or zero (rarer than 2^-18 in draft, 2^-26 in
 *            fine)
 */
ql_vec3_t ql_bsdf_diffuse(const ql_surface_t *surface, ql_uniform2_t u);

/* Draw a direction.
 *
 *   bsdf     -     from ql_bsdf_begin()
 *   density  -     QL_DENSITY_UNIFORM, _COSINE or _BRDF, of what is not a
 *                  delta lobe; UNIFORM needs QL_CFG_STRATEGIES
 *   delta    -     true: the delta lobe alone, with all its weight
 *   pick     uq32  chooses the lobe, of glass whether it reflects
 *   u        uq32  chooses the direction
 *   sample   -     out, if true is returned; its pdf only if asked for
 *   pdf      -     ask for it; only BRDF has one
 *   return   false if the light is lost: the direction is below the surface,
 *            the weight is zero
 *
 * Mean of the weight times what comes from there: the reflected radiance.
 *     BRDF     Kd / (1 - P) with pdf (1 - P) cos/pi, or
 *              Ks (n + 2)/(n + 1) cos / P with pdf P (n + 1)/(2 pi) cos^n
 *     COSINE   Kd + Ks (n + 2)/2 cos^n
 *     UNIFORM  (Kd + Ks (n + 2)/2 cos^n) 2 cos
 * where cos^n is that of the angle to the mirror direction and P the chance of
 * the specular lobe. A mirror's lobe is drawn with its chance whatever the
 * density; COSINE and UNIFORM divide what is left by 1 - P.
 * Glass: Fresnel's reflectance R is the chance to reflect, weight 1; what is
 * refracted has weight Tf (n1/n2)^2, as radiance does. Rounded onto the
 * surface's plane, a delta lobe's direction is bent off by four ulp.
 *
 * Exact: the weight of a surface that is diffuse only is its albedo, e = 0,
 *        unless drawn UNIFORM; so is Ks of a mirror that is nothing else.
 * Error: weights relative, 2^-26; of draft's lobes 2^-14, from the lengths of
 *        unit vectors. R within 2^-20 (draft 2^-11), but where the cosine's
 *        own error, 5e-8 (6e-5), moves it more, next to total reflection.
 * From:  Lafortune and Willems, "Using the Modified Phong Reflectance Model for
 *        Physically Based Rendering", 1994; the equations of Snell and Fresnel.
 */
bool ql_bsdf_sample(const ql_bsdf_t *bsdf, ql_density_t density, bool delta,
        ql_uq32_t pick, ql_uniform2_t u, ql_bsdf_sample_t *sample, bool pdf);

/* Reflect light that comes from a known direction, all but delta lobes.
 *
 *   bsdf     -      from ql_bsdf_begin()
 *   w        s2.29  unit direction the light comes from, above surface->n;
 *                   asked only by a Phong lobe
 *   cosine   -      cos(theta) between w and the shading normal, above 0
 *   inverse  -      1 / density of w per solid angle (times the number of
 *                   samples drawn so); not 0
 *   mis      -      weigh each lobe by the balance heuristic against
 *                   ql_bsdf_sample() with BRDF
 *   r        -      out: f cos inverse; with mis, each lobe's part divided by
 *                   1 + inverse times the lobe's pdf as ql_bsdf_sample() has it
 */
void ql_bsdf_reflect(const ql_bsdf_t *bsdf, ql_vec3_t w, ql_real_t cosine,
        ql_real_t inverse, bool mis, ql_rgb_t *r);

/* Unit shading normal.
 *
 *   surface  -      as above
 *   return   s2.29  its shade if it is smooth, else n / |n|
 */
ql_vec3_t ql_bsdf_normal(const ql_surface_t *surface);

/* Cosine between a direction and the shading normal.
 *
 *   surface  -      as above
 *   w        -      any integer vector, |w| < 2^30
 *   return   real   n.w of the unit shading normal n, in the units of w; 0 if
 *                   not above 0, or if w is not above surface->n
 *
 * Error: relative, 2^-26 of a flat surface; of a smooth one 2^-28 |w|.
 */
ql_real_t ql_bsdf_cosine(const ql_surface_t *surface, ql_vec3_t w);

#endif
