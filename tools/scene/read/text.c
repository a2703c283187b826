/* text.c - lines and words of a text file, errors with file and line */
/* SPDX-License-Identifier: MIT */

#include "scene/read/text.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lib/program/cli.h"
#include "lib/program/alloc.h"
#include "scene/foreign/foreign.h"

#define NUMBER_MOST 1e300

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

/* Begin at the first line of data. */
static void begin_text(text_t *text, const char *path, char *data, size_t size)
{
    memset(text, 0, sizeof *text);
    text->path = path;
    text->data = data;
    text->next = data;
    text->end = data + size;
    text->rest = text->end;
    text->next_line = 1;
    if (size >= 3 && memcmp(data, "\xef\xbb\xbf", 3) == 0) {
        text->next += 3; /* a byte order mark */
    }
}

void text_open(text_t *text, const char *path, kind_t wanted)
{
    size_t size;
    char *data = cli_read(path, &size);
    const char *zero = memchr(data, 0, size);

    kind_refuse(path, data, size, wanted);
    if (zero != NULL) {
        cli_fail(CLI_INPUT, "%s: byte %zu is zero; expected a text file", path,
                (size_t)(zero - data));
    }
    begin_text(text, path, data, size);
}

void text_of(text_t *text, const char *path, char *data)
{
    begin_text(text, path, data, strlen(data));
}

void text_open_foreign(text_t *text, const char *path, notes_t *notes,
        const char *const *whole)
{
    size_t size;
    char *data = cli_read(path, &size);

    notes->path = path;
    foreign_clean(notes, data, size);
    begin_text(text, path, data, size);
    text->notes = notes;
    text->whole = whole;
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

/* Is the key of the line that begins here one of those kept whole? */
static bool is_whole(const text_t *text)
{
    const char *key = text->next + strspn(text->next, " \t\v\f");
    const size_t length = strcspn(key, " \t\v\f\r\n");

    for (size_t i = 0; text->whole != NULL && text->whole[i] != NULL; i++) {
        if (strlen(text->whole[i]) == length &&
                memcmp(text->whole[i], key, length) == 0) {
            return true;
        }
    }
    return false;
}

/* Does a line end in a backslash? It is blanked; so are blanks behind it, which
 * are noted. */
static bool take_backslash(text_t *text, char *start, char *end)
{
    char *last = end;

    while (last > start && is_blank(last[-1])) {
        last--;
    }
    if (last == start || last[-1] != '\\') {
        return false;
    }
    last[-1] = ' ';
    if (last != end && text->notes != NULL) {
        notes_add(text->notes, text->next_line, "blanks behind a backslash",
                "a backslash with blanks behind it continues the line");
    }
    return true;
}

typedef enum { COMMENTS, WHOLE } line_kind_t;

/* Take one physical line, blank its comment and its end. True if a backslash
 * says that it goes on. */
static bool take_line(text_t *text, line_kind_t kind)
{
    char *const start = text->next;
    char *end = start + strcspn(start, "\r\n");
    char *after = end;
    char *comment = kind == WHOLE ? end : find_comment(start, end);
    bool goes_on = comment == end && take_backslash(text, start, end);

    if (*after == '\r' && after[1] == '\n') {
        *after++ = ' ';
    }
    if (after < text->end) {
        *after++ = ' ';
    }
    text->next = after;
    text->next_line++;
    memset(comment, ' ', (size_t)(after - comment));
    return goes_on;
}

bool text_line(text_t *text)
{
    while (text->next < text->end) {
        const line_kind_t kind = is_whole(text) ? WHOLE : COMMENTS;
        char *end;

        text->line = text->next_line;
        text->rest = text->next;
        while (take_line(text, kind) && text->next < text->end) {
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
    if (!(fabs(value) <= NUMBER_MOST)) {
        text_fail(text, "expected %s of at most %g, found '%s'", what,
                NUMBER_MOST, word);
    }
    return value;
}

/* Without its sign: nan, nan(ind), inf, infinity as C writes them, and what
 * begins with 1.# as Windows does. */
static bool is_no_finite_number(const char *word)
{
    char lower[16] = "";

    word += *word == '-' || *word == '+';
    for (size_t i = 0; i + 1 < sizeof lower && word[i] != '\0'; i++) {
        lower[i] = (char)tolower((unsigned char)word[i]);
    }
    return strcmp(lower, "nan") == 0 || strncmp(lower, "nan(", 4) == 0 ||
           strcmp(lower, "inf") == 0 || strcmp(lower, "infinity") == 0 ||
           strncmp(lower, "1.#", 3) == 0;
}

double text_coordinate(text_t *text, const char *what)
{
    const size_t length = strcspn(text->rest, " \t\v\f");
    char word[64] = "", *end;
    double value;

    if (length == 0 || length >= sizeof word) {
        return text_number(text, what);
    }
    memcpy(word, text->rest, length);
    value = strtod(word, &end);
    if (is_no_finite_number(word) ||
            (*end == '\0' && !(fabs(value) <= NUMBER_MOST))) {
        (void)text_word(text);
        return NAN;
    }
    return text_number(text, what);
}

bool text_try_number(text_t *text, double *value)
{
    const char *word = text_word(text);
    char *end;
    double number;

    if (word == NULL || word[strspn(word, "0123456789+-.eE")] != '\0') {
        return false;
    }
    number = strtod(word, &end);
    if (*end != '\0' || !(fabs(number) <= NUMBER_MOST)) {
        return false;
    }
    *value = number;
    return true;
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

bool text_cut_comment(char *name)
{
    char *end = name + strlen(name);

    do {
        if (end == name) {
            return false;
        }
        end--;
    } while (*end != '#' || (end != name && !is_blank(end[-1])));
    while (end > name && is_blank(end[-1])) {
        end--;
    }
    *end = '\0';
    return true;
}

/* Length of a name without a comment that begins with a lone '#'. */
static size_t find_name_length(const char *name)
{
    size_t length = 0;

    for (size_t i = 0; name[i] != '\0'; i++) {
        if (name[i] == '#' && (i == 0 || is_blank(name[i - 1])) &&
                (name[i + 1] == '\0' || is_blank(name[i + 1]))) {
            break;
        }
        length = is_blank(name[i]) ? length : i + 1;
    }
    return length;
}

bool text_is_same_name(const char *name, const char *other)
{
    const size_t length = find_name_length(name);

    return length == find_name_length(other) &&
           memcmp(name, other, length) == 0;
}

void text_fail(const text_t *text, const char *format, ...)
{
    char message[512];
    va_list arguments;

    va_start(arguments, format);
    (void)vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    if (text->notes != NULL) {
        notes_report(text->notes);
    }
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
