/* cost_count.c - a copy of the core's paths that counts their work */
/* SPDX-License-Identifier: MIT */

/* The core has QL_COUNT(event) wherever an event begins, which is nothing. Here
 * the files that count are compiled once more, under other names, so no copy of
 * the code can differ from the core's, and nothing else gets slower. */

#include "ql_config.h"

/* Names of the copies. */
#undef QL_GATED
#define QL_GATED(name)           counted_##name
#define ql_bvh_closest_hit       counted_closest_hit
#define ql_bvh_occluded_but      counted_occluded_but
#define ql_bvh_touches           counted_touches
#define ql_emit_inv_pdf          counted_emit_inv_pdf
#define ql_emit_sample           counted_emit_sample
#define ql_emit_triangle_inv_pdf counted_triangle_inv_pdf
#define ql_emit_triangle_point   counted_triangle_point
#define ql_emit_triangle_sample  counted_triangle_sample
#define ql_emitted_add           counted_emitted_add
#define ql_emitted_by_hit        counted_emitted_by_hit
#define ql_emitted_by_sky        counted_emitted_by_sky
#define ql_hull_has              counted_hull_has
#define ql_hull_is_before_sides  counted_hull_is_before_sides
#define ql_hull_next             counted_hull_next
#define ql_mis_weight            counted_mis_weight
#define ql_mis_weight_of_ray     counted_mis_weight_of_ray
#define ql_next_event            counted_next_event
#define ql_path_miss             counted_path_miss
#define ql_path_trace            counted_path_trace
#define ql_smooth_at             counted_smooth_at
#define ql_smooth_lift           counted_smooth_lift
#define ql_surface_at            counted_surface_at
#define ql_surface_cross         counted_surface_cross
#define ql_surface_step          counted_surface_step

/* An event, in the copies. */
#define QL_COUNT(event) ((void)counting->event++)

#include "lib/cost/cost.h"

/* Where the copies count; set while they run. */
static cost_events_t *counting;

#include "trace/ql_bvh.c"
#include "trace/ql_hull.c"
#include "trace/ql_hull_slanted.c"
#include "trace/surface/ql_smooth.c"
#include "trace/surface/ql_surface_at.c"

#include "light/ql_emit.c"
#include "light/ql_emit_triangle.c"

#include "render/ql_emitted.c"
#include "render/ql_line.c"
#include "render/ql_mis.c"
#include "render/ql_next_event.c"
#include "render/ql_path.c"

void cost_render_pixel(cost_events_t *events, ql_render_t *render, uint16_t x,
        uint16_t y, uint32_t first, uint32_t count, ql_sum_t *sum)
{
    counting = events;
    ql_render_pixel(render, x, y, first, count, sum);
    counting = NULL;
}
