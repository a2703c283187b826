/* ql_trig.h - sine and cosine of turns; sine, arc tangent of real numbers */
/* SPDX-License-Identifier: MIT */

#ifndef QL_TRIG_H
#define QL_TRIG_H

#include "math/ql_real.h"

/* Sine and cosine together.
 *
 *   turn    turn32  any angle; wraps
 *   sine    s1.30   out: in [-1, 1], and its error
 *   cosine  s1.30   out: of the same angle
 *
 * Error: at most 2.0e-5 (draft) or 4.2e-8 (fine), absolute, by tables of 7
 *        bits. With h = pi / 2^(bits + 2), half a cell, and 2e-9 of rounding it
 *        is h^2 / 2 or h^3 / 6; h without QL_CFG_TABLE_LERP.
 * Cost:  two look-ups; three multiplications (draft) or five (fine), or none.
 * From:  Taylor's series about the nearest of 2^(bits + 2) angles a turn, of
 *        the first (draft) or second order (fine).
 */
void ql_sincos(ql_turn32_t turn, int32_t *sine, int32_t *cosine);

/* Sine of a real angle, for where a small one must keep its bits.
 *
 *   x       rad   [0, pi]; 0 beyond
 *   return  real  sin(x)
 *
 * Error: relative, 2^-28, up to pi / 2; from there absolute, 2^-29. The same in
 *        both precisions.
 * Cost:  ten multiplications, no table.
 * From:  sin(x) / x as a polynomial of degree 5 in x^2, near minimax.
 */
ql_real_t ql_real_sin(ql_real_t x);

/* Arc tangent of a real number.
 *
 *   a       real  any
 *   return  rad   atan(a) in [0, pi / 2]
 *
 * Error: relative, 2^-28, both precisions.
 * Cost:  fifteen multiplications; above 1 a reciprocal.
 * From:  atan(a) / a as a polynomial of degree 11 in a^2, near minimax.
 */
ql_real_t ql_real_atan(ql_real_t a);

/* The angle of a point of the plane.
 *
 *   y, x    -       any
 *   return  turn32  atan2(y, x) / (2 pi), wrapping; 0 for (0, 0)
 *
 * Error: at most 2^-30 of a turn, both precisions; none on the axes.
 * Cost:  one reciprocal, ql_real_atan().
 */
ql_turn32_t ql_atan2(int32_t y, int32_t x);

#endif
