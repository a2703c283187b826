/* ql_frame.h - a right-handed frame about a unit vector */
/* SPDX-License-Identifier: MIT */

#ifndef QL_FRAME_H
#define QL_FRAME_H

#include "math/vec/ql_vec.h"

/* A right-handed frame: s x t = n. */
typedef struct {
    ql_vec3_t s; /* s2.29 */
    ql_vec3_t t; /* s2.29 */
    ql_vec3_t n; /* s2.29, the local z */
} ql_frame_t;

/* Complete a unit normal to a frame.
 *
 *   frame  -      out; not NULL
 *   n      s2.29  unit vector, also (0, 0, +-1) and its neighbours; of any
 *                 other vector some frame is made, not an orthonormal one
 *
 * Error: lengths and dot products within 6e-9 of 1 and 0 for an n rounded to
 *        nearest.
 * Cost:  one reciprocal, five multiplications; no branch but a sign.
 * From:  Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1),
 *        2017.
 */
void ql_frame_from_normal(ql_frame_t *frame, ql_vec3_t n);

/* Turn a local direction to the world's axes.
 *
 *   frame   -      from ql_frame_from_normal()
 *   v       s2.29  length at most 2
 *   return  s2.29  v.x s + v.y t + v.z n, each to nearest
 *
 * Cost: nine multiplications to 64 bits.
 */
ql_vec3_t ql_frame_to_world(const ql_frame_t *frame, ql_vec3_t v);

#endif
