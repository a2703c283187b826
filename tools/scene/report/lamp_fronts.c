/* lamp_fronts.c - lamps that shine away from everything */
/* SPDX-License-Identifier: MIT */

#include "scene/report/lamp_fronts.h"

#include <math.h>
#include <stdlib.h>

#include "lib/program/cli.h"
#include "scene/report/probe.h"

enum { NEAR = (GRID_HIGH - GRID_LOW) / 256, TRIED = 64, WAYS = 9, MOST = 10 };

typedef struct {
    size_t mesh;
    uint32_t material;
} lamp_t;

/* A triangle of a lamp. */
typedef struct {
    lamp_t lamp;
    uint32_t face; /* of the grid */
} member_t;

static size_t find_mesh(const world_t *world, size_t face)
{
    size_t low = 0, high = world->mesh_count;

    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;

        if (world->meshes[middle].first_face <= face) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

static int compare_members(const void *a, const void *b)
{
    const member_t *p = a, *q = b;

    return p->lamp.mesh != q->lamp.mesh ? (p->lamp.mesh < q->lamp.mesh ? -1 : 1)
           : p->lamp.material != q->lamp.material
                   ? (p->lamp.material < q->lamp.material ? -1 : 1)
                   : (p->face > q->face) - (p->face < q->face);
}

/* The emitting triangles, lamp by lamp; free() them. */
static member_t *find_members(
        const world_t *world, const grid_t *grid, size_t *count)
{
    member_t *members = cli_alloc(grid->face_count, sizeof *members);
    size_t n = 0;

    for (uint32_t f = 0; f < grid->face_count; f++) {
        const grid_face_t *face = grid->faces + f;

        if (face->sphere == 0 && world_emits(world, face->material)) {
            members[n].face = f;
            members[n].lamp.mesh = find_mesh(world, face->source);
            members[n++].lamp.material = face->material;
        }
    }
    qsort(members, n, sizeof *members, compare_members);
    *count = n;
    return members;
}

/* The axes of a triangle: along an edge, across it, and its normal, all of
 * length 1. */
static void find_axes(
        const grid_t *grid, const grid_face_t *face, double axes[3][3])
{
    int64_t n[3];
    double edge = 0, normal = 0;

    grid_normal(grid, face, n);
    for (int k = 0; k < 3; k++) {
        axes[0][k] = grid->vertices[face->vertex[1]][k] -
                     grid->vertices[face->vertex[0]][k];
        axes[2][k] = (double)n[k];
        edge += axes[0][k] * axes[0][k];
        normal += axes[2][k] * axes[2][k];
    }
    for (int k = 0; k < 3; k++) {
        axes[0][k] /= sqrt(edge);
        axes[2][k] /= sqrt(normal);
    }
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;

        axes[1][k] = axes[2][i] * axes[0][j] - axes[2][j] * axes[0][i];
    }
}

/* How many rays from one side of a triangle meet something that is not near,
 * counted along the normal: of that and eight around it. */
static unsigned look(const ql_scene_t *scene, const grid_t *grid,
        const grid_face_t *face, double side)
{
    static const double ways[WAYS][2] = {{0, 0}, {1, 0}, {-1, 0}, {0, 1},
            {0, -1}, {3, 3}, {-3, 3}, {-3, -3}, {3, -3}};
    double axes[3][3], from[3];
    unsigned far = 0;

    find_axes(grid, face, axes);
    for (int k = 0; k < 3; k++) {
        from[k] = side * axes[2][k]; /* a cell off */
        for (int i = 0; i < 3; i++) {
            from[k] += grid->vertices[face->vertex[i]][k] / 3.0;
        }
    }
    for (int i = 0; i < WAYS; i++) {
        double direction[3];
        probe_t probe;

        for (int k = 0; k < 3; k++) {
            direction[k] = side * axes[2][k] + ways[i][0] * axes[0][k] +
                           ways[i][1] * axes[1][k];
        }
        far += probe_cast(&probe, scene, from, direction) &&
               probe.distance > NEAR * sqrt(1 + ways[i][0] * ways[i][0] +
                                               ways[i][1] * ways[i][1]);
    }
    return far;
}

/* Is a point in front of a triangle? */
static bool is_before(
        const grid_t *grid, const grid_face_t *face, const double point[3])
{
    const uint16_t *p = grid->vertices[face->vertex[0]];
    int64_t n[3];

    grid_normal(grid, face, n);
    return (double)n[0] * (point[0] - p[0]) + (double)n[1] * (point[1] - p[1]) +
                   (double)n[2] * (point[2] - p[2]) >
           0;
}

static void report(const world_t *world, const lamp_t *lamp, unsigned nth)
{
    if (nth < MOST) {
        cli_warn("%s: the lamp '%s' of %s shines away from everything; turn "
                 "its faces, or say 'lights two-sided'",
                world->path, world->materials[lamp->material].name,
                world->meshes[lamp->mesh].path);
    }
}

void lamp_fronts_report(
        const ql_scene_t *scene, const world_t *world, const grid_t *grid)
{
    size_t count, end;
    double eye[3];
    member_t *members = find_members(world, grid, &count);
    unsigned wrong = 0;

    (void)probe_eye(eye, world, grid);
    for (size_t i = 0; i < count && !world->two_sided; i = end) {
        const lamp_t lamp = members[i].lamp;
        unsigned ahead = 0, behind = 0;
        size_t step;

        for (end = i + 1; end < count && members[end].lamp.mesh == lamp.mesh &&
                          members[end].lamp.material == lamp.material;
                end++) {
        }
        step = (end - i) / TRIED + 1; /* some of many */
        for (size_t m = i; m < end && ahead == 0; m += step) {
            const grid_face_t *face = grid->faces + members[m].face;

            ahead += is_before(grid, face, eye);
            ahead += look(scene, grid, face, 1);
            behind += look(scene, grid, face, -1);
        }
        if (ahead == 0 && behind > 0) {
            report(world, &lamp, wrong++);
        }
    }
    if (wrong > MOST) {
        cli_warn("%s: %u more lamps shine away", world->path, wrong - MOST);
    }
    free(members);
}
