/* test_bsdf.c - both lobes together: chances, densities, MIS; extremes */
/* SPDX-License-Identifier: MIT */

#include "trace/surface/ql_shading.h"
#include "warp/ql_warp_lobe.h"
#include "support/seen_phong.h"

/* ---- Two lobes --------------------------------------------------------- */

#if QL_CFG_PHONG
/* 4 exponents, 3 views, 3 mixtures. */
TEST(every_density_has_the_same_mean)
{
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < VIEWS; k += 3) {
            for (int mix = 0; mix < 3; mix++) {
                const double kd = mix == 0 ? 0 : mix == 1 ? 0.3 : 0.75;
                const double ks = mix == 0 ? 1 : mix == 1 ? 0.6 : 0.25;

                set_phong(kd, ks, exponents[i],
                        mix == 0   ? 1
                        : mix == 1 ? 0.4
                                   : 0.2);
                see_at(views[k]);
                density = QL_DENSITY_BRDF;
                check_density(i, k, kd, ks);
                density = QL_DENSITY_COSINE;
                check_density(i, k, kd, ks);
#if QL_UNIFORM_DIRECTIONS
                density = QL_DENSITY_UNIFORM;
                check_density(i, k, kd, ks);
#endif
            }
        }
    }
}

TEST(colours_of_both_lobes_keep_apart)
{
    static const double kd[] = {0.5, 0.2, 0}, ks[] = {0.1, 0.7, 0.9};

    set_phong(0, 0, 20, 0.5);
    for (unsigned i = 0; i < 3; i++) {
        material.albedo[i] = uq31(kd[i]);
        gloss.specular[i] = uq31(ks[i]);
    }
    see_at(60);
    for (colour = 0; colour < 3; colour++) {
        density = QL_DENSITY_BRDF;
        check_density(3, 3, kd[colour], ks[colour]);
        density = QL_DENSITY_COSINE;
        check_density(3, 3, kd[colour], ks[colour]);
    }
    colour = 0;
}

/* A chance of 0 or 1 never divides by nothing. */
TEST(lobes_of_no_chance_are_never_drawn)
{
    for (int k = 0; k < CORNERS * CORNERS * CORNERS; k++) {
        const ql_uniform2_t u = {
                corners[k % CORNERS], corners[k / CORNERS % CORNERS]};
        const uint32_t pick = corners[k / (CORNERS * CORNERS)];
        ql_bsdf_sample_t sample;

        set_phong(0.5, 0.5, 20, 0);
        see_at(45);
        CHECK(ql_bsdf_sample(&bsdf, QL_DENSITY_BRDF, pick, u, &sample, NULL) &&
                        channel(&sample.weight, 0) == 0.5,
                "chance 0: weight %.9f", channel(&sample.weight, 0));
        set_phong(0.5, 0.5, 20, 1);
        see_at(45);
        if (ql_bsdf_sample(&bsdf, QL_DENSITY_BRDF, pick, u, &sample, NULL)) {
            CHECK(channel(&sample.weight, 0) <= 0.5 * 22 / 21 * (1 + 0x1p-29),
                    "chance 1: weight %.9f", channel(&sample.weight, 0));
        }
    }
}

#if QL_MIS
/* P (n + 1)/(2 pi) cos^n of the angle to the mirror direction, and (1 - P)
 * cos/pi. Rounding moves the angle by ROUNDED, so cos^n by n tan of it. */
TEST(densities_are_those_of_the_lobe_drawn)
{
    const double n = 20, chance = 0.3;
    double lobe = 0, diffuse = 0;

    set_phong(0.5, 0.4, n, chance);
    set_normal(tilted);
    state = 6;
    for (long k = 0; k < MANY(100000); k++) {
        const uint64_t bits = stats_random(&state);
        const ql_uniform2_t u = {(uint32_t)bits, (uint32_t)(bits >> 32)};
        const bool special = k & 1;
        const ql_vec3_t incoming = incoming_at(
                normal(), 1.4 * stats_random_unit(&state), 6.0 * (int)(k % 7));
        const point_t in = unit(from_vec(incoming));
        const point_t axis = along(in, -2 * dot(in, normal()), normal());
        ql_bsdf_sample_t sample;
        ql_real_t pdf;
        ql_uq31_t s;
        double got, exact, cosine, error;

        see(true, incoming);
        if (!ql_bsdf_sample(&bsdf, QL_DENSITY_BRDF, special ? 0 : 0xffffffffu,
                    u, &sample, &pdf)) {
            continue;
        }
        got = real(pdf);
        if (special) {
            cosine = dot(unit(from_vec(sample.wi)), axis);
            exact = chance * (n + 1) / (2 * PI) * pow(cosine, n);
            error = fabs(got / exact - 1);
            if (cosine > 0.3) {
                lobe = fmax(lobe, error);
                CHECK(error <= 1e-6 + 2 * n * (ROUNDED + DRAWN_ERROR) / cosine,
                        "lobe: %.9g, not %.9g", got, exact);
            }
            (void)ql_warp_lobe(
                    ql_warp_lobe_inverse((uint32_t)n << 16), u.u1, u.u2, &s);
            exact = real(ql_warp_lobe_pdf((uint32_t)n << 16, s)) * chance;
            CHECK(fabs(got / exact - 1) <= 0x1p-29, "lobe: %.9g, not %.9g", got,
                    exact);
        } else {
            cosine = cosine_to_normal(sample.wi);
            exact = (1 - chance) * cosine / PI;
            error = fabs(got - exact);
            if (cosine > 0.05) {
                diffuse = fmax(diffuse, error);
                CHECK(error <= DRAWN_ERROR / cosine + ROUNDED,
                        "diffuse: %.9g, not %.9g", got, exact);
            }
        }
    }
    NOTE("worst %.1e relative, lobe; %.1e diffuse", lobe, diffuse);
}

#endif

/* ---- Light from a known direction -------------------------------------- */

/* A cap of light about a direction of the surface's frame. */
static point_t cap_axis;
static double cap_s; /* 1 - cos of its rim */

static point_t cap_direction(draw_t draw)
{
    const double s = ldexp(draw.u.u1 + 0.5, -32) * cap_s;
    const double turn = ldexp(draw.u.u2 + 0.5, -32) * 2 * PI;
    const double rho = sqrt(s * (2 - s));
    point_t a, b, w;

    across(cap_axis, &a, &b);
    w = along(point(0, 0, 0), 1 - s, cap_axis);
    return along(along(w, rho * cos(turn), a), rho * sin(turn), b);
}

static double reflected(draw_t draw, ql_mis_t mis)
{
    const ql_vec3_t w = to_q29(cap_direction(draw));
    ql_real_t cosine = ql_shading_cosine(&surface, w), inverse;
    ql_rgb_t r;

    if (cosine.m == 0) {
        return 0;
    }
    cosine.e = (int16_t)(cosine.e - 29);
    inverse = ql_real_from_u64((uint64_t)ldexp(2 * PI * cap_s, 50));
    inverse.e = (int16_t)(inverse.e - 50);
    ql_bsdf_eval(&bsdf, w, cosine, inverse, mis, &r);
    return channel(&r, 0);
}

static double by_light(draw_t draw)
{
    return reflected(draw, QL_MIS_NONE);
}

TEST(light_from_all_around_is_reflected_by_the_albedo)
{
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < VIEWS; k += 3) {
            const double exact = 0.3 + 0.6 * albedos[i][k];
            estimate_t e;

            set_phong(0.3, 0.6, exponents[i], 0.5);
            see_at(views[k]);
            cap_axis = normal();
            cap_s = 1;
            e = estimate(by_light, 512);
            CHECK(fabs(e.mean - exact) <= WITHIN(e),
                    "n = %g, %g degrees: %.6f +- %.6f, not %.6f", exponents[i],
                    views[k], e.mean, e.error, exact);
        }
    }
}

#if QL_MIS
static bool in_cap(ql_vec3_t direction)
{
    return dot(unit(from_vec(direction)), cap_axis) > 1 - cap_s;
}

static double by_brdf(draw_t draw)
{
    ql_bsdf_sample_t sample;
    ql_real_t pdf;

    return ql_bsdf_sample(&bsdf, QL_DENSITY_BRDF, draw.pick, draw.u, &sample,
                   &pdf) && in_cap(sample.wi)
                   ? channel(&sample.weight, 0)
                   : 0;
}

static double density_scale; /* 1; a fault otherwise */

/* Both halves, the same numbers for each. */
static double by_both(draw_t draw)
{
    const double light = 1 / (2 * PI * cap_s);
    ql_bsdf_sample_t sample;
    ql_real_t pdf;
    double value = reflected(draw, QL_MIS_BALANCE);

    if (ql_bsdf_sample(
                &bsdf, QL_DENSITY_BRDF, draw.pick, draw.u, &sample, &pdf) &&
            in_cap(sample.wi)) {
        const double p = real(pdf) * density_scale;

        value += channel(&sample.weight, 0) * p / (p + light);
    }
    return value;
}

static void see_cap(double n, double wide)
{
    set_phong(0.4, 0.5, n, 0.35);
    see_at(50);
    /* off the mirror direction and across the horizon where it is wide */
    cap_s = wide;
    cap_axis = unit(along(from_vec(bsdf.mirror), 0x1p27, normal()));
}

TEST(light_and_directions_and_both_have_the_same_mean)
{
    double least = 1;

    for (int i = 1; i < 5; i++) {
        for (int k = 0; k < 3; k++) {
            estimate_t light, brdf, both;

            see_cap(exponents[i], k == 0 ? 0.02 : k == 1 ? 0.2 : 0.9);
            density_scale = 1;
            light = estimate(by_light, 512);
            brdf = estimate(by_brdf, 512);
            both = estimate(by_both, 512);
            least = fmin(least, light.mean);
            CHECK(fabs(light.mean - brdf.mean) <=
                                    WITHIN(light) + errors_max() * brdf.error &&
                            fabs(light.mean - both.mean) <=
                                    WITHIN(light) + errors_max() * both.error,
                    "n = %g, cap %d: %.6f +- %.6f, %.6f +- %.6f, %.6f +- %.6f",
                    exponents[i], k, light.mean, light.error, brdf.mean,
                    brdf.error, both.mean, both.error);
        }
    }
    NOTE("12 caps, the darkest %.4f", least);
}

/* The fault: the density without the chance of the lobe. */
TEST(a_density_without_the_chance_is_rejected)
{
    estimate_t light, both;

    see_cap(20, 0.2);
    density_scale = 2;
    light = estimate(by_light, 512);
    both = estimate(by_both, 512);
    CHECK(fabs(light.mean - both.mean) >
                    WITHIN(light) + errors_max() * both.error,
            "%.6f +- %.6f, %.6f +- %.6f", light.mean, light.error, both.mean,
            both.error);
    NOTE("%.4f, not %.4f", both.mean, light.mean);
}

#endif
#endif

/* ---- Extremes ---------------------------------------------------------- */

#if QL_SPECULAR
/* Along the surface, as near its plane as directions can be: whichever way
 * rounding goes, nothing is lost or lands on the plane. */
static void check_grazing(long *reflected_count, long *through)
{
    for (long k = 0; k < MANY(60000); k++) {
        const ql_uniform2_t u = {0, 0};
        ql_bsdf_sample_t sample;
        ql_real_t pdf, *const asked = QL_MIS ? &pdf : NULL;
        ql_vec3_t incoming;

        set_normal(random_normal());
        incoming = incoming_at(
                normal(), PI / 2, 2 * PI * stats_random_unit(&state));
        if (ql_vec_dot_normal(incoming, surface.n) >= 0) {
            continue;
        }
        see(k & 1, incoming);
        CHECK(ql_bsdf_sample(&bsdf, QL_DENSITY_SPECULAR,
                      k & 2 ? 0xffffffffu : 0, u, &sample, asked),
                "lost");
        check_sample(&sample, 1e6, asked);
        *reflected_count += !sample.through;
        *through += sample.through;
    }
}

TEST(grazing_rays_are_never_lost)
{
    long reflected_count = 0, through = 0;

    state = 9;
#if QL_CFG_MIRROR
    set_albedo(0, 0, 0);
    set_gloss(QL_GLOSS_MIRROR, 1, 0, 1);
    check_grazing(&reflected_count, &through);
#endif
#if QL_CFG_GLASS
    (void)set_glass(1);
    check_grazing(&reflected_count, &through);
    (void)set_glass(1 + 0x1p-16);
    check_grazing(&reflected_count, &through);
    (void)set_glass(1.5);
    check_grazing(&reflected_count, &through);
#endif
    CHECK(reflected_count > MANY(10000), "%ld", reflected_count);
    NOTE("%ld reflected, %ld through", reflected_count, through);
}

#endif

/* Every sample of the material that is set, at every corner of the random
 * numbers, seen along the normal and as grazing as 2^-15. */
static unsigned long extremes(double most)
{
    unsigned long count = 0;

    for (int axis = 0; axis < 27; axis++) {
        const ql_vec3_t n = vec((axis % 3 - 1) * 0x3fffffff,
                (axis / 3 % 3 - 1) * 0x3fffffff, (axis / 9 - 1) * 0x3fffffff);
        point_t s, t, d;

        if (axis == 13) {
            continue;
        }
        for (int k = 0; k < 8; k++) {
            set_normal(n);
            across(normal(), &s, &t);
            d = along(k & 1 ? s : t, -(k & 2 ? 1 : 0x1p-15), normal());
#if QL_CFG_SMOOTH
            if (k & 4) {
                set_shade(70);
            }
#endif
            see(k & 2, ql_vec_to_dir(to_q29(unit(d))));
            for (int i = 0; i < CORNERS * CORNERS * CORNERS; i++) {
                const ql_uniform2_t u = {
                        corners[i % CORNERS], corners[i / CORNERS % CORNERS]};
                const ql_density_t which = i % 3 == 0   ? QL_DENSITY_BRDF
                                           : i % 3 == 1 ? QL_DENSITY_COSINE
                                                        : QL_DENSITY_UNIFORM;
                ql_bsdf_sample_t sample;
                ql_real_t pdf, *const asked = QL_MIS && (i & 16) ? &pdf : NULL;

                if (ql_bsdf_sample(&bsdf, i & 8 ? QL_DENSITY_SPECULAR : which,
                            corners[i / (CORNERS * CORNERS)], u, &sample,
                            asked)) {
                    check_sample(&sample, which == QL_DENSITY_BRDF ? most : 1e6,
                            which == QL_DENSITY_BRDF ? asked : NULL);
                    count++;
                }
            }
        }
    }
    return count;
}

TEST(extremes_stay_on_their_side_and_below_their_weights)
{
    unsigned long count;

    set_albedo(1, 1, 1);
    count = extremes(1);
#if QL_CFG_PHONG
    for (int i = 0; i < EXPONENTS; i++) {
        set_phong(0, 1, exponents[i], 1);
        count += extremes((exponents[i] + 2) / (exponents[i] + 1));
    }
    set_phong(0.5, 0.5, 65535.99998, 0.5);
    count += extremes(1 + 1 / 65536.0);
#endif
#if QL_CFG_MIRROR
    set_albedo(0.5, 0.5, 0.5);
    set_gloss(QL_GLOSS_MIRROR, 0.5, 0, 0.5);
    count += extremes(1);
#endif
#if QL_CFG_GLASS
    for (int i = 0; i < INDICES; i++) {
        const double n = set_glass(indices[i]);

        count += extremes(fmax(n * n, 1 / (n * n)) * (1 + 1e-8));
    }
#endif
    CHECK(count > 10000, "%lu samples", count);
    NOTE("%lu samples", count);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_bsdf", argc, argv);
#if QL_CFG_PHONG
    RUN(every_density_has_the_same_mean);
    RUN(colours_of_both_lobes_keep_apart);
    RUN(lobes_of_no_chance_are_never_drawn);
#if QL_MIS
    RUN(densities_are_those_of_the_lobe_drawn);
#endif
    RUN(light_from_all_around_is_reflected_by_the_albedo);
#if QL_MIS
    RUN(light_and_directions_and_both_have_the_same_mean);
    RUN_IF(TABLES_EXACT, a_density_without_the_chance_is_rejected);
#endif
#endif
#if QL_SPECULAR
    RUN(grazing_rays_are_never_lost);
#endif
    RUN(extremes_stay_on_their_side_and_below_their_weights);
    return TEST_END();
}
