/* ql_table_error.h - what sines and roots of warps may err, by their tables */
/* SPDX-License-Identifier: MIT */

/* The formulas of math/ql_trig.h and ql_real.h, five parts in a hundred wider,
 * and rounding. With the default tables they are the bounds named there. */

#ifndef QL_TABLE_ERROR_H
#define QL_TABLE_ERROR_H

#include "base/ql_base.h"

/* Half a cell of the sine's table, rad; relative error of a root's entry. */
#define SINE_STEP (3.14159265358979 / (4 << QL_CFG_TABLE_BITS))
#define ROOT_STEP (0.5 / (1 << QL_CFG_TABLE_BITS))

#define TABLES_DEFAULT (QL_CFG_TABLE_BITS == 7 && QL_CFG_TABLE_LERP)

/* Good enough for claims of exact distributions. Coarser ones are a bias. */
#define TABLES_EXACT                                                           \
    (QL_CFG_TABLE_LERP && (QL_CFG_TABLE_BITS >= 7 || QL_CFG_PRECISION > 0))

/* ql_sincos(), absolute */
#define SINE_ERROR                                                             \
    (1.05 * SINE_STEP *                                                        \
                    (!QL_CFG_TABLE_LERP        ? 1                             \
                            : QL_CFG_PRECISION ? SINE_STEP * SINE_STEP / 6     \
                                               : SINE_STEP / 2) +              \
            2e-9)

/* ql_rsqrt_m(), relative */
#define RSQRT_ERROR (QL_CFG_PRECISION == 0 ? 2.3e-5 : 1.2e-9)

/* ql_rsqrt_warp_m(), relative */
#define WARP_ROOT_ERROR                                                        \
    (RSQRT_ERROR +                                                             \
            (TABLES_DEFAULT ? 0                                                \
                            : 1.05 * ROOT_STEP *                               \
                                      (!QL_CFG_TABLE_LERP ? 1                  \
                                              : QL_CFG_PRECISION               \
                                                      ? 3.4 * ROOT_STEP *      \
                                                                ROOT_STEP *    \
                                                                ROOT_STEP      \
                                                      : 1.5 * ROOT_STEP)))

/* What a bound with the default tables is with others. */
#define BY_TABLES(bound)                                                       \
    (TABLES_DEFAULT ? (bound) : (bound) + 2 * (SINE_ERROR + WARP_ROOT_ERROR))

#endif
