/* ql_lut.h - what each table holds, its format, its worst error */
/* SPDX-License-Identifier: MIT */

/* All tables come from tools/lut/lut_main.c and are regenerated and compared by
 * the tests. Their worst errors stand beside them in ql_lut_data.c. */

#ifndef QL_LUT_H
#define QL_LUT_H

#include "base/ql_base.h"

QL_C_BEGIN

/* sin(i / QL_SIN_CELLS quarter turns), s1.30, both ends included. */
#define QL_SIN_BITS  QL_CFG_TABLE_BITS
#define QL_SIN_CELLS (1 << QL_SIN_BITS)
extern const int32_t ql_lut_sin[QL_SIN_CELLS + 1];

/* 1/sqrt(m) at the middle of each of these cells of m in [1/4, 1), u1.15. */
#define QL_RSQRT_CELLS (3 << (QL_CFG_TABLE_BITS - 1))
extern const uint16_t ql_lut_rsqrt[QL_RSQRT_CELLS];

/* 1/m at the middle of 128 cells of m in [1/2, 1), u1.15. */
#define QL_RECIP_CELLS 128
extern const uint16_t ql_lut_recip[QL_RECIP_CELLS];

/* The sRGB curve: 16 cells an octave of [2^-9, 1], both ends included;
 * 8-bit display values as u8.8. Below 2^-9 the curve is the line 12.92 x. */
#define QL_SRGB_OCTAVES 9
#define QL_SRGB_STEPS   16
extern const uint16_t ql_lut_srgb[QL_SRGB_OCTAVES * QL_SRGB_STEPS + 1];

/* The curves of film/ql_curve.h: 16 cells an octave of [2^-9, 8], both ends
 * included, u0.16; 1 is cut to 65535. */
#define QL_CURVE_OCTAVES 12
#define QL_CURVE_STEPS   16
extern const uint16_t ql_lut_filmic[QL_CURVE_OCTAVES * QL_CURVE_STEPS + 1];
extern const uint16_t ql_lut_reinhard[QL_CURVE_OCTAVES * QL_CURVE_STEPS + 1];

/* log2(ql_lut_recip[i] / 2^15), u0.32. */
extern const uint32_t ql_lut_log2[QL_RECIP_CELLS];

/* 1 - 2^(-i / QL_EXP2_CELLS), u0.32. */
#define QL_EXP2_BITS  6
#define QL_EXP2_CELLS (1 << QL_EXP2_BITS)
extern const uint32_t ql_lut_exp2[QL_EXP2_CELLS];

QL_C_END

#endif
