/* ref_vec.h - vectors in double precision, and a random number's value */
/* SPDX-License-Identifier: MIT */

#ifndef REF_VEC_H
#define REF_VEC_H

#include <math.h>
#include <stdint.h>

#define REF_PI 3.14159265358979323846

typedef struct {
    double x, y, z;
} ref_vec_t;

static inline ref_vec_t ref_add(ref_vec_t a, ref_vec_t b)
{
    const ref_vec_t r = {a.x + b.x, a.y + b.y, a.z + b.z};

    return r;
}

static inline ref_vec_t ref_sub(ref_vec_t a, ref_vec_t b)
{
    const ref_vec_t r = {a.x - b.x, a.y - b.y, a.z - b.z};

    return r;
}

static inline ref_vec_t ref_scale(ref_vec_t a, double by)
{
    const ref_vec_t r = {a.x * by, a.y * by, a.z * by};

    return r;
}

/* a + b by */
static inline ref_vec_t ref_along(ref_vec_t a, ref_vec_t b, double by)
{
    return ref_add(a, ref_scale(b, by));
}

static inline double ref_dot(ref_vec_t a, ref_vec_t b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline ref_vec_t ref_cross(ref_vec_t a, ref_vec_t b)
{
    const ref_vec_t r = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
            a.x * b.y - a.y * b.x};

    return r;
}

static inline double ref_length(ref_vec_t a)
{
    return sqrt(ref_dot(a, a));
}

static inline ref_vec_t ref_unit(ref_vec_t a)
{
    return ref_scale(a, 1 / ref_length(a));
}

/* v - 2 (v.n) n of a unit vector n. */
static inline ref_vec_t ref_mirrored(ref_vec_t v, ref_vec_t n)
{
    return ref_along(v, n, -2 * ref_dot(v, n));
}

/* A u0.32 number stands for the midpoint of its interval. */
static inline double ref_midpoint(uint32_t u)
{
    return ldexp((double)u + 0.5, -32);
}

#endif
