/* ql_double.h - pi and products of vectors in double, for expected values */
/* SPDX-License-Identifier: MIT */

/* double_pt.c and float_pt.c have their own: tracers that share nothing. */

#ifndef QL_DOUBLE_H
#define QL_DOUBLE_H

#define PI 3.14159265358979323846

static inline double dot3(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* c = a x b; c is neither of them. */
static inline void cross3(const double a[3], const double b[3], double c[3])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

#endif
