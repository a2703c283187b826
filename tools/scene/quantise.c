/* quantise.c - the scene on its integer grid, and what that loses */
/* SPDX-License-Identifier: MIT */

#include "quantise.h"

#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "scene/ql_blob.h"

#define NONE UINT32_MAX

static bool same_point(const world_t *world, uint32_t a, uint32_t b)
{
    const double *p = world->vertices[a], *q = world->vertices[b];

    return p[0] == q[0] && p[1] == q[1] && p[2] == q[2];
}

/* Two corners in one place: such a face must not widen the box. */
static bool is_flat(const world_t *world, const world_face_t *face)
{
    const uint32_t *v = face->vertex;

    return same_point(world, v[0], v[1]) || same_point(world, v[1], v[2]) ||
           same_point(world, v[2], v[0]);
}

/* Find the scale and the origin from the box of all faces. */
static void fit_box(grid_t *grid, const world_t *world)
{
    double low[3] = {0, 0, 0}, high[3] = {0, 0, 0};
    soft_t span = soft_int(0, 0);
    bool any = false;

    for (size_t f = 0; f < world->face_count; f++) {
        const world_face_t *face = world->faces + f;

        for (int i = 0; i < 3 && !is_flat(world, face); i++) {
            const double *p = world->vertices[face->vertex[i]];

            for (int k = 0; k < 3; k++) {
                low[k] = !any || p[k] < low[k] ? p[k] : low[k];
                high[k] = !any || p[k] > high[k] ? p[k] : high[k];
            }
            any = true;
        }
    }
    for (int k = 0; k < 3; k++) {
        const soft_t side = soft_sub(soft_from(high[k]), soft_from(low[k]));

        /* with nothing to see, the camera may as well be at the origin */
        grid->origin[k] = soft_from(any ? low[k] : world->camera.eye[k]);
        span = soft_compare(side, span) > 0 ? side : span;
    }
    if (span.m == 0) {
        span = soft_int(GRID_HIGH - GRID_LOW, 0);
    }
    grid->unit = soft_div(span, soft_int(GRID_HIGH - GRID_LOW, 0));
}

/* Grid vertices by position: open addressing, at most half full. */
typedef struct {
    uint32_t *slots;
    size_t mask;
} finder_t;

static void finder_open(finder_t *finder, size_t count)
{
    size_t size = 16;

    while (size < 2 * count) {
        size *= 2;
    }
    finder->slots = cli_alloc(size, sizeof *finder->slots);
    memset(finder->slots, 0xff, size * sizeof *finder->slots);
    finder->mask = size - 1;
}

/* The grid vertex at p, a new one if there is none. */
static uint32_t find_vertex(finder_t *finder, grid_t *grid, const uint16_t p[3])
{
    const uint64_t key =
            (uint64_t)p[0] << 32 | (uint64_t)p[1] << 16 | (uint64_t)p[2];
    size_t slot = (size_t)(key * 0x9e3779b97f4a7c15u >> 20) & finder->mask;

    while (finder->slots[slot] != NONE) {
        const uint32_t found = finder->slots[slot];

        if (memcmp(grid->vertices[found], p, 3 * sizeof *p) == 0) {
            grid->merged_count++;
            return found;
        }
        slot = (slot + 1) & finder->mask;
    }
    finder->slots[slot] = grid->vertex_count;
    memcpy(grid->vertices[grid->vertex_count], p, 3 * sizeof *p);
    return grid->vertex_count++;
}

static uint32_t round_vertex(finder_t *finder, grid_t *grid, const double p[3])
{
    uint16_t q[3];

    for (int k = 0; k < 3; k++) {
        const soft_t x = soft_sub(soft_from(p[k]), grid->origin[k]);

        /* inside the box: 0..32751 */
        q[k] = (uint16_t)(GRID_LOW + soft_round(soft_div(x, grid->unit), 0));
    }
    return find_vertex(finder, grid, q);
}

void grid_normal(const grid_t *grid, const grid_face_t *face, int64_t n[3])
{
    int64_t a[3], b[3];

    for (int k = 0; k < 3; k++) {
        const int64_t p = grid->vertices[face->vertex[0]][k];

        a[k] = grid->vertices[face->vertex[1]][k] - p;
        b[k] = grid->vertices[face->vertex[2]][k] - p;
    }
    n[0] = a[1] * b[2] - a[2] * b[1];
    n[1] = a[2] * b[0] - a[0] * b[2];
    n[2] = a[0] * b[1] - a[1] * b[0];
}

static void add_face(grid_t *grid, const grid_face_t *face)
{
    int64_t n[3];

    grid_normal(grid, face, n);
    if (n[0] == 0 && n[1] == 0 && n[2] == 0) {
        grid->tiny_count++;
        return;
    }
    grid->faces[grid->face_count++] = *face;
    for (int i = 0; i < 3; i++) {
        const uint16_t *p = grid->vertices[face->vertex[i]];

        for (int k = 0; k < 3; k++) {
            grid->low[k] = p[k] < grid->low[k] ? p[k] : grid->low[k];
            grid->high[k] = p[k] > grid->high[k] ? p[k] : grid->high[k];
        }
    }
}

static void round_faces(grid_t *grid, const world_t *world)
{
    uint32_t *rounded = cli_alloc(world->vertex_count, sizeof *rounded);
    finder_t finder;

    memset(rounded, 0xff, world->vertex_count * sizeof *rounded);
    finder_open(&finder, world->vertex_count);
    for (size_t f = 0; f < world->face_count; f++) {
        const world_face_t *from = world->faces + f;
        grid_face_t face;

        if (is_flat(world, from)) {
            grid->flat_count++;
            continue;
        }
        face.material = from->material;
        for (int i = 0; i < 3; i++) {
            const uint32_t v = from->vertex[i];

            if (rounded[v] == NONE) {
                rounded[v] = round_vertex(&finder, grid, world->vertices[v]);
            }
            face.vertex[i] = rounded[v];
        }
        add_face(grid, &face);
    }
    free(finder.slots);
    free(rounded);
}

void quantise(grid_t *grid, const world_t *world)
{
    memset(grid, 0, sizeof *grid);
    grid->vertices = cli_alloc(world->vertex_count, sizeof *grid->vertices);
    grid->faces = cli_alloc(world->face_count, sizeof *grid->faces);
    for (int k = 0; k < 3; k++) {
        grid->low[k] = UINT16_MAX;
    }
    fit_box(grid, world);
    round_faces(grid, world);
    if (grid->face_count > QL_TRI_MAX) {
        cli_fail(CLI_INPUT, "%s: expected %lu triangles at most, found %lu",
                world->path, (unsigned long)QL_TRI_MAX,
                (unsigned long)grid->face_count);
    }
}

void grid_free(grid_t *grid)
{
    free(grid->vertices);
    free(grid->faces);
    memset(grid, 0, sizeof *grid);
}
