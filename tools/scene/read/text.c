/* text.c - lines and words of a text file, errors with file and line */
/* SPDX-License-Identifier: MIT */

#include "scene/read/text.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/program/cli.h"
#include "lib/program/alloc.h"

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

void text_open(text_t *text, const char *path)
{
    size_t size;
    char *data = cli_read(path, &size);
    const char *zero = memchr(data, 0, size);

    if (zero != NULL) {
        cli_fail(CLI_INPUT, "%s: byte %zu is zero; expected a text file", path,
                (size_t)(zero - data));
    }
    text->path = path;
    text->data = data;
    text->next = data;
    text->end = data + size;
    text->rest = text->end;
    text->line = 0;
    text->next_line = 1;
    if (size >= 3 && memcmp(data, "\xef\xbb\xbf", 3) == 0) {
        text->next += 3; /* a byte order mark */
    }
}

void text_close(text_t *text)
{
    free(text->data);
    memset(text, 0, sizeof *text);
}

/* Where the comment of a physical line begins, or its end. */
static char *find_comment(char *line, char *end)
{
    for (char *c = line; c < end; c++) {
        if (*c == '#' && (c == line || is_blank(c[-1]))) {
            return c;
        }
    }
    return end;
}

/* Take one physical line, blank its comment and its end. True if a backslash
 * says that it goes on. */
static bool take_line(text_t *text)
{
    char *const start = text->next;
    char *end = start + strcspn(start, "\r\n");
    char *after = end;
    char *comment = find_comment(start, end);

    if (*after == '\r' && after[1] == '\n') {
        *after++ = ' ';
    }
    if (after < text->end) {
        *after++ = ' ';
    }
    text->next = after;
    text->next_line++;
    memset(comment, ' ', (size_t)(after - comment));
    if (comment == end && end > start && end[-1] == '\\') {
        end[-1] = ' ';
        return true;
    }
    return false;
}

bool text_line(text_t *text)
{
    while (text->next < text->end) {
        char *end;

        text->line = text->next_line;
        text->rest = text->next;
        while (take_line(text) && text->next < text->end) {
        }
        end = text->next;
        while (end > text->rest && is_blank(end[-1])) {
            end--;
        }
        /* the last line may lack an end; the zero after the file serves */
        *end = '\0';
        while (is_blank(*text->rest)) {
            text->rest++;
        }
        if (text->rest < end) {
            return true;
        }
    }
    return false;
}

char *text_word(text_t *text)
{
    char *word = text->rest;
    char *end;

    if (*word == '\0') {
        return NULL;
    }
    end = word;
    while (*end != '\0' && !is_blank(*end)) {
        end++;
    }
    text->rest = end;
    while (is_blank(*text->rest)) {
        text->rest++;
    }
    *end = '\0';
    return word;
}

char *text_rest(text_t *text)
{
    char *rest = text->rest;

    if (*rest == '\0') {
        return NULL;
    }
    text->rest += strlen(rest);
    return rest;
}

double text_number(text_t *text, const char *what)
{
    const char *word = text_word(text);
    char *end;
    double value;

    if (word == NULL) {
        text_fail(text, "expected %s, found the end of the line", what);
    }
    value = strtod(word, &end);
    /* strtod also reads "nan", "inf" and "0x1p3" */
    if (*end != '\0' || word[strspn(word, "0123456789+-.eE")] != '\0') {
        text_fail(text, "expected %s, found '%s'", what, word);
    }
    if (!(fabs(value) <= 1e300)) {
        text_fail(text, "expected %s of at most 1e300, found '%s'", what, word);
    }
    return value;
}

int64_t text_integer(text_t *text, const char *what, int64_t min, int64_t max)
{
    const char *word = text_word(text);
    char *end;
    long long value;

    if (word == NULL) {
        text_fail(text, "expected %s, found the end of the line", what);
    }
    errno = 0;
    value = strtoll(word, &end, strncmp(word, "0x", 2) == 0 ? 16 : 10);
    if (*end != '\0' || errno != 0 || value < min || value > max) {
        text_fail(text, "expected %s, an integer from %lld to %lld, found '%s'",
                what, (long long)min, (long long)max, word);
    }
    return value;
}

void text_finish(text_t *text)
{
    const char *word = text_word(text);

    if (word != NULL) {
        text_fail(text, "expected the end of the line, found '%s'", word);
    }
}

void text_fail(const text_t *text, const char *format, ...)
{
    char message[512];
    va_list arguments;

    va_start(arguments, format);
    (void)vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    cli_fail(CLI_INPUT, "%s:%u: %s", text->path, text->line, message);
}

char *text_beside(const char *path, const char *name)
{
    const char *slash = strrchr(path, '/');
    const size_t folder = slash != NULL ? (size_t)(slash + 1 - path) : 0;
    char *joined;

    if (name[0] == '/' || folder == 0) {
        return alloc_text(name, strlen(name));
    }
    joined = cli_alloc(folder + strlen(name) + 1, 1);
    memcpy(joined, path, folder);
    memcpy(joined + folder, name, strlen(name) + 1);
    return joined;
}
