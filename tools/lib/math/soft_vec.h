/* soft_vec.h - vectors of real numbers, the same on every host */
/* SPDX-License-Identifier: MIT */

#ifndef SOFT_VEC_H
#define SOFT_VEC_H

#include "lib/math/soft.h"

typedef struct {
    soft_t k[3];
} soft_vec_t;

/* a, exactly; its numbers are finite. */
soft_vec_t soft_vec_from(const double a[3]);

/* Sums and products as soft_add() and soft_mul() round them, one after the
 * other from x to z. */
soft_vec_t soft_vec_add(soft_vec_t a, soft_vec_t b);
soft_vec_t soft_vec_sub(soft_vec_t a, soft_vec_t b);
soft_vec_t soft_vec_scale(soft_vec_t a, soft_t by);
soft_t soft_vec_dot(soft_vec_t a, soft_vec_t b);
soft_vec_t soft_vec_cross(soft_vec_t a, soft_vec_t b);

/* a / |a|; a is not 0. */
soft_vec_t soft_vec_unit(soft_vec_t a);

#endif
