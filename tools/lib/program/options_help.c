/* options_help.c - the help of a program, out of its table of options */
/* SPDX-License-Identifier: MIT */

#include "lib/program/options_help.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum {
    LINE_MAX_COLUMN = 79,
    LEFT_MAX = 20, /* a longer left column has its line for itself */
    TEXT_BYTES = 1024
};

void options_words(char *text, size_t size, const char *const *words)
{
    size_t used = 0;

    text[0] = '\0';
    for (int i = 0; words[i] != NULL && used < size; i++) {
        const char *between = i == 0 ? "" : words[i + 1] ? ", " : " or ";

        used += (size_t)snprintf(
                text + used, size - used, "%s%s", between, words[i]);
    }
}

uint64_t options_load(const option_t *option, const void *fields)
{
    const char *at = (const char *)fields + option->field.at;
    uint8_t v8;
    uint16_t v16;
    uint32_t v32;
    uint64_t v64;

    switch (option->field.bytes) {
    case 1:
        memcpy(&v8, at, 1);
        return v8;
    case 2:
        memcpy(&v16, at, 2);
        return v16;
    case 4:
        memcpy(&v32, at, 4);
        return v32;
    default:
        memcpy(&v64, at, 8);
        return v64;
    }
}

/* Print words from a column on, in which the cursor stands, and wrap them. */
static void print_wrapped(const char *text, size_t size, size_t column)
{
    size_t at = column;

    for (size_t i = 0; i < size;) {
        const size_t word = strcspn(text + i, " \n");
        const size_t length = word < size - i ? word : size - i;

        if (at > column && at + 1 + length > LINE_MAX_COLUMN) {
            printf("\n%*s", (int)column, "");
            at = column;
        } else if (at > column) {
            putchar(' ');
            at++;
        }
        printf("%.*s", (int)length, text + i);
        at += length;
        i += length + 1;
    }
    putchar('\n');
}

/* Two columns: what stands left, and from the column on what it is. */
static void print_row(
        const char *left, const char *right, size_t right_size, size_t column)
{
    if (strlen(left) + 4 > column) {
        printf("  %s\n%*s", left, (int)column, "");
    } else {
        printf("  %-*s", (int)column - 2, left);
    }
    print_wrapped(right, right_size, column);
}

/* The column in which the right one of two begins. */
static size_t column_of(const program_t *program)
{
    size_t longest = strlen("-h, --help");

    for (const option_section_t *s = program->sections; s->options; s++) {
        for (const option_t *o = s->options; o->name != NULL; o++) {
            const size_t length = strlen(o->name);

            if (o->help != NULL && length > longest && length <= LEFT_MAX) {
                longest = length;
            }
        }
    }
    return longest + 4;
}

/* What an option takes: ", 1 to 16". */
static void add_range(char *text, size_t size, const option_t *o)
{
    switch (o->kind) {
    case OPTION_WORD:
        snprintf(text, size, ": ");
        options_words(text + 2, size - 2, o->words);
        break;
    case OPTION_NUMBER:
    case OPTION_SIZE:
        snprintf(text, size, ", %.0f to %.0f%s", o->min, o->max,
                o->kind == OPTION_SIZE ? " a side" : "");
        break;
    case OPTION_REAL:
        if (o->max < HUGE_VAL) {
            snprintf(text, size, ", %g to %g%s%s", o->min, o->max,
                    o->words != NULL ? " or " : "",
                    o->words != NULL ? *o->words : "");
        }
        break;
    default:
        break;
    }
}

/* What holds if it is not given: " (default 16)". */
static void add_default(
        char *text, size_t size, const option_t *o, const void *defaults)
{
    if (o->preset != NULL) {
        snprintf(text, size, " (default %s)", o->preset);
    } else if (!o->required && o->kind == OPTION_NUMBER) {
        snprintf(text, size, " (default %" PRIu64 ")",
                options_load(o, defaults));
    } else if (!o->required && o->kind == OPTION_WORD) {
        snprintf(text, size, " (default %s)",
                o->words[options_load(o, defaults)]);
    }
}

/* Its help, what it takes before the first semicolon, its default. */
static void print_option(const option_t *o, const void *defaults, size_t column)
{
    const size_t head = strcspn(o->help, ";");
    char text[TEXT_BYTES];
    size_t used;

    snprintf(text, sizeof text, "%.*s", (int)head, o->help);
    used = strlen(text);
    add_range(text + used, sizeof text - used, o);
    used = strlen(text);
    snprintf(text + used, sizeof text - used, "%s", o->help + head);
    used = strlen(text);
    add_default(text + used, sizeof text - used, o, defaults);
    print_row(o->name, text, strlen(text), column);
}

/* Lines of a text behind a prefix, those with a tab as two columns. */
static void print_lines(const char *prefix, const char *text, size_t column)
{
    while (*text != '\0') {
        const size_t size = strcspn(text, "\n");
        const size_t left = strcspn(text, "\t\n");
        char start[LINE_MAX_COLUMN + 1];

        snprintf(start, sizeof start, "%s%.*s", prefix, (int)left, text);
        if (left < size) {
            print_row(start, text + left + 1, size - left - 1, column);
        } else if (prefix[0] != '\0') {
            printf("  %s\n", start);
        } else {
            print_wrapped(text, size, 0);
        }
        text += size + (text[size] == '\n');
    }
}

/* The forms of a command line, and in a column of its own what they do. */
static void print_usage(const program_t *program)
{
    char name[LINE_MAX_COLUMN + 1];
    size_t longest = 0;

    for (const char *line = program->usage; *line != '\0';) {
        const size_t left = strcspn(line, "\t\n");

        longest = left > longest ? left : longest;
        line += strcspn(line, "\n");
        line += *line == '\n';
    }
    snprintf(name, sizeof name, "%s ", program->name);
    print_lines(name, program->usage, strlen(name) + longest + 4);
}

static void print_exits(const program_t *program)
{
    char text[TEXT_BYTES];

    snprintf(text, sizeof text,
            "Exit: 0 done, 1 wrong usage, 2 bad input, 3 could not read or "
            "write, stopped%s%s",
            program->exits != NULL ? ", " : "",
            program->exits != NULL ? program->exits : "");
    print_lines("", text, 0);
}

void options_help(const program_t *program, const void *defaults)
{
    static const option_t own[] = {{.name = "-h, --help", .help = "print this"},
            {.name = "--version", .help = "print the version"}};
    const size_t column = column_of(program);
    char about[TEXT_BYTES];

    snprintf(about, sizeof about, "%s: %s\n\n", program->name, program->about);
    print_lines("", about, 0);
    print_usage(program);
    putchar('\n');
    for (const option_section_t *s = program->sections; s->options; s++) {
        if (s->title != NULL) {
            printf("\n%s\n", s->title);
        }
        for (const option_t *o = s->options; o->name != NULL; o++) {
            if (o->help != NULL) {
                print_option(o, defaults, column);
            }
        }
    }
    print_option(&own[0], defaults, column);
    print_option(&own[1], defaults, column);
    if (program->notes != NULL) {
        putchar('\n');
        print_lines("", program->notes, column);
    }
    putchar('\n');
    print_exits(program);
    printf("\nExample:\n");
    for (const char *line = program->example; *line != '\0';) {
        const int size = (int)strcspn(line, "\n");

        printf("  %.*s\n", size, line);
        line += size + (line[size] == '\n');
    }
}
