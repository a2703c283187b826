/* ql_diffuse.c - directions proportional to the cosine, or uniform ones */
/* SPDX-License-Identifier: MIT */

#include "material/ql_diffuse.h"

#include "trace/surface/ql_shading.h"
#include "math/vec/ql_frame.h"
#include "math/vec/ql_vec_unit.h"
#include "warp/ql_warp_hemisphere.h"

ql_vec3_t ql_diffuse_direction(const ql_surface_t *surface, ql_uniform2_t u)
{
    const ql_vec3_t n = ql_shading_flat_normal(surface);
    const ql_vec3_t wi =
            ql_vec_to_dir(ql_warp_hemisphere_cosine(n, u.u1, u.u2));

    return ql_shading_is_above(surface, wi) ? wi : ql_vec_to_dir(n);
}

ql_vec3_t ql_diffuse_unit(const ql_surface_t *surface, ql_uniform2_t u)
{
    const ql_vec3_t n = ql_shading_normal(surface);
    const ql_vec3_t w = ql_warp_hemisphere_cosine(n, u.u1, u.u2);
    const ql_real_t square = ql_vec_square(w);

    return square.m == 0 ? w
                         : ql_vec_unit_q29_of_length(w, ql_real_sqrt(square));
}

/* Cosine-distributed. About a smooth normal it may be below the surface. */
static bool draw_cosine(const ql_surface_t *surface, ql_uniform2_t u,
        ql_bsdf_sample_t *sample, ql_real_t *pdf)
{
    const ql_vec3_t n = ql_shading_normal(surface);
    const ql_vec3_t w = ql_warp_hemisphere_cosine(n, u.u1, u.u2);
    bool above;

    sample->wi = ql_vec_to_dir(w);
    above = ql_shading_is_above(surface, sample->wi);
    if (!above) {
        sample->wi = ql_vec_to_dir(n); /* as ql_diffuse_direction() */
    }
    if (ql_bsdf_wants_pdf(pdf)) {
        *pdf = above ? ql_warp_hemisphere_cosine_pdf(ql_vec_dot_call(w, n))
                     : QL_REAL_INV_PI;
    }
    return above || !ql_surface_is_smooth(surface);
}

/* Uniform. cos/pi over its density is 2 cos. */
static bool draw_uniform(const ql_surface_t *surface, ql_uniform2_t u,
        ql_bsdf_sample_t *sample, ql_real_t *ratio)
{
    const ql_vec3_t local = ql_warp_hemisphere_uniform(u.u1, u.u2);
    ql_frame_t frame;

    ql_frame_from_normal(&frame, ql_shading_normal(surface));
    sample->wi = ql_vec_to_dir(ql_frame_to_world(&frame, local));
    *ratio = ql_real_from_uq_call((uint32_t)local.z, 28); /* z >= 0 */
    return ratio->m != 0 && ql_shading_is_above(surface, sample->wi);
}

bool ql_diffuse_draw(const ql_surface_t *surface, ql_density_t density,
        ql_uniform2_t u, ql_bsdf_sample_t *sample, ql_real_t *ratio,
        ql_real_t *pdf)
{
    if (ql_density_is_uniform(density)) {
        return draw_uniform(surface, u, sample, ratio);
    }
    *ratio = QL_REAL_ONE;
    return draw_cosine(surface, u, sample, pdf);
}

bool ql_diffuse_sample(const ql_bsdf_t *bsdf, ql_density_t density,
        ql_uniform2_t u, ql_bsdf_sample_t *sample, ql_real_t *pdf)
{
    ql_real_t ratio;

    if (!ql_rgb_load(&sample->weight, bsdf->material->albedo) ||
            !ql_diffuse_draw(bsdf->surface, density, u, sample, &ratio, pdf)) {
        return false;
    }
    if (ql_density_is_uniform(density)) {
        ql_rgb_scale(&sample->weight, ratio);
    }
    return true;
}
