/* test_gates.c - settings that need a part this build lacks are refused */
/* SPDX-License-Identifier: MIT */

#include "support/ql_test.h"
#include "render/ql_line.h"

static ql_status_t init_with(const ql_settings_t *settings)
{
    static const ql_blob_header_t header;
    static const ql_blob_camera_t camera;
    ql_scene_t scene;
    ql_render_t render;
    ql_status_t status;

    memset(&scene, 0, sizeof scene);
    scene.header = &header;
    scene.camera = &camera;
    status = ql_render_init(&render, &scene, settings);
    CHECK(status == QL_OK || render.scene == NULL, "not zero after %d", status);
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

TEST(estimators_are_accepted_if_strategies_are_built_in)
{
    ql_settings_t s = least();

    s.direct = QL_DIRECT_MIS;
    expect("mis", s, QL_CFG_STRATEGIES);
    s = least();
    s.lights = QL_LIGHTS_UNIFORM;
    expect("uniform lights", s, QL_CFG_STRATEGIES);
    s = least();
    s.roulette = 1;
    expect("roulette", s, QL_CFG_STRATEGIES);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("unit/test_gates", argc, argv);
    RUN(what_every_build_has_is_accepted);
    RUN(a_sampler_is_accepted_if_it_is_built_in);
    RUN(bounces_are_accepted_if_paths_are_built_in);
    RUN(estimators_are_accepted_if_strategies_are_built_in);
    return TEST_END();
}
