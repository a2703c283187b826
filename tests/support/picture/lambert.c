/* lambert.c - form factors of polygons, and what area sampling makes of them */
/* SPDX-License-Identifier: MIT */

#include "support/picture/lambert.h"

#include <math.h>
#include <string.h>

#include "support/ql_double.h"

/* What of a polygon lies above the horizon. */
static lambert_polygon_t clip(const lambert_polygon_t *p, const double n[3])
{
    lambert_polygon_t out;

    memset(&out, 0, sizeof out);
    for (int i = 0; i < p->count; i++) {
        const double *a = p->corner[i], *b = p->corner[(i + 1) % p->count];
        const double above = dot3(a, n), next = dot3(b, n);

        if (above >= 0) {
            memcpy(out.corner[out.count++], a, sizeof out.corner[0]);
        }
        if ((above > 0 && next < 0) || (above < 0 && next > 0)) {
            for (int k = 0; k < 3; k++) {
                out.corner[out.count][k] =
                        (a[k] * next - b[k] * above) / (next - above);
            }
            out.count++;
        }
    }
    return out;
}

double lambert_form_factor(const lambert_polygon_t *polygon, const double n[3])
{
    const lambert_polygon_t p = clip(polygon, n);
    double sum = 0;

    for (int i = 0; i < p.count; i++) {
        const double *a = p.corner[i], *b = p.corner[(i + 1) % p.count];
        double g[3], size;

        cross3(a, b, g);
        size = sqrt(dot3(g, g));
        if (size > 0) {
            sum += atan2(size, dot3(a, b)) * dot3(n, g) / size;
        }
    }
    return sum / (2 * PI);
}

/* A cos cos' / (pi r^2) times A / normal's length: normal is that long. */
static double geometry(
        const double w[3], const double n[3], const double normal[3])
{
    const double r2 = dot3(w, w), cosine = dot3(w, n), other = -dot3(w, normal);

    return cosine > 0 && other > 0 ? cosine * other / (PI * r2 * r2) : 0;
}

/* Sums of powers 1 to 4 to central moments. */
static lambert_moments_t moments_of(const double power[4], double count)
{
    const double m1 = power[0] / count, m2 = power[1] / count;
    const double m3 = power[2] / count, m4 = power[3] / count;
    lambert_moments_t m;

    m.mean = m1;
    m.variance = m2 - m1 * m1;
    m.fourth = m4 - 4 * m1 * m3 + 6 * m1 * m1 * m2 - 3 * m1 * m1 * m1 * m1;
    return m;
}

static void add_powers(double power[4], double x)
{
    power[0] += x;
    power[1] += x * x;
    power[2] += x * x * x;
    power[3] += x * x * x * x;
}

lambert_moments_t lambert_area_sampling(const double corner[3],
        const double a[3], const double b[3], const double n[3],
        lambert_visible_t visible, int side)
{
    double power[4] = {0, 0, 0, 0}, normal[3];

    cross3(a, b, normal); /* as long as the area */
    for (int i = 0; i < side; i++) {
        for (int j = 0; j < side; j++) {
            double w[3], x;

            for (int k = 0; k < 3; k++) {
                w[k] = corner[k] + a[k] * (i + 0.5) / side +
                       b[k] * (j + 0.5) / side;
            }
            x = geometry(w, n, normal);
            add_powers(power, visible != NULL ? x * visible(w) : x);
        }
    }
    return moments_of(power, (double)side * side);
}

lambert_moments_t lambert_triangle_sampling(
        const double corner[3][3], const double n[3], int side)
{
    double power[4] = {0, 0, 0, 0}, e1[3], e2[3], normal[3];

    for (int k = 0; k < 3; k++) {
        e1[k] = corner[1][k] - corner[0][k];
        e2[k] = corner[2][k] - corner[0][k];
    }
    cross3(e1, e2, normal);
    for (int k = 0; k < 3; k++) {
        normal[k] /= 2; /* as long as the area */
    }
    /* cells i + j < side stand upright and, but for the last, upside down */
    for (int i = 0; i < side; i++) {
        for (int j = 0; j < 2 * (side - i) - 1; j++) {
            const double third = j % 2 == 0 ? 1 / 3.0 : 2 / 3.0;
            double w[3];

            for (int k = 0; k < 3; k++) {
                w[k] = corner[0][k] + e1[k] * (i + third) / side +
                       e2[k] * (j / 2 + third) / side;
            }
            add_powers(power, geometry(w, n, normal));
        }
    }
    return moments_of(power, (double)side * side);
}
