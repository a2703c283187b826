/* fill.c - faces of many corners to triangles, as their outline is drawn */
/* SPDX-License-Identifier: MIT */

/* Ears are cut off: corners whose neighbours can see each other. A corner that
 * is none becomes one only if a neighbour is cut off, so each is looked at
 * three times, with all others, and again if that is done less strictly. */

#include "scene/fill/fill.h"

#include <math.h>
#include <stdlib.h>

#include "lib/program/cli.h"
#include "scene/fill/crossing.h"
#include "scene/fill/plane.h"

#define BENT 1.0154 /* 1 / cos(10 degrees) */

/* A corner that is not cut off yet. */
typedef struct {
    plane_point_t at;
    uint32_t vertex, normal; /* as of a world_face_t */
    uint32_t previous, next; /* in the ring */
    bool bulges;             /* the outline turns left here */
    bool is_ear;
} corner_t;

/* What keeps a corner from being an ear: that it is thin, and corners inside
 * its triangle or on its sides; the latter; only those inside. A thin ear is
 * what rounding leaves of a corner in a side. The grid would drop it, and then
 * only the neighbour of the face had that corner. */
typedef enum { THIN, TOUCHING, INSIDE } strictness_t;

typedef struct {
    const world_t *world;
    corner_t *corners;
    plane_point_t *points; /* where they are */
    size_t count;
    size_t left; /* corners not cut off yet */
    strictness_t strictness;
    world_face_t
            *faces; /* triangles cut off, all with the last one's material */
    size_t face_count;
} ring_t;

/* ---- triangles ---- */

/* Twice the area of a triangle; its normal is added to a sum. */
static double add_normal(
        double sum[3], const world_t *world, const world_face_t *face)
{
    const double *p = world->vertices[face->vertex[0]];
    double a[3], b[3], square = 0;

    for (int k = 0; k < 3; k++) {
        a[k] = world->vertices[face->vertex[1]][k] - p[k];
        b[k] = world->vertices[face->vertex[2]][k] - p[k];
    }
    for (int k = 0; k < 3; k++) {
        const int x = (k + 1) % 3, y = (k + 2) % 3;
        const double n = a[x] * b[y] - a[y] * b[x];

        sum[k] += n;
        square += n * n;
    }
    return sqrt(square);
}

/* Make a triangle of a corner and its neighbours, the first one first. */
static void add_face(ring_t *ring, const corner_t *corner)
{
    const uint32_t a = corner->previous, c = corner->next;
    const uint32_t b = (uint32_t)(corner - ring->corners);
    const uint32_t of[5] = {a, b, c, a, b};
    const int first = a < b && a < c ? 0 : b < c ? 1 : 2;
    world_face_t *face = ring->faces + ring->face_count++;

    for (int k = 0; k < 3; k++) {
        const corner_t *from = ring->corners + of[first + k];

        face->vertex[k] = from->vertex;
        face->normal[k] = from->normal;
    }
}

/* ---- the ring ---- */

static const corner_t *previous(const ring_t *ring, const corner_t *corner)
{
    return ring->corners + corner->previous;
}

static const corner_t *next(const ring_t *ring, const corner_t *corner)
{
    return ring->corners + corner->next;
}

static int turn(const ring_t *ring, const corner_t *corner)
{
    return plane_side(
            &previous(ring, corner)->at, &corner->at, &next(ring, corner)->at);
}

static bool is_at(const corner_t *a, const corner_t *b)
{
    return a->at.x == b->at.x && a->at.y == b->at.y;
}

static void unlink_corner(ring_t *ring, uint32_t i)
{
    const corner_t *corner = ring->corners + i;

    ring->corners[corner->previous].next = corner->next;
    ring->corners[corner->next].previous = corner->previous;
    ring->left--;
}

/* Is a corner the end of a line that encloses nothing, or a repeated one? */
static bool is_spike(const ring_t *ring, uint32_t i)
{
    const corner_t *corner = ring->corners + i;

    return turn(ring, corner) == 0 &&
           plane_turns_back(&previous(ring, corner)->at, &corner->at,
                   &next(ring, corner)->at);
}

/* Take out a spike. If it is none in space, only seen along the normal, it
 * leaves a triangle. */
static void cut_spike(ring_t *ring, uint32_t i)
{
    double normal[3] = {0, 0, 0};

    add_face(ring, ring->corners + i);
    if (add_normal(normal, ring->world, ring->faces + ring->face_count - 1) ==
            0) {
        ring->face_count--;
    }
    unlink_corner(ring, i);
}

/* Take out spikes at corner i, behind it, and where that makes new ones; return
 * the corner that is there then. */
static uint32_t cut_spikes(ring_t *ring, uint32_t i)
{
    while (ring->left > 2) {
        if (is_spike(ring, i)) {
            const uint32_t before = ring->corners[i].previous;

            cut_spike(ring, i);
            i = before;
        } else if (is_spike(ring, ring->corners[i].next)) {
            cut_spike(ring, ring->corners[i].next);
        } else {
            break;
        }
    }
    return i;
}

/* ---- ears ---- */

static bool is_beside(const corner_t *corner, const corner_t *a,
        const corner_t *b, const corner_t *c)
{
    const plane_point_t *p = &corner->at;

    return (p->x < a->at.x && p->x < b->at.x && p->x < c->at.x) ||
           (p->x > a->at.x && p->x > b->at.x && p->x > c->at.x) ||
           (p->y < a->at.y && p->y < b->at.y && p->y < c->at.y) ||
           (p->y > a->at.y && p->y > b->at.y && p->y > c->at.y);
}

/* Is a corner in the triangle of others, but at none of them? */
static bool is_within(const ring_t *ring, const corner_t *corner,
        const corner_t *a, const corner_t *b, const corner_t *c)
{
    const int least = ring->strictness == INSIDE ? 1 : 0;

    return !is_beside(corner, a, b, c) &&
           plane_side(&a->at, &b->at, &corner->at) >= least &&
           plane_side(&b->at, &c->at, &corner->at) >= least &&
           plane_side(&c->at, &a->at, &corner->at) >= least &&
           !is_at(corner, a) && !is_at(corner, b) && !is_at(corner, c);
}

/* Is a corner less than about 2^-16 of the width of the face above the line
 * between its neighbours? Coordinates are cut to 2^28, so that products of
 * their differences are below 2^58. */
static bool is_thin(const corner_t *a, const corner_t *b, const corner_t *c)
{
    const int64_t cut = (int64_t)1 << 33;
    const int64_t x = c->at.x / cut - a->at.x / cut;
    const int64_t y = c->at.y / cut - a->at.y / cut;
    const int64_t size = (x < 0 ? -x : x) + (y < 0 ? -y : y);
    const int64_t area = (b->at.x / cut - a->at.x / cut) * y -
                         (b->at.y / cut - a->at.y / cut) * x;

    return area <= size << 12;
}

/* Can the neighbours of a corner see each other? Where corners are inside its
 * triangle, the one farthest behind the line between the neighbours does not
 * bulge, so that others need not be looked at. */
static bool find_ear(const ring_t *ring, const corner_t *b)
{
    const corner_t *a = previous(ring, b), *c = next(ring, b);

    if (!b->bulges || (ring->strictness == THIN && is_thin(a, b, c))) {
        return false;
    }
    for (const corner_t *p = next(ring, c); p != a; p = next(ring, p)) {
        if (!p->bulges && is_within(ring, p, a, b, c)) {
            return false;
        }
    }
    return true;
}

/* Look again at a corner whose neighbours have changed, and at the next. */
static void look_again(ring_t *ring, uint32_t i)
{
    corner_t *corner = ring->corners + i;
    corner_t *behind = ring->corners + corner->next;

    corner->bulges = turn(ring, corner) > 0;
    behind->bulges = turn(ring, behind) > 0;
    corner->is_ear = find_ear(ring, corner);
    behind->is_ear = find_ear(ring, behind);
}

/* Look at all corners from i on. */
static void look_at_all(ring_t *ring, uint32_t i)
{
    for (size_t k = 0; k < ring->left; k++, i = ring->corners[i].next) {
        ring->corners[i].bulges = turn(ring, ring->corners + i) > 0;
    }
    for (size_t k = 0; k < ring->left; k++, i = ring->corners[i].next) {
        ring->corners[i].is_ear = find_ear(ring, ring->corners + i);
    }
}

/* Cut off a corner; return one behind it. */
static uint32_t cut_ear(ring_t *ring, uint32_t i)
{
    const corner_t *corner = ring->corners + i;

    add_face(ring, corner);
    unlink_corner(ring, i);
    i = cut_spikes(ring, corner->previous);
    if (ring->left > 2) {
        look_again(ring, i);
    }
    return next(ring, ring->corners + i)->next;
}

/* Of the corners with a turn to a side the one whose neighbours are nearest to
 * each other; SIZE_MAX if there is none. */
static size_t find_shortest(const ring_t *ring, uint32_t i, int side)
{
    uint64_t least = UINT64_MAX;
    size_t found = SIZE_MAX;

    for (size_t k = 0; k < ring->left; k++, i = ring->corners[i].next) {
        const corner_t *corner = ring->corners + i;
        const plane_point_t *a = &previous(ring, corner)->at;
        const plane_point_t *c = &next(ring, corner)->at;
        /* below 2^63 */
        const uint64_t apart =
                (uint64_t)(a->x < c->x ? c->x - a->x : a->x - c->x) +
                (uint64_t)(a->y < c->y ? c->y - a->y : a->y - c->y);

        if (turn(ring, corner) == side && apart < least) {
            least = apart;
            found = i;
        }
    }
    return found;
}

/* Cut off all corners; return false if one had to go that is no ear. */
static bool cut_ears(ring_t *ring, uint32_t i)
{
    bool clean = true;
    size_t idle = 0;

    look_at_all(ring, i);
    while (ring->left > 2) {
        if (ring->corners[i].is_ear) {
            i = cut_ear(ring, i);
            idle = 0;
        } else if (++idle < ring->left) {
            i = ring->corners[i].next;
        } else if (ring->strictness != INSIDE) {
            ring->strictness++;
            look_at_all(ring, i);
            idle = 0;
        } else {
            size_t forced = find_shortest(ring, i, 1);

            forced = forced != SIZE_MAX ? forced : find_shortest(ring, i, -1);
            i = cut_ear(ring, (uint32_t)forced); /* a ring has a turn */
            clean = false;
            idle = 0;
        }
    }
    return clean;
}

/* ---- outlines ---- */

/* Take the corners of a fan; false if they enclose nothing. */
static bool open_ring(
        ring_t *ring, const world_t *world, world_face_t *fan, size_t count)
{
    const size_t n = count + 2;
    uint32_t *vertices = cli_alloc(n, sizeof *vertices);
    bool seen;

    ring->world = world;
    ring->corners = cli_alloc(n, sizeof *ring->corners);
    ring->points = cli_alloc(n, sizeof *ring->points);
    ring->count = n;
    ring->faces = fan;
    for (size_t i = 0; i < n; i++) {
        const world_face_t *face = fan + (i < 2 ? 0 : i - 2);
        const size_t k = i < 2 ? i : 2;

        ring->corners[i].vertex = vertices[i] = face->vertex[k];
        ring->corners[i].normal = face->normal[k];
    }
    seen = plane_project(ring->points, world, vertices, n);
    free(vertices);
    return seen;
}

static void close_ring(ring_t *ring)
{
    free(ring->points);
    free(ring->corners);
}

/* The nearest multiple of 2^bits; x is 2^61 at most in size, bits below 61. */
static int64_t snap(int64_t x, unsigned bits)
{
    const int64_t size = (int64_t)1 << bits;
    const int64_t rest = (x % size + size) % size;

    return x - rest + (2 * rest >= size ? size : 0);
}

/* Join all corners to a ring, on a lattice, and take out spikes; return one
 * that is left. */
static uint32_t begin_ring(ring_t *ring, unsigned bits)
{
    const size_t n = ring->count;
    uint32_t i = 0;
    size_t clean = 0; /* corners before i that are no spikes */

    for (size_t k = 0; k < n; k++) {
        corner_t *corner = ring->corners + k;

        corner->at.x = snap(ring->points[k].x, bits);
        corner->at.y = snap(ring->points[k].y, bits);
        corner->previous = (uint32_t)((k + n - 1) % n);
        corner->next = (uint32_t)((k + 1) % n);
    }
    ring->left = n;
    ring->strictness = THIN;
    ring->face_count = 0;
    while (ring->left > 2 && clean < ring->left) {
        if (is_spike(ring, i)) {
            cut_spike(ring, i);
            i = ring->corners[i].previous;
            clean = clean > 2 ? clean - 2 : 0; /* its neighbours may be now */
        } else {
            i = ring->corners[i].next;
            clean++;
        }
    }
    return i;
}

/* Does the way from one corner to the next point up, or right? */
static bool points_up(const corner_t *from, const corner_t *to)
{
    return to->at.y > from->at.y ||
           (to->at.y == from->at.y && to->at.x > from->at.x);
}

/* Does the outline go around once, and do all corners bulge by more than a
 * little? */
typedef struct {
    bool once, convex;
} shape_t;

static shape_t find_shape(const ring_t *ring, uint32_t i)
{
    shape_t shape = {false, true};
    int64_t rounds = 0; /* times the direction has passed the right */

    for (size_t k = 0; k < ring->left; k++, i = ring->corners[i].next) {
        const corner_t *corner = ring->corners + i;
        const int side = turn(ring, corner);
        const bool up = points_up(corner, next(ring, corner));

        if (points_up(previous(ring, corner), corner) != up) {
            rounds += side > 0 && up ? 1 : side < 0 && !up ? -1 : 0;
        }
        shape.convex =
                shape.convex && side > 0 &&
                !is_thin(previous(ring, corner), corner, next(ring, corner));
    }
    shape.once = rounds == 1;
    return shape;
}

static bool has_crossing(const ring_t *ring, uint32_t i)
{
    plane_point_t *points = cli_alloc(ring->left, sizeof *points);
    bool found;

    for (size_t k = 0; k < ring->left; k++, i = ring->corners[i].next) {
        points[k] = ring->corners[i].at;
    }
    found = crossing_find(points, ring->left);
    free(points);
    return found;
}

static bool is_bent(
        const world_t *world, const world_face_t *faces, size_t count)
{
    double sum[3] = {0, 0, 0}, area = 0;

    for (size_t i = 0; i < count; i++) {
        area += add_normal(sum, world, faces + i);
    }
    return area >
           BENT * sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
}

/* Lattices for corners, as bits of points that are about 2^60 wide: none, and
 * from 2^-40 of that to 2^-16. On these the sides of a bridge that rounding has
 * taken apart come together again, where they cross otherwise. */
static const unsigned lattices[] = {0, 20, 30, 40, 44};

/* Fill the outline of a ring that has an area. */
static size_t fill_ring(fill_faults_t *faults, ring_t *ring)
{
    for (size_t k = 0; k < sizeof lattices / sizeof *lattices; k++) {
        const uint32_t i = begin_ring(ring, lattices[k]);
        const shape_t shape = find_shape(ring, i);

        if (k == 0 && ring->left < 3) {
            return ring->face_count;
        }
        if (k == 0 && ring->left == ring->count && shape.convex && shape.once) {
            return ring->count - 2; /* the fan */
        }
        if (shape.once && !has_crossing(ring, i) && cut_ears(ring, i)) {
            return ring->face_count;
        }
    }
    faults->crosses = true;
    (void)cut_ears(ring, begin_ring(ring, 0));
    return ring->face_count;
}

size_t fill_face(fill_faults_t *faults, const world_t *world, world_face_t *fan,
        size_t count)
{
    ring_t ring;

    faults->crosses = faults->is_bent = false;
    if (count < 2) {
        return count;
    }
    count = open_ring(&ring, world, fan, count) ? fill_ring(faults, &ring) : 0;
    faults->is_bent = !faults->crosses && is_bent(world, fan, count);
    close_ring(&ring);
    return count;
}
