/* pilot.h - small pictures of a scene, one for each way of finding light */
/* SPDX-License-Identifier: MIT */

#ifndef PILOT_H
#define PILOT_H

#include "film/ql_film.h"
#include "lib/math/soft.h"
#include "scene/choose/choice.h"
#include "scene/ql_scene.h"

/* Both pictures of a pilot have the scene's shape, PILOT_PIXELS pixels at most
 * and PILOT_SPP samples a pixel. They are Sobol points of two seeds, so half of
 * the square of what they differ by is what either is off by. */
enum { PILOT_PIXELS = 2304, PILOT_SPP = 8, PILOT_PICTURES = 2 };

typedef struct {
    ql_sum_t *sums[PILOT_PICTURES]; /* u40.24 of each pixel */
    uint32_t pixels;                /* 1 or more */
    uint64_t instructions;          /* what both take on a Cortex-M3, draft */
} pilot_t;

/* Render the pictures of a way.
 *
 *   pilot  -  out
 *   scene  -  the blob, opened
 *   way    -  how light is found; all else is as QL_SETTINGS_DEFAULT has it
 *
 * Not for two threads at a time.
 */
void pilot_render(
        pilot_t *pilot, const ql_scene_t *scene, const choice_way_t *way);

/* What each pilot has to work for the same error.
 *
 *   work    -  out, count of them, above 0: relative squared error of a
 *              picture, (x - m)^2 / (m^2 + M^2 / 100), times the instructions.
 *              m is the mean of all pilots in the pixel, M that of the pixels;
 *              an error below 2^-20, which nobody sees, counts as that
 *   pilots  -  count of them, of one scene
 *   count   -  1 to 16
 *
 * The measure is relMSE of qlux-diff; m is the same for all, so a way is not
 * forgiven a white dot because it raised its own mean.
 */
void pilot_compare(soft_t *work, const pilot_t *pilots, unsigned count);

void pilot_free(pilot_t *pilot);

#endif
