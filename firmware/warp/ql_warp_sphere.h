/* ql_warp_sphere.h - points of the unit sphere, uniform or by their angles */
/* SPDX-License-Identifier: MIT */

/* A warp maps uniform u1, u2 to a domain; its density stands beside it with the
 * same name and _pdf. A uniform number stands for the midpoint of its interval.
 * "GI" is Dutre's Global Illumination Compendium (2003).
 *
 * Directions about an axis come in a local frame whose z is the axis;
 * ql_frame_to_world() turns them. How far one is from the axis is kept as
 * s = 1 - cos(theta), never as the cosine, because near the axis the cosine has
 * no bits left; sin^2(theta) = s (2 - s). */

#ifndef QL_WARP_SPHERE_H
#define QL_WARP_SPHERE_H

#include "math/ql_trig.h"
#include "math/vec/ql_vec.h"

#define QL_WARP_ONE_Q29 ((int32_t)1 << 29)

/* 1 / (4 pi), u0.32. */
#define QL_WARP_INV_4PI_UQ32 0x145f306eu

/* Uniform on the unit sphere; pdf 1/(4 pi) per solid angle.
 *
 *   u1, u2  uq32   uniform
 *   return  s2.29  unit vector: z = 1 - 2 u1, azimuth 2 pi u2
 *
 * Error: length within 2.0e-5 (draft) or 7e-9 (fine) of 1. The direction has
 *        the errors of square root and sine, and u1 (1 - u1) is cut to 2^-32:
 *        next to the poles that moves a point by up to 1.5 2^-30 / rho towards
 *        them, 3.8e-5 at most (u1 = 1; tests/unit/test_warp_sphere.c).
 * Cost:  one square root, one sine and cosine.
 * From:  GI (33).
 */
ql_vec3_t ql_warp_sphere(ql_uq32_t u1, ql_uq32_t u2);

/* Density of ql_warp_sphere(), per solid angle.
 *
 *   return  uq32  1/(4 pi)
 */
QL_INLINE ql_uq32_t ql_warp_sphere_pdf(void)
{
    return QL_WARP_INV_4PI_UQ32;
}

/* A point by its distance from the axis, azimuth and height.
 *
 *   rho      uq32    distance from the axis
 *   azimuth  turn32  about the axis
 *   z        s2.29   height
 *   return   s2.29   (rho cos, rho sin, z), x and y to nearest
 *
 * Cost: one sine and cosine, two multiplications.
 */
static inline ql_vec3_t ql_warp_sphere_polar(
        ql_uq32_t rho, ql_turn32_t azimuth, ql_q29_t z)
{
    int32_t sine, cosine;
    ql_vec3_t v;

    ql_sincos(azimuth, &sine, &cosine);
    /* s1.30 times u0.32, high word: s1.30, below 2^30 + 2^15 */
    v.x = ql_asr32(ql_mulhi_su32(cosine, rho) + 1, 1);
    v.y = ql_asr32(ql_mulhi_su32(sine, rho) + 1, 1);
    v.z = z;
    return v;
}

/* A point by how far it is from the axis.
 *
 *   s        real    1 - z in [0, 1]; above 1 points end at the horizon
 *   azimuth  turn32  about the axis
 *   return   s2.29   unit vector
 *
 * Error: z to nearest; x, y to nearest and the errors of square root and sine.
 * Cost:  one square root, one sine and cosine, three multiplications.
 */
static inline ql_vec3_t ql_warp_sphere_off_axis(
        ql_real_t s, ql_turn32_t azimuth)
{
    const ql_uq32_t fixed = ql_real_to_uq32(s);
    /* (2 - s) 2^31 in [2^31, 2^32), rounded down so that the sine is <= 1 */
    const ql_real_t rest = QL_REAL(~(fixed >> 1), -31);
    const ql_q29_t z = QL_WARP_ONE_Q29 - (int32_t)(((fixed >> 2) + 1) >> 1);

    return ql_warp_sphere_polar(
            ql_sqrt_uq32_of_real(ql_real_mul(s, rest)), azimuth, z);
}

#endif
