/* bvh.c - BVH by full-sweep SAH, of guaranteed depth */
/* SPDX-License-Identifier: MIT */

#include "scene/mesh/bvh.h"

#include <stdlib.h>
#include <string.h>

#include "lib/program/cli.h"
#include "scene/ql_blob.h"

typedef struct {
    uint16_t low[3], high[3];
} box_t;

typedef struct {
    const grid_t *grid;
    const bvh_cost_t *cost;
    bvh_t *bvh;
    box_t *boxes;        /* of each face */
    uint32_t *sorted[3]; /* faces by centroid along each axis */
    uint32_t *scratch;
    uint64_t *lower_area; /* of the first i + 1 faces of a range */
    bool *is_upper;       /* per face: goes to the second child */
    unsigned leaf_max;
    bool quiet;
    uint32_t done; /* faces in leaves so far */
} builder_t;

/* A place to split the range: faces [0, count) go to the first child. */
typedef struct {
    uint64_t cost; /* less the cost of the pair */
    uint32_t count;
    uint32_t imbalance;
    int axis;
} split_t;

static void empty_box(box_t *box)
{
    memset(box->low, 0xff, sizeof box->low);
    memset(box->high, 0, sizeof box->high);
}

static void extend_box(box_t *box, const box_t *other)
{
    for (int k = 0; k < 3; k++) {
        if (other->low[k] < box->low[k]) {
            box->low[k] = other->low[k];
        }
        if (other->high[k] > box->high[k]) {
            box->high[k] = other->high[k];
        }
    }
}

/* Half the surface of the grid cells of a box, so that none is 0; < 2^32. */
static uint64_t measure_box(const box_t *box)
{
    uint64_t s[3];

    for (int k = 0; k < 3; k++) {
        s[k] = (uint64_t)(box->high[k] - box->low[k]) + 1;
    }
    return s[0] * s[1] + s[1] * s[2] + s[2] * s[0];
}

static box_t find_box(const grid_t *grid, const grid_face_t *face)
{
    box_t box;

    grid_box(grid, face, box.low, box.high);
    return box;
}

/* A face's place along an axis: twice its centre, then its index. */
typedef struct {
    uint32_t centre;
    uint32_t face;
} place_t;

static int compare_places(const void *a, const void *b)
{
    const place_t *x = a, *y = b;

    if (x->centre != y->centre) {
        return x->centre < y->centre ? -1 : 1;
    }
    return x->face < y->face ? -1 : 1;
}

static void sort_axis(builder_t *b, int axis)
{
    const uint32_t n = b->grid->face_count;
    place_t *places = cli_alloc(n, sizeof *places);

    for (uint32_t i = 0; i < n; i++) {
        places[i].centre = (uint32_t)b->boxes[i].low[axis] +
                           (uint32_t)b->boxes[i].high[axis];
        places[i].face = i;
    }
    qsort(places, n, sizeof *places, compare_places);
    for (uint32_t i = 0; i < n; i++) {
        b->sorted[axis][i] = places[i].face;
    }
    free(places);
}

/* Faces that fit below a node with this many levels below it; < 2^36. */
static uint64_t count_room(const builder_t *b, unsigned levels)
{
    return (uint64_t)b->leaf_max << levels;
}

/* Try every split of n sorted faces along one axis. */
static void sweep(const builder_t *b, int axis, uint32_t first, uint32_t n,
        uint64_t room_below, split_t *best)
{
    const uint32_t *faces = b->sorted[axis] + first;
    box_t box;

    empty_box(&box);
    for (uint32_t i = 0; i < n; i++) {
        extend_box(&box, b->boxes + faces[i]);
        b->lower_area[i] = measure_box(&box);
    }
    empty_box(&box);
    for (uint32_t i = n - 1; i > 0; i--) {
        const uint32_t upper = n - i;
        split_t split;

        /* area < 2^32, count < 2^16, cost of a triangle < 2^12 */
        extend_box(&box, b->boxes + faces[i]);
        split.cost = b->cost->triangle *
                     (b->lower_area[i - 1] * i + measure_box(&box) * upper);
        split.count = i;
        split.imbalance = i > upper ? i - upper : upper - i;
        split.axis = axis;
        if (i <= room_below && upper <= room_below &&
                (split.cost < best->cost ||
                        (split.cost == best->cost &&
                                split.imbalance < best->imbalance))) {
            *best = split;
        }
    }
}

/* Divide a range by is_upper, both parts in order along every axis. */
static void divide(builder_t *b, uint32_t first, uint32_t n)
{
    for (int k = 0; k < 3; k++) {
        uint32_t *faces = b->sorted[k] + first;
        uint32_t lower = 0, upper = 0;

        for (uint32_t i = 0; i < n; i++) {
            if (b->is_upper[faces[i]]) {
                b->scratch[upper++] = faces[i];
            } else {
                faces[lower++] = faces[i];
            }
        }
        memcpy(faces + lower, b->scratch, upper * sizeof *faces);
    }
}

static void partition(
        builder_t *b, const split_t *split, uint32_t first, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++) {
        b->is_upper[b->sorted[split->axis][first + i]] = i >= split->count;
    }
    divide(b, first, n);
}

static void make_leaf(
        builder_t *b, bvh_node_t *node, uint32_t first, uint32_t n)
{
    node->link = first;
    node->meta = BVH_LEAF + n;
    b->done += n;
    if (b->grid->face_count >= 4096 &&
            (b->done % 256 < n || b->done == b->grid->face_count)) {
        cli_progress("bvh", b->done, b->grid->face_count, b->quiet);
    }
}

/* Set a node's box to that of n sorted faces; returns its measure. */
static uint64_t bound(
        const builder_t *b, bvh_node_t *node, uint32_t first, uint32_t n)
{
    box_t box;

    empty_box(&box);
    for (uint32_t i = 0; i < n; i++) {
        extend_box(&box, b->boxes + b->sorted[0][first + i]);
    }
    memcpy(node->low, box.low, sizeof node->low);
    memcpy(node->high, box.high, sizeof node->high);
    return measure_box(&box);
}

/* Build the subtree of n sorted faces; levels may lie below its root. */
static void build(builder_t *b, bvh_node_t *node, uint32_t first, uint32_t n,
        unsigned levels, unsigned depth)
{
    split_t best = {UINT64_MAX, 0, UINT32_MAX, 0};
    const uint64_t area = bound(b, node, first, n);
    uint32_t pair;

    if (depth > b->bvh->depth) {
        b->bvh->depth = depth;
    }
    for (int k = 0; k < 3 && n > 1 && levels > 0; k++) {
        sweep(b, k, first, n, count_room(b, levels - 1), &best);
    }
    if (n <= b->leaf_max &&
            (best.count == 0 || b->cost->triangle * area * n <=
                                        best.cost + b->cost->pair * area)) {
        make_leaf(b, node, first, n);
        return;
    }
    partition(b, &best, first, n);
    pair = b->bvh->pair_count++;
    node->link = pair;
    node->meta = (uint32_t)best.axis;
    build(b, &b->bvh->pairs[pair][0], first, best.count, levels - 1, depth + 1);
    build(b, &b->bvh->pairs[pair][1], first + best.count, n - best.count,
            levels - 1, depth + 1);
}

/* The axis along which the first child of a pair is the farthest below the
 * second. */
static uint32_t axis_between(const bvh_node_t pair[2])
{
    uint32_t axis = 0;
    int most = INT32_MIN;

    for (uint32_t k = 0; k < 3; k++) {
        const int way = pair[1].low[k] + pair[1].high[k] - pair[0].low[k] -
                        pair[0].high[k];

        if (way > most) {
            most = way;
            axis = k;
        }
    }
    return axis;
}

/* Build what has the parts first to last of a range, below a node. */
static void build_parts(builder_t *b, const bvh_apart_t *apart, uint32_t node,
        unsigned first, unsigned last, uint32_t from, unsigned depth)
{
    bvh_node_t *at = &b->bvh->pairs[node / 2][node % 2];
    const unsigned middle = (first + last) / 2;
    uint32_t count = 0, lower = 0;

    for (uint32_t i = from; i < b->grid->face_count; i++) {
        const unsigned part = apart->part[b->sorted[0][i]];

        count += part <= last;
        lower += part <= middle;
    }
    if (first == last) {
        apart->nodes[first - 1] = node;
        build(b, at, from, count, QL_DEPTH_MAX - depth, depth);
        return;
    }
    (void)bound(b, at, from, count);
    at->link = b->bvh->pair_count++;
    build_parts(b, apart, 2 * at->link, first, middle, from, depth + 1);
    build_parts(b, apart, 2 * at->link + 1, middle + 1, last, from + lower,
            depth + 1);
    at->meta = axis_between(b->bvh->pairs[at->link]);
}

/* Build the root's two children: all faces but those apart, and these. */
static void build_root(builder_t *b, const bvh_apart_t *apart)
{
    const uint32_t n = b->grid->face_count;
    bvh_node_t *root = &b->bvh->root;
    uint32_t from = 0;

    for (unsigned part = 0; part <= apart->count; part++) {
        const uint32_t first = from;

        for (uint32_t i = 0; i < n; i++) {
            b->is_upper[i] = apart->part[i] > part;
            from += apart->part[i] == part;
        }
        divide(b, first, n - first); /* those of part come first */
    }
    from = 0;
    while (apart->part[b->sorted[0][from]] == 0) {
        from++;
    }
    (void)bound(b, root, 0, n);
    root->link = b->bvh->pair_count++;
    build(b, &b->bvh->pairs[0][0], 0, from, QL_DEPTH_MAX - 1, 1);
    build_parts(b, apart, 1, 1, apart->count, from, 1);
    root->meta = axis_between(b->bvh->pairs[0]);
}

void bvh_build(bvh_t *bvh, const grid_t *grid, unsigned leaf_max,
        const bvh_cost_t *cost, bool quiet)
{
    bvh_build_apart(bvh, grid, NULL, leaf_max, cost, quiet);
}

void bvh_build_apart(bvh_t *bvh, const grid_t *grid, const bvh_apart_t *apart,
        unsigned leaf_max, const bvh_cost_t *cost, bool quiet)
{
    const uint32_t n = grid->face_count;
    builder_t b = {0};

    memset(bvh, 0, sizeof *bvh);
    b.grid = grid;
    b.cost = cost;
    b.bvh = bvh;
    b.leaf_max = leaf_max;
    b.quiet = quiet;
    b.boxes = cli_alloc(n, sizeof *b.boxes);
    b.scratch = cli_alloc(n, sizeof *b.scratch);
    b.lower_area = cli_alloc(n, sizeof *b.lower_area);
    b.is_upper = cli_alloc(n, sizeof *b.is_upper);
    bvh->pairs = cli_alloc(n, sizeof *bvh->pairs);
    for (uint32_t i = 0; i < n; i++) {
        b.boxes[i] = find_box(grid, grid->faces + i);
    }
    for (int k = 0; k < 3; k++) {
        b.sorted[k] = cli_alloc(n, sizeof *b.sorted[k]);
        sort_axis(&b, k);
    }
    if (apart != NULL && apart->count > 0) {
        build_root(&b, apart);
    } else {
        build(&b, &bvh->root, 0, n, QL_DEPTH_MAX, 0);
    }
    /* after the last partition all axes agree on who is in which leaf */
    bvh->order = b.sorted[0];
    free(b.sorted[1]);
    free(b.sorted[2]);
    free(b.boxes);
    free(b.scratch);
    free(b.lower_area);
    free(b.is_upper);
}

void bvh_free(bvh_t *bvh)
{
    free(bvh->pairs);
    free(bvh->order);
    memset(bvh, 0, sizeof *bvh);
}
