/* test_mirror.c - mirror directions against the law of reflection */
/* SPDX-License-Identifier: MIT */

#include "material/ql_mirror.h"
#include "support/seen_surface.h"

#if QL_CFG_MIRROR
/* How far a flat mirror's direction is off v - 2 (v.n) n of the very v and n it
 * was made of, as a part of what rounding may change: v.n to nearest and then
 * each component. */
static double reflection_off(void)
{
    const int32_t v[3] = {bsdf.minus_wo.x, bsdf.minus_wo.y, bsdf.minus_wo.z};
    const int32_t n[3] = {bsdf.n.x, bsdf.n.y, bsdf.n.z};
    const int32_t r[3] = {bsdf.mirror.x, bsdf.mirror.y, bsdf.mirror.z};
    long double height = 0;
    double worst = 0;

    for (int k = 0; k < 3; k++) {
        height += (long double)v[k] * n[k];
    }
    for (int k = 0; k < 3; k++) {
        const long double exact = v[k] - ldexpl(2 * height * n[k], -58);
        const double may = 0.5 + 0.5 * ldexp(fabs((double)n[k]), -29);

        worst = fmax(worst, (double)fabsl(r[k] - exact) / may);
    }
    return worst;
}

/* Twice the error of the normal, 2^-26, and rounding. */
TEST(mirrors_reflect_at_equal_angles)
{
    double worst = 0, length = 0, bent = 0, ulps = 0;

    state = 7;
    set_albedo(0, 0, 0);
    set_gloss(QL_GLOSS_MIRROR, 1, 0, 1);
    for (long k = 0; k < MANY(100000); k++) {
        const ql_uniform2_t u = {(uint32_t)k, 7};
        ql_vec3_t incoming;
        point_t in;
        ql_bsdf_sample_t sample;
        ql_real_t pdf, *const asked = QL_MIS ? &pdf : NULL;
        double off;

        set_normal(random_normal());
        incoming = random_incoming();
        in = unit(from_vec(incoming));
        see(true, incoming);
        CHECK(ql_bsdf_sample(&bsdf,
                      k & 1 ? QL_DENSITY_SPECULAR : QL_DENSITY_UNIFORM,
                      (uint32_t)k, u, &sample, asked) &&
                        sample.specular && !sample.through,
                "lost");
        check_sample(&sample, 1, asked);
        off = angle(from_vec(sample.wi),
                along(in, -2 * dot(in, normal()), normal()));
        worst = fmax(worst, off);
        CHECK(off <= ROUNDED + 0x1p-24, "%.3g rad off", off);
        off = angle(from_vec(bsdf.mirror),
                along(in, -2 * dot(in, normal()), normal()));
        bent = fmax(bent, off);
        off = sqrt(dot(from_vec(bsdf.mirror), from_vec(bsdf.mirror)) /
                   dot(from_vec(bsdf.minus_wo), from_vec(bsdf.minus_wo)));
        length = fmax(length, fabs(off - 1));
        ulps = fmax(ulps, reflection_off());
    }
    /* a normal of a packed length is short by 2^-26 of it at most */
    CHECK(bent <= 0x1p-25 && length <= 0x1p-24, "%.3g rad, length %.3g", bent,
            length);
    CHECK(ulps <= 1 && ulps > 0.9, "%.3f of what rounding may change", ulps);
    NOTE("worst %.2f 2^-%d rad", ldexp(worst, QL_DIR_BITS), QL_DIR_BITS);
}

/* Both lobes, each divided by its chance; the delta lobe alone is not. */
TEST(mixed_mirrors_draw_each_lobe_with_its_chance)
{
    static const ql_density_t all[] = {
            QL_DENSITY_BRDF, QL_DENSITY_COSINE, QL_DENSITY_UNIFORM};

    set_albedo(0.5, 0.5, 0.5);
    set_gloss(QL_GLOSS_MIRROR, 0.25, 0, 0.25);
    see_at(40);
    CHECK(ql_bsdf_has_specular(&bsdf) && ql_bsdf_has_nonspecular(&bsdf),
            "lobes");
    for (int i = 0; i < (QL_UNIFORM_DIRECTIONS ? 3 : 2); i++) {
        estimate_t e;
        const ql_uniform2_t u = {0x12345678u, 0x9abcdef0u};
        ql_bsdf_sample_t sample;

        density = all[i];
        e = estimate(drawn_weight, 256);
        CHECK(fabs(e.mean - 0.75) <= WITHIN(e), "density %d: %.6f +- %.6f",
                density, e.mean, e.error);
        CHECK(ql_bsdf_sample(&bsdf, density, 0x3fffffffu, u, &sample, NULL) &&
                        sample.specular &&
                        fabs(channel(&sample.weight, 0) - 1) < 0x1p-28,
                "below the chance");
        CHECK(ql_bsdf_sample(&bsdf, density, 0x40000000u, u, &sample, NULL) &&
                        !sample.specular,
                "at the chance");
        CHECK(ql_bsdf_sample(&bsdf, QL_DENSITY_SPECULAR, 0xffffffffu, u,
                      &sample, NULL) &&
                        sample.specular && channel(&sample.weight, 0) == 0.25,
                "alone: %.9f", channel(&sample.weight, 0));
    }
}

#if QL_CFG_SMOOTH
/* Whatever the shading normal; where it does not turn the ray away from the
 * surface, at equal angles about it. */
TEST(smooth_mirrors_have_no_black_rim)
{
    long plain = 0, bent = 0;
    double worst = 0;

    state = 8;
    set_albedo(0, 0, 0);
    set_gloss(QL_GLOSS_MIRROR, 1, 0, 1);
    for (long k = 0; k < MANY(100000); k++) {
        const ql_uniform2_t u = {0, 0};
        ql_vec3_t incoming;
        point_t in, axis, shade;
        ql_bsdf_sample_t sample;

        set_normal(random_normal());
        set_shade(60 * stats_random_unit(&state));
        incoming = random_incoming();
        see(true, incoming);
        CHECK(ql_bsdf_sample(&bsdf, QL_DENSITY_BRDF, 0, u, &sample, NULL),
                "lost");
        check_sample(&sample, 1, NULL);
        in = unit(from_vec(incoming));
        shade = unit(from_vec(surface.shade));
        if (dot(in, shade) > 1e-3) { /* seen from below it */
            shade = normal();
        }
        axis = along(in, -2 * dot(in, shade), shade);
        if (dot(axis, normal()) < -1e-3) {
            axis = along(axis, -2 * dot(axis, normal()), normal());
            bent++;
        } else {
            plain++;
        }
        if (fabs(dot(in, shade)) > 1e-3 && fabs(dot(axis, normal())) > 1e-3) {
            worst = fmax(worst, angle(from_vec(sample.wi), axis));
        }
    }
    CHECK(worst <= ROUNDED + 0x1p-23, "%.3g rad off", worst);
    CHECK(bent > 1000 && plain > 1000, "%ld turned up, %ld not", bent, plain);
    NOTE("%ld turned up, %ld not", bent, plain);
}

#endif
#else

TEST(no_surface_is_mirror_where_that_is_not_built)
{
    static const ql_blob_gloss_t built = {.kind = QL_LE16(QL_GLOSS_MIRROR)};

    bsdf.gloss = &built;
    CHECK(!ql_mirror_is(&bsdf), "it is");
}

#endif

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_mirror", argc, argv);
#if QL_CFG_MIRROR
    RUN(mirrors_reflect_at_equal_angles);
    RUN(mixed_mirrors_draw_each_lobe_with_its_chance);
#if QL_CFG_SMOOTH
    RUN(smooth_mirrors_have_no_black_rim);
#endif
#else
    RUN(no_surface_is_mirror_where_that_is_not_built);
#endif
    return TEST_END();
}
