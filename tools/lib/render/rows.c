/* rows.c - a picture's rows on several threads: steps, progress, a stop */
/* SPDX-License-Identifier: MIT */

#include "lib/render/rows.h"

#include <inttypes.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

/* What the threads share; the lock guards all that changes. */
typedef struct {
    pthread_mutex_t lock;
    const rows_t *rows;
    uint32_t next_row;
    uint64_t done; /* samples, or what an early end made unnecessary */
    uint64_t total;
} shared_t;

/* The next row, or row_end if there is none. */
static uint32_t take_row(shared_t *shared)
{
    const uint32_t end = shared->rows->range.row_end;
    uint32_t row;

    pthread_mutex_lock(&shared->lock);
    row = cli_interrupted() ? end : shared->next_row;
    shared->next_row += row < end;
    pthread_mutex_unlock(&shared->lock);
    return row;
}

/* Hand in what a thread did, if anything: the bar ends once. */
static void report(shared_t *shared, void *own, uint64_t *samples)
{
    const rows_t *rows = shared->rows;

    if (*samples == 0) {
        return;
    }
    pthread_mutex_lock(&shared->lock);
    rows->collect(rows->job, own);
    shared->done += *samples;
    cli_progress(rows->label, rows->before + shared->done,
            rows->total != 0 ? rows->total : shared->total, rows->quiet);
    pthread_mutex_unlock(&shared->lock);
    *samples = 0;
}

/* A row, in steps short enough to stop soon. */
static void draw_row(shared_t *shared, void *own, uint32_t y)
{
    const rows_t *rows = shared->rows;
    const uint32_t end = rows->range.sample_end;
    uint64_t fresh = 0;
    bool whole = true;

    for (uint32_t x = 0; x < rows->width; x++) {
        uint32_t at = rows->range.sample_first;
        while (at < end && !cli_interrupted()) {
            const uint32_t n = end - at < rows->step ? end - at : rows->step;
            rows->draw(rows->job, own, (uint16_t)x, (uint16_t)y, at, n);
            at += n;
            fresh += n;
            if (fresh >= ROWS_STEP) {
                report(shared, own, &fresh);
            }
        }
        whole = whole && at == end;
    }
    if (whole && rows->finish != NULL) {
        rows->finish(rows->job, own, (uint16_t)y);
    }
    report(shared, own, &fresh);
}

static void *work(void *argument)
{
    shared_t *shared = argument;
    const rows_t *rows = shared->rows;
    void *own = cli_alloc(rows->own_bytes, 1);
    uint32_t y;

    memcpy(own, rows->own, rows->own_bytes);
    while ((y = take_row(shared)) < rows->range.row_end) {
        draw_row(shared, own, y);
    }
    free(own);
    return NULL;
}

/* This thread and count - 1 others; fewer if the system has no more. */
static void run_threads(shared_t *shared, unsigned count)
{
    pthread_t *threads = cli_alloc(count, sizeof *threads);
    unsigned started = 0;

    while (started + 1 < count &&
            pthread_create(threads + started, NULL, work, shared) == 0) {
        started++;
    }
    work(shared);
    while (started > 0) {
        pthread_join(threads[--started], NULL);
    }
    free(threads);
}

bool rows_render(const rows_t *rows)
{
    const sums_range_t *r = &rows->range;
    const uint32_t count = r->row_end - r->row_first;
    shared_t shared;

    memset(&shared, 0, sizeof shared);
    shared.rows = rows;
    shared.next_row = r->row_first;
    shared.total =
            (uint64_t)count * rows->width * (r->sample_end - r->sample_first);
    pthread_mutex_init(&shared.lock, NULL);
    run_threads(&shared, rows->threads < count ? rows->threads : count);
    pthread_mutex_destroy(&shared.lock);
    return shared.done == shared.total && !cli_interrupted();
}

void rows_print_stats(
        uint64_t paths, uint64_t closest_rays, uint64_t shadow_rays)
{
    const double rays = (double)closest_rays + (double)shadow_rays;

    printf("paths: %" PRIu64 "\n", paths);
    printf("closest-rays: %" PRIu64 "\n", closest_rays);
    printf("shadow-rays: %" PRIu64 "\n", shadow_rays);
    printf("rays-per-path: %.3f\n", paths != 0 ? rays / (double)paths : 0);
}
