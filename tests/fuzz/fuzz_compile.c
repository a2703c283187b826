/* fuzz_compile.c - what becomes of a scene: compiled, opened, drawn */
/* SPDX-License-Identifier: MIT */

#include <stdlib.h>

#include "film/ql_adaptive.h"
#include "fuzz/fuzz.h"
#include "lib/render/open_blob.h"
#include "qlux.h"
#include "scene/bare/bare.h"
#include "scene/blob/write_blob.h"
#include "scene/build/compile.h"
#include "scene/script/read_scene.h"

enum { WIDTH = 2, HEIGHT = 2, SPP = 1 };

static void draw_with(const ql_scene_t *scene, const ql_settings_t *settings)
{
    static uint8_t line[QL_LINE_BYTES(WIDTH, QL_FORMAT_RGB888)];
    const ql_output_t output = {QL_FORMAT_RGB888, line};
    static ql_render_t render;

    if (ql_render_init(&render, scene, settings) == QL_OK) {
        for (uint16_t y = 0; y < settings->height; y++) {
            ql_render_line(&render, y, &output, 1);
        }
    }
}

/* A pixel that may end by itself. */
static void draw_adaptive(const ql_scene_t *scene)
{
    ql_settings_t settings = QL_SETTINGS_DEFAULT;

    settings.width = 1;
    settings.height = 1;
    settings.spp = 2 * QL_ADAPTIVE_MIN;
    settings.error_q16 = QL_ERROR_Q16(0.1);
    draw_with(scene, &settings);
}

void fuzz_draw(const ql_scene_t *scene)
{
    ql_settings_t settings = QL_SETTINGS_DEFAULT;

    settings.width = WIDTH;
    settings.height = HEIGHT;
    settings.spp = SPP;
    for (uint8_t direct = QL_DIRECT_NONE; direct <= QL_DIRECT_MIS; direct++) {
        settings.direct = direct;
        settings.indirect = direct == QL_DIRECT_HEMISPHERE ? QL_INDIRECT_UNIFORM
                                                           : QL_INDIRECT_BRDF;
        settings.lights = direct % 3;
        settings.light_samples = (uint8_t)(1 + direct % 2);
        settings.roulette = direct == QL_DIRECT_SOLID_ANGLE;
        settings.sampler = direct == QL_DIRECT_COSINE ? QL_SAMPLER_RANDOM
                                                      : QL_SAMPLER_SOBOL;
        draw_with(scene, &settings);
    }
    draw_adaptive(scene);
}

static void compile(text_t *text, unsigned node_bits)
{
    const compile_options_t how = {node_bits, 4, true};
    ql_scene_t scene;
    world_t world;
    model_t model;
    uint8_t *blob;
    size_t size;

    read_scene(&world, text);
    compile_scene(&model, &world, &how);
    blob = write_blob(&model, &size);
    open_blob_bytes(&scene, blob, size, "s.qlb");
    if (node_bits == 16) {
        fuzz_draw(&scene);
    }
    free(blob);
    model_free(&model);
    world_free(&world);
    text_close(text);
}

void fuzz_compile(void)
{
    text_t text;

    text_open(&text, "s.scene", KIND_SCENE);
    compile(&text, 16);
    text_open(&text, "s.scene", KIND_SCENE);
    compile(&text, 8);
}

void fuzz_compile_bare(bool is_up_z)
{
    const bare_t bare = {.path = "m.obj", .is_up_z = is_up_z, .floor = true};
    text_t text;

    text_of(&text, "m.obj", bare_describe(&bare));
    compile(&text, 16);
}
