/* ql_main.c - main() of every board: one picture, its settings from make */
/* SPDX-License-Identifier: MIT */

#include "board.h"
#include "ql_app.h"
#include "ql_hal.h"

/* QL_APP_WIDTH, QL_APP_HEIGHT: px. QL_APP_SPP: samples a pixel. QL_APP_SEED:
 * any. QL_APP_BOUNCES: indirect reflections. QL_APP_SAMPLER: ql_sampler_kind_t.
 * QL_APP_INTERLACE: px between lines of the first pass, a power of two. */
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
#ifndef QL_APP_INTERLACE
#define QL_APP_INTERLACE 1
#endif

int main(void)
{
    static uint8_t work[QL_WORK_BYTES(
            QL_APP_WIDTH, QL_PORT_PANEL_WIDTH, QL_PORT_PANEL_FORMAT)];
    static const ql_app_t app = {
            {QL_APP_WIDTH, QL_APP_HEIGHT, QL_APP_SPP, QL_APP_SEED,
                    QL_APP_BOUNCES, QL_APP_SAMPLER, QL_DIRECT_AREA,
                    QL_INDIRECT_COSINE},
            QL_APP_INTERLACE,
            work,
            sizeof work,
            QL_PORT_TICK_HZ,
    };

    ql_hal_exit(ql_app_run(&app));
    return 0;
}
