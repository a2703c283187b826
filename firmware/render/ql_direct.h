/* ql_direct.h - light that comes straight from the emitters */
/* SPDX-License-Identifier: MIT */

/* Emitters count exactly once. A vertex takes their light from points or
 * directions drawn towards them (ql_direct_light()), from rays drawn otherwise
 * that meet one (ql_direct_seen()), or from both, each weighed by its share.
 * Which, is said for every ray by its ql_sight_t. */

#ifndef QL_DIRECT_H
#define QL_DIRECT_H

#include "base/ql_settings.h"
#include "math/ql_rgb.h"
#include "film/ql_film.h"
#include "sample/ql_sampler.h"
#include "material/ql_bsdf.h"
#include "scene/ql_ray.h"
#include "scene/ql_scene.h"
#include "scene/ql_surface.h"

/* What every part of one camera path needs. */
typedef struct {
    const ql_scene_t *scene;
    const ql_settings_t *settings;
    const ql_sampler_t *sampler; /* started for this sample */
    ql_sum_t *sum;
    ql_diag_t *diag;
} ql_path_t;

/* How much of an emitter a ray counts. */
typedef enum {
    QL_SIGHT_NONE, /* nothing: it was counted where the ray began */
    QL_SIGHT_ALL,  /* all of it */
    QL_SIGHT_SHARE /* its share by the balance heuristic */
} ql_sight_kind_t;

typedef struct {
    ql_sight_kind_t kind;
#if QL_CFG_STRATEGIES
    ql_real_t pdf;            /* of its direction, times its lobe's chance */
    const ql_surface_t *from; /* where it began */
#endif
} ql_sight_t;

/* Estimate the light that a surface reflects from the emitters by points or
 * directions drawn towards them, and add it to a pixel. The strategies AREA,
 * SOLID_ANGLE and MIS do; for others nothing is added.
 *
 *   path       -  as above; its scene has lights
 *   dim        -  QL_DIM_BOUNCE(k) of this vertex
 *   bsdf       -  of the vertex
 *   carried    -  throughput before the vertex
 *   reflected  -  throughput times albedo
 *
 * Adds f cos Le V / (P pdf), for each emitter asked. Of a flat diffuse surface
 * and a triangle's area it is reflected Le (n.w)(-N.w) V / (2 pi P |w|^4), w
 * from the vertex to the point, n the unit normal, N = e1 x e2 of the emitter:
 * reflected/pi Le cos cos' / r^2 divided by the pdf P/area, with the square
 * roots cancelled. Exactly zero if either side faces away.
 * Error: relative 2^-26 and the rounding of the sum; directions add 2^-27.
 * From:  change of domain to the emitters' area; Veach, "Robust Monte Carlo
 *        Methods for Light Transport Simulation", 1997, 9.2 for the shares: of
 *        a cosine direction and a point it is g / (1 + g), where g is what is
 *        added for Le = reflected = 1.
 */
void ql_direct_light(const ql_path_t *path, uint32_t dim, const ql_bsdf_t *bsdf,
        const ql_rgb_t *carried, const ql_rgb_t *reflected);

/* Add what a ray sees an emitter shine.
 *
 *   path     -      as above
 *   sight    -      how much of it counts
 *   carried  -      throughput along the ray
 *   ray      -      the ray
 *   hit      -      what it hit, not NULL
 */
void ql_direct_seen(const ql_path_t *path, const ql_sight_t *sight,
        const ql_rgb_t *carried, const ql_ray_t *ray, const ql_hit_t *hit);

/* Likewise for a ray that leaves the scene: adds the sky. Of the ray only the
 * direction counts if all of the sky does.
 *
 *   path, sight, carried, ray  -  as above
 */
void ql_direct_sky(const ql_path_t *path, const ql_sight_t *sight,
        const ql_rgb_t *carried, const ql_ray_t *ray);

#endif
