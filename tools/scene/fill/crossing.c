/* crossing.c - does an outline cross itself? */
/* SPDX-License-Identifier: MIT */

#include "scene/fill/crossing.h"

#include <stdlib.h>

#include "lib/program/cli.h"

/* From left to right. */
typedef struct {
    plane_point_t left, right;
} edge_t;

static int compare_edges(const void *a, const void *b)
{
    const edge_t *p = a, *q = b;

    return (p->left.x > q->left.x) - (p->left.x < q->left.x);
}

/* Are a and b on different sides of an edge? */
static bool separates(
        const edge_t *edge, const plane_point_t *a, const plane_point_t *b)
{
    return plane_side(&edge->left, &edge->right, a) *
                   plane_side(&edge->left, &edge->right, b) <
           0;
}

static bool is_above(const edge_t *a, const edge_t *b)
{
    return (a->left.y > b->left.y && a->left.y > b->right.y) &&
           (a->right.y > b->left.y && a->right.y > b->right.y);
}

static bool is_crossed(const edge_t *a, const edge_t *b)
{
    return !is_above(a, b) && !is_above(b, a) &&
           separates(a, &b->left, &b->right) &&
           separates(b, &a->left, &a->right);
}

bool crossing_find(const plane_point_t *points, size_t count)
{
    edge_t *edges = cli_alloc(count, sizeof *edges);
    bool found = false;

    for (size_t i = 0; i < count; i++) {
        const plane_point_t a = points[i], b = points[(i + 1) % count];

        edges[i].left = a.x <= b.x ? a : b;
        edges[i].right = a.x <= b.x ? b : a;
    }
    qsort(edges, count, sizeof *edges, compare_edges);
    for (size_t i = 0; i < count && !found; i++) {
        for (size_t k = i + 1;
                k < count && !found && edges[k].left.x < edges[i].right.x;
                k++) {
            found = is_crossed(edges + i, edges + k);
        }
    }
    free(edges);
    return found;
}
