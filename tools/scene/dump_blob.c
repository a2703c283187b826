/* dump_blob.c - a blob for people: a summary, or all of it as text */
/* SPDX-License-Identifier: MIT */

#include "dump_blob.h"

#include <inttypes.h>

#include "write_blob.h"

#include <stdlib.h>

static void print_features(FILE *file, uint32_t features)
{
#define PRINT_FEATURE(name, bit, text)                                         \
    if ((features & (uint32_t)name) != 0) {                                    \
        fprintf(file, " %s", text);                                            \
    }
    QL_FEATURE_LIST(PRINT_FEATURE)
#undef PRINT_FEATURE
    fputc('\n', file);
}

/* ---- --info ---- */

/* Leaves of the tree: a binary tree has one more than inner nodes. */
static uint32_t leaf_count(const model_t *model)
{
    return model->triangle_count > 0 ? model->pair_count + 1 : 0;
}

static void print_sizes(FILE *file, const model_t *model)
{
    size_t size;

    free(write_blob(model, &size));
    fprintf(file, "bytes: %zu\n", size);
    if (model->triangle_count > 0) {
        const unsigned long hundredths =
                (unsigned long)((size * 100 + model->triangle_count / 2) /
                                model->triangle_count);

        fprintf(file, "bytes-per-triangle: %lu.%02lu\n", hundredths / 100,
                hundredths % 100);
    }
}

static void print_lights(FILE *file, const model_t *model)
{
    uint32_t emissive = 0;

    for (uint32_t m = 0; m < model->material_count; m++) {
        const uint32_t *e = model->materials[m].emission;

        emissive += (e[0] | e[1] | e[2]) != 0;
    }
    fprintf(file, "materials: %" PRIu32 "\n", model->material_count);
    fprintf(file, "emissive-materials: %" PRIu32 "\n", emissive);
    fprintf(file, "lights: %" PRIu32 "\n", model->light_count);
    fprintf(file, "radiance-unit: 2^%d\n", model->header.radiance_exp);
}

void print_info(FILE *file, const model_t *model)
{
    const ql_blob_header_t *h = &model->header;
    const soft_t unit = soft_int(h->unit_m, h->unit_exp);
    const soft_t half = soft_int(h->unit_m, h->unit_exp - 1);

    fprintf(file, "version: %u\n", (unsigned)h->version);
    fprintf(file, "triangles: %" PRIu32 "\n", model->triangle_count);
    fprintf(file, "vertices: %" PRIu32 "\n", model->vertex_count);
    fprintf(file, "nodes: %" PRIu32 "\n", 2 * model->pair_count + 1);
    fprintf(file, "leaves: %" PRIu32 "\n", leaf_count(model));
    fprintf(file, "depth: %u\n", (unsigned)h->depth);
    fprintf(file, "node-bits: %u\n", model_node_bits(model));
    print_lights(file, model);
    fputs("features:", file);
    print_features(file, h->features);
    fprintf(file, "image: %u %u\n", (unsigned)h->image_width,
            (unsigned)h->image_height);
    fprintf(file, "exposure: %.8g\n", h->exposure_q8 / 256.0);
    fprintf(file, "unit: %.9g\n", soft_double(unit));
    fprintf(file, "rounding: %.3g\n", soft_double(half));
    print_sizes(file, model);
    fprintf(file, "crc32: %08" PRIx32 "\n", h->crc32);
}

/* ---- --dump ---- */

static void dump_wide(FILE *file, const char *key, const uint32_t words[3][2])
{
    fputs(key, file);
    for (int k = 0; k < 3; k++) {
        fprintf(file, " 0x%08" PRIx32 ".%08" PRIx32, words[k][1], words[k][0]);
    }
    fputc('\n', file);
}

static void dump_triple32(FILE *file, const char *key, const uint32_t words[3])
{
    fprintf(file, "%s 0x%08" PRIx32 " 0x%08" PRIx32 " 0x%08" PRIx32 "\n", key,
            words[0], words[1], words[2]);
}

static void dump_header(FILE *file, const model_t *model)
{
    const ql_blob_header_t *h = &model->header;

    fprintf(file, "%s\n", DUMP_FIRST_LINE);
    fputs("features", file);
    print_features(file, h->features);
    fprintf(file, "depth %u\n", (unsigned)h->depth);
    fprintf(file, "root %u %u\n", (unsigned)h->root_meta,
            (unsigned)h->root_link);
    fprintf(file, "radiance_exp %d\n", h->radiance_exp);
    fprintf(file, "exposure_q8 %d\n", h->exposure_q8);
    fprintf(file, "image %u %u\n", (unsigned)h->image_width,
            (unsigned)h->image_height);
    fprintf(file, "unit 0x%08" PRIx32 " %d\n", h->unit_m, h->unit_exp);
    fputs("# camera: s31.32, then s1.30\n", file);
    dump_wide(file, "p ", model->camera.p);
    dump_wide(file, "pr", model->camera.pr);
    dump_wide(file, "pu", model->camera.pu);
    dump_triple32(file, "d ", model->camera.d);
    dump_triple32(file, "dr", model->camera.dr);
    dump_triple32(file, "du", model->camera.du);
}

static void dump_triangles(FILE *file, const model_t *model)
{
    fprintf(file, "# %" PRIu32 " vertices: x y z\n", model->vertex_count);
    for (uint32_t i = 0; i < model->vertex_count; i++) {
        const uint16_t *v = model->vertices[i].xyz;

        fprintf(file, "v %u %u %u\n", (unsigned)v[0], (unsigned)v[1],
                (unsigned)v[2]);
    }
    fprintf(file, "# %" PRIu32 " triangles: corners, page, material, inv_n\n",
            model->triangle_count);
    for (uint32_t i = 0; i < model->triangle_count; i++) {
        const ql_blob_tri_t *t = model->triangles + i;

        fprintf(file, "t %u %u %u  %u %u  0x%08" PRIx32 "\n",
                (unsigned)t->vertex[0], (unsigned)t->vertex[1],
                (unsigned)t->vertex[2], (unsigned)t->material >> 14,
                (unsigned)t->material & 0x3fffu, t->inv_n);
    }
}

static void dump_nodes16(FILE *file, const model_t *model)
{
    fprintf(file, "# %" PRIu32 " pairs of: centre, half, meta, link\n",
            model->pair_count);
    for (uint32_t i = 0; i < 2 * model->pair_count; i++) {
        const ql_blob_node16_t *n = model->nodes16 + i;

        fprintf(file, "n %u %u %u  %u %u %u  %u %u\n", (unsigned)n->centre[0],
                (unsigned)n->centre[1], (unsigned)n->centre[2],
                (unsigned)n->half[0], (unsigned)n->half[1],
                (unsigned)n->half[2], (unsigned)n->meta, (unsigned)n->link);
    }
}

static void dump_pairs8(FILE *file, const model_t *model)
{
    fprintf(file,
            "# %" PRIu32 " pairs: base, shift;"
            " two of: centre, half, meta, link\n",
            model->pair_count);
    for (uint32_t i = 0; i < model->pair_count; i++) {
        const ql_blob_pair8_t *p = model->pairs8 + i;

        fprintf(file, "p8 %u %u %u  %u\n", (unsigned)p->base[0],
                (unsigned)p->base[1], (unsigned)p->base[2], (unsigned)p->shift);
        for (int c = 0; c < 2; c++) {
            fprintf(file, "n8 %u %u %u  %u %u %u  %u %u\n",
                    (unsigned)p->centre[c][0], (unsigned)p->centre[c][1],
                    (unsigned)p->centre[c][2], (unsigned)p->half[c][0],
                    (unsigned)p->half[c][1], (unsigned)p->half[c][2],
                    (unsigned)p->meta >> 4 * c & 15u, (unsigned)p->link[c]);
        }
    }
}

static void dump_lights(FILE *file, const model_t *model)
{
    fprintf(file, "# %" PRIu32 " materials: albedo u1.31, emission u0.32\n",
            model->material_count);
    for (uint32_t i = 0; i < model->material_count; i++) {
        const ql_blob_material_t *m = model->materials + i;

        fprintf(file,
                "m 0x%08" PRIx32 " 0x%08" PRIx32 " 0x%08" PRIx32
                "  0x%08" PRIx32 " 0x%08" PRIx32 " 0x%08" PRIx32 "\n",
                m->albedo[0], m->albedo[1], m->albedo[2], m->emission[0],
                m->emission[1], m->emission[2]);
    }
    fprintf(file, "# %" PRIu32 " lights: cum, weight, triangle\n",
            model->light_count);
    for (uint32_t i = 0; i < model->light_count; i++) {
        const ql_blob_light_t *l = model->lights + i;

        fprintf(file, "l 0x%08" PRIx32 "  0x%08" PRIx32 " %d  %u\n", l->cum,
                l->weight_m, l->weight_exp, (unsigned)l->triangle);
    }
}

void dump_blob(FILE *file, const model_t *model)
{
    dump_header(file, model);
    dump_triangles(file, model);
    if (model->nodes16 != NULL) {
        dump_nodes16(file, model);
    } else {
        dump_pairs8(file, model);
    }
    dump_lights(file, model);
}
