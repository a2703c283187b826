/* cost_settings.h - ways to render that the table of costs is fitted to */
/* SPDX-License-Identifier: MIT */

#ifndef COST_SETTINGS_H
#define COST_SETTINGS_H

#include "base/ql_settings.h"

#define COST_SIZE 16 /* px, the picture is square */
#define COST_SPP  4

/* X(name, direct, bounces, light samples, lights) */
#define COST_WAYS(X)                                                           \
    X("area-0", AREA, 0, 1, POWER)                                             \
    X("area-1", AREA, 1, 1, POWER)                                             \
    X("area-4", AREA, 4, 1, POWER)                                             \
    X("area-8", AREA, 8, 1, POWER)                                             \
    X("none-4", NONE, 4, 1, POWER)                                             \
    X("mis-0", MIS, 0, 1, POWER)                                               \
    X("mis-1", MIS, 1, 1, POWER)                                               \
    X("mis-4", MIS, 4, 1, POWER)                                               \
    X("mis-8", MIS, 8, 1, POWER)                                               \
    X("solid-angle-0", SOLID_ANGLE, 0, 1, POWER)                               \
    X("solid-angle-4", SOLID_ANGLE, 4, 1, POWER)                               \
    X("cosine-4", COSINE, 4, 1, POWER)                                         \
    X("hemisphere-4", HEMISPHERE, 4, 1, POWER)                                 \
    X("area-1-lights-4", AREA, 1, 4, POWER)                                    \
    X("area-4-lights-2", AREA, 4, 2, POWER)                                    \
    X("mis-4-lights-2", MIS, 4, 2, POWER)                                      \
    X("area-1-all", AREA, 1, 1, ALL)

typedef struct {
    const char *name;
    ql_settings_t settings;
} cost_way_t;

#define COST_WAY(name, d, bounces, samples, choice)                            \
    {name, {COST_SIZE, COST_SIZE, COST_SPP, 0, bounces, QL_SAMPLER_SOBOL,      \
                   QL_DIRECT_##d, QL_INDIRECT_BRDF, QL_LIGHTS_##choice,        \
                   samples, 0, 0, QL_IF_BUILT(QL_CFG_ADAPTIVE, 0)}},
static const cost_way_t cost_ways[] = {COST_WAYS(COST_WAY)};
#define COST_WAYS_COUNT (sizeof cost_ways / sizeof cost_ways[0])

#endif
