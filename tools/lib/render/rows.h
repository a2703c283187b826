/* rows.h - a picture's rows on several threads: steps, progress, a stop */
/* SPDX-License-Identifier: MIT */

/* rows.c starts the only threads of the product. qlux-sim, qlux-ref and
 * qlux-trade link it, so no other program needs a thread library.
 *
 * Rows are handed out one by one, and each pixel is written by the one thread
 * that has its row, its samples in order: the number of threads changes no bit.
 * Pixels need no lock therefore; counters do, and are handed in under it. */

#ifndef ROWS_H
#define ROWS_H

#include "lib/sums/sums.h"

#define ROWS_STEP 4096u /* samples between two reports: some milliseconds */

/* Add samples to one pixel.
 *
 *   job    -   rows_t.job
 *   own    -   the thread's copy of rows_t.own
 *   x, y   px  the pixel, from the top left
 *   first  -   index of the first sample
 *   count  -   how many, 1 to rows_t.step
 */
typedef void rows_draw_t(void *job, void *own, uint16_t x, uint16_t y,
        uint32_t first, uint32_t count);

/* A row of the range is complete. Called in the thread that drew it, and that
 * alone has it. */
typedef void rows_finish_t(void *job, void *own, uint16_t y);

/* Move the counters of a thread into those of the job and leave zeros: 32 bits
 * would wrap. Called by one thread at a time. */
typedef void rows_collect_t(void *job, void *own);

/* What to render, and with what. */
typedef struct {
    const char *label;  /* of the progress bar */
    uint32_t width;     /* px, 1..65535 */
    sums_range_t range; /* rows and samples; all within 16 bits and 2^24 */
    uint32_t step;      /* most samples of one call; 1 or more */
    uint64_t before;    /* for the bar, samples of all pixels: done before */
    uint64_t total;     /* ... and of all calls; 0: this one is all */
    unsigned threads;   /* 1 or more; fewer run if the system has no more */
    bool quiet;         /* no progress bar */
    void *job;          /* shared by the threads */
    const void *own;    /* each thread works on a copy of this */
    size_t own_bytes;
    rows_draw_t *draw;
    rows_finish_t *finish; /* or NULL */
    rows_collect_t *collect;
} rows_t;

/* Render them, in this thread and rows->threads - 1 others.
 *
 *   return  false if a signal stopped it (cli_interrupted()): some rows were
 *           not finished. The caller holds signals
 *
 * Fails: cli_fail(CLI_IO) if there is no memory.
 */
bool rows_render(const rows_t *rows);

/* Print how many paths and rays that took, as --stats does. */
void rows_print_stats(
        uint64_t paths, uint64_t closest_rays, uint64_t shadow_rays);

#endif
