/* names.h - sets of names */
/* SPDX-License-Identifier: MIT */

#ifndef NAMES_H
#define NAMES_H

#include <stdbool.h>
#include <stddef.h>

/* Names that have been seen. All zero is the empty set. */
typedef struct {
    char **names;
    size_t count, capacity;
} names_t;

/* Add a name; false if it was there already. */
bool names_add(names_t *set, const char *name);

void names_free(names_t *set);

#endif
