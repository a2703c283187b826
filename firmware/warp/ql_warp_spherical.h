/* ql_warp_spherical.h - uniform directions towards a triangle */
/* SPDX-License-Identifier: MIT */

#ifndef QL_WARP_SPHERICAL_H
#define QL_WARP_SPHERICAL_H

#include "math/ql_real.h"
#include "math/vec/ql_vec.h"

/* A triangle as seen from a point: what sampling needs of it, worked out once.
 * Its angle at a is alpha, its edge from a to b is c long. */
typedef struct {
    ql_vec3_t a, b;        /* s2.29: unit directions of two corners */
    ql_vec3_t towards_c;   /* s2.29: unit tangent of the edge from a to c */
    ql_real_t p;           /* tan(c / 2) sin(alpha) */
    ql_real_t q;           /* tan(c / 2) |cos(alpha)| */
    bool obtuse;           /* is cos(alpha) below 0? */
    ql_real_t solid_angle; /* sr */
} ql_warp_spherical_t;

/* See a triangle from a point.
 *
 *   t        -  out, if true is returned
 *   a, b, c  -  from the point to the corners, any unit, components below 2^24;
 *               in either sense of rotation
 *   return   false if it covers less than 3e-4 or more than 6.22 sr, which
 *            includes none at all: draw points of its area then
 *
 * Where an edge spans more than 120 degrees the corners change their names in
 * cyclic order, so that the longest edge is from c to a. Elsewhere a, b and c
 * keep theirs, which fixes what u1 and u2 mean.
 *
 * Error: solid angle relative, 1e-8, both precisions, slivers included: the
 *        triple product and the normals of the edges are exact integers.
 * Cost:  four square roots, four reciprocals, one arc tangent and about 60
 *        multiplications, some to 64 bits.
 * From:  tan(area / 2) = p / (cot(b / 2) + tan(c / 2) cos(alpha)) with b and c
 *        the edges that meet at a: Van Oosterom and Strackee, "The Solid Angle
 *        of a Plane Triangle", 1983, in half angles, so that nothing cancels.
 */
bool ql_warp_spherical_begin(
        ql_warp_spherical_t *t, ql_vec3_t a, ql_vec3_t b, ql_vec3_t c);

/* Uniform on a spherical triangle; pdf 1/solid_angle per solid angle.
 *
 *   t       -      from ql_warp_spherical_begin()
 *   u1, u2  uq32   uniform; u1 is the share of the area between the edge from a
 *                  to b and the arc from b through the direction, u2 that of
 *                  1 - cos along this arc, from b
 *   return  s2.29  unit vector
 *
 * Error: that of a u1 off by up to 2^-27, and then each component within 1e-8,
 *        or 1e-8 / sin(d) where the arc from b is d > 90 degrees long; length
 *        within 1e-8. Both precisions. In all, over 1.5 million triangles of
 *        every shape: 1.6e-6, from edges of almost 180 degrees.
 * Cost:  one square root, three reciprocals, two sines and about 60
 *        multiplications, some to 64 bits.
 * From:  Arvo, "Stratified Sampling of Spherical Triangles", SIGGRAPH 1995,
 *        with half angles for his cosines, because those of a small triangle
 *        cancel: the point x along the edge from a to c cuts off the area y
 *        where tan(x / 2) = sin(y / 2) / (p cos(y / 2) - q sin(y / 2)).
 */
ql_vec3_t ql_warp_spherical(
        const ql_warp_spherical_t *t, ql_uq32_t u1, ql_uq32_t u2);

/* Density of ql_warp_spherical(), per solid angle.
 *
 *   t       -     from ql_warp_spherical_begin()
 *   return  real  1 / solid_angle inside the triangle
 *
 * Error: relative, that of the solid angle and 2^-29.
 */
ql_real_t ql_warp_spherical_pdf(const ql_warp_spherical_t *t);

#endif
