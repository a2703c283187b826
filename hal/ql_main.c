/* ql_main.c - main() of every board: one picture, its settings from make */
/* SPDX-License-Identifier: MIT */

#include "app/ql_app.h"
#include "board.h"
#include "ql_hal.h"

/* QL_APP_WIDTH, QL_APP_HEIGHT: px. QL_APP_SPP: samples a pixel. QL_APP_SEED:
 * any. QL_APP_BOUNCES: indirect reflections. QL_APP_SAMPLER: ql_sampler_kind_t.
 * QL_APP_DIRECT, QL_APP_INDIRECT, QL_APP_LIGHTS: ql_direct_t, ql_indirect_t,
 * ql_light_choice_t. QL_APP_LIGHT_SAMPLES: of each emitter, or directions.
 * QL_APP_ROULETTE: 0 or 1. QL_APP_ERROR: relative error of a pixel, a part of
 * 1, 0 for all samples. QL_APP_EXPOSURE: stops brighter than the scene's
 * exposure, with QL_APP_METER 1 than the metered one. QL_APP_CURVE: ql_curve_t.
 * QL_APP_CLAMP: radiance in the units of Ke, 0 for no limit. QL_APP_INTERLACE:
 * px between lines of the first pass, a power of two. */
#ifndef QL_APP_WIDTH
#define QL_APP_WIDTH 64
#endif
#ifndef QL_APP_HEIGHT
#define QL_APP_HEIGHT 64
#endif
#ifndef QL_APP_SPP
#define QL_APP_SPP 4
#endif
#ifndef QL_APP_SEED
#define QL_APP_SEED 0
#endif
#ifndef QL_APP_BOUNCES
#define QL_APP_BOUNCES 4
#endif
#ifndef QL_APP_SAMPLER
#define QL_APP_SAMPLER QL_SAMPLER_SOBOL
#endif
#ifndef QL_APP_DIRECT
#define QL_APP_DIRECT QL_DIRECT_AREA
#endif
#ifndef QL_APP_INDIRECT
#define QL_APP_INDIRECT QL_INDIRECT_BRDF
#endif
#ifndef QL_APP_LIGHTS
#define QL_APP_LIGHTS QL_LIGHTS_POWER
#endif
#ifndef QL_APP_LIGHT_SAMPLES
#define QL_APP_LIGHT_SAMPLES 1
#endif
#ifndef QL_APP_ROULETTE
#define QL_APP_ROULETTE 0
#endif
#ifndef QL_APP_ERROR
#define QL_APP_ERROR 0
#endif
#ifndef QL_APP_EXPOSURE
#define QL_APP_EXPOSURE 0
#endif
#ifndef QL_APP_METER
#define QL_APP_METER 0
#endif
#ifndef QL_APP_CLAMP
#define QL_APP_CLAMP 0
#endif
#ifndef QL_APP_CURVE
#define QL_APP_CURVE QL_CURVE_SRGB
#endif
#ifndef QL_APP_INTERLACE
#define QL_APP_INTERLACE 1
#endif

/* BOARD_PANEL of board.mk says so too. */
QL_STATIC_ASSERT(
        QL_PORT_PANEL_WIDTH == 0 ||
                (QL_CFG_PANEL && (QL_CFG_FORMATS >> QL_PORT_PANEL_FORMAT & 1)),
        ql_build_has_the_panels_format);

/* What a build may lack. */
#define OPTIONAL_SETTINGS                                                      \
    QL_IF_BUILT(QL_CFG_ADAPTIVE, .error_q16 = QL_ERROR_Q16(QL_APP_ERROR), )    \
    QL_IF_BUILT(QL_ROLL_OFF, .curve = QL_APP_CURVE, )                          \
    QL_IF_BUILT(QL_CFG_METER, .meter = QL_APP_METER, )                         \
    QL_IF_BUILT(QL_CFG_CLAMP, .clamp_q16 = QL_CLAMP_Q16(QL_APP_CLAMP))

int main(void)
{
    static uint8_t work[QL_WORK_BYTES(
            QL_APP_WIDTH, QL_PORT_PANEL_WIDTH, QL_PORT_PANEL_FORMAT)];
    static const ql_app_t app = {
            .settings = {.width = QL_APP_WIDTH,
                    .height = QL_APP_HEIGHT,
                    .spp = QL_APP_SPP,
                    .seed = QL_APP_SEED,
                    .bounces = QL_APP_BOUNCES,
                    .sampler = QL_APP_SAMPLER,
                    .direct = QL_APP_DIRECT,
                    .indirect = QL_APP_INDIRECT,
                    .lights = QL_APP_LIGHTS,
                    .light_samples = QL_APP_LIGHT_SAMPLES,
                    .roulette = QL_APP_ROULETTE,
                    .exposure_q8 = QL_EXPOSURE_Q8(QL_APP_EXPOSURE),
                    OPTIONAL_SETTINGS},
            .interlace = QL_APP_INTERLACE,
            .work = work,
            .work_bytes = sizeof work,
            .tick_hz = QL_PORT_TICK_HZ,
    };

    ql_hal_exit(ql_app_run(&app));
    return 0;
}
