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
#define AXIAL_MOMENTS(z, zz)                                                   \
    {                                                                          \
        {0, 0, z},                                                             \
        {                                                                      \
            (1 - (zz)) / 2, (1 - (zz)) / 2, zz, 0, 0, 0                        \
        }                                                                      \
    }

static void put_moments(warp_moments_t *m, double z, double zz)
{
    memset(m, 0, sizeof *m);
    m->mean[2] = z;
    m->second[0] = m->second[1] = (1 - zz) / 2;
    m->second[2] = zz;
}

/* Hemisphere, polar angle and azimuth evenly: not uniform. */

static void naive_draw(const uint32_t *u, warp_point_t *p)
{
    const ql_vec3_t v = ql_warp_lecture_naive(u[0], u[1]);

    put_direction(p, v);
    p->inside = p->inside && v.z >= 0;
    p->density = warp_real(ql_warp_lecture_naive_pdf(v));
}

static void naive_invert(const double *x, double *c)
{
    put_inverse(x, atan2(warp_sine(x), x[2]) / (PI / 2), c);
}

static double naive_density(const double *x)
{
    return 1 / (PI * PI * warp_sine(x));
}

/* Hemisphere and sphere, uniform. */

static void uniform_draw(const uint32_t *u, warp_point_t *p)
{
    const ql_vec3_t v = ql_warp_hemisphere_uniform(u[0], u[1]);

    put_direction(p, v);
    p->inside = p->inside && v.z >= 0;
    p->density = ql_warp_hemisphere_uniform_pdf() / TWO_32;
}

static void uniform_invert(const double *x, double *c)
{
    put_inverse(x, warp_from_axis(x), c);
}

static void sphere_draw(const uint32_t *u, warp_point_t *p)
{
    put_direction(p, ql_warp_sphere(u[0], u[1]));
    p->density = ql_warp_sphere_pdf() / TWO_32;
}

static void sphere_invert(const double *x, double *c)
{
    put_inverse(x, (1 - x[2]) / 2, c);
}

/* Cosine, twice, and powers of it. */

/* About z, as the renderer draws it about any normal: a vector of length
 * 2 cos(theta). Rounding moves directions next to the horizon, and the density
 * is that of the product before it. */
static void cosine_draw(const uint32_t *u, warp_point_t *p)
{
    const ql_vec3_t n = {0, 0, QL_WARP_ONE_Q29};
    const ql_vec3_t v = ql_warp_hemisphere_cosine(n, u[0], u[1]);
    const double length = sqrt((double)ql_vec_dot(v, v));

    p->x[0] = v.x / length;
    p->x[1] = v.y / length;
    p->x[2] = v.z / length;
    p->inside = v.z > 0;
    p->density = warp_real(ql_warp_hemisphere_cosine_pdf(ql_vec_dot(v, n)));
}

static void textbook_draw(const uint32_t *u, warp_point_t *p)
{
    const ql_vec3_t v = ql_warp_lecture_cosine(u[0], u[1]);

    put_direction(p, v);
    p->inside = p->inside && v.z > 0;
    p->density = ql_warp_lecture_cosine_pdf(v.z) / TWO_32;
}

static void cosine_invert(const double *x, double *c)
{
    const double from_axis = warp_from_axis(x);

    put_inverse(x, from_axis * (2 - from_axis), c);
}

static double cosine_density(const double *x)
{
    return x[2] / PI;
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

/* As that of a sphere, which is where the renderer's cones come from. */
static void cone_setup(warp_setup_t *s)
{
    const double sine = sin(s->parameter * DEGREE);
    int exponent;
    const double m = frexp(sine * sine, &exponent);
    const ql_real_t ratio2 = {(uint32_t)(m * TWO_32), (int16_t)(exponent - 32)};

    s->s_max = ql_warp_cone_of_sphere(ratio2);
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

static void disk_draw(const uint32_t *u, warp_point_t *p)
{
    ql_q29_t x, y;

    ql_warp_plane_disk(u[0], u[1], &x, &y);
    p->x[0] = x / ONE_Q29;
    p->x[1] = y / ONE_Q29;
    p->inside = warp_sine(p->x) <= 1 + MARGIN;
    p->density = ql_warp_plane_disk_pdf() / TWO_32;
}

static void disk_invert(const double *x, double *c)
{
    put_inverse(x, x[0] * x[0] + x[1] * x[1], c);
}

static void triangle_draw(const uint32_t *u, warp_point_t *p)
{
    uint32_t b1, b2;

    ql_warp_plane_triangle(u[0], u[1], &b1, &b2);
    p->x[0] = ldexp(b1, -QL_BARY_BITS);
    p->x[1] = ldexp(b2, -QL_BARY_BITS);
    p->inside = p->x[0] + p->x[1] < 1;
    /* where the weights have an area of 1/2 */
    p->density = warp_real(
            ql_warp_plane_triangle_pdf(ql_real_scale(QL_REAL_ONE, -1)));
}

static void triangle_invert(const double *x, double *c)
{
    const double rest = 1 - x[0];

    c[0] = 1 - rest * rest;
    c[1] = x[1] / rest;
}

static void tent_draw(const uint32_t *u, warp_point_t *p)
{
    const int32_t x = ql_warp_lecture_tent(u[0], u[1]),
                  y = ql_warp_lecture_tent(u[2], u[3]);

    p->x[0] = x / TWO_31;
    p->x[1] = y / TWO_31;
    p->inside = true;
    p->density = ql_warp_lecture_tent_pdf(x) / TWO_31 *
                 (ql_warp_lecture_tent_pdf(y) / TWO_31);
}

static void tent_invert(const double *x, double *c)
{
    for (int d = 0; d < 2; d++) {
        const double rest = 1 - fabs(x[d]), tail = rest * rest / 2;

        c[d] = x[d] < 0 ? tail : 1 - tail;
    }
}

static double tent_density(const double *x)
{
    return (1 - fabs(x[0])) * (1 - fabs(x[1]));
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
    p->density = warp_real(ql_warp_spherical_pdf(&s->spherical));
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
        {.name = "naive-hemisphere",
                .domain = "hemisphere",
                .density = "1/(pi^2 sin(theta)) per sr: not uniform",
                .source = "-",
                .kind = WARP_AXIAL,
                .dims = 3,
                .numbers = 2,
                .lecture = true,
                .draw_plain = naive_draw,
                .invert_plain = naive_invert,
                .density_plain = naive_density,
                .moments_const = AXIAL_MOMENTS(2 / PI, 1 / 2.0)},
        {.name = "uniform-hemisphere",
                .domain = "hemisphere",
                .density = "1/(2 pi) per sr",
                .source = "GI (34)",
                .kind = WARP_AXIAL,
                .dims = 3,
                .numbers = 2,
                .draw_plain = uniform_draw,
                .invert_plain = uniform_invert,
                .density_const = 1 / (2 * PI),
                .moments_const = AXIAL_MOMENTS(1 / 2.0, 1 / 3.0)},
        {.name = "uniform-sphere",
                .domain = "sphere",
                .density = "1/(4 pi) per sr",
                .source = "GI (33)",
                .kind = WARP_AXIAL,
                .dims = 3,
                .numbers = 2,
                .draw_plain = sphere_draw,
                .invert_plain = sphere_invert,
                .density_const = 1 / (4 * PI),
                .moments_const = AXIAL_MOMENTS(0, 1 / 3.0)},
        {.name = "cosine-hemisphere",
                .domain = "hemisphere",
                .density = "cos(theta)/pi per sr",
                .source = "GI (35)",
                .kind = WARP_AXIAL,
                .dims = 3,
                .numbers = 2,
                .density_floor = 0.05 / PI,
                .draw_plain = cosine_draw,
                .invert_plain = cosine_invert,
                .density_plain = cosine_density,
                .moments_const = AXIAL_MOMENTS(2 / 3.0, 1 / 2.0)},
        {.name = "cosine-power",
                .domain = "hemisphere",
                .density = "(m+1)/(2 pi) cos^m(theta) per sr",
                .source = "GI (36)",
                .kind = WARP_AXIAL,
                .dims = 3,
                .numbers = 2,
                .label = "m = %g",
                .n_parameters = 8,
                .parameters = {0, 1, 2, 2.5, 8, 16, 1000, 65535},
                .setup = power_setup,
                .draw = power_draw,
                .invert = power_invert,
                .density_at = power_density,
                .moments = power_moments},
        {.name = "uniform-cone",
                .domain = "cone about z",
                .density = "1/(2 pi (1 - cos(max))) per sr",
                .source = "GI (34)",
                .kind = WARP_AXIAL,
                .dims = 3,
                .numbers = 2,
                .label = "%g deg",
                .n_parameters = 3,
                .parameters = {30, 90, 0.1},
                .setup = cone_setup,
                .draw = cone_draw,
                .invert = cone_invert,
                .density_at = cone_density,
                .moments = cone_moments},
        {.name = "uniform-disk",
                .domain = "unit disk",
                .density = "1/pi per area",
                .source = "Shirley-Chiu 1997",
                .kind = WARP_DISK,
                .dims = 2,
                .numbers = 2,
                .draw_plain = disk_draw,
                .invert_plain = disk_invert,
                .density_const = 1 / PI,
                .moments_const = {.second = {1 / 4.0, 1 / 4.0}}},
        {.name = "uniform-triangle",
                .domain = "triangle",
                .density = "1/area per area",
                .source = "GI (18)",
                .kind = WARP_TRIANGLE,
                .dims = 2,
                .numbers = 2,
                .draw_plain = triangle_draw,
                .invert_plain = triangle_invert,
                .density_const = 2,
                .moments_const = {{1 / 3.0, 1 / 3.0, 0},
                        {1 / 6.0, 1 / 6.0, 0, 1 / 12.0}}},
        {.name = "spherical-triangle",
                .domain = "triangle of the sphere",
                .density = "1/(solid angle) per sr",
                .source = "Arvo 1995",
                .kind = WARP_DIRECTION,
                .dims = 3,
                .numbers = 2,
                .label = "radius %g deg",
                .n_parameters = 3,
                .parameters = {35, 60, 2},
                .setup = spherical_setup,
                .draw = spherical_draw,
                .invert = spherical_invert,
                .density_at = spherical_density,
                .moments = spherical_moments},
        {.name = "tent",
                .domain = "square [-1, 1]^2",
                .density = "(1 - |x|)(1 - |y|) per area",
                .source = "sum of two uniforms",
                .kind = WARP_TENT,
                .dims = 2,
                .numbers = 4,
                .lecture = true,
                .draw_plain = tent_draw,
                .invert_plain = tent_invert,
                .density_plain = tent_density,
                .moments_const = {.second = {1 / 6.0, 1 / 6.0}}},
        {.name = "cosine-textbook",
                .domain = "hemisphere",
                .density = "cos(theta)/pi per sr",
                .source = "GI (35)",
                .kind = WARP_AXIAL,
                .dims = 3,
                .numbers = 2,
                .lecture = true,
                .draw_plain = textbook_draw,
                .invert_plain = cosine_invert,
                .density_plain = cosine_density,
                .moments_const = AXIAL_MOMENTS(2 / 3.0, 1 / 2.0)},
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
    if (warp->setup != NULL) {
        warp->setup(s);
    }
}

void warp_draw(const warp_t *warp, const warp_setup_t *s, const uint32_t *u,
        warp_point_t *p)
{
    if (warp->draw != NULL) {
        warp->draw(s, u, p);
    } else {
        warp->draw_plain(u, p);
    }
}

void warp_invert(
        const warp_t *warp, const warp_setup_t *s, const double *x, double *c)
{
    if (warp->invert != NULL) {
        warp->invert(s, x, c);
    } else {
        warp->invert_plain(x, c);
    }
}

double warp_density(const warp_t *warp, const warp_setup_t *s, const double *x)
{
    return warp->density_at != NULL      ? warp->density_at(s, x)
           : warp->density_plain != NULL ? warp->density_plain(x)
                                         : warp->density_const;
}

void warp_moments(const warp_t *warp, const warp_setup_t *s, warp_moments_t *m)
{
    if (warp->moments != NULL) {
        warp->moments(s, m);
    } else {
        *m = warp->moments_const;
    }
}

void warp_numbers(ql_sampler_kind_t kind, uint32_t seed, uint32_t index,
        uint32_t u[WARP_NUMBERS])
{
    ql_sampler_t sampler;

    ql_sampler_begin(&sampler, (uint8_t)kind, seed, 0, 0);
    ql_sampler_start(&sampler, index);
    for (uint32_t pair = 0; pair < WARP_NUMBERS / 2; pair++) {
        const ql_uniform2_t two = ql_sampler_2d(&sampler, pair);

        u[2 * pair] = two.u1;
        u[2 * pair + 1] = two.u2;
    }
}
