/* double_pt.h - a path tracer in double precision that shares nothing */
/* SPDX-License-Identifier: MIT */

/* Written from the rendering equation, to be compared with the core: its own
 * OBJ reader, camera, random numbers, tree, triangle test and sampling, all in
 * double. Lambert surfaces that reflect on both sides, emitters that shine
 * from their front, light sampled by area, directions by cosine. */

#ifndef DOUBLE_PT_H
#define DOUBLE_PT_H

#include <stddef.h>
#include <stdint.h>

#define DPT_TRIANGLES_MAX 4096
#define DPT_NODES_MAX     (2 * DPT_TRIANGLES_MAX)
#define DPT_MATERIALS_MAX 16

typedef struct {
    double v[3];
} dpt_vec_t;

typedef struct {
    dpt_vec_t corner, e1, e2;
    dpt_vec_t normal; /* unit, from the counter-clockwise side */
    double area;
    unsigned material;
} dpt_triangle_t;

typedef struct {
    dpt_vec_t low, high;
    unsigned first, count; /* triangles; count 0: children first, first + 1 */
    int axis;              /* the first child is the lower one on it */
} dpt_node_t;

typedef struct {
    char name[32];
    double albedo[3], emission[3];
} dpt_material_t;

typedef struct {
    dpt_triangle_t triangles[DPT_TRIANGLES_MAX];
    dpt_node_t nodes[DPT_NODES_MAX];
    unsigned triangle_count, node_count;
    unsigned lights[DPT_TRIANGLES_MAX];
    unsigned light_count;
    double light_area; /* of all emitters: they are sampled as one area */
    dpt_material_t materials[DPT_MATERIALS_MAX];
    unsigned material_count;
} dpt_scene_t;

typedef struct {
    dpt_vec_t eye, look, up;
    double fov; /* vertical, degrees */
} dpt_camera_t;

/* Read an OBJ of v, f, usemtl and mtllib lines and its MTL's Kd and Ke.
 *
 *   scene   -  out
 *   path    -  the OBJ; its MTL lies beside it
 *   return  NULL, or what went wrong
 */
const char *dpt_read(dpt_scene_t *scene, const char *path);

/* Render.
 *
 *   scene, camera   -   as above
 *   width, height   px  of the picture
 *   side            -   side * side samples a pixel, stratified
 *   bounces         -   indirect reflections after the first hit
 *   seed            -   any
 *   rgb             -   out: radiance, 3 * width * height, rows from the top
 */
void dpt_render(const dpt_scene_t *scene, const dpt_camera_t *camera,
        unsigned width, unsigned height, unsigned side, unsigned bounces,
        uint64_t seed, double *rgb);

#endif
