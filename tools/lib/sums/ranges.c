/* ranges.c - which samples of which rows: disjoint, joined, counted */
/* SPDX-License-Identifier: MIT */

#include "lib/sums/ranges.h"

#include <stdlib.h>
#include <string.h>

#include "lib/program/cli.h"
#include "lib/sums/marks.h"

void ranges_add(ranges_t *list, const sums_range_t *range)
{
    const uint32_t n = list->count;

    if ((n & (n - 1)) == 0) { /* full at every power of two, and at 0 */
        list->items = realloc(
                list->items, (n == 0 ? 1 : 2 * (size_t)n) * sizeof *range);
        if (list->items == NULL || n > UINT32_MAX / 2) {
            cli_fail(CLI_IO, "out of memory for %u ranges", (unsigned)n);
        }
    }
    list->items[list->count++] = *range;
}

void ranges_free(ranges_t *list)
{
    free(list->items);
    memset(list, 0, sizeof *list);
}

void ranges_count(const ranges_t *list, uint32_t *counts, uint32_t height)
{
    memset(counts, 0, height * sizeof *counts);
    for (uint32_t i = 0; i < list->count; i++) { /* steps, which may wrap */
        const sums_range_t *r = list->items + i;
        const uint32_t n = r->sample_end - r->sample_first;

        counts[r->row_first] += n;
        if (r->row_end < height) {
            counts[r->row_end] -= n;
        }
    }
    for (uint32_t y = 1; y < height; y++) {
        counts[y] += counts[y - 1];
    }
}

uint64_t ranges_samples(const sums_range_t *range)
{
    return (uint64_t)(range->row_end - range->row_first) *
           (range->sample_end - range->sample_first);
}

/* Where below y, within the whole, another set of ranges holds the rows. */
static uint32_t strip_end(
        const ranges_t *list, const sums_range_t *whole, uint32_t y)
{
    uint32_t end = whole->row_end;

    for (uint32_t i = 0; i < list->count; i++) {
        const sums_range_t *r = list->items + i;

        end = r->row_first > y && r->row_first < end ? r->row_first : end;
        end = r->row_end > y && r->row_end < end ? r->row_end : end;
    }
    return end;
}

static int by_first_sample(const void *a, const void *b)
{
    const sums_range_t *x = a, *y = b;

    return (x->sample_first > y->sample_first) -
           (x->sample_first < y->sample_first);
}

/* What is missing in rows that the same ranges hold, of which held is a list to
 * work with. */
static void strip_missing(const ranges_t *list, const sums_range_t *whole,
        sums_range_t strip, ranges_t *held, ranges_t *missing)
{
    held->count = 0;
    for (uint32_t i = 0; i < list->count; i++) {
        const sums_range_t *r = list->items + i;

        if (r->row_first <= strip.row_first && r->row_end > strip.row_first &&
                r->sample_end > whole->sample_first &&
                r->sample_first < whole->sample_end) {
            held->items[held->count++] = *r;
        }
    }
    qsort(held->items, held->count, sizeof *held->items, by_first_sample);
    strip.sample_first = whole->sample_first;
    for (uint32_t i = 0; i <= held->count; i++) {
        strip.sample_end = i < held->count ? held->items[i].sample_first
                                           : whole->sample_end;
        if (strip.sample_first < strip.sample_end) {
            ranges_add(missing, &strip);
        }
        strip.sample_first = i < held->count ? held->items[i].sample_end : 0;
    }
}

void ranges_missing(
        const ranges_t *list, const sums_range_t *whole, ranges_t *missing)
{
    ranges_t held = {0, cli_alloc(list->count, sizeof *held.items)};
    sums_range_t strip = *whole;
    uint32_t clash[2];

    memset(missing, 0, sizeof *missing);
    while (strip.row_first < whole->row_end) {
        strip.row_end = strip_end(list, whole, strip.row_first);
        strip_missing(list, whole, strip, &held, missing);
        strip.row_first = strip.row_end;
    }
    (void)ranges_join(missing, clash); /* none overlap */
    free(held.items);
}

/* ---- A sweep downwards --------------------------------------------------- */

/* A range begins or ends above a row. Ends come first. */
typedef struct {
    uint32_t key;   /* 2 * row, and 1 if it begins */
    uint32_t range; /* its number */
} event_t;

/* What a row holds at the ends of samples, which are numbered in order: k is
 * the k-th smallest. A run of ranges that touch begins and ends at edges. */
typedef struct {
    const ranges_t *list;
    event_t *events; /* two a range, sorted */
    uint32_t *samples;
    uint32_t sample_count;
    uint32_t (*ends)[2]; /* the numbers of the ends of each range */
    bool *begins;        /* of each number: does one of the row begin there? */
    bool *stops;         /* does one stop there? */
    marks_t edges;       /* where only one of both is so */
    uint32_t *run_end;   /* of the run that was seen to begin there, or 0 */
    uint32_t *run_row;   /* where that run was first seen */
    uint32_t *touched;   /* beginnings of runs that may change */
    ranges_t joined;
} sweep_t;

static int compare_numbers(const void *a, const void *b)
{
    const uint32_t *p = a, *q = b;

    return (*p > *q) - (*p < *q);
}

static int compare_events(const void *a, const void *b)
{
    const event_t *p = a, *q = b;
    const int keys = compare_numbers(&p->key, &q->key);

    return keys != 0 ? keys : compare_numbers(&p->range, &q->range);
}

static int compare_ranges(const void *a, const void *b)
{
    const sums_range_t *p = a, *q = b;
    const int rows = compare_numbers(&p->row_first, &q->row_first);

    return rows != 0 ? rows
                     : compare_numbers(&p->sample_first, &q->sample_first);
}

static uint32_t number_of(const sweep_t *s, uint32_t sample)
{
    const uint32_t *at = bsearch(&sample, s->samples, s->sample_count,
            sizeof sample, compare_numbers);

    return (uint32_t)(at - s->samples); /* it is there */
}

static void begin_sweep(sweep_t *s, const ranges_t *list)
{
    const size_t n = list->count;

    memset(s, 0, sizeof *s);
    s->list = list;
    s->events = cli_alloc(2 * n, sizeof *s->events);
    s->samples = cli_alloc(2 * n, sizeof *s->samples);
    s->ends = cli_alloc(n, sizeof *s->ends);
    s->begins = cli_alloc(2 * n, sizeof *s->begins);
    s->stops = cli_alloc(2 * n, sizeof *s->stops);
    s->run_end = cli_alloc(2 * n, sizeof *s->run_end);
    s->run_row = cli_alloc(2 * n, sizeof *s->run_row);
    s->touched = cli_alloc(4 * n, sizeof *s->touched);
    for (uint32_t i = 0; i < n; i++) {
        const sums_range_t *r = list->items + i;

        s->events[2 * (size_t)i] = (event_t){2 * r->row_first + 1, i};
        s->events[2 * (size_t)i + 1] = (event_t){2 * r->row_end, i};
        s->samples[2 * (size_t)i] = r->sample_first;
        s->samples[2 * (size_t)i + 1] = r->sample_end;
    }
    qsort(s->events, 2 * n, sizeof *s->events, compare_events);
    qsort(s->samples, 2 * n, sizeof *s->samples, compare_numbers);
    for (size_t i = 0; i < 2 * n; i++) { /* each once: below 2^32 */
        if (i == 0 || s->samples[i] != s->samples[s->sample_count - 1]) {
            s->samples[s->sample_count++] = s->samples[i];
        }
    }
    for (uint32_t i = 0; i < n; i++) {
        s->ends[i][0] = number_of(s, list->items[i].sample_first);
        s->ends[i][1] = number_of(s, list->items[i].sample_end);
    }
    marks_new(&s->edges, s->sample_count + (s->sample_count == 0));
}

static void end_sweep(sweep_t *s)
{
    free(s->events);
    free(s->samples);
    free(s->ends);
    free(s->begins);
    free(s->stops);
    free(s->run_end);
    free(s->run_row);
    free(s->touched);
    marks_free(&s->edges);
}

/* The run that k is in or at an end of, if there is one. */
static bool find_run(const sweep_t *s, uint32_t k, uint32_t run[2])
{
    const uint32_t edge = marks_before(&s->edges, k);

    if (edge == MARKS_NONE || (s->stops[edge] && edge < k)) {
        return false;
    }
    run[0] = s->stops[edge] ? marks_before(&s->edges, edge - 1) : edge;
    run[1] = s->stops[edge] ? edge : marks_after(&s->edges, edge + 1);
    return true;
}

/* Does a run hold anything between a and b? */
static bool is_taken(const sweep_t *s, uint32_t a, uint32_t b)
{
    const uint32_t before = marks_before(&s->edges, a);
    const uint32_t after = marks_after(&s->edges, a + 1);

    return (before != MARKS_NONE && s->begins[before]) || after < b;
}

static void turn(sweep_t *s, bool *of, uint32_t k)
{
    of[k] = !of[k];
    marks_set(&s->edges, k, s->begins[k] != s->stops[k]);
}

/* Let the ranges of some events end and begin; the first that overlaps one is
 * returned, or else MARKS_NONE. */
static uint32_t apply(sweep_t *s, const event_t *events, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        const uint32_t *ends = s->ends[events[i].range];

        if (events[i].key % 2 != 0 && is_taken(s, ends[0], ends[1])) {
            return events[i].range;
        }
        turn(s, s->begins, ends[0]);
        turn(s, s->stops, ends[1]);
    }
    return MARKS_NONE;
}

/* Runs before the events of a row, whose beginnings are touched, are over where
 * they have changed. */
static void close_runs(sweep_t *s, size_t touched, uint32_t row)
{
    for (size_t i = 0; i < touched; i++) {
        const uint32_t first = s->touched[i], end = s->run_end[first];
        uint32_t run[2];

        if (end != 0 && !(find_run(s, first, run) && run[0] == first &&
                                run[1] == end)) {
            const sums_range_t range = {
                    s->run_row[first], row, s->samples[first], s->samples[end]};

            ranges_add(&s->joined, &range);
            s->run_end[first] = 0;
        }
    }
}

/* All events above one row. */
static uint32_t step(sweep_t *s, const event_t *events, size_t n)
{
    const uint32_t row = events->key / 2;
    uint32_t run[2], clash;
    size_t touched = 0;

    for (size_t i = 0; i < 2 * n; i++) {
        if (find_run(s, s->ends[events[i / 2].range][i % 2], run)) {
            s->touched[touched++] = run[0];
        }
    }
    clash = apply(s, events, n);
    if (clash != MARKS_NONE) {
        return clash;
    }
    close_runs(s, touched, row);
    for (size_t i = 0; i < 2 * n; i++) {
        if (find_run(s, s->ends[events[i / 2].range][i % 2], run) &&
                s->run_end[run[0]] == 0) {
            s->run_end[run[0]] = run[1];
            s->run_row[run[0]] = row;
        }
    }
    return MARKS_NONE;
}

static bool overlap(const sums_range_t *a, const sums_range_t *b)
{
    return a->row_first < b->row_end && b->row_first < a->row_end &&
           a->sample_first < b->sample_end && b->sample_first < a->sample_end;
}

/* A range overlaps another one: which? */
static void find_clash(const ranges_t *list, uint32_t one, uint32_t clash[2])
{
    uint32_t other = 0;

    while (other == one || !overlap(list->items + one, list->items + other)) {
        other++;
    }
    clash[0] = one < other ? one : other;
    clash[1] = one < other ? other : one;
}

bool ranges_join(ranges_t *list, uint32_t clash[2])
{
    const size_t n = 2 * (size_t)list->count;
    uint32_t bad = MARKS_NONE;
    sweep_t s;

    begin_sweep(&s, list);
    for (size_t i = 0, end; i < n && bad == MARKS_NONE; i = end) {
        end = i + 1;
        while (end < n && s.events[end].key / 2 == s.events[i].key / 2) {
            end++;
        }
        bad = step(&s, s.events + i, end - i);
    }
    end_sweep(&s);
    if (bad != MARKS_NONE) {
        find_clash(list, bad, clash);
        ranges_free(&s.joined);
        return false;
    }
    ranges_free(list);
    *list = s.joined;
    if (list->count > 0) {
        qsort(list->items, list->count, sizeof *list->items, compare_ranges);
    }
    return true;
}
