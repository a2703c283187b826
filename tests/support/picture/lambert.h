/* lambert.h - form factors of polygons, and what area sampling makes of them */
/* SPDX-License-Identifier: MIT */

#ifndef LAMBERT_H
#define LAMBERT_H

#define LAMBERT_CORNERS_MAX 12

typedef struct {
    double corner[LAMBERT_CORNERS_MAX][3];
    int count;
} lambert_polygon_t;

/* Form factor E / (pi L) of a polygon seen from the origin by a receiver with
 * unit normal n: Lambert's formula on what lies above the horizon. The polygon
 * is counter-clockwise from its back, or the result is negative. */
double lambert_form_factor(const lambert_polygon_t *polygon, const double n[3]);

/* Mean, variance and fourth central moment of an estimator. */
typedef struct {
    double mean, variance, fourth;
} lambert_moments_t;

/* What is between the origin and w: 1 nothing, 0 something. */
typedef double (*lambert_visible_t)(const double w[3]);

/* Moments of A cos cos' / (pi r^2) for a point uniform on a parallelogram with
 * a corner and two sides, by the midpoint rule on side * side cells.
 *
 *   visible  -  NULL: nothing is in the way
 */
lambert_moments_t lambert_area_sampling(const double corner[3],
        const double a[3], const double b[3], const double n[3],
        lambert_visible_t visible, int side);

/* The same for a triangle. */
lambert_moments_t lambert_triangle_sampling(
        const double corner[3][3], const double n[3], int side);

#endif
