/* choose.c - the best way of finding light in a scene, by small pictures */
/* SPDX-License-Identifier: MIT */

#include "scene/choose/choose.h"

#include <stdlib.h>
#include <string.h>

#include "lib/program/cli.h"
#include "lib/render/open_blob.h"
#include "scene/blob/write_blob.h"
#include "scene/choose/pilot.h"
#include "scene/choose/sky_share.h"

/* Chances of the sky that are tried beside its own: 1 / these. */
static const unsigned shares[] = {4, 16, 64};
enum { SHARES = sizeof shares / sizeof shares[0] };

/* Pilots that are there, and which choices they are for. */
typedef struct {
    pilot_t pilot[CHOICE_WAYS]; /* SHARES + 1 are not more */
    unsigned choice[CHOICE_WAYS];
    unsigned count;
    const char *name; /* of the blob, for messages */
} trials_t;

/* How far choosing is. */
typedef struct {
    unsigned done, total;
    bool quiet;
} progress_t;

static void step(progress_t *progress)
{
    cli_progress(
            "choosing", ++progress->done, progress->total, progress->quiet);
}

static void add_pilot(
        trials_t *trials, const model_t *model, unsigned way, unsigned choice)
{
    size_t size;
    uint8_t *blob = write_blob(model, &size);
    ql_scene_t scene;

    open_blob_bytes(&scene, blob, size, trials->name);
    trials->choice[trials->count] = choice;
    pilot_render(&trials->pilot[trials->count++], &scene, choice_ways + way);
    free(blob);
}

/* The lowest choice that is within a tenth of the best. work: of each choice,
 * left as it is where there is no pilot. */
static unsigned settle(const trials_t *trials, soft_t *work)
{
    soft_t each[CHOICE_WAYS];
    unsigned best = 0, lowest = CHOICE_WAYS;

    pilot_compare(each, trials->pilot, trials->count);
    for (unsigned i = 0; i < trials->count; i++) {
        best = soft_compare(each[i], each[best]) < 0 ? i : best;
        work[trials->choice[i]] = each[i];
    }
    for (unsigned i = 0; i < trials->count; i++) {
        if (soft_compare(soft_mul(each[i], soft_int(10, 0)),
                    soft_mul(each[best], soft_int(11, 0))) <= 0 &&
                trials->choice[i] < lowest) {
            lowest = trials->choice[i];
        }
    }
    return lowest;
}

static void free_pilots(trials_t *trials)
{
    for (unsigned i = 0; i < trials->count; i++) {
        pilot_free(trials->pilot + i);
    }
}

/* The sky's chance: choice 0 is its own, choice 1 + i is 1 / shares[i], which
 * is tried if it is less. */
static void choose_share(model_t *model, const char *name, progress_t *progress)
{
    const size_t size = model->lights_count * sizeof *model->lights;
    const uint32_t own = 0 - model->lights[model->lights_count - 1].cum;
    ql_blob_light_t *lights = cli_alloc(1, size);
    soft_t work[SHARES + 1];
    trials_t trials = {.name = name};
    unsigned choice;

    memcpy(lights, model->lights, size);
    for (unsigned i = 0; i <= SHARES; i++) {
        if (i == 0 || own > UINT32_MAX / shares[i - 1]) {
            if (i > 0) {
                sky_share_set(model, shares[i - 1]);
            }
            add_pilot(&trials, model, CHOICE_QL_DIRECT_AREA_QL_LIGHTS_POWER, i);
        }
        step(progress);
    }
    choice = settle(&trials, work);
    free_pilots(&trials);
    memcpy(model->lights, lights, size);
    if (choice > 0) {
        sky_share_set(model, shares[choice - 1]);
    }
    free(lights);
}

/* A way is tried: its number is its choice. */
static void try_way(trials_t *trials, const model_t *model, unsigned way,
        progress_t *progress)
{
    add_pilot(trials, model, way, way);
    step(progress);
}

void choose_way(model_t *model, const char *name, bool quiet)
{
    const bool is_all =
            model->lights_count > 1 && model->lights_count <= CHOOSE_ALL_MAX;
    const bool is_sky = sky_share_matters(model);
    progress_t progress = {0, 3u + is_all + (is_sky ? SHARES + 1u : 0), quiet};
    soft_t work[CHOICE_WAYS] = {{0}};
    trials_t trials = {.name = name};
    unsigned way = CHOICE_QL_DIRECT_MIS_QL_LIGHTS_POWER;

    if (model->lights_count == 0) {
        return;
    }
    if (is_sky) {
        choose_share(model, name, &progress);
    }
    try_way(&trials, model, way, &progress);
    if (is_all) {
        try_way(&trials, model, CHOICE_QL_DIRECT_MIS_QL_LIGHTS_ALL, &progress);
        (void)settle(&trials, work);
        if (soft_compare(work[CHOICE_QL_DIRECT_MIS_QL_LIGHTS_ALL], work[way]) <
                0) {
            way = CHOICE_QL_DIRECT_MIS_QL_LIGHTS_ALL;
        }
    }
    for (unsigned i = 0; i < CHOICE_WAYS; i++) {
        if (choice_ways[i].lights == choice_ways[way].lights &&
                choice_ways[i].direct != QL_DIRECT_MIS) {
            try_way(&trials, model, i, &progress);
        }
    }
    choice_set(model, settle(&trials, work), work);
    free_pilots(&trials);
}
