/* ql_glass.c - Snell's direction and Fresnel's reflectance at a boundary */
/* SPDX-License-Identifier: MIT */

#include "material/ql_glass.h"

#if QL_CFG_GLASS

#include "material/ql_mirror.h"

/* A ray at a boundary. With eta = n2/n1, c = cos of the angle it comes at and
 * g = eta cos of the angle it leaves at = sqrt(eta^2 - 1 + c^2), it goes on in
 * d + (c - g) n, of length eta. */
typedef struct {
    ql_real_t eta;
    ql_real_t eta2;        /* eta^2 */
    ql_real_t bend;        /* |c - g| */
    bool denser;           /* eta >= 1: c <= g */
    ql_uq32_t reflectance; /* Fresnel's */
} boundary_t;

/* |a - b| */
static ql_real_t distance(ql_real_t a, ql_real_t b)
{
    return ql_real_less(a, b) ? ql_real_sub(b, a) : ql_real_sub(a, b);
}

/* ((a - b) / (a + b))^2 */
static ql_real_t square_of_ratio(ql_real_t a, ql_real_t b)
{
    const ql_real_t ratio = ql_real_div(distance(a, b), ql_real_add(a, b));

    return ql_real_mul_call(ratio, ratio);
}

/* Let a ray that comes at cosine c, u1.31 in [0, 1], meet a boundary whose eta
 * is set; false if all of it is reflected.
 * Fresnel's reflectance is the mean of the squares of (c - g)/(c + g) and
 * (g - eta^2 c)/(g + eta^2 c). */
static bool meet_boundary(boundary_t *b, ql_uq31_t c)
{
    const uint64_t cc = (uint64_t)c * c;
    const ql_real_t cosine = ql_real_from_uq_call(c, 31);
    const ql_real_t sine2 = ql_real_from_uq_call(((uint64_t)1 << 62) - cc, 62);
    ql_real_t g, squares;

    b->eta2 = ql_real_mul_call(b->eta, b->eta);
    b->denser = !ql_real_less(b->eta2, QL_REAL_ONE);
    if (!ql_real_less(sine2, b->eta2)) {
        return false;
    }
    g = ql_real_sqrt(ql_real_sub(b->eta2, sine2));
    b->bend = distance(cosine, g);
    squares = ql_real_add(square_of_ratio(cosine, g),
            square_of_ratio(g, ql_real_mul_call(b->eta2, cosine)));
    b->reflectance = ql_real_to_uq32(ql_real_scale(squares, -1));
    return true;
}

/* d along + n bend of fractions below 1: below 2^30 */
static QL_NOINLINE int32_t refract_part(
        int32_t d, uint32_t along, int32_t n, uint32_t bend)
{
    return ql_mulhi_su32(d, along) + ql_mulhi_su32(n, bend);
}

/* Direction behind the boundary of a ray d, of length 1 or eta, whichever is
 * less. */
static ql_vec3_t refract(const boundary_t *b, ql_vec3_t d, ql_vec3_t n)
{
    const ql_real_t scale =
            b->denser ? ql_real_recip_call(b->eta) : QL_REAL_ONE;
    const int32_t side = b->denser ? -1 : 1;
    const uint32_t along = ql_real_to_uq32(scale);
    const uint32_t bend = ql_real_to_uq32(ql_real_mul_call(b->bend, scale));

    d.x = refract_part(d.x, along, n.x * side, bend);
    d.y = refract_part(d.y, along, n.y * side, bend);
    d.z = refract_part(d.z, along, n.z * side, bend);
    return d;
}

/* Cosine of the angle a ray d comes at, in [0, 1]. */
static ql_uq31_t cosine_between(ql_vec3_t d, ql_vec3_t n)
{
    const int64_t product = -ql_vec_dot_call(d, n); /* 2^-58, below 2^59 */
    const uint64_t c = product > 0 ? (uint64_t)product >> 27 : 0;

    return c < QL_UQ31_ONE ? (ql_uq31_t)c : QL_UQ31_ONE;
}

bool ql_glass_sample(
        const ql_bsdf_t *bsdf, ql_uq32_t pick, ql_bsdf_sample_t *sample)
{
    static const uint32_t white[3] = {
            QL_LE32(QL_UQ31_ONE), QL_LE32(QL_UQ31_ONE), QL_LE32(QL_UQ31_ONE)};
    const ql_vec3_t n = ql_mirror_normal(bsdf);
    ql_vec3_t w;
    boundary_t b;

    b.eta = ql_real_from_uq_call(QL_LE32(bsdf->gloss->parameter), 16);
    b.eta = bsdf->front ? b.eta : ql_real_recip_call(b.eta);
    if (!meet_boundary(&b, cosine_between(bsdf->minus_wo, n)) ||
            pick < b.reflectance) {
        (void)ql_rgb_load(&sample->weight, white);
        return ql_mirror_leave(
                bsdf->surface, bsdf->mirror, QL_SIDE_ABOVE, sample);
    }
    if (!ql_rgb_load(&sample->weight, bsdf->gloss->specular)) {
        return false;
    }
    ql_rgb_scale(&sample->weight, ql_real_recip_call(b.eta2));
    w = ql_mirror_turn(
            bsdf->surface, refract(&b, bsdf->minus_wo, n), QL_SIDE_BELOW);
    return ql_mirror_leave(bsdf->surface, w, QL_SIDE_BELOW, sample);
}

#endif
