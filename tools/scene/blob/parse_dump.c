/* parse_dump.c - the text of a dump back to a model */
/* SPDX-License-Identifier: MIT */

#include "scene/blob/parse_dump.h"

#include <stdlib.h>
#include <string.h>

#include "lib/program/alloc.h"
#include "lib/program/cli.h"
#include "scene/blob/dump_blob.h"

#define MORE_MAX (1u << 28) /* entries of a table of a feature */

/* A table being read: entries in use, room for more. */
typedef struct {
    size_t count, capacity;
} table_t;

/* Keys that stand once in a dump: those of the header and the camera, which
 * every dump has, then those of a lens. */
enum {
    SINGLE_COUNT = 17,
    SINGLE_NEEDED = (1 << 13) - 1,
    SINGLE_LENS = 15 << 13
};

typedef struct {
    text_t *text;
    model_t *model;
    table_t vertices, triangles, nodes16, pairs8, materials, lights;
    table_t normals, gloss, spheres, sky, texels, tables, words, lens;
    ql_blob_lens_t lens_read;
    unsigned children; /* n8 lines the last p8 line has had */
    uint32_t seen;     /* bits of single keys */
} parser_t;

bool is_dump(const text_t *text)
{
    const size_t length = strlen(DUMP_FIRST_LINE);

    return strncmp(text->next, DUMP_FIRST_LINE, length) == 0 &&
           strchr("\r\n \t", text->next[length]) != NULL;
}

static uint32_t get32(parser_t *p, const char *what)
{
    return (uint32_t)text_integer(p->text, what, 0, UINT32_MAX);
}

static uint16_t get16(parser_t *p, const char *what)
{
    return (uint16_t)text_integer(p->text, what, 0, UINT16_MAX);
}

static uint8_t get8(parser_t *p, const char *what)
{
    return (uint8_t)text_integer(p->text, what, 0, UINT8_MAX);
}

static int16_t get_signed(parser_t *p, const char *what)
{
    return (int16_t)text_integer(p->text, what, INT16_MIN, INT16_MAX);
}

static void get_triple16(parser_t *p, const char *what, uint16_t values[3])
{
    for (int k = 0; k < 3; k++) {
        values[k] = get16(p, what);
    }
}

static void get_triple32(parser_t *p, const char *what, uint32_t values[3])
{
    for (int k = 0; k < 3; k++) {
        values[k] = get32(p, what);
    }
}

/* Three times 0xHHHHHHHH.LLLLLLLL. */
static void get_wide(parser_t *p, uint32_t words[3][2])
{
    for (int k = 0; k < 3; k++) {
        const char *word = text_word(p->text);

        if (word == NULL || strlen(word) != 19 || word[10] != '.' ||
                strncmp(word, "0x", 2) != 0 ||
                strspn(word + 2, "0123456789abcdef") != 8 ||
                strspn(word + 11, "0123456789abcdef") != 8) {
            text_fail(p->text, "expected a number like 0x00000001.80000000");
        }
        words[k][1] = (uint32_t)strtoul(word + 2, NULL, 16);
        words[k][0] = (uint32_t)strtoul(word + 11, NULL, 16);
    }
}

static void parse_features(parser_t *p)
{
    const char *word;

    while ((word = text_word(p->text)) != NULL) {
        const uint32_t before = p->model->header.features;

#define PARSE_FEATURE(name, bit, text)                                         \
    if (strcmp(word, text) == 0) {                                             \
        p->model->header.features |= (uint32_t)name;                           \
    }
        QL_FEATURE_LIST(PARSE_FEATURE)
#undef PARSE_FEATURE
        if (p->model->header.features == before) {
            text_fail(p->text,
                    "expected names of features, each once, found "
                    "'%s'",
                    word);
        }
    }
}

static void parse_single(parser_t *p, int key)
{
    ql_blob_header_t *h = &p->model->header;
    ql_blob_camera_t *camera = &p->model->camera;
    uint32_t(*const wide[3])[2] = {camera->p, camera->pr, camera->pu};
    uint32_t *const narrow[3] = {camera->d, camera->dr, camera->du};
    ql_blob_lens_t *lens = &p->lens_read;

    switch (key) {
    case 0:
        parse_features(p);
        break;
    case 1:
        h->depth = get16(p, "the depth");
        break;
    case 2:
        h->root_meta = get16(p, "the root's meta");
        h->root_link = get16(p, "the root's link");
        break;
    case 3:
        h->radiance_exp = get_signed(p, "an exponent");
        break;
    case 4:
        h->exposure_q8 = get_signed(p, "the exposure");
        break;
    case 5:
        h->image_width = get16(p, "the width");
        h->image_height = get16(p, "the height");
        break;
    case 6:
        h->unit_m = get32(p, "the unit");
        h->unit_exp = get_signed(p, "its exponent");
        break;
    case 7:
    case 8:
    case 9:
        get_wide(p, wide[key - 7]);
        break;
    case 10:
    case 11:
    case 12:
        get_triple32(p, "a direction", narrow[key - 10]);
        break;
    case 13:
    case 14:
        get_wide(p, lens->p[key - 13]);
        break;
    default:
        get_triple32(p, "a direction", lens->d[key - 15]);
    }
}

/* A line whose key stands once in a dump; false if this is none. */
static bool parse_header_line(parser_t *p, const char *key)
{
    static const char *const keys[] = {"features", "depth", "root",
            "radiance_exp", "exposure_q8", "image", "unit", "p", "pr", "pu",
            "d", "dr", "du", "pa", "pb", "da", "db"};

    for (int i = 0; i < SINGLE_COUNT; i++) {
        if (strcmp(key, keys[i]) == 0) {
            if ((p->seen & 1u << i) != 0) {
                text_fail(p->text, "expected one '%s', found a second", key);
            }
            p->seen |= 1u << i;
            parse_single(p, i);
            return true;
        }
    }
    return false;
}

/* A new entry behind a table's last. */
static void *append(void *entries, table_t *table, size_t size)
{
    entries = alloc_grow(entries, table->count, &table->capacity, size);
    memset((char *)entries + table->count * size, 0, size);
    table->count++;
    return entries;
}

static void parse_vertex(parser_t *p)
{
    model_t *m = p->model;

    m->vertices = append(m->vertices, &p->vertices, sizeof *m->vertices);
    get_triple16(p, "a coordinate", m->vertices[p->vertices.count - 1].xyz);
}

static void parse_triangle(parser_t *p)
{
    model_t *m = p->model;
    ql_blob_tri_t *tri;
    int64_t page;

    m->triangles = append(m->triangles, &p->triangles, sizeof *m->triangles);
    tri = m->triangles + p->triangles.count - 1;
    get_triple16(p, "a vertex", tri->vertex);
    page = text_integer(p->text, "a page", 0, 3);
    tri->material = (uint16_t)(page << 14 | text_integer(p->text, "a material",
                                                    0, QL_MATERIAL_MAX - 1));
    tri->inv_n = get32(p, "inv_n");
}

static void parse_node16(parser_t *p)
{
    model_t *m = p->model;
    ql_blob_node16_t *node;

    m->nodes16 = append(m->nodes16, &p->nodes16, sizeof *m->nodes16);
    node = m->nodes16 + p->nodes16.count - 1;
    get_triple16(p, "the centre", node->centre);
    get_triple16(p, "half the size", node->half);
    node->meta = get16(p, "the meta");
    node->link = get16(p, "the link");
}

static void parse_pair8(parser_t *p)
{
    model_t *m = p->model;

    if (p->pairs8.count > 0 && p->children != 2) {
        text_fail(p->text, "expected two 'n8' after each 'p8'");
    }
    m->pairs8 = append(m->pairs8, &p->pairs8, sizeof *m->pairs8);
    get_triple16(p, "the base", m->pairs8[p->pairs8.count - 1].base);
    m->pairs8[p->pairs8.count - 1].shift = get8(p, "the shift");
    p->children = 0;
}

static void parse_node8(parser_t *p)
{
    ql_blob_pair8_t *pair;
    const unsigned c = p->children;

    if (p->pairs8.count == 0 || c >= 2) {
        text_fail(p->text, "expected a 'p8' before two 'n8', found 'n8'");
    }
    p->children++;
    pair = p->model->pairs8 + p->pairs8.count - 1;
    for (int k = 0; k < 3; k++) {
        pair->centre[c][k] = get8(p, "the centre");
    }
    for (int k = 0; k < 3; k++) {
        pair->half[c][k] = get8(p, "half the size");
    }
    pair->meta = (uint8_t)(pair->meta | text_integer(p->text, "the meta", 0, 15)
                                                << 4 * c);
    pair->link[c] = get16(p, "the link");
}

static void parse_material(parser_t *p)
{
    model_t *m = p->model;
    ql_blob_material_t *material;

    m->materials = append(m->materials, &p->materials, sizeof *m->materials);
    material = m->materials + p->materials.count - 1;
    get_triple32(p, "the albedo", material->albedo);
    get_triple32(p, "the emission", material->emission);
}

static void parse_light(parser_t *p)
{
    model_t *m = p->model;
    ql_blob_light_t *light;

    m->lights = append(m->lights, &p->lights, sizeof *m->lights);
    light = m->lights + p->lights.count - 1;
    light->cum = get32(p, "cum");
    light->weight_m = get32(p, "the weight");
    light->weight_exp = get_signed(p, "its exponent");
    light->triangle = get16(p, "a triangle");
}

/* ---- tables of features ---- */

static void parse_normal(parser_t *p)
{
    model_t *m = p->model;

    m->normals = append(m->normals, &p->normals, sizeof *m->normals);
    for (int k = 0; k < 3; k++) {
        m->normals[p->normals.count - 1].xyz[k] = get_signed(p, "a normal");
    }
}

static void parse_gloss(parser_t *p)
{
    model_t *m = p->model;
    ql_blob_gloss_t *gloss;

    m->gloss = append(m->gloss, &p->gloss, sizeof *m->gloss);
    gloss = m->gloss + p->gloss.count - 1;
    get_triple32(p, "the specular colour", gloss->specular);
    gloss->parameter = get32(p, "the parameter");
    gloss->chance = get32(p, "the chance");
    gloss->kind = get16(p, "the kind");
}

static void parse_sphere(parser_t *p)
{
    model_t *m = p->model;
    ql_blob_sphere_t *sphere;

    m->spheres = append(m->spheres, &p->spheres, sizeof *m->spheres);
    sphere = m->spheres + p->spheres.count - 1;
    get_triple32(p, "the centre", sphere->centre);
    sphere->radius = get32(p, "the radius");
}

static void parse_sky(parser_t *p)
{
    model_t *m = p->model;
    ql_blob_sky_t *sky;

    m->sky = append(m->sky, &p->sky, sizeof *m->sky);
    sky = m->sky + p->sky.count - 1;
    get_triple32(p, "the emission", sky->emission);
    sky->rotate = get32(p, "the rotation");
    sky->width = get16(p, "the width");
    sky->height = get16(p, "the height");
    sky->table = get16(p, "the table");
}

/* As many as the line has, one or more. */
static void parse_texels(parser_t *p)
{
    model_t *m = p->model;

    do {
        m->texels = append(m->texels, &p->texels, sizeof *m->texels);
        m->texels[p->texels.count - 1].rgb9e5 = get32(p, "a texel");
    } while (*p->text->rest != '\0');
}

static void parse_table(parser_t *p)
{
    model_t *m = p->model;
    ql_blob_distribution_t *table;

    m->tables = append(m->tables, &p->tables, sizeof *m->tables);
    table = m->tables + p->tables.count - 1;
    table->first = get32(p, "the first word");
    table->dims = get16(p, "the dimensions");
    get_triple16(p, "the cells", table->count);
}

static void parse_words(parser_t *p)
{
    model_t *m = p->model;

    do {
        m->words = append(m->words, &p->words, sizeof *m->words);
        m->words[p->words.count - 1] = get16(p, "a word");
    } while (*p->text->rest != '\0');
}

static void parse_line(parser_t *p, const char *key)
{
    static const struct {
        const char *key;
        void (*parse)(parser_t *);
    } entries[] = {{"v", parse_vertex}, {"t", parse_triangle},
            {"n", parse_node16}, {"p8", parse_pair8}, {"n8", parse_node8},
            {"m", parse_material}, {"l", parse_light}, {"vn", parse_normal},
            {"g", parse_gloss}, {"s", parse_sphere}, {"sky", parse_sky},
            {"x", parse_texels}, {"table", parse_table}, {"w", parse_words}};

    if (parse_header_line(p, key)) {
        return;
    }
    for (size_t i = 0; i < sizeof entries / sizeof *entries; i++) {
        if (strcmp(key, entries[i].key) == 0) {
            entries[i].parse(p);
            return;
        }
    }
    text_fail(p->text, "expected a key of a dump, found '%s'", key);
}

/* Four lines are the one entry of the table. */
static void finish_lens(parser_t *p)
{
    model_t *m = p->model;

    if ((p->seen & SINGLE_LENS) == 0) {
        return;
    }
    if ((p->seen & SINGLE_LENS) != SINGLE_LENS) {
        text_fail(p->text, "expected pa, pb, da and db or none of them");
    }
    m->lens = append(m->lens, &p->lens, sizeof *m->lens);
    *m->lens = p->lens_read;
}

/* Every table of a feature is there, and no other. */
static void finish_more(parser_t *p)
{
    model_t *m = p->model;
    const uint32_t features = m->header.features;

#define FINISH_MORE(name, type, bits)                                          \
    if ((p->name.count > 0) != ((features & (uint32_t)(bits)) != 0)) {         \
        text_fail(p->text,                                                     \
                "expected " #name " if and only if a feature needs them");     \
    }                                                                          \
    if (p->name.count > MORE_MAX) {                                            \
        text_fail(p->text, "expected at most %u " #name, MORE_MAX);            \
    }                                                                          \
    m->name##_count = (uint32_t)p->name.count;
    QL_BLOB_MORE_LIST(FINISH_MORE)
#undef FINISH_MORE
}

static void finish(parser_t *p)
{
    model_t *m = p->model;
    const bool node8 = (m->header.features & QL_FEATURE_NODE8) != 0;

    if ((p->seen & SINGLE_NEEDED) != SINGLE_NEEDED) {
        text_fail(p->text, "expected features to du, one line each");
    }
    finish_lens(p);
    finish_more(p);
    if ((node8 ? p->nodes16 : p->pairs8).count != 0 ||
            p->nodes16.count % 2 != 0 ||
            (p->pairs8.count > 0 && p->children != 2)) {
        text_fail(p->text, "expected whole pairs of %d-bit nodes only",
                node8 ? 8 : 16);
    }
    /* far above every limit of the format, far below 2^32 bytes */
    if (p->vertices.count > QL_VERTEX_MAX || p->triangles.count > QL_TRI_MAX ||
            p->nodes16.count + p->pairs8.count > 2 * QL_TRI_MAX ||
            p->materials.count > QL_MATERIAL_MAX ||
            p->lights.count > QL_LIGHT_MAX) {
        text_fail(p->text, "expected fewer entries: a table exceeds the limits "
                           "of the format");
    }
    /* the table that says which width it is must exist, even if empty */
    if (!node8 && m->nodes16 == NULL) {
        m->nodes16 = cli_alloc(0, sizeof *m->nodes16);
    } else if (node8 && m->pairs8 == NULL) {
        m->pairs8 = cli_alloc(0, sizeof *m->pairs8);
    }
    m->vertex_count = (uint32_t)p->vertices.count;
    m->triangle_count = (uint32_t)p->triangles.count;
    m->pair_count = (uint32_t)(p->nodes16.count / 2 + p->pairs8.count);
    m->material_count = (uint32_t)p->materials.count;
    m->light_count = (uint32_t)p->lights.count;
}

void parse_dump(model_t *model, text_t *text)
{
    parser_t parser = {0};

    memset(model, 0, sizeof *model);
    parser.text = text;
    parser.model = model;
    (void)text_line(text);
    while (text_line(text)) {
        parse_line(&parser, text_word(text));
        text_finish(text);
    }
    finish(&parser);
}
