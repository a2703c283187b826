/* ql_settings.h - what a user may choose about a picture */
/* SPDX-License-Identifier: MIT */

#ifndef QL_SETTINGS_H
#define QL_SETTINGS_H

#include "base/ql_base.h"

#define QL_SPP_MAX     (1ul << 24)
#define QL_BOUNCES_MAX 64u

typedef enum {
    QL_SAMPLER_RANDOM, /* independent: a hash of (seed, pixel, index, dim) */
    QL_SAMPLER_SOBOL   /* Owen-scrambled Sobol points, padded in pairs */
} ql_sampler_kind_t;

/* How light that comes straight from emitters is estimated. */
typedef enum {
    QL_DIRECT_NONE, /* not at all; emitters are still seen */
    QL_DIRECT_AREA  /* by points on the emitters */
} ql_direct_t;

/* How light that comes by way of another surface is estimated. */
typedef enum {
    QL_INDIRECT_NONE,  /* not at all */
    QL_INDIRECT_COSINE /* by directions proportional to the cosine */
} ql_indirect_t;

typedef struct {
    uint16_t width; /* px, 1..16384; 0: the scene's own */
    uint16_t height;
    uint32_t spp;     /* samples a pixel, 1..2^24 */
    uint32_t seed;    /* any */
    uint8_t bounces;  /* indirect reflections, 0..64 */
    uint8_t sampler;  /* ql_sampler_kind_t */
    uint8_t direct;   /* ql_direct_t */
    uint8_t indirect; /* ql_indirect_t */
} ql_settings_t;

#define QL_SETTINGS_DEFAULT                                                    \
    {                                                                          \
        0, 0, 16, 0, 4, QL_SAMPLER_SOBOL, QL_DIRECT_AREA, QL_INDIRECT_COSINE   \
    }

#endif
