/* sim_render.c - render rows on several threads into exact sums */
/* SPDX-License-Identifier: MIT */

#include "sim/sim_render.h"

#include <string.h>

#include "lib/render/rows.h"

/* What the threads share. */
typedef struct {
    sums_t *sums;
    sim_stats_t stats;
} job_t;

static ql_sum_t *pixel_of(const job_t *job, uint16_t x, uint16_t y)
{
    return sums_pixels(job->sums, y) + x;
}

/* Sums are exact, so it changes no bit how many samples a call takes. */
static void draw(void *shared, void *own, uint16_t x, uint16_t y,
        uint32_t first, uint32_t count)
{
    ql_render_pixel(own, x, y, first, count, pixel_of(shared, x, y));
}

#if QL_CFG_ADAPTIVE
/* A pixel that ends by itself; it counts as done entirely. */
static void draw_adaptive(void *shared, void *own, uint16_t x, uint16_t y,
        uint32_t first, uint32_t count)
{
    const job_t *job = shared;
    ql_sum_t *sum = pixel_of(job, x, y);

    (void)first;
    (void)count;
    job->sums->counts[sum - job->sums->pixels] =
            ql_render_adaptive(own, x, y, sum);
}
#endif

static void collect(void *shared, void *own)
{
    sim_stats_t *stats = &((job_t *)shared)->stats;
    ql_diag_t *diag = &((ql_render_t *)own)->diag;

    stats->paths += diag->paths;
    stats->closest_rays += diag->closest_rays;
    stats->shadow_rays += diag->shadow_rays;
    stats->saturated += diag->saturated;
    stats->faint += diag->faint;
    memset(diag, 0, sizeof *diag);
}

bool sim_render(sums_t *sums, const ql_render_t *render,
        const sums_range_t *range, unsigned threads, bool quiet,
        sim_stats_t *stats)
{
    const double begun = cli_seconds();
    job_t job = {.sums = sums};
    rows_t rows = {.label = "rendering",
            .width = render->settings.width,
            .range = *range,
            .step = ROWS_STEP,
            .threads = threads,
            .quiet = quiet,
            .job = &job,
            .own = render,
            .own_bytes = sizeof *render,
            .draw = draw,
            .collect = collect};
    bool done;

#if QL_CFG_ADAPTIVE
    if (render->settings.error_q16 != 0) {
        sums_own_counts(sums);
        rows.draw = draw_adaptive;
        rows.step = render->settings.spp;
    }
#endif
    done = rows_render(&rows);
    *stats = job.stats;
    stats->seconds = cli_seconds() - begun;
    return done;
}
