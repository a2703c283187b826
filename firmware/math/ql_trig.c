/* ql_trig.c - sine and cosine by table; sine, arc tangent by polynomials */
/* SPDX-License-Identifier: MIT */

#include "math/ql_trig.h"

#include "math/lut/ql_lut.h"

#define CELL_SHIFT (30 - QL_SIN_BITS) /* turn32 bits in one cell */

/* Turn the sine and cosine of a table's angle by the rest, by Taylor's first
 * order (draft) or second (fine). */
QL_FAST_INLINE void refine_sincos(int32_t rest, int32_t *sine, int32_t *cosine)
{
    /* rest 2 pi / 2^32 rad, scaled by 2^36: |rest| <= 2^24, |delta| < pi 2^29.
     * 2 pi 2^29 is QL_PI_M. */
    const int32_t delta = ql_mulhi_su32(rest * 128, QL_PI_M);
    const uint32_t adelta = ql_abs32(delta);
    const int32_t s = *sine, c = *cosine;
    int32_t middle_s = s, middle_c = c, ds, dc;

    if (QL_CFG_PRECISION > 0) {
        /* s + d (c - d s / 2), c - d (s + d c / 2): s1.30 times 2^36 is 2^66,
         * the high word 2^34; >> 5 makes it s1.30 and halves it */
        const int32_t half_s =
                (int32_t)(ql_mulhi_u32((uint32_t)s, adelta) >> 5);
        const int32_t half_c =
                (int32_t)(ql_mulhi_u32((uint32_t)c, adelta) >> 5);

        middle_c = delta < 0 ? c + half_s : c - half_s;
        middle_s = delta < 0 ? s - half_c : s + half_c;
    }
    /* 2^34 to s1.30, to nearest */
    dc = ql_asr32(ql_mulhi_su32(middle_c, adelta) + 8, 4);
    ds = ql_asr32(ql_mulhi_su32(middle_s, adelta) + 8, 4);
    *sine = delta < 0 ? s - dc : s + dc;
    *cosine = delta < 0 ? c + ds : c - ds;
}

void ql_sincos(ql_turn32_t turn, int32_t *sine, int32_t *cosine)
{
    /* Nearest table angle, and the rest: |rest| <= 2^(CELL_SHIFT - 1). */
    const uint32_t near =
            (turn + ((uint32_t)1 << (CELL_SHIFT - 1))) >> CELL_SHIFT;
    const int32_t rest = ql_i32(turn - (near << CELL_SHIFT));
    const unsigned cell = near & (QL_SIN_CELLS - 1);
    int32_t s = ql_lut_sin[cell];
    int32_t c = ql_lut_sin[QL_SIN_CELLS - cell];

    if (QL_CFG_TABLE_LERP) {
        refine_sincos(rest, &s, &c);
    }

    /* Quadrants: near counts cells of the whole turn. */
    switch (near >> QL_SIN_BITS & 3u) {
    case 0:
        *sine = s;
        *cosine = c;
        break;
    case 1:
        *sine = c;
        *cosine = -s;
        break;
    case 2:
        *sine = -s;
        *cosine = -c;
        break;
    default:
        *sine = -c;
        *cosine = s;
        break;
    }
}

/* (1 - sin(y) / y) / v of v = y^2 / 4, u0.32, alternating signs. Interpolated
 * at Chebyshev's points of [0, (pi/4)^2]; off by 2^-33. */
static const uint32_t sine_series[] = {
        0xaaaaaaaau, 0x222221fbu, 0x0340320bu, 0x002e32d2u, 0x00019db1u};

/* (1 - atan(a) / a) / z of z = a^2 on [0, 1], as above; off by 2^-31. */
static const uint32_t atan_series[] = {0x55555554u, 0x33333192u, 0x249206a7u,
        0x1c6d94a5u, 0x172251c8u, 0x12fd217du, 0x0ebf57c8u, 0x09cfd3d7u,
        0x04ee4b52u, 0x0196cc73u, 0x003d5c80u};

/* x (1 - z (c0 - z (c1 - z (c2 - ...)))). The coefficients fall faster than z
 * lets them grow, so every difference is positive. */
static ql_real_t odd_series(
        ql_real_t x, ql_uq32_t z, const uint32_t *series, unsigned count)
{
    ql_real_t r = {0, -32};
    uint32_t sum = 0;

    while (count-- > 0) {
        sum = series[count] - ql_mulhi_u32(z, sum);
    }
    r.m = ~ql_mulhi_u32(z, sum); /* 0.63 or more of 2^32 */
    return ql_real_mul_call(x, r);
}

ql_real_t ql_real_sin(ql_real_t x)
{
    ql_real_t v;

    if (x.m == 0) {
        return x;
    }
    if (x.e > -31 || (x.e == -31 && x.m > QL_PI_M)) { /* above pi / 2 */
        x = ql_real_sub(QL_REAL_PI, x);
    }
    v = ql_real_scale(ql_real_mul_call(x, x), -2);
    return odd_series(x, ql_real_to_uq32(v), sine_series,
            sizeof sine_series / sizeof sine_series[0]);
}

ql_real_t ql_real_atan(ql_real_t a)
{
    const bool steep = a.m != 0 && a.e > -32; /* a >= 1 */
    ql_real_t angle;

    if (steep) {
        a = ql_real_recip(a);
    }
    angle = odd_series(a, ql_real_to_uq32(ql_real_mul_call(a, a)), atan_series,
            sizeof atan_series / sizeof atan_series[0]);
    return steep ? ql_real_sub(QL_REAL_HALF_PI, angle) : angle;
}

ql_turn32_t ql_atan2(int32_t y, int32_t x)
{
    const uint32_t ay = ql_abs32(y), ax = ql_abs32(x);
    const bool steep = ay > ax;
    const ql_real_t ratio = ql_real_div(ql_real_from_u64(steep ? ax : ay),
            ql_real_from_u64(steep ? ay : ax));
    ql_turn32_t turn = ql_real_to_uq32(
            ql_real_mul_call(ql_real_atan(ratio), QL_REAL_INV_2PI));

    turn = steep ? 0x40000000u - turn : turn;
    turn = x < 0 ? 0x80000000u - turn : turn;
    return y < 0 ? 0u - turn : turn;
}
