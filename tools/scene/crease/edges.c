/* edges.c - the edges of triangles, those in one place together */
/* SPDX-License-Identifier: MIT */

#include "scene/crease/edges.h"

#include <stdlib.h>
#include <string.h>

#include "lib/program/cli.h"

/* ---- places ---- */

typedef struct {
    double at[3];
    uint32_t vertex;
} place_t;

static int compare_doubles(double a, double b)
{
    return (a > b) - (a < b);
}

static int compare_points(const place_t *p, const place_t *q)
{
    int order = compare_doubles(p->at[0], q->at[0]);

    order = order != 0 ? order : compare_doubles(p->at[1], q->at[1]);
    return order != 0 ? order : compare_doubles(p->at[2], q->at[2]);
}

static int compare_places(const void *a, const void *b)
{
    const place_t *p = a, *q = b;
    const int order = compare_points(p, q);

    return order != 0 ? order
                      : (p->vertex > q->vertex) - (p->vertex < q->vertex);
}

uint32_t *edges_places(const world_t *world)
{
    const size_t n = world->vertex_count;
    uint32_t *places = cli_alloc(n, sizeof *places);
    place_t *sorted = cli_alloc(n, sizeof *sorted);

    for (size_t i = 0; i < n; i++) {
        memcpy(sorted[i].at, world->vertices[i], sizeof sorted[i].at);
        sorted[i].vertex = (uint32_t)i; /* world_add_vertex() has a limit */
    }
    qsort(sorted, n, sizeof *sorted, compare_places);
    for (size_t i = 0; i < n; i++) {
        const bool same =
                i > 0 && compare_points(sorted + i - 1, sorted + i) == 0;

        places[sorted[i].vertex] =
                same ? places[sorted[i - 1].vertex] : sorted[i].vertex;
    }
    free(sorted);
    return places;
}

/* ---- edges ---- */

static int compare_edges(const void *a, const void *b)
{
    const edge_t *p = a, *q = b;

    for (int i = 0; i < 2; i++) {
        if (p->ends[i] != q->ends[i]) {
            return p->ends[i] < q->ends[i] ? -1 : 1;
        }
    }
    return (p->corners[0] > q->corners[0]) - (p->corners[0] < q->corners[0]);
}

edge_t *edges_sort(const world_face_t *faces, const bool *wanted, size_t count,
        const uint32_t *places, size_t *edges)
{
    edge_t *sorted = cli_alloc(3 * count, sizeof *sorted);
    size_t n = 0;

    for (size_t f = 0; f < count; f++) {
        for (uint32_t i = 0; i < 3 && wanted[f]; i++) {
            const uint32_t k = (i + 1) % 3;
            const uint32_t a = places[faces[f].vertex[i]];
            const uint32_t b = places[faces[f].vertex[k]];
            const uint32_t corners[2] = {
                    (uint32_t)(3 * f + i), (uint32_t)(3 * f + k)};
            edge_t *edge = sorted + n++;

            edge->forwards = a < b;
            edge->ends[0] = a < b ? a : b;
            edge->ends[1] = a < b ? b : a;
            edge->corners[0] = corners[a < b ? 0 : 1];
            edge->corners[1] = corners[a < b ? 1 : 0];
        }
    }
    qsort(sorted, n, sizeof *sorted, compare_edges);
    *edges = n;
    return sorted;
}
