/* test_warp_pdf.c - each warp's density integrates to 1, and is its own */
/* SPDX-License-Identifier: MIT */

#include <math.h>

#include "support/ql_double.h"
#include "support/ql_table_error.h"
#include "support/ql_test.h"
#include "warp/lecture/ql_warp_lecture.h"
#include "warp/ql_warp_cone.h"
#include "warp/ql_warp_hemisphere.h"
#include "warp/ql_warp_lobe.h"
#include "warp/ql_warp_plane.h"
#include "warp/ql_warp_sphere.h"
#include "warp/ql_warp_spherical.h"

enum { SIDE = 256, BINS = 16, PIECES = 256 };

/* Directions about z: where one is drawn, and the density there. */
typedef struct {
    const char *name;
    double low; /* z is low..1 */
    double (*draw)(uint32_t u1, uint32_t u2);
    double (*density)(double z);
} axial_t;

static double real(ql_real_t r)
{
    return ldexp(r.m, r.e);
}

static ql_q29_t q29(double x)
{
    return (ql_q29_t)lround(ldexp(x, 29));
}

static double height(ql_vec3_t v)
{
    return ldexp(v.z, -29);
}

static double draw_sphere(uint32_t u1, uint32_t u2)
{
    return height(ql_warp_sphere(u1, u2));
}

static double pdf_sphere(double z)
{
    (void)z;
    return ldexp(ql_warp_sphere_pdf(), -32);
}

static double draw_uniform(uint32_t u1, uint32_t u2)
{
    return height(ql_warp_hemisphere_uniform(u1, u2));
}

static double pdf_uniform(double z)
{
    (void)z;
    return ldexp(ql_warp_hemisphere_uniform_pdf(), -32);
}

/* The vector it returns has length 2 z. */
static double draw_cosine(uint32_t u1, uint32_t u2)
{
    const ql_vec3_t n = {0, 0, (int32_t)1 << 29};

    return sqrt(height(ql_warp_hemisphere_cosine(n, u1, u2)) / 2);
}

static double pdf_cosine(double z)
{
    return real(ql_warp_hemisphere_cosine_pdf(llround(ldexp(2 * z * z, 58))));
}

static const ql_uq16_t power = 5u << 15; /* 2.5 */

static double draw_lobe(uint32_t u1, uint32_t u2)
{
    ql_uq31_t s;

    return height(ql_warp_lobe(ql_warp_lobe_inverse(power), u1, u2, &s));
}

static double pdf_lobe(double z)
{
    return real(ql_warp_lobe_pdf(power, (ql_uq31_t)llround(ldexp(1 - z, 31))));
}

/* 1 - cos(theta_max) = 3/4. */
static const ql_real_t wide = {0xc0000000u, -32};

static double draw_cone(uint32_t u1, uint32_t u2)
{
    return height(ql_warp_cone(wide, u1, u2));
}

static double pdf_cone(double z)
{
    (void)z;
    return real(ql_warp_cone_pdf(wide));
}

static double draw_textbook(uint32_t u1, uint32_t u2)
{
    return height(ql_warp_lecture_cosine(u1, u2));
}

static double pdf_textbook(double z)
{
    return ldexp(ql_warp_lecture_cosine_pdf(q29(z)), -32);
}

static double draw_naive(uint32_t u1, uint32_t u2)
{
    return height(ql_warp_lecture_naive(u1, u2));
}

static double pdf_naive(double z)
{
    const ql_vec3_t w = {q29(sqrt(1 - z * z)), 0, q29(z)};

    return real(ql_warp_lecture_naive_pdf(w));
}

static const axial_t axial[] = {
        {"sphere", -1, draw_sphere, pdf_sphere},
        {"uniform hemisphere", 0, draw_uniform, pdf_uniform},
        {"cosine hemisphere", 0, draw_cosine, pdf_cosine},
        {"cosine power", 0, draw_lobe, pdf_lobe},
        {"cone", 0.25, draw_cone, pdf_cone},
        {"textbook cosine", 0, draw_textbook, pdf_textbook},
        {"naive hemisphere", 0, draw_naive, pdf_naive},
};

/* Probability of z in a..b. Midpoints of 1 - z = t^2 (1 - a) soften the pole
 * of the naive hemisphere. */
static double mass(const axial_t *w, double a, double b)
{
    double sum = 0;

    for (int i = 0; i < PIECES; i++) {
        const double low = sqrt(1 - b), high = sqrt(1 - a);
        const double step = (high - low) / PIECES;
        const double t = low + (i + 0.5) * step;

        sum += w->density(1 - t * t) * 2 * t * step;
    }
    return 2 * PI * sum;
}

/* Largest difference of any bin's share of the samples from its mass by the
 * density of another warp. */
static double misfit(const axial_t *w, const axial_t *as)
{
    double hits[BINS] = {0}, worst = 0;

    for (uint32_t i = 0; i < SIDE * SIDE; i++) {
        const uint32_t u1 = i << 16 | 0x8000u, u2 = (i % SIDE) << 24;
        const double at = (w->draw(u1, u2) - as->low) / (1 - as->low) * BINS;

        hits[at < 0 ? 0 : at >= BINS ? BINS - 1 : (int)at]++;
    }
    for (int k = 0; k < BINS; k++) {
        const double step = (1 - as->low) / BINS, a = as->low + k * step;
        const double share = hits[k] / (SIDE * SIDE);

        worst = fmax(worst, fabs(share - mass(as, a, a + step)));
    }
    return worst;
}

TEST(densities_of_directions_integrate_to_1)
{
    for (size_t i = 0; i < sizeof axial / sizeof *axial; i++) {
        const double all = mass(&axial[i], axial[i].low, 1);

        CHECK(fabs(all - 1) < 2e-5, "%s: %.8f", axial[i].name, all);
    }
}

TEST(directions_fall_as_often_as_their_density_says)
{
    for (size_t i = 0; i < sizeof axial / sizeof *axial; i++) {
        const double worst = misfit(&axial[i], &axial[i]);

        CHECK(worst < BY_TABLES(5e-5), "%s: a bin is off by %.2g",
                axial[i].name, worst);
    }
}

TEST(the_density_of_another_warp_is_rejected)
{
    CHECK(misfit(&axial[1], &axial[2]) > 1e-2, "uniform as cosine");
    CHECK(misfit(&axial[6], &axial[1]) > 1e-2, "naive as uniform");
}

TEST(densities_of_triangles_times_their_measure_are_1)
{
    const ql_vec3_t corner[3] = {
            {-50, -50, 150}, {50, -50, 150}, {50, 50, 150}};
    const ql_real_t area = ql_real_scale(QL_REAL(0xa0000000u, -31), 7);
    ql_warp_spherical_t t;

    CHECK(fabs(real(ql_warp_plane_triangle_pdf(area)) * real(area) - 1) < 1e-8,
            "plane: %.12g", real(ql_warp_plane_triangle_pdf(area)));
    CHECK(ql_warp_spherical_begin(&t, corner[0], corner[1], corner[2]),
            "refused");
    CHECK(fabs(real(ql_warp_spherical_pdf(&t)) * real(t.solid_angle) - 1) <
                    1e-8,
            "spherical: %.12g", real(ql_warp_spherical_pdf(&t)));
}

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_warp_pdf", argc, argv);
    RUN(densities_of_directions_integrate_to_1);
    RUN(directions_fall_as_often_as_their_density_says);
    RUN(the_density_of_another_warp_is_rejected);
    RUN(densities_of_triangles_times_their_measure_are_1);
    return TEST_END();
}
