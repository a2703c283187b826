/* write_blob.c - a model to the bytes of a blob */
/* SPDX-License-Identifier: MIT */

#include "scene/blob/write_blob.h"

#include "base/ql_crc.h"
#include "lib/program/cli.h"

/* Turn structs of this machine into those of a blob. */
static void encode(
        uint8_t *to, const blob_struct_t *s, const void *from, size_t count)
{
    for (size_t n = 0; n < count; n++) {
        for (unsigned f = 0; f < s->field_count; f++) {
            const blob_field_t *field = s->fields + f;
            const unsigned bytes = blob_number_bytes(field);

            for (unsigned i = 0; i < blob_field_bytes(field); i++) {
                const uint64_t number = blob_get(field, from, i / bytes);

                to[field->offset + i] =
                        (uint8_t)(number >> 8 * (i % bytes) & 0xffu);
            }
        }
        to += s->bytes;
        from = (const char *)from + s->bytes;
    }
}

/* Where each table lies, and where the last one ends. Counts are below 2^32 and
 * entries below 2^8 bytes, so 15 tables stay below 2^44. */
typedef struct {
    uint64_t offset[BLOB_TABLE_COUNT];
    uint64_t end;
    uint16_t header_bytes;
} layout_t;

static void lay_out(layout_t *layout, uint32_t features,
        const model_table_t tables[BLOB_TABLE_COUNT])
{
    uint64_t end = BLOB_PLACES_FROM;

    for (int i = 0; i < BLOB_TABLE_COUNT; i++) {
        end += blob_has_table(blob_tables + i, features) ? blob_place.bytes : 0;
    }
    layout->header_bytes = (uint16_t)end; /* 176 at most */
    for (int i = 0; i < BLOB_TABLE_COUNT; i++) {
        layout->offset[i] = end;
        if (blob_has_table(blob_tables + i, features)) {
            end += (tables[i].count * blob_entry_bytes(blob_tables + i) + 3) /
                   4 * 4;
        }
    }
    layout->end = end;
    if (end > UINT32_MAX) {
        cli_fail(CLI_INPUT,
                "expected a scene whose blob stays below 2^32 "
                "bytes, found one of %llu",
                (unsigned long long)end);
    }
}

static void put_tables(uint8_t *blob, const layout_t *layout, uint32_t features,
        const model_table_t tables[BLOB_TABLE_COUNT])
{
    uint8_t *place = blob + BLOB_PLACES_FROM;

    for (int i = 0; i < BLOB_TABLE_COUNT; i++) {
        const blob_table_t *table = blob_tables + i;

        if (blob_has_table(table, features)) {
            const ql_blob_table_t at = {
                    (uint32_t)layout->offset[i], tables[i].count}; /* <= end */

            encode(place, &blob_place, &at, 1);
            place += blob_place.bytes;
            encode(blob + layout->offset[i], &table->entry, tables[i].entries,
                    (size_t)tables[i].count * table->repeat);
        }
    }
}

uint8_t *write_blob(const model_t *model, size_t *size)
{
    model_table_t tables[BLOB_TABLE_COUNT];
    ql_blob_header_t header = model->header;
    layout_t layout;
    uint8_t *blob;

    model_get_tables(model, tables);
    lay_out(&layout, header.features, tables);
    *size = (size_t)layout.end;
    blob = cli_alloc(*size, 1);
    header.magic = QL_BLOB_MAGIC;
    header.version = QL_BLOB_VERSION;
    header.header_bytes = layout.header_bytes;
    header.size_bytes = (uint32_t)layout.end; /* lay_out() has checked it */
    header.crc32 = 0;
    encode(blob, &blob_header.entry, &header, 1);
    put_tables(blob, &layout, header.features, tables);
    header.crc32 = ql_crc32(
            0, blob + QL_BLOB_CRC_FROM, *size - (size_t)QL_BLOB_CRC_FROM);
    encode(blob, &blob_header.entry, &header, 1);
    return blob;
}
