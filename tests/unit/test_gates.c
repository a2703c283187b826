/* test_gates.c - settings that need a part this build lacks are refused */
/* SPDX-License-Identifier: MIT */

#include "support/built.h"
#include "support/ql_test.h"
#include "render/ql_line.h"

/* What the scene says that auto is. */
static uint8_t auto_direct = QL_DIRECT_AREA, auto_lights = QL_LIGHTS_POWER;

static ql_status_t init_with(const ql_settings_t *settings)
{
    ql_blob_header_t header;
    static const ql_blob_camera_t camera;
    ql_scene_t scene;
    ql_render_t render;
    ql_status_t status;

    memset(&header, 0, sizeof header);
    header.auto_direct = auto_direct;
    header.auto_lights = auto_lights;
    memset(&scene, 0, sizeof scene);
    scene.header = &header;
    scene.camera = &camera;
    status = ql_render_init(&render, &scene, settings);
    CHECK(status == QL_OK ? render.settings.direct <= QL_DIRECT_MIS &&
                                    render.settings.lights <= QL_LIGHTS_UNIFORM
                          : render.scene == NULL,
            "not zero, or not resolved after %d", status);
    return status;
}

/* What every build has. */
static ql_settings_t least(void)
{
    ql_settings_t s = QL_SETTINGS_DEFAULT;

    s.width = s.height = 8;
    return s;
}

static void expect(const char *what, ql_settings_t s, bool built)
{
    const ql_status_t status = init_with(&s);

    CHECK(status == (built ? QL_OK : QL_ERR_SETTINGS), "%s: status %d", what,
            status);
}

TEST(what_every_build_has_is_accepted)
{
    ql_settings_t s = least();

    expect("default", s, true);
    s.indirect = QL_INDIRECT_NONE;
    s.bounces = QL_BOUNCES_MAX;
    expect("no indirect light, however many bounces", s, true);
}

TEST(a_sampler_is_accepted_if_it_is_built_in)
{
    ql_settings_t s = least();

    s.sampler = QL_SAMPLER_RANDOM;
    expect("random", s, (QL_CFG_SAMPLERS & 1) != 0);
    s.sampler = QL_SAMPLER_SOBOL;
    expect("Sobol", s, (QL_CFG_SAMPLERS & 2) != 0);
    s.sampler = QL_SAMPLER_SOBOL + 1;
    expect("none there is", s, false);
    s.sampler = 255;
    expect("none there is", s, false);
}

TEST(bounces_are_accepted_if_paths_are_built_in)
{
    ql_settings_t s = least();

    s.bounces = 0;
    expect("no bounce", s, true);
    s.bounces = 1;
    expect("one bounce", s, QL_CFG_INDIRECT);
}

/* By name, and where a scene says it. */
TEST(each_way_of_finding_light_is_accepted_if_it_is_built_in)
{
    ql_settings_t s = least();

    for (unsigned i = 0; i <= 255; i++) {
        const bool built = i <= QL_DIRECT_MIS && BUILT_HAS_DIRECT(i);

        s.direct = (uint8_t)i;
        expect("direct", s, built || i == QL_DIRECT_AUTO);
        s.direct = QL_DIRECT_AUTO;
        auto_direct = (uint8_t)i;
        expect("direct of the scene", s, built);
        auto_direct = QL_DIRECT_AREA;
    }
    for (unsigned i = 0; i <= 255; i++) {
        const bool built = i <= QL_LIGHTS_UNIFORM && BUILT_HAS_LIGHTS(i);

        s.lights = (uint8_t)i;
        expect("lights", s, built || i == QL_LIGHTS_AUTO);
        s.lights = QL_LIGHTS_AUTO;
        auto_lights = (uint8_t)i;
        expect("lights of the scene", s, built);
        auto_lights = QL_LIGHTS_POWER;
    }
}

TEST(what_else_an_estimator_does_is_accepted_if_it_is_built_in)
{
    ql_settings_t s = least();

    s.light_samples = 0;
    expect("no sample", s, false);
    s.light_samples = 2;
    expect("two samples", s, QL_CFG_LIGHT_SAMPLES);
    s = least();
    s.bounces = 0;
    s.indirect = QL_INDIRECT_UNIFORM;
    expect("uniform directions", s, QL_CFG_UNIFORM);
    s = least();
    s.roulette = 1;
    expect("roulette", s, QL_CFG_ROULETTE);
    s.roulette = 2;
    expect("more than roulette", s, false);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_gates", argc, argv);
    RUN(what_every_build_has_is_accepted);
    RUN(a_sampler_is_accepted_if_it_is_built_in);
    RUN(bounces_are_accepted_if_paths_are_built_in);
    RUN(each_way_of_finding_light_is_accepted_if_it_is_built_in);
    RUN(what_else_an_estimator_does_is_accepted_if_it_is_built_in);
    return TEST_END();
}
