/* read_table.c - tabulated distributions from text files */
/* SPDX-License-Identifier: MIT */

#include "scene/read/read_table.h"

#include <string.h>

#include "lib/program/cli.h"
#include "scene/read/text.h"

#define CELLS_MOST ((int64_t)1 << 24)

static void expect(text_t *text, const char *keyword)
{
    const char *word = text_word(text);

    if (word == NULL || strcmp(word, keyword) != 0) {
        text_fail(text, "expected dims D cells N for each, then the weights");
    }
}

/* The first line; return how many weights follow. */
static int64_t read_size(text_t *text, world_table_t *table)
{
    int64_t cells = 1;

    if (!text_line(text)) {
        text_fail(text, "expected dims D cells N for each, then the weights");
    }
    expect(text, "dims");
    table->dims = (unsigned)text_integer(text, "the dimensions", 1, 3);
    expect(text, "cells");
    for (unsigned d = 0; d < 3; d++) {
        table->count[d] = 1;
        if (d < table->dims) {
            table->count[d] = (uint16_t)text_integer(
                    text, "the cells of each dimension", 1, UINT16_MAX);
        }
        cells *= table->count[d]; /* < 2^48 */
    }
    if (cells > CELLS_MOST) {
        text_fail(text, "expected at most 2^24 cells, found %lld",
                (long long)cells);
    }
    return cells;
}

static bool more_words(text_t *text)
{
    return *text->rest != '\0' || text_line(text);
}

void read_table(world_t *world, const char *path)
{
    world_table_t *table = world_add_table(world);
    bool any = false;
    text_t text;
    int64_t cells;

    text_open(&text, path, KIND_TEXT);
    cells = read_size(&text, table);
    table->weights = cli_alloc((size_t)cells, sizeof *table->weights);
    for (int64_t i = 0; i < cells; i++) {
        if (!more_words(&text)) {
            text_fail(&text, "expected %lld weights, found %lld",
                    (long long)cells, (long long)i);
        }
        table->weights[i] = text_number(&text, "a weight");
        if (table->weights[i] < 0) {
            text_fail(&text, "expected a weight of 0 or more, found %g",
                    table->weights[i]);
        }
        any = any || table->weights[i] > 0;
    }
    if (more_words(&text)) {
        text_fail(&text, "expected %lld weights, found '%s' too",
                (long long)cells, text_word(&text));
    }
    if (!any) {
        text_fail(&text, "expected a weight above 0, found none");
    }
    text_close(&text);
}
