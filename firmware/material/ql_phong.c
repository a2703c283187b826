/* ql_phong.c - the Phong lobe: draw from it, its density, its weight */
/* SPDX-License-Identifier: MIT */

#include "material/ql_phong.h"

#if QL_CFG_PHONG

#include "trace/surface/ql_shading.h"
#include "math/vec/ql_frame.h"
#include "math/vec/ql_vec_unit.h"
#include "warp/ql_warp_lobe.h"

/* Weigh a factor, given 1 / (n + 1). */
static bool set_weight(const ql_bsdf_t *bsdf, ql_real_t inverse,
        ql_real_t factor, ql_rgb_t *weight)
{
    const uint64_t power = QL_LE32(bsdf->gloss->parameter);
    /* (n + 2) / (n + 1) */
    const ql_real_t ratio = ql_real_mul_call(
            ql_real_from_uq_call(power + ((uint32_t)2 << 16), 16), inverse);

    if (!ql_rgb_load(weight, bsdf->gloss->specular)) {
        return false;
    }
    ql_rgb_scale(weight, ql_real_mul_call(factor, ratio));
    return true;
}

bool ql_phong_weight(const ql_bsdf_t *bsdf, ql_real_t factor, ql_rgb_t *weight)
{
    return set_weight(bsdf,
            ql_warp_lobe_inverse(QL_LE32(bsdf->gloss->parameter)), factor,
            weight);
}

ql_real_t ql_phong_pdf(const ql_bsdf_t *bsdf, ql_vec3_t wi)
{
    /* 2 (1 - cos) 2^58: of unit vectors, below 2^61 */
    const ql_vec3_t apart = ql_vec_sub(wi, bsdf->mirror);
    const uint64_t square = (uint64_t)ql_vec_dot_call(apart, apart);

    if (square >> 59 != 0) {
        return QL_REAL_ZERO;
    }
    return ql_warp_lobe_pdf(QL_LE32(bsdf->gloss->parameter),
            (uint32_t)((square + ((uint32_t)1 << 27)) >> 28));
}

bool ql_phong_sample(const ql_bsdf_t *bsdf, ql_uniform2_t u,
        ql_bsdf_sample_t *sample, ql_real_t *pdf)
{
    const ql_uq16_t power = QL_LE32(bsdf->gloss->parameter);
    const ql_real_t inverse = ql_warp_lobe_inverse(power);
    ql_real_t cosine;
    ql_frame_t frame;
    ql_vec3_t w;
    ql_uq31_t s;
    int64_t above;

    ql_frame_from_normal(&frame, bsdf->mirror);
    w = ql_frame_to_world(&frame, ql_warp_lobe(inverse, u.u1, u.u2, &s));
    sample->wi = ql_vec_to_dir(w);
    above = ql_vec_dot_call(w, bsdf->n); /* 2^-58 */
    if (above <= 0 || !ql_shading_is_above(bsdf->surface, sample->wi)) {
        return false;
    }
    if (ql_bsdf_wants_pdf(pdf)) {
        /* rounded, s may be 1, where the density ends */
        s = s < QL_UQ31_ONE ? s : QL_UQ31_ONE - 1;
        *pdf = ql_warp_lobe_pdf(power, s);
    }
    cosine = ql_real_from_uq_call((uint64_t)above, 58);
    cosine = ql_real_less(cosine, QL_REAL_ONE) ? cosine : QL_REAL_ONE;
    return set_weight(bsdf, inverse, cosine, &sample->weight);
}

#endif
