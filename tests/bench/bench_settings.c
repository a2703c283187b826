/* bench_settings.c - instructions per sample under each of some settings */
/* SPDX-License-Identifier: MIT */

/* The list is in trade_settings.h, which tools/trade/trade.sh writes. Every
 * third pixel of every third line is rendered: the same samples, fewer of them.
 */

#include "bench/bench_board.h"
#include "blob/ql_blob_open.h"
#include "trade_settings.h"

#define STEP 3u

static void measure_lines(bench_total_t *total, ql_render_t *render)
{
    const ql_settings_t *s = &render->settings;

    for (uint16_t y = 1; y < s->height; y = (uint16_t)(y + STEP)) {
        const uint32_t begin = ql_hal_ticks();

        for (uint16_t x = 1; x < s->width; x = (uint16_t)(x + STEP)) {
            ql_sum_t sum = {{0, 0, 0}};

            if (s->error_q16 != 0) {
                total->calls += ql_render_adaptive(render, x, y, &sum);
            } else {
                ql_render_pixel(render, x, y, 0, s->spp, &sum);
                total->calls += s->spp;
            }
            BENCH_KEEP(&sum);
        }
        total->ticks += (uint32_t)(ql_hal_ticks() - begin);
    }
}

static ql_status_t run(void)
{
    static ql_scene_t scene;
    static ql_render_t render;
    const void *blob;
    size_t size;
    ql_status_t status;

    ql_hal_scene_blob(&blob, &size);
    status = ql_blob_open(&scene, blob, size);
    for (unsigned i = 0; i < TRADE_COUNT && status == QL_OK; i++) {
        bench_total_t total = {0, 0};

        status = ql_render_init(&render, &scene, &trade_settings[i].settings);
        if (status == QL_OK) {
            measure_lines(&total, &render);
            bench_print_row(
                    BENCH_PRECISION, "", trade_settings[i].name, &total, NULL);
        }
    }
    return status;
}

int main(void)
{
    return bench_run(run);
}
