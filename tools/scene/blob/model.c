/* model.c - everything a blob says, in the numbers of this machine */
/* SPDX-License-Identifier: MIT */

#include "scene/blob/model.h"

#include <stdlib.h>
#include <string.h>

#include "scene/build/build_camera.h"
#include "scene/build/build_gloss.h"
#include "scene/build/build_lights.h"
#include "scene/mesh/build_nodes.h"
#include "scene/build/build_sky.h"
#include "scene/build/add_table.h"
#include "lib/program/cli.h"
#include "scene/blob/scene_features.h"

#define PAGE             65536u /* index of a page's first vertex over page */
#define PAGE_VERTICES    65535u /* in use: the last index of a page is not */
#define RADIANCE_EXP_MAX 64

unsigned model_node_bits(const model_t *model)
{
    return (model->header.features & QL_FEATURE_NODE8) != 0 ? 8 : 16;
}

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

static uint64_t square_of(const int64_t n[3])
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
    if (model->vertex_count - pager->page * PAGE + missing <= PAGE_VERTICES) {
        return;
    }
    pager->page++;
    while (model->vertex_count < pager->page * PAGE) {
        uint16_t *filler = model->vertices[model->vertex_count++].xyz;

        filler[0] = filler[1] = filler[2] = GRID_LOW;
    }
}

static void place_vertex(model_t *model, const grid_t *grid, uint32_t v)
{
    const uint32_t i = model->vertex_count;

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
    ql_blob_tri_t *tri = model->triangles + model->triangle_count++;
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
            pager->place[v] = model->vertex_count++;
        }
        tri->vertex[i] = (uint16_t)(pager->place[v] & 0xffffu);
    }
    grid_normal(grid, face, n);
    tri->inv_n = pack_inverse(square_of(n));
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
    model->normals_count = grid->normals != NULL ? model->vertex_count : 0;
    model->spheres_count = grid->sphere_count;
    model->spheres = cli_alloc(grid->sphere_count, sizeof *model->spheres);
    if (grid->sphere_count > 0) {
        memcpy(model->spheres, grid->spheres,
                grid->sphere_count * sizeof *model->spheres);
    }
}

/* ---- materials ---- */

/* Smallest exponent for which every Ke and the sky fit u0.32; 0 without any. */
static int radiance_exponent(const world_t *world, const bool *used)
{
    soft_t most = sky_most(&world->sky);
    int e = -RADIANCE_EXP_MAX;

    for (size_t m = 0; m < world->material_count; m++) {
        for (int k = 0; k < 3 && used[m]; k++) {
            const soft_t ke = soft_from(world->materials[m].ke[k]);

            most = soft_compare(ke, most) > 0 ? ke : most;
        }
    }
    if (most.m == 0) {
        return 0;
    }
    /* Ke 2^(32 - e) <= 2^32 - 1 */
    while (soft_compare(most, soft_int(0xffffffff, e - 32)) > 0) {
        e++;
    }
    return e; /* Ke and sky are at most 1e18 < 2^60 */
}

static void round_emission(uint32_t emission[3],
        const world_material_t *material, int radiance_exp)
{
    for (int k = 0; k < 3; k++) {
        const soft_t ke = soft_from(material->ke[k]);
        const int64_t rounded = soft_round(ke, 32 - radiance_exp);

        /* what shines must not stop to do so; 2^32 cannot be reached */
        emission[k] = rounded == 0 && ke.m != 0 ? 1 : (uint32_t)rounded;
    }
}

/* Add the materials in use that have gloss, or those that have none, in the
 * order of their definition. */
static void place_kind(model_t *model, const world_t *world, const bool *used,
        uint32_t *place, bool glossy)
{
    for (size_t m = 0; m < world->material_count; m++) {
        ql_blob_material_t material;
        ql_blob_gloss_t gloss;

        if (!used[m] || gloss_round(material.albedo, &gloss,
                                world->materials + m) != glossy) {
            continue;
        }
        round_emission(material.emission, world->materials + m,
                model->header.radiance_exp);
        if (glossy) {
            model->gloss[model->gloss_count++] = gloss;
        }
        place[m] = model->material_count;
        model->materials[model->material_count++] = material;
    }
}

/* Keep the materials that a face uses: those with gloss come first. */
static void place_materials(model_t *model, const world_t *world,
        const grid_t *grid, const bvh_t *bvh)
{
    const size_t count = world->material_count;
    bool *used = cli_alloc(count, sizeof *used);
    uint32_t *place = cli_alloc(count, sizeof *place);

    for (uint32_t i = 0; i < grid->face_count; i++) {
        used[grid->faces[i].material] = true;
    }
    model->header.radiance_exp = (int16_t)radiance_exponent(world, used);
    model->materials = cli_alloc(count, sizeof *model->materials);
    model->gloss = cli_alloc(count, sizeof *model->gloss);
    place_kind(model, world, used, place, true);
    place_kind(model, world, used, place, false);
    if (model->material_count > QL_MATERIAL_MAX) {
        cli_fail(CLI_INPUT, "%s: expected %lu materials at most, found %lu",
                world->path, (unsigned long)QL_MATERIAL_MAX,
                (unsigned long)model->material_count);
    }
    for (uint32_t i = 0; i < model->triangle_count; i++) {
        const uint32_t m = place[grid->faces[bvh->order[i]].material];

        model->triangles[i].material =
                (uint16_t)(model->triangles[i].material | m);
    }
    free(place);
    free(used);
}

/* ---- tree and header ---- */

static void place_nodes(model_t *model, const bvh_t *bvh, unsigned node_bits)
{
    const uint32_t n = bvh->pair_count;

    model->pair_count = n;
    if (node_bits == 16) {
        model->nodes16 = cli_alloc(2 * (size_t)n, sizeof *model->nodes16);
        for (uint32_t i = 0; i < 2 * n; i++) {
            nodes_encode16(model->nodes16 + i, &bvh->pairs[i / 2][i % 2]);
        }
    } else {
        model->pairs8 = cli_alloc(n, sizeof *model->pairs8);
        for (uint32_t i = 0; i < n; i++) {
            nodes_encode8(model->pairs8 + i, bvh->pairs[i]);
        }
    }
    model->header.depth = (uint16_t)bvh->depth;
    model->header.root_meta = (uint16_t)bvh->root.meta;
    model->header.root_link = (uint16_t)bvh->root.link;
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
    h->features = world->two_sided ? QL_FEATURE_TWO_SIDED : 0;
    h->features = features_of(model);
}

void model_build(model_t *model, const world_t *world, const grid_t *grid,
        const bvh_t *bvh, unsigned node_bits)
{
    memset(model, 0, sizeof *model);
    model->lens = cli_alloc(1, sizeof *model->lens);
    model->lens_count = world->lens.radius > 0;
    build_camera(&model->camera, model->lens, world, grid);
    place_triangles(model, grid, bvh);
    place_materials(model, world, grid, bvh);
    for (size_t i = 0; i < world->table_count; i++) {
        add_table(model, world->tables + i, world->path);
    }
    build_sky(model, world);
    build_lights(model, grid, bvh, world->path);
    place_nodes(model, bvh, node_bits);
    fill_header(model, world, grid);
}

void model_free(model_t *model)
{
    free(model->vertices);
    free(model->triangles);
    free(model->nodes16);
    free(model->pairs8);
    free(model->materials);
    free(model->lights);
#define FREE_MORE(name, type, bits) free(model->name);
    QL_BLOB_MORE_LIST(FREE_MORE)
#undef FREE_MORE
    memset(model, 0, sizeof *model);
}
