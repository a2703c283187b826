/* write_blob.c - a model to the bytes of a blob */
/* SPDX-License-Identifier: MIT */

#include "write_blob.h"

#include "cli.h"
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

static void put_camera(uint8_t **at, const ql_blob_camera_t *camera)
{
    const uint32_t(*const wide[3])[2] = {camera->p, camera->pr, camera->pu};

    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            put32(at, wide[i][k][0]);
            put32(at, wide[i][k][1]);
        }
    }
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

static void put_table(uint8_t **at, const ql_blob_table_t *table)
{
    put32(at, table->offset);
    put32(at, table->count);
}

static void put_header(uint8_t **at, const ql_blob_header_t *h)
{
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
}

/* Place a table at *offset and move *offset behind it. At most 65,535 entries
 * of 32 bytes or 262,143 of 6 each: sums stay far below 2^32. */
static ql_blob_table_t place(uint32_t *offset, uint32_t count, size_t entry)
{
    ql_blob_table_t table;

    table.offset = *offset;
    table.count = count;
    *offset += (uint32_t)((count * entry + 3) / 4 * 4);
    return table;
}

static ql_blob_header_t lay_out(const model_t *model)
{
    ql_blob_header_t h = model->header;
    uint32_t end = sizeof h;
    const size_t pair = model_node_bits(model) == 16
                                ? 2 * sizeof(ql_blob_node16_t)
                                : sizeof(ql_blob_pair8_t);

    h.magic = QL_BLOB_MAGIC;
    h.version = QL_BLOB_VERSION;
    h.header_bytes = sizeof h;
    h.camera = place(&end, 1, sizeof(ql_blob_camera_t));
    h.vertices = place(&end, model->vertex_count, sizeof(ql_blob_vertex_t));
    h.triangles = place(&end, model->triangle_count, sizeof(ql_blob_tri_t));
    h.pairs = place(&end, model->pair_count, pair);
    h.materials =
            place(&end, model->material_count, sizeof(ql_blob_material_t));
    h.lights = place(&end, model->light_count, sizeof(ql_blob_light_t));
    h.size_bytes = end;
    h.crc32 = 0;
    return h;
}

static void put_tables(
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
    ql_blob_header_t h = lay_out(model);
    uint8_t *const blob = cli_alloc(h.size_bytes, 1);
    uint8_t *at = blob;

    put_tables(blob, model, &h);
    put_header(&at, &h);
    h.crc32 = ql_crc32(0, blob + QL_BLOB_CRC_FROM,
            h.size_bytes - (size_t)QL_BLOB_CRC_FROM);
    at = blob;
    put_header(&at, &h);
    *size = h.size_bytes;
    return blob;
}
