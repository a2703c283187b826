/* choose.h - the best way of finding light in a scene, by small pictures */
/* SPDX-License-Identifier: MIT */

#ifndef CHOOSE_H
#define CHOOSE_H

#include "scene/choose/choice.h"

/* All lights are asked at most if there are no more of them. */
enum { CHOOSE_ALL_MAX = 16 };

/* Render pilots (pilot.h) of a scene and choose, three things in turn:
 *
 *   - where there are a sky and other lights the sky's chance, its own, 1/4,
 *     1/16 or 1/64, as seen by area;
 *   - where there are few lights whether all are asked, as seen by mis, which
 *     no scene is bad for;
 *   - area, solid-angle or mis.
 *
 * What takes the least work is best; the sky keeps its chance, and the strategy
 * is one before the best in the order of choice_ways, which needs less code, if
 * that is within a tenth of the least.
 *
 *   model  -  complete; changed: auto_direct, auto_lights, trials of its
 *             header, and the chances of its lights. Without lights it is left
 *             as it is
 *   name   -  of the blob: begins the message if the core does not take it
 *   quiet  -  no progress bar
 *
 * The same on every host.
 * Cost: 37,000 paths a pilot; of them there are 3, or 4 where lights are few,
 *       and 4 more for a sky.
 */
void choose_way(model_t *model, const char *name, bool quiet);

#endif
