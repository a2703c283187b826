/* ref_bsdf.c - diffuse, Phong, mirror and glass: sample, density, value */
/* SPDX-License-Identifier: MIT */

#include <string.h>

#include "ref/ref_parts.h"

static double chance_of(const ref_material_t *material)
{
    return ldexp((double)material->chance, -31);
}

static bool is_black(const double rgb[3])
{
    return rgb[0] <= 0 && rgb[1] <= 0 && rgb[2] <= 0;
}

static void set_weight(ref_bsdf_sample_t *sample, const double by[3], double x)
{
    for (unsigned k = 0; k < 3; k++) {
        sample->weight[k] = by[k] * x;
    }
}

bool ref_bsdf_has_delta(const ref_bsdf_t *bsdf)
{
    return bsdf->material->kind == QL_GLOSS_MIRROR ||
           bsdf->material->kind == QL_GLOSS_GLASS;
}

bool ref_bsdf_has_spread(const ref_bsdf_t *bsdf)
{
    return !ref_bsdf_has_delta(bsdf) || !is_black(bsdf->material->albedo);
}

double ref_cosine(const ref_surface_t *surface, ref_vec_t w)
{
    const double cosine = ref_dot(w, surface->shade);

    return cosine > 0 && ref_dot(w, surface->n) > 0 ? cosine : 0;
}

/* ---- Where mirrors and glass lead --------------------------------------- */

/* v, turned across the surface's plane if it is not on the side wanted. */
static ref_vec_t turned(
        const ref_surface_t *surface, ref_vec_t v, ref_side_t wanted)
{
    const double side = ref_dot(v, surface->n);

    return (wanted == REF_BELOW ? side < 0 : side > 0)
                   ? v
                   : ref_mirrored(v, surface->n);
}

/* The normal that reflects and refracts. */
static ref_vec_t facing(const ref_bsdf_t *bsdf)
{
    const ref_surface_t *s = bsdf->surface;

    return s->smooth && ref_dot(bsdf->in, s->shade) >= 0 ? s->n : s->shade;
}

void ref_bsdf_begin(ref_bsdf_t *bsdf, const struct ref_rounding *rounding,
        const ref_surface_t *surface, const ref_material_t *material,
        bool front, ref_vec_t incoming)
{
    bsdf->rounding = rounding;
    bsdf->surface = surface;
    bsdf->material = material;
    bsdf->front = front;
    bsdf->in = incoming;
    bsdf->axis =
            turned(surface, ref_mirrored(incoming, facing(bsdf)), REF_ABOVE);
}

static bool sample_glass(
        const ref_bsdf_t *bsdf, uint32_t pick, ref_bsdf_sample_t *sample)
{
    static const double white[3] = {1, 1, 1};
    const ref_vec_t n = facing(bsdf);
    const double index = bsdf->front ? bsdf->material->parameter
                                     : 1 / bsdf->material->parameter;
    const double c = fmax(0, -ref_dot(bsdf->in, n));
    const double g2 = index * index - (1 - c * c);
    double reflectance = 1, g = 0;

    sample->delta = true;
    if (g2 > 0) {
        double s, p;

        g = sqrt(g2);
        s = (c - g) / (c + g);
        p = (g - index * index * c) / (g + index * index * c);
        reflectance = (s * s + p * p) / 2;
    }
    if (ref_midpoint(pick) < reflectance) {
        set_weight(sample, white, 1);
        sample->direction = bsdf->axis;
        return true;
    }
    sample->side = REF_BELOW;
    set_weight(sample, bsdf->material->specular, 1 / (index * index));
    sample->direction = turned(
            bsdf->surface, ref_unit(ref_along(bsdf->in, n, c - g)), REF_BELOW);
    return true;
}

/* ---- Lobes -------------------------------------------------------------- */

/* (n + 1)/(2 pi) cos^n of the angle to the mirror direction. */
static double lobe_density(const ref_bsdf_t *bsdf, ref_vec_t w)
{
    const double n = bsdf->material->parameter;
    const double cosine = ref_dot(w, bsdf->axis);

    return cosine > 0 ? (n + 1) / (2 * REF_PI) * pow(cosine, n) : 0;
}

static double lobe_ratio(const ref_bsdf_t *bsdf)
{
    return (bsdf->material->parameter + 2) / (bsdf->material->parameter + 1);
}

static bool sample_lobe(
        const ref_bsdf_t *bsdf, ql_uniform2_t u, ref_bsdf_sample_t *sample)
{
    const double chance = chance_of(bsdf->material);
    const double n = bsdf->material->parameter;
    const double z = pow(ref_midpoint(u.u1), 1 / (n + 1));
    double cosine;

    sample->direction =
            ref_warp_about(NULL, bsdf->axis, 1 - z, ref_midpoint(u.u2));
    cosine = ref_cosine(bsdf->surface, sample->direction);
    set_weight(sample, bsdf->material->specular,
            cosine * lobe_ratio(bsdf) / chance);
    sample->pdf = chance * (n + 1) / (2 * REF_PI) * pow(z, n);
    return cosine > 0;
}

/* As ref_warp_cosine(), step by step. */
static ref_vec_t rounded_cosine(const ref_rounding_t *rounding,
        const ref_surface_t *surface, double u1, double u2)
{
    ref_vec_t n = surface->shade, v = ref_warp_sphere(u1, u2);

    if (rounding->normal != NULL) {
        rounding->normal(rounding->data, surface, &n);
    }
    if (rounding->sphere != NULL) {
        rounding->sphere(rounding->data, u1, u2, &v);
    }
    v = ref_add(n, v);
    if (rounding->direction != NULL) {
        rounding->direction(rounding->data, surface, n, &v);
    }
    return ref_unit(v);
}

/* A direction whose density knows of no lobe but the diffuse one; *factor is
 * cos/pi over the density. */
static bool draw_direction(const ref_bsdf_t *bsdf, ql_density_t density,
        ql_uniform2_t u, ref_bsdf_sample_t *sample, double *factor)
{
    const ref_surface_t *surface = bsdf->surface;
    const double u1 = ref_midpoint(u.u1), u2 = ref_midpoint(u.u2);

    if (density == QL_DENSITY_UNIFORM) {
        sample->direction =
                ref_warp_about(bsdf->rounding, surface->shade, 1 - u1, u2);
        *factor = 2 * u1;
    } else {
        sample->direction =
                bsdf->rounding != NULL
                        ? rounded_cosine(bsdf->rounding, surface, u1, u2)
                        : ref_warp_cosine(surface->shade, u1, u2);
        sample->pdf = ref_dot(sample->direction, surface->shade) / REF_PI;
        *factor = 1;
    }
    return ref_dot(sample->direction, surface->n) > 0;
}

static bool sample_diffuse(const ref_bsdf_t *bsdf, ql_density_t density,
        ql_uniform2_t u, ref_bsdf_sample_t *sample)
{
    double factor;

    if (is_black(bsdf->material->albedo) ||
            !draw_direction(bsdf, density, u, sample, &factor)) {
        return false;
    }
    set_weight(sample, bsdf->material->albedo, factor);
    return true;
}

/* Both lobes by such a direction. */
static bool sample_both(const ref_bsdf_t *bsdf, ql_density_t density,
        ql_uniform2_t u, ref_bsdf_sample_t *sample)
{
    double factor, lobe;

    if (!draw_direction(bsdf, density, u, sample, &factor)) {
        return false;
    }
    lobe = lobe_density(bsdf, sample->direction) * REF_PI * lobe_ratio(bsdf);
    for (unsigned k = 0; k < 3; k++) {
        sample->weight[k] =
                factor * (bsdf->material->albedo[k] +
                                 bsdf->material->specular[k] * lobe);
    }
    return true;
}

bool ref_bsdf_sample(const ref_bsdf_t *bsdf, ql_density_t density,
        ref_lobes_t lobes, uint32_t pick, ql_uniform2_t u,
        ref_bsdf_sample_t *sample)
{
    const ref_material_t *m = bsdf->material;
    const bool delta = lobes == REF_LOBES_DELTA;
    const bool special = pick >> 1 < m->chance;

    memset(sample, 0, sizeof *sample);
    if (m->kind == 0) {
        return !delta && sample_diffuse(bsdf, density, u, sample);
    }
    if (m->kind == QL_GLOSS_GLASS) {
        return sample_glass(bsdf, pick, sample);
    }
    if (m->kind == QL_GLOSS_MIRROR && (delta || special)) {
        sample->delta = true;
        sample->direction = bsdf->axis;
        set_weight(sample, m->specular, delta ? 1 : 1 / chance_of(m));
        return true;
    }
    if (delta) {
        return false;
    }
    if (m->kind == QL_GLOSS_PHONG && density != QL_DENSITY_BRDF) {
        return sample_both(bsdf, density, u, sample);
    }
    if (m->kind == QL_GLOSS_PHONG && special) {
        return sample_lobe(bsdf, u, sample);
    }
    if (special || !sample_diffuse(bsdf, density, u, sample)) {
        return false;
    }
    set_weight(sample, sample->weight, 1 / (1 - chance_of(m)));
    sample->pdf *= 1 - chance_of(m);
    return true;
}

/* part, less what the other estimator has of this lobe. */
static double balanced(double part, double chance, bool mis)
{
    return mis ? part / (1 + part * chance) : part;
}

void ref_bsdf_reflect(const ref_bsdf_t *bsdf, ref_vec_t w, double inverse,
        bool mis, double *diffuse, double *lobe)
{
    const ref_material_t *m = bsdf->material;
    const double cosine = ref_cosine(bsdf->surface, w);
    const double chance = m->kind != 0 ? chance_of(m) : 0;

    *diffuse = balanced(cosine / REF_PI * inverse, 1 - chance, mis);
    *lobe = 0;
    if (m->kind == QL_GLOSS_PHONG) {
        *lobe = balanced(lobe_density(bsdf, w) * inverse, chance, mis) *
                cosine * lobe_ratio(bsdf);
    }
}
