/* ql_bsdf.c - which lobe: its chance, its density, its weight for MIS */
/* SPDX-License-Identifier: MIT */

#include "material/ql_bsdf.h"

#include "material/ql_diffuse.h"
#include "material/ql_glass.h"
#include "material/ql_mirror.h"
#include "material/ql_phong.h"

/* The chance of the lobe that is not diffuse. */
static ql_uq31_t gloss_chance(const ql_bsdf_t *bsdf)
{
    return ql_bsdf_is_glossy(bsdf) ? QL_LE32(bsdf->gloss->chance) : 0;
}

void ql_bsdf_begin(ql_bsdf_t *bsdf, const ql_scene_t *scene,
        const ql_surface_t *surface, const ql_blob_material_t *material,
        bool front, ql_vec3_t incoming)
{
    bsdf->surface = surface;
    bsdf->material = material;
    bsdf->gloss = ql_scene_gloss(scene, material);
    if (ql_bsdf_is_glossy(bsdf)) {
        ql_mirror_begin(bsdf, front, incoming);
    }
}

/* ---- Draw -------------------------------------------------------------- */

/* Divide what a lobe drew by its chance; exactly if that is 1. */
static void divide_by_chance(
        ql_bsdf_sample_t *sample, ql_uq31_t chance, ql_real_t *pdf)
{
    const ql_real_t p = ql_real_from_uq_call(chance, 31);

    if (chance != QL_UQ31_ONE) {
        ql_rgb_scale(&sample->weight, ql_real_recip_call(p));
    }
    if (ql_bsdf_wants_pdf(pdf)) {
        *pdf = ql_real_mul_call(*pdf, p);
    }
}

/* Both lobes by a direction whose density knows of neither: the weight is
 * f cos / density = f ratio pi. */
static bool sample_both(const ql_bsdf_t *bsdf, ql_density_t density,
        ql_uniform2_t u, ql_bsdf_sample_t *sample)
{
    ql_real_t ratio;

    if (!ql_diffuse_draw(bsdf->surface, density, u, sample, &ratio, NULL)) {
        return false;
    }
    ql_bsdf_eval(bsdf, ql_vec_unit_q29(sample->wi), ratio, QL_REAL_PI,
            QL_MIS_NONE, &sample->weight);
    return ql_rgb_most(&sample->weight) != 0;
}

/* One of two lobes, by its chance. */
static bool sample_one(const ql_bsdf_t *bsdf, ql_density_t density,
        ql_uq32_t pick, ql_uniform2_t u, ql_bsdf_sample_t *sample,
        ql_real_t *pdf)
{
    ql_uq31_t chance = gloss_chance(bsdf);
    bool drawn;

    if (pick >> 1 < chance) { /* exactly with that chance */
        drawn = ql_mirror_is(bsdf) ? ql_mirror_sample(bsdf, sample)
                                   : ql_phong_sample(bsdf, u, sample, pdf);
    } else {
        chance = QL_UQ31_ONE - chance; /* not 0 */
        drawn = ql_diffuse_sample(bsdf, density, u, sample, pdf);
    }
    if (drawn) {
        divide_by_chance(sample, chance, pdf);
    }
    return drawn;
}

static bool sample_gloss(const ql_bsdf_t *bsdf, ql_density_t density,
        ql_uq32_t pick, ql_uniform2_t u, ql_bsdf_sample_t *sample,
        ql_real_t *pdf)
{
    if (ql_glass_is(bsdf)) {
        return ql_glass_sample(bsdf, pick, sample);
    }
    if (density == QL_DENSITY_SPECULAR) {
        return ql_mirror_is(bsdf) && ql_mirror_sample(bsdf, sample);
    }
    if (ql_phong_is(bsdf) && density != QL_DENSITY_BRDF) {
        return sample_both(bsdf, density, u, sample);
    }
    return sample_one(bsdf, density, pick, u, sample, pdf);
}

bool ql_bsdf_sample(const ql_bsdf_t *bsdf, ql_density_t density, ql_uq32_t pick,
        ql_uniform2_t u, ql_bsdf_sample_t *sample, ql_real_t *pdf)
{
    sample->specular = false;
    sample->through = false;
    if (ql_bsdf_wants_pdf(pdf)) {
        *pdf = QL_REAL_ZERO;
    }
    if (ql_bsdf_is_glossy(bsdf)) {
        return sample_gloss(bsdf, density, pick, u, sample, pdf);
    }
    return density != QL_DENSITY_SPECULAR &&
           ql_diffuse_sample(bsdf, density, u, sample, pdf);
}

/* ---- Evaluate ---------------------------------------------------------- */

/* What is left of a lobe that has x times the density of wi, if mis: by the
 * balance heuristic x / (1 + x chance). */
static ql_real_t weigh(ql_real_t x, ql_uq31_t chance, ql_mis_t mis)
{
    if (ql_mis_is_balance(mis)) {
        const ql_real_t other =
                ql_real_mul_call(x, ql_real_from_uq_call(chance, 31));

        x = ql_real_div(x, ql_real_add(QL_REAL_ONE, other));
    }
    return x;
}

/* Add f cos inv_pdf of the Phong lobe. */
static void add_phong(const ql_bsdf_t *bsdf, ql_vec3_t wi, ql_real_t cosine,
        ql_real_t inv_pdf, ql_mis_t mis, ql_rgb_t *r)
{
    ql_real_t x = ql_real_mul_call(ql_phong_pdf(bsdf, wi), inv_pdf);
    ql_rgb_t lobe;

    if (x.m == 0) {
        return;
    }
    x = weigh(x, gloss_chance(bsdf), mis);
    if (ql_phong_weight(bsdf, ql_real_mul_call(x, cosine), &lobe)) {
        ql_rgb_add(r, &lobe);
    }
}

void ql_bsdf_eval(const ql_bsdf_t *bsdf, ql_vec3_t wi, ql_real_t cosine,
        ql_real_t inv_pdf, ql_mis_t mis, ql_rgb_t *r)
{
    /* f cos of a lobe is its density times what its directions weigh */
    const ql_real_t x = ql_real_mul_call(ql_diffuse_pdf(cosine), inv_pdf);

    (void)ql_rgb_load(r, bsdf->material->albedo);
    ql_rgb_scale(r, weigh(x, QL_UQ31_ONE - gloss_chance(bsdf), mis));
    if (ql_phong_is(bsdf)) {
        add_phong(bsdf, wi, cosine, inv_pdf, mis, r);
    }
}
