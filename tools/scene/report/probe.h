/* probe.h - what a ray of the core meets in a scene, for reports */
/* SPDX-License-Identifier: MIT */

#ifndef PROBE_H
#define PROBE_H

#include <stdbool.h>
#include <stdint.h>

#include "scene/mesh/grid.h"
#include "scene/ql_scene.h"

typedef struct {
    bool front;      /* of what was met */
    uint32_t index;  /* its place in the order of the tree */
    double distance; /* grid units */
} probe_t;

/* Cast a ray.
 *
 *   probe      -           out, if true is returned
 *   scene      -           open
 *   from       grid units  in the box of the scene and its margin
 *   direction  -           any length but 0
 *   return     true if it meets anything
 */
bool probe_cast(probe_t *probe, const ql_scene_t *scene, const double from[3],
        const double direction[3]);

/* Find the eye, in grid units. False if it is beside the scene. */
bool probe_eye(double eye[3], const world_t *world, const grid_t *grid);

#endif
