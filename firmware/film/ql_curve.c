/* ql_curve.c - curves that let highlights roll off before they are white */
/* SPDX-License-Identifier: MIT */

#include "film/ql_curve.h"

#include "math/lut/ql_lut.h"

#if QL_ROLL_OFF

#define WHITE_UQ16 65536u

/* Of one channel; the table has an entry more than cells. */
static uint32_t rolled_off(const uint16_t *table, ql_uq16_t linear)
{
    unsigned octave, step;
    uint32_t rest, low;

    if (linear >= QL_CURVE_WHITE * WHITE_UQ16) {
        return WHITE_UQ16;
    }
    if (linear < 128) { /* a line to the first entry */
        return (linear * table[0] + 64u) >> 7;
    }
    octave = 24 - ql_clz32(linear); /* 0 for [2^7, 2^8), .. 11 */
    linear <<= 11 - octave;         /* [2^18, 2^19) */
    step = octave * QL_CURVE_STEPS + (unsigned)(linear >> 14 & 15u);
    rest = linear & 16383u;
    low = table[step];
    /* entries grow: below 2^16 2^14 */
    return low + (((table[step + 1] - low) * rest + 8192u) >> 14);
}

void ql_curve_roll_off(ql_curve_t curve, ql_uq16_t linear[3])
{
    const bool filmic = QL_CFG_CURVES == 1 ||
                        (QL_CFG_CURVES == 3 && curve == QL_CURVE_FILMIC);
    const uint16_t *table = filmic ? ql_lut_filmic : ql_lut_reinhard;

    for (unsigned i = 0; i < 3 && curve != QL_CURVE_SRGB; i++) {
        linear[i] = rolled_off(table, linear[i]);
    }
}

#endif
