/* trade_table.c - read the table of measurements, find what is best */
/* SPDX-License-Identifier: MIT */

#include <stdlib.h>
#include <string.h>

#include "lib/files/kind.h"
#include "lib/program/cli.h"
#include "trade/trade.h"

static const char header[] =
        "scene,core,name,knob,precision,table_bits,table_lerp,node_bits,leaf,"
        "options,samples,error,bias,instructions_per_sample,"
        "instructions_per_pixel";

enum {
    SCENE,
    CORE,
    NAME,
    KNOB,
    PRECISION,
    TABLE_BITS,
    TABLE_LERP,
    NODE_BITS,
    LEAF,
    OPTIONS,
    SAMPLES,
    ERROR,
    BIAS,
    PER_SAMPLE,
    PER_PIXEL,
    FIELDS
};

/* Cut a line at its commas; false unless there are as many fields. */
static bool cut(char *line, char *field[FIELDS])
{
    for (int i = 0; i < FIELDS; i++) {
        field[i] = line;
        line = strchr(line, ',');
        if (line == NULL) {
            return i == FIELDS - 1;
        }
        *line++ = '\0';
    }
    return false;
}

/* Numbers are positive but the bias. */
static bool number(const char *text, double least, double *value)
{
    char *end;

    *value = strtod(text, &end);
    return end != text && *end == '\0' && *value >= least && *value < 1e30;
}

static bool take(trade_point_t *p, char *field[FIELDS])
{
    const bool nearest = strcmp(field[TABLE_LERP], "0") == 0;
    double per_sample;

    for (int i = 0; i < FIELDS; i++) {
        if (strlen(field[i]) >= TRADE_TEXT / 2 && i != OPTIONS) {
            return false;
        }
    }
    snprintf(p->scene, sizeof p->scene, "%s", field[SCENE]);
    snprintf(p->core, sizeof p->core, "%s", field[CORE]);
    snprintf(p->name, sizeof p->name, "%s", field[NAME]);
    snprintf(p->knob, sizeof p->knob, "%s", field[KNOB]);
    snprintf(p->options, sizeof p->options, "%.*s", TRADE_TEXT - 1,
            field[OPTIONS]);
    snprintf(p->build, sizeof p->build, "%.10s%s%.4s%s%s%.4s%s%.4s",
            field[PRECISION],
            strcmp(field[TABLE_BITS], "7") == 0 && !nearest ? "" : ", tables ",
            strcmp(field[TABLE_BITS], "7") == 0 && !nearest ? ""
                                                            : field[TABLE_BITS],
            nearest ? " nearest" : "",
            strcmp(field[NODE_BITS], "16") == 0 ? "" : ", node bits ",
            strcmp(field[NODE_BITS], "16") == 0 ? "" : field[NODE_BITS],
            strcmp(field[LEAF], "4") == 0 ? "" : ", leaf ",
            strcmp(field[LEAF], "4") == 0 ? "" : field[LEAF]);
    return number(field[SAMPLES], 1, &p->samples) &&
           number(field[ERROR], 0, &p->error) &&
           number(field[BIAS], -1, &p->bias) &&
           number(field[PER_SAMPLE], 1, &per_sample) &&
           number(field[PER_PIXEL], 1, &p->cost);
}

static bool same_place(const trade_point_t *a, const trade_point_t *b)
{
    return strcmp(a->scene, b->scene) == 0 && strcmp(a->core, b->core) == 0;
}

void trade_mark_best(trade_t *trade)
{
    for (size_t i = 0; i < trade->count; i++) {
        trade_point_t *p = trade->points + i;

        p->best = p->error > 0;
        for (size_t k = 0; k < trade->count && p->best; k++) {
            const trade_point_t *q = trade->points + k;

            p->best = !same_place(p, q) || q->error > p->error ||
                      q->cost > p->cost ||
                      (q->error == p->error && q->cost == p->cost);
        }
    }
}

void trade_read(trade_t *trade, const char *path)
{
    size_t size, room = 0;
    char *text = cli_read(path, &size), *line = text;
    char *field[FIELDS];

    trade->points = NULL;
    trade->count = 0;
    for (unsigned long n = 1; *line != '\0'; n++) {
        char *next = strchr(line, '\n');

        if (next == NULL) {
            kind_refuse_file(path, KIND_TABLE);
            cli_fail(CLI_INPUT, "%s:%lu: the line has no end", path, n);
        }
        *next = '\0';
        if (n == 1) {
            if (strcmp(line, header) != 0) {
                kind_refuse_file(path, KIND_TABLE);
                cli_fail(CLI_INPUT, "%s:1: expected %s", path, header);
            }
        } else {
            if (trade->count == room) {
                room = 2 * room + 64;
                trade->points =
                        realloc(trade->points, room * sizeof *trade->points);
                if (trade->points == NULL) {
                    cli_fail(CLI_IO, "out of memory");
                }
            }
            if (!cut(line, field) ||
                    !take(trade->points + trade->count, field)) {
                cli_fail(CLI_INPUT, "%s:%lu: expected a row of %s", path, n,
                        header);
            }
            trade->count++;
        }
        line = next + 1;
    }
    if (trade->count == 0) {
        cli_fail(CLI_INPUT, "%s: no rows", path);
    }
    free(text);
    trade_mark_best(trade);
}

void trade_free(trade_t *trade)
{
    free(trade->points);
    trade->points = NULL;
    trade->count = 0;
}

const trade_point_t *trade_cheapest(
        const trade_t *trade, const char *scene, const char *core, double error)
{
    const trade_point_t *best = NULL;

    for (size_t i = 0; i < trade->count; i++) {
        const trade_point_t *p = trade->points + i;

        if (p->error > 0 && p->error <= error && strcmp(p->scene, scene) == 0 &&
                strcmp(p->core, core) == 0 &&
                (best == NULL || p->cost < best->cost)) {
            best = p;
        }
    }
    return best;
}

const trade_point_t *trade_next_best(
        const trade_t *trade, const trade_point_t *like, double cost)
{
    const trade_point_t *next = NULL;

    for (size_t i = 0; i < trade->count; i++) {
        const trade_point_t *p = trade->points + i;

        if (p->best && p->cost > cost && same_place(p, like) &&
                (next == NULL || p->cost < next->cost)) {
            next = p;
        }
    }
    return next;
}

bool trade_new_scene(const trade_t *trade, size_t i)
{
    for (size_t k = 0; k < i; k++) {
        if (strcmp(trade->points[k].scene, trade->points[i].scene) == 0) {
            return false;
        }
    }
    return true;
}

bool trade_new_core(const trade_t *trade, size_t i)
{
    for (size_t k = 0; k < i; k++) {
        if (same_place(trade->points + k, trade->points + i)) {
            return false;
        }
    }
    return true;
}
