/* ql_camera.h - pixel and subpixel position to ray */
/* SPDX-License-Identifier: MIT */

#ifndef QL_CAMERA_H
#define QL_CAMERA_H

#include "sample/ql_sampler.h"
#include "scene/ql_lens.h"
#include "scene/ql_ray.h"
#include "scene/ql_scene.h"

QL_C_BEGIN

/* A coordinate that is affine in the picture: at its top left corner, and its
 * steps per pixel. */
typedef struct {
    int64_t corner;
    int64_t right;
    int64_t down;
} ql_camera_axis_t;

/* The blob's camera for one picture size: x, y and z of the ray's origin (grid
 * units, s31.32), then of its direction (s1.30 with 16 more fraction bits). */
typedef struct {
    ql_camera_axis_t axes[6];
    QL_IF_BUILT(QL_CFG_LENS, ql_lens_t lens;)
} ql_camera_t;

/* One pixel of a picture, at the precision of a ray. */
typedef struct {
    int64_t corner[6]; /* as the axes, with 16 fraction bits less */
    const ql_camera_t *camera;
} ql_camera_pixel_t;

/* Make a camera ready for a picture size.
 *
 *   camera         -   out
 *   scene          -   open
 *   width, height  px  1..16384; pixels are square
 *   return         false if the picture, with the lens, reaches further than
 *                  2^30 grid units
 */
QL_MUST_CHECK bool ql_camera_init(ql_camera_t *camera, const ql_scene_t *scene,
        uint16_t width, uint16_t height);

/* Begin a pixel.
 *
 *   pixel   -   out
 *   camera  -   from ql_camera_init(); must outlive pixel
 *   x, y    px  from the top left
 */
void ql_camera_pixel(ql_camera_pixel_t *pixel, const ql_camera_t *camera,
        uint16_t x, uint16_t y);

/* The ray through a point of a pixel, entering the box of the scene.
 *
 *   pixel   -     from ql_camera_pixel()
 *   u       uq32  where in the pixel: right and down from its corner; the
 *                 top 15 bits of each count, as midpoints
 *   lens    uq32  where on the lens; not used without one
 *   ray     -     out; its origin only if true is returned
 *   return  false if the ray misses the box [0, 32767]^3; its direction is that
 *           of what is seen there
 *
 * Error: origin within an ulp of its format in each component, direction within
 *        that of ql_vec_to_dir() and, before it, 6 2^-30 in each component: of
 *        the picture's longest direction if that is above 1. So a lens that all
 *        but cancels a direction turns it, as a lens of sense never does. A
 *        point of the lens is that of ql_warp_plane_disk(), cut to 2^-15 grid
 *        units and to 2^-29 of a direction.
 */
bool ql_camera_ray(const ql_camera_pixel_t *pixel, ql_uniform2_t u,
        ql_uniform2_t lens, ql_ray_t *ray);

QL_C_END

#endif
