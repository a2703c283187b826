/* smooth.c - which triangles are smooth, and the normals of their corners */
/* SPDX-License-Identifier: MIT */

#include "scene/mesh/smooth.h"

#include <stdlib.h>
#include <string.h>

#include "lib/math/soft_vec.h"
#include "lib/program/cli.h"
#include "scene/mesh/triples.h"

/* e1 x e2 of a face as written. */
static soft_vec_t find_normal(const world_t *world, const world_face_t *face)
{
    const soft_vec_t p = soft_vec_from(world->vertices[face->vertex[0]]);
    soft_vec_t e[2];

    for (int i = 0; i < 2; i++) {
        e[i] = soft_vec_sub(
                soft_vec_from(world->vertices[face->vertex[i + 1]]), p);
    }
    return soft_vec_cross(e[0], e[1]);
}

/* Is the sine of the angle between two lines at most 2^-13? */
static bool is_parallel(soft_vec_t a, soft_vec_t b)
{
    const soft_vec_t c = soft_vec_cross(a, b);
    soft_t limit = soft_mul(soft_vec_dot(a, a), soft_vec_dot(b, b));

    limit.e -= 26;
    return soft_compare(soft_vec_dot(c, c), limit) <= 0;
}

/* To s0.15 of length 1; false if there is none. */
static bool round_normal(soft_vec_t n, int16_t rounded[3])
{
    const soft_t square = soft_vec_dot(n, n);
    soft_t scale;

    if (square.m == 0) {
        return false;
    }
    scale = soft_div(soft_int(INT16_MAX, 0), soft_sqrt(square));
    for (int k = 0; k < 3; k++) {
        rounded[k] = (int16_t)soft_round(soft_mul(n.k[k], scale), 0);
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
    const world_face_t *from;
    bool curved = false;
    int64_t front[3];
    soft_vec_t own;

    if (face->sphere != 0) {
        return false;
    }
    from = world->faces + face->source;
    if (from->normal[0] == 0 || from->normal[1] == 0 || from->normal[2] == 0) {
        return false;
    }
    own = find_normal(world, from);
    grid_normal(grid, face, front);
    for (int i = 0; i < 3; i++) {
        const soft_vec_t n = soft_vec_from(world->normals[from->normal[i] - 1]);

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
