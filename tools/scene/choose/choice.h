/* choice.h - which way of finding light a scene asks for, and how others did */
/* SPDX-License-Identifier: MIT */

#ifndef CHOICE_H
#define CHOICE_H

#include "base/ql_settings.h"
#include "lib/math/soft.h"
#include "scene/blob/model.h"

/* The ways there are, in the order of the header's trials. */
enum {
#define CHOICE_WAY(direct, lights) CHOICE_##direct##_##lights,
    QL_BLOB_TRIALS(CHOICE_WAY)
#undef CHOICE_WAY
            CHOICE_WAYS
};

typedef struct {
    ql_direct_t direct;
    ql_light_choice_t lights;
} choice_way_t;

extern const choice_way_t choice_ways[CHOICE_WAYS];

/* Put the choice into the header of a blob.
 *
 *   model  -  out: auto_direct, auto_lights, trials of its header
 *   way    -  the one chosen, 0 to CHOICE_WAYS - 1
 *   cost   -  of each way its variance times its instructions, in any unit; 0
 *             if it was not tried
 *
 * A trial is rounded to 1/16 of a power of two.
 */
void choice_set(model_t *model, unsigned way, const soft_t cost[CHOICE_WAYS]);

/* Choose for a scene.
 *
 *   model  -  complete but for the choice
 *
 * The same on every host.
 */
void choice_make(model_t *model);

#endif
