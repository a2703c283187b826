/* bench_cost.c - on a board: instructions of a sample, each way that it can */
/* SPDX-License-Identifier: MIT */

#include "bench/bench_board.h"
#include "bench/cost/cost_settings.h"
#include "blob/ql_blob_open.h"

/* Time every sample of the picture. */
static void measure(bench_total_t *total, ql_render_t *render)
{
    for (uint16_t y = 0; y < COST_SIZE; y++) {
        const uint32_t begin = ql_hal_ticks();

        for (uint16_t x = 0; x < COST_SIZE; x++) {
            ql_sum_t sum = {{0, 0, 0}};

            ql_render_pixel(render, x, y, 0, COST_SPP, &sum);
            BENCH_KEEP(&sum);
        }
        total->ticks += (uint32_t)(ql_hal_ticks() - begin);
        total->calls += COST_SIZE * COST_SPP;
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
    for (unsigned i = 0; i < COST_WAYS_COUNT && status == QL_OK; i++) {
        bench_total_t total = {0, 0};

        if (ql_render_init(&render, &scene, &cost_ways[i].settings) == QL_OK) {
            measure(&total, &render);
            bench_print_row(
                    BENCH_PRECISION, "", cost_ways[i].name, &total, NULL);
        }
    }
    return status;
}

int main(void)
{
    return bench_run(run);
}
