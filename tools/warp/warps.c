/* warps.c - directions and points of the plane, and their closed forms */
/* SPDX-License-Identifier: MIT */

#include "warp/warps.h"

#include <math.h>
#include <string.h>

#include "lib/program/cli.h"
#include "sample/ql_sampler.h"
#include "warp/lecture/ql_warp_lecture.h"
#include "warp/ql_warp_cone.h"
#include "warp/ql_warp_hemisphere.h"
#include "warp/ql_warp_lobe.h"
#include "warp/ql_warp_plane.h"
#include "warp/ql_warp_sphere.h"
#include "warp/ql_warp_spherical.h"

#define PI      3.14159265358979323846
#define DEGREE  (PI / 180)
#define ONE_Q29 536870912.0  /* 2^29 */
#define TWO_31  2147483648.0 /* 2^31 */
#define TWO_32  4294967296.0 /* 2^32 */
#define MARGIN  1e-6         /* how far rounding may take a point outside */

double warp_real(ql_real_t r)
{
    return ldexp((double)r.m, r.e);
}

double warp_sine(const double *x)
{
    return hypot(x[0], x[1]);
}

double warp_from_axis(const double *x)
{
    const double square = x[0] * x[0] + x[1] * x[1];

    return x[2] > 0 ? square / (1 + x[2]) : 1 - x[2];
}

/* A direction; its length is right within the headers' 5.1e-8. */
static void put_direction(warp_point_t *p, ql_vec3_t v)
{
    const double x = v.x / ONE_Q29, y = v.y / ONE_Q29, z = v.z / ONE_Q29;

    p->x[0] = x;
    p->x[1] = y;
    p->x[2] = z;
    p->inside = fabs(x * x + y * y + z * z - 1) < MARGIN;
}

/* Of a density that depends on z only: its share of what is nearer to the axis
 * and the azimuth are uniform. */
static void put_inverse(const double *x, double share, double *c)
{
    const double turn = atan2(x[1], x[0]) / (2 * PI);

    c[0] = share;
    c[1] = turn < 0 ? turn + 1 : turn;
}

/* Of such a density, from the means of z and of z z. */
static void put_moments(warp_moments_t *m, double z, double zz)
{
    memset(m, 0, sizeof *m);
    m->mean[2] = z;
    m->second[0] = m->second[1] = (1 - zz) / 2;
    m->second[2] = zz;
}

static void no_setup(warp_setup_t *s)
{
    (void)s;
}

/* Hemisphere, polar angle and azimuth evenly: not uniform. */

static void naive_draw(
        const warp_setup_t *s, const uint32_t *u, warp_point_t *p)
{
    const ql_vec3_t v = ql_warp_lecture_naive(u[0], u[1]);

    (void)s;
    put_direction(p, v);
    p->inside = p->inside && v.z >= 0;
    p->density = warp_real(ql_warp_lecture_naive_pdf(v));
}

static void naive_invert(const warp_setup_t *s, const double *x, double *c)
{
    (void)s;
    put_inverse(x, atan2(warp_sine(x), x[2]) / (PI / 2), c);
}

static double naive_density(const warp_setup_t *s, const double *x)
{
    (void)s;
    return 1 / (PI * PI * warp_sine(x));
}

static void naive_moments(const warp_setup_t *s, warp_moments_t *m)
{
    (void)s;
    put_moments(m, 2 / PI, 0.5);
}

/* Hemisphere and sphere, uniform. */

static void uniform_draw(
        const warp_setup_t *s, const uint32_t *u, warp_point_t *p)
{
    const ql_vec3_t v = ql_warp_hemisphere_uniform(u[0], u[1]);

    (void)s;
    put_direction(p, v);
    p->inside = p->inside && v.z >= 0;
    p->density = ql_warp_hemisphere_uniform_pdf() / TWO_32;
}

static void uniform_invert(const warp_setup_t *s, const double *x, double *c)
{
    (void)s;
    put_inverse(x, warp_from_axis(x), c);
}

static double uniform_density(const warp_setup_t *s, const double *x)
{
    (void)s;
    (void)x;
    return 1 / (2 * PI);
}

static void uniform_moments(const warp_setup_t *s, warp_moments_t *m)
{
    (void)s;
    put_moments(m, 1 / 2.0, 1 / 3.0);
}

static void sphere_draw(
        const warp_setup_t *s, const uint32_t *u, warp_point_t *p)
{
    (void)s;
    put_direction(p, ql_warp_sphere(u[0], u[1]));
    p->density = 1 / (4 * PI); /* the core has no use for it */
}

static void sphere_invert(const warp_setup_t *s, const double *x, double *c)
{
    (void)s;
    put_inverse(x, (1 - x[2]) / 2, c);
}

static double sphere_density(const warp_setup_t *s, const double *x)
{
    (void)s;
    (void)x;
    return 1 / (4 * PI);
}

static void sphere_moments(const warp_setup_t *s, warp_moments_t *m)
{
    (void)s;
    put_moments(m, 0, 1 / 3.0);
}

/* Cosine, and powers of it. */

static void cosine_draw(
        const warp_setup_t *s, const uint32_t *u, warp_point_t *p)
{
    const ql_vec3_t v = ql_warp_lecture_cosine(u[0], u[1]);

    (void)s;
    put_direction(p, v);
    p->inside = p->inside && v.z > 0;
    p->density = ql_warp_lecture_cosine_pdf(v.z) / TWO_32;
}

static void cosine_invert(const warp_setup_t *s, const double *x, double *c)
{
    const double from_axis = warp_from_axis(x);

    (void)s;
    put_inverse(x, from_axis * (2 - from_axis), c);
}

static double cosine_density(const warp_setup_t *s, const double *x)
{
    (void)s;
    return x[2] / PI;
}

static void cosine_moments(const warp_setup_t *s, warp_moments_t *m)
{
    (void)s;
    put_moments(m, 2 / 3.0, 1 / 2.0);
}

static void power_setup(warp_setup_t *s)
{
    s->power = (ql_uq16_t)llround(s->parameter * 65536);
    s->parameter = s->power / 65536.0;
    s->inverse = ql_warp_lobe_inverse(s->power);
}

static void power_draw(
        const warp_setup_t *s, const uint32_t *u, warp_point_t *p)
{
    ql_uq31_t from_axis;
    const ql_vec3_t v = ql_warp_lobe(s->inverse, u[0], u[1], &from_axis);

    put_direction(p, v);
    p->inside = p->inside && v.z >= 0;
    p->density = warp_real(ql_warp_lobe_pdf(s->power, from_axis));
}

static void power_invert(const warp_setup_t *s, const double *x, double *c)
{
    const double log_cosine = log1p(-fmin(warp_from_axis(x), 1));

    put_inverse(x, -expm1((s->parameter + 1) * log_cosine), c);
}

static double power_density(const warp_setup_t *s, const double *x)
{
    const double m = s->parameter;
    const double log_cosine = log1p(-fmin(warp_from_axis(x), 1));

    return (m + 1) / (2 * PI) * (m > 0 ? exp(m * log_cosine) : 1);
}

static void power_moments(const warp_setup_t *s, warp_moments_t *m)
{
    const double n = s->parameter + 1;

    put_moments(m, n / (n + 1), n / (n + 2));
}

/* Cone, by its half-angle. */

/* 1 - cos of it, which loses no bits. */
static double cone_width(const warp_setup_t *s)
{
    const double half = sin(s->parameter * DEGREE / 2);

    return 2 * half * half;
}

static void cone_setup(warp_setup_t *s)
{
    int exponent;
    const double m = frexp(cone_width(s), &exponent);

    s->s_max.m = (uint32_t)(m * TWO_32);
    s->s_max.e = (int16_t)(exponent - 32);
}

static void cone_draw(const warp_setup_t *s, const uint32_t *u, warp_point_t *p)
{
    const ql_vec3_t v = ql_warp_cone(s->s_max, u[0], u[1]);

    put_direction(p, v);
    p->inside = p->inside &&
                warp_from_axis(p->x) <= cone_width(s) * (1 + 1e-5) + 1e-9;
    p->density = warp_real(ql_warp_cone_pdf(s->s_max));
}

static void cone_invert(const warp_setup_t *s, const double *x, double *c)
{
    put_inverse(x, warp_from_axis(x) / cone_width(s), c);
}

static double cone_density(const warp_setup_t *s, const double *x)
{
    (void)x;
    return 1 / (2 * PI * cone_width(s));
}

static void cone_moments(const warp_setup_t *s, warp_moments_t *m)
{
    const double width = cone_width(s);

    put_moments(m, 1 - width / 2, 1 - width + width * width / 3);
}

/* Disk, triangle, tent. */

static void disk_draw(const warp_setup_t *s, const uint32_t *u, warp_point_t *p)
{
    ql_q29_t x, y;

    (void)s;
    ql_warp_plane_disk(u[0], u[1], &x, &y);
    p->x[0] = x / ONE_Q29;
    p->x[1] = y / ONE_Q29;
    p->inside = warp_sine(p->x) <= 1 + MARGIN;
    p->density = ql_warp_plane_disk_pdf() / TWO_32;
}

static void disk_invert(const warp_setup_t *s, const double *x, double *c)
{
    (void)s;
    put_inverse(x, x[0] * x[0] + x[1] * x[1], c);
}

static double disk_density(const warp_setup_t *s, const double *x)
{
    (void)s;
    (void)x;
    return 1 / PI;
}

static void disk_moments(const warp_setup_t *s, warp_moments_t *m)
{
    (void)s;
    memset(m, 0, sizeof *m);
    m->second[0] = m->second[1] = 0.25;
}

static void triangle_draw(
        const warp_setup_t *s, const uint32_t *u, warp_point_t *p)
{
    uint32_t b1, b2;

    (void)s;
    ql_warp_plane_triangle(u[0], u[1], &b1, &b2);
    p->x[0] = ldexp(b1, -QL_BARY_BITS);
    p->x[1] = ldexp(b2, -QL_BARY_BITS);
    p->inside = p->x[0] + p->x[1] < 1;
    p->density = 2; /* where the weights have an area of 1/2 */
}

static void triangle_invert(const warp_setup_t *s, const double *x, double *c)
{
    const double rest = 1 - x[0];

    (void)s;
    c[0] = 1 - rest * rest;
    c[1] = x[1] / rest;
}

static double triangle_density(const warp_setup_t *s, const double *x)
{
    (void)s;
    (void)x;
    return 2;
}

static void triangle_moments(const warp_setup_t *s, warp_moments_t *m)
{
    (void)s;
    memset(m, 0, sizeof *m);
    m->mean[0] = m->mean[1] = 1 / 3.0;
    m->second[0] = m->second[1] = 1 / 6.0;
    m->second[3] = 1 / 12.0;
}

static void tent_draw(const warp_setup_t *s, const uint32_t *u, warp_point_t *p)
{
    const int32_t x = ql_warp_lecture_tent(u[0], u[1]),
                  y = ql_warp_lecture_tent(u[2], u[3]);

    (void)s;
    p->x[0] = x / TWO_31;
    p->x[1] = y / TWO_31;
    p->inside = true;
    p->density = ql_warp_lecture_tent_pdf(x) / TWO_31 *
                 (ql_warp_lecture_tent_pdf(y) / TWO_31);
}

static void tent_invert(const warp_setup_t *s, const double *x, double *c)
{
    (void)s;
    for (int d = 0; d < 2; d++) {
        const double rest = 1 - fabs(x[d]), tail = rest * rest / 2;

        c[d] = x[d] < 0 ? tail : 1 - tail;
    }
}

static double tent_density(const warp_setup_t *s, const double *x)
{
    (void)s;
    return (1 - fabs(x[0])) * (1 - fabs(x[1]));
}

static void tent_moments(const warp_setup_t *s, warp_moments_t *m)
{
    (void)s;
    memset(m, 0, sizeof *m);
    m->second[0] = m->second[1] = 1 / 6.0;
}

/* Spherical triangle. */

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double *a, const double *b, double *r)
{
    r[0] = a[1] * b[2] - a[2] * b[1];
    r[1] = a[2] * b[0] - a[0] * b[2];
    r[2] = a[0] * b[1] - a[1] * b[0];
}

static double volume(const double *a, const double *b, const double *c)
{
    double n[3];

    cross(b, c, n);
    return dot(a, n);
}

/* Solid angle of unit vectors, as Van Oosterom and Strackee. */
static double solid_angle(const double *a, const double *b, const double *c)
{
    const double t =
            2 * atan2(volume(a, b, c), 1 + dot(a, b) + dot(b, c) + dot(c, a));

    return t < -1e-9 ? t + 4 * PI : t;
}

/* Three corners about a direction that a picture shows from the front; the
 * parameter is about how many degrees they are from it. */
static void spherical_setup(warp_setup_t *s)
{
    static const double azimuth[3] = {10, 140, 255};
    static const double radius[3] = {1, 0.75, 1.15};
    const double tilt = 50 * DEGREE;
    ql_vec3_t v[3];

    for (int i = 0; i < 3; i++) {
        const double r = tan(radius[i] * s->parameter * DEGREE);
        const double x = r * cos(azimuth[i] * DEGREE);
        const double y = r * sin(azimuth[i] * DEGREE);
        const double p[3] = {
                x, -sin(tilt) + y * cos(tilt), cos(tilt) + y * sin(tilt)};
        const double scale = 8e6 / sqrt(dot(p, p)); /* below 2^24 */
        double length;

        v[i].x = (int32_t)lround(p[0] * scale);
        v[i].y = (int32_t)lround(p[1] * scale);
        v[i].z = (int32_t)lround(p[2] * scale);
        length = sqrt((double)ql_vec_dot(v[i], v[i]));
        s->corners[i][0] = v[i].x / length;
        s->corners[i][1] = v[i].y / length;
        s->corners[i][2] = v[i].z / length;
    }
    if (!ql_warp_spherical_begin(&s->spherical, v[0], v[1], v[2])) {
        cli_fail(CLI_INPUT, "spherical-triangle: the core refuses %.3g sr",
                solid_angle(s->corners[0], s->corners[1], s->corners[2]));
    }
}

static void spherical_draw(
        const warp_setup_t *s, const uint32_t *u, warp_point_t *p)
{
    put_direction(p, ql_warp_spherical(&s->spherical, u[0], u[1]));
    for (int i = 0; i < 3; i++) {
        p->inside = p->inside && volume(s->corners[i], s->corners[(i + 1) % 3],
                                         p->x) > -MARGIN;
    }
    p->density = 1 / warp_real(s->spherical.solid_angle);
}

static double spherical_whole(const warp_setup_t *s)
{
    return solid_angle(s->corners[0], s->corners[1], s->corners[2]);
}

/* The plane through b and the point meets the edge from c to a at d. The share
 * of a, b, d in the whole is uniform, and so is how far from b the point is,
 * by 1 - cos, compared with d. */
static void spherical_invert(const warp_setup_t *s, const double *x, double *c)
{
    const double *a = s->corners[0], *b = s->corners[1], *end = s->corners[2];
    double plane[3], edge[3], d[3], from_b[3], length;

    cross(b, x, plane);
    cross(end, a, edge);
    cross(plane, edge, d);
    length = sqrt(dot(d, d));
    length = dot(d, a) + dot(d, end) < 0 ? -length : length;
    for (int k = 0; k < 3; k++) {
        d[k] /= length;
        from_b[k] = x[k] - b[k];
    }
    c[0] = solid_angle(a, b, d) / spherical_whole(s);
    c[1] = dot(from_b, from_b) / 2;
    for (int k = 0; k < 3; k++) {
        from_b[k] = d[k] - b[k];
    }
    c[1] /= dot(from_b, from_b) / 2;
}

static double spherical_density(const warp_setup_t *s, const double *x)
{
    (void)x;
    return 1 / spherical_whole(s);
}

void warp_add_moments(const double *x, double weight, warp_moments_t *m)
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3;

        m->mean[i] += weight * x[i];
        m->second[i] += weight * x[i] * x[i];
        /* 3 is xy, 4 xz, 5 yz */
        m->second[2 + i + j] += weight * x[i] * x[j];
    }
}

/* By a midpoint rule over the flat triangle with the same corners, of 1024^2
 * pieces: error about 1e-6. */
static void spherical_moments(const warp_setup_t *s, warp_moments_t *m)
{
    enum { SIDE = 1024 };
    double sum = 0;

    memset(m, 0, sizeof *m);
    for (int i = 0; i < SIDE; i++) {
        for (int j = 0; j < SIDE; j++) {
            const double b1 = (i + 0.5) / SIDE;
            const double b2 = (1 - b1) * (j + 0.5) / SIDE;
            double x[3], length, weight;

            for (int k = 0; k < 3; k++) {
                x[k] = (1 - b1 - b2) * s->corners[0][k] +
                       b1 * s->corners[1][k] + b2 * s->corners[2][k];
            }
            length = sqrt(dot(x, x));
            weight = (1 - b1) / (length * length * length);
            for (int k = 0; k < 3; k++) {
                x[k] /= length;
            }
            warp_add_moments(x, weight, m);
            sum += weight;
        }
    }
    for (int k = 0; k < 6; k++) {
        m->mean[k % 3] /= k < 3 ? sum : 1;
        m->second[k] /= sum;
    }
}

static const warp_t warps[] = {
        {"naive-hemisphere", "hemisphere",
                "1/(pi^2 sin(theta)) per sr: not uniform", "-", WARP_AXIAL, 3,
                2, false, NULL, 1, {0}, no_setup, naive_draw, naive_invert,
                naive_density, naive_moments},
        {"uniform-hemisphere", "hemisphere", "1/(2 pi) per sr", "GI (34)",
                WARP_AXIAL, 3, 2, false, NULL, 1, {0}, no_setup, uniform_draw,
                uniform_invert, uniform_density, uniform_moments},
        {"uniform-sphere", "sphere", "1/(4 pi) per sr", "GI (33)", WARP_AXIAL,
                3, 2, true, NULL, 1, {0}, no_setup, sphere_draw, sphere_invert,
                sphere_density, sphere_moments},
        {"cosine-hemisphere", "hemisphere", "cos(theta)/pi per sr", "GI (35)",
                WARP_AXIAL, 3, 2, false, NULL, 1, {0}, no_setup, cosine_draw,
                cosine_invert, cosine_density, cosine_moments},
        {"cosine-power", "hemisphere", "(m+1)/(2 pi) cos^m(theta) per sr",
                "GI (36)", WARP_AXIAL, 3, 2, false, "m = %g", 8,
                {0, 1, 2, 2.5, 8, 16, 1000, 65535}, power_setup, power_draw,
                power_invert, power_density, power_moments},
        {"uniform-cone", "cone about z", "1/(2 pi (1 - cos(max))) per sr",
                "GI (34)", WARP_AXIAL, 3, 2, false, "%g deg", 3, {30, 90, 0.1},
                cone_setup, cone_draw, cone_invert, cone_density, cone_moments},
        {"uniform-disk", "unit disk", "1/pi per area", "Shirley-Chiu 1997",
                WARP_DISK, 2, 2, false, NULL, 1, {0}, no_setup, disk_draw,
                disk_invert, disk_density, disk_moments},
        {"uniform-triangle", "triangle", "1/area per area", "GI (18)",
                WARP_TRIANGLE, 2, 2, true, NULL, 1, {0}, no_setup,
                triangle_draw, triangle_invert, triangle_density,
                triangle_moments},
        {"spherical-triangle", "triangle of the sphere",
                "1/(solid angle) per sr", "Arvo 1995", WARP_DIRECTION, 3, 2,
                false, "radius %g deg", 3, {35, 60, 2}, spherical_setup,
                spherical_draw, spherical_invert, spherical_density,
                spherical_moments},
        {"tent", "square [-1, 1]^2", "(1 - |x|)(1 - |y|) per area",
                "sum of two uniforms", WARP_TENT, 2, 4, false, NULL, 1, {0},
                no_setup, tent_draw, tent_invert, tent_density, tent_moments},
};

const warp_t *warp_at(unsigned i)
{
    const unsigned n = sizeof warps / sizeof *warps;
    const warp_t *warp = i < n ? &warps[i] : &warps_over_cells[i - n];

    return warp->name != NULL ? warp : NULL;
}

const warp_t *warp_find(const char *name)
{
    for (unsigned i = 0; warp_at(i) != NULL; i++) {
        if (strcmp(warp_at(i)->name, name) == 0) {
            return warp_at(i);
        }
    }
    return NULL;
}

void warp_begin(const warp_t *warp, warp_setup_t *s, double parameter)
{
    memset(s, 0, sizeof *s);
    s->parameter = parameter;
    warp->setup(s);
}

void warp_numbers(
        bool sobol, uint32_t seed, uint32_t index, uint32_t u[WARP_NUMBERS])
{
    ql_sampler_t sampler;

    ql_sampler_begin(
            &sampler, sobol ? QL_SAMPLER_SOBOL : QL_SAMPLER_RANDOM, seed, 0, 0);
    ql_sampler_start(&sampler, index);
    for (uint32_t pair = 0; pair < WARP_NUMBERS / 2; pair++) {
        const ql_uniform2_t two = ql_sampler_2d(&sampler, pair);

        u[2 * pair] = two.u1;
        u[2 * pair + 1] = two.u2;
    }
}
