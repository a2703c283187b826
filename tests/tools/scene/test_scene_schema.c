/* test_scene_schema.c - the description of a blob against what it describes */
/* SPDX-License-Identifier: MIT */

#include <stdlib.h>

#include "lib/program/cli.h"
#include "scene/blob/dump_blob.h"
#include "scene/blob/parse_dump.h"
#include "support/picture/picture.h"
#include "tools/scene/scene_worlds.h"

/* ---- rows against structs ---- */

static unsigned size_of(const blob_field_t *field)
{
    return field->bits == 0 ? field->count * blob_number_bytes(field) : 0;
}

static void check_rows(const char *name, const blob_struct_t *s)
{
    unsigned char rows[256] = {0};

    for (unsigned f = 0; f < s->field_count; f++) {
        const blob_field_t *field = s->fields + f;

        for (unsigned i = 0; i < size_of(field); i++) {
            rows[field->offset + i]++;
        }
        CHECK((field->gap == 0) == (field->what == NULL), "%s: %s", name,
                field->name);
    }
    for (size_t i = 0; i < s->bytes; i++) {
        CHECK(rows[i] == 1, "%s: byte %zu has %d rows", name, i, rows[i]);
    }
}

TEST(every_byte_of_every_struct_has_one_row)
{
    static const size_t bytes[] = {
#define SIZE(name, type, features) sizeof(type),
            BLOB_TABLE_LIST(SIZE)
#undef SIZE
    };

    check_rows("place", &blob_place);
    check_rows("header", &blob_header.entry);
    for (int i = 0; i < BLOB_TABLE_COUNT; i++) {
        const blob_table_t *t = blob_tables + i;

        CHECK(t->name != NULL, "table %d is not described", i);
        if (t->name != NULL) {
            CHECK(blob_entry_bytes(t) == bytes[i], "%s: %lu bytes", t->name,
                    (unsigned long)blob_entry_bytes(t));
            check_rows(t->name, &t->entry);
        }
    }
}

/* How often a key begins a line in one struct. */
static unsigned count_key(const blob_struct_t *s, const char *key)
{
    unsigned count = 0;

    for (unsigned f = 0; f < s->field_count; f++) {
        count += s->fields[f].key != NULL && strcmp(s->fields[f].key, key) == 0;
    }
    return count;
}

TEST(no_two_tables_share_a_key)
{
    for (int i = 0; i < BLOB_TABLE_COUNT; i++) {
        const blob_struct_t *s = &blob_tables[i].entry;

        for (unsigned f = 0; f < s->field_count; f++) {
            const char *key = s->fields[f].key;

            for (int other = 0; key != NULL && other < i; other++) {
                CHECK(count_key(&blob_tables[other].entry, key) == 0, "%s",
                        key);
            }
            CHECK(key == NULL || count_key(&blob_header.entry, key) == 0, "%s",
                    key);
        }
    }
}

/* ---- to text and back ---- */

/* Fill what a dump shows with random bits, signs and all. */
static void fill(const blob_table_t *table, void *entries, size_t count)
{
    const blob_struct_t *s = &table->entry;

    for (size_t n = 0; n < count * table->repeat; n++) {
        for (unsigned f = 0; f < s->field_count; f++) {
            const blob_field_t *field = s->fields + f;

            for (unsigned i = 0; i < field->count && field->gap > 0; i++) {
                blob_set(field, (char *)entries + n * s->bytes, i, next());
            }
        }
    }
}

/* A model of random numbers, with every table that its features allow. */
static void fill_model(model_t *model, uint32_t features)
{
    model_table_t tables[BLOB_TABLE_COUNT] = {{NULL, 0}};

    memset(model, 0, sizeof *model);
    fill(&blob_header, &model->header, 1);
    model->header.features = features;
    for (int i = 0; i < BLOB_TABLE_COUNT; i++) {
        const blob_table_t *t = blob_tables + i;

        if (blob_has_table(t, features)) {
            tables[i].count =
                    t->count_max == 1 ? 1 : 1 + (uint32_t)(next() % 30);
            tables[i].entries =
                    cli_alloc(tables[i].count, (size_t)blob_entry_bytes(t));
            fill(t, tables[i].entries, tables[i].count);
        }
    }
    model_set_tables(model, tables);
}

static void parse(model_t *model, const char *path)
{
    text_t text;

    text_open(&text, path, KIND_SCENE);
    CHECK(is_dump(&text), "%s does not begin as a dump", path);
    parse_dump(model, &text);
    text_close(&text);
}

static void check_equal(const model_t *a, const model_t *b)
{
    model_table_t in[BLOB_TABLE_COUNT], out[BLOB_TABLE_COUNT];

    CHECK(memcmp(&a->header, &b->header, sizeof a->header) == 0, "header");
    model_get_tables(a, in);
    model_get_tables(b, out);
    for (int i = 0; i < BLOB_TABLE_COUNT; i++) {
        const size_t bytes =
                in[i].count * (size_t)blob_entry_bytes(blob_tables + i);

        CHECK(in[i].count == out[i].count, "%s: %lu entries, then %lu",
                blob_tables[i].name, (unsigned long)in[i].count,
                (unsigned long)out[i].count);
        CHECK(in[i].count != out[i].count || bytes == 0 ||
                        memcmp(in[i].entries, out[i].entries, bytes) == 0,
                "%s changed", blob_tables[i].name);
    }
}

TEST(any_numbers_of_any_table_come_back_from_a_dump)
{
    const char *path = picture_built("test/test_scene_schema.txt");
    const uint32_t all = (1u << 14) - 1;

    for (int round = 0; round < 100; round++) {
        const uint32_t nodes =
                round % 2 == 0 ? QL_FEATURE_NODE8 : QL_FEATURE_NODE16;
        const uint32_t other =
                all & ~nodes &
                ~(uint32_t)(QL_FEATURE_NODE8 | QL_FEATURE_NODE16);
        FILE *file = fopen(path, "wb");
        model_t model, again;

        if (file == NULL) {
            CHECK(false, "cannot write %s: run from the root", path);
            return;
        }
        fill_model(
                &model, nodes | (round < 2 ? other : other & (uint32_t)next()));
        dump_blob(file, &model);
        fclose(file);
        parse(&again, path);
        check_equal(&model, &again);
        model_free(&model);
        model_free(&again);
    }
    remove(path);
}

/* ---- BLOB.md ---- */

/* A row "offset size name" of a block against the table's. */
static bool is_described(const blob_struct_t *s, const char *row)
{
    unsigned offset, size;
    char name[32];

    if (sscanf(row, "%u %u %31s", &offset, &size, name) != 3) {
        return false;
    }
    for (unsigned f = 0; f < s->field_count; f++) {
        const blob_field_t *field = s->fields + f;

        if (field->bits == 0 && strcmp(field->name, name) == 0) {
            return field->offset == offset && size_of(field) == size;
        }
    }
    return false;
}

/* Blocks of BLOB.md begin with this line; one is the header's, then each table
 * has one, in the order of the blob. */
static const char block[] = "    offset  size  field";

/* Check the rows behind such a line, and that none is missing. */
static void check_block(FILE *file, const char *name, const blob_struct_t *s)
{
    unsigned rows = 0, expected = 0;
    char line[256];

    for (unsigned f = 0; f < s->field_count; f++) {
        expected += s->fields[f].bits == 0;
    }
    while (rows < expected && fgets(line, sizeof line, file) != NULL &&
            line[0] == ' ') {
        if (strspn(line, " ") < 15) { /* else it goes on with the last row */
            CHECK(is_described(s, line), "%s: %s", name, line);
            rows++;
        }
    }
    CHECK(rows == expected, "%s: %u rows, expected %u", name, rows, expected);
}

/* A heading that says bytes says those of the table's entry. */
static void check_heading(const char *heading, const blob_table_t *t)
{
    char bytes[16];

    (void)snprintf(
            bytes, sizeof bytes, " %lu ", (unsigned long)blob_entry_bytes(t));
    CHECK(strpbrk(heading, "0123456789") == NULL ||
                    strstr(heading, bytes) != NULL,
            "%s: %s", t->name, heading);
}

TEST(blob_md_has_every_field_where_it_is)
{
    FILE *file = fopen("firmware/BLOB.md", "rb");
    char line[256], heading[256] = "";
    int i = -1;

    if (file == NULL) {
        CHECK(false, "cannot read firmware/BLOB.md: run from the root");
        return;
    }
    while (fgets(line, sizeof line, file) != NULL) {
        if (strncmp(line, "## ", 3) == 0) {
            memcpy(heading, line, sizeof heading);
        }
        if (strncmp(line, block, strlen(block)) == 0) {
            const blob_table_t *t = i < 0 ? &blob_header : blob_tables + i;

            if (i < BLOB_TABLE_COUNT) {
                check_heading(heading, t);
                check_block(file, t->name, &t->entry);
            }
            i++;
        }
    }
    fclose(file);
    CHECK(i == BLOB_TABLE_COUNT, "%d blocks of tables, expected %d", i,
            BLOB_TABLE_COUNT);
}

/* The line of the list of optional tables. */
static void format_row(char *row, size_t size, const blob_table_t *t)
{
    const char *before = "";
    int at = snprintf(row, size, "| %s | %lu bytes | ", t->name,
            (unsigned long)blob_entry_bytes(t));

#define APPEND(name, bit, text)                                                \
    if ((t->features & (uint32_t)name) != 0) {                                 \
        at += snprintf(row + at, size - (size_t)at, "%s%s", before, text);     \
        before = ", ";                                                         \
    }
    QL_FEATURE_LIST(APPEND)
#undef APPEND
    (void)snprintf(row + at, size - (size_t)at, " |\n");
}

TEST(blob_md_lists_the_optional_tables_in_their_order)
{
    FILE *file = fopen("firmware/BLOB.md", "rb");
    int i = BLOB_TABLE_normals;
    char line[256], row[256];

    if (file == NULL) {
        CHECK(false, "cannot read firmware/BLOB.md: run from the root");
        return;
    }
    while (i < BLOB_TABLE_COUNT && fgets(line, sizeof line, file) != NULL) {
        format_row(row, sizeof row, blob_tables + i);
        i += strcmp(line, row) == 0;
    }
    fclose(file);
    CHECK(i == BLOB_TABLE_COUNT, "no line like %s", row);
}

int main(int argc, char **argv)
{
    TEST_BEGIN("tools/scene_schema", argc, argv);
    RUN(every_byte_of_every_struct_has_one_row);
    RUN(no_two_tables_share_a_key);
    RUN(any_numbers_of_any_table_come_back_from_a_dump);
    RUN(blob_md_has_every_field_where_it_is);
    RUN(blob_md_lists_the_optional_tables_in_their_order);
    return TEST_END();
}
