/* grid.c - the scene on its integer grid, and what that loses */
/* SPDX-License-Identifier: MIT */

#include "scene/mesh/grid.h"

#include <stdlib.h>
#include <string.h>

#include "lib/math/soft_vec.h"
#include "lib/program/cli.h"
#include "scene/ql_blob.h"
#include "scene/mesh/triples.h"

#define NONE UINT32_MAX

/* Box of the world, exact. */
typedef struct {
    soft_t low[3], high[3];
    bool any;
} extent_t;

static void extend(extent_t *extent, int k, soft_t low, soft_t high)
{
    if (!extent->any || soft_compare(low, extent->low[k]) < 0) {
        extent->low[k] = low;
    }
    if (!extent->any || soft_compare(high, extent->high[k]) > 0) {
        extent->high[k] = high;
    }
}

static void extend_by_face(
        extent_t *extent, const world_t *world, const world_face_t *face)
{
    for (int i = 0; i < 3; i++) {
        const double *p = world->vertices[face->vertex[i]];

        for (int k = 0; k < 3; k++) {
            extend(extent, k, soft_from(p[k]), soft_from(p[k]));
        }
        extent->any = true;
    }
}

static void extend_by_sphere(extent_t *extent, const world_sphere_t *sphere)
{
    const soft_t r = soft_from(sphere->radius);

    for (int k = 0; k < 3; k++) {
        const soft_t c = soft_from(sphere->centre[k]);

        extend(extent, k, soft_sub(c, r), soft_add(c, r));
    }
    extent->any = true;
}

void grid_fit(grid_t *grid, const world_t *world)
{
    soft_t span = soft_int(0, 0);
    extent_t extent;

    memset(&extent, 0, sizeof extent);
    for (size_t f = 0; f < world->face_count; f++) {
        /* such a face must not widen the box */
        if (!world_is_flat(world, world->faces + f)) {
            extend_by_face(&extent, world, world->faces + f);
        }
    }
    for (size_t i = 0; i < world->sphere_count; i++) {
        extend_by_sphere(&extent, world->spheres + i);
    }
    for (int k = 0; k < 3; k++) {
        const soft_t side = soft_sub(extent.high[k], extent.low[k]);

        /* with nothing to see, the camera may as well be at the origin */
        grid->origin[k] =
                extent.any ? extent.low[k] : soft_from(world->camera.eye[k]);
        span = soft_compare(side, span) > 0 ? side : span;
    }
    if (span.m == 0) {
        span = soft_int(GRID_HIGH - GRID_LOW, 0);
    }
    grid->unit = soft_div(span, soft_int(GRID_HIGH - GRID_LOW, 0));
}

/* The grid vertex at p, a new one if there is none. */
static uint32_t find_vertex(
        triples_t *places, grid_t *grid, const uint16_t p[3])
{
    const triples_key_t key = {0, {p[0], p[1], p[2]}};
    const uint32_t found = triples_add(places, &key, grid->vertex_count);

    if (found == grid->vertex_count) {
        memcpy(grid->vertices[grid->vertex_count++], p, 3 * sizeof *p);
    } else {
        grid->merged_count++;
    }
    return found;
}

static uint32_t round_vertex(triples_t *places, grid_t *grid, const double p[3])
{
    uint16_t q[3];

    for (int k = 0; k < 3; k++) {
        const soft_t x = soft_sub(soft_from(p[k]), grid->origin[k]);

        /* inside the box: 0..32751 */
        q[k] = (uint16_t)(GRID_LOW + soft_round(soft_div(x, grid->unit), 0));
    }
    return find_vertex(places, grid, q);
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

void grid_box(const grid_t *grid, const grid_face_t *face, uint16_t low[3],
        uint16_t high[3])
{
    if (face->sphere != 0) {
        const ql_blob_sphere_t *s = grid->spheres + face->sphere - 1;

        for (int k = 0; k < 3; k++) {
            low[k] = (uint16_t)((s->centre[k] - s->radius) >> 8);
            high[k] = (uint16_t)((s->centre[k] + s->radius + 255) >> 8);
        }
        return;
    }
    memcpy(low, grid->vertices[face->vertex[0]], 3 * sizeof *low);
    memcpy(high, low, 3 * sizeof *high);
    for (int i = 1; i < 3; i++) {
        const uint16_t *p = grid->vertices[face->vertex[i]];

        for (int k = 0; k < 3; k++) {
            low[k] = p[k] < low[k] ? p[k] : low[k];
            high[k] = p[k] > high[k] ? p[k] : high[k];
        }
    }
}

static void append_face(grid_t *grid, const grid_face_t *face)
{
    uint16_t low[3], high[3];

    grid_box(grid, face, low, high);
    for (int k = 0; k < 3; k++) {
        grid->low[k] = low[k] < grid->low[k] ? low[k] : grid->low[k];
        grid->high[k] = high[k] > grid->high[k] ? high[k] : grid->high[k];
    }
    grid->faces[grid->face_count++] = *face;
}

static bool has_area(const grid_t *grid, const grid_face_t *face)
{
    int64_t n[3];

    grid_normal(grid, face, n);
    return n[0] != 0 || n[1] != 0 || n[2] != 0;
}

/* Is a face with these corners, in this order, there already? Which corner is
 * the first makes no difference. */
static bool is_double(
        triples_t *known, const grid_t *grid, const grid_face_t *face)
{
    triples_key_t key = {0, {0, 0, 0}};
    int first = 0;

    for (int i = 1; i < 3; i++) {
        first = face->vertex[i] < face->vertex[first] ? i : first;
    }
    for (int i = 0; i < 3; i++) {
        key.triple[i] = face->vertex[(first + i) % 3];
    }
    return triples_add(known, &key, grid->face_count) != grid->face_count;
}

/* Does it leave the part of the grid that holds the scene? */
static bool pokes_out(const ql_blob_sphere_t *sphere)
{
    bool out = false;

    for (int k = 0; k < 3; k++) {
        out = out || sphere->centre[k] < (GRID_LOW << 8) + sphere->radius ||
              sphere->centre[k] + sphere->radius > GRID_HIGH << 8;
    }
    return out;
}

static void round_sphere(grid_t *grid, const world_t *world, uint32_t index)
{
    const world_sphere_t *from = world->spheres + index;
    grid_face_t face = {{0, 0, 0}, 0, 0, 0, 0};
    ql_blob_sphere_t sphere;

    sphere.radius = (uint32_t)soft_round(
            soft_div(soft_from(from->radius), grid->unit), 8);
    for (int k = 0; k < 3; k++) {
        const soft_t x = soft_sub(soft_from(from->centre[k]), grid->origin[k]);

        /* inside the box: below 2^23 */
        sphere.centre[k] = (uint32_t)((GRID_LOW << 8) +
                                      soft_round(soft_div(x, grid->unit), 8));
    }
    /* it did not before rounding, so a step or two suffice */
    while (sphere.radius > 0 && pokes_out(&sphere)) {
        sphere.radius--;
    }
    if (sphere.radius < 256) {
        grid->tiny_count++;
        return;
    }
    grid->spheres[grid->sphere_count++] = sphere;
    face.material = from->material;
    face.sphere = grid->sphere_count;
    face.source = index;
    append_face(grid, &face);
}

/* Has a face an area as it is written, but for the rounding of 64 bits? */
static bool has_area_as_written(const world_t *world, const world_face_t *face)
{
    const soft_vec_t p = soft_vec_from(world->vertices[face->vertex[0]]);
    const soft_vec_t q = soft_vec_from(world->vertices[face->vertex[1]]);
    const soft_vec_t r = soft_vec_from(world->vertices[face->vertex[2]]);
    const soft_vec_t n = soft_vec_cross(soft_vec_sub(q, p), soft_vec_sub(r, p));

    return soft_vec_dot(n, n).m != 0;
}

static void round_faces(grid_t *grid, const world_t *world)
{
    uint32_t *rounded = cli_alloc(world->vertex_count, sizeof *rounded);
    triples_t places, known;

    memset(rounded, 0xff, world->vertex_count * sizeof *rounded);
    triples_open(&places, world->vertex_count);
    triples_open(&known, world->face_count);
    for (size_t f = 0; f < world->face_count; f++) {
        const world_face_t *from = world->faces + f;
        grid_face_t face;

        if (world_is_flat(world, from)) {
            grid->flat_count++;
            continue;
        }
        face.material = from->material;
        face.sphere = 0;
        face.source = (uint32_t)f;
        face.gain = 0;
        for (int i = 0; i < 3; i++) {
            const uint32_t v = from->vertex[i];

            if (rounded[v] == NONE) {
                rounded[v] = round_vertex(&places, grid, world->vertices[v]);
            }
            face.vertex[i] = rounded[v];
        }
        if (!has_area(grid, &face)) {
            if (has_area_as_written(world, from)) {
                grid->tiny_count++;
            } else {
                grid->flat_count++;
            }
        } else if (is_double(&known, grid, &face)) {
            grid->double_count++;
        } else {
            append_face(grid, &face);
        }
    }
    triples_close(&known);
    triples_close(&places);
    free(rounded);
}

void grid_round(grid_t *grid, const world_t *world)
{
    memset(grid, 0, sizeof *grid);
    grid->vertices = cli_alloc(world->vertex_count, sizeof *grid->vertices);
    grid->faces = cli_alloc(
            world->face_count + world->sphere_count, sizeof *grid->faces);
    grid->spheres = cli_alloc(world->sphere_count, sizeof *grid->spheres);
    for (int k = 0; k < 3; k++) {
        grid->low[k] = UINT16_MAX;
    }
    grid_fit(grid, world);
    round_faces(grid, world);
    for (size_t i = 0; i < world->sphere_count; i++) {
        round_sphere(grid, world, (uint32_t)i); /* lines of a text: < 2^32 */
    }
    if (grid->face_count > QL_TRI_MAX) {
        cli_fail(CLI_INPUT,
                "%s: expected %lu triangles and spheres at most, found %lu",
                world->path, (unsigned long)QL_TRI_MAX,
                (unsigned long)grid->face_count);
    }
}

void grid_free(grid_t *grid)
{
    free(grid->vertices);
    free(grid->normals);
    free(grid->faces);
    free(grid->spheres);
    memset(grid, 0, sizeof *grid);
}
