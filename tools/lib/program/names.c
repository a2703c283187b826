/* names.c - sets of names */
/* SPDX-License-Identifier: MIT */

#include "lib/program/names.h"

#include <stdlib.h>
#include <string.h>

#include "lib/program/alloc.h"

bool names_add(names_t *set, const char *name)
{
    for (size_t i = 0; i < set->count; i++) {
        if (strcmp(set->names[i], name) == 0) {
            return false;
        }
    }
    set->names = alloc_grow(
            set->names, set->count, &set->capacity, sizeof *set->names);
    set->names[set->count++] = alloc_text(name, strlen(name));
    return true;
}

void names_free(names_t *set)
{
    for (size_t i = 0; i < set->count; i++) {
        free(set->names[i]);
    }
    free(set->names);
    memset(set, 0, sizeof *set);
}
