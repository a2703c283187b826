/* foreign.c - bytes that other programs leave in OBJ and MTL files */
/* SPDX-License-Identifier: MIT */

#include "scene/foreign/foreign.h"

#include <ctype.h>
#include <stdbool.h>
#include <string.h>

#include "lib/files/kind.h"
#include "lib/program/cli.h"

static bool is_space(char c)
{
    return c == '\0' || isspace((unsigned char)c);
}

/* Is byte at behind a '#' that begins a word of its line? */
static bool is_comment(const char *data, size_t at)
{
    bool found = false;

    while (at > 0 && data[at - 1] != '\n' && data[at - 1] != '\r') {
        at--;
        found = found ||
                (data[at] == '#' && (at == 0 || is_space(data[at - 1])));
    }
    return found;
}

/* A Windows line end counts once. */
static unsigned count_lines(const char *data, size_t from, size_t to)
{
    unsigned lines = 0;

    for (size_t i = from; i < to; i++) {
        lines += data[i] == '\n' || (data[i] == '\r' && data[i + 1] != '\n');
    }
    return lines;
}

void foreign_clean(notes_t *notes, char *data, size_t size)
{
    char *zero;
    size_t at = 0;
    unsigned line = 1;

    kind_refuse(notes->path, data, size, KIND_MODEL);
    while ((zero = memchr(data + at, 0, size - at)) != NULL) {
        const size_t begin = (size_t)(zero - data);
        size_t end = begin;

        while (end < size && data[end] == '\0') {
            end++;
        }
        line += count_lines(data, at, begin);
        if (begin > 0 && end < size && !is_space(data[begin - 1]) &&
                !is_space(data[end]) && !is_comment(data, begin)) {
            cli_fail(CLI_INPUT,
                    "%s:%u: byte %zu is zero inside a word; expected a text "
                    "file",
                    notes->path, line, begin);
        }
        for (size_t i = begin; i < end; i++) {
            notes_add(notes, line, "zero bytes", "zero bytes are blanks here");
        }
        memset(data + begin, ' ', end - begin);
        at = end;
    }
}
