/* hull.c - the walls around a scene: nothing is behind their planes */
/* SPDX-License-Identifier: MIT */

#include "scene/touch/hull.h"

#include <stdlib.h>
#include <string.h>

#include "lib/program/cli.h"
#include "scene/touch/ranks.h"

/* Directions of the corners, edges and faces of a cube, to find vertices that
 * stick out: most faces have one of them behind. */
#define EXTREMES 27

/* The plane of a face. */
typedef struct {
    int64_t n[3];
    const uint16_t *on; /* the face's first corner */
    uint32_t face;
    uint64_t size; /* |n| of all its walls, as a sum */
} plane_t;

typedef struct {
    const grid_t *grid;
    uint32_t extremes[EXTREMES]; /* vertices */
    plane_t planes[HULL_SIDES_MAX];
    unsigned count;
    int64_t left; /* of the faces that may be asked */
} search_t;

static plane_t plane_of(const grid_t *grid, uint32_t face)
{
    plane_t plane = {{0, 0, 0}, NULL, face, 0};

    grid_normal(grid, grid->faces + face, plane.n);
    plane.on = grid->vertices[grid->faces[face].vertex[0]];
    return plane;
}

/* n.(vertex - on); below 3 2^45 */
static int64_t height_of(
        const grid_t *grid, uint32_t vertex, const plane_t *plane)
{
    const uint16_t *at = grid->vertices[vertex];
    int64_t height = 0;

    for (int k = 0; k < 3; k++) {
        height += plane->n[k] * ((int64_t)at[k] - plane->on[k]);
    }
    return height;
}

/* Does a sphere lie in front of a plane, or touch it from there? */
static bool is_sphere_before(
        const ql_blob_sphere_t *sphere, const plane_t *plane)
{
    int64_t height = 0, square = 0;

    for (int k = 0; k < 3; k++) {
        height += plane->n[k] *
                  ((int64_t)sphere->centre[k] - 256 * (int64_t)plane->on[k]);
        square += plane->n[k] * plane->n[k];
    }
    /* the height is below 2^55, |n|^2 below 2^62, the radius below 2^23 */
    return height >= 0 &&
           u128_compare(u128_mul((uint64_t)height, (uint64_t)height),
                   u128_mul((uint64_t)square,
                           (uint64_t)sphere->radius * sphere->radius)) >= 0;
}

static void find_extremes(search_t *search)
{
    const grid_t *grid = search->grid;

    for (int i = 0; i < EXTREMES; i++) {
        const int32_t way[3] = {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
        int32_t most = INT32_MIN;

        for (uint32_t v = 0; v < grid->vertex_count; v++) {
            const uint16_t *at = grid->vertices[v];
            const int32_t far =
                    way[0] * at[0] + way[1] * at[1] + way[2] * at[2];

            if (far > most) {
                most = far;
                search->extremes[i] = v;
            }
        }
    }
}

/* Is nothing behind a plane? */
static bool is_wall(search_t *search, const plane_t *plane)
{
    const grid_t *grid = search->grid;

    for (int i = 0; i < EXTREMES; i++) {
        if (height_of(grid, search->extremes[i], plane) < 0) {
            return false;
        }
    }
    for (uint32_t v = 0; v < grid->vertex_count; v++) {
        search->left--;
        if (height_of(grid, v, plane) < 0) {
            return false;
        }
    }
    for (uint32_t s = 0; s < grid->sphere_count; s++) {
        search->left--;
        if (!is_sphere_before(grid->spheres + s, plane)) {
            return false;
        }
    }
    return true;
}

/* Does a triangle lie in a plane? */
static bool is_in(
        const grid_t *grid, const grid_face_t *face, const plane_t *plane)
{
    return face->sphere == 0 && height_of(grid, face->vertex[0], plane) == 0 &&
           height_of(grid, face->vertex[1], plane) == 0 &&
           height_of(grid, face->vertex[2], plane) == 0;
}

/* Do two planes that are parallel have the same front? */
static bool is_alike(const plane_t *a, const plane_t *b)
{
    for (int k = 0; k < 3; k++) {
        if ((a->n[k] > 0) != (b->n[k] > 0)) {
            return false;
        }
    }
    return true;
}

/* The number of the wall that has a face; 0 if none has. */
static unsigned find_wall(const search_t *search, const plane_t *plane)
{
    for (unsigned i = 0; i < search->count; i++) {
        if (is_alike(search->planes + i, plane) &&
                is_in(search->grid, search->grid->faces + plane->face,
                        search->planes + i)) {
            return i + 1;
        }
    }
    return 0;
}

/* Find the planes that nothing is behind, and the faces there. */
static bool find_walls(search_t *search, uint8_t *part)
{
    for (uint32_t i = 0; i < search->grid->face_count; i++) {
        plane_t plane;

        if (search->grid->faces[i].sphere != 0) {
            continue;
        }
        plane = plane_of(search->grid, i);
        part[i] = (uint8_t)find_wall(search, &plane);
        if (part[i] == 0 && is_wall(search, &plane)) {
            if (search->count == HULL_SIDES_MAX) {
                return false;
            }
            search->planes[search->count++] = plane;
            part[i] = (uint8_t)search->count;
        }
        if (search->left < 0) {
            return false;
        }
    }
    return true;
}

/* Take the faces of a plane away that overlap another there, and measure the
 * others. */
static bool leave_overlaps(
        search_t *search, plane_t *plane, uint8_t *part, uint32_t *flat)
{
    const grid_t *grid = search->grid;
    uint32_t count = 0;

    for (uint32_t i = 0; i < grid->face_count; i++) {
        if (is_in(grid, grid->faces + i, plane)) {
            flat[count++] = i;
        }
    }
    search->left -= (int64_t)count * count;
    for (uint32_t i = 0; i < count && search->left >= 0; i++) {
        const plane_t own = plane_of(grid, flat[i]);

        for (uint32_t j = 0; j < count; j++) {
            if (i != j && ranks_do_overlap(grid, grid->faces + flat[i],
                                  grid->faces + flat[j])) {
                part[flat[i]] = 0;
            }
        }
        for (int k = 0; k < 3 && part[flat[i]] != 0; k++) {
            plane->size += (uint64_t)llabs(own.n[k]);
        }
    }
    return search->left >= 0;
}

/* n times a power of two, the largest component in 2^13..2^14, to nearest. */
static void set_normal(ql_blob_side_t *side, const int64_t n[3])
{
    int64_t most = 0, by = 1;
    bool up;

    for (int k = 0; k < 3; k++) {
        most = llabs(n[k]) > most ? llabs(n[k]) : most;
    }
    up = most < 8192;
    while (up ? most * by < 8192 : most > 16384 * by) {
        by *= 2;
    }
    for (int k = 0; k < 3; k++) {
        const int64_t half = n[k] < 0 ? -(by / 2) : by / 2;

        side->n[k] = (int16_t)(up ? n[k] * by : (n[k] + half) / by);
    }
}

static void add_side(hull_t *hull, const plane_t *plane)
{
    ql_blob_side_t *side = hull->sides + hull->side_count++;

    memset(side, 0, sizeof *side);
    set_normal(side, plane->n);
}

/* Cut the box along the dominant axis of a plane, so that all of it is in front
 * of that. */
static void cut_box(uint16_t box[3][2], const plane_t *plane)
{
    const int64_t *n = plane->n;
    const int64_t ax = llabs(n[0]), ay = llabs(n[1]), az = llabs(n[2]);
    const int axis = ax >= ay && ax >= az ? 0 : ay >= az ? 1 : 2;
    const int64_t size = llabs(n[axis]);
    int64_t least = 0, in; /* what the other axes add, and what must be added */

    for (int k = 0; k < 3; k++) {
        const int64_t low = n[k] * (box[k][0] - plane->on[k]);
        const int64_t high = n[k] * (box[k][1] - plane->on[k]);

        least += k == axis ? 0 : low < high ? low : high;
    }
    in = least < 0 ? (size - 1 - least) / size : -(least / size);
    if (n[axis] > 0 && plane->on[axis] + in > box[axis][0]) {
        in += plane->on[axis];
        box[axis][0] = (uint16_t)(in < QL_GRID_MAX ? in : QL_GRID_MAX);
    } else if (n[axis] < 0 && plane->on[axis] - in < box[axis][1]) {
        in = plane->on[axis] - in;
        box[axis][1] = (uint16_t)(in > 0 ? in : 0);
    }
}

static bool is_slanted(const int64_t n[3])
{
    return (n[0] != 0) + (n[1] != 0) + (n[2] != 0) > 1;
}

/* Number the sides: the largest first, as most rays leave there. */
static void sort_sides(const search_t *search, hull_t *hull, uint32_t n)
{
    uint8_t place[HULL_SIDES_MAX + 1] = {0};

    for (unsigned i = 0; i < search->count; i++) {
        place[i + 1] = 1;
        for (unsigned j = 0; j < search->count; j++) {
            place[i + 1] =
                    (uint8_t)(place[i + 1] +
                              (search->planes[j].size >
                                              search->planes[i].size ||
                                      (search->planes[j].size ==
                                                      search->planes[i].size &&
                                              j < i)));
        }
    }
    for (uint32_t i = 0; i < n; i++) {
        hull->part[i] = place[hull->part[i]];
    }
    for (unsigned side = 1; side <= search->count; side++) {
        for (unsigned i = 0; i < search->count; i++) {
            if (place[i + 1] == side && search->planes[i].size > 0) {
                add_side(hull, search->planes + i);
            }
        }
    }
}

/* The box that is in front of every plane. Those perpendicular to an axis cut
 * it first: what they leave is less for the others to cut. */
static void make_box(const search_t *search, hull_t *hull)
{
    for (int k = 0; k < 3; k++) {
        hull->box.box[k][1] = QL_GRID_MAX;
    }
    for (unsigned i = 0; i < 2 * search->count; i++) {
        const plane_t *plane = search->planes + i % search->count;

        if (plane->size > 0 && is_slanted(plane->n) == (i >= search->count)) {
            cut_box(hull->box.box, plane);
        }
    }
}

static bool find_hull(search_t *search, hull_t *hull)
{
    const uint32_t n = search->grid->face_count;
    uint32_t *flat = cli_alloc(n, sizeof *flat);
    uint32_t inner = 0;
    bool found;

    if (search->grid->vertex_count > 0) {
        find_extremes(search);
    }
    found = search->grid->vertex_count > 0 && find_walls(search, hull->part);
    for (unsigned i = 0; i < search->count && found; i++) {
        found = leave_overlaps(search, search->planes + i, hull->part, flat);
    }
    free(flat);
    for (uint32_t i = 0; i < n; i++) {
        inner += hull->part[i] == 0;
    }
    if (!found || inner == 0 || inner == n) {
        return false;
    }
    hull->box.first = (uint16_t)inner;
    sort_sides(search, hull, n);
    make_box(search, hull);
    return true;
}

void hull_find(hull_t *hull, const grid_t *grid)
{
    search_t search = {
            .grid = grid, .left = (int64_t)HULL_WALKS_MAX * grid->face_count};

    memset(hull, 0, sizeof *hull);
    hull->part = cli_alloc(grid->face_count, sizeof *hull->part);
    if (!find_hull(&search, hull)) {
        hull_free(hull);
    }
}

bvh_apart_t hull_apart(hull_t *hull)
{
    const bvh_apart_t apart = {hull->part, hull->side_count, hull->nodes};

    return apart;
}

void hull_free(hull_t *hull)
{
    free(hull->part);
    memset(hull, 0, sizeof *hull);
}
