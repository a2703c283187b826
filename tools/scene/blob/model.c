/* model.c - everything a blob says, in the numbers of this machine */
/* SPDX-License-Identifier: MIT */

#include "scene/blob/model.h"

#include <stdlib.h>
#include <string.h>

unsigned model_node_bits(const model_t *model)
{
    return (model->header.features & QL_FEATURE_NODE8) != 0 ? 8 : 16;
}

uint32_t model_pair_count(const model_t *model)
{
    return model_node_bits(model) == 8 ? model->pairs8_count
                                       : model->pairs16_count;
}

void model_get_tables(
        const model_t *model, model_table_t tables[BLOB_TABLE_COUNT])
{
#define GET_TABLE(name, type, features)                                        \
    tables[BLOB_TABLE_##name].entries = model->name;                           \
    tables[BLOB_TABLE_##name].count = model->name##_count;
    BLOB_TABLE_LIST(GET_TABLE)
#undef GET_TABLE
}

void model_set_tables(
        model_t *model, const model_table_t tables[BLOB_TABLE_COUNT])
{
#define SET_TABLE(name, type, features)                                        \
    model->name = tables[BLOB_TABLE_##name].entries;                           \
    model->name##_count = tables[BLOB_TABLE_##name].count;
    BLOB_TABLE_LIST(SET_TABLE)
#undef SET_TABLE
}

void model_free(model_t *model)
{
    model_table_t tables[BLOB_TABLE_COUNT];

    model_get_tables(model, tables);
    for (int i = 0; i < BLOB_TABLE_COUNT; i++) {
        free(tables[i].entries);
    }
    memset(model, 0, sizeof *model);
}
