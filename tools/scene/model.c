/* model.c - everything a blob says, in the numbers of this machine */
/* SPDX-License-Identifier: MIT */

#include "model.h"

#include <stdlib.h>
#include <string.h>

#include "build_camera.h"
#include "build_cdf.h"
#include "build_nodes.h"
#include "cli.h"
#include "scene_features.h"

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

static void place_triangle(model_t *model, pager_t *pager, const grid_t *grid,
        const grid_face_t *face)
{
    ql_blob_tri_t *tri = model->triangles + model->triangle_count++;
    int64_t n[3];

    turn_page(pager, model, face);
    for (int i = 0; i < 3; i++) {
        const uint32_t v = face->vertex[i];

        if (!is_placed(pager, v)) {
            pager->place[v] = model->vertex_count;
            memcpy(model->vertices[model->vertex_count++].xyz,
                    grid->vertices[v], sizeof model->vertices->xyz);
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
    model->triangles = cli_alloc(n, sizeof *model->triangles);
    for (uint32_t i = 0; i < n; i++) {
        place_triangle(model, &pager, grid, grid->faces + bvh->order[i]);
        model->triangles[i].material = (uint16_t)(pager.page << 14);
    }
    free(pager.place);
}

/* ---- materials ---- */

/* Smallest exponent for which every Ke fits u0.32; 0 without lights. */
static int radiance_exponent(const world_t *world, const bool *used)
{
    soft_t most = soft_int(0, 0);
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
    return e; /* Ke is at most 1e18 < 2^60 */
}

static void round_material(ql_blob_material_t *out,
        const world_material_t *material, int radiance_exp)
{
    for (int k = 0; k < 3; k++) {
        const soft_t ke = soft_from(material->ke[k]);
        int64_t emission = soft_round(ke, 32 - radiance_exp);

        /* what shines must not stop to do so; 2^32 cannot be reached */
        emission = emission == 0 && ke.m != 0 ? 1 : emission;
        out->albedo[k] = (uint32_t)soft_round(soft_from(material->kd[k]), 31);
        out->emission[k] = (uint32_t)emission;
    }
}

/* Keep the materials that a triangle uses, in the order of their definition. */
static void place_materials(model_t *model, const world_t *world,
        const grid_t *grid, const bvh_t *bvh)
{
    bool *used = cli_alloc(world->material_count, sizeof *used);
    uint32_t *place = cli_alloc(world->material_count, sizeof *place);
    int e;

    for (uint32_t i = 0; i < grid->face_count; i++) {
        used[grid->faces[i].material] = true;
    }
    e = radiance_exponent(world, used);
    model->header.radiance_exp = (int16_t)e;
    model->materials =
            cli_alloc(world->material_count, sizeof *model->materials);
    for (size_t m = 0; m < world->material_count; m++) {
        place[m] = model->material_count;
        if (used[m]) {
            round_material(model->materials + model->material_count++,
                    world->materials + m, e);
        }
    }
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

/* ---- lights ---- */

/* Radiance units of all channels of a triangle's material; < 2^34. */
static uint64_t emission_of(const model_t *model, uint32_t tri)
{
    const ql_blob_material_t *material =
            model->materials + (model->triangles[tri].material & 0x3fffu);

    return (uint64_t)material->emission[0] + material->emission[1] +
           material->emission[2];
}

/* Twice the area with 32 fraction bits, below 2^63, times the emission. */
static u128_t power_of(
        const grid_t *grid, const grid_face_t *face, uint64_t emission)
{
    u128_t square = {0, 0};
    int64_t n[3];

    grid_normal(grid, face, n);
    square.high = square_of(n);
    return u128_mul(u128_sqrt(square), emission);
}

static void place_lights(model_t *model, const grid_t *grid, const bvh_t *bvh)
{
    u128_t *power = cli_alloc(model->triangle_count, sizeof *power);
    uint64_t *shares = cli_alloc(model->triangle_count, sizeof *shares);
    uint64_t sum = 0;

    model->lights = cli_alloc(model->triangle_count, sizeof *model->lights);
    for (uint32_t i = 0; i < model->triangle_count; i++) {
        const uint64_t emission = emission_of(model, i);

        if (emission > 0) {
            power[model->light_count] =
                    power_of(grid, grid->faces + bvh->order[i], emission);
            model->lights[model->light_count++].triangle = (uint16_t)i;
        }
    }
    if (model->light_count > 0) {
        cdf_shares(shares, power, model->light_count);
    }
    for (uint32_t i = 0; i < model->light_count; i++) {
        ql_blob_light_t *light = model->lights + i;

        light->cum = (uint32_t)sum;
        sum += shares[i];
        cdf_weight(shares[i], &light->weight_m, &light->weight_exp);
    }
    free(shares);
    free(power);
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
    build_camera(&model->camera, world, grid);
    place_triangles(model, grid, bvh);
    place_materials(model, world, grid, bvh);
    place_lights(model, grid, bvh);
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
    memset(model, 0, sizeof *model);
}
