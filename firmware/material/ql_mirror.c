/* ql_mirror.c - mirror directions, kept on their side of the surface */
/* SPDX-License-Identifier: MIT */

#include "material/ql_mirror.h"

#if QL_GLOSS

#include "trace/surface/ql_shading.h"

/* x - (twice y 2^-29), to nearest: below 3 2^29 for unit vectors */
static QL_NOINLINE int32_t reflect_part(int32_t x, int32_t twice, int32_t y)
{
    const int64_t product = (int64_t)twice * y;

    return x - (int32_t)ql_asr64(product + ((int32_t)1 << 28), 29);
}

/* v - 2 (v.n) n of unit vectors, n at most 2^-21 too long. */
static QL_NOINLINE ql_vec3_t reflect(ql_vec3_t v, ql_vec3_t n)
{
    /* 2 (v.n) in s2.29, to nearest: the sum is below 2^59 */
    const int32_t twice =
            (int32_t)ql_asr64(ql_vec_dot_call(v, n) + ((int32_t)1 << 27), 28);

    v.x = reflect_part(v.x, twice, n.x);
    v.y = reflect_part(v.y, twice, n.y);
    v.z = reflect_part(v.z, twice, n.z);
    return v;
}

ql_vec3_t ql_mirror_normal(const ql_bsdf_t *bsdf)
{
    return ql_surface_is_smooth(bsdf->surface) &&
                           ql_vec_dot_call(bsdf->minus_wo, bsdf->n) >= 0
                   ? ql_shading_flat_normal(bsdf->surface)
                   : bsdf->n;
}

ql_vec3_t ql_mirror_turn(
        const ql_surface_t *surface, ql_vec3_t w, ql_side_t side)
{
    const int64_t height = ql_vec_dot_call(w, surface->n); /* below 2^62 */

    return (side == QL_SIDE_BELOW ? height < 0 : height > 0)
                   ? w
                   : reflect(w, ql_shading_flat_normal(surface));
}

void ql_mirror_begin(ql_bsdf_t *bsdf, bool front, ql_vec3_t incoming)
{
    bsdf->front = front;
    bsdf->n = ql_shading_normal(bsdf->surface);
    bsdf->minus_wo = ql_vec_unit_q29(incoming);
    bsdf->mirror = ql_mirror_turn(bsdf->surface,
            reflect(bsdf->minus_wo, ql_mirror_normal(bsdf)), QL_SIDE_ABOVE);
}

bool ql_mirror_leave(const ql_surface_t *surface, ql_vec3_t w, ql_side_t side,
        ql_bsdf_sample_t *sample)
{
    const ql_vec3_t n = {
            surface->n.x * side, surface->n.y * side, surface->n.z * side};

    sample->specular = true;
    sample->through = side == QL_SIDE_BELOW;
    sample->wi = ql_vec_to_dir(w);
    if (ql_vec_dot_call(sample->wi, n) <= 0) {
        const ql_vec3_t off = ql_vec_unit_q29_of_inv_n(n, surface->inv_n);

        w.x += ql_asr32(off.x, QL_DIR_BITS - 2);
        w.y += ql_asr32(off.y, QL_DIR_BITS - 2);
        w.z += ql_asr32(off.z, QL_DIR_BITS - 2);
        sample->wi = ql_vec_to_dir(w);
    }
    return ql_vec_dot_call(sample->wi, n) > 0;
}

#if QL_CFG_MIRROR
bool ql_mirror_sample(const ql_bsdf_t *bsdf, ql_bsdf_sample_t *sample)
{
    return ql_rgb_load(&sample->weight, bsdf->gloss->specular) &&
           ql_mirror_leave(bsdf->surface, bsdf->mirror, QL_SIDE_ABOVE, sample);
}
#endif

#endif
