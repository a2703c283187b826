/* trade_measure.c - error and cost of ways to render a scene, measured here */
/* SPDX-License-Identifier: MIT */

/* Noise is half the square of the difference of two pictures of other seeds.
 * What is missing after the last bounce is the difference to a picture of the
 * same seed with many bounces: their paths are the same until there, so it has
 * little noise, and the product of two such differences of other seeds has the
 * mean of its square. A reference of many samples is only what differences are
 * relative to, so its own error hardly counts. */

#include "trade/scene/trade_measure.h"

#include <math.h>
#include <stdlib.h>

#include "lib/program/cli.h"
#include "lib/render/rows.h"

#define PILOT        32u  /* samples of each of two pictures of a strategy */
#define TRIED        32u  /* samples after which bounces are left out */
#define REFERENCE    20e9 /* instructions on a Cortex-M3 of the reference, */
#define WORK         9e10 /* and of a strategy with all its bounces */
#define QUICK        20   /* part of that work */
#define LEAST_ERROR  1e-6
#define ENOUGH       0.0095 /* an error that need not fall further */
#define NOTHING_LEFT 0.002  /* an error of which no more bounces are needed */
#define COST_STEP    3      /* of every third pixel of every third row */
#define COST_SPP     4

static const uint8_t bounces[] = {1, 2, 4, 8, 16, 24};

/* ---- Pictures ---------------------------------------------------------- */

/* A picture that samples are added to. */
typedef struct {
    ql_settings_t settings;
    ql_sum_t *sums;
    uint32_t samples; /* of each pixel so far */
} picture_t;

static size_t pixels_of(const trade_measure_t *m)
{
    return (size_t)m->width * m->height;
}

static void picture_begin(picture_t *p, const trade_measure_t *m,
        const ql_settings_t *settings, uint32_t seed)
{
    p->settings = *settings;
    p->settings.seed = seed;
    p->sums = cli_alloc(pixels_of(m), sizeof *p->sums);
    p->samples = 0;
}

static void draw(void *job, void *own, uint16_t x, uint16_t y, uint32_t first,
        uint32_t count)
{
    picture_t *p = job;

    ql_render_pixel(own, x, y, first, count,
            p->sums + (size_t)y * p->settings.width + x);
}

static void collect(void *job, void *own)
{
    (void)job;
    (void)own;
}

/* Render until each pixel has so many samples. */
static void picture_go_on(
        picture_t *p, const trade_measure_t *m, uint32_t samples)
{
    ql_render_t render;
    rows_t rows = {.label = "",
            .width = m->width,
            .range = {0, m->height, p->samples, samples},
            .step = ROWS_STEP,
            .threads = m->threads,
            .quiet = true,
            .job = p,
            .own = &render,
            .own_bytes = sizeof render,
            .draw = draw,
            .collect = collect};

    if (ql_render_init(&render, m->scene, &p->settings) != QL_OK) {
        cli_fail(CLI_INPUT, "the scene cannot be rendered in %ux%u", m->width,
                m->height);
    }
    (void)rows_render(&rows);
    p->samples = samples;
}

/* Value i of a picture, three a pixel; the unit does not matter. */
static double value_of(const picture_t *p, size_t i)
{
    return (double)p->sums[i / 3].rgb[i % 3] / p->samples;
}

static double mean_of(const picture_t *p, size_t values)
{
    double sum = 0;

    for (size_t i = 0; i < values; i++) {
        sum += value_of(p, i);
    }
    return sum / (double)values;
}

/* ---- Errors ------------------------------------------------------------ */

/* What differences are relative to, of each value. */
typedef struct {
    double *square; /* v^2 + 0.01 mean^2 */
    size_t values;
} scale_t;

static void scale_begin(scale_t *scale, const picture_t *reference,
        size_t values, const char *name)
{
    const double mean = mean_of(reference, values);

    if (!(mean > 0)) {
        cli_fail(CLI_INPUT, "%s: the picture is black; has it lights?", name);
    }
    scale->square = cli_alloc(values, sizeof *scale->square);
    scale->values = values;
    for (size_t i = 0; i < values; i++) {
        const double v = value_of(reference, i);

        scale->square[i] = v * v + 0.01 * mean * mean;
    }
}

/* Root of the relative variance of a picture, by another one. */
static double noise_of(
        const scale_t *scale, const picture_t *x, const picture_t *y)
{
    double sum = 0;

    for (size_t i = 0; i < scale->values; i++) {
        const double d = value_of(x, i) - value_of(y, i);

        sum += d * d / 2 / scale->square[i];
    }
    return fmax(sqrt(sum / (double)scale->values), LEAST_ERROR);
}

/* Root of the relative square of what x has not that deep has: twice, for
 * two seeds. */
static double floor_of(
        const scale_t *scale, const picture_t x[2], const picture_t deep[2])
{
    double sum = 0;

    for (size_t i = 0; i < scale->values; i++) {
        sum += (value_of(x + 0, i) - value_of(deep + 0, i)) *
               (value_of(x + 1, i) - value_of(deep + 1, i)) / scale->square[i];
    }
    return sqrt(fmax(sum / (double)scale->values, 0));
}

/* ---- Cost -------------------------------------------------------------- */

static void count_cost(trade_way_t *way, const trade_measure_t *m)
{
    cost_events_t events = {0};
    ql_render_t render;
    ql_settings_t s = way->settings;
    double samples = 0;

    if (ql_render_init(&render, m->scene, &s) != QL_OK) {
        cli_fail(CLI_INPUT, "the scene cannot be rendered in %ux%u", m->width,
                m->height);
    }
    for (unsigned y = 1; y < s.height; y += COST_STEP) {
        for (unsigned x = 1; x < s.width; x += COST_STEP) {
            ql_sum_t sum = {{0, 0, 0}};

            cost_render_pixel(&events, &render, (uint16_t)x, (uint16_t)y, 0,
                    COST_SPP, &sum);
            samples += COST_SPP;
        }
    }
    for (unsigned core = 0; core < COST_CORES; core++) {
        way->cost[core] =
                (double)cost_instructions(&events, (cost_core_t)core, 0) /
                samples;
    }
}

/* The largest i for which 2^i samples take so much work at most.
 *
 *   instructions  -  of a sample, on a Cortex-M3
 */
static unsigned doublings(
        const trade_measure_t *m, double instructions, double work)
{
    const double picture = instructions * (double)pixels_of(m);
    const double most = log2((m->quick ? work / QUICK : work) / picture);

    return most < 5                ? 5
           : most < TRADE_DOTS - 1 ? (unsigned)most
                                   : TRADE_DOTS - 1;
}

/* ---- Ways -------------------------------------------------------------- */

static ql_settings_t settings_of(const trade_measure_t *m, ql_direct_t direct,
        uint8_t samples, ql_light_choice_t lights)
{
    ql_settings_t s = QL_SETTINGS_DEFAULT;

    s.width = m->width;
    s.height = m->height;
    s.spp = QL_SPP_MAX;
    s.direct = (uint8_t)direct;
    s.light_samples = samples;
    s.lights = (uint8_t)lights;
    return s;
}

static void add_way(trade_way_t *ways, unsigned *count,
        const trade_measure_t *m, ql_settings_t settings)
{
    const trade_way_t none = {.settings = settings};

    ways[*count] = none;
    count_cost(ways + *count, m);
    (*count)++;
}

/* The strategies that are tried; every light is asked where there are few. */
static unsigned list_strategies(trade_way_t *ways, const trade_measure_t *m)
{
    static const ql_direct_t directs[] = {
            QL_DIRECT_AREA, QL_DIRECT_MIS, QL_DIRECT_SOLID_ANGLE};
    unsigned count = 0;

    for (unsigned d = 0; d < 3; d++) {
        add_way(ways, &count, m,
                settings_of(m, directs[d], 1, QL_LIGHTS_POWER));
    }
    for (uint8_t samples = 2; samples <= 4; samples *= 2) {
        for (unsigned d = 0; d < 2; d++) {
            add_way(ways, &count, m,
                    settings_of(m, directs[d], samples, QL_LIGHTS_POWER));
        }
    }
    for (unsigned d = 0;
            d < 2 && m->scene->light_count > 1 && m->scene->light_count <= 8;
            d++) {
        add_way(ways, &count, m, settings_of(m, directs[d], 1, QL_LIGHTS_ALL));
    }
    return count;
}

/* Bring those to the front that have the least noise at equal work on a
 * Cortex-M3; of equal ones the first one alone. */
static void choose(trade_way_t *ways, unsigned count, const trade_measure_t *m,
        const scale_t *scale)
{
    double work[TRADE_WAYS];

    for (unsigned i = 0; i < count; i++) {
        picture_t x, y;
        double noise;

        picture_begin(&x, m, &ways[i].settings, 0);
        picture_begin(&y, m, &ways[i].settings, 1);
        picture_go_on(&x, m, PILOT);
        picture_go_on(&y, m, PILOT);
        noise = noise_of(scale, &x, &y);
        work[i] = noise * noise * ways[i].cost[COST_M3];
        free(x.sums);
        free(y.sums);
        for (unsigned k = 0; k < i; k++) { /* the same by another name */
            work[i] = work[k] == work[i] ? HUGE_VAL : work[i];
        }
        cli_progress("strategies", i + 1, count, m->quiet);
    }
    for (unsigned i = 0; i < TRADE_KEPT; i++) {
        unsigned least = i;
        trade_way_t way;

        for (unsigned k = i + 1; k < count; k++) {
            least = work[k] < work[least] ? k : least;
        }
        way = ways[least];
        for (unsigned k = least; k > i; k--) {
            ways[k] = ways[k - 1];
            work[k] = work[k - 1];
        }
        ways[i] = way;
    }
}

static void make_reference(scale_t *scale, trade_measure_t *m, const char *name)
{
    trade_way_t way = {
            .settings = settings_of(m, QL_DIRECT_MIS, 1, QL_LIGHTS_POWER)};
    picture_t reference;

    way.settings.bounces = bounces[TRADE_BOUNCES - 1];
    count_cost(&way, m);
    m->reference_samples = (uint32_t)1
                           << doublings(m, way.cost[COST_M3], REFERENCE);
    picture_begin(&reference, m, &way.settings, 2);
    for (uint32_t i = 1; i <= 8; i++) { /* 32 samples or more */
        picture_go_on(&reference, m, m->reference_samples / 8 * i);
        cli_progress("reference", i, 8, m->quiet);
    }
    scale_begin(scale, &reference, 3 * pixels_of(m), name);
    free(reference.sums);
}

/* A strategy with each number of bounces: two pictures of each. */
typedef struct {
    trade_way_t *ways; /* TRADE_BOUNCES of them */
    picture_t pictures[TRADE_BOUNCES][2];
    bool out[TRADE_BOUNCES]; /* not followed any more */
} strategy_t;

/* Leave out what misses too much, and what more bounces add nothing to. */
static void leave_out(strategy_t *s)
{
    for (unsigned k = 0; k < TRADE_BOUNCES; k++) {
        s->out[k] = s->ways[k].curve.floor > 0.1 ||
                    (k > 0 && s->ways[k - 1].curve.floor < NOTHING_LEFT);
    }
}

/* Add the dots of 2^i samples. */
static void add_dots(strategy_t *s, const trade_measure_t *m,
        const scale_t *scale, unsigned i)
{
    const picture_t *deep = NULL;

    for (unsigned k = TRADE_BOUNCES; k-- > 0;) {
        trade_curve_t *c = &s->ways[k].curve;

        if (s->out[k]) {
            continue;
        }
        for (unsigned seed = 0; seed < 2; seed++) {
            picture_go_on(&s->pictures[k][seed], m, (uint32_t)1 << i);
        }
        deep = deep == NULL ? s->pictures[k] : deep;
        c->noise[i] = noise_of(scale, s->pictures[k], s->pictures[k] + 1);
        c->floor = floor_of(scale, s->pictures[k], deep);
        c->count = i + 1;
    }
}

/* Are all errors as small as they need be? */
static bool is_enough(const strategy_t *s)
{
    for (unsigned k = 0; k < TRADE_BOUNCES; k++) {
        const trade_curve_t *c = &s->ways[k].curve;

        if (!s->out[k] && c->floor < ENOUGH &&
                trade_curve_error(c, c->count - 1) > ENOUGH) {
            return false;
        }
    }
    return true;
}

/* Render a strategy with each number of bounces, its samples doubling. */
static void follow(trade_measure_t *m, const trade_way_t *like,
        const scale_t *scale, unsigned turn)
{
    strategy_t s = {.ways = m->ways + m->count};
    double instructions = 0;
    unsigned most;

    for (unsigned k = 0; k < TRADE_BOUNCES; k++) {
        ql_settings_t settings = like->settings;

        settings.bounces = bounces[k];
        add_way(m->ways, &m->count, m, settings);
        instructions += 2 * s.ways[k].cost[COST_M3];
        for (unsigned seed = 0; seed < 2; seed++) {
            picture_begin(&s.pictures[k][seed], m, &settings, seed);
        }
    }
    most = doublings(m, instructions, WORK);
    for (unsigned i = 0; i <= most; i++) {
        add_dots(&s, m, scale, i);
        cli_progress("errors", ((uint64_t)turn << most) + ((uint64_t)1 << i),
                (uint64_t)TRADE_KEPT << most, m->quiet);
        if ((uint32_t)1 << i == TRIED) {
            leave_out(&s);
        }
        if ((uint32_t)1 << i >= TRIED && is_enough(&s)) {
            break;
        }
    }
    for (unsigned k = 0; k < TRADE_BOUNCES; k++) {
        trade_curve_extend(&s.ways[k].curve);
        free(s.pictures[k][0].sums);
        free(s.pictures[k][1].sums);
    }
}

void trade_measure(trade_measure_t *measure, const char *name)
{
    static trade_way_t strategies[TRADE_WAYS];
    const unsigned tried = list_strategies(strategies, measure);
    scale_t scale;

    make_reference(&scale, measure, name);
    choose(strategies, tried, measure, &scale);
    measure->count = 0;
    for (unsigned i = 0; i < TRADE_KEPT; i++) {
        follow(measure, strategies + i, &scale, i);
    }
    cli_progress("errors", 1, 1, measure->quiet);
    free(scale.square);
}
