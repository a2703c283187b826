/* ref_parts.h - the parts of the tracer: rays, surfaces, warps, BSDF, lights */
/* SPDX-License-Identifier: MIT */

#ifndef REF_PARTS_H
#define REF_PARTS_H

#include "base/ql_density.h"
#include "ref/ref.h"
#include "sample/ql_sampler.h"

/* ---- Rays -------------------------------------------------------------- */

#define REF_NOWHERE 0xffffffffu

typedef struct {
    ref_vec_t origin, direction; /* unit direction */
    uint32_t from;               /* shape it leaves, or REF_NOWHERE */
    bool inside;                 /* of from, a sphere: it goes on inside */
} ref_ray_t;

typedef struct {
    uint32_t shape;
    bool front;
    double t;
    double u, v; /* of a triangle: weights of corners 1 and 2 */
} ref_hit_t;

/* A point of a surface, seen from the side of its normals. */
typedef struct {
    ref_vec_t p;
    ref_vec_t n;     /* unit, of the surface itself */
    ref_vec_t shade; /* unit shading normal; n where flat */
    bool smooth;
    bool inside; /* of a sphere: seen from inside */
    uint32_t shape;
} ref_surface_t;

struct ref_rounding; /* below; NULL: results stay exact */

/* The nearest shape along a ray; of equals the lowest index. */
bool ref_closest(
        const ref_scene_t *scene, const ref_ray_t *ray, ref_hit_t *hit);

/* Is anything on a ray before a distance, but for one shape? */
bool ref_blocked(const ref_scene_t *scene, const ref_ray_t *ray,
        double distance, uint32_t but);

/* The surface at a hit. */
void ref_surface_at(const ref_scene_t *scene, const ref_ray_t *ray,
        const ref_hit_t *hit, ref_surface_t *surface);

/* A side of a surface: where the point's normals lead, or the other one. */
typedef enum { REF_ABOVE, REF_BELOW } ref_side_t;

/* A ray that leaves a surface to a side. */
ref_ray_t ref_leave(
        const ref_surface_t *surface, ref_vec_t direction, ref_side_t side);

/* ---- Warps: the core's maps, numbers in [0, 1) -------------------------- */

ref_vec_t ref_warp_sphere(double u1, double u2);
ref_vec_t ref_warp_disk(double u1, double u2); /* z is 0 */
void ref_warp_triangle(double u1, double u2, double *b1, double *b2);

/* The direction with 1 - cos = s about an axis, azimuth u2 turns. */
ref_vec_t ref_warp_about(const struct ref_rounding *rounding, ref_vec_t axis,
        double s, double u2);

/* About a unit normal, proportional to the cosine: unit. */
ref_vec_t ref_warp_cosine(ref_vec_t n, double u1, double u2);

/* Uniform on a triangle as seen from the origin.
 *
 *   corner       -   towards the corners, any length
 *   w            -   out: unit direction, if true is returned
 *   solid_angle  sr  out
 *   return       false if it is drawn by points instead
 */
bool ref_warp_spherical(const ref_vec_t corner[3], double u1, double u2,
        ref_vec_t *w, double *solid_angle);

/* ---- How surfaces reflect ----------------------------------------------- */

typedef struct {
    const struct ref_rounding *rounding;
    const ref_surface_t *surface;
    const ref_material_t *material;
    ref_vec_t in;   /* unit direction that came */
    ref_vec_t axis; /* unit mirror direction, above the surface */
    bool front;
} ref_bsdf_t;

typedef struct {
    ref_vec_t direction;
    double weight[3]; /* f cos / (chance pdf) */
    double pdf;       /* per solid angle, times the chance */
    bool delta;
    ref_side_t side; /* where the direction leads */
} ref_bsdf_sample_t;

/* Which lobes a direction is drawn of. */
typedef enum { REF_LOBES_ALL, REF_LOBES_DELTA } ref_lobes_t;

void ref_bsdf_begin(ref_bsdf_t *bsdf, const struct ref_rounding *rounding,
        const ref_surface_t *surface, const ref_material_t *material,
        bool front, ref_vec_t incoming);

bool ref_bsdf_has_delta(const ref_bsdf_t *bsdf);
bool ref_bsdf_has_spread(const ref_bsdf_t *bsdf);

/* As ql_bsdf_sample(): same numbers, same lobes. */
bool ref_bsdf_sample(const ref_bsdf_t *bsdf, ql_density_t density,
        ref_lobes_t lobes, uint32_t pick, ql_uniform2_t u,
        ref_bsdf_sample_t *sample);

/* f cos inverse of each lobe for an albedo, a specular colour of 1, by the
 * balance heuristic with mis. */
void ref_bsdf_reflect(const ref_bsdf_t *bsdf, ref_vec_t w, double inverse,
        bool mis, double *diffuse, double *lobe);

/* Cosine to the shading normal; 0 if w is not above both normals. */
double ref_cosine(const ref_surface_t *surface, ref_vec_t w);

/* ---- Emitters ----------------------------------------------------------- */

typedef struct {
    ref_vec_t w;     /* unit */
    double inverse;  /* 1 / pdf per solid angle, of this emitter alone */
    double distance; /* to where it ends; HUGE_VAL of the sky */
    uint32_t shape;  /* that is aimed at; REF_NOWHERE of the sky */
    double emission[3];
} ref_aim_t;

/* The chance by which a light is chosen, times the samples drawn of it. */
double ref_light_chance(
        const ref_scene_t *scene, const ql_settings_t *s, uint32_t light);

/* Draw a direction towards a light; false if nothing comes from there. */
bool ref_aim(const ref_scene_t *scene, unsigned direct, uint32_t light,
        const ref_surface_t *surface, ql_uniform2_t u, ref_aim_t *aim);

/* 1 / the density of ref_aim() with MIS of a ray drawn otherwise, which met a
 * shape, or the sky: hit is NULL then. 0 for a density of 0. */
double ref_aim_inverse(const ref_scene_t *scene, const ref_surface_t *surface,
        ref_vec_t w, const ref_hit_t *hit);

/* Radiance of the sky; zero if there is none. */
void ref_sky(const ref_scene_t *scene, ref_vec_t w, double emission[3]);

/* ---- What a test may do to exact results -------------------------------- */

/* Each function is called with the exact result of a stage and may change it,
 * as the core's rounding of that stage does: tests/known/double/known_budget.c.
 * Any may be NULL. They are for diffuse surfaces and lights that are triangles,
 * drawn by points; other estimators pass them by. Vectors are in grid units. */
typedef struct ref_rounding {
    void *data; /* the first argument of each */

    /* The ray of a sample of pixel x, y. */
    void (*camera)(void *data, uint16_t x, uint16_t y,
            const ql_sampler_t *sampler, ref_ray_t *ray);

    /* The surface at a hit: where it is. */
    void (*point)(void *data, const ref_ray_t *ray, const ref_hit_t *hit,
            ref_surface_t *surface);

    /* The unit normal about which directions are drawn. */
    void (*normal)(void *data, const ref_surface_t *surface, ref_vec_t *n);

    /* The other two axes of a frame. */
    void (*frame)(void *data, ref_vec_t axis, ref_vec_t *right, ref_vec_t *up);

    /* A uniform point of the unit sphere. */
    void (*sphere)(void *data, double u1, double u2, ref_vec_t *v);

    /* n plus that point: a direction of any length. */
    void (*direction)(void *data, const ref_surface_t *surface, ref_vec_t n,
            ref_vec_t *w);

    /* From a surface to a point of a light, a triangle. */
    void (*light_point)(void *data, const ref_surface_t *surface,
            const ref_shape_t *shape, double u1, double u2, ref_vec_t *to);

    /* 1 / (pdf chance): the geometry term, but for the surface's cosine. */
    void (*geometry)(void *data, const ref_surface_t *surface,
            const ref_aim_t *aim, double *inverse);

    /* Throughput times albedo or emission. */
    void (*product)(void *data, double carried, double by, double *product);

    /* A contribution as it is added to a sum. */
    void (*contribution)(void *data, double *light);

    /* Changes nothing: told what each ray met, a shape or REF_NOWHERE; of a ray
     * towards a light 1 if it is blocked, 0 if not. */
    void (*met)(void *data, uint32_t what);
} ref_rounding_t;

#endif
