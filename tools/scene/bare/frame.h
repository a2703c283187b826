/* frame.h - a camera that has all of a mesh in its picture */
/* SPDX-License-Identifier: MIT */

#ifndef FRAME_H
#define FRAME_H

#include "scene/world/world.h"

/* Place a camera so that all faces fill a square picture but for a margin.
 *
 *   camera     -  out: eye and look; in: fov
 *   world      -  vertices and faces; y is up
 *   direction  -  towards the eye; x or z is not 0
 *
 * Exact but for the rounding of soft reals: the same on every host.
 */
void frame_all(
        world_camera_t *camera, const world_t *world, const int direction[3]);

/* Find a point beside another.
 *
 *   p          -  out
 *   from       -  the other
 *   direction  -  towards the eye; x or z is not 0
 *   way        -  to the right, up, and level towards the eye, in
 *   unit          of this length
 */
void frame_beside(double p[3], const double from[3], const int direction[3],
        const double way[3], double unit);

/* The box of all faces with an area; false if there are none. */
bool frame_box(const world_t *world, double low[3], double high[3]);

#endif
