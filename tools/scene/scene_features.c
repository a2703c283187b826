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

/* What auto is, and the gate of that unless the command line has another. */
static void write_choice(
        FILE *file, const char *name, const char *gate, unsigned choice)
{
    fprintf(file, "#define QL_SCENE_%s %u\n", name, choice);
    fprintf(file, "#ifndef QL_CFG_%s\n#define QL_CFG_%s %u\n#endif\n", gate,
            gate, 1u << choice); /* at most 5: checked, or made so */
}

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
    write_choice(file, "DIRECT", "DIRECT", model->header.auto_direct);
    write_choice(file, "LIGHTS", "LIGHT_CHOICES", model->header.auto_lights);
}
