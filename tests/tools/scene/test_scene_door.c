/* test_scene_door.c - each rule of each field of a blob, broken by itself */
/* SPDX-License-Identifier: MIT */

/* The core checks a blob once, at the door. One list has what is legal of each
 * field of the schema: the last legal value and the first one that is not. With
 * the CRC mended the one opens; the other, with which nothing else is wrong,
 * is refused with the status of its rule. A field that is not listed fails. */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/ql_crc.h"
#include "base/ql_settings.h"
#include "blob/ql_blob_open.h"
#include "scene/blob/blob_schema.h"
#include "support/picture/mini_scene.h"
#include "support/ql_stats.h"
#include "support/ql_test.h"

/* ---- The scenes -------------------------------------------------------- */

typedef enum { WITH_ALL, WITH_8_BITS, WITH_CONSTANT_SKY } scene_kind_t;

static mini_scene_t mini;

/* One triangle and one sphere that shine and two that do not, each gloss, a
 * map of the sky, tables, a lens, contacts, ranks, a hull. Entries are in the
 * order of their making but for triangles, which the tree sorts, and materials,
 * glossy ones first. */
static void build(scene_kind_t kind)
{
    static const int32_t ball[2][3] = {
            {2000000, 2000000, 5000000}, {6000000, 4000000, 6000000}};
    static const int32_t a[2][3] = {{1000, 1000, 30000}, {1000, 9000, 28000}};
    static const int32_t b[2][3] = {{9000, 1000, 28000}, {9000, 9000, 28000}};
    static const int32_t c[2][3] = {{9000, 9000, 30000}, {5000, 9500, 26000}};
    static const double right[3] = {0.3, 0, 0}, up[3] = {0, 0.3, 0};
    static const double lens[2][2][3] = {
            {{300, 0, 0}, {0, 300, 0}}, {{-0.01, 0, 0}, {0, -0.01, 0}}};
    static const double weights[8] = {1, 2, 0, 4, 5, 0, 7, 8};
    static const double bend[3] = {0.1, 0.2, -0.9};
    static const uint16_t count[3] = {2, 2, 2};
    double rgb[32][3];
    uint16_t white, lamp, phong, mirror, glass;
    ql_scene_t scene;

    mini_begin(&mini);
    mini.node_bits = kind == WITH_8_BITS ? 8 : 16;
    mini.leaf_max = 1;
    white = mini_material(&mini, 0.7, 0);
    lamp = mini_material(&mini, 0.2, 0.9);
    phong = mini_material(&mini, 0.3, 0);
    mirror = mini_material(&mini, 0.1, 0);
    glass = mini_material(&mini, 0, 0);
    mini_gloss(&mini, phong, QL_GLOSS_PHONG, 0.5, 20.5);
    mini_gloss(&mini, mirror, QL_GLOSS_MIRROR, 0.8, 0);
    mini_gloss(&mini, glass, QL_GLOSS_GLASS, 0.9, 1.5);
    mini_triangle(&mini, a[0], b[0], c[0], lamp);
    mini_triangle(&mini, a[1], b[1], c[1], white);
    (void)mini_sphere(&mini, ball[0], 900000, lamp);
    (void)mini_sphere(&mini, ball[1], 1000000, mirror);
    /* of no triangle, so that it may lie anywhere */
    mini_normal(&mini, mini_vertex(&mini, 500, 500, 500), bend);
    (void)mini_table(&mini, 3, count, weights);
    for (int i = 0; i < 32; i++) {
        rgb[i][0] = rgb[i][1] = rgb[i][2] = 0.9 / (1 + i);
    }
    if (kind == WITH_CONSTANT_SKY) {
        mini_sky(&mini, 0.1, 0.2, 0.3);
    } else {
        mini_sky_map(&mini, 8, 4, (const double(*)[3])rgb, 0.3);
    }
    mini_lens(&mini, lens[0], lens[1]);
    mini.contact = true;
    mini.order = true;
    mini.hull = true;
    mini_field(&mini, right, up);
    mini_open(&mini, &scene);
}

/* ---- A copy that can be changed ---------------------------------------- */

enum { ROOM = 4 << 20 };

static struct {
    uint32_t words[ROOM / 4];
    uint32_t size;
} copy;

static uint8_t *at_byte(uint32_t offset)
{
    return (uint8_t *)copy.words + offset;
}

static void take_copy(scene_kind_t kind)
{
    build(kind);
    memset(copy.words, 0, sizeof copy.words);
    memcpy(copy.words, mini.blob, mini.size_bytes);
    copy.size = (uint32_t)mini.size_bytes;
}

static ql_blob_header_t *header(void)
{
    return (ql_blob_header_t *)(void *)copy.words;
}

static ql_status_t door(void)
{
    ql_scene_t scene;

    return ql_blob_open(&scene, copy.words, copy.size);
}

static void mend(void)
{
    header()->crc32 = ql_crc32(
            0, at_byte(QL_BLOB_CRC_FROM), copy.size - QL_BLOB_CRC_FROM);
}

static const blob_table_t *table_of(const char *name)
{
    for (int i = 0; i < BLOB_TABLE_COUNT; i++) {
        if (strcmp(blob_tables[i].name, name) == 0) {
            return blob_tables + i;
        }
    }
    return &blob_header;
}

/* Where the header says that a table lies. */
static ql_blob_table_t *place_of(const blob_table_t *table)
{
    ql_blob_table_t *place =
            (ql_blob_table_t *)(void *)at_byte(BLOB_PLACES_FROM);

    for (const blob_table_t *t = blob_tables; t < table; t++) {
        place += blob_has_table(t, header()->features);
    }
    return place;
}

static const blob_field_t *field_of(const blob_table_t *table, const char *name)
{
    for (unsigned i = 0; i < table->entry.field_count; i++) {
        const blob_field_t *const field = table->entry.fields + i;

        if (strcmp(field->name, name) == 0 && field->bits == 0) {
            return field;
        }
    }
    (void)fprintf(stderr, "no field %s of %s\n", name, table->name);
    exit(2);
}

/* Move a table to the end, as so many entries; new ones are as its last. With
 * the triangles go the tables of what touches and of ranks. */
static void grow(const blob_table_t *table, uint32_t count)
{
    ql_blob_table_t *const place = place_of(table);
    const uint32_t bytes = (uint32_t)blob_entry_bytes(table);
    const uint32_t old = place->count < count ? place->count : count;

    if (copy.size + (uint64_t)count * bytes + 4 > ROOM) {
        (void)fprintf(stderr, "%s: no room\n", table->name);
        exit(2);
    }
    memcpy(at_byte(copy.size), at_byte(place->offset), old * bytes);
    for (uint32_t i = old; i < count; i++) {
        memcpy(at_byte(copy.size + i * bytes),
                at_byte(place->offset + (old - 1) * bytes), bytes);
    }
    place->offset = copy.size;
    place->count = count;
    copy.size = (copy.size + count * bytes + 3) / 4 * 4;
    header()->size_bytes = copy.size;
    if (strcmp(table->name, "triangles") == 0) {
        grow(table_of("contacts"), (count + 15) / 16);
        grow(table_of("ranks"), count);
    }
}

/* ---- Rules of fields --------------------------------------------------- */

/* Which entry of a table. */
enum { LAST = -1, A_TRIANGLE = -2, A_SPHERE = -3 };

/* Which of a field's numbers. */
enum { EACH = 255 };

/* What opens: a value, whatever there is, or any value at all. */
typedef enum { LEGAL, AS_IT_IS, ANYTHING } opens_t;

typedef struct {
    const char *table, *field;
    int entry, number;
    opens_t opens;
    uint64_t legal, broken;
    ql_status_t status; /* QL_OK: QL_ERR_RANGE */
    const char *with;   /* another field of the entry that is set first */
    uint64_t with_value;
} rule_t;

#define EDGE(table, field, entry, legal, broken)                               \
    {                                                                          \
        table, field, entry, EACH, LEGAL, legal, broken, QL_OK, NULL, 0        \
    }
#define EDGE_IF(table, field, entry, legal, broken, with, value)               \
    {                                                                          \
        table, field, entry, EACH, LEGAL, legal, broken, QL_OK, with, value    \
    }
#define NOT(table, field, entry, broken)                                       \
    {                                                                          \
        table, field, entry, EACH, AS_IT_IS, 0, broken, QL_OK, NULL, 0         \
    }
#define NOT_OF(table, field, entry, number, broken)                            \
    {                                                                          \
        table, field, entry, number, AS_IT_IS, 0, broken, QL_OK, NULL, 0       \
    }
#define NOT_BY(table, field, broken, status)                                   \
    {                                                                          \
        table, field, 0, EACH, AS_IT_IS, 0, broken, status, NULL, 0            \
    }
#define FREE(table, field)                                                     \
    {                                                                          \
        table, field, 0, EACH, ANYTHING, 0, 0, QL_OK, NULL, 0                  \
    }

/* High words of s31.32 and words of s1.30: within 2^30. */
#define WIDE(high) ((uint64_t)(uint32_t)(high) << 32)
#define REACHES(table, field)                                                  \
    EDGE(table, field, 0, 0x40000000u, 0x40000001u),                           \
            EDGE(table, field, 0, 0xc0000000u, 0xbfffffffu)
#define WIDE_REACHES(table, field)                                             \
    EDGE(table, field, 0, WIDE(0x40000000u), WIDE(0x40000001u)),               \
            EDGE(table, field, 0, WIDE(0xc0000000u), WIDE(0xbfffffffu))

#define SPHERE_HIGH (32759u * 256u)

/* Of a blob with all tables. What `pairs8` says is tried in one of 8-bit
 * nodes, of `sky (constant)` in one without a map. Triangles are in the order
 * of the tree, so lights 0 and 1 are what is in lights' table. */
static const rule_t rules[] = {
        NOT_BY("header", "magic", 0x58554c50u, QL_ERR_MAGIC),
        NOT_BY("header", "version", 0, QL_ERR_VERSION),
        NOT_BY("header", "version", 1, QL_ERR_VERSION),
        NOT_BY("header", "header_bytes", 96 + 8 * 9, QL_ERR_VERSION),
        NOT_BY("header", "header_bytes", 96 + 8 * 11, QL_ERR_VERSION),
        NOT_BY("header", "size_bytes", 0x7ffffffcu, QL_ERR_TRUNCATED),
        NOT_BY("header", "size_bytes", 92, QL_ERR_RANGE),
        NOT_BY("header", "features", 0x40003fe5u, QL_ERR_FEATURE),
        NOT_BY("header", "depth", QL_CFG_BVH_STACK + 1, QL_ERR_CAPACITY),
        EDGE("header", "depth", 0, QL_CFG_BVH_STACK, 0),
        EDGE("header", "depth", 0, 2, 1),
        NOT("header", "root_meta", 0, 3),
        NOT("header", "root_meta", 0, 17),
        NOT("header", "root_meta", 0, 0x100),
        NOT("header", "root_link", 0, 1),
        EDGE("header", "radiance_exp", 0, 64, 65),
        EDGE("header", "radiance_exp", 0, 0xffc0u, 0xffbfu),
        FREE("header", "exposure_q8"),
        EDGE("header", "image_width", 0, 1, 0),
        EDGE("header", "image_width", 0, 16384, 16385),
        EDGE("header", "image_height", 0, 1, 0),
        EDGE("header", "image_height", 0, 16384, 16385),
        FREE("header", "unit_m"),
        FREE("header", "unit_exp"),
        EDGE("header", "auto_direct", 0, QL_DIRECT_MIS, QL_DIRECT_MIS + 1),
        EDGE("header", "auto_lights", 0, QL_LIGHTS_UNIFORM,
                QL_LIGHTS_UNIFORM + 1),
        FREE("header", "trials"),

        WIDE_REACHES("camera", "at[0]"),
        FREE("camera", "at[1]"),
        FREE("camera", "at[2]"),
        REACHES("camera", "towards[0]"),
        REACHES("camera", "towards[1]"),
        REACHES("camera", "towards[2]"),

        EDGE("vertices", "xyz", LAST, 8, 7),
        EDGE("vertices", "xyz", LAST, 32759, 32760),

        NOT("triangles", "vertex", A_TRIANGLE, 7),
        NOT_OF("triangles", "vertex", A_SPHERE, 0, 2),
        NOT_OF("triangles", "vertex", A_SPHERE, 1, 1),
        NOT_OF("triangles", "vertex", A_SPHERE, 2, 1),
        EDGE("triangles", "material", A_TRIANGLE, 4, 5),
        NOT("triangles", "material", A_TRIANGLE, 0x4000u),
        NOT("triangles", "material", A_SPHERE, 0x4000u),
        EDGE("triangles", "inv_n", A_TRIANGLE, 0x8000001fu, 0x7fffffffu),
        NOT("triangles", "inv_n", A_TRIANGLE, 0),

        EDGE("pairs16", "centre", LAST, 32767, 32768),
        EDGE("pairs16", "half", LAST, 16384, 16385),
        EDGE("pairs16", "link", LAST, 19, 20),
        EDGE_IF("pairs16", "link", LAST, 20, 21, "meta", 3),
        EDGE_IF("pairs16", "meta", LAST, 16, 17, "link", 0),
        EDGE_IF("pairs16", "meta", LAST, 7, 8, "link", 16),
        NOT("pairs16", "meta", LAST, 2),

        EDGE("pairs8", "base", LAST, 32767, 32768),
        EDGE_IF("pairs8", "base", LAST, 32767 - 60 * 256, 32768 - 60 * 256,
                "centre[0]", 0x3c3c3cu),
        EDGE_IF("pairs8", "base", LAST, 32767 - 60 * 256, 32768 - 60 * 256,
                "centre[1]", 0x3c3c3cu),
        EDGE("pairs8", "shift", LAST, 8, 9),
        EDGE("pairs8", "centre[0]", LAST, 127, 128),
        EDGE("pairs8", "centre[1]", LAST, 127, 128),
        EDGE("pairs8", "half[0]", LAST, 64, 65),
        EDGE("pairs8", "half[1]", LAST, 64, 65),
        EDGE_IF("pairs8", "meta", LAST, 0x47, 0x48, "link[0]", 0x10),
        EDGE_IF("pairs8", "meta", LAST, 0x74, 0x84, "link[1]", 0x10),
        NOT("pairs8", "meta", LAST, 0x42),
        NOT("pairs8", "meta", LAST, 0x14),
        EDGE("pairs8", "link[0]", LAST, 19, 20),
        EDGE("pairs8", "link[1]", LAST, 19, 20),

        EDGE("materials", "albedo", LAST, 0x80000000u, 0x80000001u),
        NOT("materials", "albedo", 2, 1), /* glass */
        FREE("materials", "emission"),

        NOT("lights", "cum", 0, 1),
        NOT("lights", "cum", 1, 0),
        EDGE("lights", "cum", LAST, 0xffffffffu, 1),
        EDGE("lights", "weight_m", 0, 0x80000000u, 0x7fffffffu),
        EDGE("lights", "weight_exp", LAST, 128, 129),
        EDGE("lights", "weight_exp", 0, 0xff80u, 0xff7fu),
        EDGE("lights", "triangle", 0, 0, 0xffffu),
        EDGE("lights", "triangle", 1, 3, 4),
        NOT("lights", "triangle", LAST, 3),
        NOT("lights", "triangle", LAST, 65534),

        FREE("normals", "xyz"),

        EDGE("gloss", "specular", 0, 0xb3333333u - 0x80000000u + 0x26666666u,
                0x80000000u),
        NOT("gloss", "specular", 1, 0x80000001u),
        EDGE("gloss", "specular", 2, 0x80000000u, 0x80000001u),
        NOT("gloss", "parameter", 1, 1),
        EDGE("gloss", "parameter", 2, 4096, 4095),
        EDGE("gloss", "parameter", 2, 4194304, 4194305),
        EDGE("gloss", "chance", 0, 0x80000000u, 0x80000001u),
        EDGE("gloss", "chance", 1, 0, 0x80000001u),
        NOT("gloss", "chance", 2, 0x7fffffffu),
        NOT("gloss", "kind", 0, 0),
        NOT("gloss", "kind", 0, 4),
        NOT("gloss", "zero", LAST, 1),

        EDGE("spheres", "radius", 0, 256, 255),
        EDGE("spheres", "radius", 0, 2000000 - 2048, 2000000 - 2047),
        NOT("spheres", "radius", 0, 0xfffffff0u),
        EDGE("spheres", "centre", 1, 1000000 + 2048, 1000000 + 2047),
        EDGE("spheres", "centre", 1, SPHERE_HIGH - 1000000,
                SPHERE_HIGH - 999999),

        FREE("sky", "emission"),
        FREE("sky", "rotate"),
        NOT("sky", "width", 0, 7),
        NOT("sky", "width", 0, 0),
        NOT("sky", "height", 0, 5),
        NOT("sky", "height", 0, 0),
        NOT("sky", "table", 0, 0),
        NOT("sky", "table", 0, 2),
        FREE("sky", "zero"),

        EDGE("texels", "rgb9e5", LAST, 0xbfffffffu, 0xc0000000u),

        NOT("tables", "first", 0, 47),
        NOT("tables", "first", 0, 0xffffffffu),
        NOT("tables", "dims", 0, 0),
        NOT("tables", "dims", 0, 2),
        NOT("tables", "dims", 0, 4),
        NOT("tables", "count", 0, 0),
        NOT_OF("tables", "count", 0, 0, 0xffff),
        NOT_OF("tables", "count", 1, 2, 2),

        NOT("words", "word", 0, 0),
        NOT("words", "word", 0, 3),

        WIDE_REACHES("lens", "p[0]"),
        WIDE_REACHES("lens", "p[1]"),
        REACHES("lens", "d[0]"),
        REACHES("lens", "d[1]"),

        FREE("contacts", "word"),
        FREE("ranks", "word"),

        FREE("hull", "box[0]"),
        FREE("hull", "box[1]"),
        FREE("hull", "box[2]"),
        FREE("hull", "first"),
        FREE("hull", "zero"),
        FREE("sides", "n"),
        EDGE("sides", "node", 0, 5, 6),
        EDGE("sides", "triangle", 0, 3, 4),
};
enum { RULES = sizeof rules / sizeof rules[0] };

/* An entry of a table in the copy. */
static void *entry_of(const blob_table_t *table, int entry)
{
    uint8_t *first;
    int i = entry;

    if (table == &blob_header) {
        return copy.words;
    }
    first = at_byte(place_of(table)->offset);
    if (entry == LAST) {
        i = (int)(place_of(table)->count * table->repeat) - 1;
    } else if (entry < LAST) {
        const ql_blob_tri_t *const tri = (const ql_blob_tri_t *)(void *)first;

        for (i = 0; (tri[i].inv_n == 0) != (entry == A_SPHERE); i++) {
        }
    }
    return first + (size_t)i * table->entry.bytes;
}

/* A blob in which only a rule is at stake. */
static void *prepare(const rule_t *rule)
{
    const blob_table_t *const table = table_of(rule->table);
    const bool eight = strcmp(rule->table, "pairs8") == 0;
    void *entry;

    take_copy(eight ? WITH_8_BITS : WITH_ALL);
    /* a vertex more than the header tells, as the last one of triangles */
    if (strcmp(rule->table, "triangles") == 0) {
        const blob_table_t *const vertices = table_of("vertices");
        ql_blob_vertex_t *v;

        grow(vertices, 8);
        place_of(vertices)->count = 7;
        v = (ql_blob_vertex_t *)(void *)at_byte(place_of(vertices)->offset);
        v[7] = v[1];
    }
    if (strncmp(rule->table, "pairs", 5) == 0) {
        grow(table_of("triangles"), 20);
    }
    /* likewise a table more, just as that of the sky */
    if (strcmp(rule->table, "sky") == 0) {
        grow(table_of("tables"), 3);
        place_of(table_of("tables"))->count = 2;
    }
    entry = entry_of(table, rule->entry);
    if (eight) { /* boxes of one point: leaves both */
        ql_blob_pair8_t *const pair = entry;

        memset(pair->base, 0, sizeof pair->base);
        memset(pair->centre, 0, sizeof pair->centre);
        memset(pair->half, 0, sizeof pair->half);
        pair->shift = 8;
        pair->meta = 0x44;
    }
    if (rule->with != NULL) {
        const blob_field_t *const with = field_of(table, rule->with);

        for (unsigned i = 0; i < with->count; i++) {
            blob_set(with, entry, i, rule->with_value >> 8 * i);
        }
    }
    return entry;
}

static void try_value(const rule_t *rule, const blob_field_t *field, unsigned i,
        uint64_t value, ql_status_t wanted)
{
    void *const entry = prepare(rule);
    ql_status_t got;

    blob_set(field, entry, i, value);
    mend();
    got = door();
    CHECK(got == wanted, "%s %s[%u] of entry %d = 0x%llx: status %d, want %d",
            rule->table, rule->field, i, rule->entry, (unsigned long long)value,
            got, wanted);
}

static unsigned long tried;

static void try_rule(const rule_t *rule)
{
    const blob_field_t *const field =
            field_of(table_of(rule->table), rule->field);
    const ql_status_t status =
            rule->status == QL_OK ? QL_ERR_RANGE : rule->status;
    static const uint64_t any[] = {0, 1, 0x8000800080008000u,
            0x7fff7fff7fff7fffu, 0x123456789abcdef0u, UINT64_MAX};

    for (unsigned i = 0; i < field->count; i++) {
        if (rule->number != EACH && rule->number != (int)i) {
            continue;
        }
        if (rule->opens == ANYTHING) {
            for (unsigned k = 0; k < sizeof any / sizeof any[0]; k++) {
                try_value(rule, field, i, any[k], QL_OK);
            }
            continue;
        }
        (void)prepare(rule);
        mend();
        CHECK(door() == QL_OK, "%s %s: refused as it is", rule->table,
                rule->field);
        if (rule->opens == LEGAL) {
            try_value(rule, field, i, rule->legal, QL_OK);
        }
        try_value(rule, field, i, rule->broken, status);
        tried++;
    }
}

TEST(each_rule_of_a_field_is_checked_at_its_edge)
{
    tried = 0;
    for (unsigned i = 0; i < RULES; i++) {
        try_rule(rules + i);
    }
    NOTE("%u rules, %lu numbers", (unsigned)RULES, tried);
}

/* A unit normal may be longer than 1 by 2^-21, and no more: 1/|N| as the blob
 * packs it, a bit below that and a bit above. */
TEST(normals_are_no_longer_than_their_bound)
{
    static const double off[] = {0, 0.9, 1.1, 2, 1 << 20};

    for (unsigned i = 0; i < sizeof off / sizeof off[0]; i++) {
        ql_blob_tri_t *tri;
        const bool sound = off[i] <= 1;
        ql_status_t got;
        double m;

        take_copy(WITH_ALL);
        tri = entry_of(table_of("triangles"), A_TRIANGLE);
        m = tri->inv_n & ~31u;
        m *= 1 + ldexp(off[i], -21);
        if (m >= 4294967296.0) {
            continue;
        }
        tri->inv_n = ((uint32_t)m & ~31u) | (tri->inv_n & 31u);
        mend();
        got = door();
        CHECK(got == (sound ? QL_OK : QL_ERR_RANGE), "longer by %g 2^-21: %d",
                off[i], got);
    }
}

static void check_listed(const blob_table_t *table)
{
    for (unsigned f = 0; f < table->entry.field_count; f++) {
        const blob_field_t *const field = table->entry.fields + f;
        unsigned listed = 0;

        for (unsigned i = 0; i < RULES; i++) {
            listed += strcmp(rules[i].table, table->name) == 0 &&
                      strcmp(rules[i].field, field->name) == 0;
        }
        if (blob_field_bytes(field) > 0 && strcmp(field->name, "crc32") != 0) {
            CHECK(listed > 0, "%s %s has no rule", table->name, field->name);
        }
    }
}

/* The CRC and places of tables have claims of their own. */
TEST(every_field_of_the_schema_has_a_rule)
{
    check_listed(&blob_header);
    for (int i = 0; i < BLOB_TABLE_COUNT; i++) {
        check_listed(blob_tables + i);
    }
    NOTE("%d tables", BLOB_TABLE_COUNT);
}

/* ---- Rules of tables --------------------------------------------------- */

static void check_place(const blob_table_t *table, scene_kind_t kind,
        uint32_t offset, uint32_t count, ql_status_t wanted)
{
    const uint32_t offset_now = place_of(table)->offset;
    ql_status_t got;

    place_of(table)->offset = offset;
    place_of(table)->count = count;
    mend();
    got = door();
    CHECK(got == wanted,
            "%s at %lu of %lu (was at %lu), %lu entries, scene %d: status %d",
            table->name, (unsigned long)offset, (unsigned long)copy.size,
            (unsigned long)offset_now, (unsigned long)count, kind, got);
    tried++;
}

/* At each offset that is wrong lies what would be right. */
static void check_table(const blob_table_t *table, scene_kind_t kind)
{
    uint32_t at, count, bytes;

    take_copy(kind);
    if (!blob_has_table(table, header()->features)) {
        return;
    }
    count = place_of(table)->count;
    bytes = count * (uint32_t)blob_entry_bytes(table);
    grow(table, count);
    at = place_of(table)->offset;
    check_place(table, kind, at, count, QL_OK);
    for (uint32_t off = 1; off < 4; off++) {
        take_copy(kind);
        grow(table, count);
        copy.size = header()->size_bytes = copy.size + 4;
        memmove(at_byte(at + off), at_byte(at), bytes);
        check_place(table, kind, at + off, count, QL_ERR_RANGE);
    }
    /* what is behind the end is right as well */
    take_copy(kind);
    grow(table, count);
    copy.size = header()->size_bytes = at + (bytes - 1) / 4 * 4;
    check_place(table, kind, at, count, QL_ERR_RANGE);
    check_place(table, kind, copy.size + 4, count, QL_ERR_RANGE);
    check_place(table, kind, UINT32_MAX - 3, count, QL_ERR_RANGE);
    check_place(table, kind, at, 0xffffffffu / 4, QL_ERR_RANGE);
    /* in the header: whatever it is, nothing may lie there */
    take_copy(kind);
    check_place(table, kind, header()->header_bytes - 4u, count, QL_ERR_RANGE);
    check_place(table, kind, 0, count, QL_ERR_RANGE);
}

TEST(tables_lie_aligned_behind_the_header_and_inside_the_blob)
{
    tried = 0;
    for (int i = 0; i < BLOB_TABLE_COUNT; i++) {
        for (unsigned kind = WITH_ALL; kind <= WITH_CONSTANT_SKY; kind++) {
            check_table(blob_tables + i, (scene_kind_t)kind);
        }
    }
    NOTE("%lu places", tried);
}

static void check_count(const char *name, uint32_t count, ql_status_t wanted)
{
    const blob_table_t *const table = table_of(name);
    ql_status_t got;

    take_copy(WITH_ALL);
    if (count >= place_of(table)->count) {
        grow(table, count);
    } else {
        place_of(table)->count = count;
    }
    mend();
    got = door();
    CHECK(got == wanted, "%lu of %s: status %d", (unsigned long)count, name,
            got);
    tried++;
}

/* Tables of the most entries, all of them legal, and of one more; those whose
 * number another one gives, of one more and one less. */
TEST(tables_have_no_more_entries_than_the_format_allows)
{
    static const struct {
        const char *name;
        uint32_t most;
    } most[] = {{"triangles", QL_TRI_MAX}, {"materials", QL_MATERIAL_MAX},
            {"spheres", QL_TRI_MAX}, {"tables", 65535}, {"sides", QL_TRI_MAX}};
    static const struct {
        const char *name;
        uint32_t exact;
    } exact[] = {{"camera", 1}, {"vertices", 7}, {"normals", 7}, {"pairs16", 3},
            {"sky", 1}, {"texels", 32}, {"lens", 1}, {"contacts", 1},
            {"ranks", 4}, {"hull", 1}};

    tried = 0;
    for (unsigned i = 0; i < sizeof most / sizeof most[0]; i++) {
        check_count(most[i].name, most[i].most, QL_OK);
        check_count(most[i].name, most[i].most + 1, QL_ERR_RANGE);
    }
    for (unsigned i = 0; i < sizeof exact / sizeof exact[0]; i++) {
        check_count(exact[i].name, exact[i].exact, QL_OK);
        check_count(exact[i].name, exact[i].exact + 1, QL_ERR_RANGE);
        check_count(exact[i].name, exact[i].exact - 1, QL_ERR_RANGE);
    }
    check_count("gloss", 5, QL_ERR_RANGE); /* diffuse ones have no kind */
    check_count("gloss", 6, QL_ERR_RANGE);
    check_count("materials", 4, QL_ERR_RANGE); /* a triangle is of the last */
    check_count("triangles", 3, QL_ERR_RANGE); /* a leaf needs the last */
    check_count("spheres", 1, QL_ERR_RANGE);
    check_count("lights", 0, QL_ERR_RANGE);
    check_count("tables", 1, QL_ERR_RANGE); /* the sky's is the last */
    check_count("words", 49, QL_ERR_RANGE);
    check_count("sides", 0, QL_ERR_RANGE);
    NOTE("%lu tables", tried);
}

/* ---- Rules of features ------------------------------------------------- */

/* With one of its features changed a blob has another header, or breaks the
 * rule of that feature. */
TEST(features_are_those_that_the_blob_has)
{
    unsigned refused = 0;

    for (unsigned bit = 0; bit < 32; bit++) {
        const uint32_t feature = (uint32_t)1 << bit;
        const uint32_t kinds =
                QL_FEATURE_PHONG | QL_FEATURE_MIRROR | QL_FEATURE_GLASS;
        const uint32_t free_ones = QL_FEATURE_TWO_SIDED | QL_FEATURE_PAGES;
        const uint32_t same_header = kinds | QL_FEATURE_LIGHTS |
                                     QL_FEATURE_NODE16 | QL_FEATURE_NODE8;
        const ql_status_t wanted = bit > 16                ? QL_ERR_FEATURE
                                   : feature & free_ones   ? QL_OK
                                   : feature & same_header ? QL_ERR_RANGE
                                                           : QL_ERR_VERSION;
        ql_status_t got;

        take_copy(WITH_ALL);
        header()->features ^= feature;
        mend();
        got = door();
        CHECK(got == wanted, "feature %u: status %d, want %d", bit, got,
                wanted);
        refused += got != QL_OK;
    }
    NOTE("%u refused", refused);
}

/* Take an optional table out of a blob that has it, and its features. */
static void leave_out(const blob_table_t *table)
{
    ql_blob_table_t *const place = place_of(table);
    uint8_t *const end = at_byte(header()->header_bytes);

    memmove(place, place + 1, (size_t)(end - (uint8_t *)(place + 1)));
    header()->header_bytes = (uint16_t)(header()->header_bytes - 8);
    header()->features &= ~table->features;
}

TEST(tables_that_others_need_cannot_be_left_out)
{
    static const struct {
        const char *name, *too;
        bool needed;
    } optional[] = {{"normals", NULL, false}, {"gloss", NULL, false},
            {"spheres", NULL, true}, {"sky", NULL, true},
            {"texels", NULL, true}, {"tables", "words", true},
            {"lens", NULL, false}, {"contacts", NULL, false},
            {"ranks", NULL, false}, {"hull", "sides", false}};

    for (unsigned i = 0; i < sizeof optional / sizeof optional[0]; i++) {
        const blob_table_t *const table = table_of(optional[i].name);
        ql_status_t got;

        take_copy(WITH_ALL);
        if (optional[i].too != NULL) {
            leave_out(table_of(optional[i].too));
            header()->features |= table->features;
        }
        leave_out(table);
        mend();
        got = door();
        CHECK(got == (optional[i].needed ? QL_ERR_RANGE : QL_OK),
                "without %s: status %d", optional[i].name, got);
    }
}

/* A scene of one leaf has no pairs, wherever their table is. */
TEST(a_root_is_a_leaf_of_at_most_13_triangles)
{
    for (unsigned count = 0; count <= 20; count++) {
        ql_blob_table_t *place;
        ql_status_t got;

        take_copy(WITH_ALL);
        leave_out(table_of("sides")); /* a hull needs two children */
        header()->features |= QL_FEATURE_HULL;
        leave_out(table_of("hull"));
        grow(table_of("triangles"), 20);
        place = place_of(table_of("pairs16"));
        place->count = 0;
        place->offset = copy.size;
        header()->root_meta = (uint16_t)(3 + count);
        mend();
        got = door();
        CHECK(got == (count <= QL_LEAF_MAX ? QL_OK : QL_ERR_RANGE),
                "%u triangles: status %d", count, got);
    }
}

/* Triangles of two lights: equal, and the later one before the first. */
TEST(no_two_lights_are_of_one_triangle)
{
    for (unsigned i = 0; i < 3; i++) {
        ql_blob_light_t *light;
        ql_status_t got;

        take_copy(WITH_ALL);
        light = entry_of(table_of("lights"), 0);
        light[0].triangle = (uint16_t)(1 + i);
        light[1].triangle = 2;
        mend();
        got = door();
        CHECK(got == (i == 0 ? QL_OK : QL_ERR_RANGE), "%u, then 2: status %d",
                1 + i, got);
    }
}

/* A sky of 2 by 2 texels whose table is of 2 by 2 by 2 cells. */
TEST(the_table_of_the_sky_has_two_dimensions)
{
    ql_blob_sky_t *sky;
    ql_status_t got;

    take_copy(WITH_ALL);
    sky = entry_of(table_of("sky"), 0);
    sky->table = 0;
    sky->width = sky->height = 2;
    place_of(table_of("texels"))->count = 4;
    mend();
    got = door();
    CHECK(got == QL_ERR_RANGE, "status %d", got);
}

/* A constant sky has no map, so no size. */
TEST(a_sky_without_a_map_has_no_texels_to_look_up)
{
    for (unsigned i = 0; i < 4; i++) {
        ql_blob_sky_t *sky;
        ql_status_t got;

        take_copy(WITH_CONSTANT_SKY);
        sky = entry_of(table_of("sky"), 0);
        sky->width = (uint16_t)(i & 1);
        sky->height = (uint16_t)(i >> 1);
        mend();
        got = door();
        CHECK(got == (i == 0 ? QL_OK : QL_ERR_RANGE), "%u: status %d", i, got);
    }
}

/* Each bound of each row of a table of 2 x 2 x 2 decreases in turn; row by row
 * it may not be empty if it is entered. */
TEST(no_row_of_a_table_decreases_or_is_longer_than_it_is)
{
    unsigned refused = 0;

    for (unsigned i = 0; i < 48; i++) {
        /* the map's rows: 4, then 4 of 8; before them 2, 2 of 2, 4 of 2 */
        const unsigned in_map = i - 14, in_row = (in_map - 4) % 8;
        uint16_t *words;
        ql_status_t got;

        take_copy(WITH_ALL);
        words = entry_of(table_of("words"), 0);
        if (i < 14 || in_map < 4 || in_row < 2) {
            continue; /* a bound before which there is none */
        }
        words[i] = (uint16_t)(words[i - 1] - 1);
        mend();
        got = door();
        CHECK(got == QL_ERR_RANGE, "word %u: status %d", i, got);
        refused += got != QL_OK;
    }
    NOTE("%u bounds", refused);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("tools/scene_door", argc, argv);
    RUN(each_rule_of_a_field_is_checked_at_its_edge);
    RUN(normals_are_no_longer_than_their_bound);
    RUN(every_field_of_the_schema_has_a_rule);
    RUN(tables_lie_aligned_behind_the_header_and_inside_the_blob);
    RUN(tables_have_no_more_entries_than_the_format_allows);
    RUN(features_are_those_that_the_blob_has);
    RUN(tables_that_others_need_cannot_be_left_out);
    RUN(a_root_is_a_leaf_of_at_most_13_triangles);
    RUN(no_two_lights_are_of_one_triangle);
    RUN(the_table_of_the_sky_has_two_dimensions);
    RUN(a_sky_without_a_map_has_no_texels_to_look_up);
    RUN(no_row_of_a_table_decreases_or_is_longer_than_it_is);
    return TEST_END();
}
