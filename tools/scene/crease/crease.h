/* crease.h - normals where faces meet, split at creases */
/* SPDX-License-Identifier: MIT */

#ifndef CREASE_H
#define CREASE_H

#include "scene/world/world.h"

/* Give normals to faces that have none, where that is asked for.
 *
 *   world  -  in, out: normals are added; faces get their indices
 *
 * In a mesh with smoothing groups (s) faces of one group are smooth. In a mesh
 * that has neither those nor normals (vn), faces are if the .scene says smooth
 * and their normals differ by that angle at most; a warning says if there is no
 * such mesh. Triangles of one face in the file belong together in any case.
 * Faces meet at edges whose ends are in the same places and which they go along
 * in opposite directions; edges of more than 16 faces and those of a face and
 * its own back are creases in any case.
 *
 * The normal of a corner is the sum over the triangles around its vertex that
 * can be reached from its own across such edges: of their normals, as long as
 * their area is large, times their angles there.
 *
 * Error: of an angle 2^-44; a limit is a hundredth of a degree more than said,
 *        for coordinates are rounded.
 * Cost:  n log n.
 * From:  G. Thuermer, C. A. Wuethrich, "Computing Vertex Normals from Polygonal
 *        Facets", Journal of Graphics Tools 3(1), 1998: the angles.
 */
void crease_world(world_t *world);

#endif
