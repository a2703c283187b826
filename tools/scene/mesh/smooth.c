/* smooth.c - which triangles are smooth, and the normals of their corners */
/* SPDX-License-Identifier: MIT */

#include "scene/mesh/smooth.h"

#include <stdlib.h>
#include <string.h>

#include "lib/program/cli.h"

#define NONE UINT32_MAX

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
static bool turn(int16_t normal[3], const int64_t front[3])
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
static bool corner_normals(const grid_t *grid, const world_t *world,
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
        if (!round_normal(n, normals[i]) || !turn(normals[i], front)) {
            return false;
        }
        curved = curved || !is_parallel(n, own);
    }
    return curved;
}

/* ---- vertices with normals ---- */

/* Vertices that have a normal, by place and normal: open addressing, at most
 * half full. */
typedef struct {
    grid_t *grid;
    uint32_t *slots;
    size_t mask;
} splitter_t;

static void splitter_open(splitter_t *s, grid_t *grid, size_t corners)
{
    const size_t room = grid->vertex_count + corners;
    uint16_t(*vertices)[3] = cli_alloc(room, sizeof *vertices);
    size_t size = 16;

    if (grid->vertex_count > 0) {
        memcpy(vertices, grid->vertices, grid->vertex_count * sizeof *vertices);
    }
    free(grid->vertices);
    grid->vertices = vertices;
    grid->normals = cli_alloc(room, sizeof *grid->normals);
    while (size < 2 * corners) {
        size *= 2;
    }
    s->grid = grid;
    s->slots = cli_alloc(size, sizeof *s->slots);
    memset(s->slots, 0xff, size * sizeof *s->slots);
    s->mask = size - 1;
}

static size_t hash(uint32_t vertex, const int16_t normal[3])
{
    uint64_t key = vertex;

    for (int k = 0; k < 3; k++) {
        key = (key ^ (uint16_t)normal[k]) * 0x9e3779b97f4a7c15u;
        key ^= key >> 29;
    }
    return (size_t)(key >> 16);
}

/* The vertex where another is, with a normal; a new one if there is none. */
static uint32_t split(splitter_t *s, uint32_t vertex, const int16_t normal[3])
{
    grid_t *grid = s->grid;
    size_t slot = hash(vertex, normal) & s->mask;

    while (s->slots[slot] != NONE) {
        const uint32_t v = s->slots[slot];

        if (memcmp(grid->vertices[v], grid->vertices[vertex],
                    sizeof *grid->vertices) == 0 &&
                memcmp(grid->normals[v], normal, sizeof *grid->normals) == 0) {
            return v;
        }
        slot = (slot + 1) & s->mask;
    }
    s->slots[slot] = grid->vertex_count;
    memcpy(grid->vertices[grid->vertex_count], grid->vertices[vertex],
            sizeof *grid->vertices);
    memcpy(grid->normals[grid->vertex_count], normal, sizeof *grid->normals);
    return grid->vertex_count++;
}

void smooth(grid_t *grid, const world_t *world)
{
    int16_t(*normals)[3][3];
    bool *is_smooth;
    size_t count = 0;
    splitter_t s;

    if (world->normal_count == 0) {
        return;
    }
    normals = cli_alloc(grid->face_count, sizeof *normals);
    is_smooth = cli_alloc(grid->face_count, sizeof *is_smooth);
    for (uint32_t f = 0; f < grid->face_count; f++) {
        is_smooth[f] = corner_normals(grid, world, grid->faces + f, normals[f]);
        count += is_smooth[f];
    }
    if (count > 0) {
        splitter_open(&s, grid, 3 * count);
        for (uint32_t f = 0; f < grid->face_count; f++) {
            for (int i = 0; i < 3 && is_smooth[f]; i++) {
                uint32_t *v = grid->faces[f].vertex + i;

                *v = split(&s, *v, (const int16_t *)normals[f][i]);
            }
        }
        free(s.slots);
    }
    free(is_smooth);
    free(normals);
}
