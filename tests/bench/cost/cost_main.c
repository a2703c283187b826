/* cost_main.c - fit the table of costs to counted runs, or check it by them */
/* SPDX-License-Identifier: MIT */

/* A row "BLOB WIDTH HEIGHT STEP CORE PRECISION WAY N" says that every STEPth
 * pixel of every STEPth line took N instructions a sample, 4 samples each. WAY
 * is DIRECT-BOUNCES, and perhaps -lights-SAMPLES or -all: mis-4-lights-2.
 *
 * With n the events of that sample, counted here, and x what they cost, n.x = N
 * is an equation. For each core and precision x is what brings the sum of the
 * squares of relative errors down most, nothing in it below 0. */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lib/cost/cost.h"
#include "lib/program/cli.h"
#include "lib/render/open_blob.h"

#define SPP    4
#define ROUNDS 100000u

/* A counted run. */
typedef struct {
    char name[96]; /* "cornell.qlb cortex-m3 draft mis-4" */
    cost_core_t core;
    unsigned precision;
    double counted;       /* instructions a sample */
    cost_events_t events; /* of all samples */
    double samples;
} row_t;

static ql_settings_t settings_of(const char *way)
{
    static const char *const directs[] = {"none-", "area-", "hemisphere-",
            "cosine-", "solid-angle-", "mis-"}; /* as ql_direct_t */
    ql_settings_t s = QL_SETTINGS_DEFAULT;
    const char *lights = strstr(way, "-lights-");

    for (unsigned i = 0; i < sizeof directs / sizeof directs[0]; i++) {
        if (strncmp(way, directs[i], strlen(directs[i])) == 0) {
            s.direct = (uint8_t)i;
            s.bounces = (uint8_t)atoi(way + strlen(directs[i]));
        }
    }
    if (lights != NULL) {
        s.light_samples = (uint8_t)atoi(lights + strlen("-lights-"));
    }
    s.lights = strstr(way, "-all") != NULL ? QL_LIGHTS_ALL : QL_LIGHTS_POWER;
    return s;
}

/* Render what the board rendered. */
static void count(row_t *row, const char *blob_name, const ql_settings_t *s,
        unsigned step)
{
    ql_scene_t scene;
    ql_render_t render;
    void *blob = open_blob(&scene, blob_name);

    if (ql_render_init(&render, &scene, s) != QL_OK) {
        cli_fail(CLI_INPUT, "%s: expected settings of this core", row->name);
    }
    for (unsigned y = step > 1; y < s->height; y += step) {
        for (unsigned x = step > 1; x < s->width; x += step) {
            ql_sum_t sum = {{0, 0, 0}};

            cost_render_pixel(&row->events, &render, (uint16_t)x, (uint16_t)y,
                    0, SPP, &sum);
            row->samples += SPP;
        }
    }
    free(blob);
}

static bool read_row(row_t *row, FILE *file)
{
    char blob[1024], core[32], precision[8], way[40];
    unsigned width, height, step;
    ql_settings_t s;

    if (fscanf(file, "%1023s %u %u %u %31s %7s %39s %lf", blob, &width, &height,
                &step, core, precision, way, &row->counted) != 8) {
        return false;
    }
    snprintf(row->name, sizeof row->name, "%.40s %.16s %.8s %.24s",
            strrchr(blob, '/') != NULL ? strrchr(blob, '/') + 1 : blob, core,
            precision, way);
    if (!cost_core_find(&row->core, core) || step == 0) {
        cli_fail(CLI_INPUT, "%s: expected a core of the table", row->name);
    }
    row->precision = strcmp(precision, "fine") == 0;
    s = settings_of(way);
    s.width = (uint16_t)width;
    s.height = (uint16_t)height;
    count(row, blob, &s, step);
    return true;
}

/* Events of a sample over the instructions of one. */
static void equation(double n[COST_EVENT_COUNT], const row_t *row)
{
    const double scale = 1 / (row->samples * row->counted);
    unsigned i = 0;

#define EVENT(event, what) n[i++] = scale * (double)row->events.event;
    COST_EVENTS(EVENT)
#undef EVENT
}

/* Least squares without a coefficient below 0: each in turn takes its best. */
static void fit(double x[COST_EVENT_COUNT], const row_t *rows, size_t n_rows,
        cost_core_t core, unsigned precision)
{
    double square[COST_EVENT_COUNT][COST_EVENT_COUNT] = {{0}};
    double right[COST_EVENT_COUNT] = {0}, n[COST_EVENT_COUNT];

    for (size_t r = 0; r < n_rows; r++) {
        if (rows[r].core != core || rows[r].precision != precision) {
            continue;
        }
        equation(n, rows + r);
        for (unsigned i = 0; i < COST_EVENT_COUNT; i++) {
            right[i] += n[i];
            for (unsigned k = 0; k < COST_EVENT_COUNT; k++) {
                square[i][k] += n[i] * n[k];
            }
        }
    }
    for (unsigned round = 0; round < ROUNDS; round++) {
        for (unsigned i = 0; i < COST_EVENT_COUNT; i++) {
            double rest = right[i];

            for (unsigned k = 0; k < COST_EVENT_COUNT; k++) {
                rest -= k == i ? 0 : square[i][k] * x[k];
            }
            x[i] = square[i][i] > 0 ? fmax(rest / square[i][i], 0) : 0;
        }
    }
}

static void print_table(const row_t *rows, size_t n_rows)
{
    static const char *const names[] = {
#define NAME(event, what) #event,
            COST_EVENTS(NAME)
#undef NAME
    };
    static double x[COST_CORES][2][COST_EVENT_COUNT];

    for (unsigned core = 0; core < COST_CORES; core++) {
        fit(x[core][0], rows, n_rows, (cost_core_t)core, 0);
        fit(x[core][1], rows, n_rows, (cost_core_t)core, 1);
    }
    printf("/* cost_table.h - GENERATED by make cost-table: tenths of "
           "instructions */\n/* SPDX-License-Identifier: MIT */\n\n"
           "/* What one of each event takes, in draft and in fine, on each "
           "core "
           "in turn. */\n/* clang-format off */\nstatic const uint32_t "
           "cost_table[COST_EVENT_COUNT][COST_CORES][2] = {\n");
    for (unsigned i = 0; i < COST_EVENT_COUNT; i++) {
        printf("    /* %s */\n    {", names[i]);
        for (unsigned core = 0; core < COST_CORES; core++) {
            printf("%s{%.0f, %.0f}", core == 0 ? "" : ", ", 10 * x[core][0][i],
                    10 * x[core][1][i]);
        }
        printf("},\n");
    }
    printf("};\n");
}

/* A line a row; true if every one is within the limit. */
static bool check(const row_t *rows, size_t n_rows, double limit)
{
    bool good = n_rows > 0;

    for (size_t r = 0; r < n_rows; r++) {
        const row_t *row = rows + r;
        const double said = (double)cost_instructions(
                                    &row->events, row->core, row->precision) /
                            row->samples;
        const double off = said / row->counted - 1;

        printf("%s: counted %.0f, said %.0f, %+.1f %%\n", row->name,
                row->counted, said, 100 * off);
        good = good && fabs(off) <= limit;
    }
    return good;
}

int main(int argc, char **argv)
{
    row_t *rows = NULL;
    size_t n = 0;

    cli_begin("cost-model");
    if (argc != 2) {
        cli_fail(CLI_USAGE, "usage: cost-model fit|LIMIT < rows");
    }
    for (;; n++) {
        rows = realloc(rows, (n + 1) * sizeof *rows);
        if (rows == NULL) {
            cli_fail(CLI_IO, "out of memory");
        }
        memset(rows + n, 0, sizeof *rows);
        if (!read_row(rows + n, stdin)) {
            break;
        }
    }
    if (strcmp(argv[1], "fit") == 0) {
        print_table(rows, n);
    } else if (!check(rows, n, atof(argv[1]))) {
        return CLI_ABOVE;
    }
    free(rows);
    return CLI_DONE;
}
