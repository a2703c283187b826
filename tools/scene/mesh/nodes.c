/* nodes.c - boxes of the BVH as the blob stores them */
/* SPDX-License-Identifier: MIT */

#include "scene/mesh/nodes.h"

#include <string.h>

#define HALF_MAX  16384
#define SHIFT_MAX 8

void nodes_encode16(ql_blob_node16_t *out, const bvh_node_t *node)
{
    for (int k = 0; k < 3; k++) {
        const int low = node->low[k], high = node->high[k];

        /* high <= 32759, so the centre stays in the grid */
        out->centre[k] = (uint16_t)((low + high + 1) / 2);
        out->half[k] = (uint16_t)((high - low + 1) / 2);
    }
    out->link = (uint16_t)node->link;
    out->meta = (uint16_t)node->meta;
}

/* Steps of 2^shift from centre that reach both ends; too many for a byte or
 * for the limit of half a box give -1. */
static int count_half_steps(
        const bvh_node_t *node, int k, int centre, int shift)
{
    const int below = centre - node->low[k], above = node->high[k] - centre;
    const int reach = below > above ? below : above;
    const int steps = (reach + (1 << shift) - 1) >> shift; /* reach >= 0 */

    return steps > 255 || steps << shift > HALF_MAX ? -1 : steps;
}

/* One axis of a pair on a given grid. */
typedef struct {
    int base, away; /* the upper centre is base + (away << shift) */
    int half_lower, half_upper;
} axis_t;

/* Best place for the upper child when the lower is centred on axis->base. */
static int place_upper(axis_t *axis, const bvh_node_t *lower,
        const bvh_node_t *upper, int k, int shift)
{
    const int centre = (upper->low[k] + upper->high[k]) / 2;
    const int guess = centre > axis->base ? (centre - axis->base) >> shift : 0;
    int best = -1;

    axis->half_lower = count_half_steps(lower, k, axis->base, shift);
    for (int away = guess; away <= guess + 1 && away <= 255; away++) {
        const int at = axis->base + (away << shift);
        const int half = count_half_steps(upper, k, at, shift);

        if (axis->half_lower >= 0 && half >= 0 && at <= QL_GRID_MAX &&
                (best < 0 || axis->half_lower + half < best)) {
            best = axis->half_lower + half;
            axis->away = away;
            axis->half_upper = half;
        }
    }
    return best;
}

/* Find the tightest boxes of one axis; false if this grid does not reach. */
static bool fit_axis(axis_t *best, const bvh_node_t *lower,
        const bvh_node_t *upper, int k, int shift)
{
    const int centre = (lower->low[k] + lower->high[k]) / 2;
    const int way = 1 << shift;
    int best_cost = -1;

    for (int step = 0; step <= 2 * way; step++) {
        axis_t axis;
        int cost;

        /* the centre itself first, then alternately around it */
        axis.base = centre + (step % 2 == 0 ? step / 2 : -(step + 1) / 2);
        if (axis.base < 0 || axis.base > QL_GRID_MAX) {
            continue;
        }
        cost = place_upper(&axis, lower, upper, k, shift);
        if (cost >= 0 && (best_cost < 0 || cost < best_cost)) {
            best_cost = cost;
            *best = axis;
        }
    }
    return best_cost >= 0;
}

static bool encode_at(ql_blob_pair8_t *out, const bvh_node_t pair[2], int shift)
{
    for (int k = 0; k < 3; k++) {
        const int swap = pair[0].low[k] + pair[0].high[k] >
                         pair[1].low[k] + pair[1].high[k];
        axis_t axis;

        if (!fit_axis(&axis, pair + swap, pair + !swap, k, shift)) {
            return false;
        }
        out->base[k] = (uint16_t)axis.base;
        out->centre[swap][k] = 0;
        out->centre[!swap][k] = (uint8_t)axis.away;
        out->half[swap][k] = (uint8_t)axis.half_lower;
        out->half[!swap][k] = (uint8_t)axis.half_upper;
    }
    out->shift = (uint8_t)shift;
    return true;
}

void nodes_encode8(ql_blob_pair8_t *out, const bvh_node_t pair[2])
{
    int shift = 0;

    /* Shift 8 always reaches: 255 << 8 exceeds the grid, and centres at 16384
     * contain any box in 8..32759 by half of 16384. */
    while (shift < SHIFT_MAX && !encode_at(out, pair, shift)) {
        shift++;
    }
    if (shift == SHIFT_MAX) {
        (void)encode_at(out, pair, shift);
    }
    out->meta = (uint8_t)(pair[0].meta | pair[1].meta << 4);
    for (int i = 0; i < 2; i++) {
        out->link[i] = (uint16_t)pair[i].link;
    }
}
