/* dump_blob.c - a blob for people: a summary, or all of it as text */
/* SPDX-License-Identifier: MIT */

#include "scene/blob/dump_blob.h"

#include <inttypes.h>

#include "scene/blob/write_blob.h"

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

/* Begin a line before number i of a table that has eight a line. */
static void start_line(FILE *file, const char *key, uint32_t i)
{
    if (i % 8 == 0) {
        fprintf(file, "%s%s", i > 0 ? "\n" : "", key);
    }
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

static void print_gloss(FILE *file, const model_t *model)
{
    uint32_t count[QL_GLOSS_GLASS + 1] = {0};

    for (uint32_t i = 0; i < model->gloss_count; i++) {
        count[model->gloss[i].kind]++; /* checked when opened */
    }
    fprintf(file, "phong-materials: %" PRIu32 "\n", count[QL_GLOSS_PHONG]);
    fprintf(file, "mirror-materials: %" PRIu32 "\n", count[QL_GLOSS_MIRROR]);
    fprintf(file, "glass-materials: %" PRIu32 "\n", count[QL_GLOSS_GLASS]);
}

static void print_sky(FILE *file, const model_t *model)
{
    if (model->sky_count == 0) {
        fputs("sky: none\n", file);
    } else if (model->sky->width == 0) {
        fputs("sky: constant\n", file);
    } else {
        fprintf(file, "sky: %u %u\n", (unsigned)model->sky->width,
                (unsigned)model->sky->height);
    }
    fprintf(file, "tables: %" PRIu32 "\n", model->tables_count);
    fprintf(file, "table-words: %" PRIu32 "\n", model->words_count);
    fprintf(file, "lens: %s\n", model->lens_count > 0 ? "yes" : "no");
}

/* Vertices that have a normal. */
static uint32_t smooth_count(const model_t *model)
{
    uint32_t count = 0;

    for (uint32_t i = 0; i < model->normals_count; i++) {
        const int16_t *n = model->normals[i].xyz;

        count += (n[0] | n[1] | n[2]) != 0;
    }
    return count;
}

static void print_lights(FILE *file, const model_t *model)
{
    uint32_t emissive = 0;

    for (uint32_t m = 0; m < model->material_count; m++) {
        const uint32_t *e = model->materials[m].emission;

        emissive += (e[0] | e[1] | e[2]) != 0;
    }
    fprintf(file, "materials: %" PRIu32 "\n", model->material_count);
    print_gloss(file, model);
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
    fprintf(file, "triangles: %" PRIu32 "\n",
            model->triangle_count - model->spheres_count);
    fprintf(file, "spheres: %" PRIu32 "\n", model->spheres_count);
    fprintf(file, "vertices: %" PRIu32 "\n", model->vertex_count);
    fprintf(file, "smooth-vertices: %" PRIu32 "\n", smooth_count(model));
    fprintf(file, "nodes: %" PRIu32 "\n", 2 * model->pair_count + 1);
    fprintf(file, "leaves: %" PRIu32 "\n", leaf_count(model));
    fprintf(file, "depth: %u\n", (unsigned)h->depth);
    fprintf(file, "node-bits: %u\n", model_node_bits(model));
    print_lights(file, model);
    print_sky(file, model);
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

static void dump_lens(FILE *file, const model_t *model)
{
    const ql_blob_lens_t *lens = model->lens;

    if (model->lens_count > 0) {
        fputs("# lens: likewise\n", file);
        dump_wide(file, "pa", lens->p[0]);
        dump_wide(file, "pb", lens->p[1]);
        dump_triple32(file, "da", lens->d[0]);
        dump_triple32(file, "db", lens->d[1]);
    }
}

static void dump_triangles(FILE *file, const model_t *model)
{
    fprintf(file, "# %" PRIu32 " vertices: x y z\n", model->vertex_count);
    for (uint32_t i = 0; i < model->vertex_count; i++) {
        const uint16_t *v = model->vertices[i].xyz;

        fprintf(file, "v %u %u %u\n", (unsigned)v[0], (unsigned)v[1],
                (unsigned)v[2]);
    }
    if (model->normals_count > 0) {
        fprintf(file, "# %" PRIu32 " normals: x y z, s0.15\n",
                model->normals_count);
    }
    for (uint32_t i = 0; i < model->normals_count; i++) {
        const int16_t *n = model->normals[i].xyz;

        fprintf(file, "vn %d %d %d\n", n[0], n[1], n[2]);
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

static void dump_gloss(FILE *file, const model_t *model)
{
    if (model->gloss_count == 0) {
        return;
    }
    fprintf(file,
            "# %" PRIu32 " gloss: specular u1.31, parameter, chance u1.31,"
            " kind\n",
            model->gloss_count);
    for (uint32_t i = 0; i < model->gloss_count; i++) {
        const ql_blob_gloss_t *g = model->gloss + i;

        fprintf(file,
                "g 0x%08" PRIx32 " 0x%08" PRIx32 " 0x%08" PRIx32
                "  0x%08" PRIx32 " 0x%08" PRIx32 "  %u\n",
                g->specular[0], g->specular[1], g->specular[2], g->parameter,
                g->chance, (unsigned)g->kind);
    }
}

static void dump_spheres(FILE *file, const model_t *model)
{
    if (model->spheres_count == 0) {
        return;
    }
    fprintf(file, "# %" PRIu32 " spheres: centre, radius, 1/256 units\n",
            model->spheres_count);
    for (uint32_t i = 0; i < model->spheres_count; i++) {
        const ql_blob_sphere_t *s = model->spheres + i;

        fprintf(file, "s %" PRIu32 " %" PRIu32 " %" PRIu32 "  %" PRIu32 "\n",
                s->centre[0], s->centre[1], s->centre[2], s->radius);
    }
}

static void dump_sky(FILE *file, const model_t *model)
{
    for (uint32_t i = 0; i < model->sky_count; i++) {
        const ql_blob_sky_t *s = model->sky + i;

        fputs("# sky: emission u0.32, rotate, width, height, table\n", file);
        fprintf(file,
                "sky 0x%08" PRIx32 " 0x%08" PRIx32 " 0x%08" PRIx32
                "  0x%08" PRIx32 "  %u %u  %u\n",
                s->emission[0], s->emission[1], s->emission[2], s->rotate,
                (unsigned)s->width, (unsigned)s->height, (unsigned)s->table);
    }
    if (model->texels_count > 0) {
        fprintf(file, "# %" PRIu32 " texels\n", model->texels_count);
        for (uint32_t i = 0; i < model->texels_count; i++) {
            start_line(file, "x", i);
            fprintf(file, " 0x%08" PRIx32, model->texels[i].rgb9e5);
        }
        fputc('\n', file);
    }
}

static void dump_tables(FILE *file, const model_t *model)
{
    if (model->tables_count == 0) {
        return;
    }
    fprintf(file, "# %" PRIu32 " tables: first word, dims, cells\n",
            model->tables_count);
    for (uint32_t i = 0; i < model->tables_count; i++) {
        const ql_blob_distribution_t *t = model->tables + i;

        fprintf(file, "table %" PRIu32 "  %u  %u %u %u\n", t->first,
                (unsigned)t->dims, (unsigned)t->count[0], (unsigned)t->count[1],
                (unsigned)t->count[2]);
    }
    fprintf(file, "# %" PRIu32 " words\n", model->words_count);
    for (uint32_t i = 0; i < model->words_count; i++) {
        start_line(file, "w", i);
        fprintf(file, " 0x%04x", (unsigned)model->words[i]);
    }
    fputs(model->words_count > 0 ? "\n" : "", file);
}

void dump_blob(FILE *file, const model_t *model)
{
    dump_header(file, model);
    dump_lens(file, model);
    dump_triangles(file, model);
    if (model->nodes16 != NULL) {
        dump_nodes16(file, model);
    } else {
        dump_pairs8(file, model);
    }
    dump_lights(file, model);
    dump_gloss(file, model);
    dump_spheres(file, model);
    dump_sky(file, model);
    dump_tables(file, model);
}
