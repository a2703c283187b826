/* contacts.c - which faces have another that comes near their inside */
/* SPDX-License-Identifier: MIT */

#include "scene/touch/contacts.h"

#include <stdlib.h>
#include <string.h>

#include "lib/math/soft.h"
#include "lib/program/cli.h"
#include "scene/touch/around.h"

enum {
    REACH = 8,         /* grid units between boxes that may be near */
    INSIDE_HALVES = 5, /* where the inside begins, in halves of a unit */
    HEIGHT_HALVES = 7, /* how near is near, likewise */
    RADIUS_LEAST = 64  /* of a sphere that a step hardly curves around */
};

/* Where a point is, as a triangle sees it: how far inside of each edge, times
 * the edge, and how far in front, times the normal. */
enum { FRONT = 3, SIGHTS };
typedef struct {
    int64_t of[SIGHTS];
} sight_t;

/* A triangle that looks at others. */
typedef struct {
    int64_t corner[3], e1[3], e2[3], normal[3];
    int x, y;             /* the axes that are not dominant */
    int64_t whole;        /* the doubled area seen along the third */
    int64_t near[SIGHTS]; /* twice what counts as near: above, of FRONT below */
} viewer_t;

static int64_t absolute(int64_t x)
{
    return x < 0 ? -x : x;
}

static int64_t cross2(const viewer_t *v, const int64_t a[3], const int64_t b[3])
{
    return a[v->x] * b[v->y] - a[v->y] * b[v->x];
}

/* |x| + |y| of an edge, as the core has it. */
static int64_t width(const viewer_t *v, const int64_t edge[3])
{
    return absolute(edge[v->x]) + absolute(edge[v->y]);
}

static viewer_t viewer_of(const grid_t *grid, const grid_face_t *face)
{
    viewer_t v;
    int64_t e3[3];
    int z;

    for (int k = 0; k < 3; k++) {
        v.corner[k] = grid->vertices[face->vertex[0]][k];
        v.e1[k] = grid->vertices[face->vertex[1]][k] - v.corner[k];
        v.e2[k] = grid->vertices[face->vertex[2]][k] - v.corner[k];
        e3[k] = v.e2[k] - v.e1[k];
    }
    grid_normal(grid, face, v.normal);
    z = absolute(v.normal[0]) >= absolute(v.normal[1]) ? 0 : 1;
    z = absolute(v.normal[z]) >= absolute(v.normal[2]) ? z : 2;
    v.x = (z + 1) % 3;
    v.y = (z + 2) % 3;
    v.whole = cross2(&v, v.e1, v.e2);
    v.near[0] = INSIDE_HALVES * width(&v, v.e1);
    v.near[1] = INSIDE_HALVES * width(&v, v.e2);
    v.near[2] = INSIDE_HALVES * width(&v, e3);
    v.near[FRONT] = HEIGHT_HALVES * absolute(v.normal[z]);
    return v;
}

/* Exact: below 2^33, in front below 2^48. unit is 1, or more for a position in
 * parts of a grid unit. */
static sight_t see(const viewer_t *v, const int64_t at[3], int64_t unit)
{
    const int64_t sign = v->whole < 0 ? -1 : 1;
    sight_t seen;
    int64_t s[3];

    for (int k = 0; k < 3; k++) {
        s[k] = at[k] - unit * v->corner[k];
    }
    seen.of[0] = sign * cross2(v, v->e1, s);
    seen.of[1] = sign * cross2(v, s, v->e2);
    seen.of[2] = unit * absolute(v->whole) - seen.of[0] - seen.of[1];
    seen.of[FRONT] =
            v->normal[0] * s[0] + v->normal[1] * s[1] + v->normal[2] * s[2];
    return seen;
}

/* ---- a triangle and another ---- */

typedef struct {
    soft_t of[SIGHTS];
} point_t;

enum { POINTS_MAX = 3 + 2 + 3 }; /* each cut adds one at most */

static point_t between(const point_t *a, const point_t *b, int which, soft_t at)
{
    const soft_t part = soft_div(
            soft_sub(at, a->of[which]), soft_sub(b->of[which], a->of[which]));
    point_t p;

    for (int i = 0; i < SIGHTS; i++) {
        p.of[i] = soft_add(
                a->of[i], soft_mul(part, soft_sub(b->of[i], a->of[i])));
    }
    p.of[which] = at;
    return p;
}

/* Cut a convex polygon where one of its sights, times sign, is below a limit.
 * Returns how many corners are left. */
static int cut(point_t *points, int count, int which, int sign, soft_t limit)
{
    point_t kept[POINTS_MAX];
    int left = 0;

    for (int i = 0; i < count; i++) {
        const point_t *a = points + i, *b = points + (i + 1) % count;
        const int in = sign * soft_compare(a->of[which], limit);
        const int next = sign * soft_compare(b->of[which], limit);

        if (in >= 0) {
            kept[left++] = *a;
        }
        if ((in > 0 && next < 0) || (in < 0 && next > 0)) {
            kept[left++] = between(a, b, which, limit);
        }
    }
    memcpy(points, kept, (size_t)left * sizeof *kept);
    return left;
}

/* Are all corners beyond an edge, or above, or below? Nearly all are. */
static bool is_far(const viewer_t *v, const sight_t seen[3])
{
    const int64_t high = v->near[FRONT]; /* and each sight is below 2^49 */
    bool above = true, below = true;

    for (int i = 0; i < 3; i++) {
        if (2 * seen[0].of[i] <= v->near[i] &&
                2 * seen[1].of[i] <= v->near[i] &&
                2 * seen[2].of[i] <= v->near[i]) {
            return true;
        }
        above = above && 2 * seen[i].of[FRONT] > high;
        below = below && 2 * seen[i].of[FRONT] < -high;
    }
    return above || below;
}

/* Is a part of a triangle near the inside of another? */
static bool is_near(const viewer_t *v, const sight_t seen[3])
{
    const soft_t height = soft_int(v->near[FRONT], -1);
    point_t points[POINTS_MAX];
    int count = 3;

    if (is_far(v, seen)) {
        return false;
    }
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < SIGHTS; k++) {
            points[i].of[k] = soft_int(seen[i].of[k], 0);
        }
    }
    count = cut(points, count, FRONT, -1, height);
    count = cut(points, count, FRONT, 1, soft_negate(height));
    for (int i = 0; i < 3; i++) {
        count = cut(points, count, i, 1, soft_int(v->near[i], -1));
    }
    return count > 0;
}

/* ---- spheres ---- */

/* Does the surface of a sphere come into a box, that is: is the nearest point
 * of it inside, and the farthest outside? */
static bool is_crossed(const box_t *box, const ql_blob_sphere_t *sphere)
{
    const int64_t r = sphere->radius;
    int64_t nearest = 0, farthest = 0;

    for (int k = 0; k < 3; k++) {
        const int64_t c = sphere->centre[k];
        const int64_t low = c - 256 * (int64_t)box->low[k];
        const int64_t high = 256 * (int64_t)box->high[k] - c;
        const int64_t out = low < 0 ? -low : high < 0 ? -high : 0;
        const int64_t far = low > high ? low : high;

        nearest += out * out;
        farthest += far * far;
    }
    return nearest <= r * r && farthest >= r * r;
}

/* Is a part of a sphere near the inside of a triangle? Its extent along a sight
 * is its radius times the gradient, or less than |x| + |y| (+ |z|). */
static bool is_sphere_near(const viewer_t *v, const ql_blob_sphere_t *sphere)
{
    const int64_t r = sphere->radius;
    int64_t at[3], size = 0;
    sight_t seen;

    for (int k = 0; k < 3; k++) {
        at[k] = sphere->centre[k];
        size += absolute(v->normal[k]);
    }
    seen = see(v, at, 256); /* below 2^41; in front below 2^56 */
    for (int i = 0; i < 3; i++) {
        if (2 * seen.of[i] + 2 * r * (v->near[i] / INSIDE_HALVES) <=
                256 * v->near[i]) {
            return false;
        }
    }
    return 2 * (absolute(seen.of[FRONT]) - r * size) < 256 * v->near[FRONT];
}

/* ---- each face and all others ---- */

/* The face that is being looked from, and what was found. */
typedef struct {
    const grid_t *grid;
    const grid_face_t *face;
    viewer_t viewer; /* of a triangle */
    box_t box;
    bool touches; /* something is within reach */
    bool marked;  /* near its inside */
} search_t;

static void look_at_triangle(search_t *s, const grid_face_t *other)
{
    sight_t seen[3];
    bool is_flat = true;

    for (int i = 0; i < 3; i++) {
        const uint16_t *p = s->grid->vertices[other->vertex[i]];
        const int64_t at[3] = {p[0], p[1], p[2]};

        seen[i] = see(&s->viewer, at, 1);
        is_flat = is_flat && seen[i].of[FRONT] == 0;
    }
    /* what is in the plane is near only where rays pass through it */
    s->marked = is_near(&s->viewer, seen);
    s->touches = s->touches || s->marked || !is_flat;
}

static void look_at(search_t *s, const grid_face_t *other)
{
    if (other == s->face) {
        return;
    }
    if (s->face->sphere != 0) {
        /* whether the other comes near this sphere */
        const box_t box = box_around(s->grid, other, REACH);

        if (is_crossed(&box, s->grid->spheres + s->face->sphere - 1)) {
            s->touches = s->marked = true;
        }
    } else if (other->sphere != 0) {
        const ql_blob_sphere_t *sphere = s->grid->spheres + other->sphere - 1;

        if (is_crossed(&s->box, sphere)) {
            s->touches = true;
            s->marked = is_sphere_near(&s->viewer, sphere);
        }
    } else {
        look_at_triangle(s, other);
    }
}

/* Look at every face within reach, until one is near. */
static void look_around(search_t *s, const bvh_t *bvh)
{
    const grid_face_t *other;
    around_t walk;

    around_begin(&walk, s->grid, bvh, s->box);
    while (!s->marked && (other = around_next(&walk)) != NULL) {
        look_at(s, other);
    }
}

static bool is_small(const grid_t *grid, const grid_face_t *face)
{
    return face->sphere != 0 &&
           grid->spheres[face->sphere - 1].radius < 256 * RADIUS_LEAST;
}

uint16_t *contacts_find(const grid_t *grid, const bvh_t *bvh)
{
    const size_t words = (grid->face_count + 15) / 16;
    uint16_t *marks = cli_alloc(words, sizeof *marks);
    bool touches = false;

    memset(marks, 0, words * sizeof *marks);
    for (uint32_t i = 0; i < grid->face_count; i++) {
        search_t s;

        memset(&s, 0, sizeof s);
        s.grid = grid;
        s.face = grid->faces + bvh->order[i];
        s.box = box_around(grid, s.face, REACH);
        if (s.face->sphere == 0) {
            s.viewer = viewer_of(grid, s.face);
        }
        s.touches = s.marked = is_small(grid, s.face);
        look_around(&s, bvh);
        touches = touches || s.touches;
        marks[i / 16] = (uint16_t)(marks[i / 16] | s.marked << i % 16);
    }
    if (!touches) {
        free(marks);
        return NULL;
    }
    return marks;
}
