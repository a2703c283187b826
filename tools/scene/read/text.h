/* text.h - lines and words of a text file, errors with file and line */
/* SPDX-License-Identifier: MIT */

/* Lines may end in LF, CR LF or CR; a backslash before the end continues them.
 * A '#' at the start of a word begins a comment. Words are separated by blanks
 * and tabs. */

#ifndef TEXT_H
#define TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct {
    const char *path;   /* for messages */
    char *data;         /* the whole file; words point into it */
    char *next;         /* first character not read yet */
    char *rest;         /* what is left of the line */
    char *end;          /* of the file */
    unsigned line;      /* number of the line, from 1 */
    unsigned next_line; /* of the first character not read yet */
} text_t;

/* Read a whole file. Fails with exit 3 if it cannot be read, 2 if it is not
 * text. path must outlive the text. */
void text_open(text_t *text, const char *path);

/* Free it. */
void text_close(text_t *text);

/* Go to the next line that is not empty; false at the end of the file. */
bool text_line(text_t *text);

/* The next word of the line, zero-terminated; NULL at its end. */
char *text_word(text_t *text);

/* All that is left of the line without blanks around it; NULL if nothing is. */
char *text_rest(text_t *text);

/* The next word as a finite number. Fails naming what was expected. */
double text_number(text_t *text, const char *what);

/* The next word as an integer in [min, max], decimal or 0x. Fails as
 * text_number() does. */
int64_t text_integer(text_t *text, const char *what, int64_t min, int64_t max);

/* Fail unless the line is at its end. */
void text_finish(text_t *text);

/* Print "program: file:line: message" and exit 2. */
#if defined(__GNUC__)
__attribute__((noreturn, format(printf, 2, 3)))
#endif
void text_fail(const text_t *text, const char *format, ...);

/* name as seen from the folder that path is in; malloc'd. */
char *text_beside(const char *path, const char *name);

#endif
