/* trade_points.c - what was measured of a scene as points of a table */
/* SPDX-License-Identifier: MIT */

#include "trade/trade_points.h"

#include <string.h>

#include "lib/program/cli.h"
#include "lib/render/render_options.h"
#include "trade/scene/trade_advice.h"

void trade_points(
        trade_t *trade, const trade_measure_t *measure, const char *path)
{
    const char *slash = strrchr(path, '/');
    trade_point_t *p;

    p = trade->points = cli_alloc(
            (size_t)measure->count * TRADE_DOTS * COST_CORES, sizeof *p);
    for (unsigned core = 0; core < COST_CORES; core++) {
        for (unsigned i = 0; i < measure->count; i++) {
            const trade_way_t *way = measure->ways + i;
            const ql_settings_t *s = &way->settings;

            for (unsigned k = 0; k < way->curve.count; k++, p++) {
                trade_options(p->options, sizeof p->options, s);
                memmove(p->options, p->options + 1, strlen(p->options));
                snprintf(p->name, sizeof p->name, "%s-%u%s%.0u%s",
                        render_words_direct[s->direct], s->bounces,
                        s->light_samples > 1 ? "-" : "",
                        s->light_samples > 1 ? s->light_samples : 0u,
                        s->lights == QL_LIGHTS_ALL ? "-all" : "");
                snprintf(p->scene, sizeof p->scene, "%.60s",
                        slash != NULL ? slash + 1 : path);
                snprintf(p->core, sizeof p->core, "%s",
                        cost_core_name((cost_core_t)core));
                snprintf(p->knob, sizeof p->knob, "%s",
                        s->direct != QL_DIRECT_AREA    ? "direct"
                        : s->light_samples > 1         ? "light-samples"
                        : s->lights != QL_LIGHTS_POWER ? "lights"
                                                       : "bounces");
                snprintf(p->build, sizeof p->build, "draft");
                p->samples = (double)((uint32_t)1 << k);
                p->error = trade_curve_error(&way->curve, k);
                p->cost = p->samples * way->cost[core];
            }
        }
    }
    trade->count = (size_t)(p - trade->points);
    trade_mark_best(trade);
}
