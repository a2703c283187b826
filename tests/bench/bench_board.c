/* bench_board.c - what the boards' benchmarks share: rows, counter, paths */
/* SPDX-License-Identifier: MIT */

#include "bench/bench_board.h"
#include "blob/ql_blob_open.h"

#include "blob/ql_blob_open.h"

int bench_run(ql_status_t (*run)(void))
{
    ql_status_t status = ql_hal_init();

    if (status == QL_OK) {
        status = run();
    }
    ql_hal_exit(status);
    return 0;
}

void bench_print(const char *text)
{
    uint16_t size = 0;

    while (text[size] != '\0') {
        size++;
    }
    if (ql_hal_serial_write((const uint8_t *)text, size) != QL_OK) {
        ql_hal_exit(QL_ERR_SERIAL);
    }
}

void bench_print_number(uint32_t number)
{
    char text[11];
    unsigned i = sizeof text - 1;

    text[i] = '\0';
    do {
        text[--i] = (char)('0' + number % 10);
        number /= 10;
    } while (number > 0);
    bench_print(text + i);
}

/* Nanoseconds of the board's time, which are instructions, a call. */
static uint32_t mean_of(const bench_total_t *total)
{
    const uint64_t ns = total->ticks * 1000000000u / QL_PORT_TICK_HZ;

    return total->calls == 0
                   ? 0
                   : (uint32_t)((ns + total->calls / 2) / total->calls);
}

/* A C name as the name of a row. */
static void print_name(const char *name)
{
    char letter[2] = {0, 0};

    for (; *name != '\0'; name++) {
        letter[0] = *name;
        bench_print(*name == '_' ? "-" : letter);
    }
}

void bench_print_row(const char *precision, const char *prefix,
        const char *what, const bench_total_t *work, const bench_total_t *empty)
{
    const uint32_t loop = empty == NULL ? 0 : mean_of(empty);

    bench_print(QL_BENCH_CORE " ");
    bench_print(precision);
    bench_print(" ");
    bench_print(prefix);
    print_name(what);
    bench_print(": ");
    bench_print_number(mean_of(work) - loop);
    bench_print("\n");
}

void bench_print_mean(const char *what, uint32_t number, uint32_t count)
{
    const uint32_t hundredths =
            count == 0 ? 0 : (number * 100 + count / 2) / count;

    bench_print("# ");
    bench_print(what);
    bench_print(": ");
    bench_print_number(hundredths / 100);
    bench_print(hundredths % 100 < 10 ? ".0" : ".");
    bench_print_number(hundredths % 100);
    bench_print("\n");
}

ql_status_t bench_open(
        ql_scene_t *scene, ql_render_t *render, ql_direct_t direct)
{
    ql_settings_t settings = QL_SETTINGS_DEFAULT;
    const void *blob;
    size_t size;
    ql_status_t status;

    settings.width = QL_BENCH_SIZE;
    settings.height = QL_BENCH_SIZE;
    settings.spp = QL_BENCH_SPP;
    settings.bounces = QL_BENCH_BOUNCES;
    settings.direct = (uint8_t)direct;
    settings.lights = QL_LIGHTS_POWER;
    ql_hal_scene_blob(&blob, &size);
    status = ql_blob_open(scene, blob, size);
    return status == QL_OK ? ql_render_init(render, scene, &settings) : status;
}

void bench_measure_paths(bench_total_t *total, ql_render_t *render)
{
    for (uint16_t y = 0; y < QL_BENCH_SIZE; y++) {
        const uint32_t begin = ql_hal_ticks();

        for (uint16_t x = 0; x < QL_BENCH_SIZE; x++) {
            ql_sum_t sum = {{0, 0, 0}};

            ql_render_pixel(render, x, y, 0, QL_BENCH_SPP, &sum);
            BENCH_KEEP(&sum);
        }
        total->ticks += (uint32_t)(ql_hal_ticks() - begin);
        total->calls += QL_BENCH_SIZE * QL_BENCH_SPP;
    }
}
