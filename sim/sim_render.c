/* sim_render.c - render rows on several threads into exact sums */
/* SPDX-License-Identifier: MIT */

#include "sim/sim_render.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

/* Samples between two looks at the clock and at Ctrl-C: some milliseconds. */
#define STEP_SAMPLES 4096u

/* What the threads share. Rows are handed out one by one; each pixel is written
 * by the one thread that has its row, so only the rest needs the lock. */
typedef struct {
    pthread_mutex_t lock;
    ql_sum_t *pixels;
    uint32_t *counts; /* NULL: each pixel takes every sample of the range */
    const ql_render_t *render;
    sums_range_t range;
    uint32_t next_row;
    uint64_t done; /* samples, or what an early end made unnecessary */
    uint64_t total;
    bool quiet;
    sim_stats_t stats;
} job_t;

/* The next row, or row_end if there is none. */
static uint32_t take_row(job_t *job)
{
    uint32_t row;

    pthread_mutex_lock(&job->lock);
    row = job->next_row;
    if (row < job->range.row_end && !cli_interrupted()) {
        job->next_row++;
    } else {
        row = job->range.row_end;
    }
    pthread_mutex_unlock(&job->lock);
    return row;
}

/* Hand in what a thread did. Its counters start again: 32 bits would wrap. */
static void report(job_t *job, ql_diag_t *diag, uint32_t *samples)
{
    pthread_mutex_lock(&job->lock);
    job->stats.paths += diag->paths;
    job->stats.closest_rays += diag->closest_rays;
    job->stats.shadow_rays += diag->shadow_rays;
    job->stats.saturated += diag->saturated;
    job->stats.faint += diag->faint;
    job->done += *samples;
    cli_progress("rendering", job->done, job->total, job->quiet);
    pthread_mutex_unlock(&job->lock);
    memset(diag, 0, sizeof *diag);
    *samples = 0;
}

#if QL_CFG_ADAPTIVE
/* A row whose pixels end by themselves; each counts as done entirely. */
static void render_row_adaptive(job_t *job, ql_render_t *render, uint32_t y)
{
    const uint32_t width = render->settings.width;

    for (uint32_t x = 0; x < width && !cli_interrupted(); x++) {
        const size_t i = (size_t)width * y + x;
        uint32_t spp = render->settings.spp;
        job->counts[i] = ql_render_adaptive(
                render, (uint16_t)x, (uint16_t)y, job->pixels + i);
        report(job, &render->diag, &spp);
    }
}
#endif

/* A row, in steps short enough to stop soon. Sums are exact, so steps change
 * no bit. */
static void render_row(job_t *job, ql_render_t *render, uint32_t y)
{
    const uint32_t width = render->settings.width;
    uint32_t fresh = 0;

    for (uint32_t x = 0; x < width; x++) {
        ql_sum_t *sum = job->pixels + (size_t)width * y + x;
        uint32_t at = job->range.sample_first;
        while (at < job->range.sample_end && !cli_interrupted()) {
            const uint32_t left = job->range.sample_end - at;
            const uint32_t n = left < STEP_SAMPLES ? left : STEP_SAMPLES;
            ql_render_pixel(render, (uint16_t)x, (uint16_t)y, at, n, sum);
            at += n;
            fresh += n;
            if (fresh >= STEP_SAMPLES) {
                report(job, &render->diag, &fresh);
            }
        }
    }
    report(job, &render->diag, &fresh);
}

static void *work(void *shared)
{
    job_t *job = shared;
    ql_render_t render = *job->render; /* counters of its own */
    uint32_t y;

    while ((y = take_row(job)) < job->range.row_end) {
#if QL_CFG_ADAPTIVE
        if (job->counts != NULL) {
            render_row_adaptive(job, &render, y);
            continue;
        }
#endif
        render_row(job, &render, y);
    }
    return NULL;
}

/* This thread and count - 1 others; fewer if the system has no more. */
static void run_threads(job_t *job, unsigned count)
{
    pthread_t *threads = cli_alloc(count, sizeof *threads);
    unsigned started = 0;

    while (started + 1 < count &&
            pthread_create(threads + started, NULL, work, job) == 0) {
        started++;
    }
    work(job);
    while (started > 0) {
        pthread_join(threads[--started], NULL);
    }
    free(threads);
}

bool sim_render(sums_t *sums, const ql_render_t *render,
        const sums_range_t *range, unsigned threads, bool quiet,
        sim_stats_t *stats)
{
    const uint32_t rows = range->row_end - range->row_first;
    const double begun = cli_seconds();
    job_t job;

    memset(&job, 0, sizeof job);
    pthread_mutex_init(&job.lock, NULL);
#if QL_CFG_ADAPTIVE
    if (render->settings.error_q16 != 0) {
        sums_own_counts(sums);
    }
#endif
    job.pixels = sums->pixels;
    job.counts = sums->counts;
    job.render = render;
    job.range = *range;
    job.next_row = range->row_first;
    job.total = (uint64_t)rows * render->settings.width *
                (range->sample_end - range->sample_first);
    job.quiet = quiet;
    run_threads(&job, threads < rows ? threads : rows);
    pthread_mutex_destroy(&job.lock);
    *stats = job.stats;
    stats->seconds = cli_seconds() - begun;
    return job.done == job.total;
}
