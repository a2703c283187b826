/* test_scene_bvh.c - trees and boxes that qlux-scene builds */
/* SPDX-License-Identifier: MIT */

#include <stdlib.h>

#include "lib/program/cli.h"
#include "support/ql_test.h"
#include "scene/mesh/bvh.h"
#include "scene/mesh/nodes.h"

static uint64_t state = 1;

static uint32_t next(uint32_t below)
{
    uint64_t z = (state += 0x9e3779b97f4a7c15u);

    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return (uint32_t)((z ^ z >> 31) % below);
}

static const bvh_cost_t cost = {100, 80};

/* ---- grids to build trees over; no face shares a vertex ---- */

static void grid_open(grid_t *grid, uint32_t faces)
{
    memset(grid, 0, sizeof *grid);
    grid->face_count = faces;
    grid->vertex_count = 3 * faces;
    grid->faces = cli_alloc(faces, sizeof *grid->faces);
    grid->vertices = cli_alloc(3 * (size_t)faces, sizeof *grid->vertices);
    for (uint32_t i = 0; i < 3 * faces; i++) {
        grid->faces[i / 3].vertex[i % 3] = i;
    }
}

/* Triangles of about the given size anywhere in the grid. */
static void fill_random(grid_t *grid, uint32_t size)
{
    for (uint32_t f = 0; f < grid->face_count; f++) {
        for (int k = 0; k < 3; k++) {
            const uint32_t base = GRID_LOW + next(32752 - size);

            for (int i = 0; i < 3; i++) {
                grid->vertices[3 * f + (uint32_t)i][k] =
                        (uint16_t)(base + next(size));
            }
        }
    }
}

/* The same triangle everywhere, moved by step units along x each time. */
static void fill_row(grid_t *grid, uint32_t step)
{
    static const uint16_t corner[3][3] = {{8, 8, 8}, {9, 8, 8}, {8, 9, 8}};

    for (uint32_t v = 0; v < grid->vertex_count; v++) {
        memcpy(grid->vertices[v], corner[v % 3], sizeof corner[0]);
        grid->vertices[v][0] = (uint16_t)(grid->vertices[v][0] + v / 3 * step);
    }
}

/* Sizes that grow as powers of two: the worst case of the heuristic. */
static void fill_chain(grid_t *grid)
{
    for (uint32_t v = 0; v < grid->vertex_count; v++) {
        const unsigned size = v / 3 % 15;

        for (int k = 0; k < 3; k++) {
            grid->vertices[v][k] =
                    (uint16_t)(8 + (1u << size) -
                               ((int)(v % 3) == k ? 1u << size >> 1 : 0));
        }
    }
}

/* ---- what every tree must satisfy ---- */

typedef struct {
    const grid_t *grid;
    const bvh_t *bvh;
    unsigned leaf_max;
    uint32_t *visits; /* per face */
    uint32_t next_face, next_pair;
    uint32_t depth;
} walker_t;

static void check_face(walker_t *w, const bvh_node_t *leaf, uint32_t at)
{
    const uint32_t face = w->bvh->order[at];

    CHECK(face < w->grid->face_count, "order[%u] is %u", at, face);
    w->visits[face]++;
    for (int i = 0; i < 3; i++) {
        const uint16_t *p = w->grid->vertices[w->grid->faces[face].vertex[i]];

        for (int k = 0; k < 3; k++) {
            CHECK(p[k] >= leaf->low[k] && p[k] <= leaf->high[k],
                    "face %u leaves its leaf's box on axis %d", face, k);
        }
    }
}

/* Twice the centre of the box of a face. */
static int centre_of(const grid_t *grid, uint32_t face, uint32_t axis)
{
    int low = INT16_MAX, high = 0;

    for (int i = 0; i < 3; i++) {
        const int p = grid->vertices[grid->faces[face].vertex[i]][axis];

        low = p < low ? p : low;
        high = p > high ? p : high;
    }
    return low + high;
}

/* Faces [first, middle) lie below those of [middle, end) on an axis. */
static void check_sides(const walker_t *w, uint32_t axis, uint32_t first,
        uint32_t middle, uint32_t end)
{
    int most = 0;

    for (uint32_t i = first; i < end; i++) {
        const int centre = centre_of(w->grid, w->bvh->order[i], axis);

        most = i < middle && centre > most ? centre : most;
        CHECK(i < middle || centre >= most,
                "a face of the second child is below one of the first");
    }
}

static void check_node(walker_t *w, const bvh_node_t *node, uint32_t depth)
{
    const uint32_t first = w->next_face;
    const bvh_node_t *pair;
    uint32_t middle = first;

    w->depth = depth > w->depth ? depth : w->depth;
    if (node->meta >= BVH_LEAF) {
        const uint32_t n = node->meta - BVH_LEAF;

        CHECK(n <= w->leaf_max, "a leaf of %u, at most %u", n, w->leaf_max);
        CHECK(n > 0 || w->grid->face_count == 0, "an empty leaf");
        CHECK(node->link == w->next_face, "a leaf begins at %u, not %u",
                node->link, w->next_face);
        for (uint32_t i = 0; i < n; i++) {
            check_face(w, node, w->next_face++);
        }
        return;
    }
    CHECK(node->link == w->next_pair, "pair %u follows %u", node->link,
            w->next_pair);
    w->next_pair++;
    pair = w->bvh->pairs[node->link];
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 3; k++) {
            CHECK(pair[i].low[k] >= node->low[k] &&
                            pair[i].high[k] <= node->high[k],
                    "a child leaves its parent's box on axis %d", k);
        }
        check_node(w, pair + i, depth + 1);
        middle = i == 0 ? w->next_face : middle;
    }
    check_sides(w, node->meta, first, middle, w->next_face);
}

/* Build and check; return the depth. */
static uint32_t check_tree(const grid_t *grid, unsigned leaf_max)
{
    walker_t w = {0};
    bvh_t bvh;

    bvh_build(&bvh, grid, leaf_max, &cost, true);
    w.grid = grid;
    w.bvh = &bvh;
    w.leaf_max = leaf_max;
    w.visits = cli_alloc(grid->face_count, sizeof *w.visits);
    check_node(&w, &bvh.root, 0);
    for (uint32_t f = 0; f < grid->face_count; f++) {
        CHECK(w.visits[f] == 1, "face %u is in %u leaves", f, w.visits[f]);
    }
    CHECK(w.depth == bvh.depth, "depth is %u, said %u", w.depth, bvh.depth);
    CHECK(bvh.depth <= QL_DEPTH_MAX, "depth %u", bvh.depth);
    CHECK(w.next_pair == bvh.pair_count, "%u pairs, said %u", w.next_pair,
            bvh.pair_count);
    free(w.visits);
    bvh_free(&bvh);
    return w.depth;
}

/* ---- the surface area heuristic, by every split there is ---- */

static const grid_t *sah_grid;
static unsigned long sah_nodes;

static int by_centre(const void *a, const void *b, uint32_t axis)
{
    const uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    const int apart =
            centre_of(sah_grid, x, axis) - centre_of(sah_grid, y, axis);

    return apart != 0 ? apart : x < y ? -1 : 1;
}

static int by_x(const void *a, const void *b)
{
    return by_centre(a, b, 0);
}

static int by_y(const void *a, const void *b)
{
    return by_centre(a, b, 1);
}

static int by_z(const void *a, const void *b)
{
    return by_centre(a, b, 2);
}

/* Half the surface of the box of n faces, in cells: a flat one has one. */
static uint64_t area_of(const uint32_t *faces, uint32_t n)
{
    uint64_t size[3];

    for (int k = 0; k < 3; k++) {
        int low = INT16_MAX, high = 0;

        for (uint32_t i = 0; i < 3 * n; i++) {
            const uint32_t v = sah_grid->faces[faces[i / 3]].vertex[i % 3];
            const int p = sah_grid->vertices[v][k];

            low = p < low ? p : low;
            high = p > high ? p : high;
        }
        size[k] = (uint64_t)(high - low) + 1;
    }
    return size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
}

static uint64_t cost_of(const uint32_t *faces, uint32_t lower, uint32_t n)
{
    return cost.triangle *
           (area_of(faces, lower) * lower +
                   area_of(faces + lower, n - lower) * (n - lower));
}

/* The least cost of any split of n faces, less that of the pair. */
static uint64_t least_cost(const uint32_t *faces, uint32_t n)
{
    static int (*const order[3])(const void *, const void *) = {
            by_x, by_y, by_z};
    uint32_t sorted[64];
    uint64_t least = UINT64_MAX;

    memcpy(sorted, faces, n * sizeof *sorted);
    for (int k = 0; k < 3; k++) {
        qsort(sorted, n, sizeof *sorted, order[k]);
        for (uint32_t i = 1; i < n; i++) {
            const uint64_t this = cost_of(sorted, i, n);

            least = this < least ? this : least;
        }
    }
    return least;
}

/* Faces below a node; they follow each other. */
static uint32_t count_below(const bvh_t *bvh, const bvh_node_t *node)
{
    return node->meta >= BVH_LEAF
                   ? node->meta - BVH_LEAF
                   : count_below(bvh, bvh->pairs[node->link]) +
                             count_below(bvh, bvh->pairs[node->link] + 1);
}

static void check_cost(const bvh_t *bvh, const bvh_node_t *node, uint32_t first,
        unsigned leaf_max)
{
    const uint32_t n = count_below(bvh, node);
    const uint32_t *const faces = bvh->order + first;
    const uint64_t area = area_of(faces, n);
    const uint64_t least = n > 1 ? least_cost(faces, n) : UINT64_MAX;
    const bool leaf =
            n == 1 || (n <= leaf_max && cost.triangle * area * n <=
                                                least + cost.pair * area);

    sah_nodes++;
    CHECK(leaf == (node->meta >= BVH_LEAF), "%u faces: %s", n,
            leaf ? "not a leaf" : "a leaf");
    if (node->meta < BVH_LEAF) {
        const bvh_node_t *const pair = bvh->pairs[node->link];
        const uint32_t lower = count_below(bvh, pair);

        CHECK(cost_of(faces, lower, n) == least,
                "%u and %u faces cost %llu, the least is %llu", lower,
                n - lower, (unsigned long long)cost_of(faces, lower, n),
                (unsigned long long)least);
        check_cost(bvh, pair, first, leaf_max);
        check_cost(bvh, pair + 1, first + lower, leaf_max);
    }
}

TEST(every_split_is_the_cheapest_of_all_and_leaves_are_cheaper)
{
    sah_nodes = 0;
    for (uint32_t i = 0; i < 300; i++) {
        const unsigned leaf_max = 1 + i % 13;
        grid_t grid;
        bvh_t bvh;

        grid_open(&grid, 1 + i % 24);
        if (i % 5 == 4) {
            fill_chain(&grid);
        } else if (i % 5 == 3) {
            fill_row(&grid, i % 3); /* flat */
        } else {
            fill_random(&grid, 1u << i % 15);
        }
        sah_grid = &grid;
        bvh_build(&bvh, &grid, leaf_max, &cost, true);
        check_cost(&bvh, &bvh.root, 0, leaf_max);
        bvh_free(&bvh);
        grid_free(&grid);
    }
    NOTE("%lu nodes", sah_nodes);
}

TEST(every_triangle_is_in_one_leaf_and_boxes_contain)
{
    static const uint32_t counts[] = {0, 1, 2, 3, 13, 14, 100, 3000};
    static const uint32_t sizes[] = {1, 30, 32752};

    for (int c = 0; c < 8; c++) {
        for (int s = 0; s < 3; s++) {
            grid_t grid;

            grid_open(&grid, counts[c]);
            fill_random(&grid, sizes[s] == 32752 ? 32751 : sizes[s]);
            for (unsigned leaf = 1; leaf <= QL_LEAF_MAX; leaf += 3) {
                check_tree(&grid, leaf);
            }
            grid_free(&grid);
        }
    }
    NOTE("120 trees");
}

TEST(thousand_identical_triangles_terminate)
{
    uint32_t depth;
    grid_t grid;

    grid_open(&grid, 1000);
    fill_row(&grid, 0);
    depth = check_tree(&grid, 1);
    CHECK(depth == 10, "depth %u, expected a balanced tree's 10", depth);
    (void)check_tree(&grid, 4);
    grid_free(&grid);
}

TEST(collinear_centroids_terminate)
{
    grid_t grid;

    grid_open(&grid, 1000);
    fill_row(&grid, 1);
    (void)check_tree(&grid, 1);
    fill_row(&grid, 32);
    (void)check_tree(&grid, 4);
    grid_free(&grid);
}

TEST(depth_stays_in_bounds_for_a_chain_of_sizes)
{
    uint32_t depth;
    grid_t grid;

    grid_open(&grid, 20000);
    fill_chain(&grid);
    depth = check_tree(&grid, 1);
    NOTE("depth %u", depth);
    grid_free(&grid);
}

TEST(full_size_builds)
{
    uint32_t depth;
    grid_t grid;

    grid_open(&grid, QL_TRI_MAX);
    fill_random(&grid, 300);
    depth = check_tree(&grid, 4);
    NOTE("65535 triangles, depth %u", depth);
    grid_free(&grid);
}

/* ---- boxes as the blob stores them ---- */

/* Twice the surplus of a decoded box over the exact one; fails if it does not
 * contain it or breaks a limit. */
static int check_axis(const bvh_node_t *node, int k, int centre, int half)
{
    CHECK(centre >= 0 && centre <= QL_GRID_MAX && half >= 0 && half <= 16384,
            "centre %d half %d", centre, half);
    CHECK(centre - half <= node->low[k] && centre + half >= node->high[k],
            "%d..%d became %d +- %d", node->low[k], node->high[k], centre,
            half);
    return 2 * half - (node->high[k] - node->low[k]);
}

static void check_pair(const bvh_node_t pair[2])
{
    ql_blob_pair8_t out8;
    ql_blob_node16_t out16;

    nodes_encode8(&out8, pair);
    CHECK(out8.shift <= 8, "shift %d", out8.shift);
    for (int i = 0; i < 2; i++) {
        nodes_encode16(&out16, pair + i);
        CHECK(out16.link == pair[i].link && out16.meta == pair[i].meta,
                "child %d links to %d", i, out16.link);
        CHECK(out8.link[i] == pair[i].link &&
                        ((unsigned)out8.meta >> 4 * i & 15u) == pair[i].meta,
                "child %d links to %d", i, out8.link[i]);
        for (int k = 0; k < 3; k++) {
            const int surplus =
                    check_axis(pair + i, k, out16.centre[k], out16.half[k]);

            CHECK(surplus <= 1, "16-bit box is %d too long", surplus);
            (void)check_axis(pair + i, k,
                    out8.base[k] + (out8.centre[i][k] << out8.shift),
                    out8.half[i][k] << out8.shift);
        }
    }
}

static void set_axis(bvh_node_t *node, int k, unsigned low, unsigned size)
{
    node->low[k] = (uint16_t)low;
    node->high[k] = (uint16_t)(low + size);
}

TEST(encoded_boxes_contain_the_exact_ones_exhaustively_when_small)
{
    unsigned long count = 0;

    for (unsigned a = 0; a < 10; a++) {
        for (unsigned b = 0; b < 10; b++) {
            for (unsigned offset = 0; offset < 20; offset++) {
                bvh_node_t pair[2] = {{{0}, {0}, 3, 1}, {{0}, {0}, 7, 5}};

                for (int k = 0; k < 3; k++) {
                    set_axis(pair, k, 8 + (k == 0 ? 10 : offset), a);
                    set_axis(pair + 1, k, 8 + (k == 0 ? offset : 10), b);
                }
                check_pair(pair);
                count++;
            }
        }
    }
    NOTE("%lu pairs", count);
}

TEST(encoded_boxes_contain_the_exact_ones_at_the_steps_of_the_grid)
{
    unsigned long count = 0;

    for (int e = 0; e <= 8; e++) {
        for (int d = -2; d <= 2; d++) {
            const long reach[] = {(255L << e) + d, (256L << e) + d,
                    (510L << e) + d, 32751 + (d < 0 ? d : 0)};

            for (int i = 0; i < 16; i++) {
                const long a = reach[i / 4], b = reach[i % 4];
                bvh_node_t pair[2] = {{{0}, {0}, 1, 4}, {{0}, {0}, 2, 5}};

                if (a > 32751 || b > 32751) {
                    continue;
                }
                for (int k = 0; k < 3; k++) {
                    set_axis(pair, k, GRID_LOW, (unsigned)a);
                    set_axis(pair + 1, k,
                            k == 1 ? GRID_LOW : (unsigned)(GRID_HIGH - b),
                            (unsigned)b);
                }
                check_pair(pair);
                count++;
            }
        }
    }
    NOTE("%lu pairs", count);
}

TEST(encoded_boxes_contain_random_ones)
{
    for (int i = 0; i < 20000; i++) {
        const unsigned size = 2u << next(15);
        bvh_node_t pair[2] = {{{0}, {0}, 9, 0}, {{0}, {0}, 8, 15}};

        for (int k = 0; k < 6; k++) {
            const unsigned s = next(size < 32752 ? size : 32752);

            set_axis(pair + k / 3, k % 3, GRID_LOW + next(32752 - s), s);
        }
        check_pair(pair);
    }
    NOTE("20000 pairs");
}

int main(int argc, char **argv)
{
    TEST_BEGIN("tools/scene_bvh", argc, argv);
    RUN(every_split_is_the_cheapest_of_all_and_leaves_are_cheaper);
    RUN(every_triangle_is_in_one_leaf_and_boxes_contain);
    RUN(thousand_identical_triangles_terminate);
    RUN(collinear_centroids_terminate);
    RUN(depth_stays_in_bounds_for_a_chain_of_sizes);
    RUN(full_size_builds);
    RUN(encoded_boxes_contain_the_exact_ones_exhaustively_when_small);
    RUN(encoded_boxes_contain_the_exact_ones_at_the_steps_of_the_grid);
    RUN(encoded_boxes_contain_random_ones);
    return TEST_END();
}
