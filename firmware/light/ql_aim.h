/* ql_aim.h - directions towards an emitter, and their density */
/* SPDX-License-Identifier: MIT */

/* How each strategy draws a direction towards one emitter, and with which
 * density per solid angle:
 *
 *              AREA, MIS                  SOLID_ANGLE
 *   triangle   point of its area          spherical triangle, or area if that
 *                                         is below 3e-4 or above 6.22 sr
 *   sphere     AREA: point of its area    cone it fills, or the cosine
 *              MIS: as SOLID_ANGLE        hemisphere if the surface is inside
 *   sky        map: its distribution      likewise
 *              constant: cosine hemisphere
 *
 * Densities here are those of one emitter; dividing by the probability of
 * choosing it is the caller's. */

#ifndef QL_AIM_H
#define QL_AIM_H

#include "math/ql_real.h"
#include "sample/ql_sampler.h"
#include "light/ql_light.h"
#include "scene/ql_ray.h"
#include "trace/ql_surface_at.h"

/* A direction towards an emitter. */
typedef struct {
    ql_vec3_t w;           /* s2.29: unit, above the surface */
    ql_real_t cosine;      /* to the shading normal, above 0 */
    ql_real_t inverse;     /* 1 / pdf per solid angle */
    ql_vec3_t to;          /* ql_pos_t: where it ends; not of the sky */
    ql_uq32_t emission[3]; /* radiance units */
} ql_aim_t;

/* Draw a direction.
 *
 *   scene    -  has lights
 *   direct   -  ql_direct_t: AREA, SOLID_ANGLE or MIS
 *   light    -  index of the light
 *   surface  -  to be lit
 *   u        -  chooses the direction
 *   aim      -  out, if true is returned
 *   return   false if nothing can come from there: the emitter faces away, or
 *            the direction is below the surface or the shading normal
 */
bool ql_aim_sample(const ql_scene_t *scene, unsigned direct, uint16_t light,
        const ql_surface_t *surface, ql_uniform2_t u, ql_aim_t *aim);

#if QL_CFG_STRATEGIES
/* 1 / density that ql_aim_sample() with MIS has for a direction that was drawn
 * otherwise.
 *
 *   scene    -      has lights
 *   surface  -      where it begins
 *   ray      -      the direction, ql_dir_t
 *   tri      -      what it hit, an emitter; NULL for the sky
 *   t        u2.30  where
 *   return   1 / pdf per solid angle; 0 for a density of 0
 */
ql_real_t ql_aim_inverse(const ql_scene_t *scene, const ql_surface_t *surface,
        const ql_ray_t *ray, const ql_blob_tri_t *tri, ql_uq30_t t);

#endif

/* Draw a point of a triangle that may shine towards a surface.
 *
 *   scene   -  has lights
 *   light   -  index of one that is a triangle
 *   p       -  ql_pos_t: of the surface
 *   u       -  chooses the point
 *   point   -  out: q stepped strictly in front, so that its own emitter never
 *              hides it; n turned to the side of p
 *   w       -  out: from p to point->q
 *   return  -n.w: the cosine at the emitter times |n| |w|; 0 if it faces away
 */
QL_INLINE uint64_t ql_aim_at_point(const ql_scene_t *scene, uint16_t light,
        ql_vec3_t p, ql_uniform2_t u, ql_light_point_t *point, ql_vec3_t *w)
{
    int64_t facing;

    ql_light_point(scene, light, u.u1, u.u2, point);
    *w = ql_vec_sub(point->q, p);
    if (ql_scene_two_sided(scene) && ql_vec_dot_normal(*w, point->n) > 0) {
        point->n = ql_vec_neg(point->n); /* |n| < 2^31 */
    }
    (void)ql_surface_step(&point->q, &point->corner, &point->n);
    *w = ql_vec_sub(point->q, p);
    facing = -ql_vec_dot_normal_ptr(w, &point->n);
    return facing > 0 ? (uint64_t)facing : 0;
}

#endif
