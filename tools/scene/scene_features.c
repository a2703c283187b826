/* scene_features.c - which parts of the core a scene needs */
/* SPDX-License-Identifier: MIT */

#include "scene_features.h"

#define STACK_LEAST 4 /* QL_CFG_BVH_STACK allows no less */

uint32_t features_of(const model_t *model)
{
    uint32_t features = model->header.features & QL_FEATURE_TWO_SIDED;

    features |= model->nodes16 != NULL ? QL_FEATURE_NODE16 : QL_FEATURE_NODE8;
    if (model->light_count > 0) {
        features |= QL_FEATURE_LIGHTS;
    } else {
        features &= ~(uint32_t)QL_FEATURE_TWO_SIDED; /* nothing to shine */
    }
    if (model->vertex_count > 65536) {
        features |= QL_FEATURE_PAGES;
    }
    return features;
}

static void write_gate(
        FILE *file, const char *name, const model_t *model, uint32_t bit)
{
    fprintf(file, "#define %s %d\n", name, (model->header.features & bit) != 0);
}

void features_write(FILE *file, const model_t *model)
{
    unsigned stack = model->header.depth;

    stack = stack > STACK_LEAST ? stack : STACK_LEAST;
    fputs("/* What one scene needs of the core, written by qlux-scene */\n"
          "/* SPDX-License-Identifier: MIT */\n\n",
            file);
    write_gate(file, "QL_CFG_NODE16", model, QL_FEATURE_NODE16);
    write_gate(file, "QL_CFG_NODE8", model, QL_FEATURE_NODE8);
    write_gate(file, "QL_CFG_PAGES", model, QL_FEATURE_PAGES);
    write_gate(file, "QL_CFG_LIGHTS", model, QL_FEATURE_LIGHTS);
    write_gate(file, "QL_CFG_TWO_SIDED", model, QL_FEATURE_TWO_SIDED);
    fprintf(file, "#define QL_CFG_BVH_STACK %u\n", stack);
}
