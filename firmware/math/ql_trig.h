/* ql_trig.h - sine and cosine of turns */
/* SPDX-License-Identifier: MIT */

#ifndef QL_TRIG_H
#define QL_TRIG_H

#include "math/ql_fx.h"

/* Sine and cosine together.
 *
 *   turn    turn32  any angle; wraps
 *   sine    s1.30   out: in [-1, 1], and its error
 *   cosine  s1.30   out: likewise
 *
 * Error: at most 2.0e-5 (draft) or 4.2e-8 (fine), absolute.
 * Cost:  two look-ups; three multiplications (draft) or five (fine).
 * From:  Taylor's series about the nearest of 512 angles a turn, of the first
 *        (draft) or second order (fine).
 */
void ql_sincos(ql_turn32_t turn, int32_t *sine, int32_t *cosine);

#endif
