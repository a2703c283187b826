/* add_table.c - append a distribution to the tables of a blob */
/* SPDX-License-Identifier: MIT */

#include "scene/build/add_table.h"

#include <stdlib.h>
#include <string.h>

#include "lib/math/build_table.h"
#include "lib/program/cli.h"

#define WORDS_MOST  ((uint32_t)1 << 28)
#define TABLES_MOST UINT16_MAX

/* Room for one more entry of a table; the old ones stay. */
static void *enlarge(void *old, size_t count, size_t more, size_t size)
{
    void *array = cli_alloc(count + more, size);

    if (count > 0) {
        memcpy(array, old, count * size);
    }
    free(old);
    return array;
}

void add_table(model_t *model, const world_table_t *table, const char *path)
{
    const uint32_t n = table_words(table->dims, table->count);
    const uint32_t first = model->words_count;
    ql_blob_distribution_t *entry;
    table_error_t error;

    if (n == 0 || n > WORDS_MOST - first ||
            model->tables_count >= TABLES_MOST) {
        cli_fail(CLI_INPUT,
                "%s: expected %lu tables of %lu words in all at most", path,
                (unsigned long)TABLES_MOST, (unsigned long)WORDS_MOST);
    }
    model->tables = enlarge(
            model->tables, model->tables_count, 1, sizeof *model->tables);
    model->words = enlarge(model->words, first, n, sizeof *model->words);
    entry = model->tables + model->tables_count++;
    model->words_count += n;
    entry->first = first;
    entry->dims = (uint16_t)table->dims;
    for (unsigned k = 0; k < 3; k++) {
        entry->count[k] = k < table->dims ? table->count[k] : 1;
    }
    error = table_build(
            model->words + first, table->weights, table->dims, entry->count);
    if (error != TABLE_OK) {
        cli_fail(CLI_INPUT, "%s: table %lu: %s", path,
                (unsigned long)model->tables_count - 1,
                table_error_text(error));
    }
    for (uint32_t i = first; i < model->words_count; i++) {
        model->words[i] = QL_LE16(model->words[i]); /* little-endian to ours */
    }
}
