/* test_diffuse.c - Lambert's lobe against closed forms */
/* SPDX-License-Identifier: MIT */

#include "material/ql_diffuse.h"
#include "warp/ql_warp_hemisphere.h"
#include "support/seen_surface.h"

/* What the path tracer has always done; pictures depend on every bit. */
static ql_vec3_t cosine_direction(ql_uniform2_t u)
{
    const ql_vec3_t n = ql_vec_unit_q29_of_inv_n(surface.n, surface.inv_n);
    const ql_vec3_t d = ql_vec_to_dir(ql_warp_hemisphere_cosine(n, u.u1, u.u2));

    return ql_vec_dot_normal(d, surface.n) > 0 ? d : ql_vec_to_dir(n);
}

TEST(diffuse_directions_and_weights_are_the_old_bits)
{
    state = 1;
    set_albedo(0.3, 1, 0.7);
    for (long k = 0; k < MANY(200000); k++) {
        const uint64_t bits = stats_random(&state);
        ql_uniform2_t u = {(uint32_t)bits, (uint32_t)(bits >> 32)};
        ql_bsdf_sample_t sample;
        bool drawn;

        if (k % 8 == 0) {
            u.u1 = corners[k / 8 % CORNERS];
            u.u2 = corners[k / 8 / CORNERS % CORNERS];
        }
        set_normal(random_normal());
        see(true, vec(1, 2, 3));
        drawn = ql_bsdf_sample(&bsdf,
                k & 1 ? QL_DENSITY_COSINE : QL_DENSITY_BRDF, (uint32_t)k, u,
                &sample, NULL);
        CHECK(drawn && same(sample.wi, cosine_direction(u)) &&
                        !sample.specular && !sample.through,
                "n = %ld %ld %ld, u = %08lx %08lx", (long)surface.n.x,
                (long)surface.n.y, (long)surface.n.z, (unsigned long)u.u1,
                (unsigned long)u.u2);
        for (unsigned i = 0; i < 3; i++) {
            CHECK(sample.weight.c[i] == QL_LE32(material.albedo[i]) &&
                            sample.weight.e == 0,
                    "weight %08lx 2^%d", (unsigned long)sample.weight.c[i],
                    sample.weight.e);
        }
        CHECK(!ql_bsdf_sample(&bsdf, QL_DENSITY_SPECULAR, 0, u, &sample, NULL),
                "drew a lobe that is not there");
    }
}

/* The mean of the cosine of a cosine lobe is 2/3. */
static double drawn_cosine(draw_t draw)
{
    ql_bsdf_sample_t sample;

    return ql_bsdf_sample(&bsdf, density, draw.pick, draw.u, &sample, NULL)
                   ? cosine_to_normal(sample.wi)
                   : 0;
}

TEST(diffuse_directions_have_the_albedo_and_a_mean_cosine_of_2_3)
{
    estimate_t weight, cosine;

    set_albedo(0.6, 0, 0);
    see_at(30);
    density = QL_DENSITY_BRDF;
    weight = estimate(drawn_weight, 64);
    cosine = estimate(drawn_cosine, 256);
    CHECK(fabs(weight.mean - 0.6) < 1e-9 &&
                    fabs(cosine.mean - 2.0 / 3) <= WITHIN(cosine),
            "%.9f; %.6f +- %.6f", weight.mean, cosine.mean, cosine.error);
    NOTE("%.6f +- %.6f", cosine.mean, cosine.error);
}

TEST(black_surfaces_lose_all_light)
{
    const ql_uniform2_t u = {0x80000000u, 5};
    ql_bsdf_sample_t sample;

    set_albedo(0, 0, 0);
    see_at(30);
    CHECK(!ql_bsdf_sample(&bsdf, QL_DENSITY_BRDF, 0, u, &sample, NULL),
            "reflects");
}

#if QL_UNIFORM_DIRECTIONS
/* 2 cos, whose mean is 1. */
TEST(uniform_directions_have_the_mean_of_the_cosine)
{
    estimate_t e;

    set_albedo(0.6, 0, 0);
    see_at(30);
    density = QL_DENSITY_UNIFORM;
    e = estimate(drawn_weight, 256);
    CHECK(fabs(e.mean - 0.6) <= WITHIN(e) && e.most <= 1.2 + 1e-6,
            "%.6f +- %.6f, most %.9f", e.mean, e.error, e.most);
    NOTE("%.6f +- %.6f", e.mean, e.error);
}

#endif

#if QL_MIS
/* cos/pi of the direction as it was rounded; the root near the horizon costs
 * what the length of n + sphere point is off. */
TEST(diffuse_density_is_the_cosine_over_pi)
{
    double worst = 0;

    state = 3;
    set_albedo(1, 1, 1);
    for (long k = 0; k < MANY(200000); k++) {
        const uint64_t bits = stats_random(&state);
        ql_uniform2_t u = {(uint32_t)bits, (uint32_t)(bits >> 32)};
        ql_bsdf_sample_t sample;
        ql_real_t pdf;
        double cosine, error;

        if (k < CORNERS * CORNERS) {
            u.u1 = corners[k % CORNERS];
            u.u2 = corners[k / CORNERS];
        }
        set_normal(random_normal());
        see(true, vec(0, 0, 1));
        CHECK(ql_bsdf_sample(&bsdf, QL_DENSITY_BRDF, 0, u, &sample, &pdf) &&
                        pdf.m != 0,
                "k = %ld", k);
        cosine = cosine_to_normal(sample.wi);
        error = fabs(real(pdf) * PI - cosine);
        if (cosine > 0.05) {
            worst = fmax(worst, error);
            CHECK(error <= DRAWN_ERROR / cosine + ROUNDED,
                    "%.9g, not %.9g / pi", real(pdf), cosine);
        }
    }
    NOTE("worst %.2e above cos 0.05", worst);
}

#endif

#if QL_CFG_SMOOTH
/* Of a cosine lobe tilted by a, (1 + cos a) / 2 is above the plane. */
TEST(smooth_surfaces_lose_what_is_below_the_plane)
{
    for (int degrees = 10; degrees <= 80; degrees += 10) {
        estimate_t e;
        const double above = (1 + cos(degrees * PI / 180)) / 2;

        set_albedo(0.8, 0, 0);
        set_normal(tilted);
        set_shade(degrees);
        see(true, incoming_at(normal(), 0.3, 0));
        density = QL_DENSITY_COSINE;
        e = estimate(drawn_weight, 256);
        CHECK(fabs(e.mean - 0.8 * above) <= WITHIN(e) && e.most <= 0.8000001,
                "%d degrees: %.6f +- %.6f, not %.6f", degrees, e.mean, e.error,
                0.8 * above);
#if QL_UNIFORM_DIRECTIONS
        density = QL_DENSITY_UNIFORM;
        e = estimate(drawn_weight, 256);
        CHECK(fabs(e.mean - 0.8 * above) <= WITHIN(e),
                "uniform, %d degrees: %.6f +- %.6f, not %.6f", degrees, e.mean,
                e.error, 0.8 * above);
#endif
    }
}

#endif

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_diffuse", argc, argv);
    RUN(diffuse_directions_and_weights_are_the_old_bits);
    RUN(diffuse_directions_have_the_albedo_and_a_mean_cosine_of_2_3);
    RUN(black_surfaces_lose_all_light);
#if QL_UNIFORM_DIRECTIONS
    RUN(uniform_directions_have_the_mean_of_the_cosine);
#endif
#if QL_MIS
    RUN(diffuse_density_is_the_cosine_over_pi);
#endif
#if QL_CFG_SMOOTH
    RUN(smooth_surfaces_lose_what_is_below_the_plane);
#endif
    return TEST_END();
}
