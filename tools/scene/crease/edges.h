/* edges.h - the edges of triangles, those in one place together */
/* SPDX-License-Identifier: MIT */

#ifndef EDGES_H
#define EDGES_H

#include "scene/world/world.h"

/* An edge as one face has it. Corners are counted 3 a face. */
typedef struct {
    uint32_t ends[2];    /* the places of its vertices, the lower one first */
    uint32_t corners[2]; /* there */
    bool forwards;       /* the face goes from the first to the second */
} edge_t;

/* For each vertex the lowest one in the same place; free() it. */
uint32_t *edges_places(const world_t *world);

/* The edges of some faces, those with the same ends one after the other, in the
 * order of faces; free() them.
 *
 *   faces   -  to take them of
 *   wanted  -  those that have edges
 *   count   -  of faces
 *   places  -  of edges_places()
 *   edges   -  out: how many there are
 */
edge_t *edges_sort(const world_face_t *faces, const bool *wanted, size_t count,
        const uint32_t *places, size_t *edges);

#endif
