/* bench_strategies.c - instructions per path under each direct strategy */
/* SPDX-License-Identifier: MIT */

/* As bench_main.c, but only whole paths, and SCENE any scene. The core has all
 * strategies only if it is built with STRATEGIES=1. */

#include "bench/bench_board.h"

static ql_status_t measure(const char *name, ql_direct_t direct)
{
    static ql_scene_t scene;
    static ql_render_t render;
    const ql_status_t status = bench_open(&scene, &render, direct);
    bench_total_t path = {0, 0};

    if (status == QL_OK) {
        bench_measure_paths(&path, &render);
        bench_print_row(BENCH_PRECISION, "path-", name, &path, NULL);
    } else {
        bench_print("# path-");
        bench_print(name);
        bench_print(": the core does not render this\n");
    }
    return status;
}

static ql_status_t run(void)
{
    static const struct {
        const char *name;
        ql_direct_t direct;
    } strategies[] = {{"area", QL_DIRECT_AREA},
            {"hemisphere", QL_DIRECT_HEMISPHERE}, {"cosine", QL_DIRECT_COSINE},
            {"solid-angle", QL_DIRECT_SOLID_ANGLE}, {"mis", QL_DIRECT_MIS}};
    ql_status_t status = QL_OK;

    for (unsigned i = 0; i < sizeof strategies / sizeof strategies[0]; i++) {
        const ql_status_t s = measure(strategies[i].name, strategies[i].direct);

        status = s == QL_OK ? status : s;
    }
    return status;
}

int main(void)
{
    return bench_run(run);
}
