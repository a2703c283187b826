/* extent.c - how wide a scene is, and which of its meshes makes it so */
/* SPDX-License-Identifier: MIT */

#include "scene/world/extent.h"

#include <math.h>
#include <stdlib.h>

#include "lib/program/cli.h"

typedef struct {
    double low[3], high[3]; /* infinities if it is empty */
} box_t;

static const box_t empty = {
        {INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

static bool is_empty(const box_t *box)
{
    return box->low[0] > box->high[0];
}

static void extend(box_t *box, const double low[3], const double high[3])
{
    for (int k = 0; k < 3; k++) {
        box->low[k] = low[k] < box->low[k] ? low[k] : box->low[k];
        box->high[k] = high[k] > box->high[k] ? high[k] : box->high[k];
    }
}

static double find_width(const box_t *box)
{
    double width = 0;

    for (int k = 0; k < 3; k++) {
        const double side = box->high[k] - box->low[k];

        width = side > width ? side : width;
    }
    return width;
}

/* The box of mesh m; with m of mesh_count, that of the spheres. */
static box_t find_box(const world_t *world, size_t m)
{
    const size_t end = m + 1 < world->mesh_count
                               ? world->meshes[m + 1].first_face
                               : world->face_count;
    box_t box = empty;

    for (size_t i = 0; m == world->mesh_count && i < world->sphere_count; i++) {
        const world_sphere_t *s = world->spheres + i;
        double low[3], high[3];

        for (int k = 0; k < 3; k++) {
            low[k] = s->centre[k] - s->radius;
            high[k] = s->centre[k] + s->radius;
        }
        extend(&box, low, high);
    }
    for (size_t f = m < world->mesh_count ? world->meshes[m].first_face : end;
            f < end; f++) {
        const world_face_t *face = world->faces + f;

        for (int i = 0; i < 3 && !world_is_flat(world, face); i++) {
            const double *p = world->vertices[face->vertex[i]];

            extend(&box, p, p);
        }
    }
    return box;
}

/* The width of all boxes but one. */
static double find_width_without(const box_t *boxes, size_t count, size_t one)
{
    box_t box = empty;

    for (size_t i = 0; i < count; i++) {
        if (i != one) {
            extend(&box, boxes[i].low, boxes[i].high);
        }
    }
    return find_width(&box);
}

world_extent_t extent_find(const world_t *world)
{
    const size_t meshes = world->mesh_count;
    box_t *boxes = cli_alloc(meshes + 1, sizeof *boxes);
    world_extent_t extent = {NULL, 0, INFINITY, false};
    size_t filled = 0;

    for (size_t m = 0; m <= meshes; m++) {
        boxes[m] = find_box(world, m);
        filled += m < meshes && !is_empty(boxes + m);
    }
    extent.width = find_width_without(boxes, meshes + 1, meshes + 1);
    for (size_t m = 0; m <= meshes; m++) {
        const double width = is_empty(boxes + m)
                                     ? INFINITY
                                     : find_width_without(boxes, meshes + 1, m);

        if (width < extent.without) {
            extent.without = width;
            extent.name = m < meshes ? world->meshes[m].path : "a sphere";
            extent.is_mesh = m < meshes && filled > 1;
        }
    }
    free(boxes);
    return extent;
}
