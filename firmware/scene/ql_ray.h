/* ql_ray.h - rays, segments and hits */
/* SPDX-License-Identifier: MIT */

#ifndef QL_RAY_H
#define QL_RAY_H

#include "math/vec/ql_vec.h"

/* A ray from a point of the box [0, 32767]^3. A closest-hit ray has no end and
 * its direction's largest component is 2^(b-1)..2^b; a segment goes from origin
 * to origin + direction exactly, whatever its length. */
typedef struct {
    ql_vec3_t origin;    /* ql_pos_t */
    ql_vec3_t direction; /* ql_dir_t; ql_pos_t for a segment */
} ql_ray_t;

/* The nearest triangle or sphere along a ray. */
typedef struct {
    uint16_t tri_idx;
    bool front;  /* seen from its counter-clockwise side, or from outside */
    ql_uq30_t t; /* hit = origin + t direction */
    QL_IF_BUILT(QL_CFG_ORDER, uint64_t exact_t;) /* t = exact_t / exact_det */
    QL_IF_BUILT(QL_CFG_ORDER, uint64_t exact_det;)
} ql_hit_t;

#endif
