/* fill.h - faces of many corners to triangles, as their outline is drawn */
/* SPDX-License-Identifier: MIT */

#ifndef FILL_H
#define FILL_H

#include "scene/world/world.h"

/* What makes the filling of a face a guess. */
typedef struct {
    bool crosses; /* its outline crosses itself */
    bool is_bent; /* its triangles have as much more area than is seen along its
                   * normal as halves that meet at 20 degrees, or more yet */
} fill_faults_t;

/* Fill the outline of a face with triangles, in place.
 *
 *   faults  -  out
 *   world   -  the scene; all vertices of the face are points
 *   fan     -  in: the face as a fan, triangles of its first corner and an edge
 *              each; out: triangles, counter-clockwise from its front
 *   count   -  triangles of the fan: corners - 2
 *   return  triangles now: count, but for corners that enclose nothing
 *
 * An outline may turn inwards, lie in any plane or in none, touch itself, run
 * twice along a bridge to a hole, repeat corners and come back the way it went.
 * A convex face stays a fan. Every corner of others is one of a triangle, also
 * in the middle of a straight side, but for those that are repeated and those
 * where the outline comes back. If one crosses itself, its corners are tried
 * on lattices of up to 2^-16 of its width, where what rounding took apart comes
 * together again; if it still does, it keeps its signed area, but triangles may
 * overlap.
 *
 * Exact: on corners rounded as plane_project() does it, or to such a lattice;
 *        every triangle faces forwards and none overlap, unless the outline
 *        crosses itself.
 * Cost:  grows as n^2 for n corners, as n if the face is convex.
 * From:  G. H. Meisters, "Polygons have ears", 1975.
 */
size_t fill_face(fill_faults_t *faults, const world_t *world, world_face_t *fan,
        size_t count);

#endif
