/* ql_lobe.c - hemispheres, cos^m lobe, cone */
/* SPDX-License-Identifier: MIT */

#include "warp/ql_lobe.h"

#include "math/ql_lut.h"
#include "math/ql_trig.h"

#define ONE_Q29  ((int32_t)1 << 29)
#define LN2_UQ32 0xb17217f8u /* ln 2 */
#define LOG2E    0xb8aa3b29u /* 1 / ln 2, u1.31 */
#define SIXTH    0x2aaaaaabu /* 1 / 6 */
#define INV_PI2  0xcf817b11u /* 1 / pi^2 2^35 */

#define POWER_MAX 4096u /* no density below 2^-this */

/* Square root of a in [0, 1), u0.32, cut below 1. Relative error that of
 * ql_rsqrt_warp_m() and 3 ulp. */
static ql_uq32_t root(ql_real_t a)
{
    const unsigned shift = (unsigned)(-32 - a.e); /* a = m 2^-32 2^-shift */
    const uint32_t m = a.m >> (shift & 1u);       /* >= 2^30, even shift */
    uint32_t half;

    if (a.m == 0 || shift > 62) {
        return 0;
    }
    half = ql_mulhi_u32(m, ql_rsqrt_warp_m(m)); /* sqrt(m 2^-32) 2^31 */
    half = half < 0x80000000u ? half << 1 : 0xffffffffu;
    return half >> (shift / 2);
}

/* (rho cos, rho sin, z), x and y to nearest. */
static ql_vec3_t polar(ql_uq32_t rho, ql_turn32_t azimuth, ql_q29_t z)
{
    int32_t sine, cosine;
    ql_vec3_t v;

    ql_sincos(azimuth, &sine, &cosine);
    /* s1.30 times u0.32, high word: s1.30, below 2^30 + 2^15 */
    v.x = ql_asr32(ql_mulhi_su32(cosine, rho) + 1, 1);
    v.y = ql_asr32(ql_mulhi_su32(sine, rho) + 1, 1);
    v.z = z;
    return v;
}

/* The direction with 1 - z = s < 1. */
static ql_vec3_t off_axis(ql_real_t s, ql_turn32_t azimuth)
{
    const ql_uq32_t fixed = ql_real_to_uq32(s);
    /* (2 - s) 2^31 in [2^31, 2^32), rounded down so that the sine is <= 1 */
    const ql_real_t rest = QL_REAL(~(fixed >> 1), -31);
    const ql_q29_t z = ONE_Q29 - (int32_t)(((fixed >> 2) + 1) >> 1);

    return polar(root(ql_real_mul(s, rest)), azimuth, z);
}

ql_vec3_t ql_warp_uniform_hemisphere(ql_uq32_t u1, ql_uq32_t u2)
{
    return off_axis(ql_real_midpoint(~u1), u2); /* 1 - midpoint, exactly */
}

ql_vec3_t ql_warp_naive_hemisphere(ql_uq32_t u1, ql_uq32_t u2)
{
    int32_t sine, cosine;

    /* a quarter turn; at its ends the sine errs beyond [0, 1] */
    ql_sincos(u1 >> 2, &sine, &cosine);
    sine = sine < 0 ? 0 : sine;
    cosine = cosine < 0 ? 0 : cosine;
    return polar(sine >= (int32_t)1 << 30 ? 0xffffffffu : (ql_uq32_t)sine << 2,
            u2, (cosine + 1) >> 1);
}

ql_real_t ql_warp_naive_hemisphere_pdf(ql_vec3_t w)
{
    /* sin^2 2^58 = square.m 2^square.e, and m 2^-32 2^t = sin^2, t even */
    const ql_real_t square = ql_real_from_u64(
            (uint64_t)((int64_t)w.x * w.x) + (uint64_t)((int64_t)w.y * w.y));
    const int32_t t = square.e + 32 - 58 + (square.e & 1);
    uint32_t r;

    if (square.m == 0 || w.z < 0) {
        return QL_REAL_ZERO;
    }
    r = ql_rsqrt_m(square.m >> (square.e & 1)); /* 2^31 2^(t/2) / sin */
    return ql_real_mul(QL_REAL(r < 0x80000000u ? 0x80000000u : r,
                               ql_real_exponent(-31 - t / 2)),
            QL_REAL(INV_PI2, -35));
}

ql_vec3_t ql_warp_cosine_lobe(ql_uq32_t u1, ql_uq32_t u2)
{
    /* at least 2^-16.5, so z > 0; u0.32 to s2.29, to nearest */
    const ql_uq32_t z = root(ql_real_midpoint(~u1));

    return polar(
            root(ql_real_midpoint(u1)), u2, (int32_t)(((z >> 2) + 1) >> 1));
}

ql_uq32_t ql_warp_cosine_lobe_pdf(ql_q29_t z)
{
    /* z 2^31 times 2^34 / (2 pi): the high word is 2^32 z / pi */
    return z <= 0 ? 0
                  : ql_mulhi_u32(z >= ONE_Q29 ? 0x80000000u : (uint32_t)z << 2,
                            QL_INV_PI_M);
}

/* -log2(u) for u = 1 - w in (0, 1). Near 1 the series in w keeps all bits of a
 * tiny result; elsewhere the table and a series about its cell. */
static ql_real_t minus_log2(ql_real_t u, ql_real_t w)
{
    uint32_t r, da, d2, d3;
    int32_t d, ln;
    uint64_t sum;

    if (w.e < -39) { /* w < 2^-8 */
        const ql_uq32_t x = ql_real_to_uq32(w);
        const uint32_t x2 = ql_mulhi_u32(x, x);
        /* (1 + x/2 + x^2/3 + x^3/4) 2^31; the next term is below 2^-34 */
        const uint32_t sum31 = 0x80000000u + (x >> 2) +
                               ql_mulhi_u32(x2, SIXTH) +
                               (ql_mulhi_u32(x2, x) >> 3);

        return ql_real_mul(
                ql_real_mul(w, QL_REAL(sum31, -31)), QL_REAL(LOG2E, -31));
    }
    /* r = 1/m to 2^-8: d = m r - 1, times 2^38, |d| < 2^30.2 */
    r = (uint32_t)ql_lut_recip[(u.m >> 24) - QL_RECIP_CELLS] << 16;
    d = ql_i32(ql_mulhi_u32(u.m, r) << 7 | (u.m * r) >> 25);
    da = ql_abs32(d);
    d2 = ql_mulhi_u32(da, da); /* d^2 2^44 < 2^28.4 */
    d3 = ql_mulhi_u32(d2, da); /* |d|^3 2^50 < 2^26.6 */
    /* ln(1 + d) 2^38; the term left out, d^4/4, is below 2^-33 */
    ln = (int32_t)(ql_mulhi_u32(d3, SIXTH) >> 11);
    ln = d - (int32_t)(d2 >> 7) + (d < 0 ? -ln : ln);
    /* exponent, log2(r), less log2(1 + d) 2^37, all in 2^-32; above 2^-8 */
    sum = ((uint64_t)(uint16_t)(-32 - u.e) << 32) +
          ql_lut_log2[(u.m >> 24) - QL_RECIP_CELLS];
    sum -= (uint64_t)(int64_t)ql_asr32(ql_mulhi_su32(ln, LOG2E) + 16, 5);
    return ql_real_scale(ql_real_from_u64(sum), -32);
}

/* (1 - e^-x) / x for x < 2^-6, u0.32: 1 - x/2 + x^2/6 - x^3/24; the next term
 * is below 2^-36. */
static uint32_t decay_over_x(ql_uq32_t x)
{
    const uint32_t x2 = ql_mulhi_u32(x, x);

    return ~(x >> 1) + ql_mulhi_u32(x2, SIXTH) -
           (ql_mulhi_u32(ql_mulhi_u32(x2, x), SIXTH) >> 2);
}

/* 1 - 2^-f for f in [0, 1), u0.32: 1 - (1 - a)(1 - b) = a + (1 - a) b, where a
 * is the table's and b the rest's. */
static ql_uq32_t decay_of_fraction(ql_uq32_t f)
{
    const uint32_t a = ql_lut_exp2[f >> (32 - QL_EXP2_BITS)];
    const uint32_t x = ql_mulhi_u32(f << QL_EXP2_BITS, LN2_UQ32); /* 2^38 */
    const uint32_t b =
            ql_mulhi_u32(x, decay_over_x(x >> QL_EXP2_BITS)) >> QL_EXP2_BITS;

    return a + ql_mulhi_u32(~a, b); /* < 2^31 + 2 */
}

/* y in [2^-6, 2^21] as whole and fraction. */
static uint32_t split(ql_real_t y, ql_uq32_t *fraction)
{
    const uint64_t fixed = (uint64_t)y.m << (y.e + 38); /* y 2^38, < 2^60 */

    *fraction = (uint32_t)(fixed >> 6);
    return (uint32_t)(fixed >> 38);
}

/* s = 1 - 2^-y, below 1. */
static ql_real_t decay(ql_real_t y)
{
    ql_uq32_t f, s;
    uint32_t whole;

    if (y.e < -37) { /* y < 2^-6: keeps the bits of a tiny y */
        const ql_real_t x = ql_real_mul(y, QL_REAL(LN2_UQ32, -32));

        return ql_real_mul(x, QL_REAL(decay_over_x(ql_real_to_uq32(x)), -32));
    }
    whole = split(y, &f);
    s = whole < 32 ? ~(~decay_of_fraction(f) >> whole) : 0xffffffffu;
    return ql_real_scale(ql_real_from_u64(s), -32);
}

/* 2^-y; 0 below 2^-POWER_MAX. */
static ql_real_t half_to_the(ql_real_t y)
{
    ql_uq32_t f = 0, m;
    uint32_t whole = 0;

    if (y.m == 0) {
        return QL_REAL_ONE;
    }
    if (y.e >= -37) {
        whole = split(y, &f);
        if (whole >= POWER_MAX) {
            return QL_REAL_ZERO;
        }
        m = ~decay_of_fraction(f);
    } else {
        m = ~ql_real_to_uq32(decay(y));
    }
    return QL_REAL(m < 0x80000000u ? 0x80000000u : m,
            ql_real_exponent(-32 - (int32_t)whole));
}

/* m + 1 */
static ql_real_t one_more(ql_uq16_t power)
{
    return ql_real_scale(ql_real_from_u64((uint64_t)power + 65536u), -16);
}

ql_real_t ql_lobe_inverse(ql_uq16_t power)
{
    return ql_real_recip(one_more(power));
}

ql_vec3_t ql_warp_power_lobe(
        ql_real_t inverse, ql_uq32_t u1, ql_uq32_t u2, ql_uq31_t *s)
{
    const ql_real_t log =
            minus_log2(ql_real_midpoint(u1), ql_real_midpoint(~u1));
    const ql_real_t exact = decay(ql_real_mul(log, inverse));
    const ql_uq32_t fixed = ql_real_to_uq32(exact);

    *s = (fixed >> 1) + (fixed & 1u); /* to nearest */
    return off_axis(exact, u2);
}

ql_real_t ql_warp_power_lobe_pdf(ql_uq16_t power, ql_uq31_t s)
{
    const ql_real_t scale = ql_real_mul(one_more(power), QL_REAL_INV_2PI);
    ql_real_t m, u, w;

    if (s >= QL_UQ31_ONE) {
        return QL_REAL_ZERO;
    }
    if (s == 0) {
        return scale;
    }
    m = ql_real_scale(ql_real_from_u64(power), -16);
    u = ql_real_scale(ql_real_from_u64(QL_UQ31_ONE - s), -31);
    w = ql_real_scale(ql_real_from_u64(s), -31);
    return ql_real_mul(scale, half_to_the(ql_real_mul(m, minus_log2(u, w))));
}

ql_real_t ql_cone_of_sphere(ql_real_t ratio2)
{
    ql_real_t root, sum;

    if (ratio2.m == 0 || ratio2.e > -32) {
        return ratio2.m == 0 ? QL_REAL_ZERO : QL_REAL_ONE;
    }
    /* (1 - r2) 2^32: exact where it is small, for there r2 has 32 bits */
    root = ql_real_from_u64(((uint64_t)1 << 32) - ql_real_to_uq32(ratio2));
    root = ql_real_sqrt(ql_real_scale(root, -32));
    sum = ql_real_add(QL_REAL_ONE, root);
    return ql_real_mul(ratio2, ql_real_recip(sum));
}

ql_vec3_t ql_warp_cone(ql_real_t s_max, ql_uq32_t u1, ql_uq32_t u2)
{
    return off_axis(ql_real_mul(s_max, ql_real_midpoint(u1)), u2);
}

ql_real_t ql_warp_cone_pdf(ql_real_t s_max)
{
    return ql_real_mul(ql_real_recip(s_max), QL_REAL_INV_2PI);
}
