/* cost.h - instructions of a rendering on each core, from what it is made of */
/* SPDX-License-Identifier: MIT */

/* A copy of the core counts, while it renders, the events that its work is made
 * of, and the table says how many instructions one of each takes on a core. No
 * emulator is needed, and everything is an integer, so the same scene and
 * settings cost the same on every PC.
 *
 *     make cost-table  instructions, counted in emulators --> cost_table.h
 *     cost_count.c     events of a rendering
 *     cost_sum.c       their sum */

#ifndef COST_H
#define COST_H

#include "qlux.h"

/* What is counted: X(event, what it is). */
#define COST_EVENTS(X)                                                         \
    X(samples, "samples of a pixel: camera, sampler, sum")                     \
    X(walks, "rays and segments that walk the tree")                           \
    X(segments, "of those the segments, which end at the first hit")           \
    X(boxes, "boxes that they test")                                           \
    X(triangles, "triangles that they test")                                   \
    X(spheres, "spheres that they test")                                       \
    X(places, "positions asked whether they are inside the hull")              \
    X(slants, "slanted sides that such a position is compared with")           \
    X(sides, "sides of the hull that a ray might leave through")               \
    X(hits, "hits of rays, the nearest so far or not")                         \
    X(vertices, "places that reflect: point, lobes, next direction")           \
    X(glossy, "those that are not diffuse alone")                              \
    X(smooth, "triangles with normals of their own that were hit")             \
    X(points, "points of a triangle, drawn for a diffuse surface")             \
    X(directions, "directions towards an emitter, drawn in another way")       \
    X(corners, "those for which a triangle was projected onto the sphere")     \
    X(spherical, "those that were drawn by a triangle's solid angle")          \
    X(lit, "light that was added to the sum")                                  \
    X(values, "values of a BSDF for such a direction")                         \
    X(shares, "those that are weighed against the lobes")                      \
    X(lobes, "directions drawn where there may be two lobes")                  \
    X(looks, "rays that are drawn for emitters alone")                         \
    X(densities, "rays that are drawn with their density")                     \
    X(weights, "rays that met an emitter and are weighed against points")      \
    X(balances, "either, weighed")

typedef struct {
#define COST_FIELD(event, what) uint64_t event;
    COST_EVENTS(COST_FIELD)
#undef COST_FIELD
} cost_events_t;

enum { COST_EVENT_COUNT = sizeof(cost_events_t) / sizeof(uint64_t) };

/* The cores of the table, in its order, and their names in the rows of make
 * bench. */
typedef enum { COST_M0, COST_M3, COST_M4F, COST_RV32, COST_CORES } cost_core_t;

/* Name of a core, as board.mk has it: "cortex-m3". */
const char *cost_core_name(cost_core_t core);

/* The core of a name.
 *
 *   core    -  out, if it is one
 *   return  false if the table has no such core
 */
bool cost_core_find(cost_core_t *core, const char *name);

/* Render samples of a pixel and count what they are made of: as
 * ql_render_pixel(), and the same bits.
 *
 *   events  -  added to; may be counted on from call to call
 *
 * Not for two threads at a time.
 */
void cost_render_pixel(cost_events_t *events, ql_render_t *render, uint16_t x,
        uint16_t y, uint32_t first, uint32_t count, ql_sum_t *sum);

/* Instructions that events take.
 *
 *   events     -  of a rendering, 2^38 of each at most
 *   core       -  where
 *   precision  -  QL_CFG_PRECISION of the firmware: 0 draft, 1 fine. What it
 *                 is made of hardly depends on that
 *   return     instructions, rounded to nearest
 *
 * Error: of a sample within 10 % in most scenes (tests/bench/cost). Of two
 * strategies in one scene what they share cancels out.
 */
uint64_t cost_instructions(
        const cost_events_t *events, cost_core_t core, unsigned precision);

#endif
