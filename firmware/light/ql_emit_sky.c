/* ql_emit_sky.c - a constant sky by the cosine, a map by its distribution */
/* SPDX-License-Identifier: MIT */

#include "light/ql_emit_sky.h"

#if QL_CFG_SKY

#include "light/sky/ql_sky_map.h"
#include "material/ql_diffuse.h"

static void constant_radiance(const ql_scene_t *scene, ql_uq32_t emission[3])
{
    for (unsigned i = 0; i < 3; i++) {
        emission[i] = QL_LE32(ql_scene_sky(scene)->emission[i]);
    }
}

void ql_emit_sky_radiance(
        const ql_scene_t *scene, ql_vec3_t d, ql_uq32_t emission[3])
{
    if (ql_scene_texels(scene) != NULL) {
        ql_sky_map_radiance(scene, d, emission, NULL);
    } else {
        constant_radiance(scene, emission);
    }
}

bool ql_emit_sky_sample(const ql_scene_t *scene, const ql_surface_t *surface,
        ql_uniform2_t u, ql_emit_sample_t *sample)
{
    ql_vec3_t wi;

    if (ql_scene_texels(scene) != NULL) {
        sample->inv_pdf =
                ql_sky_map_sample(scene, u.u1, u.u2, &wi, sample->emission);
        return ql_emit_set_wi(sample, surface, wi);
    }
    constant_radiance(scene, sample->emission);
    wi = ql_diffuse_unit(surface, u);
    if (!ql_emit_set_wi(sample, surface, wi)) {
        return false;
    }
    sample->inv_pdf = ql_diffuse_inv_pdf(sample->cosine);
    return true;
}

ql_real_t ql_emit_sky_inv_pdf(
        const ql_scene_t *scene, const ql_surface_t *surface, ql_vec3_t d)
{
    ql_uq32_t emission[3];
    ql_real_t inv_pdf;

    if (ql_scene_texels(scene) == NULL) {
        return ql_diffuse_inv_pdf(ql_shading_cosine_of_dir(surface, d));
    }
    ql_sky_map_radiance(scene, d, emission, &inv_pdf);
    return inv_pdf;
}

#endif
