/* ranks.c - which of the faces in one place counts */
/* SPDX-License-Identifier: MIT */

#include "scene/touch/ranks.h"

#include <stdlib.h>
#include <string.h>

#include "lib/program/cli.h"
#include "scene/touch/around.h"

static const uint16_t *corner(
        const grid_t *grid, const grid_face_t *face, int i)
{
    return grid->vertices[face->vertex[i % 3]];
}

/* Are all corners of a triangle in the plane of another? n is its normal. */
static bool is_in_plane(const grid_t *grid, const grid_face_t *face,
        const int64_t n[3], const grid_face_t *other)
{
    const uint16_t *on = corner(grid, face, 0);

    for (int i = 0; i < 3; i++) {
        const uint16_t *p = corner(grid, other, i);
        int64_t height = 0;

        for (int k = 0; k < 3; k++) {
            height += n[k] * (p[k] - on[k]);
        }
        if (height != 0) {
            return false;
        }
    }
    return true;
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

/* Do two triangles have an area in common? */
static bool do_overlap(
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
    return is_in_plane(grid, a, n, b) && !is_beyond(grid, a, n, axis, b) &&
           !is_beyond(grid, b, m, axis, a);
}

static bool are_equal_spheres(
        const grid_t *grid, const grid_face_t *a, const grid_face_t *b)
{
    return memcmp(grid->spheres + a->sphere - 1, grid->spheres + b->sphere - 1,
                   sizeof *grid->spheres) == 0;
}

/* Does a face share its place with another? */
static bool overlaps_any(
        const grid_t *grid, const bvh_t *bvh, const grid_face_t *face)
{
    const grid_face_t *other;
    around_t walk;

    around_begin(&walk, grid, bvh, box_around(grid, face, 0));
    while ((other = around_next(&walk)) != NULL) {
        if (other == face || (other->sphere != 0) != (face->sphere != 0)) {
            continue;
        }
        if (face->sphere != 0 ? are_equal_spheres(grid, face, other)
                              : do_overlap(grid, face, other)) {
            return true;
        }
    }
    return false;
}

uint16_t *ranks_find(const grid_t *grid, const bvh_t *bvh)
{
    uint16_t *ranks = NULL;
    bool overlaps = false;

    for (uint32_t i = 0; i < grid->face_count && !overlaps; i++) {
        overlaps = overlaps_any(grid, bvh, grid->faces + i);
    }
    if (overlaps) {
        ranks = cli_alloc(grid->face_count, sizeof *ranks);
        for (uint32_t i = 0; i < grid->face_count; i++) {
            ranks[i] = (uint16_t)bvh->order[i]; /* 65,535 faces at most */
        }
    }
    return ranks;
}
