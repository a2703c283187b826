/* write_blob.c - a model to the bytes of a blob */
/* SPDX-License-Identifier: MIT */

#include "scene/blob/write_blob.h"

#include "lib/program/cli.h"
#include "base/ql_crc.h"

static void put8(uint8_t **at, unsigned value)
{
    *(*at)++ = (uint8_t)value;
}

static void put16(uint8_t **at, unsigned value)
{
    put8(at, value & 0xffu);
    put8(at, value >> 8 & 0xffu);
}

static void put32(uint8_t **at, uint32_t value)
{
    put16(at, value & 0xffffu);
    put16(at, value >> 16);
}

static void put_triple16(uint8_t **at, const uint16_t values[3])
{
    for (int k = 0; k < 3; k++) {
        put16(at, values[k]);
    }
}

static void put_triple32(uint8_t **at, const uint32_t values[3])
{
    for (int k = 0; k < 3; k++) {
        put32(at, values[k]);
    }
}

static void put_wide(uint8_t **at, const uint32_t words[3][2])
{
    for (int k = 0; k < 3; k++) {
        put32(at, words[k][0]);
        put32(at, words[k][1]);
    }
}

static void put_camera(uint8_t **at, const ql_blob_camera_t *camera)
{
    put_wide(at, camera->p);
    put_wide(at, camera->pr);
    put_wide(at, camera->pu);
    put_triple32(at, camera->d);
    put_triple32(at, camera->dr);
    put_triple32(at, camera->du);
}

static void put_triangle(uint8_t **at, const ql_blob_tri_t *tri)
{
    put_triple16(at, tri->vertex);
    put16(at, tri->material);
    put32(at, tri->inv_n);
}

static void put_node16(uint8_t **at, const ql_blob_node16_t *node)
{
    put_triple16(at, node->centre);
    put_triple16(at, node->half);
    put16(at, node->link);
    put16(at, node->meta);
}

static void put_pair8(uint8_t **at, const ql_blob_pair8_t *pair)
{
    put_triple16(at, pair->base);
    put8(at, pair->shift);
    put8(at, pair->meta);
    for (int i = 0; i < 6; i++) {
        put8(at, pair->centre[i / 3][i % 3]);
    }
    for (int i = 0; i < 6; i++) {
        put8(at, pair->half[i / 3][i % 3]);
    }
    put16(at, pair->link[0]);
    put16(at, pair->link[1]);
}

static void put_light(uint8_t **at, const ql_blob_light_t *light)
{
    put32(at, light->cum);
    put32(at, light->weight_m);
    put16(at, (uint16_t)light->weight_exp);
    put16(at, light->triangle);
}

/* ---- one entry of each table of features ---- */

static void put_normals(uint8_t **at, const ql_blob_normal_t *normal)
{
    for (int k = 0; k < 3; k++) {
        put16(at, (uint16_t)normal->xyz[k]);
    }
}

static void put_gloss(uint8_t **at, const ql_blob_gloss_t *gloss)
{
    put_triple32(at, gloss->specular);
    put32(at, gloss->parameter);
    put32(at, gloss->chance);
    put16(at, gloss->kind);
    put16(at, gloss->zero);
}

static void put_spheres(uint8_t **at, const ql_blob_sphere_t *sphere)
{
    put_triple32(at, sphere->centre);
    put32(at, sphere->radius);
}

static void put_sky(uint8_t **at, const ql_blob_sky_t *sky)
{
    put_triple32(at, sky->emission);
    put32(at, sky->rotate);
    put16(at, sky->width);
    put16(at, sky->height);
    put16(at, sky->table);
    put16(at, sky->zero);
}

static void put_texels(uint8_t **at, const ql_blob_texel_t *texel)
{
    put32(at, texel->rgb9e5);
}

static void put_tables(uint8_t **at, const ql_blob_distribution_t *table)
{
    put32(at, table->first);
    put_triple16(at, table->count);
    put16(at, table->dims);
}

static void put_words(uint8_t **at, const uint16_t *word)
{
    put16(at, *word);
}

static void put_lens(uint8_t **at, const ql_blob_lens_t *lens)
{
    put_wide(at, lens->p[0]);
    put_wide(at, lens->p[1]);
    put_triple32(at, lens->d[0]);
    put_triple32(at, lens->d[1]);
}

/* ---- the whole ---- */

/* The header and where the tables of features lie, those that are there. */
typedef struct {
    ql_blob_header_t header;
    ql_blob_table_t more[QL_BLOB_MORE_MAX];
    unsigned more_count;
    uint64_t end; /* bytes laid out so far */
} layout_t;

static void put_table(uint8_t **at, const ql_blob_table_t *table)
{
    put32(at, table->offset);
    put32(at, table->count);
}

static void put_header(uint8_t *at_first, const layout_t *layout)
{
    const ql_blob_header_t *h = &layout->header;
    uint8_t **at = &at_first;

    put32(at, h->magic);
    put16(at, h->version);
    put16(at, h->header_bytes);
    put32(at, h->size_bytes);
    put32(at, h->crc32);
    put32(at, h->features);
    put16(at, h->depth);
    put16(at, h->root_meta);
    put16(at, h->root_link);
    put16(at, (uint16_t)h->radiance_exp);
    put16(at, (uint16_t)h->exposure_q8);
    put16(at, h->image_width);
    put16(at, h->image_height);
    put16(at, (uint16_t)h->unit_exp);
    put32(at, h->unit_m);
    put_table(at, &h->camera);
    put_table(at, &h->vertices);
    put_table(at, &h->triangles);
    put_table(at, &h->pairs);
    put_table(at, &h->materials);
    put_table(at, &h->lights);
    for (unsigned i = 0; i < layout->more_count; i++) {
        put_table(at, layout->more + i);
    }
}

/* Place a table behind the last. Counts are below 2^32 and entries below 2^8
 * bytes, so 14 tables stay below 2^44. */
static ql_blob_table_t place(layout_t *layout, uint32_t count, size_t entry)
{
    ql_blob_table_t table;

    table.offset = (uint32_t)layout->end; /* lay_out() checks the last */
    table.count = count;
    layout->end += ((uint64_t)count * entry + 3) / 4 * 4;
    return table;
}

static void place_more(layout_t *layout, const model_t *model)
{
    const uint32_t features = layout->header.features;
    unsigned i = 0;

#define PLACE_MORE(name, type, bits)                                           \
    if ((features & (uint32_t)(bits)) != 0) {                                  \
        layout->more[i++] = place(layout, model->name##_count, sizeof(type));  \
    }
    QL_BLOB_MORE_LIST(PLACE_MORE)
#undef PLACE_MORE
}

static unsigned count_more(uint32_t features)
{
    unsigned count = 0;

#define COUNT_MORE(name, type, bits)                                           \
    count += (features & (uint32_t)(bits)) != 0;
    QL_BLOB_MORE_LIST(COUNT_MORE)
#undef COUNT_MORE
    return count;
}

static void lay_out(layout_t *layout, const model_t *model)
{
    ql_blob_header_t *h = &layout->header;
    const size_t pair = model_node_bits(model) == 16
                                ? 2 * sizeof(ql_blob_node16_t)
                                : sizeof(ql_blob_pair8_t);

    *h = model->header;
    h->magic = QL_BLOB_MAGIC;
    h->version = QL_BLOB_VERSION;
    layout->more_count = count_more(h->features);
    layout->end = sizeof *h + layout->more_count * sizeof *layout->more;
    h->header_bytes = (uint16_t)layout->end; /* 152 at most */
    h->camera = place(layout, 1, sizeof(ql_blob_camera_t));
    h->vertices = place(layout, model->vertex_count, sizeof(ql_blob_vertex_t));
    h->triangles = place(layout, model->triangle_count, sizeof(ql_blob_tri_t));
    h->pairs = place(layout, model->pair_count, pair);
    h->materials =
            place(layout, model->material_count, sizeof(ql_blob_material_t));
    h->lights = place(layout, model->light_count, sizeof(ql_blob_light_t));
    place_more(layout, model);
    if (layout->end > UINT32_MAX) {
        cli_fail(CLI_INPUT,
                "expected a scene whose blob stays below 2^32 "
                "bytes, found one of %llu",
                (unsigned long long)layout->end);
    }
    h->size_bytes = (uint32_t)layout->end;
    h->crc32 = 0;
}

static void put_more(
        uint8_t *blob, const model_t *model, const layout_t *layout)
{
    const uint32_t features = layout->header.features;
    const ql_blob_table_t *table = layout->more;

#define PUT_MORE(name, type, bits)                                             \
    if ((features & (uint32_t)(bits)) != 0) {                                  \
        uint8_t *at = blob + table++->offset;                                  \
                                                                               \
        for (uint32_t i = 0; i < model->name##_count; i++) {                   \
            put_##name(&at, model->name + i);                                  \
        }                                                                      \
    }
    QL_BLOB_MORE_LIST(PUT_MORE)
#undef PUT_MORE
}

static void put_core(
        uint8_t *blob, const model_t *model, const ql_blob_header_t *h)
{
    uint8_t *at = blob + h->camera.offset;

    put_camera(&at, &model->camera);
    at = blob + h->vertices.offset;
    for (uint32_t i = 0; i < model->vertex_count; i++) {
        put_triple16(&at, model->vertices[i].xyz);
    }
    at = blob + h->triangles.offset;
    for (uint32_t i = 0; i < model->triangle_count; i++) {
        put_triangle(&at, model->triangles + i);
    }
    at = blob + h->pairs.offset;
    for (uint32_t i = 0; i < model->pair_count; i++) {
        if (model->nodes16 != NULL) {
            put_node16(&at, model->nodes16 + 2 * i);
            put_node16(&at, model->nodes16 + 2 * i + 1);
        } else {
            put_pair8(&at, model->pairs8 + i);
        }
    }
    at = blob + h->materials.offset;
    for (uint32_t i = 0; i < model->material_count; i++) {
        put_triple32(&at, model->materials[i].albedo);
        put_triple32(&at, model->materials[i].emission);
    }
    at = blob + h->lights.offset;
    for (uint32_t i = 0; i < model->light_count; i++) {
        put_light(&at, model->lights + i);
    }
}

uint8_t *write_blob(const model_t *model, size_t *size)
{
    layout_t layout;
    uint8_t *blob;

    lay_out(&layout, model);
    *size = layout.header.size_bytes;
    blob = cli_alloc(*size, 1);
    put_core(blob, model, &layout.header);
    put_more(blob, model, &layout);
    put_header(blob, &layout);
    layout.header.crc32 = ql_crc32(
            0, blob + QL_BLOB_CRC_FROM, *size - (size_t)QL_BLOB_CRC_FROM);
    put_header(blob, &layout);
    return blob;
}
