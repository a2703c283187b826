/* smooth.c - which triangles are smooth, and the normals of their corners */
/* SPDX-License-Identifier: MIT */

#include "scene/mesh/smooth.h"

#include <stdlib.h>
#include <string.h>

#include "lib/program/cli.h"
#include "scene/mesh/triples.h"

static soft_t dot(const soft_t a[3], const soft_t b[3])
{
    const soft_t xy = soft_add(soft_mul(a[0], b[0]), soft_mul(a[1], b[1]));

    return soft_add(xy, soft_mul(a[2], b[2]));
}

static void cross(const soft_t a[3], const soft_t b[3], soft_t c[3])
{
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;

        c[k] = soft_sub(soft_mul(a[i], b[j]), soft_mul(a[j], b[i]));
    }
}

/* e1 x e2 of a face as written. */
static void world_normal(
        const world_t *world, const world_face_t *face, soft_t n[3])
{
    const double *p = world->vertices[face->vertex[0]];
    soft_t e[2][3];

    for (int i = 0; i < 2; i++) {
        const double *q = world->vertices[face->vertex[i + 1]];

        for (int k = 0; k < 3; k++) {
            e[i][k] = soft_sub(soft_from(q[k]), soft_from(p[k]));
        }
    }
    cross(e[0], e[1], n);
}

/* Is the sine of the angle between two lines at most 2^-13? */
static bool is_parallel(const soft_t a[3], const soft_t b[3])
{
    soft_t limit = soft_mul(dot(a, a), dot(b, b));
    soft_t c[3];

    cross(a, b, c);
    limit.e -= 26;
    return soft_compare(dot(c, c), limit) <= 0;
}

/* To s0.15 of length 1; false if there is none. */
static bool round_normal(const soft_t n[3], int16_t rounded[3])
{
    const soft_t square = dot(n, n);
    soft_t scale;

    if (square.m == 0) {
        return false;
    }
    scale = soft_div(soft_int(INT16_MAX, 0), soft_sqrt(square));
    for (int k = 0; k < 3; k++) {
        rounded[k] = (int16_t)soft_round(soft_mul(n[k], scale), 0);
    }
    return true;
}

/* Turn a normal to the front of a face; false if it is in its plane. */
static bool turn_normal(int16_t normal[3], const int64_t front[3])
{
    int64_t side = 0;

    for (int k = 0; k < 3; k++) {
        side += normal[k] * front[k]; /* below 3 2^45 */
    }
    for (int k = 0; k < 3 && side < 0; k++) {
        normal[k] = (int16_t)-normal[k]; /* -32767..32767 */
    }
    return side != 0;
}

/* Find the normals of a triangle's corners; false if it is flat. */
static bool find_normals(const grid_t *grid, const world_t *world,
        const grid_face_t *face, int16_t normals[3][3])
{
    const world_face_t *from = world->faces + face->source;
    bool curved = false;
    int64_t front[3];
    soft_t own[3];

    if (face->sphere != 0 || from->normal[0] == 0 || from->normal[1] == 0 ||
            from->normal[2] == 0) {
        return false;
    }
    world_normal(world, from, own);
    grid_normal(grid, face, front);
    for (int i = 0; i < 3; i++) {
        const double *given = world->normals[from->normal[i] - 1];
        soft_t n[3];

        for (int k = 0; k < 3; k++) {
            n[k] = soft_from(given[k]);
        }
        if (!round_normal(n, normals[i]) || !turn_normal(normals[i], front)) {
            return false;
        }
        curved = curved || !is_parallel(n, own);
    }
    return curved;
}

/* ---- vertices with normals ---- */

/* Make room for normals and for as many more vertices. */
static void make_room(grid_t *grid, size_t corners)
{
    const size_t room = grid->vertex_count + corners;
    uint16_t(*vertices)[3] = cli_alloc(room, sizeof *vertices);

    if (grid->vertex_count > 0) {
        memcpy(vertices, grid->vertices, grid->vertex_count * sizeof *vertices);
    }
    free(grid->vertices);
    grid->vertices = vertices;
    grid->normals = cli_alloc(room, sizeof *grid->normals);
}

/* The vertex where another is, with a normal; a new one if there is none. */
static uint32_t split(triples_t *known, grid_t *grid, uint32_t vertex,
        const int16_t normal[3])
{
    const triples_key_t key = {vertex,
            {(uint16_t)normal[0], (uint16_t)normal[1], (uint16_t)normal[2]}};
    const uint32_t found = triples_add(known, &key, grid->vertex_count);

    if (found == grid->vertex_count) {
        memcpy(grid->vertices[found], grid->vertices[vertex],
                sizeof *grid->vertices);
        memcpy(grid->normals[found], normal, sizeof *grid->normals);
        grid->vertex_count++;
    }
    return found;
}

/* Replace the corners of smooth faces by vertices with normals. */
static void split_corners(grid_t *grid, const bool *is_smooth,
        int16_t (*normals)[3][3], size_t corners)
{
    triples_t known;

    make_room(grid, corners);
    triples_open(&known, corners);
    for (uint32_t f = 0; f < grid->face_count; f++) {
        for (int i = 0; i < 3 && is_smooth[f]; i++) {
            uint32_t *v = grid->faces[f].vertex + i;

            *v = split(&known, grid, *v, normals[f][i]);
        }
    }
    triples_close(&known);
}

void smooth_corners(grid_t *grid, const world_t *world)
{
    int16_t(*normals)[3][3];
    bool *is_smooth;
    size_t count = 0;

    if (world->normal_count == 0) {
        return;
    }
    normals = cli_alloc(grid->face_count, sizeof *normals);
    is_smooth = cli_alloc(grid->face_count, sizeof *is_smooth);
    for (uint32_t f = 0; f < grid->face_count; f++) {
        is_smooth[f] = find_normals(grid, world, grid->faces + f, normals[f]);
        count += is_smooth[f];
    }
    if (count > 0) {
        split_corners(grid, is_smooth, normals, 3 * count);
    }
    free(is_smooth);
    free(normals);
}
