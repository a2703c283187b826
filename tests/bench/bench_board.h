/* bench_board.h - what the boards' benchmarks share: rows, counter, paths */
/* SPDX-License-Identifier: MIT */

#ifndef BENCH_BOARD_H
#define BENCH_BOARD_H

#include "bench/rays/bench_rays.h"
#include "board.h"
#include "ql_hal.h"

/* QL_BENCH_CORE: name of the CPU in the rows. QL_BENCH_SIZE: px, the picture is
 * square. QL_BENCH_SPP: samples a pixel. QL_BENCH_BOUNCES: indirect reflections
 * of a path. */
#ifndef QL_BENCH_CORE
#define QL_BENCH_CORE "unknown"
#endif
#ifndef QL_BENCH_SIZE
#define QL_BENCH_SIZE 16
#endif
#ifndef QL_BENCH_SPP
#define QL_BENCH_SPP 4
#endif
#ifndef QL_BENCH_BOUNCES
#define QL_BENCH_BOUNCES BENCH_BOUNCES
#endif

/* Runs of a batch between two looks at the counter: a tick is up to 80
 * instructions, a batch of warps a few thousand. */
#define BENCH_REPEAT 4

#define BENCH_PRECISION (QL_CFG_PRECISION == 0 ? "draft" : "fine")

/* Make the compiler work a result out and forget what it knows of memory. */
#define BENCH_KEEP(pointer) __asm__ volatile("" : : "r"(pointer) : "memory")

/* Ticks and how many calls they were spent on. */
typedef struct {
    uint64_t ticks;
    uint32_t calls;
} bench_total_t;

/* Time count calls, BENCH_REPEAT times: work is a statement about call i. */
#define BENCH_MEASURE(total, count, work)                                      \
    do {                                                                       \
        const uint32_t begin_ = ql_hal_ticks();                                \
                                                                               \
        for (unsigned r_ = 0; r_ < BENCH_REPEAT; r_++) {                       \
            for (uint32_t i = 0; i < (count); i++) {                           \
                work;                                                          \
            }                                                                  \
        }                                                                      \
        (total)->ticks += (uint32_t)(ql_hal_ticks() - begin_);                 \
        (total)->calls += BENCH_REPEAT * (count);                              \
    } while (0)

/* What main() of a benchmark is: bring the board up, run, leave with the status
 * that run returned. */
int bench_run(ql_status_t (*run)(void));

/* Print text; the program ends if the serial port does not take it. */
void bench_print(const char *text);

/* Print a number in decimal. */
void bench_print_number(uint32_t number);

/* Print "CORE PRECISION WHAT: N": instructions a call.
 *
 *   precision  -  draft, fine or float
 *   prefix     -  of what, may be empty
 *   what       -  name of the figure; a '_' is printed as '-'
 *   work       -  the calls
 *   empty      -  the loop around them, taken off; NULL: nothing is
 */
void bench_print_row(const char *precision, const char *prefix,
        const char *what, const bench_total_t *work,
        const bench_total_t *empty);

/* Print "# WHAT: N.NN", a mean over count. */
void bench_print_mean(const char *what, uint32_t number, uint32_t count);

/* Open the board's blob and make it ready to render the benchmark's picture.
 *
 *   scene    -  out; must outlive render
 *   render   -  out
 *   direct   -  ql_direct_t
 *   return   QL_OK, or what ql_blob_open() or ql_render_init() said
 */
ql_status_t bench_open(
        ql_scene_t *scene, ql_render_t *render, ql_direct_t direct);

/* Time every path of the picture: ql_render_pixel().
 *
 *   total   -  added to: a call is one path
 *   render  -  from bench_open()
 */
void bench_measure_paths(bench_total_t *total, ql_render_t *render);

#endif
