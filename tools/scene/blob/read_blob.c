/* read_blob.c - the bytes of a blob to a model */
/* SPDX-License-Identifier: MIT */

#include "scene/blob/read_blob.h"

#include <stdlib.h>
#include <string.h>

#include "blob/ql_blob_open.h"
#include "lib/program/cli.h"
#include "scene/blob/write_blob.h"

typedef struct {
    const uint8_t *at;
} reader_t;

static uint8_t get8(reader_t *r)
{
    return *r->at++;
}

static uint16_t get16(reader_t *r)
{
    const unsigned low = get8(r);

    return (uint16_t)(low | (unsigned)get8(r) << 8);
}

static uint32_t get32(reader_t *r)
{
    const uint32_t low = get16(r);

    return low | (uint32_t)get16(r) << 16;
}

static void get_triple16(reader_t *r, uint16_t values[3])
{
    for (int k = 0; k < 3; k++) {
        values[k] = get16(r);
    }
}

static void get_triple32(reader_t *r, uint32_t values[3])
{
    for (int k = 0; k < 3; k++) {
        values[k] = get32(r);
    }
}

static void get_wide(reader_t *r, uint32_t words[3][2])
{
    for (int k = 0; k < 3; k++) {
        words[k][0] = get32(r);
        words[k][1] = get32(r);
    }
}

static int16_t to_signed(uint16_t bits)
{
    return (int16_t)(bits < 0x8000 ? bits : (int)bits - 0x10000);
}

static void get_table(reader_t *r, ql_blob_table_t *table)
{
    table->offset = get32(r);
    table->count = get32(r);
}

static void get_header(reader_t *r, ql_blob_header_t *h)
{
    h->magic = get32(r);
    h->version = get16(r);
    h->header_bytes = get16(r);
    h->size_bytes = get32(r);
    h->crc32 = get32(r);
    h->features = get32(r);
    h->depth = get16(r);
    h->root_meta = get16(r);
    h->root_link = get16(r);
    h->radiance_exp = to_signed(get16(r));
    h->exposure_q8 = to_signed(get16(r));
    h->image_width = get16(r);
    h->image_height = get16(r);
    h->unit_exp = to_signed(get16(r));
    h->unit_m = get32(r);
    get_table(r, &h->camera);
    get_table(r, &h->vertices);
    get_table(r, &h->triangles);
    get_table(r, &h->pairs);
    get_table(r, &h->materials);
    get_table(r, &h->lights);
}

static void get_camera(reader_t *r, ql_blob_camera_t *camera)
{
    get_wide(r, camera->p);
    get_wide(r, camera->pr);
    get_wide(r, camera->pu);
    get_triple32(r, camera->d);
    get_triple32(r, camera->dr);
    get_triple32(r, camera->du);
}

static void get_node16(reader_t *r, ql_blob_node16_t *node)
{
    get_triple16(r, node->centre);
    get_triple16(r, node->half);
    node->link = get16(r);
    node->meta = get16(r);
}

static void get_pair8(reader_t *r, ql_blob_pair8_t *pair)
{
    get_triple16(r, pair->base);
    pair->shift = get8(r);
    pair->meta = get8(r);
    for (int i = 0; i < 6; i++) {
        pair->centre[i / 3][i % 3] = get8(r);
    }
    for (int i = 0; i < 6; i++) {
        pair->half[i / 3][i % 3] = get8(r);
    }
    pair->link[0] = get16(r);
    pair->link[1] = get16(r);
}

/* ---- one entry of each table of features ---- */

static void get_normals(reader_t *r, ql_blob_normal_t *normal)
{
    for (int k = 0; k < 3; k++) {
        normal->xyz[k] = to_signed(get16(r));
    }
}

static void get_gloss(reader_t *r, ql_blob_gloss_t *gloss)
{
    get_triple32(r, gloss->specular);
    gloss->parameter = get32(r);
    gloss->chance = get32(r);
    gloss->kind = get16(r);
    gloss->zero = get16(r);
}

static void get_spheres(reader_t *r, ql_blob_sphere_t *sphere)
{
    get_triple32(r, sphere->centre);
    sphere->radius = get32(r);
}

static void get_sky(reader_t *r, ql_blob_sky_t *sky)
{
    get_triple32(r, sky->emission);
    sky->rotate = get32(r);
    sky->width = get16(r);
    sky->height = get16(r);
    sky->table = get16(r);
    sky->zero = get16(r);
}

static void get_texels(reader_t *r, ql_blob_texel_t *texel)
{
    texel->rgb9e5 = get32(r);
}

static void get_tables(reader_t *r, ql_blob_distribution_t *table)
{
    table->first = get32(r);
    get_triple16(r, table->count);
    table->dims = get16(r);
}

static void get_words(reader_t *r, uint16_t *word)
{
    *word = get16(r);
}

static void get_lens(reader_t *r, ql_blob_lens_t *lens)
{
    get_wide(r, lens->p[0]);
    get_wide(r, lens->p[1]);
    get_triple32(r, lens->d[0]);
    get_triple32(r, lens->d[1]);
}

/* ---- the whole ---- */

static void get_more(model_t *model, const uint8_t *blob)
{
    const uint32_t features = model->header.features;
    reader_t tables, r;

    tables.at = blob + sizeof model->header;
#define GET_MORE(name, type, bits)                                             \
    if ((features & (uint32_t)(bits)) != 0) {                                  \
        ql_blob_table_t table;                                                 \
                                                                               \
        get_table(&tables, &table);                                            \
        r.at = blob + table.offset;                                            \
        model->name##_count = table.count;                                     \
        model->name = cli_alloc(table.count, sizeof(type));                    \
        for (uint32_t i = 0; i < table.count; i++) {                           \
            get_##name(&r, model->name + i);                                   \
        }                                                                      \
    }
    QL_BLOB_MORE_LIST(GET_MORE)
#undef GET_MORE
}

static void get_surface_tables(model_t *model, const uint8_t *blob)
{
    const ql_blob_header_t *h = &model->header;
    reader_t r;

    r.at = blob + h->camera.offset;
    get_camera(&r, &model->camera);
    model->vertex_count = h->vertices.count;
    model->vertices = cli_alloc(h->vertices.count, sizeof *model->vertices);
    r.at = blob + h->vertices.offset;
    for (uint32_t i = 0; i < model->vertex_count; i++) {
        get_triple16(&r, model->vertices[i].xyz);
    }
    model->triangle_count = h->triangles.count;
    model->triangles = cli_alloc(h->triangles.count, sizeof *model->triangles);
    r.at = blob + h->triangles.offset;
    for (uint32_t i = 0; i < model->triangle_count; i++) {
        get_triple16(&r, model->triangles[i].vertex);
        model->triangles[i].material = get16(&r);
        model->triangles[i].inv_n = get32(&r);
    }
}

static void get_pairs(model_t *model, const uint8_t *blob)
{
    const uint32_t n = model->header.pairs.count;
    reader_t r;

    model->pair_count = n;
    r.at = blob + model->header.pairs.offset;
    if (model_node_bits(model) == 16) {
        model->nodes16 = cli_alloc(2 * (size_t)n, sizeof *model->nodes16);
        for (uint32_t i = 0; i < 2 * n; i++) {
            get_node16(&r, model->nodes16 + i);
        }
    } else {
        model->pairs8 = cli_alloc(n, sizeof *model->pairs8);
        for (uint32_t i = 0; i < n; i++) {
            get_pair8(&r, model->pairs8 + i);
        }
    }
}

static void get_light_tables(model_t *model, const uint8_t *blob)
{
    const ql_blob_header_t *h = &model->header;
    reader_t r;

    model->material_count = h->materials.count;
    model->materials = cli_alloc(h->materials.count, sizeof *model->materials);
    r.at = blob + h->materials.offset;
    for (uint32_t i = 0; i < model->material_count; i++) {
        get_triple32(&r, model->materials[i].albedo);
        get_triple32(&r, model->materials[i].emission);
    }
    model->light_count = h->lights.count;
    model->lights = cli_alloc(h->lights.count, sizeof *model->lights);
    r.at = blob + h->lights.offset;
    for (uint32_t i = 0; i < model->light_count; i++) {
        model->lights[i].cum = get32(&r);
        model->lights[i].weight_m = get32(&r);
        model->lights[i].weight_exp = to_signed(get16(&r));
        model->lights[i].triangle = get16(&r);
    }
}

void check_blob(const void *blob, size_t size, const char *path)
{
    ql_scene_t scene;
    const ql_status_t status = ql_blob_open(&scene, blob, size);

    if (status != QL_OK) {
        cli_fail(CLI_INPUT, "%s: %s", path, ql_status_text(status));
    }
}

void read_blob(model_t *model, const char *path)
{
    size_t size, written;
    uint8_t *blob = cli_read(path, &size);
    uint8_t *again;
    reader_t r;

    check_blob(blob, size, path);
    memset(model, 0, sizeof *model);
    r.at = blob;
    get_header(&r, &model->header);
    get_surface_tables(model, blob);
    get_pairs(model, blob);
    get_light_tables(model, blob);
    get_more(model, blob);
    /* a dump says nothing of where tables lie, so it must go without saying */
    again = write_blob(model, &written);
    if (written != size || memcmp(again, blob, size) != 0) {
        cli_fail(CLI_INPUT,
                "%s: expected the tables in the order and at the "
                "offsets qlux-scene gives them",
                path);
    }
    free(again);
    free(blob);
}
