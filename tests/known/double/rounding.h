/* rounding.h - what each stage of the core does to an exact result */
/* SPDX-License-Identifier: MIT */

/* For tools/ref: each stage works out its result in double precision, then is
 * given the error that the core's own function makes there. Stages can be
 * chosen one by one; what no stage is chosen for stays exact. */

#ifndef ROUNDING_H
#define ROUNDING_H

#include "render/ql_line.h"
#include "ref/ref_parts.h"

typedef enum {
    ROUNDING_SINE,       /* sine and cosine */
    ROUNDING_ROOT,       /* reciprocal square root */
    ROUNDING_RECIPROCAL, /* of the geometry term */
    ROUNDING_ORIGIN,     /* of the camera's ray */
    ROUNDING_RAY,        /* its direction */
    ROUNDING_LIGHT,      /* point of a light */
    ROUNDING_COSINE,     /* direction, proportional to the cosine */
    ROUNDING_NORMAL,     /* unit normal */
    ROUNDING_FRAME,      /* its other axes, of uniform directions */
    ROUNDING_WAY,        /* ray parameter of a hit */
    ROUNDING_POINT,      /* hit point */
    ROUNDING_GEOMETRY,   /* geometry term, but for the reciprocal */
    ROUNDING_THROUGHPUT, /* times albedo, times emission */
    ROUNDING_SUM,        /* contributions */
    ROUNDING_STAGES
} rounding_stage_t;

#define ROUNDING_ALL (((uint32_t)1 << ROUNDING_STAGES) - 1)

/* Errors of one stage, in its unit. */
typedef struct {
    double worst, squares;
    double along; /* sum: of points how far above their surface */
    uint64_t count;
} rounding_error_t;

typedef struct {
    ref_rounding_t hooks;
    const ref_scene_t *scene;
    const ql_settings_t *settings;
    ql_camera_t camera;
    uint32_t on;    /* bits: stages that round */
    double coarser; /* times the core's error; 1 unless set */
    bool truncate;  /* a fault: sums are cut, not rounded */
    rounding_error_t error[ROUNDING_STAGES];
    ref_vec_t sphere;   /* the exact point that was drawn last */
    uint32_t route;     /* a hash of what rays met, since it was set */
    uint64_t fallbacks; /* directions rounded below their surface */
} rounding_t;

/* Begin with no stage on, and give the scene its hooks.
 *
 *   rounding  -  out; must outlive what is rendered with the scene
 *   scene     -  from ref_scene_init()
 *   settings  -  width and height are those of the picture
 */
void rounding_begin(rounding_t *rounding, ref_scene_t *scene,
        const ql_settings_t *settings);

/* Name of a stage, and the unit of its errors. */
const char *rounding_name(rounding_stage_t stage);
const char *rounding_unit(rounding_stage_t stage);

#endif
