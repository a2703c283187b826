/* options.c - one table of options a program: parsing, --help, wrong usage */
/* SPDX-License-Identifier: MIT */

#include "lib/program/options.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "lib/program/options_help.h"
#include "qlux.h"

enum { GIVEN_MAX = 64, TEXT_BYTES = 1024 };

/* The command line of this process. */
static struct {
    const program_t *program;
    char *into;
    size_t items_max; /* of a list */
    const option_t *given[GIVEN_MAX];
    unsigned given_count;
} line;

void options_fail(const char *format, ...)
{
    char message[TEXT_BYTES];
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    cli_fail(CLI_USAGE, "%s (see --help)", message);
}

/* ---- the table ----------------------------------------------------------- */

/* Entry i of all sections, or NULL behind the last. */
static const option_t *option_at(unsigned i)
{
    for (const option_section_t *s = line.program->sections; s->options; s++) {
        for (const option_t *o = s->options; o->name != NULL; o++) {
            if (i-- == 0) {
                return o;
            }
        }
    }
    return NULL;
}

static bool is_argument(const option_t *option)
{
    return option->name[0] != '-';
}

/* Length of a name without what stands for its value. */
static int name_size(const option_t *option)
{
    return (int)strcspn(option->name, " ");
}

static const option_t *find_option(const char *name)
{
    const option_t *o;

    for (unsigned i = 0; (o = option_at(i)) != NULL; i++) {
        const size_t size = (size_t)name_size(o);

        if (!is_argument(o) && strlen(name) == size &&
                strncmp(o->name, name, size) == 0) {
            return o;
        }
    }
    return NULL;
}

static bool is_given(const option_t *option)
{
    for (unsigned i = 0; i < line.given_count; i++) {
        if (line.given[i] == option) {
            return true;
        }
    }
    return false;
}

bool options_given(const char *name)
{
    const option_t *option = find_option(name);

    return option != NULL && is_given(option);
}

/* ---- values -------------------------------------------------------------- */

/* What a value of this option is, in words. */
static void describe(char *text, size_t size, const option_t *o)
{
    char words[TEXT_BYTES] = "";

    if (o->words != NULL) {
        options_words(words, sizeof words, o->words);
    }
    switch (o->kind) {
    case OPTION_FILE:
        snprintf(text, size,
                o->words != NULL ? "a name that ends in %s, or -"
                                 : "the name of a file%s",
                words);
        break;
    case OPTION_WORD:
        snprintf(text, size, "%s", words);
        break;
    case OPTION_NUMBER:
        snprintf(
                text, size, "a whole number from %.0f to %.0f", o->min, o->max);
        break;
    case OPTION_REAL:
        snprintf(text, size,
                o->words != NULL    ? "a number from %g to %g, or %s"
                : o->max < HUGE_VAL ? "a number from %g to %g"
                                    : "a number, %g or more",
                o->min, o->max, words);
        break;
    case OPTION_POSITIVE:
        snprintf(text, size, "a finite number above 0");
        break;
    case OPTION_SIZE:
        snprintf(text, size, "WxH, whole numbers from %.0f to %.0f", o->min,
                o->max);
        break;
    case OPTION_RANGE:
        snprintf(text, size, "A:B, A below B, whole numbers from %.0f to %.0f",
                o->min, o->max);
        break;
    default:
        snprintf(text, size, "%s", is_argument(o) ? o->name : "a text");
    }
}

static bool looks_like_option(const char *text)
{
    return text[0] == '-' &&
           (text[1] == '-' || (text[1] >= 'a' && text[1] <= 'z'));
}

/* Whatever else a value may be, it is not empty and no option's name. */
static void check_present(const option_t *option, const char *text)
{
    char wanted[TEXT_BYTES];

    describe(wanted, sizeof wanted, option);
    if (is_argument(option) && text[0] == '\0') {
        options_fail("'': expected %s", wanted);
    }
    if (!is_argument(option) &&
            (text == NULL || text[0] == '\0' || looks_like_option(text))) {
        options_fail("'%.*s' needs a value: %s", name_size(option),
                option->name, wanted);
    }
}

static void refuse_value(const option_t *option, const char *text)
{
    char wanted[TEXT_BYTES];

    describe(wanted, sizeof wanted, option);
    options_fail("'%.*s%s%s': expected %s",
            is_argument(option) ? 0 : name_size(option), option->name,
            is_argument(option) ? "" : " ", text, wanted);
}

/* Parse a decimal number within the option's limits at *text, which then
 * points behind it. */
static bool take_whole(const char **text, const option_t *option, uint32_t *out)
{
    const char *digits = *text + (**text == '-' || **text == '+');
    char *end;
    long long value;

    if (*digits < '0' || *digits > '9') { /* strtoll would skip spaces */
        return false;
    }
    errno = 0;
    value = strtoll(*text, &end, 10);
    *text = end;
    if (errno != 0 || (double)value < option->min ||
            (double)value > option->max) {
        return false;
    }
    *out = (uint32_t)value; /* 0 <= min, max < 2^32 */
    return true;
}

/* "AxB" or "A:B". */
static bool take_pair(
        const char *text, const option_t *option, char between, uint32_t out[2])
{
    return take_whole(&text, option, out) && *text++ == between &&
           take_whole(&text, option, out + 1) && *text == '\0';
}

/* A number of the field's size. */
static void store(const option_t *option, uint32_t value)
{
    const uint8_t v8 = (uint8_t)value;    /* the table's max or words fit */
    const uint16_t v16 = (uint16_t)value; /* likewise */
    const uint64_t v64 = value;
    char *at = line.into + option->field.at;

    switch (option->field.bytes) {
    case 1:
        memcpy(at, &v8, 1);
        break;
    case 2:
        memcpy(at, &v16, 2);
        break;
    case 4:
        memcpy(at, &value, 4);
        break;
    default:
        memcpy(at, &v64, 8);
    }
}

static bool take_word(const option_t *option, const char *text)
{
    for (unsigned i = 0; option->words[i] != NULL; i++) {
        if (strcmp(text, option->words[i]) == 0) {
            store(option, i);
            return true;
        }
    }
    return false;
}

static bool take_number(const option_t *option, const char *text)
{
    uint32_t value;

    if (!take_whole(&text, option, &value) || *text != '\0') {
        return false;
    }
    store(option, value);
    return true;
}

static bool take_real(const option_t *option, const char *text)
{
    const bool is_word =
            option->words != NULL && strcmp(text, *option->words) == 0;
    char *end;
    double value = strtod(text, &end);
    const bool fits = option->kind == OPTION_POSITIVE
                              ? value > 0 && value < HUGE_VAL
                              : value >= option->min && value <= option->max;

    if (is_word) {
        value = HUGE_VAL;
    } else if (end == text || *end != '\0' || !fits) {
        return false;
    }
    memcpy(line.into + option->field.at, &value, sizeof value);
    return true;
}

static bool take_range(const option_t *option, const char *text)
{
    uint32_t pair[2];
    option_range_t range;

    if (!take_pair(text, option, ':', pair) || pair[0] >= pair[1]) {
        return false;
    }
    range.first = pair[0];
    range.end = pair[1];
    memcpy(line.into + option->field.at, &range, sizeof range);
    return true;
}

static bool take_size(const option_t *option, const char *text)
{
    uint32_t pair[2];
    option_size_t size;

    if (!take_pair(text, option, 'x', pair)) {
        return false;
    }
    size.width = pair[0];
    size.height = pair[1];
    memcpy(line.into + option->field.at, &size, sizeof size);
    return true;
}

static bool take_text(const option_t *option, const char *text)
{
    bool fits = option->kind != OPTION_FILE || option->words == NULL ||
                strcmp(text, "-") == 0;

    for (unsigned i = 0; !fits && option->words[i] != NULL; i++) {
        const size_t size = strlen(text), end = strlen(option->words[i]);

        fits = size > end &&
               strcasecmp(text + size - end, option->words[i]) == 0;
    }
    memcpy(line.into + option->field.at, &text, sizeof text);
    return fits;
}

static bool take_item(const option_t *option, const char *text)
{
    const char *equals = strrchr(text, '=');
    option_list_t list;

    if (option->kind == OPTION_LABEL && (equals == NULL || equals[1] == '\0')) {
        return false;
    }
    memcpy(&list, line.into + option->field.at, sizeof list);
    if (list.items == NULL) {
        list.items = cli_alloc(line.items_max, sizeof *list.items);
    }
    list.items[list.count++] = text;
    memcpy(line.into + option->field.at, &list, sizeof list);
    return true;
}

/* ---- the command line ---------------------------------------------------- */

static void take(const option_t *option, const char *text)
{
    static bool (*const takers[])(const option_t *, const char *) = {
            [OPTION_TEXT] = take_text,
            [OPTION_FILE] = take_text,
            [OPTION_LIST] = take_item,
            [OPTION_LABEL] = take_item,
            [OPTION_WORD] = take_word,
            [OPTION_NUMBER] = take_number,
            [OPTION_REAL] = take_real,
            [OPTION_POSITIVE] = take_real,
            [OPTION_SIZE] = take_size,
            [OPTION_RANGE] = take_range};
    const bool flag = true;

    if (option->kind == OPTION_FLAG) {
        memcpy(line.into + option->field.at, &flag, sizeof flag);
    } else {
        check_present(option, text);
        if (!takers[option->kind](option, text)) {
            refuse_value(option, text);
        }
    }
    if (!is_given(option) && line.given_count < GIVEN_MAX) {
        line.given[line.given_count++] = option;
    }
}

/* The argument that the next one is, or NULL if there is no more. */
static const option_t *next_argument(void)
{
    const option_t *o;

    for (unsigned i = 0; (o = option_at(i)) != NULL; i++) {
        if (is_argument(o) &&
                (o->kind == OPTION_LIST || o->kind == OPTION_LABEL ||
                        !is_given(o))) {
            return o;
        }
    }
    return NULL;
}

/* What an entry of the command line begins; fails if it is none. */
static const option_t *find_entry(const char *text)
{
    const option_t *option = find_option(text), *next = next_argument();
    const bool dash = text[0] == '-' && text[1] != '\0';
    const bool label = next != NULL && next->kind == OPTION_LABEL &&
                       strchr(text, '=') != NULL;

    if (option == NULL && dash && !label) {
        options_fail("unknown option '%s'", text);
    }
    if (option == NULL && next == NULL) {
        options_fail("unexpected argument '%s'", text);
    }
    return option != NULL ? option : next;
}

/* --help and --version go before everything else: no option's value can look
 * like them. */
static void answer(int argc, char **argv)
{
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0) {
            options_help(line.program, line.into);
            exit(CLI_DONE);
        }
        if (strcmp(argv[i], "--version") == 0) {
            printf("%s %s\n", line.program->name, QLUX_VERSION);
            exit(CLI_DONE);
        }
    }
}

/* A file that is to be written, or NULL. */
static const char *output_of(const option_t *option)
{
    const char *path = NULL;

    if (option->kind == OPTION_FILE && is_given(option)) {
        memcpy(&path, line.into + option->field.at, sizeof path);
    }
    return path;
}

/* The second of two outputs would replace the first. */
static void refuse_same_outputs(void)
{
    const option_t *a, *b;

    for (unsigned i = 0; (a = option_at(i)) != NULL; i++) {
        for (unsigned k = 0; k < i && output_of(a) != NULL; k++) {
            b = option_at(k);
            if (output_of(b) != NULL &&
                    cli_same_output(output_of(b), output_of(a))) {
                options_fail("'%.*s %s': '%.*s' writes this file", name_size(a),
                        a->name, output_of(a), name_size(b), b->name);
            }
        }
    }
}

void options_parse(const program_t *program, int argc, char **argv, void *into)
{
    const option_t *o;

    cli_begin(program->name);
    line.program = program;
    line.into = into;
    line.items_max = (size_t)argc;
    line.given_count = 0;
    answer(argc, argv);
    for (int i = 1; i < argc; i++) {
        o = find_entry(argv[i]);
        i += !is_argument(o) && o->kind != OPTION_FLAG;
        take(o, argv[i]); /* argv[argc] is NULL */
    }
    for (unsigned i = 0; (o = option_at(i)) != NULL; i++) {
        if (o->required && !is_given(o)) {
            options_fail("missing %s", o->name);
        }
    }
    refuse_same_outputs();
}
