/* model.h - everything a blob says, in the numbers of this machine */
/* SPDX-License-Identifier: MIT */

/* The structs are from ql_blob.h, but every field holds its value in the
 * host's byte order: write_blob() and read_blob() convert. */

#ifndef MODEL_H
#define MODEL_H

#include "scene/blob/blob_schema.h"

typedef struct {
    ql_blob_header_t header; /* sizes, CRC and places of tables unused */
    /* name and name_count of every table; NULL and 0 if it is not there */
#define MODEL_TABLE(name, type, features)                                      \
    type *name;                                                                \
    uint32_t name##_count;
    BLOB_TABLE_LIST(MODEL_TABLE)
#undef MODEL_TABLE
} model_t;

/* The same tables without their types, for who walks the schema. */
typedef struct {
    void *entries;
    uint32_t count;
} model_table_t;

/* Bits of a node's box: 8 or 16. */
unsigned model_node_bits(const model_t *model);

/* Pairs of the BVH, whatever their width. */
uint32_t model_pair_count(const model_t *model);

/* Tables by their BLOB_TABLE_ number. Entries are still the model's. */
void model_get_tables(
        const model_t *model, model_table_t tables[BLOB_TABLE_COUNT]);

/* Give a model its tables; entries, from malloc(), are the model's now. */
void model_set_tables(
        model_t *model, const model_table_t tables[BLOB_TABLE_COUNT]);

void model_free(model_t *model);

#endif
