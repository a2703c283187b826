/* scene_features.c - which parts of the core a scene needs */
/* SPDX-License-Identifier: MIT */

#include "scene/blob/scene_features.h"

#define STACK_LEAST 4 /* QL_CFG_BVH_STACK allows no less */

/* Do surfaces emit, not just the sky? */
static bool has_emitters(const model_t *model)
{
    return model->light_count > 0 && model->lights[0].triangle != QL_LIGHT_SKY;
}

static uint32_t features_of_gloss(const model_t *model)
{
    uint32_t features = 0;

    for (uint32_t i = 0; i < model->gloss_count; i++) {
        const unsigned kind = model->gloss[i].kind;

        features |= kind == QL_GLOSS_PHONG    ? QL_FEATURE_PHONG
                    : kind == QL_GLOSS_MIRROR ? QL_FEATURE_MIRROR
                                              : QL_FEATURE_GLASS;
    }
    return features;
}

static uint32_t features_of_sky(const model_t *model)
{
    if (model->sky_count == 0) {
        return 0;
    }
    return model->sky->width > 0 ? QL_FEATURE_SKY | QL_FEATURE_SKY_MAP
                                 : QL_FEATURE_SKY;
}

uint32_t features_of(const model_t *model)
{
    uint32_t features = model->header.features & QL_FEATURE_TWO_SIDED;

    if (!has_emitters(model)) {
        features = 0; /* nothing has a side to shine from */
    }
    features |= model->nodes16 != NULL ? QL_FEATURE_NODE16 : QL_FEATURE_NODE8;
    features |= model->light_count > 0 ? QL_FEATURE_LIGHTS : 0;
    features |= model->vertex_count > 65536 ? QL_FEATURE_PAGES : 0;
    features |= model->normals_count > 0 ? QL_FEATURE_SMOOTH : 0;
    features |= model->spheres_count > 0 ? QL_FEATURE_SPHERES : 0;
    features |= model->tables_count > 0 ? QL_FEATURE_TABLES : 0;
    features |= model->lens_count > 0 ? QL_FEATURE_LENS : 0;
    return features | features_of_gloss(model) | features_of_sky(model);
}

void features_write(FILE *file, const model_t *model)
{
    static const struct {
        const char *name;
        uint32_t bit;
    } gates[] = {{"NODE16", QL_FEATURE_NODE16}, {"NODE8", QL_FEATURE_NODE8},
            {"PAGES", QL_FEATURE_PAGES}, {"LIGHTS", QL_FEATURE_LIGHTS},
            {"TWO_SIDED", QL_FEATURE_TWO_SIDED},
            {"SPHERES", QL_FEATURE_SPHERES}, {"SMOOTH", QL_FEATURE_SMOOTH},
            {"PHONG", QL_FEATURE_PHONG}, {"MIRROR", QL_FEATURE_MIRROR},
            {"GLASS", QL_FEATURE_GLASS}, {"SKY", QL_FEATURE_SKY},
            {"SKY_MAP", QL_FEATURE_SKY_MAP}, {"TABLES", QL_FEATURE_TABLES},
            {"LENS", QL_FEATURE_LENS}};
    unsigned stack = model->header.depth;

    stack = stack > STACK_LEAST ? stack : STACK_LEAST;
    fputs("/* What one scene needs of the core, written by qlux-scene */\n"
          "/* SPDX-License-Identifier: MIT */\n\n",
            file);
    for (size_t i = 0; i < sizeof gates / sizeof *gates; i++) {
        fprintf(file, "#define QL_CFG_%s %d\n", gates[i].name,
                (model->header.features & gates[i].bit) != 0);
    }
    fprintf(file, "#define QL_CFG_BVH_STACK %u\n", stack);
}
