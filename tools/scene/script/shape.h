/* shape.h - the faces of boxes and quadrilaterals */
/* SPDX-License-Identifier: MIT */

#ifndef SHAPE_H
#define SHAPE_H

#include "scene/world/world.h"

/* Which side of a box is the front of its faces. */
typedef enum { SHAPE_OUTSIDE, SHAPE_INSIDE } shape_front_t;

/* Add a mesh of the 12 faces of a box to a world.
 *
 *   world     -  in, out
 *   low       -  a corner
 *   high      -  the opposite one, above low in x, y and z
 *   front     -  where their fronts are
 *   material  -  of the faces
 *   name      -  of the mesh, for messages
 */
void shape_box(world_t *world, const double low[3], const double high[3],
        shape_front_t front, uint32_t material, const char *name);

/* Add a mesh of a face of four corners, counter-clockwise from its front.
 * False, and no face is there, if they enclose nothing or cross. */
bool shape_quad(world_t *world, double (*corners)[3], uint32_t material,
        const char *name);

#endif
