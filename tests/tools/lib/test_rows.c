/* test_rows.c - rows on threads: every sample once, counters, a stop */
/* SPDX-License-Identifier: MIT */

#include <signal.h>
#include <stdlib.h>

#include "lib/render/rows.h"
#include "support/ql_test.h"

enum { WIDTH = 37, HEIGHT = 29 };

/* What the threads share: of each pixel the sample that comes next. Only the
 * thread of a row writes there, which the sanitizers would tell. */
typedef struct {
    uint32_t next[HEIGHT][WIDTH];
    uint32_t first;
    bool in_order[HEIGHT];
    uint64_t samples; /* collected */
    unsigned finished[HEIGHT];
    uint32_t stop_at; /* raise a signal at this sample of pixel (3, 5) */
} job_t;

static void draw(void *shared, void *own, uint16_t x, uint16_t y,
        uint32_t first, uint32_t count)
{
    job_t *job = shared;
    uint32_t *counter = own;

    if (job->first + job->next[y][x] != first) {
        job->in_order[y] = false;
    }
    job->next[y][x] += count;
    *counter += count;
    if (job->stop_at != 0 && x == 3 && y == 5 && first == job->stop_at) {
        (void)raise(SIGINT);
    }
}

static void finish(void *shared, void *own, uint16_t y)
{
    (void)own;
    ((job_t *)shared)->finished[y]++;
}

static void collect(void *shared, void *own)
{
    ((job_t *)shared)->samples += *(uint32_t *)own;
    *(uint32_t *)own = 0;
}

static bool run(job_t *job, const sums_range_t *range, uint32_t step,
        unsigned threads, uint32_t stop_at)
{
    static const uint32_t zero = 0;
    const rows_t rows = {.label = "test",
            .width = WIDTH,
            .range = *range,
            .step = step,
            .threads = threads,
            .quiet = true,
            .job = job,
            .own = &zero,
            .own_bytes = sizeof zero,
            .draw = draw,
            .finish = finish,
            .collect = collect};
    bool done;

    memset(job, 0, sizeof *job);
    memset(job->in_order, 1, sizeof job->in_order);
    job->first = range->sample_first;
    job->stop_at = stop_at;
    cli_hold_signals();
    done = rows_render(&rows);
    (void)cli_release_signals();
    return done;
}

TEST(every_sample_is_drawn_once_and_in_order)
{
    static const unsigned threads[] = {1, 2, 3, 64};
    static const uint32_t steps[] = {1, 5, 16, ROWS_STEP};
    const sums_range_t range = {2, HEIGHT - 3, 7, 23};
    static job_t job;

    for (unsigned i = 0; i < 16; i++) {
        const uint32_t step = steps[i % 4];
        const unsigned n = threads[i / 4];
        CHECK(run(&job, &range, step, n, 0), "%u threads stopped", n);
        for (uint32_t y = 0; y < HEIGHT; y++) {
            const bool inside = y >= range.row_first && y < range.row_end;
            CHECK(job.in_order[y] && job.finished[y] == inside,
                    "step %u, %u threads, row %u", step, n, y);
            for (uint32_t x = 0; x < WIDTH; x++) {
                CHECK(job.next[y][x] == (inside ? 16u : 0u),
                        "step %u, %u threads, pixel %u %u: %u samples", step, n,
                        x, y, job.next[y][x]);
            }
        }
    }
    NOTE("16 ways");
}

TEST(counters_of_all_threads_add_up)
{
    const sums_range_t range = {0, HEIGHT, 0, 1000};
    static job_t job;

    for (unsigned threads = 1; threads <= 4; threads++) {
        (void)run(&job, &range, 100, threads, 0);
        CHECK(job.samples == 1000ul * WIDTH * HEIGHT, "%u threads: %lu",
                threads, (unsigned long)job.samples);
    }
}

/* As many as a large picture has: 1.8e10. */
TEST(more_samples_than_32_bits_count_are_counted)
{
    const sums_range_t range = {0, HEIGHT, 0, 1u << 24};
    static job_t job;

    CHECK(run(&job, &range, 1u << 24, 2, 0), "%s", "not all were done");
    CHECK(job.samples == (uint64_t)WIDTH * HEIGHT << 24, "collected %llu",
            (unsigned long long)job.samples);
}

/* The last claim: nothing runs after a signal. */
TEST(a_signal_stops_within_a_step)
{
    const sums_range_t range = {0, HEIGHT, 0, 1000};
    static job_t job;

    CHECK(!run(&job, &range, 100, 1, 300), "%s", "rows that were all done");
    CHECK(job.finished[4] == 1 && job.finished[5] == 0, "%s",
            "other rows are finished than those above it");
    CHECK(job.next[5][3] == 400, "stopped after %u samples of the pixel",
            job.next[5][3]);
    CHECK(job.samples == (5ul * WIDTH + 3) * 1000 + 400, "collected %lu",
            (unsigned long)job.samples);
}

int main(int argc, char **argv)
{
    cli_begin("test_rows");
    TEST_BEGIN("tools/lib/test_rows", argc, argv);
    RUN(every_sample_is_drawn_once_and_in_order);
    RUN(counters_of_all_threads_add_up);
    RUN(more_samples_than_32_bits_count_are_counted);
    RUN(a_signal_stops_within_a_step);
    return TEST_END();
}
