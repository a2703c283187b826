/* trade_measure.h - error and cost of ways to render a scene, measured here */
/* SPDX-License-Identifier: MIT */

#ifndef TRADE_MEASURE_H
#define TRADE_MEASURE_H

#include "lib/cost/cost.h"
#include "trade/scene/trade_curve.h"

#define TRADE_KEPT    2 /* strategies whose error is measured */
#define TRADE_BOUNCES 6 /* numbers of bounces of each */
#define TRADE_WAYS    16

/* A way to render, and what came of it. */
typedef struct {
    ql_settings_t settings;
    double cost[COST_CORES]; /* instructions of a sample, in draft */
    trade_curve_t curve;
} trade_way_t;

/* What is measured, and what for. */
typedef struct {
    const ql_scene_t *scene;
    uint16_t width; /* px, of the pictures that are measured */
    uint16_t height;
    unsigned threads;
    bool quick; /* fewer samples of fewer pixels */
    bool quiet;

    trade_way_t ways[TRADE_WAYS]; /* out */
    unsigned count;
    uint32_t reference_samples; /* of what errors are relative to */
} trade_measure_t;

/* Measure a scene.
 *
 *   measure  -  in: up to ways; out: from there on
 *   name     -  of the scene, for messages
 *
 * First the noise of each strategy with a few samples; then, for the two that
 * are best at equal work and for several numbers of bounces, the error as
 * samples double. How far is decided by counted instructions, so figures do not
 * depend on this PC or on the threads.
 *
 * Fails: cli_fail(CLI_INPUT) if the picture is black.
 */
void trade_measure(trade_measure_t *measure, const char *name);

#endif
