/* grid.h - the scene on its integer grid, and what that loses */
/* SPDX-License-Identifier: MIT */

/* The box of all faces and spheres is scaled so that its longest side goes from
 * GRID_LOW to GRID_HIGH; the others begin at GRID_LOW. The margin leaves room
 * for points that are pushed off a surface. From here on all is integers. */

#ifndef GRID_H
#define GRID_H

#include "scene/ql_blob.h"
#include "lib/math/soft.h"
#include "scene/world/world.h"

#define GRID_LOW  8
#define GRID_HIGH 32759

typedef struct {
    uint32_t vertex[3];
    uint32_t material; /* of the world */
    uint32_t sphere;   /* 1 + its index, then there are no vertices; or 0 */
    uint32_t source;   /* index among the faces of the world, or spheres */
    uint32_t gain;     /* of its emission, as gain.h packs it; 0: none */
} grid_face_t;

typedef struct {
    uint16_t (*vertices)[3]; /* no two equal, but for their normals */
    int16_t (*normals)[3];   /* s0.15, of each vertex: 0 if flat; or NULL */
    grid_face_t *faces;      /* none of zero area; spheres are faces too */
    ql_blob_sphere_t *spheres;
    uint32_t vertex_count;
    uint32_t face_count;
    uint32_t sphere_count;
    uint16_t low[3], high[3]; /* box of the faces; low > high if none */
    size_t flat_count;        /* faces dropped: no area as written */
    size_t tiny_count;        /* faces, spheres dropped: none on the grid */
    size_t double_count; /* faces dropped: another has corners and winding */
    size_t merged_count; /* vertices merged with another */
    size_t lost_count;   /* lamps without any face: gain_faces() counts */
    soft_t origin[3];    /* world = origin + (grid - GRID_LOW) unit */
    soft_t unit;
} grid_t;

/* Find the unit and the origin of a grid, from the box of everything.
 *
 *   grid   -  out: these two
 *   world  -  the scene
 */
void grid_fit(grid_t *grid, const world_t *world);

/* Put a world on the grid.
 *
 *   grid   -  out; grid_free() it
 *   world  -  the scene
 *
 * Nothing is smooth yet: smooth_corners() sees to that.
 * Of faces with the same corners in the same order the first one stays, so that
 * a lamp that is in the file twice shines once.
 *
 * Error: half a unit a coordinate, half of 1/256 a coordinate of a sphere.
 * Fails: exit 2 if more than 65,535 faces remain.
 */
void grid_round(grid_t *grid, const world_t *world);

/* The smallest box of grid points around a face. */
void grid_box(const grid_t *grid, const grid_face_t *face, uint16_t low[3],
        uint16_t high[3]);

/* The exact normal e1 x e2 of a triangle; each component is below 2^30 in size.
 */
void grid_normal(const grid_t *grid, const grid_face_t *face, int64_t n[3]);

void grid_free(grid_t *grid);

#endif
