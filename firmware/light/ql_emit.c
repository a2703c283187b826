/* ql_emit.c - which kind of emitter: a triangle, a sphere or the sky */
/* SPDX-License-Identifier: MIT */

#include "light/ql_emit.h"

#include "light/ql_emit_sky.h"
#include "light/ql_emit_sphere.h"
#include "light/ql_emit_triangle.h"
#include "light/ql_light.h"

bool ql_emit_sample(const ql_scene_t *scene, ql_direct_t direct, uint16_t light,
        const ql_surface_t *surface, ql_uniform2_t u, ql_emit_sample_t *sample)
{
    const ql_blob_tri_t *tri;
    const ql_blob_sphere_t *sphere;

    if (ql_light_is_sky(scene, light)) {
        return ql_emit_sky_sample(scene, surface, u, sample);
    }
    tri = ql_light_triangle(scene, light);
    for (unsigned i = 0; i < 3; i++) {
        sample->emission[i] =
                QL_LE32(ql_scene_material(scene, tri)->emission[i]);
    }
    sphere = ql_scene_sphere(scene, tri);
    if (sphere != NULL) {
        return ql_emit_sphere_sample(scene, direct, sphere, surface, u, sample);
    }
    return ql_emit_triangle_sample(scene, direct, light, surface, u, sample);
}

#if QL_MIS
ql_real_t ql_emit_inv_pdf(const ql_scene_t *scene, const ql_surface_t *surface,
        const ql_ray_t *ray, const ql_blob_tri_t *tri, ql_uq30_t t)
{
    const ql_blob_sphere_t *sphere;

    if (tri == NULL) {
        return ql_emit_sky_inv_pdf(scene, surface, ray->direction);
    }
    sphere = ql_scene_sphere(scene, tri);
    if (sphere != NULL) {
        return ql_emit_sphere_inv_pdf(sphere, surface, ray);
    }
    return ql_emit_triangle_inv_pdf(scene, ray, tri, t);
}
#endif
