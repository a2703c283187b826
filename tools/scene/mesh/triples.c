/* triples.c - sets of integer triples, each with an index */
/* SPDX-License-Identifier: MIT */

#include "scene/mesh/triples.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "lib/program/cli.h"

#define NONE UINT32_MAX

void triples_open(triples_t *set, size_t count_max)
{
    size_t size = 16;

    while (size < 2 * count_max) {
        size *= 2;
    }
    set->keys = cli_alloc(size, sizeof *set->keys);
    set->indices = cli_alloc(size, sizeof *set->indices);
    memset(set->indices, 0xff, size * sizeof *set->indices);
    set->mask = size - 1;
}

static size_t hash(const triples_key_t *key)
{
    uint64_t sum = key->owner;

    for (int k = 0; k < 3; k++) {
        sum = (sum ^ key->triple[k]) * 0x9e3779b97f4a7c15u;
        sum ^= sum >> 29;
    }
    return (size_t)(sum >> 16);
}

static bool is_equal(const triples_key_t *a, const triples_key_t *b)
{
    return a->owner == b->owner && a->triple[0] == b->triple[0] &&
           a->triple[1] == b->triple[1] && a->triple[2] == b->triple[2];
}

uint32_t triples_add(triples_t *set, const triples_key_t *key, uint32_t index)
{
    size_t slot = hash(key) & set->mask;

    while (set->indices[slot] != NONE && !is_equal(set->keys + slot, key)) {
        slot = (slot + 1) & set->mask;
    }
    if (set->indices[slot] == NONE) {
        set->keys[slot] = *key;
        set->indices[slot] = index;
    }
    return set->indices[slot];
}

void triples_close(triples_t *set)
{
    free(set->keys);
    free(set->indices);
    memset(set, 0, sizeof *set);
}
