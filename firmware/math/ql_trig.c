/* ql_trig.c - sine and cosine by table and Taylor's series */
/* SPDX-License-Identifier: MIT */

#include "math/ql_trig.h"

#include "math/ql_lut.h"

#define CELL_SHIFT (30 - QL_SIN_BITS) /* turn32 bits in one cell */

void ql_sincos(ql_turn32_t turn, int32_t *sine, int32_t *cosine)
{
    /* Nearest table angle, and the rest: |rest| <= 2^(CELL_SHIFT - 1). */
    const uint32_t near =
            (turn + ((uint32_t)1 << (CELL_SHIFT - 1))) >> CELL_SHIFT;
    const int32_t rest = ql_i32(turn - (near << CELL_SHIFT));
    const unsigned cell = near & (QL_SIN_CELLS - 1);
    const int32_t s0 = ql_lut_sin[cell];
    const int32_t c0 = ql_lut_sin[QL_SIN_CELLS - cell];

    /* rest 2 pi / 2^32 rad, scaled by 2^36: |delta| < pi 2^(36 - 9) < 2^29.
     * 0xc90fdaa2 is 2 pi 2^29. */
    const int32_t delta = ql_mulhi_su32(rest * 128, 0xc90fdaa2u);
    const uint32_t adelta = ql_abs32(delta);
    int32_t s, c, ds, dc;

#if QL_CFG_PRECISION > 0
    /* s + d (c - d s / 2), c - d (s + d c / 2): s1.30 times 2^36 is 2^66, the
     * high word 2^34; >> 5 makes it s1.30 and halves it */
    const int32_t half_s = (int32_t)(ql_mulhi_u32((uint32_t)s0, adelta) >> 5);
    const int32_t half_c = (int32_t)(ql_mulhi_u32((uint32_t)c0, adelta) >> 5);
    const int32_t cs = delta < 0 ? c0 + half_s : c0 - half_s;
    const int32_t sc = delta < 0 ? s0 - half_c : s0 + half_c;
#else
    const int32_t cs = c0, sc = s0;
#endif
    /* 2^34 to s1.30, to nearest */
    dc = ql_asr32(ql_mulhi_su32(cs, adelta) + 8, 4);
    ds = ql_asr32(ql_mulhi_su32(sc, adelta) + 8, 4);
    s = delta < 0 ? s0 - dc : s0 + dc;
    c = delta < 0 ? c0 + ds : c0 - ds;

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
