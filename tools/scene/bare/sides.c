/* sides.c - does one see fronts or backs of a mesh from a direction? */
/* SPDX-License-Identifier: MIT */

#include "scene/bare/sides.h"

#include <stdlib.h>
#include <string.h>

#include "lib/math/soft.h"
#include "lib/program/cli.h"
#include "scene/mesh/grid.h"

enum { FRACTION = 16, WIDTH = SIDES_RASTER * FRACTION };

/* What is nearest in each place: its depth, larger towards the eye. */
typedef struct {
    int64_t depth[SIDES_RASTER][SIDES_RASTER];
    signed char side[SIDES_RASTER][SIDES_RASTER]; /* 0: nothing is there */
} raster_t;

/* A corner: x, y in 1/FRACTION of a place, z towards the eye. */
typedef struct {
    int64_t x, y, z;
} corner_t;

static int64_t dot(const int64_t p[3], const int64_t axis[3])
{
    return p[0] * axis[0] + p[1] * axis[1] + p[2] * axis[2];
}

/* Round the vertices to half of the cells of the grid. */
static int64_t (*round_vertices(const world_t *world))[3]
{
    int64_t(*rounded)[3] = cli_alloc(world->vertex_count, sizeof *rounded);
    grid_t grid;

    grid_fit(&grid, world);
    for (size_t f = 0; f < world->face_count; f++) {
        for (int i = 0; i < 3 && !world_is_flat(world, world->faces + f); i++) {
            const uint32_t v = world->faces[f].vertex[i];

            for (int k = 0; k < 3; k++) {
                const soft_t x = soft_sub(
                        soft_from(world->vertices[v][k]), grid.origin[k]);

                /* 0..2^14 */
                rounded[v][k] = soft_round(soft_div(x, grid.unit), -1);
            }
        }
    }
    return rounded;
}

/* Twice the area of a, b and a point, above 0 to the left of a to b. */
static int64_t find_area(
        const corner_t *a, const corner_t *b, int64_t x, int64_t y)
{
    return (b->x - a->x) * (y - a->y) - (b->y - a->y) * (x - a->x);
}

/* Let a place have a face if that is nearer; of equal ones a front. */
static void draw_place(
        raster_t *raster, int column, int row, int64_t depth, signed char side)
{
    int64_t *known = &raster->depth[row][column];
    signed char *seen = &raster->side[row][column];

    if (*seen == 0 || depth > *known || (depth == *known && side > *seen)) {
        *known = depth;
        *seen = side;
    }
}

static int64_t clamp(int64_t x)
{
    return x < 0 ? 0 : x >= SIDES_RASTER ? SIDES_RASTER - 1 : x;
}

/* Draw a triangle into the places whose middles it covers. */
static void draw_face(raster_t *raster, const corner_t corners[3])
{
    const corner_t *a = corners, *b = corners + 1, *c = corners + 2;
    const int64_t area = find_area(a, b, c->x, c->y);
    int64_t low[2] = {a->x, a->y}, high[2] = {a->x, a->y};

    for (int i = 1; i < 3 && area != 0; i++) {
        low[0] = corners[i].x < low[0] ? corners[i].x : low[0];
        low[1] = corners[i].y < low[1] ? corners[i].y : low[1];
        high[0] = corners[i].x > high[0] ? corners[i].x : high[0];
        high[1] = corners[i].y > high[1] ? corners[i].y : high[1];
    }
    for (int64_t row = clamp(low[1] / FRACTION);
            area != 0 && row <= clamp(high[1] / FRACTION); row++) {
        for (int64_t column = clamp(low[0] / FRACTION);
                column <= clamp(high[0] / FRACTION); column++) {
            const int64_t x = column * FRACTION + FRACTION / 2;
            const int64_t y = row * FRACTION + FRACTION / 2;
            const int64_t sign = area > 0 ? 1 : -1;
            const int64_t u = sign * find_area(b, c, x, y);
            const int64_t v = sign * find_area(c, a, x, y);
            const int64_t w = sign * find_area(a, b, x, y);

            if (u >= 0 && v >= 0 && w >= 0) {
                draw_place(raster, (int)column, (int)row,
                        (u * a->z + v * b->z + w * c->z) / (sign * area),
                        (signed char)sign);
            }
        }
    }
}

/* A model on the two axes of a picture and that of its depth. */
typedef struct {
    int64_t (*vertices)[3];
    int64_t axes[3][3];
    int64_t low[2], span[2]; /* along the first two */
} view_t;

static view_t make_view(const world_t *world, const int direction[3])
{
    const int64_t a = direction[0], b = direction[1], c = direction[2];
    /* to the right, up, towards the eye: across each other, below 2^10 */
    const int64_t axes[3][3] = {
            {c, 0, -a}, {-a * b, c * c + a * a, -b * c}, {a, b, c}};
    int64_t high[2];
    view_t view = {.vertices = round_vertices(world)};
    bool any = false;

    memcpy(view.axes, axes, sizeof axes);
    for (size_t f = 0; f < world->face_count; f++) {
        for (int i = 0; i < 6; i++) {
            const uint32_t v = world->faces[f].vertex[i / 2];
            const int64_t at = dot(view.vertices[v], axes[i % 2]);
            int64_t *low = view.low + i % 2, *most = high + i % 2;

            *low = !any || at < *low ? at : *low;
            *most = !any || at > *most ? at : *most;
            any = any || i == 1;
        }
    }
    for (int k = 0; k < 2; k++) {
        view.span[k] = any && high[k] > view.low[k] ? high[k] - view.low[k] : 1;
    }
    return view;
}

static corner_t find_corner(const view_t *view, uint32_t v)
{
    const int64_t *p = view->vertices[v];
    corner_t corner;

    corner.x = (dot(p, view->axes[0]) - view->low[0]) * WIDTH / view->span[0];
    corner.y = (dot(p, view->axes[1]) - view->low[1]) * WIDTH / view->span[1];
    corner.z = dot(p, view->axes[2]);
    return corner;
}

sides_t sides_see(const world_t *world, const int direction[3])
{
    raster_t *raster = cli_alloc(1, sizeof *raster);
    const view_t view = make_view(world, direction);
    sides_t sides = {0, 0};

    for (size_t f = 0; f < world->face_count; f++) {
        corner_t corners[3];

        for (int i = 0; i < 3; i++) {
            corners[i] = find_corner(&view, world->faces[f].vertex[i]);
        }
        draw_face(raster, corners);
    }
    for (int i = 0; i < SIDES_RASTER * SIDES_RASTER; i++) {
        const signed char side =
                raster->side[i / SIDES_RASTER][i % SIDES_RASTER];

        sides.fronts += side > 0;
        sides.backs += side < 0;
    }
    free(view.vertices);
    free(raster);
    return sides;
}
