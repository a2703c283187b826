/* extent.h - how wide a scene is, and which of its meshes makes it so */
/* SPDX-License-Identifier: MIT */

#ifndef EXTENT_H
#define EXTENT_H

#include "scene/world/world.h"

/* The width of a box is its longest side. */
typedef struct {
    const char *name; /* of the mesh without which the scene is narrowest, or
                       * "a sphere" if without the spheres; NULL: no surfaces */
    double width;     /* of all of the scene */
    double without;   /* of all but that mesh */
    bool is_mesh;     /* and there is another mesh with faces */
} world_extent_t;

/* Find it. Faces without an edge do not count. The world must live on. */
world_extent_t extent_find(const world_t *world);

#endif
