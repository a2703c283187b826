/* mini_scene.h - build the blob of a small scene, on the grid itself */
/* SPDX-License-Identifier: MIT */

/* Coordinates are grid units, so a test knows where everything is without any
 * rounding:
 *
 *     mini_scene_t m;
 *     mini_begin(&m);
 *     mini_quad(&m, a, b, c, d, mini_material(&m, 1, 0));
 *     mini_eye(&m, x, y, z);
 *     ... mini_open(&m, &scene) ...
 *
 * Anything a scene cannot hold ends the program. */

#ifndef MINI_SCENE_H
#define MINI_SCENE_H

#include "scene/ql_blob.h"

#define MINI_TRIANGLES_MAX 2000
#define MINI_VERTICES_MAX  2000
#define MINI_MATERIALS_MAX 16

typedef struct {
    uint16_t vertex[3], material;
} mini_triangle_t;

typedef struct {
    /* What a test may set between mini_begin() and mini_open(). */
    ql_blob_camera_t camera;
    uint16_t width, height; /* px; 1 by 1 unless set */
    int radiance_exp;       /* 0 unless set; emission stays below 2^this */
    unsigned node_bits;     /* 16 or 8; 16 unless set */
    unsigned leaf_max;      /* triangles, 1 to 13; 4 unless set */
    bool two_sided;         /* emitters */

    /* Faults to plant: what a broken light table would say. */
    double light_weight_scale; /* 1 unless set */
    bool forget_light_pmf;     /* every weight as if P = 1 */

    /* What has been added. */
    int32_t vertices[MINI_VERTICES_MAX][3];
    unsigned vertex_count;
    mini_triangle_t triangles[MINI_TRIANGLES_MAX];
    unsigned triangle_count;
    struct {
        double albedo[3], emission[3];
    } materials[MINI_MATERIALS_MAX];
    unsigned material_count;

    /* The blob, once open. */
    uint32_t blob[64 * MINI_TRIANGLES_MAX];
    size_t size_bytes;
} mini_scene_t;

/* Begin an empty scene seen from the middle of the box along +z. */
void mini_begin(mini_scene_t *m);

/* Add a gray material: albedo 0..1, radiance below 2^radiance_exp. */
uint16_t mini_material(mini_scene_t *m, double albedo, double emission);

/* Add a corner; any number of triangles may share it. */
uint16_t mini_vertex(mini_scene_t *m, int32_t x, int32_t y, int32_t z);

/* Add a triangle, its front where a, b, c are counter-clockwise. */
void mini_triangle(mini_scene_t *m, const int32_t a[3], const int32_t b[3],
        const int32_t c[3], uint16_t material);
void mini_face(
        mini_scene_t *m, uint16_t a, uint16_t b, uint16_t c, uint16_t material);

/* Add two: a, b, c and a, c, d. */
void mini_quad(mini_scene_t *m, const int32_t a[3], const int32_t b[3],
        const int32_t c[3], const int32_t d[3], uint16_t material);

/* Add a closed axis-aligned box, its fronts inward. */
void mini_room(mini_scene_t *m, const int32_t low[3], const int32_t high[3],
        uint16_t material);

/* Look from a point, every ray along one direction of components below 2 in
 * size: all samples of all pixels meet the same point. */
void mini_eye(mini_scene_t *m, double x, double y, double z);
void mini_look(mini_scene_t *m, double x, double y, double z);

/* Spread the rays: added to the direction for one unit of the picture's plane
 * to the right, and up. */
void mini_field(mini_scene_t *m, const double right[3], const double up[3]);

/* Spread the origins likewise, in grid units: a parallel projection. */
void mini_window(mini_scene_t *m, const double right[3], const double up[3]);

/* Move everything, the camera too, by whole grid units. */
void mini_move(mini_scene_t *m, int32_t x, int32_t y, int32_t z);

/* Write the blob and open it as the core would. */
void mini_open(mini_scene_t *m, ql_scene_t *scene);

#endif
