/* sim_render.h - render rows on several threads into exact sums */
/* SPDX-License-Identifier: MIT */

#ifndef SIM_RENDER_H
#define SIM_RENDER_H

#include "render/ql_line.h"
#include "lib/render/sums.h"

/* ql_diag_t, wide enough for a picture of any size. */
typedef struct {
    uint64_t paths;
    uint64_t closest_rays;
    uint64_t shadow_rays;
    uint64_t saturated;
    uint64_t faint;
    double seconds;
} sim_stats_t;

/* Add the samples of a range to the sums; or, if the settings have an
 * error_q16, let each pixel take as many as it needs, the number kept in
 * sums->counts.
 *
 *   sums     -  its pixels; ranges are the caller's business
 *   render   -  from ql_render_init()
 *   range    -  within the picture; with an error_q16 all samples
 *   threads  -  1 or more; changes no bit
 *   quiet    -  no progress bar
 *   stats    -  out: what happened
 *   return   false if interrupted: the sums are incomplete
 */
bool sim_render(sums_t *sums, const ql_render_t *render,
        const sums_range_t *range, unsigned threads, bool quiet,
        sim_stats_t *stats);

#endif
