/* ref.h - the core's picture in double precision, with its random numbers */
/* SPDX-License-Identifier: MIT */

/* What is shared with the core is what is exact there: the check of the blob,
 * the random numbers and which decision takes which of them, choices among
 * integers. Camera, rays, surfaces, warps, densities, weights and sums are
 * worked out in double precision from the formulas. The paths of both are the
 * same ones, so pictures differ by the core's rounding and nothing else. */

#ifndef REF_H
#define REF_H

#include <stdbool.h>

#include "base/ql_settings.h"
#include "ref/ref_vec.h"
#include "scene/ql_scene.h"

/* A material: as its entries in the blob, in numbers. */
typedef struct {
    double albedo[3];
    double emission[3]; /* radiance units */
    double specular[3];
    double parameter;
    uint32_t chance; /* u1.31, as it is compared with */
    unsigned kind;   /* ql_gloss_kind_t; 0: diffuse only */
} ref_material_t;

/* A triangle or sphere, grid units. */
typedef struct {
    ref_vec_t corner;    /* of a sphere its centre */
    ref_vec_t e1, e2;    /* edges from there */
    ref_vec_t n;         /* e1 x e2 */
    double radius;       /* 0: a triangle */
    ref_vec_t normal[3]; /* of the corners, any length; if smooth */
    bool smooth;
    int32_t light; /* which light it is; -1: none */
    const ref_material_t *material;
} ref_shape_t;

/* A child of a pair of the BVH: leads on as the blob's link and meta. */
typedef struct {
    double low[3], high[3];
    unsigned link, meta;
} ref_node_t;

/* A scene ready to render. Materials may be changed before. */
typedef struct {
    const ql_scene_t *blob;
    ref_material_t *materials;
    ref_shape_t *shapes;
    ref_node_t *nodes;
    ref_vec_t p, pr, pu, d, dr, du; /* camera, as the blob has it */
    ref_vec_t lens_p[2], lens_d[2]; /* if there is a lens */
    double sky[3];                  /* if it is constant */
    double unit;                    /* one radiance unit, in units of Ke */

    /* ref_parts.h: what happens to exact results; NULL, as it is unless set:
     * nothing */
    const struct ref_rounding *rounding;
} ref_scene_t;

typedef struct {
    uint64_t paths, closest_rays, shadow_rays;
} ref_stats_t;

/* Turn the tables of a blob into numbers.
 *
 *   scene   -  out; ref_scene_free() gives its memory back
 *   blob    -  open; must outlive scene
 */
void ref_scene_init(ref_scene_t *scene, const ql_scene_t *blob);
void ref_scene_free(ref_scene_t *scene);

/* Add samples of one pixel.
 *
 *   scene     -   from ref_scene_init()
 *   settings  -   in range; width and height are those of the picture
 *   x, y      px  from the top left
 *   first     -   index of the first sample
 *   count     -   how many
 *   rgb       -   added to: sums in radiance units
 *   stats     -   counted up
 */
void ref_pixel(const ref_scene_t *scene, const ql_settings_t *settings,
        uint16_t x, uint16_t y, uint32_t first, uint32_t count, double rgb[3],
        ref_stats_t *stats);

#endif
