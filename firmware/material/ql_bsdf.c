/* ql_bsdf.c - diffuse, Phong, mirror and glass: sample, density, value */
/* SPDX-License-Identifier: MIT */

#include "material/ql_bsdf.h"

#include "math/ql_frame.h"
#include "math/ql_vec_unit.h"
#include "warp/ql_lobe.h"
#include "warp/ql_warp.h"

/* ---- Real numbers ------------------------------------------------------ */

/* c 2^-31 */
static ql_real_t real_from_uq31(ql_uq31_t c)
{
    return ql_real_from_uq_call(c, 31);
}

/* x / (1 + x chance): what the balance heuristic leaves of a lobe, if x is the
 * lobe's density over that of the direction. */
static ql_real_t balanced(ql_real_t x, ql_uq31_t chance)
{
    const ql_real_t other = ql_real_mul_call(x, real_from_uq31(chance));

    return ql_real_mul_call(
            x, ql_real_recip_call(ql_real_add(QL_REAL_ONE, other)));
}

/* ---- The surface ------------------------------------------------------- */

static ql_vec3_t flat_normal(const ql_surface_t *surface)
{
    return ql_vec_unit_q29_of_inv_n(surface->n, surface->inv_n);
}

ql_vec3_t ql_bsdf_normal(const ql_surface_t *surface)
{
#if QL_CFG_SMOOTH
    if (surface->smooth) {
        return surface->shade;
    }
#endif
    return flat_normal(surface);
}

ql_real_t ql_bsdf_cosine(const ql_surface_t *surface, ql_vec3_t w)
{
    /* three products of less than 2^30 2^31 */
    const int64_t above = ql_vec_dot_call(w, surface->n);

    if (above <= 0) {
        return QL_REAL_ZERO;
    }
#if QL_CFG_SMOOTH
    if (surface->smooth) {
        const int64_t cosine = ql_vec_dot_call(w, surface->shade);

        return cosine > 0 ? ql_real_from_uq_call((uint64_t)cosine, 29)
                          : QL_REAL_ZERO;
    }
#endif
    return ql_real_mul_call(ql_real_from_u64((uint64_t)above),
            ql_vec_unit_unpack_inv_n(surface->inv_n));
}

/* Is a rounded direction strictly above the surface? */
QL_INLINE bool is_above(const ql_surface_t *surface, ql_vec3_t direction)
{
    return ql_vec_dot_normal(direction, surface->n) > 0;
}

/* ---- The diffuse lobe -------------------------------------------------- */

static bool set_weight(ql_rgb_t *weight, const uint32_t by[3])
{
    for (unsigned i = 0; i < 3; i++) {
        weight->c[i] = QL_LE32(by[i]);
    }
    weight->e = 0;
    return (weight->c[0] | weight->c[1] | weight->c[2]) != 0;
}

/* cos/pi of a direction n + a point of the unit sphere: 2 cos^2 = its dot
 * product with n, which rounding may leave at 0 or less; a density never is. */
static ql_real_t cosine_pdf(int64_t product)
{
    const uint64_t twice = product > 0 ? (uint64_t)product : 1u; /* 2^-58 */

    return ql_real_mul_call(
            ql_real_sqrt(ql_real_from_uq_call(twice, 59)), QL_REAL_INV_PI);
}

ql_vec3_t ql_bsdf_diffuse(const ql_surface_t *surface, ql_uniform2_t u)
{
    const ql_vec3_t n = flat_normal(surface);
    const ql_vec3_t d = ql_vec_to_dir(ql_warp_cosine_hemisphere(n, u.u1, u.u2));

    return is_above(surface, d) ? d : ql_vec_to_dir(n);
}

/* Cosine-distributed. About a smooth normal it may be below the surface. */
static bool cosine_direction(const ql_surface_t *surface, ql_uniform2_t u,
        ql_bsdf_sample_t *sample, bool pdf)
{
    const ql_vec3_t n = ql_bsdf_normal(surface);
    const ql_vec3_t v = ql_warp_cosine_hemisphere(n, u.u1, u.u2);
    bool above;

    sample->direction = ql_vec_to_dir(v);
    above = is_above(surface, sample->direction);
    if (!above) {
        sample->direction = ql_vec_to_dir(n); /* as ql_bsdf_diffuse() */
    }
    if (QL_CFG_STRATEGIES && pdf) {
        sample->pdf =
                above ? cosine_pdf(ql_vec_dot_call(v, n)) : QL_REAL_INV_PI;
    }
    return above || !ql_surface_is_smooth(surface);
}

#if QL_CFG_STRATEGIES
/* Uniform. *factor is cos/pi over its density, 2 cos. */
static bool uniform_direction(const ql_surface_t *surface, ql_uniform2_t u,
        ql_bsdf_sample_t *sample, ql_real_t *factor)
{
    const ql_vec3_t local = ql_warp_uniform_hemisphere(u.u1, u.u2);
    ql_frame_t frame;

    ql_frame_from_normal(&frame, ql_bsdf_normal(surface));
    sample->direction = ql_vec_to_dir(ql_frame_to_world(&frame, local));
    *factor = ql_real_from_uq_call((uint32_t)local.z, 28); /* z >= 0 */
    return factor->m != 0 && is_above(surface, sample->direction);
}
#endif

/* Draw a direction by a density that knows of no lobe but the diffuse one.
 * *factor is cos/pi over the density. */
static bool draw_direction(const ql_surface_t *surface, ql_density_t density,
        ql_uniform2_t u, ql_bsdf_sample_t *sample, ql_real_t *factor, bool pdf)
{
#if QL_CFG_STRATEGIES
    if (density == QL_DENSITY_UNIFORM) {
        return uniform_direction(surface, u, sample, factor);
    }
#else
    (void)density;
#endif
    *factor = QL_REAL_ONE;
    return cosine_direction(surface, u, sample, pdf);
}

/* The diffuse lobe alone. */
static bool sample_diffuse(const ql_bsdf_t *bsdf, ql_density_t density,
        ql_uniform2_t u, ql_bsdf_sample_t *sample, bool pdf)
{
    ql_real_t factor;

    if (!set_weight(&sample->weight, bsdf->material->albedo) ||
            !draw_direction(bsdf->surface, density, u, sample, &factor, pdf)) {
        return false;
    }
    if (QL_CFG_STRATEGIES && density == QL_DENSITY_UNIFORM) {
        ql_rgb_scale(&sample->weight, factor);
    }
    return true;
}

/* ---- Directions of the other lobes ------------------------------------- */

#if QL_GLOSS

/* Divide by the chance of what was drawn: by 1 exactly. */
static void divide(ql_rgb_t *weight, ql_uq31_t chance)
{
    if (chance != QL_UQ31_ONE) {
        ql_rgb_scale(weight, ql_real_recip_call(real_from_uq31(chance)));
    }
}

/* x - (twice y 2^-29), to nearest: below 3 2^29 for unit vectors */
static QL_NOINLINE int32_t mirrored_part(int32_t x, int32_t twice, int32_t y)
{
    const int64_t product = (int64_t)twice * y;

    return x - (int32_t)ql_asr64(product + (1L << 28), 29);
}

/* v - 2 (v.n) n of unit vectors, n at most 2^-21 too long. */
static QL_NOINLINE ql_vec3_t mirrored(ql_vec3_t v, ql_vec3_t n)
{
    /* 2 (v.n) in s2.29, to nearest: the sum is below 2^59 */
    const int32_t twice =
            (int32_t)ql_asr64(ql_vec_dot_call(v, n) + (1L << 27), 28);

    v.x = mirrored_part(v.x, twice, n.x);
    v.y = mirrored_part(v.y, twice, n.y);
    v.z = mirrored_part(v.z, twice, n.z);
    return v;
}

/* v, turned across the surface's plane if it is not on the side wanted. */
static ql_vec3_t turned(const ql_surface_t *surface, ql_vec3_t v, bool below)
{
    const int64_t side = ql_vec_dot_call(v, surface->n); /* below 2^62 */

    return (below ? side < 0 : side > 0) ? v
                                         : mirrored(v, flat_normal(surface));
}

#if QL_CFG_MIRROR || QL_CFG_GLASS
/* Set the way of a lobe of one direction: v, which was turned.
 * Rounded onto the plane it is bent off by four ulp, more than rounding moves
 * it. */
static bool set_delta(const ql_surface_t *surface, ql_vec3_t v, bool through,
        ql_bsdf_sample_t *sample)
{
    const int32_t side = through ? -1 : 1;
    const ql_vec3_t n = {
            surface->n.x * side, surface->n.y * side, surface->n.z * side};

    sample->delta = true;
    sample->through = through;
    sample->pdf = QL_REAL_ZERO;
    sample->direction = ql_vec_to_dir(v);
    if (ql_vec_dot_call(sample->direction, n) <= 0) {
        const ql_vec3_t off = ql_vec_unit_q29_of_inv_n(n, surface->inv_n);

        v.x += ql_asr32(off.x, QL_DIR_BITS - 2);
        v.y += ql_asr32(off.y, QL_DIR_BITS - 2);
        v.z += ql_asr32(off.z, QL_DIR_BITS - 2);
        sample->direction = ql_vec_to_dir(v);
    }
    return ql_vec_dot_call(sample->direction, n) > 0;
}
#endif

/* The normal that reflects and refracts: the shading normal, unless the viewer
 * is below it. */
static ql_vec3_t facing(const ql_bsdf_t *bsdf)
{
    return ql_surface_is_smooth(bsdf->surface) &&
                           ql_vec_dot_call(bsdf->in, bsdf->n) >= 0
                   ? flat_normal(bsdf->surface)
                   : bsdf->n;
}

/* ---- Phong ------------------------------------------------------------- */

#if QL_CFG_PHONG
/* (n + 2) / (n + 1), from n and 1 / (n + 1) */
static ql_real_t lobe_ratio(ql_uq16_t power, ql_real_t inverse)
{
    return ql_real_mul_call(
            ql_real_from_uq_call((uint64_t)power + 131072u, 16), inverse);
}

/* (n + 1)/(2 pi) cos^n of the angle between w and the mirror direction. */
static ql_real_t lobe_density(const ql_bsdf_t *bsdf, ql_vec3_t w)
{
    /* 2 (1 - cos) 2^58: of unit vectors, below 2^61 */
    const ql_vec3_t apart = ql_vec_sub(w, bsdf->axis);
    const uint64_t square = (uint64_t)ql_vec_dot_call(apart, apart);

    if (square >> 59 != 0) {
        return QL_REAL_ZERO;
    }
    return ql_warp_power_lobe_pdf(QL_LE32(bsdf->gloss->parameter),
            (uint32_t)((square + (1ul << 27)) >> 28));
}

/* Add f cos inverse of the lobe. */
static void add_lobe(const ql_bsdf_t *bsdf, ql_vec3_t w, ql_real_t cosine,
        ql_real_t inverse, bool mis, ql_rgb_t *r)
{
    const ql_uq16_t power = QL_LE32(bsdf->gloss->parameter);
    ql_real_t part = ql_real_mul_call(lobe_density(bsdf, w), inverse);
    ql_rgb_t lobe;

    if (part.m == 0 || !set_weight(&lobe, bsdf->gloss->specular)) {
        return;
    }
    if (QL_CFG_STRATEGIES && mis) {
        part = balanced(part, QL_LE32(bsdf->gloss->chance));
    }
    part = ql_real_mul_call(part, cosine);
    ql_rgb_scale(&lobe,
            ql_real_mul_call(part, lobe_ratio(power, ql_lobe_inverse(power))));
    ql_rgb_add(r, &lobe);
}

/* The specular lobe, drawn with a chance. */
static bool sample_lobe(const ql_bsdf_t *bsdf, ql_uniform2_t u,
        ql_bsdf_sample_t *sample, bool pdf)
{
    const ql_uq16_t power = QL_LE32(bsdf->gloss->parameter);
    const ql_uq31_t chance = QL_LE32(bsdf->gloss->chance);
    const ql_real_t inverse = ql_lobe_inverse(power);
    ql_real_t cosine;
    ql_frame_t frame;
    ql_vec3_t w;
    ql_uq31_t s;
    int64_t above;

    ql_frame_from_normal(&frame, bsdf->axis);
    w = ql_frame_to_world(&frame, ql_warp_power_lobe(inverse, u.u1, u.u2, &s));
    sample->direction = ql_vec_to_dir(w);
    above = ql_vec_dot_call(w, bsdf->n); /* 2^-58 */
    if (above <= 0 || !is_above(bsdf->surface, sample->direction) ||
            !set_weight(&sample->weight, bsdf->gloss->specular)) {
        return false;
    }
    cosine = ql_real_from_uq_call((uint64_t)above, 58);
    cosine = ql_real_less(cosine, QL_REAL_ONE) ? cosine : QL_REAL_ONE;
    cosine = ql_real_mul_call(cosine, lobe_ratio(power, inverse));
    ql_rgb_scale(&sample->weight, cosine);
    divide(&sample->weight, chance);
    if (QL_CFG_STRATEGIES && pdf) {
        /* rounded, s may be 1, where the density ends */
        s = s < QL_UQ31_ONE ? s : QL_UQ31_ONE - 1;
        sample->pdf = ql_real_mul_call(
                ql_warp_power_lobe_pdf(power, s), real_from_uq31(chance));
    }
    return true;
}

/* Both lobes by a direction whose density knows of neither. */
static bool sample_both(const ql_bsdf_t *bsdf, ql_density_t density,
        ql_uniform2_t u, ql_bsdf_sample_t *sample)
{
    ql_real_t factor;

    if (!draw_direction(bsdf->surface, density, u, sample, &factor, false)) {
        return false;
    }
    /* f cos / density = f factor pi */
    ql_bsdf_reflect(bsdf, ql_vec_unit_q29(sample->direction), factor,
            QL_REAL_PI, false, &sample->weight);
    return ql_rgb_most(&sample->weight) != 0;
}
#endif

/* ---- Glass ------------------------------------------------------------- */

#if QL_CFG_GLASS
/* A ray at a boundary. With N = n2/n1, c = cos of the angle it comes at and
 * g = N cos of the angle it leaves at = sqrt(N^2 - 1 + c^2), it goes on in
 * d + (c - g) n, of length N. */
typedef struct {
    ql_real_t index;  /* N */
    ql_real_t square; /* N^2 */
    ql_real_t bend;   /* |c - g| */
    bool denser;      /* N >= 1: c <= g */
    ql_uq32_t reflectance;
} boundary_t;

/* |a - b| */
static ql_real_t distance(ql_real_t a, ql_real_t b)
{
    return ql_real_less(a, b) ? ql_real_sub(b, a) : ql_real_sub(a, b);
}

/* ((a - b) / (a + b))^2 */
static ql_real_t square_of_ratio(ql_real_t a, ql_real_t b)
{
    const ql_real_t inverse = ql_real_recip_call(ql_real_add(a, b));
    const ql_real_t ratio = ql_real_mul_call(distance(a, b), inverse);

    return ql_real_mul_call(ratio, ratio);
}

/* Let a ray that comes at cosine c, u1.31 in [0, 1], meet a boundary whose
 * index is set; false if all of it is reflected.
 * Fresnel's reflectance is the mean of the squares of (c - g)/(c + g) and
 * (g - N^2 c)/(g + N^2 c). */
static bool meet_boundary(boundary_t *b, ql_uq31_t c)
{
    const uint64_t cc = (uint64_t)c * c;
    const ql_real_t cosine = real_from_uq31(c);
    const ql_real_t sine2 = ql_real_from_uq_call(((uint64_t)1 << 62) - cc, 62);
    ql_real_t g, x;

    b->square = ql_real_mul_call(b->index, b->index);
    b->denser = !ql_real_less(b->square, QL_REAL_ONE);
    if (!ql_real_less(sine2, b->square)) {
        return false;
    }
    g = ql_real_sqrt(ql_real_sub(b->square, sine2));
    b->bend = distance(cosine, g);
    x = ql_real_add(square_of_ratio(cosine, g),
            square_of_ratio(g, ql_real_mul_call(b->square, cosine)));
    b->reflectance = ql_real_to_uq32(ql_real_scale(x, -1));
    return true;
}

/* d along + n bend of fractions below 1: below 2^30 */
static QL_NOINLINE int32_t refracted_part(
        int32_t d, uint32_t along, int32_t n, uint32_t bend)
{
    return ql_mulhi_su32(d, along) + ql_mulhi_su32(n, bend);
}

/* Direction behind the boundary, of length 1 or N, whichever is less. */
static ql_vec3_t refracted(const boundary_t *b, ql_vec3_t in, ql_vec3_t n)
{
    const ql_real_t scale =
            b->denser ? ql_real_recip_call(b->index) : QL_REAL_ONE;
    const int32_t side = b->denser ? -1 : 1;
    const uint32_t along = ql_real_to_uq32(scale);
    const uint32_t bend = ql_real_to_uq32(ql_real_mul_call(b->bend, scale));

    in.x = refracted_part(in.x, along, n.x * side, bend);
    in.y = refracted_part(in.y, along, n.y * side, bend);
    in.z = refracted_part(in.z, along, n.z * side, bend);
    return in;
}

/* Cosine of the angle the ray comes at, in [0, 1]. */
static ql_uq31_t cosine_between(ql_vec3_t in, ql_vec3_t n)
{
    const int64_t product = -ql_vec_dot_call(in, n); /* 2^-58, below 2^59 */
    const uint64_t c = product > 0 ? (uint64_t)product >> 27 : 0;

    return c < QL_UQ31_ONE ? (ql_uq31_t)c : QL_UQ31_ONE;
}

static bool sample_glass(
        const ql_bsdf_t *bsdf, ql_uq32_t pick, ql_bsdf_sample_t *sample)
{
    static const uint32_t white[3] = {
            QL_LE32(QL_UQ31_ONE), QL_LE32(QL_UQ31_ONE), QL_LE32(QL_UQ31_ONE)};
    const ql_vec3_t n = facing(bsdf);
    boundary_t b;

    b.index = ql_real_from_uq_call(QL_LE32(bsdf->gloss->parameter), 16);
    b.index = bsdf->front ? b.index : ql_real_recip_call(b.index);
    if (!meet_boundary(&b, cosine_between(bsdf->in, n)) ||
            pick < b.reflectance) {
        (void)set_weight(&sample->weight, white);
        return set_delta(bsdf->surface, bsdf->axis, false, sample);
    }
    if (!set_weight(&sample->weight, bsdf->gloss->specular)) {
        return false;
    }
    ql_rgb_scale(&sample->weight, ql_real_recip_call(b.square));
    return set_delta(bsdf->surface,
            turned(bsdf->surface, refracted(&b, bsdf->in, n), true), true,
            sample);
}
#endif

/* ---- Whichever it is --------------------------------------------------- */

#if QL_CFG_MIRROR
static bool sample_mirror(
        const ql_bsdf_t *bsdf, bool all, ql_bsdf_sample_t *sample)
{
    if (!set_weight(&sample->weight, bsdf->gloss->specular)) {
        return false;
    }
    if (!all) {
        divide(&sample->weight, QL_LE32(bsdf->gloss->chance));
    }
    return set_delta(bsdf->surface, bsdf->axis, false, sample);
}
#endif

static bool sample_gloss(const ql_bsdf_t *bsdf, ql_density_t density,
        bool delta, ql_uq32_t pick, ql_uniform2_t u, ql_bsdf_sample_t *sample,
        bool pdf)
{
    const uint16_t kind = QL_LE16(bsdf->gloss->kind);
    const ql_uq31_t chance = QL_LE32(bsdf->gloss->chance);
    const bool special = pick >> 1 < chance; /* exactly with that chance */

#if QL_CFG_GLASS
    if (kind == QL_GLOSS_GLASS) {
        return sample_glass(bsdf, pick, sample);
    }
#endif
#if QL_CFG_MIRROR
    if (kind == QL_GLOSS_MIRROR && (delta || special)) {
        return sample_mirror(bsdf, delta, sample);
    }
#endif
    if (delta) {
        return false;
    }
#if QL_CFG_PHONG
    if (kind == QL_GLOSS_PHONG && density != QL_DENSITY_BRDF) {
        return sample_both(bsdf, density, u, sample);
    }
    if (kind == QL_GLOSS_PHONG && special) {
        return sample_lobe(bsdf, u, sample, pdf);
    }
#endif
    /* What is left has the rest of the chance, which is not 0. */
    if (special || !sample_diffuse(bsdf, density, u, sample, pdf)) {
        return false;
    }
    divide(&sample->weight, QL_UQ31_ONE - chance);
    if (QL_CFG_STRATEGIES && pdf) {
        const ql_real_t rest = real_from_uq31(QL_UQ31_ONE - chance);

        sample->pdf = ql_real_mul_call(sample->pdf, rest);
    }
    return true;
}

static void begin_gloss(ql_bsdf_t *bsdf, ql_vec3_t incoming)
{
    bsdf->n = ql_bsdf_normal(bsdf->surface);
    bsdf->in = ql_vec_unit_q29(incoming);
    bsdf->axis = turned(bsdf->surface, mirrored(bsdf->in, facing(bsdf)), false);
}

#endif

void ql_bsdf_begin(ql_bsdf_t *bsdf, const ql_scene_t *scene,
        const ql_surface_t *surface, const ql_blob_material_t *material,
        bool front, ql_vec3_t incoming)
{
    bsdf->surface = surface;
    bsdf->material = material;
    bsdf->gloss = ql_scene_gloss(scene, material);
#if QL_GLOSS
    bsdf->front = front;
    if (bsdf->gloss != NULL) {
        begin_gloss(bsdf, incoming);
    }
#else
    (void)front;
    (void)incoming;
#endif
}

bool ql_bsdf_sample(const ql_bsdf_t *bsdf, ql_density_t density, bool delta,
        ql_uq32_t pick, ql_uniform2_t u, ql_bsdf_sample_t *sample, bool pdf)
{
    sample->delta = false;
    sample->through = false;
#if QL_GLOSS
    if (bsdf->gloss != NULL) {
        return sample_gloss(bsdf, density, delta, pick, u, sample, pdf);
    }
#else
    (void)pick;
#endif
    return !delta && sample_diffuse(bsdf, density, u, sample, pdf);
}

void ql_bsdf_reflect(const ql_bsdf_t *bsdf, ql_vec3_t w, ql_real_t cosine,
        ql_real_t inverse, bool mis, ql_rgb_t *r)
{
    ql_real_t part =
            ql_real_mul_call(ql_real_mul_call(cosine, QL_REAL_INV_PI), inverse);
    ql_uq31_t chance = QL_UQ31_ONE;

#if QL_GLOSS
    if (bsdf->gloss != NULL) {
        chance -= QL_LE32(bsdf->gloss->chance);
    }
#endif
    if (QL_CFG_STRATEGIES && mis) {
        part = balanced(part, chance);
    }
    (void)set_weight(r, bsdf->material->albedo);
    ql_rgb_scale(r, part);
#if QL_CFG_PHONG
    if (bsdf->gloss != NULL && QL_LE16(bsdf->gloss->kind) == QL_GLOSS_PHONG) {
        add_lobe(bsdf, w, cosine, inverse, mis, r);
    }
#else
    (void)w;
#endif
}
