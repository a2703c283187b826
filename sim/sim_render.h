/* sim_render.h - render what is missing, on several threads, into exact sums */
/* SPDX-License-Identifier: MIT */

#ifndef SIM_RENDER_H
#define SIM_RENDER_H

#include "render/ql_line.h"
#include "lib/sums/sums.h"

/* ql_diag_t, wide enough for a picture of any size. */
typedef struct {
    uint64_t paths;
    uint64_t closest_rays;
    uint64_t shadow_rays;
    uint64_t saturated;
    uint64_t faint;
    double seconds;
} sim_stats_t;

/* What changes no bit. */
typedef struct {
    unsigned threads;                             /* 1 or more */
    bool quiet;                                   /* no progress bar */
    void (*passed)(void *to, const sums_t *sums); /* after each pass but the
                         last, settled sums; or NULL */
    void *to;
} sim_how_t;

/* Add the samples of a range that the sums do not hold. They come in passes of
 * 1, 1, 2, 4, .. samples over all rows, so that early sums are already of the
 * whole picture. If the settings have an error_q16, there is one pass, in which
 * each pixel takes as many as it needs, the number kept in sums->counts.
 *
 *   sums    -  settled, in and out: what it holds, pixels and ranges
 *   render  -  from ql_render_init()
 *   range   -  within the rows in memory; with an error_q16 all samples
 *   how     -
 *   stats   -  out: what happened
 *   return  false if it was interrupted: the sums hold the rows that were
 *           finished. The caller holds signals
 *
 * Memory: a row of sums for each thread.
 */
bool sim_render(sums_t *sums, const ql_render_t *render,
        const sums_range_t *range, const sim_how_t *how, sim_stats_t *stats);

#endif
