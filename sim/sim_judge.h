/* sim_judge.h - is the picture one that shows anything? */
/* SPDX-License-Identifier: MIT */

#ifndef SIM_JUDGE_H
#define SIM_JUDGE_H

#include <stdint.h>

#include "film/ql_curve.h"
#include "lib/sums/sums.h"

/* Warn if 99 pixels of 100 are black on a display, or 99 of 100 that are lit
 * white, and say which exposure would do: with it the geometric mean of what is
 * lit is a middle grey, 0.18 of white.
 *
 *   sums         -     settled, with some samples; rows without do not count
 *   exposure_q8  s7.8  stops that it is shown with beside the scene's own
 *   curve        -     that it is shown by: says what is white
 *
 * Cost: some nanoseconds a pixel.
 */
void sim_judge(const sums_t *sums, int16_t exposure_q8, ql_curve_t curve);

#endif
