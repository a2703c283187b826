/* dump_blob.c - all of a blob as text */
/* SPDX-License-Identifier: MIT */

#include "scene/blob/dump_blob.h"

#include <inttypes.h>

static void dump_features(FILE *file, uint32_t features)
{
#define DUMP_FEATURE(name, bit, text)                                          \
    if ((features & (uint32_t)name) != 0) {                                    \
        fprintf(file, " %s", text);                                            \
    }
    QL_FEATURE_LIST(DUMP_FEATURE)
#undef DUMP_FEATURE
}

static void dump_number(FILE *file, const blob_field_t *field, uint64_t value)
{
    switch (field->kind) {
    case BLOB_S16:
        fprintf(file, "%d", value < 0x8000 ? (int)value : (int)value - 0x10000);
        break;
    case BLOB_X16:
        fprintf(file, "0x%04" PRIx64, value);
        break;
    case BLOB_X32:
        fprintf(file, "0x%08" PRIx64, value);
        break;
    case BLOB_WIDE:
        fprintf(file, "0x%08" PRIx64 ".%08" PRIx64, value >> 32,
                value & 0xffffffffu);
        break;
    default:
        fprintf(file, "%" PRIu64, value);
    }
}

static void dump_field(FILE *file, const blob_field_t *field, const void *entry)
{
    if (field->kind == BLOB_FEATURES) {
        dump_features(file, (uint32_t)blob_get(field, entry, 0));
        return;
    }
    for (unsigned i = 0; i < field->count; i++) {
        fprintf(file, "%*s", i == 0 ? field->gap : 1, "");
        dump_number(file, field, blob_get(field, entry, i));
    }
}

/* Dump structs; per_line of them follow each other on a line. */
static void dump_structs(FILE *file, const blob_table_t *table,
        const void *entries, size_t count)
{
    const blob_struct_t *s = &table->entry;
    bool begun = false;

    for (size_t n = 0; n < count; n++) {
        const void *entry = (const char *)entries + n * s->bytes;

        for (unsigned f = 0; f < s->field_count; f++) {
            const blob_field_t *field = s->fields + f;

            if (field->key != NULL && n % table->per_line == 0) {
                fprintf(file, "%s%s", begun ? "\n" : "", field->key);
                begun = true;
            }
            if (field->gap > 0) {
                dump_field(file, field, entry);
            }
        }
    }
    fputs(begun ? "\n" : "", file);
}

static void dump_table(
        FILE *file, const blob_table_t *table, const model_table_t *from)
{
    if (table->count_max == 1) {
        fprintf(file, "# %s\n", table->title);
    } else {
        fprintf(file, "# %" PRIu32 " %s\n", from->count, table->title);
    }
    dump_structs(
            file, table, from->entries, (size_t)from->count * table->repeat);
}

/* As people want them: what belongs together side by side. */
static const int order[] = {BLOB_TABLE_camera, BLOB_TABLE_lens,
        BLOB_TABLE_vertices, BLOB_TABLE_normals, BLOB_TABLE_triangles,
        BLOB_TABLE_pairs16, BLOB_TABLE_pairs8, BLOB_TABLE_materials,
        BLOB_TABLE_lights, BLOB_TABLE_gloss, BLOB_TABLE_spheres, BLOB_TABLE_sky,
        BLOB_TABLE_texels, BLOB_TABLE_tables, BLOB_TABLE_words,
        BLOB_TABLE_contacts, BLOB_TABLE_ranks, BLOB_TABLE_hull,
        BLOB_TABLE_sides};

QL_STATIC_ASSERT(sizeof order / sizeof *order == BLOB_TABLE_COUNT,
        each_table_has_its_place_in_a_dump);

void dump_blob(FILE *file, const model_t *model)
{
    model_table_t tables[BLOB_TABLE_COUNT];

    model_get_tables(model, tables);
    fputs(DUMP_NAME " " DUMP_VERSION "\n", file);
    dump_structs(file, &blob_header, &model->header, 1);
    for (int i = 0; i < BLOB_TABLE_COUNT; i++) {
        const blob_table_t *table = blob_tables + order[i];

        if (blob_has_table(table, model->header.features)) {
            dump_table(file, table, tables + order[i]);
        }
    }
    fputs(DUMP_END "\n", file);
}
