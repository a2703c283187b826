/* compile.c - a scene to everything its blob says, step by step */
/* SPDX-License-Identifier: MIT */

#include "scene/build/compile.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "blob/ql_blob_open.h"
#include "lib/program/cli.h"
#include "scene/blob/write_blob.h"
#include "scene/build/add_table.h"
#include "scene/build/build_camera.h"
#include "scene/build/build_lights.h"
#include "scene/build/build_materials.h"
#include "scene/build/build_sky.h"
#include "scene/choose/choice.h"
#include "scene/report/faint.h"
#include "scene/report/lamp_fronts.h"
#include "scene/report/sight.h"
#include "scene/mesh/gain.h"
#include "scene/mesh/nodes.h"
#include "scene/mesh/smooth.h"
#include "scene/touch/contacts.h"
#include "scene/touch/hull.h"
#include "scene/touch/joints.h"
#include "scene/touch/ranks.h"
#include "scene/world/extent.h"

#define PAGE            65536u /* index of a page's first vertex over page */
#define WIDENS_MANIFOLD 10     /* such a mesh is named */
#define PAGE_VERTICES   65535u /* in use: the last index of a page is not */

/* Costs the tree is built for, in instructions. Measured on the Cornell box and
 * a mesh of 20,492 triangles, counting 35 a box and 80 a triangle: with 16-bit
 * nodes 70 and 100 tie as the fastest and 100 is 9 % smaller; with 8-bit nodes
 * 200 takes 2 % more instructions a path than 100 and 17 % fewer bytes. */
static const bvh_cost_t cost16 = {100, 80};
static const bvh_cost_t cost8 = {200, 80};

/* ---- vertices and triangles ---- */

/* 1/sqrt(square) packed as ql_blob_tri_t documents, rounded to nearest.
 * 1 <= square <= 3 (2^30)^2 < 2^62. */
static uint32_t pack_inverse(uint64_t square)
{
    uint64_t mantissa = 0;
    unsigned e = 0;
    u128_t limit = {0, 0};

    /* smallest e with 1/sqrt(square) >= 2^-e; at most 31 */
    while (square > (uint64_t)1 << 2 * e) {
        e++;
    }
    /* the largest m whose (m - 1/2) is not above 2^(26 + e) / sqrt(square):
     * (2 m - 1)^2 square <= 2^(54 + 2 e), at most 2^116 */
    limit.high = 54 + 2 * e >= 64 ? (uint64_t)1 << (2 * e - 10) : 0;
    limit.low = 54 + 2 * e < 64 ? (uint64_t)1 << (54 + 2 * e) : 0;
    for (int bit = 27; bit >= 0; bit--) {
        const uint64_t m = mantissa | (uint64_t)1 << bit;
        const uint64_t twice = 2 * m - 1;

        if (u128_compare(u128_mul(twice * twice, square), limit) <= 0) {
            mantissa = m;
        }
    }
    if (mantissa >> 27 != 0) { /* rounded up to the next power of two */
        mantissa >>= 1;
        e--;
    }
    return (uint32_t)(mantissa << 5) | e;
}

static uint64_t square(const int64_t n[3])
{
    return (uint64_t)(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
}

/* Where grid vertices went in the page being filled. */
typedef struct {
    uint32_t *place; /* per grid vertex: index in the table */
    uint32_t page;
} pager_t;

static bool is_placed(const pager_t *pager, uint32_t v)
{
    return pager->place[v] != UINT32_MAX &&
           pager->place[v] >> 16 >= pager->page;
}

/* Fill up the page if three new vertices might not fit. */
static void turn_page(pager_t *pager, model_t *model, const grid_face_t *face)
{
    unsigned missing = 0;

    for (int i = 0; i < 3; i++) {
        missing += !is_placed(pager, face->vertex[i]);
    }
    if (model->vertices_count - pager->page * PAGE + missing <= PAGE_VERTICES) {
        return;
    }
    pager->page++;
    while (model->vertices_count < pager->page * PAGE) {
        uint16_t *filler = model->vertices[model->vertices_count++].xyz;

        filler[0] = filler[1] = filler[2] = GRID_LOW;
    }
}

static void place_vertex(model_t *model, const grid_t *grid, uint32_t v)
{
    const uint32_t i = model->vertices_count;

    memcpy(model->vertices[i].xyz, grid->vertices[v],
            sizeof model->vertices->xyz);
    if (model->normals != NULL) {
        memcpy(model->normals[i].xyz, grid->normals[v],
                sizeof model->normals->xyz);
    }
}

static void place_triangle(model_t *model, pager_t *pager, const grid_t *grid,
        const grid_face_t *face)
{
    ql_blob_tri_t *tri = model->triangles + model->triangles_count++;
    int64_t n[3];

    if (face->sphere != 0) { /* the rest is 0 */
        tri->vertex[0] = (uint16_t)(face->sphere - 1);
        return;
    }
    turn_page(pager, model, face);
    tri->material = (uint16_t)(pager->page << 14);
    for (int i = 0; i < 3; i++) {
        const uint32_t v = face->vertex[i];

        if (!is_placed(pager, v)) {
            place_vertex(model, grid, v);
            pager->place[v] = model->vertices_count++;
        }
        tri->vertex[i] = (uint16_t)(pager->place[v] & 0xffffu);
    }
    grid_normal(grid, face, n);
    tri->inv_n = pack_inverse(square(n));
}

static void place_triangles(
        model_t *model, const grid_t *grid, const bvh_t *bvh)
{
    const uint32_t n = grid->face_count;
    pager_t pager = {NULL, 0};

    pager.place = cli_alloc(grid->vertex_count, sizeof *pager.place);
    memset(pager.place, 0xff, grid->vertex_count * sizeof *pager.place);
    /* at most three vertices a triangle and three a turned page are wasted, but
     * for filler that four pages bound */
    model->vertices = cli_alloc(3 * (size_t)n + 16, sizeof *model->vertices);
    if (grid->normals != NULL) {
        model->normals = cli_alloc(3 * (size_t)n + 16, sizeof *model->normals);
    }
    model->triangles = cli_alloc(n, sizeof *model->triangles);
    for (uint32_t i = 0; i < n; i++) {
        place_triangle(model, &pager, grid, grid->faces + bvh->order[i]);
    }
    free(pager.place);
    model->normals_count = grid->normals != NULL ? model->vertices_count : 0;
    model->spheres_count = grid->sphere_count;
    model->spheres = cli_alloc(grid->sphere_count, sizeof *model->spheres);
    if (grid->sphere_count > 0) {
        memcpy(model->spheres, grid->spheres,
                grid->sphere_count * sizeof *model->spheres);
    }
}

/* ---- tree and header ---- */

static void place_nodes(model_t *model, const bvh_t *bvh, unsigned node_bits)
{
    const uint32_t n = bvh->pair_count;

    if (node_bits == 16) {
        model->header.features |= QL_FEATURE_NODE16;
        model->pairs16_count = n;
        model->pairs16 = cli_alloc(n, sizeof *model->pairs16);
        for (uint32_t i = 0; i < 2 * n; i++) {
            nodes_encode16(
                    &model->pairs16[i / 2][i % 2], &bvh->pairs[i / 2][i % 2]);
        }
    } else {
        model->header.features |= QL_FEATURE_NODE8;
        model->pairs8_count = n;
        model->pairs8 = cli_alloc(n, sizeof *model->pairs8);
        for (uint32_t i = 0; i < n; i++) {
            nodes_encode8(model->pairs8 + i, bvh->pairs[i]);
        }
    }
    model->header.depth = (uint16_t)bvh->depth;
    model->header.root_meta = (uint16_t)bvh->root.meta;
    model->header.root_link = (uint16_t)bvh->root.link;
}

/* Mark what touches, if anything does. */
static void place_contacts(model_t *model, const grid_t *grid, const bvh_t *bvh)
{
    model->contacts = contacts_find(grid, bvh);
    model->contacts_count =
            model->contacts != NULL ? (grid->face_count + 15) / 16 : 0;
}

/* Say which counts where surfaces are in one place, if any are. */
static void place_ranks(model_t *model, const grid_t *grid, const bvh_t *bvh)
{
    model->ranks = ranks_find(grid, bvh);
    model->ranks_count = model->ranks != NULL ? grid->face_count : 0;
}

/* Say what has nothing of the scene behind it, if anything has. */
static void place_hull(model_t *model, const bvh_t *bvh, const hull_t *hull)
{
    uint32_t at = 0;

    if (hull == NULL || hull->part == NULL) {
        return;
    }
    model->hull = cli_alloc(1, sizeof *model->hull);
    model->hull_count = 1;
    *model->hull = hull->box;
    model->sides = cli_alloc(hull->side_count, sizeof *model->sides);
    model->sides_count = hull->side_count;
    memcpy(model->sides, hull->sides, hull->side_count * sizeof *model->sides);
    for (uint32_t i = 0; i < hull->side_count; i++) {
        while (hull->part[bvh->order[at]] != i + 1) {
            at++;
        }
        model->sides[i].node = (uint16_t)hull->nodes[i];
        model->sides[i].triangle = (uint16_t)at; /* the side's first */
    }
}

/* Do surfaces emit, not just the sky? */
static bool has_emitters(const model_t *model)
{
    return model->lights_count > 0 && model->lights[0].triangle != QL_LIGHT_SKY;
}

static uint32_t find_gloss_features(const model_t *model)
{
    uint32_t features = 0;

    for (uint32_t i = 0; i < model->gloss_count; i++) {
        const unsigned kind = model->gloss[i].kind;

        features |= kind == QL_GLOSS_PHONG    ? QL_FEATURE_PHONG
                    : kind == QL_GLOSS_MIRROR ? QL_FEATURE_MIRROR
                                              : QL_FEATURE_GLASS;
    }
    return features;
}

static uint32_t find_sky_features(const model_t *model)
{
    if (model->sky_count == 0) {
        return 0;
    }
    return model->sky->width > 0 ? QL_FEATURE_SKY | QL_FEATURE_SKY_MAP
                                 : QL_FEATURE_SKY;
}

/* The features that tables ask for. */
static uint32_t find_features(const model_t *model)
{
    uint32_t features = 0;

    features |= model->lights_count > 0 ? QL_FEATURE_LIGHTS : 0;
    features |= model->vertices_count > 65536 ? QL_FEATURE_PAGES : 0;
    features |= model->normals_count > 0 ? QL_FEATURE_SMOOTH : 0;
    features |= model->spheres_count > 0 ? QL_FEATURE_SPHERES : 0;
    features |= model->tables_count > 0 ? QL_FEATURE_TABLES : 0;
    features |= model->lens_count > 0 ? QL_FEATURE_LENS : 0;
    features |= model->contacts_count > 0 ? QL_FEATURE_CONTACT : 0;
    features |= model->ranks_count > 0 ? QL_FEATURE_ORDER : 0;
    features |= model->hull_count > 0 ? QL_FEATURE_HULL : 0;
    return features | find_gloss_features(model) | find_sky_features(model);
}

static void fill_header(
        model_t *model, const world_t *world, const grid_t *grid)
{
    ql_blob_header_t *h = &model->header;
    uint64_t m = (grid->unit.m >> 32) + (grid->unit.m >> 31 & 1u);
    int e = grid->unit.e + 32;

    if (m >> 32 != 0) {
        m >>= 1;
        e++;
    }
    h->unit_m = (uint32_t)m;
    h->unit_exp = (int16_t)e; /* doubles reach 2^-1074 to 2^1024 */
    h->exposure_q8 = (int16_t)soft_round(soft_from(world->exposure), 8);
    h->image_width = (uint16_t)world->width;
    h->image_height = (uint16_t)world->height;
    h->features |= find_features(model);
    if (world->two_sided && has_emitters(model)) {
        h->features |= QL_FEATURE_TWO_SIDED; /* else nothing has a side */
    }
}

void compile_model(model_t *model, const world_t *world, const grid_t *grid,
        const bvh_t *bvh, const hull_t *hull, unsigned node_bits)
{
    memset(model, 0, sizeof *model);
    model->camera = cli_alloc(1, sizeof *model->camera);
    model->camera_count = 1;
    model->lens = cli_alloc(1, sizeof *model->lens);
    model->lens_count = world->lens.radius > 0;
    build_camera(model->camera, model->lens, world, grid);
    place_triangles(model, grid, bvh);
    build_materials(model, world, grid, bvh);
    for (size_t i = 0; i < world->table_count; i++) {
        add_table(model, world->tables + i, world->path);
    }
    build_sky(model, world);
    build_lights(model, grid, bvh, world->path);
    place_nodes(model, bvh, node_bits);
    place_contacts(model, grid, bvh);
    place_ranks(model, grid, bvh);
    place_hull(model, bvh, hull);
    fill_header(model, world, grid);
    choice_make(model);
}

/* Say what the grid cost, what makes it coarse, and what was there twice, a
 * line each. */
static void report_losses(const grid_t *grid, const world_t *world)
{
    const world_extent_t extent = extent_find(world);

    if (extent.is_mesh && extent.width >= WIDENS_MANIFOLD * extent.without) {
        cli_warn("%s alone makes the scene %.4g wide, which is %.4g without it",
                extent.name, extent.width, extent.without);
    }
    if (grid->flat_count > 0) {
        fprintf(stderr, "qlux-scene: dropped %zu faces without area\n",
                grid->flat_count);
    }
    if (grid->tiny_count > 0) {
        fprintf(stderr,
                "qlux-scene: dropped %zu faces smaller than the grid, %.3g "
                "units wide, because the scene is %.4g wide (%s)\n",
                grid->tiny_count, soft_double(grid->unit), extent.width,
                extent.name);
    }
    if (grid->double_count > 0) {
        fprintf(stderr,
                "qlux-scene: dropped %zu faces that repeat another's corners, "
                "in its order\n",
                grid->double_count);
    }
}

static void report_gain(const grid_t *grid, soft_t gain)
{
    const double off = soft_double(gain) - 1;

    if (off > 0.01) {
        cli_warn("the area of a lamp is off by %.0f %% on the grid: its "
                 "emission makes up for it",
                100 * off);
    }
    if (grid->lost_count > 0) {
        cli_warn("%zu lamps are smaller than the grid: their light is lost",
                grid->lost_count);
    }
}

static void report_darkness(const model_t *model, const world_t *world)
{
    if (model->lights_count == 0) {
        cli_warn("%s: no surface has a Ke and there is no sky: the picture is "
                 "black",
                world->path);
    }
}

/* Say what cannot see anything, by rays of the core. */
static void report_views(const model_t *model, const world_t *world,
        const grid_t *grid, const bvh_t *bvh)
{
    size_t size;
    uint8_t *blob = write_blob(model, &size);
    ql_scene_t scene;

    if (ql_blob_open(&scene, blob, size) == QL_OK) {
        sight_report(&scene, world, grid, bvh);
        lamp_fronts_report(&scene, world, grid);
    }
    free(blob);
}

static void report_joints(size_t count)
{
    if (count > 0) {
        fprintf(stderr,
                "qlux-scene: cut %zu faces at corners of others that lie on "
                "their edges\n",
                count);
    }
}

void compile_scene(
        model_t *model, world_t *world, const compile_options_t *options)
{
    const size_t cuts = joints_split(world);
    bvh_apart_t apart;
    hull_t hull;
    grid_t grid;
    bvh_t bvh;

    if (!options->quiet) {
        report_joints(cuts);
    }
    grid_round(&grid, world);
    report_losses(&grid, world);
    report_gain(&grid, gain_faces(&grid, world));
    smooth_corners(&grid, world);
    hull_find(&hull, &grid);
    apart = hull_apart(&hull);
    bvh_build_apart(&bvh, &grid, &apart, options->leaf_max,
            options->node_bits == 16 ? &cost16 : &cost8, options->quiet);
    compile_model(model, world, &grid, &bvh, &hull, options->node_bits);
    report_darkness(model, world);
    faint_report(model, world, &grid, &bvh);
    report_views(model, world, &grid, &bvh);
    bvh_free(&bvh);
    hull_free(&hull);
    grid_free(&grid);
}
