/* ql_blob_distributions.c - tabulated distributions, and their words */
/* SPDX-License-Identifier: MIT */

#include "blob/ql_blob_parts.h"

#include "sample/ql_table.h"

#if QL_CFG_TABLES

/* Do the rows of a distribution lie among the words, and are they sound? */
static bool distribution_valid(const ql_scene_t *scene,
        const ql_blob_distribution_t *d, uint32_t word_count)
{
    const uint32_t first = QL_LE32(d->first);
    uint16_t count[QL_TABLE_DIMS_MAX];
    ql_table_t table;

    for (unsigned k = 0; k < QL_TABLE_DIMS_MAX; k++) {
        count[k] = QL_LE16(d->count[k]);
        if (k >= QL_LE16(d->dims) && count[k] != 1) {
            return false;
        }
    }
    return first <= word_count &&
           ql_table_open(&table, scene->words + first, word_count - first,
                   QL_LE16(d->dims), count) == QL_OK;
}
bool ql_blob_distributions_open(ql_blob_parts_t *parts, ql_scene_t *scene)
{
    scene->tables = ql_blob_optional(
            parts, QL_FEATURE_TABLES, sizeof *scene->tables, UINT16_MAX);
    scene->table_count = (uint16_t)parts->count; /* <= UINT16_MAX */
    if (!parts->sound) {
        return false;
    }
    scene->words = ql_blob_optional(
            parts, QL_FEATURE_TABLES, sizeof *scene->words, UINT32_MAX / 2);
    if (!parts->sound) {
        return false;
    }
    for (uint16_t i = 0; i < scene->table_count; i++) {
        if (!distribution_valid(scene, scene->tables + i, parts->count)) {
            return false;
        }
    }
    return true;
}

#endif
