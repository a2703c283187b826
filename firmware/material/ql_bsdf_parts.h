/* ql_bsdf_parts.h - a surface ready to be asked, and what its lobes draw */
/* SPDX-License-Identifier: MIT */

/* The lobes, each in a file of its own, and ql_bsdf.h, which asks them, share
 * this. */

#ifndef QL_BSDF_PARTS_H
#define QL_BSDF_PARTS_H

#include "base/ql_density.h"
#include "math/vec/ql_rgb.h"
#include "math/vec/ql_vec_unit.h"
#include "sample/ql_sampler.h"
#include "scene/ql_ray.h"
#include "scene/ql_scene.h"
#include "scene/ql_surface.h"

/* A surface ready to be asked. */
typedef struct {
    const ql_surface_t *surface;
    const ql_blob_material_t *material;
    const ql_blob_gloss_t *gloss; /* NULL: diffuse only */
    /* set only if gloss is; vectors are unit vectors in s2.29 */
    QL_IF_BUILT(QL_GLOSS, ql_vec3_t n;)        /* the shading normal */
    QL_IF_BUILT(QL_GLOSS, ql_vec3_t mirror;)   /* mirror direction, above */
    QL_IF_BUILT(QL_GLOSS, ql_vec3_t minus_wo;) /* of the ray that came */
    QL_IF_BUILT(QL_GLOSS, bool front;)         /* it came from outside */
} ql_bsdf_t;

/* A direction to go on in. */
typedef struct {
    ql_vec3_t wi;    /* ql_dir_t, not zero */
    ql_rgb_t weight; /* f cos / (chance of the lobe times its pdf) */
    bool specular;   /* of a mirror's or glass's lobe */
    bool through;    /* of glass: it leads behind the surface */
} ql_bsdf_sample_t;

/* Does the balance heuristic weigh what is evaluated? */
typedef enum {
    QL_MIS_NONE,   /* no: nothing else samples it */
    QL_MIS_BALANCE /* yes, against ql_bsdf_sample() with BRDF */
} ql_mis_t;

/* Is light to be weighed? */
QL_INLINE bool ql_mis_is_balance(ql_mis_t mis)
{
    return QL_MIS && mis == QL_MIS_BALANCE;
}

/* Is a density asked for? Only to weigh by it. */
QL_INLINE bool ql_bsdf_wants_pdf(const ql_real_t *pdf)
{
    return QL_MIS && pdf != NULL;
}

#if QL_GLOSS
/* Does a surface have a lobe that is not diffuse? */
QL_INLINE bool ql_bsdf_is_glossy(const ql_bsdf_t *bsdf)
{
    return bsdf->gloss != NULL;
}

/* The lobe that is not diffuse: ql_gloss_kind_t; 0 for none. */
QL_INLINE unsigned ql_bsdf_kind(const ql_bsdf_t *bsdf)
{
    return bsdf->gloss != NULL ? QL_LE16(bsdf->gloss->kind) : 0u;
}
#else
QL_INLINE bool ql_bsdf_is_glossy(const ql_bsdf_t *bsdf)
{
    (void)bsdf;
    return false;
}

QL_INLINE unsigned ql_bsdf_kind(const ql_bsdf_t *bsdf)
{
    (void)bsdf;
    return 0;
}
#endif

#if QL_SPECULAR
/* Does a surface have a specular lobe (mirror, glass)? */
QL_INLINE bool ql_bsdf_has_specular(const ql_bsdf_t *bsdf)
{
    return ql_bsdf_is_glossy(bsdf) && ql_bsdf_kind(bsdf) != QL_GLOSS_PHONG;
}

/* Does a surface have any other lobe? */
QL_INLINE bool ql_bsdf_has_nonspecular(const ql_bsdf_t *bsdf)
{
    return !ql_bsdf_has_specular(bsdf) ||
           (bsdf->material->albedo[0] | bsdf->material->albedo[1] |
                   bsdf->material->albedo[2]) != 0;
}
#else
QL_INLINE bool ql_bsdf_has_specular(const ql_bsdf_t *bsdf)
{
    (void)bsdf;
    return false;
}

QL_INLINE bool ql_bsdf_has_nonspecular(const ql_bsdf_t *bsdf)
{
    (void)bsdf;
    return true;
}
#endif

/* Is a surface diffuse and flat, so that ql_diffuse_direction() is enough? */
QL_INLINE bool ql_bsdf_is_flat_diffuse(const ql_bsdf_t *bsdf)
{
    return !ql_bsdf_is_glossy(bsdf) && !ql_surface_is_smooth(bsdf->surface);
}

#endif
