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

/* How light that comes straight from emitters is estimated. Every strategy but
 * NONE has the same mean. */
typedef enum {
    QL_DIRECT_NONE,        /* not at all; emitters are still seen */
    QL_DIRECT_AREA,        /* by points on the emitters */
    QL_DIRECT_HEMISPHERE,  /* by uniform directions that may hit one */
    QL_DIRECT_COSINE,      /* by directions proportional to the cosine */
    QL_DIRECT_SOLID_ANGLE, /* by directions towards the emitters */
    QL_DIRECT_MIS,         /* by points and directions, balance heuristic */
    QL_DIRECT_AUTO         /* by the one that the blob says */
} ql_direct_t;

/* How light that comes by way of another surface is estimated: by directions
 * with which density per solid angle. All but NONE have the same mean. */
typedef enum {
    QL_INDIRECT_NONE,    /* not at all */
    QL_INDIRECT_COSINE,  /* proportional to the cosine */
    QL_INDIRECT_UNIFORM, /* uniform on the hemisphere */
    QL_INDIRECT_BRDF     /* proportional to BRDF and cosine */
} ql_indirect_t;

/* Which emitters a vertex asks. */
typedef enum {
    QL_LIGHTS_POWER,   /* one, by power */
    QL_LIGHTS_ALL,     /* every one: the sum over the sources */
    QL_LIGHTS_UNIFORM, /* one, each with the same chance */
    QL_LIGHTS_AUTO     /* as the blob says */
} ql_light_choice_t;

/* How light becomes what a display shows (film/ql_curve.h). */
typedef enum {
    QL_CURVE_SRGB,    /* in proportion; white is cut */
    QL_CURVE_FILMIC,  /* Narkowicz's fit of the ACES film curve */
    QL_CURVE_REINHARD /* Reinhard's, with a white point */
} ql_curve_t;

typedef struct {
    uint16_t width; /* px, 1..16384; 0: the scene's own */
    uint16_t height;
    uint32_t spp;          /* samples a pixel, 1..2^24 */
    uint32_t seed;         /* any */
    uint8_t bounces;       /* indirect reflections, 0..64 */
    uint8_t sampler;       /* ql_sampler_kind_t */
    uint8_t direct;        /* ql_direct_t */
    uint8_t indirect;      /* ql_indirect_t */
    uint8_t lights;        /* ql_light_choice_t */
    uint8_t light_samples; /* of each emitter asked, or directions; 1..255 */
    uint8_t roulette;      /* 0 or 1: Russian roulette */
    int16_t exposure_q8;   /* stops, s7.8, brighter than the scene's exposure */
    /* u0.16: a pixel stops at this standard error, a part of its mean; 0: it
     * takes all its samples */
    QL_IF_BUILT(QL_CFG_ADAPTIVE, uint16_t error_q16;)
    QL_IF_BUILT(QL_ROLL_OFF, uint8_t curve;) /* ql_curve_t */
    /* not 0: exposure_q8 is beside the metered exposure, not the scene's */
    QL_IF_BUILT(QL_CFG_METER, uint8_t meter;)
    /* u16.16: light of a contribution above this radiance, in the units of Ke,
     * is cut off; 0: nothing is */
    QL_IF_BUILT(QL_CFG_CLAMP, uint32_t clamp_q16;)
} ql_settings_t;

/* Which gate of ql_config.h a setting needs: a build without GATE refuses a
 * MEMBER from FIRST to LAST, or such a pair of members. This is the only list:
 * tools/dev/gates.awk reads the same rows for make and for make trade. Of a SET
 * the gate has a bit for each value of MEMBER. Beside them, QL_CFG_CURVES has a
 * bit for each ql_curve_t but SRGB; curve does not exist without any, nor
 * error_q16, meter and clamp_q16 without QL_CFG_ADAPTIVE, QL_CFG_METER and
 * QL_CFG_CLAMP.
 *
 *   SET(GATE, MEMBER)
 *   NEED(GATE, MEMBER, FIRST, LAST)
 *   BOTH(GATE, MEMBER, FIRST, LAST, MEMBER, FIRST, LAST) */
#define QL_SETTINGS_NEED(SET, NEED, BOTH)                                      \
    SET(SAMPLERS, sampler)                                                     \
    SET(DIRECT, direct)                                                        \
    SET(LIGHT_CHOICES, lights)                                                 \
    NEED(UNIFORM, indirect, QL_INDIRECT_UNIFORM, QL_INDIRECT_UNIFORM)          \
    NEED(LIGHT_SAMPLES, light_samples, 2, 255)                                 \
    NEED(ROULETTE, roulette, 1, 1)                                             \
    BOTH(INDIRECT, bounces, 1, QL_BOUNCES_MAX, indirect, QL_INDIRECT_COSINE,   \
            QL_INDIRECT_BRDF)

/* Where a setting changes no picture: a MEMBER from FIRST to LAST that is not
 * the default, while WHERE is from FIRST to LAST. Programs and make say so, by
 * this list.
 *
 *   IDLE(MEMBER, FIRST, LAST, WHERE, FIRST, LAST) */
#define QL_SETTINGS_IDLE(IDLE)                                                 \
    IDLE(lights, QL_LIGHTS_ALL, QL_LIGHTS_UNIFORM, direct,                     \
            QL_DIRECT_HEMISPHERE, QL_DIRECT_COSINE)                            \
    IDLE(lights, QL_LIGHTS_ALL, QL_LIGHTS_UNIFORM, direct, QL_DIRECT_NONE,     \
            QL_DIRECT_NONE)                                                    \
    IDLE(light_samples, 1, 255, direct, QL_DIRECT_NONE, QL_DIRECT_NONE)        \
    IDLE(indirect, QL_INDIRECT_COSINE, QL_INDIRECT_BRDF, bounces, 0, 0)        \
    IDLE(bounces, 1, QL_BOUNCES_MAX, indirect, QL_INDIRECT_NONE,               \
            QL_INDIRECT_NONE)                                                  \
    IDLE(roulette, 1, 1, bounces, 0, 0)                                        \
    IDLE(roulette, 1, 1, indirect, QL_INDIRECT_NONE, QL_INDIRECT_NONE)

/* error_q16 of a part of 1, rounded: on a board of a constant, by the compiler.
 *   part  -  0, or from 0.00001 to 0.9999 */
#define QL_ERROR_Q16(part) ((uint16_t)((part)*65536 + 0.5))

/* exposure_q8 of stops, rounded, likewise.
 *   stops  -  -64 to 64 */
#define QL_EXPOSURE_Q8(stops)                                                  \
    ((int16_t)((stops)*256 + ((stops) < 0 ? -0.5 : 0.5)))

/* clamp_q16 of a radiance, likewise.
 *   radiance  -  0, or from 0.0001 to 65535 */
#define QL_CLAMP_Q16(radiance) ((uint32_t)((radiance)*65536.0 + 0.5))

/* Is a setting that was checked this one? Known to the compiler where the build
 * has no other.
 *
 *   direct, lights  -  of ql_settings_t, not AUTO
 *   which           -  not AUTO
 */
QL_INLINE bool ql_direct_is(unsigned direct, ql_direct_t which)
{
    return (QL_CFG_DIRECT >> which & 1) != 0 &&
           (QL_CFG_DIRECT == 1 << which || direct == (unsigned)which);
}

QL_INLINE bool ql_lights_is(unsigned lights, ql_light_choice_t which)
{
    return (QL_CFG_LIGHT_CHOICES >> which & 1) != 0 &&
           (QL_CFG_LIGHT_CHOICES == 1 << which || lights == (unsigned)which);
}

QL_STATIC_ASSERT(1 << QL_DIRECT_MIS == 32 && 1 << QL_DIRECT_SOLID_ANGLE == 16 &&
                         1 << QL_DIRECT_HEMISPHERE == 4 &&
                         1 << QL_DIRECT_COSINE == 8 && QL_DIRECT_AREA == 1,
        bits_of_ql_config_h_are_strategies);

/* The scene's size, 16 samples, seed 0, Sobol points and 4 bounces, or what
 * there is of them in the build, direct light as the blob says, the BRDF, sRGB;
 * in the order of the struct, as C++ wants it. */
#define QL_SETTINGS_OPTIONAL                                                   \
    QL_IF_BUILT(QL_CFG_ADAPTIVE, 0, )                                          \
    QL_IF_BUILT(QL_ROLL_OFF, QL_CURVE_SRGB, )                                  \
    QL_IF_BUILT(QL_CFG_METER, 0, )                                             \
    QL_IF_BUILT(QL_CFG_CLAMP, 0)
#define QL_SETTINGS_DEFAULT                                                    \
    {                                                                          \
        0, 0, 16, 0, QL_CFG_INDIRECT ? 4 : 0,                                  \
                QL_CFG_SAMPLERS & 2 ? QL_SAMPLER_SOBOL : QL_SAMPLER_RANDOM,    \
                QL_DIRECT_AUTO, QL_INDIRECT_BRDF, QL_LIGHTS_AUTO, 1, 0, 0,     \
                QL_SETTINGS_OPTIONAL                                           \
    }

#endif
