/* ranks.c - which of the faces in one place counts */
/* SPDX-License-Identifier: MIT */

#include "scene/touch/ranks.h"

#include <stdlib.h>

#include "lib/program/cli.h"
#include "scene/touch/around.h"

static const uint16_t *corner(
        const grid_t *grid, const grid_face_t *face, int i)
{
    return grid->vertices[face->vertex[i % 3]];
}

/* Is a triangle beyond an edge of another, or on it, seen along an axis on
 * which the normal of that is not 0? */
static bool is_beyond(const grid_t *grid, const grid_face_t *face,
        const int64_t n[3], int axis, const grid_face_t *other)
{
    const int x = (axis + 1) % 3, y = (axis + 2) % 3;

    for (int i = 0; i < 3; i++) {
        const uint16_t *a = corner(grid, face, i);
        const uint16_t *b = corner(grid, face, i + 1);
        bool beyond = true;

        for (int j = 0; j < 3; j++) {
            const uint16_t *p = corner(grid, other, j);
            const int64_t in = (int64_t)(b[x] - a[x]) * (p[y] - a[y]) -
                               (int64_t)(b[y] - a[y]) * (p[x] - a[x]);

            beyond = beyond && (n[axis] > 0 ? in <= 0 : in >= 0);
        }
        if (beyond) {
            return true;
        }
    }
    return false;
}

bool ranks_do_overlap(
        const grid_t *grid, const grid_face_t *a, const grid_face_t *b)
{
    int64_t n[3], m[3];
    int axis = 0;

    grid_normal(grid, a, n);
    grid_normal(grid, b, m);
    while (n[axis] == 0) {
        axis++;
    }
    /* in one plane their normals are 0 on the same axes */
    return !is_beyond(grid, a, n, axis, b) && !is_beyond(grid, b, m, axis, a);
}

/* ---- Faces by their planes ----------------------------------------------- */

/* The plane of a triangle, n in lowest terms and of one sign; or where a sphere
 * is, its radius beyond every d. */
typedef struct {
    int64_t n[3], d; /* below 2^32 and 2^49 */
    uint32_t face;
} plane_t;

#define SPHERE ((int64_t)1 << 50)

static int64_t common_divisor(int64_t a, int64_t b)
{
    while (b != 0) {
        const int64_t rest = a % b;

        a = b;
        b = rest;
    }
    return a < 0 ? -a : a;
}

static plane_t plane_of(const grid_t *grid, uint32_t face)
{
    const grid_face_t *f = grid->faces + face;
    plane_t plane = {{0, 0, 0}, 0, face};
    int64_t divisor = 0;

    if (f->sphere != 0) {
        const ql_blob_sphere_t *sphere = grid->spheres + f->sphere - 1;

        for (int k = 0; k < 3; k++) {
            plane.n[k] = sphere->centre[k];
        }
        plane.d = SPHERE + sphere->radius;
        return plane;
    }
    grid_normal(grid, f, plane.n);
    for (int k = 0; k < 3; k++) {
        divisor = common_divisor(divisor, plane.n[k]);
    }
    for (int k = 2; k >= 0; k--) {
        divisor = plane.n[k] != 0 && (plane.n[k] < 0) != (divisor < 0)
                          ? -divisor
                          : divisor;
    }
    for (int k = 0; k < 3; k++) {
        plane.n[k] /= divisor;
        plane.d += plane.n[k] * corner(grid, f, 0)[k];
    }
    return plane;
}

static int compare_planes(const void *a, const void *b)
{
    const plane_t *p = a, *q = b;

    for (int k = 0; k < 3; k++) {
        if (p->n[k] != q->n[k]) {
            return p->n[k] < q->n[k] ? -1 : 1;
        }
    }
    return (p->d > q->d) - (p->d < q->d);
}

/* For each face the number of its plane, 0 if it is alone there. */
static uint32_t *number_planes(const grid_t *grid)
{
    const uint32_t n = grid->face_count;
    uint32_t *numbers = cli_alloc(n, sizeof *numbers);
    plane_t *planes = cli_alloc(n, sizeof *planes);
    uint32_t first = 0;

    for (uint32_t i = 0; i < n; i++) {
        planes[i] = plane_of(grid, i);
    }
    qsort(planes, n, sizeof *planes, compare_planes);
    for (uint32_t i = 1; i < n; i++) {
        if (compare_planes(planes + first, planes + i) == 0) {
            numbers[planes[first].face] = numbers[planes[i].face] = first + 1;
        } else {
            first = i;
        }
    }
    free(planes);
    return numbers;
}

/* Does a face share its place with another? */
static bool overlaps_any(const grid_t *grid, const bvh_t *bvh,
        const uint32_t *planes, const grid_face_t *face)
{
    const uint32_t plane = planes[face - grid->faces];
    const grid_face_t *other;
    around_t walk;

    if (plane == 0) {
        return false;
    }
    around_begin(&walk, grid, bvh, box_around(grid, face, 0));
    while ((other = around_next(&walk)) != NULL) {
        if (other != face && planes[other - grid->faces] == plane &&
                (face->sphere != 0 || ranks_do_overlap(grid, face, other))) {
            return true;
        }
    }
    return false;
}

uint16_t *ranks_find(const grid_t *grid, const bvh_t *bvh)
{
    uint32_t *planes = number_planes(grid);
    uint16_t *ranks = NULL;
    bool overlaps = false;

    for (uint32_t i = 0; i < grid->face_count && !overlaps; i++) {
        overlaps = overlaps_any(grid, bvh, planes, grid->faces + i);
    }
    free(planes);
    if (overlaps) {
        ranks = cli_alloc(grid->face_count, sizeof *ranks);
        for (uint32_t i = 0; i < grid->face_count; i++) {
            ranks[i] = (uint16_t)bvh->order[i]; /* 65,535 faces at most */
        }
    }
    return ranks;
}
