/* foreign.c - bytes that other programs leave in OBJ and MTL files */
/* SPDX-License-Identifier: MIT */

#include "scene/foreign/foreign.h"

#include <ctype.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>
#include <strings.h>

#include "lib/program/cli.h"

#define STL_HEADER   80 /* bytes; then the number of triangles */
#define STL_TRIANGLE 50 /* bytes */

#define CONVERT "expected OBJ or MTL; Blender or MeshLab converts meshes"

/* How files of other formats begin. */
static const struct {
    const char *begins;
    const char *format;
    const char *expected;
} formats[] = {{"ply", "a PLY mesh", CONVERT},
        {"solid", "an STL mesh", CONVERT}, {"OFF", "an OFF mesh", CONVERT},
        {"glTF", "a glTF mesh", CONVERT},
        {"Kaydara FBX", "an FBX scene", CONVERT},
        {"BLENDER", "a Blender scene", CONVERT},
        {"PK\3\4", "a zip archive", "expected OBJ or MTL; unpack it"},
        {"\x1f\x8b", "compressed by gzip", "expected OBJ or MTL; unpack it"},
        {"\xff\xfe", "text in UTF-16", "expected UTF-8; save it as that"},
        {"\xfe\xff", "text in UTF-16", "expected UTF-8; save it as that"}};

/* Does the file consist of a header and as many triangles as it says? */
static bool is_binary_stl(const char *data, size_t size)
{
    uint64_t count = 0;

    if (size < STL_HEADER + 4) {
        return false;
    }
    for (int i = 3; i >= 0; i--) {
        count = count << 8 | (unsigned char)data[STL_HEADER + i];
    }
    return count * STL_TRIANGLE == size - STL_HEADER - 4;
}

/* Do the bytes begin so? A word does only if it ends there. */
static bool has_beginning(const char *data, size_t size, const char *begins)
{
    const size_t length = strlen(begins);

    return size >= length && strncasecmp(data, begins, length) == 0 &&
           (!isalpha((unsigned char)*begins) || size == length ||
                   !isalpha((unsigned char)data[length]));
}

static void refuse_formats(const char *path, const char *data, size_t size)
{
    size_t blanks = 0;

    while (blanks < size && isspace((unsigned char)data[blanks])) {
        blanks++;
    }
    if (is_binary_stl(data, size)) {
        cli_fail(CLI_INPUT, "%s: this is an STL mesh; " CONVERT, path);
    }
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++) {
        if (has_beginning(data + blanks, size - blanks, formats[i].begins)) {
            cli_fail(CLI_INPUT, "%s: this is %s; %s", path, formats[i].format,
                    formats[i].expected);
        }
    }
}

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

    refuse_formats(notes->path, data, size);
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
