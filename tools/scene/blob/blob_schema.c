/* blob_schema.c - every struct and table of a blob, described once */
/* SPDX-License-Identifier: MIT */

#include "scene/blob/blob_schema.h"

#include <string.h>

enum {
#define KIND_BYTES(name, bytes) BYTES_##name = bytes,
    BLOB_KIND_LIST(KIND_BYTES)
#undef KIND_BYTES
};

/* ---- the structs ---- */

/* F: type, field, kind, count, and of a dump key, blanks before it (0: it is
 * not shown), what it is. P: a part of the number in the row before: type,
 * field, kind, lowest bit, bits, and the same of a dump. */

#define HEADER(F, P, T)                                                        \
    F(T, magic, X32, 1, NULL, 0, NULL)                                         \
    F(T, version, U16, 1, NULL, 0, NULL)                                       \
    F(T, header_bytes, U16, 1, NULL, 0, NULL)                                  \
    F(T, size_bytes, U32, 1, NULL, 0, NULL)                                    \
    F(T, crc32, X32, 1, NULL, 0, NULL)                                         \
    F(T, features, FEATURES, 1, "features", 1, "a feature")                    \
    F(T, depth, U16, 1, "depth", 1, "the depth")                               \
    F(T, root_meta, U16, 1, "root", 1, "the root's meta")                      \
    F(T, root_link, U16, 1, NULL, 1, "the root's link")                        \
    F(T, radiance_exp, S16, 1, "radiance_exp", 1, "an exponent")               \
    F(T, exposure_q8, S16, 1, "exposure_q8", 1, "the exposure")                \
    F(T, image_width, U16, 1, "image", 1, "the width")                         \
    F(T, image_height, U16, 1, NULL, 1, "the height")                          \
    F(T, unit_m, X32, 1, "unit", 1, "the unit")                                \
    F(T, unit_exp, S16, 1, NULL, 1, "its exponent")                            \
    F(T, auto_direct, U8, 1, "auto", 1, "the strategy")                        \
    F(T, auto_lights, U8, 1, NULL, 1, "the choice of lights")                  \
    F(T, trials, U8, 6, "trials", 1, "a trial")                                \
    F(T, camera, PLACE, 1, NULL, 0, NULL)                                      \
    F(T, vertices, PLACE, 1, NULL, 0, NULL)                                    \
    F(T, triangles, PLACE, 1, NULL, 0, NULL)                                   \
    F(T, pairs, PLACE, 1, NULL, 0, NULL)                                       \
    F(T, materials, PLACE, 1, NULL, 0, NULL)                                   \
    F(T, lights, PLACE, 1, NULL, 0, NULL)

#define PLACE(F, P, T)                                                         \
    F(T, offset, U32, 1, NULL, 0, NULL)                                        \
    F(T, count, U32, 1, NULL, 0, NULL)

#define CAMERA(F, P, T)                                                        \
    F(T, at[0], WIDE, 3, "p", 2, "an origin")                                  \
    F(T, at[1], WIDE, 3, "pr", 1, "an origin")                                 \
    F(T, at[2], WIDE, 3, "pu", 1, "an origin")                                 \
    F(T, towards[0], X32, 3, "d", 2, "a direction")                            \
    F(T, towards[1], X32, 3, "dr", 1, "a direction")                           \
    F(T, towards[2], X32, 3, "du", 1, "a direction")

#define VERTEX(F, P, T) F(T, xyz, U16, 3, "v", 1, "a coordinate")

#define TRIANGLE(F, P, T)                                                      \
    F(T, vertex, U16, 3, "t", 1, "a vertex")                                   \
    F(T, material, U16, 1, NULL, 0, NULL)                                      \
    P(T, material, U16, 14, 2, NULL, 2, "a page")                              \
    P(T, material, U16, 0, 14, NULL, 1, "a material")                          \
    F(T, inv_n, X32, 1, NULL, 2, "inv_n")

#define NODE16(F, P, T)                                                        \
    F(T, centre, U16, 3, "n", 1, "the centre")                                 \
    F(T, half, U16, 3, NULL, 2, "half the size")                               \
    F(T, meta, U16, 1, NULL, 2, "the meta")                                    \
    F(T, link, U16, 1, NULL, 1, "the link")

#define PAIR8(F, P, T)                                                         \
    F(T, base, U16, 3, "p8", 1, "the base")                                    \
    F(T, shift, U8, 1, NULL, 2, "the shift")                                   \
    F(T, meta, U8, 1, NULL, 0, NULL)                                           \
    F(T, centre[0], U8, 3, "n8", 1, "the centre")                              \
    F(T, half[0], U8, 3, NULL, 2, "half the size")                             \
    P(T, meta, U8, 0, 4, NULL, 2, "the meta")                                  \
    F(T, link[0], U16, 1, NULL, 1, "the link")                                 \
    F(T, centre[1], U8, 3, "n8", 1, "the centre")                              \
    F(T, half[1], U8, 3, NULL, 2, "half the size")                             \
    P(T, meta, U8, 4, 4, NULL, 2, "the meta")                                  \
    F(T, link[1], U16, 1, NULL, 1, "the link")

#define MATERIAL(F, P, T)                                                      \
    F(T, albedo, X32, 3, "m", 1, "the albedo")                                 \
    F(T, emission, X32, 3, NULL, 2, "the emission")

#define LIGHT(F, P, T)                                                         \
    F(T, cum, X32, 1, "l", 1, "cum")                                           \
    F(T, weight_m, X32, 1, NULL, 2, "the weight")                              \
    F(T, weight_exp, S16, 1, NULL, 1, "its exponent")                          \
    F(T, triangle, U16, 1, NULL, 2, "a triangle")

#define NORMAL(F, P, T) F(T, xyz, S16, 3, "vn", 1, "a normal")

#define GLOSS(F, P, T)                                                         \
    F(T, specular, X32, 3, "g", 1, "the specular colour")                      \
    F(T, parameter, X32, 1, NULL, 2, "the parameter")                          \
    F(T, chance, X32, 1, NULL, 1, "the chance")                                \
    F(T, kind, U16, 1, NULL, 2, "the kind")                                    \
    F(T, zero, U16, 1, NULL, 0, NULL)

#define SPHERE(F, P, T)                                                        \
    F(T, centre, U32, 3, "s", 1, "the centre")                                 \
    F(T, radius, U32, 1, NULL, 2, "the radius")

#define SKY(F, P, T)                                                           \
    F(T, emission, X32, 3, "sky", 1, "the emission")                           \
    F(T, rotate, X32, 1, NULL, 2, "the rotation")                              \
    F(T, width, U16, 1, NULL, 2, "the width")                                  \
    F(T, height, U16, 1, NULL, 1, "the height")                                \
    F(T, table, U16, 1, NULL, 2, "the table")                                  \
    F(T, zero, U16, 1, NULL, 0, NULL)

#define TEXEL(F, P, T) F(T, rgb9e5, X32, 1, "x", 1, "a texel")

#define DISTRIBUTION(F, P, T)                                                  \
    F(T, first, U32, 1, "table", 1, "the first word")                          \
    F(T, dims, U16, 1, NULL, 2, "the dimensions")                              \
    F(T, count, U16, 3, NULL, 2, "the cells")

#define LENS(F, P, T)                                                          \
    F(T, p[0], WIDE, 3, "pa", 1, "an origin")                                  \
    F(T, p[1], WIDE, 3, "pb", 1, "an origin")                                  \
    F(T, d[0], X32, 3, "da", 1, "a direction")                                 \
    F(T, d[1], X32, 3, "db", 1, "a direction")

#define HULL(F, P, T)                                                          \
    F(T, box[0], U16, 2, "h", 1, "a bound")                                    \
    F(T, box[1], U16, 2, NULL, 2, "a bound")                                   \
    F(T, box[2], U16, 2, NULL, 2, "a bound")                                   \
    F(T, first, U16, 1, NULL, 2, "the first triangle")                         \
    F(T, zero, U16, 1, NULL, 0, NULL)

#define SIDE(F, P, T)                                                          \
    F(T, n, S16, 3, "hs", 1, "the normal")                                     \
    F(T, node, U16, 1, NULL, 2, "the node")                                    \
    F(T, triangle, U16, 1, NULL, 1, "a triangle")

/* ---- their rows ---- */

#define FIELD(type, member, number, n, text, blanks, called)                   \
    {.name = #member,                                                          \
            .offset = offsetof(type, member),                                  \
            .kind = BLOB_##number,                                             \
            .count = n,                                                        \
            .gap = blanks,                                                     \
            .key = text,                                                       \
            .what = called},
#define PART(type, member, number, lowest, n, text, blanks, called)            \
    {.name = #member,                                                          \
            .offset = offsetof(type, member),                                  \
            .kind = BLOB_##number,                                             \
            .count = 1,                                                        \
            .shift = lowest,                                                   \
            .bits = n,                                                         \
            .gap = blanks,                                                     \
            .key = text,                                                       \
            .what = called},

/* Bytes of a field, too many if its row does not say what ql_blob.h does. */
#define FIELD_BYTES(type, field, kind, n, key, gap, what)                      \
    +(sizeof(((type *)0)->field) == (n)*BYTES_##kind ? (n)*BYTES_##kind : 9999)
#define PART_BYTES(type, field, kind, shift, bits, key, gap, what) +0

/* Define the rows of a struct; they must add up to all of it. */
#define ROWS(name, LIST, type)                                                 \
    QL_STATIC_ASSERT(LIST(FIELD_BYTES, PART_BYTES, type) == sizeof(type),      \
            name##_has_a_row_for_each_field);                                  \
    static const blob_field_t name##_rows[] = {LIST(FIELD, PART, type)}

ROWS(header, HEADER, ql_blob_header_t);
ROWS(place, PLACE, ql_blob_table_t);
ROWS(camera, CAMERA, ql_blob_camera_t);
ROWS(vertices, VERTEX, ql_blob_vertex_t);
ROWS(triangles, TRIANGLE, ql_blob_tri_t);
ROWS(pairs16, NODE16, ql_blob_node16_t);
ROWS(pairs8, PAIR8, ql_blob_pair8_t);
ROWS(materials, MATERIAL, ql_blob_material_t);
ROWS(lights, LIGHT, ql_blob_light_t);
ROWS(normals, NORMAL, ql_blob_normal_t);
ROWS(gloss, GLOSS, ql_blob_gloss_t);
ROWS(spheres, SPHERE, ql_blob_sphere_t);
ROWS(sky, SKY, ql_blob_sky_t);
ROWS(texels, TEXEL, ql_blob_texel_t);
ROWS(tables, DISTRIBUTION, ql_blob_distribution_t);
ROWS(lens, LENS, ql_blob_lens_t);
ROWS(hull, HULL, ql_blob_hull_t);
ROWS(sides, SIDE, ql_blob_side_t);

/* A word is no struct, but a number by itself. */
#define WORD_ROW(text, called)                                                 \
    {                                                                          \
        {                                                                      \
            .name = "word", .kind = BLOB_X16, .count = 1, .gap = 1,            \
            .key = text, .what = called                                        \
        }                                                                      \
    }
static const blob_field_t words_rows[] = WORD_ROW("w", "a word");
static const blob_field_t contacts_rows[] = WORD_ROW("c", "marks");
static const blob_field_t ranks_rows[] = WORD_ROW("r", "a rank");

/* ---- the tables ---- */

#define WORDS_MAX ((uint32_t)1 << 28) /* what qlux-scene makes at most */

enum {
#define TABLE_NEEDS(name, type, features) name##_needs = (features),
    BLOB_TABLE_LIST(TABLE_NEEDS)
#undef TABLE_NEEDS
};

#define ENTRY(name, type)                                                      \
    {                                                                          \
        name##_rows, sizeof name##_rows / sizeof *name##_rows, sizeof(type)    \
    }

/* A table: name, struct, and what else there is to say. */
#define TABLE(id, type, ...)                                                   \
    [BLOB_TABLE_##id] = {.name = #id,                                          \
            .entry = ENTRY(id, type),                                          \
            .features = id##_needs,                                            \
            __VA_ARGS__}

const blob_struct_t blob_place = ENTRY(place, ql_blob_table_t);

const blob_table_t blob_header = {.name = "header",
        .entry = ENTRY(header, ql_blob_header_t),
        .repeat = 1,
        .per_line = 1,
        .count_min = 1,
        .count_max = 1};

const blob_table_t blob_tables[BLOB_TABLE_COUNT] = {
        TABLE(camera, ql_blob_camera_t, .repeat = 1, .per_line = 1,
                .count_min = 1, .count_max = 1,
                .title = "camera: s31.32, then s1.30"),
        TABLE(vertices, ql_blob_vertex_t, .repeat = 1, .per_line = 1,
                .count_max = QL_VERTEX_MAX, .title = "vertices: x y z"),
        TABLE(triangles, ql_blob_tri_t, .repeat = 1, .per_line = 1,
                .count_max = QL_TRI_MAX,
                .title = "triangles: corners, page, material, inv_n"),
        TABLE(pairs16, ql_blob_node16_t, .repeat = 2, .per_line = 1,
                .count_max = QL_TRI_MAX,
                .title = "pairs of: centre, half, meta, link"),
        TABLE(pairs8, ql_blob_pair8_t, .repeat = 1, .per_line = 1,
                .count_max = QL_TRI_MAX,
                .title =
                        "pairs: base, shift; two of: centre, half, meta, link"),
        TABLE(materials, ql_blob_material_t, .repeat = 1, .per_line = 1,
                .count_max = QL_MATERIAL_MAX,
                .title = "materials: albedo u1.31, emission u0.32"),
        TABLE(lights, ql_blob_light_t, .repeat = 1, .per_line = 1,
                .count_max = QL_LIGHT_MAX,
                .title = "lights: cum, weight, triangle"),
        TABLE(normals, ql_blob_normal_t, .repeat = 1, .per_line = 1,
                .count_min = 1, .count_max = QL_VERTEX_MAX,
                .title = "normals: x y z, s0.15"),
        TABLE(gloss, ql_blob_gloss_t, .repeat = 1, .per_line = 1,
                .count_min = 1, .count_max = QL_MATERIAL_MAX,
                .title =
                        "gloss: specular u1.31, parameter, chance u1.31, kind"),
        TABLE(spheres, ql_blob_sphere_t, .repeat = 1, .per_line = 1,
                .count_min = 1, .count_max = QL_TRI_MAX,
                .title = "spheres: centre, radius, 1/256 units"),
        TABLE(sky, ql_blob_sky_t, .repeat = 1, .per_line = 1, .count_min = 1,
                .count_max = 1,
                .title = "sky: emission u0.32, rotate, width, height, table"),
        TABLE(texels, ql_blob_texel_t, .repeat = 1, .per_line = 8,
                .count_min = 1, .count_max = WORDS_MAX, .title = "texels"),
        TABLE(tables, ql_blob_distribution_t, .repeat = 1, .per_line = 1,
                .count_min = 1, .count_max = UINT16_MAX,
                .title = "tables: first word, dims, cells"),
        TABLE(words, uint16_t, .repeat = 1, .per_line = 8, .count_min = 1,
                .count_max = WORDS_MAX, .title = "words"),
        TABLE(lens, ql_blob_lens_t, .repeat = 1, .per_line = 1, .count_min = 1,
                .count_max = 1, .title = "lens: likewise"),
        TABLE(contacts, uint16_t, .repeat = 1, .per_line = 8, .count_min = 1,
                .count_max = (QL_TRI_MAX + 15) / 16,
                .title = "contacts: a bit for each triangle"),
        TABLE(ranks, uint16_t, .repeat = 1, .per_line = 8, .count_min = 1,
                .count_max = QL_TRI_MAX,
                .title = "ranks: one for each triangle"),
        TABLE(hull, ql_blob_hull_t, .repeat = 1, .per_line = 1, .count_min = 1,
                .count_max = 1,
                .title = "hull: low and high of x, y, z, first triangle"),
        TABLE(sides, ql_blob_side_t, .repeat = 1, .per_line = 1, .count_min = 1,
                .count_max = QL_TRI_MAX,
                .title = "sides: normal, node, triangle"),
};

bool blob_has_table(const blob_table_t *table, uint32_t features)
{
    return table->features == 0 || (table->features & features) != 0;
}

uint64_t blob_entry_bytes(const blob_table_t *table)
{
    return (uint64_t)table->repeat * table->entry.bytes;
}

/* ---- numbers ---- */

unsigned blob_number_bytes(const blob_field_t *field)
{
    static const uint8_t bytes[] = {
#define NUMBER_BYTES(name, bytes) bytes,
            BLOB_KIND_LIST(NUMBER_BYTES)
#undef NUMBER_BYTES
    };

    return bytes[field->kind];
}

unsigned blob_field_bytes(const blob_field_t *field)
{
    return field->bits == 0 && field->kind != BLOB_PLACE
                   ? field->count * blob_number_bytes(field)
                   : 0;
}

uint64_t blob_get(const blob_field_t *field, const void *from, unsigned i)
{
    const unsigned bytes = blob_number_bytes(field);
    const uint8_t *at = (const uint8_t *)from + field->offset + i * bytes;
    uint32_t pair[2] = {0, 0};
    uint16_t half;
    uint64_t value;

    if (bytes == 1) {
        value = *at;
    } else if (bytes == 2) {
        memcpy(&half, at, sizeof half);
        value = half;
    } else {
        memcpy(pair, at, bytes);
        value = (uint64_t)pair[1] << 32 | pair[0];
    }
    value >>= field->shift;
    return field->bits == 0 ? value : value & ((1u << field->bits) - 1);
}

void blob_set(const blob_field_t *field, void *to, unsigned i, uint64_t value)
{
    const unsigned bytes = blob_number_bytes(field);
    uint8_t *at = (uint8_t *)to + field->offset + i * bytes;
    uint32_t pair[2];
    uint16_t half;

    if (field->bits != 0) {
        blob_field_t whole = *field;
        const uint64_t mask = ((uint64_t)1 << field->bits) - 1;

        whole.shift = whole.bits = 0;
        value = (value & mask) << field->shift |
                (blob_get(&whole, to, i) & ~(mask << field->shift));
    }
    if (bytes == 1) {
        *at = (uint8_t)(value & 0xffu);
    } else if (bytes == 2) {
        half = (uint16_t)(value & 0xffffu);
        memcpy(at, &half, sizeof half);
    } else {
        pair[0] = (uint32_t)(value & 0xffffffffu);
        pair[1] = (uint32_t)(value >> 32);
        memcpy(at, pair, bytes);
    }
}
