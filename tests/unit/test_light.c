/* test_light.c - emitters chosen by their share, weights, look-ups */
/* SPDX-License-Identifier: MIT */

#include <math.h>
#include <string.h>

#include "blob/ql_blob_open.h"
#include "light/ql_emit_triangle.h"
#include "light/ql_light.h"
#include "support/built.h"
#include "support/picture/lamps.h"
#include "support/ql_test.h"

#if QL_CFG_LIGHTS

static double mass_of(uint16_t light)
{
    const double low = QL_LE32(scene.lights[light].cum);
    const double high = light + 1 < scene.light_count
                                ? QL_LE32(scene.lights[light + 1].cum)
                                : 4294967296.0;

    return (high - low) / 4294967296.0;
}

static double value(ql_real_t r)
{
    return ldexp(r.m, r.e);
}

TEST(each_emitter_is_chosen_for_its_share_and_weighs_its_inverse)
{
    const double two_pi = 6.283185307179586;

    for (unsigned lamps = 1; lamps <= 12; lamps++) {
        build_lamps(lamps);
        CHECK(scene.light_count == lamps, "%u lights", scene.light_count);
        for (uint16_t i = 0; i < scene.light_count; i++) {
            const uint32_t first = QL_LE32(scene.lights[i].cum);
            const uint32_t last = i + 1 < scene.light_count
                                          ? QL_LE32(scene.lights[i + 1].cum) - 1
                                          : 0xffffffffu;
            const ql_blob_tri_t *tri =
                    scene.triangles + QL_LE16(scene.lights[i].triangle);
            const ql_vec3_t corner = ql_scene_corner(&scene, tri, 0);
            const double weight =
                    value(ql_light_weight(&scene, QL_LIGHTS_POWER, 1, i));
            const ql_uniform2_t u = {77, 99};
            ql_emit_point_t p;

            CHECK(ql_light_choose(&scene, QL_LIGHTS_POWER, first) == i &&
                            ql_light_choose(&scene, QL_LIGHTS_POWER, last) == i,
                    "light %u of %u: another one was chosen", i, lamps);
            ql_emit_triangle_point(&scene, i, u, &p);
            CHECK(p.corner.x == corner.x && p.corner.y == corner.y &&
                            p.corner.z == corner.z,
                    "light %u of %u: a point of another one", i, lamps);
            CHECK(fabs(weight * two_pi * mass_of(i) - 1) < 1e-8,
                    "light %u of %u weighs %.9f, its mass is %.9f", i, lamps,
                    weight, mass_of(i));
            CHECK(QL_LE32(p.material->emission[0]) > 0, "light %u is dark", i);
        }
    }
}

TEST(probabilities_are_the_shares_and_add_up_to_1)
{
    static const ql_light_choice_t all[] = {QL_LIGHTS_POWER, QL_LIGHTS_UNIFORM};

    for (unsigned lamps = 1; lamps <= 12; lamps++) {
        build_lamps(lamps);
        for (int k = 0; k < (BUILT_HAS_LIGHTS(QL_LIGHTS_UNIFORM) ? 2 : 1);
                k++) {
            double sum = 0;

            for (uint16_t i = 0; i < lamps; i++) {
                const double pmf = value(ql_light_pmf(&scene, all[k], i));

                sum += pmf;
                CHECK(k == 1 ? fabs(pmf * lamps - 1) <= lamps * 0x1p-32
                             : pmf == mass_of(i),
                        "light %u of %u: %.12f", i, lamps, pmf);
                CHECK(!BUILT_HAS_LIGHTS(QL_LIGHTS_ALL) ||
                                value(ql_light_pmf(&scene, QL_LIGHTS_ALL, i)) ==
                                        1,
                        "light %u of %u", i, lamps);
            }
            CHECK(sum == 1, "%u lights: %.12f", lamps, sum);
        }
    }
}

/* Sum over lights of weight times probability: 1 / (2 pi) each. */
TEST(weights_times_probabilities_count_every_emitter_once)
{
    double sum = 0;

    build_lamps(12);
    for (uint32_t k = 0; k < 65536; k++) {
        const uint16_t i =
                ql_light_choose(&scene, QL_LIGHTS_POWER, k << 16 | 0x8000u);

        sum += value(ql_light_weight(&scene, QL_LIGHTS_POWER, 1, i)) / 65536;
    }
    sum *= 6.283185307179586;
    /* 2^16 steps of u resolve each mass to 2^-16 */
    CHECK(fabs(sum - 12) < 12.0 * 12 / 65536 * 200, "%.4f, not 12", sum);
    NOTE("%.4f of 12", sum);
}

#if QL_CFG_LIGHT_CHOICES & 4
/* The bounds of equal shares: the last u of each light and the next one. */
TEST(uniform_choice_has_the_probability_it_divides_by)
{
    const double two_pi = 6.283185307179586;

    for (unsigned lamps = 1; lamps <= 12; lamps++) {
        uint64_t begin = 0;

        build_lamps(lamps);
        for (uint16_t i = 0; i < lamps; i++) {
            /* light i has every u with floor(u lamps / 2^32) = i */
            const uint64_t end =
                    (((uint64_t)i + 1) * 4294967296u + lamps - 1) / lamps;
            const double mass = (double)(end - begin) / 4294967296.0;
            const double weight =
                    value(ql_light_weight(&scene, QL_LIGHTS_UNIFORM, 1, i));

            CHECK(ql_light_choose(&scene, QL_LIGHTS_UNIFORM, (uint32_t)begin) ==
                                    i &&
                            ql_light_choose(&scene, QL_LIGHTS_UNIFORM,
                                    (uint32_t)(end - 1)) == i,
                    "light %u of %u: another one was chosen", i, lamps);
            CHECK(fabs(weight * two_pi * mass - 1) < 4e-9,
                    "light %u of %u weighs %.10f, its mass is %.10f", i, lamps,
                    weight, mass);
            CHECK(value(ql_light_pmf(&scene, QL_LIGHTS_UNIFORM, i)) == mass,
                    "light %u of %u: %.10f is not exact", i, lamps, mass);
            begin = end;
        }
        CHECK(begin == 4294967296u, "%u lights leave out numbers", lamps);
    }
}

/* ceil(i 2^32 / n), where the equal share of light i of n begins. */
static uint64_t share_begin(uint64_t i, uint64_t n)
{
    return (i * 4294967296u + n - 1) / n;
}

/* Of any number of lights: equal shares need nothing of a scene but that. */
TEST(equal_shares_are_exact_of_every_light_of_very_many)
{
    static const uint16_t counts[] = {2, 3, 5, 7, 255, 256, 257, 1000, 4096,
            21845, 32767, 32768, 32769, 65534, 65535};
    unsigned long lights = 0;

    for (size_t k = 0; k < sizeof counts / sizeof counts[0]; k++) {
        const uint32_t n = counts[k];
        ql_scene_t many = {0};

        many.light_count = counts[k];
        for (uint32_t i = 0; i < n; i++) {
            const uint64_t begin = share_begin(i, n);
            const uint64_t end = share_begin(i + 1, n);
            const double pmf =
                    value(ql_light_pmf(&many, QL_LIGHTS_UNIFORM, (uint16_t)i));

            CHECK(pmf * 4294967296.0 == (double)(end - begin),
                    "light %lu of %lu: %.1f of 2^32, want %lu",
                    (unsigned long)i, (unsigned long)n, pmf * 4294967296.0,
                    (unsigned long)(end - begin));
            CHECK(ql_light_choose(&many, QL_LIGHTS_UNIFORM, (uint32_t)begin) ==
                                    i &&
                            ql_light_choose(&many, QL_LIGHTS_UNIFORM,
                                    (uint32_t)(end - 1)) == i,
                    "light %lu of %lu: another one was chosen",
                    (unsigned long)i, (unsigned long)n);
            lights++;
        }
    }
    NOTE("%lu lights", lights);
}

#endif

#if QL_CFG_LIGHT_CHOICES & 2 && QL_CFG_LIGHT_SAMPLES
TEST(samples_divide_the_weight_and_all_lights_weigh_1)
{
    build_lamps(5);
    for (unsigned n = 1; n <= 255; n++) {
        const double all = value(ql_light_weight(&scene, QL_LIGHTS_ALL, n, 3));
        const double one =
                value(ql_light_weight(&scene, QL_LIGHTS_POWER, 1, 3));
        const double part =
                value(ql_light_weight(&scene, QL_LIGHTS_POWER, n, 3));

        CHECK(fabs(all * n * 6.283185307179586 - 1) < 4e-9, "%u: %.10f", n,
                all);
        CHECK(fabs(part * n / one - 1) < 4e-9, "%u: %.10f", n, part * n / one);
    }
}

#endif

#if QL_MIS
TEST(each_light_is_found_by_its_triangle_and_nothing_else_is)
{
    for (unsigned lamps = 1; lamps <= 12; lamps++) {
        unsigned found = 0;

        build_lamps(lamps);
        for (uint32_t t = 0; t <= 65535; t++) {
            uint16_t light;

            if (ql_light_find(&scene, (uint16_t)t, &light)) {
                CHECK(light < lamps &&
                                QL_LE16(scene.lights[light].triangle) == t,
                        "triangle %lu is not light %u", (unsigned long)t,
                        light);
                found++;
            }
        }
        CHECK(found == lamps, "%u of %u lights", found, lamps);
    }
}
#endif

#else

TEST(emitters_are_named_as_missing)
{
    ql_blob_header_t header = {0};

    header.features = QL_LE32(QL_FEATURE_LIGHTS);
    CHECK(strcmp(ql_blob_missing(&header), "lights") == 0, "%s",
            ql_blob_missing(&header));
}

#endif

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_light", argc, argv);
#if QL_CFG_LIGHTS
    RUN(each_emitter_is_chosen_for_its_share_and_weighs_its_inverse);
    RUN(probabilities_are_the_shares_and_add_up_to_1);
    RUN(weights_times_probabilities_count_every_emitter_once);
#if QL_CFG_LIGHT_CHOICES & 4
    RUN(uniform_choice_has_the_probability_it_divides_by);
    RUN(equal_shares_are_exact_of_every_light_of_very_many);
#endif
#if QL_CFG_LIGHT_CHOICES & 2 && QL_CFG_LIGHT_SAMPLES
    RUN(samples_divide_the_weight_and_all_lights_weigh_1);
#endif
#if QL_MIS
    RUN(each_light_is_found_by_its_triangle_and_nothing_else_is);
#endif
#else
    RUN(emitters_are_named_as_missing);
#endif
    return TEST_END();
}
