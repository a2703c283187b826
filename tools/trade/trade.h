/* trade.h - measured choices: what a pixel costs and how far off it is */
/* SPDX-License-Identifier: MIT */

#ifndef TRADE_H
#define TRADE_H

#include "figure/figure.h"

#define TRADE_TEXT 96

/* A line of the table: one choice, one number of samples, one core. */
typedef struct {
    char scene[TRADE_TEXT];
    char core[TRADE_TEXT];
    char name[TRADE_TEXT];
    char knob[TRADE_TEXT];
    char build[TRADE_TEXT]; /* precision, tables, nodes, leaves */
    char options[TRADE_TEXT];
    double samples; /* a pixel */
    double error;   /* root of relMSE */
    double bias;    /* relative */
    double cost;    /* instructions a pixel */
    bool best;      /* nothing that costs less errs less */
} trade_point_t;

typedef struct {
    trade_point_t *points;
    size_t count;
} trade_t;

/* Read the table that tools/trade/trade.sh writes, and mark what is best in
 * each scene on each core. cli_fail(CLI_INPUT) names file and line. */
void trade_read(trade_t *trade, const char *path);
void trade_free(trade_t *trade);

/* Mark what is best in each scene on each core. */
void trade_mark_best(trade_t *trade);

/* The cheapest point of a scene on a core with an error of at most this; NULL
 * if there is none. */
const trade_point_t *trade_cheapest(const trade_t *trade, const char *scene,
        const char *core, double error);

/* The cheapest best point of the scene and core of like that costs more than
 * this; NULL if none does. */
const trade_point_t *trade_next_best(
        const trade_t *trade, const trade_point_t *like, double cost);

/* Is point i the first of its scene? Of its scene and core? */
bool trade_new_scene(const trade_t *trade, size_t i);
bool trade_new_core(const trade_t *trade, size_t i);

/* Draw a panel for each scene: every choice on the first core, and what is best
 * on each. */
void trade_plot(figure_t *figure, const trade_t *trade);

#endif
