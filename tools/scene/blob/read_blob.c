/* read_blob.c - the bytes of a blob to a model */
/* SPDX-License-Identifier: MIT */

#include "scene/blob/read_blob.h"

#include <stdlib.h>
#include <string.h>

#include "lib/program/cli.h"
#include "lib/render/open_blob.h"
#include "scene/blob/write_blob.h"

/* A field that says nothing, so that no dump shows it. */
static bool is_zero(const blob_field_t *field)
{
    return strcmp(field->name, "zero") == 0;
}

/* Turn structs of a blob into those of this machine, which are all 0. */
static void decode(
        void *to, const blob_struct_t *s, const uint8_t *from, size_t count)
{
    for (size_t n = 0; n < count; n++) {
        for (unsigned f = 0; f < s->field_count; f++) {
            const blob_field_t *field = s->fields + f;
            const unsigned bytes = blob_number_bytes(field);
            uint64_t number = 0;

            for (unsigned i = 0; !is_zero(field) && i < blob_field_bytes(field);
                    i++) {
                const uint64_t byte = from[field->offset + i];

                number = i % bytes == 0 ? byte
                                        : number | byte << 8 * (i % bytes);
                blob_set(field, to, i / bytes, number);
            }
        }
        from += s->bytes;
        to = (char *)to + s->bytes;
    }
}

static void get_tables(model_t *model, const uint8_t *blob)
{
    const uint8_t *place = blob + BLOB_PLACES_FROM;
    model_table_t tables[BLOB_TABLE_COUNT] = {{NULL, 0}};

    for (int i = 0; i < BLOB_TABLE_COUNT; i++) {
        const blob_table_t *table = blob_tables + i;
        ql_blob_table_t at;

        if (blob_has_table(table, model->header.features)) {
            decode(&at, &blob_place, place, 1);
            place += blob_place.bytes;
            tables[i].count = at.count;
            tables[i].entries =
                    cli_alloc(at.count, (size_t)blob_entry_bytes(table));
            decode(tables[i].entries, &table->entry, blob + at.offset,
                    (size_t)at.count * table->repeat);
        }
    }
    model_set_tables(model, tables);
}

void read_blob(model_t *model, const char *path)
{
    size_t size, written;
    ql_scene_t scene;
    uint8_t *blob = cli_read(path, &size);
    uint8_t *again;

    open_blob_bytes(&scene, blob, size, path);
    memset(model, 0, sizeof *model);
    decode(&model->header, &blob_header.entry, blob, 1);
    get_tables(model, blob);
    /* What a dump does not say must go without saying: where tables lie, and
     * that there are zeros between them and in fields that say nothing. */
    again = write_blob(model, &written);
    if (written != size || memcmp(again, blob, size) != 0) {
        cli_fail(CLI_INPUT,
                "%s: expected the tables in the order and at the "
                "offsets qlux-scene gives them, and zeros elsewhere",
                path);
    }
    free(again);
    free(blob);
}
