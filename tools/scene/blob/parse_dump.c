/* parse_dump.c - the text of a dump back to a model */
/* SPDX-License-Identifier: MIT */

#include "scene/blob/parse_dump.h"

#include <stdlib.h>
#include <string.h>

#include "lib/program/alloc.h"
#include "scene/blob/dump_blob.h"

/* A table being read. */
typedef struct {
    const blob_table_t *table;
    char *entries;
    size_t count, capacity; /* structs: entries times repeat */
    unsigned lines;         /* bits: those the last struct has had */
} part_t;

enum { HEADER = BLOB_TABLE_COUNT }; /* its number among the parts */

typedef struct {
    part_t parts[BLOB_TABLE_COUNT + 1];
} parser_t;

bool is_dump(const text_t *text)
{
    const size_t length = strlen(DUMP_NAME);

    return strncmp(text->next, DUMP_NAME, length) == 0 &&
           strchr("\r\n \t", text->next[length]) != NULL;
}

/* ---- the lines of a struct ---- */

/* The first field of a line of a struct. */
static const blob_field_t *find_line(const blob_struct_t *s, unsigned line)
{
    unsigned f = 0;

    while (s->fields[f].key == NULL || line-- > 0) {
        f++;
    }
    return s->fields + f;
}

static unsigned count_lines(const blob_struct_t *s)
{
    unsigned count = 0;

    for (unsigned f = 0; f < s->field_count; f++) {
        count += s->fields[f].key != NULL;
    }
    return count;
}

/* The first line that a part's last struct lacks; 0 if a new struct begins. */
static unsigned find_next_line(const part_t *part)
{
    unsigned line = 0;

    while ((part->lines >> line & 1u) != 0) {
        line++;
    }
    return line < count_lines(&part->table->entry) ? line : 0;
}

/* Is no struct begun that lacks a line? */
static bool is_between(const part_t *part)
{
    const unsigned count = count_lines(&part->table->entry); /* < 32 */

    return part->count == 0 || part->lines == (1u << count) - 1;
}

/* ---- numbers ---- */

static uint64_t parse_wide(text_t *text)
{
    static const char digits[] = "0123456789abcdef";
    const char *word = text_word(text);

    if (word == NULL || strlen(word) != 19 || word[10] != '.' ||
            strncmp(word, "0x", 2) != 0 || strspn(word + 2, digits) != 8 ||
            strspn(word + 11, digits) != 8) {
        text_fail(text, "expected a number like 0x00000001.80000000");
    }
    return (uint64_t)strtoull(word + 2, NULL, 16) << 32 |
           strtoull(word + 11, NULL, 16);
}

static uint32_t parse_features(text_t *text)
{
    uint32_t features = 0;
    const char *word;

    while ((word = text_word(text)) != NULL) {
        const uint32_t before = features;

#define PARSE_FEATURE(name, bit, text)                                         \
    if (strcmp(word, text) == 0) {                                             \
        features |= (uint32_t)name;                                            \
    }
        QL_FEATURE_LIST(PARSE_FEATURE)
#undef PARSE_FEATURE
        if (features == before) {
            text_fail(text,
                    "expected names of features, each once, found "
                    "'%s'",
                    word);
        }
    }
    return features;
}

static uint64_t parse_number(text_t *text, const blob_field_t *field)
{
    const unsigned bits =
            field->bits != 0 ? field->bits : 8 * blob_number_bytes(field);

    switch (field->kind) {
    case BLOB_WIDE:
        return parse_wide(text);
    case BLOB_FEATURES:
        return parse_features(text);
    case BLOB_S16:
        return (uint64_t)text_integer(text, field->what, INT16_MIN, INT16_MAX);
    default: /* 32 bits at most */
        return (uint64_t)text_integer(
                text, field->what, 0, ((int64_t)1 << bits) - 1);
    }
}

/* The numbers of a line, from its first field to the next line's. */
static void parse_fields(text_t *text, const blob_struct_t *s,
        const blob_field_t *first, void *entry)
{
    const blob_field_t *field = first;

    do {
        for (unsigned i = 0; i < field->count && field->gap > 0; i++) {
            blob_set(field, entry, i, parse_number(text, field));
        }
        field++;
    } while (field < s->fields + s->field_count && field->key == NULL);
}

/* ---- tables ---- */

/* A new struct, all zero, behind the last. */
static void append(part_t *part, const text_t *text)
{
    const blob_table_t *table = part->table;

    if (part->count / table->repeat >= table->count_max) {
        text_fail(text, "expected at most %lu %s",
                (unsigned long)table->count_max, table->name);
    }
    part->entries = alloc_grow(
            part->entries, part->count, &part->capacity, table->entry.bytes);
    memset(part->entries + part->count * table->entry.bytes, 0,
            table->entry.bytes);
    part->count++;
    part->lines = 0;
}

/* Take a line of this key: the lines of a table of one entry have any order,
 * others that of the schema. */
static void take_line(
        part_t *part, text_t *text, unsigned line, const char *key)
{
    const blob_struct_t *s = &part->table->entry;
    const blob_field_t *first = find_line(s, line);

    if (part->table->count_max > 1) {
        line = find_next_line(part);
        first = find_line(s, line);
        if (strcmp(first->key, key) != 0) {
            text_fail(text, "expected a '%s' line here, found '%s'", first->key,
                    key);
        }
    } else if ((part->lines >> line & 1u) != 0) {
        text_fail(text, "expected one '%s', found a second", key);
    }
    do {
        if (is_between(part)) {
            append(part, text);
        }
        part->lines |= 1u << line;
        parse_fields(
                text, s, first, part->entries + (part->count - 1) * s->bytes);
    } while (part->table->per_line > 1 && *text->rest != '\0');
}

/* Take a line; true if it is the last. */
static bool parse_line(parser_t *p, text_t *text)
{
    const char *key = text_word(text);

    if (strcmp(key, DUMP_END) == 0) {
        text_finish(text);
        return true;
    }
    for (int i = 0; i <= HEADER; i++) {
        const blob_struct_t *s = &p->parts[i].table->entry;
        const unsigned count = count_lines(s);

        for (unsigned line = 0; line < count; line++) {
            if (strcmp(key, find_line(s, line)->key) == 0) {
                take_line(p->parts + i, text, line, key);
                text_finish(text);
                return false;
            }
        }
    }
    text_fail(text, "expected a key of a dump, found '%s'", key);
}

/* All lines, the first one of which names the version. */
static void parse_lines(parser_t *p, text_t *text)
{
    const char *version;
    bool ended = false;

    (void)text_line(text);
    (void)text_word(text);
    version = text_word(text);
    if (version == NULL || strcmp(version, DUMP_VERSION) != 0) {
        text_fail(text,
                "expected a dump of version " DUMP_VERSION ", found '%s'",
                version != NULL ? version : "");
    }
    text_finish(text);
    while (!ended && text_line(text)) {
        ended = parse_line(p, text);
    }
    if (!ended) {
        text_fail(text, "expected an '" DUMP_END "' line, for the rest is cut");
    }
    if (text_line(text)) {
        text_fail(text, "expected nothing after '" DUMP_END "', found '%s'",
                text_word(text));
    }
}

/* A table is there if and only if these features need it, and it is whole. */
static void check_part(
        const part_t *part, const text_t *text, uint32_t features)
{
    const blob_table_t *table = part->table;
    const bool bad = blob_has_table(table, features)
                             ? part->count < table->count_min
                             : part->count > 0;

    if (!is_between(part) || part->count % table->repeat != 0 ||
            (bad && table->features == 0)) {
        text_fail(text, "expected a '%s' line before the end of the file",
                find_line(&table->entry, find_next_line(part))->key);
    }
    if (bad) {
        text_fail(text, "expected %s if and only if a feature needs them",
                table->name);
    }
}

/* The tables are the model's now. */
static void finish(parser_t *p, model_t *model, const text_t *text)
{
    part_t *header = p->parts + HEADER;
    model_table_t tables[BLOB_TABLE_COUNT];

    check_part(header, text, 0);
    memcpy(&model->header, header->entries, sizeof model->header);
    free(header->entries);
    for (int i = 0; i < BLOB_TABLE_COUNT; i++) {
        const part_t *part = p->parts + i;

        check_part(part, text, model->header.features);
        tables[i].entries = part->entries;
        tables[i].count = (uint32_t)(part->count / part->table->repeat);
    }
    model_set_tables(model, tables);
}

void parse_dump(model_t *model, text_t *text)
{
    parser_t parser = {0};

    memset(model, 0, sizeof *model);
    for (int i = 0; i < BLOB_TABLE_COUNT; i++) {
        parser.parts[i].table = blob_tables + i;
    }
    parser.parts[HEADER].table = &blob_header;
    parse_lines(&parser, text);
    finish(&parser, model, text);
}
