/* float_pt.h - the rival: the same path tracer in single precision */
/* SPDX-License-Identifier: MIT */

/* What one would write for speed, with an FPU and without: boxes and triangles
 * as floats, slabs with the inverse direction, both children of a node at once
 * and the nearer first, Moeller and Trumbore's triangle test without a division
 * on a miss, points on emitters, cosine-distributed directions in a frame. It
 * takes its tree and triangles from the blob, so that both tracers search the
 * same tree, and its random numbers from the core, so that both follow the same
 * paths. Walls around the scene are apart for both, as ql_hull.h has it. */

#ifndef FLOAT_PT_H
#define FLOAT_PT_H

#include "scene/ql_ray.h"
#include "scene/ql_scene.h"

typedef struct {
    float x, y, z;
} fp_vec_t;

/* Two children: bounds as low x, high x, low y, ... in grid units. */
typedef struct {
    float box[2][6];
    uint16_t link[2];  /* pair, or first triangle of a leaf */
    uint16_t count[2]; /* triangles of a leaf, 0 for a pair */
} fp_pair_t;

typedef struct {
    fp_vec_t v0, e1, e2;
} fp_tri_t;

/* What shading needs of a triangle. */
typedef struct {
    fp_vec_t n; /* unit */
    uint32_t material;
} fp_shade_t;

typedef struct {
    fp_vec_t albedo;   /* Kd */
    fp_vec_t emission; /* Ke, radiance units of the blob */
} fp_material_t;

typedef struct {
    float cdf;    /* upper bound of its part of [0, 1) */
    float weight; /* area / (pi P), P its chance */
    uint32_t triangle;
} fp_light_t;

typedef struct {
    fp_vec_t p, pr, pu, d, dr, du; /* as ql_blob_camera_t */
} fp_camera_t;

typedef struct {
    const fp_pair_t *pairs;
    const fp_tri_t *tris;
    const fp_shade_t *shades;
    const fp_material_t *materials;
    const fp_light_t *lights;
    uint32_t light_count;
    uint16_t root_link, root_count;
    /* What lies inside the scene's hull, a box within it, and its triangles:
     * those from hull_first to tri_count. Without a hull the box is empty. */
    uint16_t inner_link, inner_count;
    float hull_box[6]; /* low x, high x, low y, .. */
    uint32_t hull_first, tri_count;
    bool two_sided;
    fp_camera_t camera;
} fp_scene_t;

/* From origin onwards if t_max is FP_FAR, or a segment if it is below 1. */
typedef struct {
    fp_vec_t origin;
    fp_vec_t direction;
    float t_min, t_max; /* hits lie strictly between */
} fp_ray_t;

#define FP_FAR 1e30f

typedef struct {
    float t;
    uint32_t triangle;
    bool front;
} fp_hit_t;

/* Bytes that fp_open() needs for a scene. */
size_t fp_bytes(const ql_scene_t *scene);

/* Convert a scene; memory is fp_bytes() bytes, 4-byte aligned. */
void fp_open(fp_scene_t *fp, const ql_scene_t *scene, void *memory);

/* Convert a ray: its direction to unit length, or a segment of t in (0, 1). */
fp_ray_t fp_ray(const ql_ray_t *ray, bool segment);

/* Nearest triangle; false if none is hit. */
bool fp_closest(const fp_scene_t *fp, const fp_ray_t *ray, fp_hit_t *hit);

/* Is any triangle hit? */
bool fp_occluded(const fp_scene_t *fp, const fp_ray_t *ray);

/* Cosine-distributed unit vector about a unit normal, from [0, 1)^2. */
fp_vec_t fp_cosine_hemisphere(fp_vec_t n, float u1, float u2);

/* Add the light of some paths through a pixel to rgb, in radiance units.
 *
 *   fp             -   the scene
 *   x, y           px  in a picture of width x height
 *   first, count   -   samples
 *   bounces        -   indirect reflections
 *   rgb            -   added to
 */
void fp_pixel(const fp_scene_t *fp, unsigned x, unsigned y, unsigned width,
        unsigned height, uint32_t first, uint32_t count, unsigned bounces,
        float rgb[3]);

#endif
