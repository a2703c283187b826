/* build_camera.h - the camera as affine functions of the picture's plane */
/* SPDX-License-Identifier: MIT */

#ifndef BUILD_CAMERA_H
#define BUILD_CAMERA_H

#include "scene/blob/model.h"
#include "scene/mesh/grid.h"
#include "scene/world/world.h"

/* Fill in a camera and its lens, in host byte order.
 *
 *   camera  -  out
 *   lens    -  out: all zero if the camera is a pinhole
 *   world   -  has the camera
 *   grid    -  gives the units and the box
 *
 * If the box lies entirely in front of the eye, rays start on the plane through
 * its nearest corner, so distance costs no resolution. Directions are scaled by
 * a power of two so that they stay below 2^30 in pictures up to four times as
 * wide as high, or as wide as the scene's own. What a lens adds stays within
 * the same bounds.
 *
 * Error: half of the last bit of each field.
 * Fails: exit 2 if the eye is beside the box and further than 2^20 units away,
 *        if the picture at the box is wider than 2^30 units, or if the lens is
 *        wider than 256 times its focus.
 */
void build_camera(ql_blob_camera_t *camera, ql_blob_lens_t *lens,
        const world_t *world, const grid_t *grid);

#endif
