/* scene_features.c - the gates of a core for one scene */
/* SPDX-License-Identifier: MIT */

#include "scene/scene_features.h"

#include <string.h>

#define STACK_LEAST 4 /* QL_CFG_BVH_STACK allows no less */

/* A gate is called QL_CFG_ and what its feature is behind QL_FEATURE_. */
static const struct {
    const char *feature;
    uint32_t bit;
} gates[] = {
#define GATE(name, bit, text) {#name, (uint32_t)name},
        QL_FEATURE_LIST(GATE)
#undef GATE
};

void write_features(FILE *file, const model_t *model)
{
    unsigned stack = model->header.depth;

    stack = stack > STACK_LEAST ? stack : STACK_LEAST;
    fputs("/* What one scene needs of the core, written by qlux-scene */\n"
          "/* SPDX-License-Identifier: MIT */\n\n",
            file);
    for (size_t i = 0; i < sizeof gates / sizeof *gates; i++) {
        fprintf(file, "#define QL_CFG_%s %d\n",
                gates[i].feature + strlen("QL_FEATURE_"),
                (model->header.features & gates[i].bit) != 0);
    }
    fprintf(file, "#define QL_CFG_BVH_STACK %u\n", stack);
}
