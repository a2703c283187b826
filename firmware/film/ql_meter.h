/* ql_meter.h - the exposure that a picture wants, from a few of its cells */
/* SPDX-License-Identifier: MIT */

/* The geometric mean of the luminance becomes a middle grey of 0.18 (Reinhard,
 * Stark, Shirley, Ferwerda, 2002, equations 1 and 2). Cells without light do
 * not count, so a black background changes nothing; a lamp or one bright sample
 * is a cell of many, and its logarithm is taken. And a tenth of the cells with
 * light may be brighter than white, no more. */

#ifndef QL_METER_H
#define QL_METER_H

#include "base/ql_settings.h"
#include "film/ql_film.h"

QL_C_BEGIN

/* Cells a side, and samples of a cell: two of each of four pixels. */
#define QL_METER_SIDE    8u
#define QL_METER_SAMPLES 2u
#define QL_METER_CELL    (4u * QL_METER_SAMPLES)

/* What cells with light were seen; all zero to begin. */
typedef struct {
    uint8_t count;
    int16_t stops_q8[QL_METER_SIDE * QL_METER_SIDE]; /* ascending */
} ql_meter_t;

/* Add a cell.
 *
 *   meter  -       of fewer than QL_METER_SIDE^2 cells
 *   sum    u40.24  of its QL_METER_CELL samples
 *
 * Its luminance is that of Rec. 709, in 256 parts; the logarithm is off by
 * 0.02.
 */
void ql_meter_add(ql_meter_t *meter, const ql_sum_t *sum);

/* The exposure.
 *
 *   meter   -    of all cells
 *   return  s.8  stops by which radiance units are to be made brighter; 0 if
 *                no cell has any light
 */
int16_t ql_meter_stops(const ql_meter_t *meter);

#if QL_CFG_METER
/* Is the exposure to be metered? */
QL_INLINE bool ql_meter_wanted(const ql_settings_t *settings)
{
    return settings->meter != 0;
}
#else
QL_INLINE bool ql_meter_wanted(const ql_settings_t *settings)
{
    (void)settings;
    return false;
}
#endif

QL_C_END

#endif
