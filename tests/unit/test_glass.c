/* test_glass.c - Snell's and Fresnel's laws, reciprocity, energy */
/* SPDX-License-Identifier: MIT */

#include "material/ql_glass.h"
#include "support/seen_surface.h"

#if QL_CFG_GLASS
static bool draw_glass(ql_uq32_t pick, ql_bsdf_sample_t *sample)
{
    const ql_uniform2_t u = {0, 0};

    return ql_bsdf_sample(&bsdf, QL_DENSITY_BRDF, pick, u, sample, NULL);
}

/* How many of 2^32 picks reflect: they are the smallest. */
static uint64_t reflectance(void)
{
    uint64_t low = 0, high = (uint64_t)1 << 32;

    while (low < high) {
        const uint64_t mid = (low + high) / 2;
        ql_bsdf_sample_t sample;

        if (draw_glass((uint32_t)mid, &sample) && !sample.through) {
            low = mid + 1;
        } else {
            high = mid;
        }
    }
    return low;
}

/* Fresnel's equations as in the textbooks, n = n2/n1. */
static double fresnel(double c, double n)
{
    const double t2 = 1 - (1 - c * c) / (n * n);
    const double t = sqrt(fmax(t2, 0));
    const double s = (c - n * t) / (c + n * t), p = (t - n * c) / (t + n * c);

    return t2 <= 0 ? 1 : (s * s + p * p) / 2;
}

/* How much it may change if the cosine is off by its length's error, the angle
 * by so much, and the index by 2^-30: it dips at Brewster's angle, so all of
 * the range is looked at. Then what a root is off. */
static double fresnel_limit(double c, double n, double angle_off)
{
    const double off = c * LENGTH_ERROR + 0x1p-28 + angle_off * sqrt(1 - c * c);
    const double r = fresnel(c, n);
    double change = 0;

    for (int i = -32; i <= 32; i++) {
        const double at = fmin(fmax(c + off * i / 32, 0), 1);

        change = fmax(change, fabs(fresnel(at, n * (1 - 0x1p-30)) - r));
        change = fmax(change, fabs(fresnel(at, n * (1 + 0x1p-30)) - r));
    }
    return change + (QL_CFG_PRECISION == 0 ? 0x1p-13 : 0x1p-26);
}

#define FRESNEL_ERROR (QL_CFG_PRECISION == 0 ? 0x1p-11 : 0x1p-20)

TEST(fresnel_reflectance_is_right_but_next_to_total_reflection)
{
    double worst = 0;
    long loose = 0;

    set_normal(tilted);
    for (int i = 0; i < 2 * INDICES; i++) {
        const bool front = i < INDICES;
        const double index = set_glass(indices[i % INDICES]);
        const double n = front ? index : 1 / index;

        for (int k = 0; k < 1000; k++) {
            const ql_vec3_t incoming =
                    incoming_at(normal(), (k + 0.5) * PI / 2000, k);
            const double c = -cosine_to_normal(incoming);
            const double exact = fresnel(c, n);
            const double limit = fresnel_limit(c, n, 0);
            double got;

            see(front, incoming);
            got = ldexp((double)reflectance(), -32);
            CHECK(fabs(got - exact) <= limit,
                    "index %g, %s, cos %.9f: %.9f, not %.9f, limit %.2g", index,
                    front ? "front" : "back", c, got, exact, limit);
            /* all but where a rounded cosine decides */
            if (limit < FRESNEL_ERROR) {
                worst = fmax(worst, fabs(got - exact));
            } else {
                loose++;
            }
        }
    }
    CHECK(worst <= FRESNEL_ERROR && loose < 200, "worst %.3g, %ld left out",
            worst, loose);
    NOTE("worst 2^%.1f but for %ld of 16,000", log2(worst), loose);
}

/* ((n - 1)/(n + 1))^2 head on. */
TEST(glass_head_on_has_its_closed_form)
{
    set_normal(vec(0, 0, 12345));
    for (int i = 0; i < INDICES; i++) {
        const double n = set_glass(indices[i]);
        const double root = (n - 1) / (n + 1);
        double got;

        see(true, vec(0, 0, -(1 << QL_DIR_BITS)));
        got = ldexp((double)reflectance(), -32);
        CHECK(fabs(got - root * root) <=
                        (QL_CFG_PRECISION == 0 ? 0x1p-14 : 0x1p-26),
                "index %g: %.9f, not %.9f", n, got, root * root);
    }
}

TEST(snell_holds_both_ways)
{
    double worst = 0;

    set_normal(tilted);
    for (int i = 0; i < 2 * INDICES; i++) {
        const bool front = i < INDICES;
        const double index = set_glass(indices[i % INDICES]);
        const double n = front ? index : 1 / index;

        for (int k = 0; k < 1000; k++) {
            const ql_vec3_t incoming =
                    incoming_at(normal(), (k + 0.5) * PI / 2000, k);
            const point_t in = unit(from_vec(incoming));
            const double c = -dot(in, normal());
            const double t2 = 1 - (1 - c * c) / (n * n);
            ql_bsdf_sample_t sample;
            double off, limit;

            see(front, incoming);
            if (!draw_glass(0xffffffffu, &sample) || !sample.through) {
                CHECK(t2 < 1e-3, "index %g, cos %.6f: not refracted", index, c);
                continue;
            }
            check_sample(&sample, fmax(1, 1 / (n * n)) * (1 + 1e-6), NULL);
            if (t2 < 1e-6) {
                continue;
            }
            off = angle(
                    from_vec(sample.wi), along(along(point(0, 0, 0), 1 / n, in),
                                                 c / n - sqrt(t2), normal()));
            /* across the normal what the directions are off, along it what
             * the cosine behind is, each magnified by a larger index */
            limit = ROUNDED + 0x1p-27 * fmax(1, 1 / n) +
                    LENGTH_ERROR * c * fmax(1, 1 / (n * n)) / sqrt(t2);
            worst = fmax(worst, off / limit);
            CHECK(off <= limit,
                    "index %g, %s, cos %.6f: %.3g rad off, limit %.3g", index,
                    front ? "front" : "back", c, off, limit);
        }
    }
    NOTE("worst %.2f of the limit", worst);
}

/* sin = n2/n1 */
TEST(reflection_is_total_from_the_critical_angle_on)
{
    set_normal(tilted);
    for (int i = 2; i < INDICES; i++) {
        const double index = set_glass(indices[i]);
        const bool front = index < 1;
        const double critical = asin(front ? index : 1 / index);
        const double off = QL_CFG_PRECISION == 0 ? 2e-3 : 1e-5;

        see(front, incoming_at(normal(), critical + off, 1));
        CHECK(reflectance() == (uint64_t)1 << 32, "index %g: %.9f", index,
                ldexp((double)reflectance(), -32));
        see(front, incoming_at(normal(), critical - off, 1));
        CHECK(reflectance() < (uint64_t)1 << 32, "index %g: total", index);
    }
}

/* R is the same from both sides of a path, radiance over n^2 is kept, and what
 * is reflected and refracted adds up. */
TEST(glass_is_reciprocal_and_keeps_energy)
{
    long loose = 0;

    set_normal(tilted);
    for (int i = 0; i < INDICES; i++) {
        const double index = set_glass(indices[i]);

        for (int k = 1; k < 80; k++) {
            const double theta = asin(sin(k * PI / 180) * fmin(1, index));
            const double behind = asin(fmin(1, sin(theta) / index));
            ql_bsdf_sample_t there, back;
            const double limit = fresnel_limit(cos(theta), index, ROUNDED) +
                                 fresnel_limit(cos(behind), 1 / index, ROUNDED);
            double r, r2, kept;

            see(true, incoming_at(normal(), theta, k));
            r = ldexp((double)reflectance(), -32);
            CHECK(draw_glass(0xffffffffu, &there) && there.through,
                    "not refracted");
            kept = r + (1 - r) * channel(&there.weight, 0) * index * index;
            CHECK(fabs(kept - 1) <= 1e-8, "index %g: %.10f", index, kept);
            if (limit > 0.01) { /* the rounded ray may miss the way back */
                loose++;
                continue;
            }
            see(false, incoming_at(normal(), behind, k));
            r2 = ldexp((double)reflectance(), -32);
            CHECK(draw_glass(0xffffffffu, &back) && back.through,
                    "not refracted back");
            CHECK(fabs(r - r2) <= limit, "index %g, %d degrees: %.9f, %.9f",
                    index, k, r, r2);
            CHECK(fabs(channel(&there.weight, 0) * channel(&back.weight, 0) -
                          1) <= 1e-8,
                    "there and back: %.10f",
                    channel(&there.weight, 0) * channel(&back.weight, 0));
            CHECK(draw_glass(0, &back) && (r == 0 || !back.through),
                    "the least pick is refracted");
        }
    }
    CHECK(loose <= (QL_CFG_PRECISION == 0 ? 160 : 2), "%ld left out", loose);
    NOTE("all but %ld of %d", loose, INDICES * 79);
}

TEST(glass_has_no_spread_and_filters_by_tf)
{
    ql_bsdf_sample_t sample;
    const ql_real_t one = {0x80000000u, -31};
    ql_rgb_t r;

    (void)set_glass(1);
    gloss.specular[1] = uq31(0.25);
    gloss.specular[2] = 0;
    see_at(40);
    CHECK(ql_bsdf_has_specular(&bsdf) && !ql_bsdf_has_nonspecular(&bsdf),
            "lobes");
    CHECK(draw_glass(0, &sample) && sample.through &&
                    fabs(channel(&sample.weight, 0) - 1) < 0x1p-29 &&
                    fabs(channel(&sample.weight, 1) - 0.25) < 0x1p-31 &&
                    channel(&sample.weight, 2) == 0,
            "%.9f", channel(&sample.weight, 1));
    CHECK(angle(from_vec(sample.wi), from_vec(bsdf.minus_wo)) <= ROUNDED,
            "index 1 bends");
    ql_bsdf_eval(&bsdf, bsdf.n, one, one, QL_MIS_NONE, &r);
    CHECK(ql_rgb_most(&r) == 0, "reflects %.9f", channel(&r, 0));
}

TEST(what_glass_reflects_is_white)
{
    ql_bsdf_sample_t sample;

    (void)set_glass(1.5);
    gloss.specular[1] = uq31(0.25);
    gloss.specular[2] = 0;
    see_at(40);
    CHECK(draw_glass(0, &sample) && !sample.through, "the least pick");
    for (unsigned i = 0; i < 3; i++) {
        CHECK(channel(&sample.weight, i) == 1, "channel %u: %.9f", i,
                channel(&sample.weight, i));
    }
}

#else

TEST(no_surface_is_glass_where_that_is_not_built)
{
    static const ql_blob_gloss_t built = {.kind = QL_LE16(QL_GLOSS_GLASS)};

    bsdf.gloss = &built;
    CHECK(!ql_glass_is(&bsdf), "it is");
}

#endif

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_glass", argc, argv);
#if QL_CFG_GLASS
    RUN(fresnel_reflectance_is_right_but_next_to_total_reflection);
    RUN(glass_head_on_has_its_closed_form);
    RUN(snell_holds_both_ways);
    RUN(reflection_is_total_from_the_critical_angle_on);
    RUN(glass_is_reciprocal_and_keeps_energy);
    RUN(glass_has_no_spread_and_filters_by_tf);
    RUN(what_glass_reflects_is_white);
#else
    RUN(no_surface_is_glass_where_that_is_not_built);
#endif
    return TEST_END();
}
