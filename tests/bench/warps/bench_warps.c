/* bench_warps.c - instructions per call of each warp on an emulated board */
/* SPDX-License-Identifier: MIT */

/* A firmware of its own, with base, math and sample only, so that the rays of
 * bench_main.c are measured in a core without these. */

#include "bench/bench_board.h"
#include "bench/warps/warp_list.h"

enum { NUMBERS = 256, BATCHES = 4 };

static ql_uniform2_t numbers[NUMBERS];

/* The total of one function over all batches. */
static bench_total_t measure(warp_batch_t run)
{
    bench_total_t total = {0, 0};

    for (uint32_t batch = 0; batch < BATCHES; batch++) {
        uint32_t begin;

        warp_numbers(numbers, batch * NUMBERS, NUMBERS);
        begin = ql_hal_ticks();
        run(numbers, NUMBERS);
        total.ticks += (uint32_t)(ql_hal_ticks() - begin);
        total.calls += NUMBERS;
    }
    return total;
}

int main(void)
{
    ql_status_t status = ql_hal_init();

    if (status == QL_OK && !warp_list_open()) {
        bench_print("# a table or triangle is refused\n");
        status = QL_ERR_RANGE;
    }
    if (status == QL_OK) {
        const bench_total_t empty = measure(warp_batch_empty);

        for (const warp_t *w = warp_list; w->name != NULL; w++) {
            const bench_total_t work = measure(w->run);

            bench_print_row(BENCH_PRECISION, "warp-", w->name, &work, &empty);
        }
    }
    ql_hal_exit(status);
    return 0;
}
