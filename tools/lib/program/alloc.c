/* alloc.c - arrays that grow, copies of text */
/* SPDX-License-Identifier: MIT */

#include "lib/program/alloc.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "lib/program/cli.h"

void *alloc_grow(void *array, size_t count, size_t *capacity, size_t size)
{
    if (count < *capacity) {
        return array;
    }
    if (*capacity > SIZE_MAX / 4 / size) {
        cli_fail(CLI_IO, "out of memory");
    }
    *capacity = *capacity > 0 ? 2 * *capacity : 64;
    array = realloc(array, *capacity * size);
    if (array == NULL) {
        cli_fail(CLI_IO, "out of memory");
    }
    return array;
}

char *alloc_text(const char *text, size_t length)
{
    char *copy = cli_alloc(length + 1, 1);

    memcpy(copy, text, length);
    return copy;
}
