/* sim_render.c - render what is missing, on several threads, into exact sums */
/* SPDX-License-Identifier: MIT */

#include "sim/sim_render.h"

#include <stdlib.h>
#include <string.h>

#include "lib/render/rows.h"

/* What the threads share. */
typedef struct {
    sums_t *sums;
    bool *finished; /* of each row of the picture, in this pass */
    ql_sum_t *cut;  /* off each of them */
    sim_stats_t stats;
} job_t;

/* What each of them has: the core's state and a row that is not finished. */
typedef struct {
    ql_render_t render;
    ql_sum_t row[]; /* a picture's width */
} own_t;

/* Sums are exact, so it changes no bit how many samples a call takes. */
static void draw(void *shared, void *own, uint16_t x, uint16_t y,
        uint32_t first, uint32_t count)
{
    own_t *thread = own;

    (void)shared;
    ql_render_pixel(&thread->render, x, y, first, count, thread->row + x);
}

#if QL_CFG_ADAPTIVE
/* A pixel that ends by itself; it counts as done entirely. */
static void draw_adaptive(void *shared, void *own, uint16_t x, uint16_t y,
        uint32_t first, uint32_t count)
{
    sums_t *sums = ((job_t *)shared)->sums;
    own_t *thread = own;

    (void)first;
    (void)count;
    sums->counts[sums_pixels(sums, y) + x - sums->pixels] =
            ql_render_adaptive(&thread->render, x, y, thread->row + x);
}
#endif

/* What was cut off a row. */
static void take_cut(job_t *job, own_t *thread, uint16_t y)
{
#if QL_CFG_CLAMP
    memcpy(job->cut[y].rgb, thread->render.clamp.cut, sizeof job->cut[y].rgb);
    memset(thread->render.clamp.cut, 0, sizeof thread->render.clamp.cut);
#else
    (void)job;
    (void)thread;
    (void)y;
#endif
}

static void finish(void *shared, void *own, uint16_t y)
{
    job_t *job = shared;
    own_t *thread = own;
    const uint32_t width = job->sums->field[SUMS_WIDTH];

    sums_add_pixels(sums_pixels(job->sums, y), thread->row, width);
    memset(thread->row, 0, width * sizeof *thread->row);
    take_cut(job, thread, y);
    job->finished[y] = true;
}

static void collect(void *shared, void *own)
{
    sim_stats_t *stats = &((job_t *)shared)->stats;
    ql_diag_t *diag = &((own_t *)own)->render.diag;

    stats->paths += diag->paths;
    stats->closest_rays += diag->closest_rays;
    stats->shadow_rays += diag->shadow_rays;
    stats->saturated += diag->saturated;
    stats->faint += diag->faint;
    memset(diag, 0, sizeof *diag);
}

/* The sums hold the finished rows of a range now. */
static void take_finished(job_t *job, const sums_range_t *range)
{
    uint32_t clash[2], y = range->row_first;
    sums_range_t rows = *range;

    while (y < range->row_end) {
        rows.row_first = y;
        while (y < range->row_end && job->finished[y]) {
            sums_add_pixels(&job->sums->cut, job->cut + y, 1);
            job->finished[y++] = false;
        }
        rows.row_end = y;
        if (rows.row_first < rows.row_end) {
            ranges_add(&job->sums->ranges, &rows);
        }
        y++; /* one that is not finished, or the end */
    }
    (void)sums_settle(job->sums, clash); /* none was there before */
}

/* Of what is missing the samples from first to end. */
static bool render_pass(rows_t *rows, job_t *job, const ranges_t *missing,
        uint32_t first, uint32_t end)
{
    sums_range_t *r = &rows->range;
    bool done = true;

    for (uint32_t i = 0; i < missing->count && done; i++) {
        *r = missing->items[i];
        r->sample_first = r->sample_first > first ? r->sample_first : first;
        r->sample_end = r->sample_end < end ? r->sample_end : end;
        if (r->sample_first < r->sample_end) {
            done = rows_render(rows);
            take_finished(job, r);
            rows->before += ranges_samples(r) * rows->width;
        }
    }
    return done;
}

/* All of it: least samples, as many again, then twice as many each time. */
static bool render_passes(rows_t *rows, job_t *job, const ranges_t *missing,
        const sums_range_t *range, uint32_t least, const sim_how_t *how)
{
    const uint32_t count = range->sample_end - range->sample_first;
    bool done = true;

    for (uint32_t at = 0, next = least; at < count && done; at = next) {
        next = at == 0 ? least : at < count / 2 ? 2 * at : count;
        done = render_pass(rows, job, missing, range->sample_first + at,
                range->sample_first + next);
        if (done && next < count && how->passed != NULL) {
            how->passed(how->to, job->sums);
        }
    }
    return done;
}

static uint64_t samples_of(const ranges_t *ranges)
{
    uint64_t sum = 0; /* of all rows: < 2^38 */

    for (uint32_t i = 0; i < ranges->count; i++) {
        sum += ranges_samples(ranges->items + i);
    }
    return sum;
}

bool sim_render(sums_t *sums, const ql_render_t *render,
        const sums_range_t *range, const sim_how_t *how, sim_stats_t *stats)
{
    const double begun = cli_seconds();
    const uint32_t width = render->settings.width;
    const size_t own_bytes = sizeof(own_t) + width * sizeof(ql_sum_t);
    own_t *own = cli_alloc(1, own_bytes);
    job_t job = {.sums = sums,
            .finished = cli_alloc(render->settings.height, sizeof(bool)),
            .cut = cli_alloc(render->settings.height, sizeof(ql_sum_t))};
    rows_t rows = {.label = "rendering",
            .width = width,
            .step = ROWS_STEP,
            .threads = how->threads,
            .quiet = how->quiet,
            .job = &job,
            .own = own,
            .own_bytes = own_bytes,
            .draw = draw,
            .finish = finish,
            .collect = collect};
    uint32_t least = 1;
    ranges_t missing;
    bool done;

    own->render = *render;
#if QL_CFG_ADAPTIVE
    if (render->settings.error_q16 != 0) {
        sums_own_counts(sums);
        rows.draw = draw_adaptive;
        rows.step = least = render->settings.spp;
    }
#endif
    ranges_missing(&sums->ranges, range, &missing);
    rows.total = samples_of(&missing) * width;
    done = render_passes(&rows, &job, &missing, range, least, how);
    *stats = job.stats;
    stats->seconds = cli_seconds() - begun;
    ranges_free(&missing);
    free(job.finished);
    free(job.cut);
    free(own);
    return done;
}
