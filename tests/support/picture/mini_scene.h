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
 * Anything a scene cannot hold ends the program. In a build without
 * QL_CFG_LIGHTS emitters do not shine; a tree is no deeper than
 * QL_CFG_BVH_STACK. */

#ifndef MINI_SCENE_H
#define MINI_SCENE_H

#include "scene/ql_scene.h"

#define MINI_TRIANGLES_MAX 2000
#define MINI_VERTICES_MAX  2000
#define MINI_MATERIALS_MAX 16
#define MINI_SPHERES_MAX   1000
#define MINI_TEXELS_MAX    4096
#define MINI_TABLES_MAX    8
#define MINI_WORDS_MAX     8192

/* Bits of the nodes that are built in: from .. to .., in steps of 8. */
#define MINI_BITS_MIN (QL_CFG_NODE8 ? 8u : 16u)
#define MINI_BITS_MAX (QL_CFG_NODE16 ? 16u : 8u)

/* A triangle, or a sphere if sphere is not 0: vertex[0] is its index. */
typedef struct {
    uint16_t vertex[3], material;
    bool sphere;
    uint16_t rank; /* if the scene has an order; may be set */
} mini_triangle_t;

typedef struct {
    double albedo[3], emission[3];
    double specular[3], parameter, chance;
    uint16_t gloss; /* ql_gloss_kind_t; 0: diffuse */
} mini_material_t;

typedef struct {
    /* What a test may set between mini_begin() and mini_open(). */
    ql_blob_camera_t camera;
    uint16_t width, height; /* px; 1 by 1 unless set */
    int radiance_exp;       /* 0 unless set; emission stays below 2^this */
    unsigned node_bits;     /* 16 or 8; the most built in unless set */
    unsigned leaf_max;      /* triangles, 1 to 13; 4 unless set */
    bool two_sided;         /* emitters */
    bool contact;           /* every face may touch another */
    bool order;             /* faces have ranks: the order of their making */
    bool hull;              /* one that no triangle and no position is of */

    /* Faults to plant: what a broken light table would say. */
    double light_weight_scale; /* 1 unless set */
    bool forget_light_pmf;     /* every weight as if P = 1 */

    /* What has been added. */
    int32_t vertices[MINI_VERTICES_MAX][3];
    unsigned vertex_count;
    mini_triangle_t triangles[MINI_TRIANGLES_MAX];
    unsigned triangle_count;
    mini_material_t materials[MINI_MATERIALS_MAX];
    unsigned material_count;
    double normals[MINI_VERTICES_MAX][3]; /* all 0: flat */
    bool smooth;                          /* there are any */
    ql_blob_sphere_t spheres[MINI_SPHERES_MAX];
    unsigned sphere_count;
    bool has_sky;
    double sky[3]; /* radiance; of a map its mean */
    ql_blob_sky_t sky_entry;
    double texels[MINI_TEXELS_MAX][3];
    ql_blob_distribution_t tables[MINI_TABLES_MAX];
    unsigned table_count;
    uint16_t words[MINI_WORDS_MAX];
    unsigned word_count;
    bool has_lens;
    ql_blob_lens_t lens;

    /* The blob, once open. */
    uint32_t blob[64 * MINI_TRIANGLES_MAX];
    size_t size_bytes;
} mini_scene_t;

/* Begin an empty scene seen from the middle of the box along +z. */
void mini_begin(mini_scene_t *m);

/* Add a gray material: albedo 0..1, radiance below 2^radiance_exp. */
uint16_t mini_material(mini_scene_t *m, double albedo, double emission);

/* Add a material with a colour. */
uint16_t mini_rgb(
        mini_scene_t *m, const double albedo[3], const double emission[3]);

/* Make a material more than diffuse: kind as ql_blob_gloss_t has it, specular
 * its Ks or Tf, parameter its Ns or Ni. The chance of the specular lobe is what
 * it reflects of all that is reflected, unless the material's own is set. */
void mini_gloss(mini_scene_t *m, uint16_t material, ql_gloss_kind_t kind,
        double specular, double parameter);
void mini_gloss_rgb(mini_scene_t *m, uint16_t material, ql_gloss_kind_t kind,
        const double specular[3], double parameter);

/* Add a sphere; all in 1/256 grid units. Returns its index among spheres. */
uint16_t mini_sphere(mini_scene_t *m, const int32_t centre[3], int32_t radius,
        uint16_t material);

/* Give a corner a normal, of any length from 2^-15 to 1 in each component. */
void mini_normal(mini_scene_t *m, uint16_t vertex, const double normal[3]);

/* Light from all around, in the units of emission. */
void mini_sky(mini_scene_t *m, double r, double g, double b);

/* A picture of it, width by height, row 0 around +y; turned by so many turns.
 * Its table follows the radiance as it is stored. */
void mini_sky_map(mini_scene_t *m, unsigned width, unsigned height,
        const double (*rgb)[3], double rotate);

/* Add a tabulated distribution of as many weights as count[0] count[1] ..., the
 * first index fastest; returns its index. */
uint16_t mini_table(mini_scene_t *m, unsigned dims, const uint16_t *count,
        const double *weights);

/* A lens: a point (a, b) of the unit disk adds a p[0] + b p[1] grid units to
 * the origin and a d[0] + b d[1] to the direction. */
void mini_lens(mini_scene_t *m, const double p[2][3], const double d[2][3]);

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

/* A ball around the middle of the box that faces inwards: eight triangles, the
 * sides of each cut into parts (63 at most). */
void mini_ball(mini_scene_t *m, int parts, uint16_t material);

/* A smooth ball of few faces, its front outwards: 3 parts around, 2 parts from
 * pole to pole. */
void mini_smooth_ball(mini_scene_t *m, const int32_t centre[3], int32_t radius,
        int parts, uint16_t material);

/* Look from a point, every ray along one direction of components below 2 in
 * size: all samples of all pixels meet the same point. */
void mini_eye(mini_scene_t *m, double x, double y, double z);
void mini_look(mini_scene_t *m, double x, double y, double z);

/* Spread the rays: added to the direction for one unit of the picture's plane
 * to the right, and up. */
void mini_field(mini_scene_t *m, const double right[3], const double up[3]);

/* Spread the origins likewise, in grid units: a parallel projection. */
void mini_window(mini_scene_t *m, const double right[3], const double up[3]);

/* Move everything in the box, the camera too, by whole grid units. */
void mini_move(mini_scene_t *m, int32_t x, int32_t y, int32_t z);

/* Write the blob and open it as the core would. */
void mini_open(mini_scene_t *m, ql_scene_t *scene);

#endif
