/* bench_profile.c - the paths of the benchmark alone, to be profiled */
/* SPDX-License-Identifier: MIT */

/* As bench_main.c, but only whole paths: profile.sh counts every instruction
 * from outside. */

#include "bench/bench_board.h"

static ql_status_t run(void)
{
    static ql_scene_t scene;
    static ql_render_t render;
    const ql_status_t status = bench_open(&scene, &render, QL_DIRECT_AREA);
    bench_total_t path = {0, 0};

    if (status == QL_OK) {
        bench_measure_paths(&path, &render);
        bench_print_row(BENCH_PRECISION, "", "path", &path, NULL);
        bench_print_mean("paths", path.calls, 1);
    }
    return status;
}

int main(void)
{
    return bench_run(run);
}
