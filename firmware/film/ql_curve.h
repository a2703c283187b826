/* ql_curve.h - curves that let highlights roll off before they are white */
/* SPDX-License-Identifier: MIT */

/* A curve maps each channel to [0, 1]; what comes out is linear still, and
 * ql_tonemap.h encodes it. Below x is a channel after exposure, 1 being the
 * white of a display without a curve; both curves leave a middle grey of 0.18
 * where it is, within 0.002, and are white from x = QL_CURVE_WHITE on. A
 * saturated colour that is very bright becomes white, as on film.
 *
 *   filmic    N(0.72 x) / N(5.76), N(v) = v (2.51 v + 0.03) /
 *             (v (2.43 v + 0.59) + 0.14): Narkowicz, ACES Filmic Tone Mapping
 *             Curve, 2015. Its toe makes shadows darker
 *   reinhard  L (1 + L / 9.6^2) / (1 + L), L = 1.2 x: Reinhard, Stark, Shirley,
 *             Ferwerda, Photographic Tone Reproduction for Digital Images,
 *             2002, equation 4, for each channel */

#ifndef QL_CURVE_H
#define QL_CURVE_H

#include "base/ql_settings.h"
#include "math/ql_fx.h"

QL_C_BEGIN

/* What a curve makes white: so many times the white without one. */
#define QL_CURVE_WHITE 8

#if QL_ROLL_OFF
/* Apply a curve.
 *
 *   curve   -       SRGB: nothing is changed
 *   linear  u16.16  in and out, each channel
 *
 * Error: 2.1e-4 of white; 0.05 of 255 after the sRGB curve, which adds its own.
 * Cost:  a look-up and a product a channel.
 */
void ql_curve_roll_off(ql_curve_t curve, ql_uq16_t linear[3]);

/* Which one the settings ask for. */
QL_INLINE ql_curve_t ql_curve_of(const ql_settings_t *settings)
{
    return (ql_curve_t)settings->curve;
}
#else
QL_INLINE void ql_curve_roll_off(ql_curve_t curve, ql_uq16_t linear[3])
{
    (void)curve;
    (void)linear;
}

QL_INLINE ql_curve_t ql_curve_of(const ql_settings_t *settings)
{
    (void)settings;
    return QL_CURVE_SRGB;
}
#endif

QL_C_END

#endif
